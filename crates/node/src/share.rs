//! How a driver's end and a node reach the same part: by a cell, or by a cell behind a critical
//! section where an interrupt is one of the two.
//!
//! `(cell, what to do) => done, or busy`. Nothing is allocated, nothing waits, nothing panics.

use core::cell::RefCell;

use crate::fault::Fault;

/// A place where a part lies, reached from several others.
pub trait Shared {
    /// What lies there.
    type Part;

    /// Does something with the part.
    ///
    /// # Errors
    /// [`Fault::Busy`] where somebody else is at it, or nothing lies there yet.
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

/// A place in a `static` that a program fills when it starts: for parts and nodes that an interrupt
/// reaches, too.
#[cfg(feature = "critical-section")]
#[derive(Debug)]
pub struct Slot<T>(critical_section::Mutex<RefCell<Option<T>>>);

#[cfg(feature = "critical-section")]
impl<T> Slot<T> {
    /// An empty one.
    #[must_use]
    pub const fn new() -> Self {
        Self(critical_section::Mutex::new(RefCell::new(None)))
    }

    /// Puts something there and gives back what was there.
    ///
    /// # Errors
    /// [`Fault::Busy`] where somebody is at it; `part` is dropped then.
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
