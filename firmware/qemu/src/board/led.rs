//! A user LED of the board's FPGA I/O, an embedded-hal output.

use core::convert::Infallible;

use embedded_hal::digital::{ErrorType, OutputPin, StatefulOutputPin};

use super::addresses::fpgaio::LED0;
use super::registers::Registers;

/// One LED; high is lit.
#[derive(Debug)]
pub struct Led<R> {
    registers: R,
    bit: u32,
}

impl<R: Registers> Led<R> {
    /// The LED of one bit of the LED register; the other bits stay as they are.
    pub fn new(registers: R, bit: u32) -> Self {
        Self { registers, bit }
    }
}

impl<R> ErrorType for Led<R> {
    type Error = Infallible;
}

impl<R: Registers> OutputPin for Led<R> {
    fn set_low(&mut self) -> Result<(), Infallible> {
        let lit = self.registers.read(LED0);
        self.registers.write(LED0, lit & !self.bit);
        Ok(())
    }

    fn set_high(&mut self) -> Result<(), Infallible> {
        let lit = self.registers.read(LED0);
        self.registers.write(LED0, lit | self.bit);
        Ok(())
    }
}

impl<R: Registers> StatefulOutputPin for Led<R> {
    fn is_set_high(&mut self) -> Result<bool, Infallible> {
        Ok(self.registers.read(LED0) & self.bit != 0)
    }

    fn is_set_low(&mut self) -> Result<bool, Infallible> {
        self.is_set_high().map(|high| !high)
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    struct Word(u32);

    impl Registers for Word {
        fn read(&self, offset: usize) -> u32 {
            assert_eq!(offset, LED0);
            self.0
        }

        fn write(&mut self, offset: usize, value: u32) {
            assert_eq!(offset, LED0);
            self.0 = value;
        }
    }

    #[test]
    fn a_led_leaves_its_neighbour_alone() {
        let mut led = Led::new(Word(0b01), 0b10);
        led.set_high().unwrap();
        assert_eq!((led.registers.0, led.is_set_high()), (0b11, Ok(true)));
        led.set_low().unwrap();
        assert_eq!((led.registers.0, led.is_set_low()), (0b01, Ok(true)));
    }
}
