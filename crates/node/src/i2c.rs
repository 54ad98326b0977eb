//! I2C: parts with addresses on two wires.
//!
//! `(address, bytes of the driver) => bytes of the part, or no acknowledge`. Consecutive reads and writes are joined as
//! the trait requires: a (repeated) start occurs where the direction changes. Transfers take no time.

use embedded_hal::i2c::{ErrorType, I2c, Operation};

use crate::fault::{Fault, WiringError};
use crate::part::{Linked, fix};
use crate::share::Shared;

/// A part that speaks I2C, byte by byte.
pub trait I2cPart: Linked {
    /// Its seven-bit address.
    fn address(&self) -> u8;
    /// A start, or a repeated one, with this part's address; bytes follow to or from it.
    fn start(&mut self, reading: bool);
    /// A byte from the driver.
    fn take(&mut self, byte: u8);
    /// A byte for the driver.
    fn give(&mut self) -> u8;
    /// The stop.
    fn finish(&mut self);
}

/// Devices on the bus: a part in its cell, or several in a tuple.
pub trait OnI2c {
    /// Runs a transaction with the part at an address; `false` if there is none.
    ///
    /// # Errors
    /// [`Fault`] if the part is in use elsewhere or stopped.
    fn transact(&self, address: u8, operations: &mut [Operation<'_>]) -> Result<bool, Fault>;

    /// Checks that a node steps every part.
    ///
    /// # Errors
    /// [`WiringError`] with the name of the first that no node steps.
    fn check(&self) -> Result<(), WiringError>;
}

impl<C: Shared<Part: I2cPart>> OnI2c for C {
    fn transact(&self, address: u8, operations: &mut [Operation<'_>]) -> Result<bool, Fault> {
        self.with(|part| {
            if part.address() != address {
                return Ok(false);
            }
            part.link().check()?;
            let mut reading = None;
            for operation in operations {
                let reads = matches!(operation, Operation::Read(_));
                if reading != Some(reads) {
                    part.start(reads);
                    reading = Some(reads);
                }
                match operation {
                    Operation::Read(bytes) => bytes.iter_mut().for_each(|byte| *byte = part.give()),
                    Operation::Write(bytes) => bytes.iter().for_each(|&byte| part.take(byte)),
                }
            }
            part.finish();
            Ok(true)
        })?
    }

    fn check(&self) -> Result<(), WiringError> {
        fix(self)
    }
}

/// Two or more parts on the same wires; nest tuples for more than four.
macro_rules! on_i2c {
    ($($thing:ident)*) => {
        #[allow(non_snake_case)]
        impl<$($thing: OnI2c),*> OnI2c for ($($thing,)*) {
            fn transact(
                &self,
                address: u8,
                operations: &mut [Operation<'_>],
            ) -> Result<bool, Fault> {
                let ($($thing,)*) = self;
                $(if $thing.transact(address, operations)? {
                    return Ok(true);
                })*
                Ok(false)
            }

            fn check(&self) -> Result<(), WiringError> {
                let ($($thing,)*) = self;
                $($thing.check()?;)*
                Ok(())
            }
        }
    };
}

on_i2c!(A B);
on_i2c!(A B C);
on_i2c!(A B C D);

/// The bus as an `I2c` with seven-bit addresses.
#[derive(Clone, Copy, Debug)]
pub struct I2cEnd<T>(T);

impl<T: OnI2c> I2cEnd<T> {
    /// The bus of a part in its cell, or of a tuple of them.
    ///
    /// # Errors
    /// [`WiringError`] if no node steps one of them.
    pub fn new(parts: T) -> Result<Self, WiringError> {
        parts.check()?;
        Ok(Self(parts))
    }
}

impl<T> ErrorType for I2cEnd<T> {
    type Error = Fault;
}

impl<T: OnI2c> I2c for I2cEnd<T> {
    fn transaction(&mut self, address: u8, operations: &mut [Operation<'_>]) -> Result<(), Fault> {
        if self.0.transact(address, operations)? { Ok(()) } else { Err(Fault::Address(address)) }
    }
}
