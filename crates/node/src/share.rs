//! Sharing of a part between a driver port and a node: by a cell, or by a cell behind a critical section if one of them
//! is in an interrupt.
//!
//! `(cell, function) => result, or busy`. Does not allocate, wait or panic.

use core::cell::RefCell;

use crate::fault::Fault;

/// A shared cell of a part.
pub trait Shared {
    /// The contents.
    type Part;

    /// Calls a function with the part.
    ///
    /// # Errors
    /// [`Fault::Busy`] if it is in use or empty.
    fn with<A>(&self, action: impl FnOnce(&mut Self::Part) -> A) -> Result<A, Fault>;
}

impl<T: Shared + ?Sized> Shared for &T {
    type Part = T::Part;

    #[inline]
    fn with<A>(&self, action: impl FnOnce(&mut Self::Part) -> A) -> Result<A, Fault> {
        T::with(self, action)
    }
}

impl<T> Shared for RefCell<T> {
    type Part = T;

    #[inline]
    fn with<A>(&self, action: impl FnOnce(&mut T) -> A) -> Result<A, Fault> {
        match self.try_borrow_mut() {
            Ok(mut part) => Ok(action(&mut part)),
            Err(_) => Err(Fault::Busy),
        }
    }
}

#[cfg(feature = "critical-section")]
impl<T> Shared for critical_section::Mutex<RefCell<T>> {
    type Part = T;

    #[inline]
    fn with<A>(&self, action: impl FnOnce(&mut T) -> A) -> Result<A, Fault> {
        critical_section::with(|section| self.borrow(section).with(action))
    }
}

/// A slot in a `static` that a program fills at the start: for parts and nodes that an interrupt also uses.
#[cfg(feature = "critical-section")]
#[derive(Debug)]
pub struct Slot<T>(critical_section::Mutex<RefCell<Option<T>>>);

#[cfg(feature = "critical-section")]
impl<T> Slot<T> {
    /// An empty slot.
    #[must_use]
    pub const fn new() -> Self {
        Self(critical_section::Mutex::new(RefCell::new(None)))
    }

    /// Replaces the contents and returns the previous ones.
    ///
    /// # Errors
    /// [`Fault::Busy`] if it is in use; `part` is dropped then.
    pub fn put(&self, part: T) -> Result<Option<T>, Fault> {
        critical_section::with(|section| self.0.borrow(section).with(|slot| slot.replace(part)))
    }
}

#[cfg(feature = "critical-section")]
impl<T> Default for Slot<T> {
    fn default() -> Self {
        Self::new()
    }
}

#[cfg(feature = "critical-section")]
impl<T> Shared for Slot<T> {
    type Part = T;

    #[inline]
    fn with<A>(&self, action: impl FnOnce(&mut T) -> A) -> Result<A, Fault> {
        critical_section::with(|section| {
            self.0.borrow(section).with(|slot| slot.as_mut().map(action))
        })?
        .ok_or(Fault::Busy)
    }
}
