//! Access to a block of 32-bit registers: mapped into memory, or imitated in a test.

/// A block of registers.
pub trait Registers {
    /// Reads the register at a byte offset.
    fn read(&self, offset: usize) -> u32;
    /// Writes the register at a byte offset.
    fn write(&mut self, offset: usize, value: u32);
}

/// Registers at an address of the board.
#[cfg(target_os = "none")]
#[derive(Debug)]
pub struct Mapped {
    base: usize,
}

#[cfg(target_os = "none")]
impl Mapped {
    /// Only [`super::Board`] makes these, from [`super::addresses`].
    pub(super) const fn at(base: usize) -> Self {
        Self { base }
    }
}

// The only access to the board's peripherals.
#[allow(unsafe_code)]
#[cfg(target_os = "none")]
impl Registers for Mapped {
    fn read(&self, offset: usize) -> u32 {
        // SAFETY: `base` is a peripheral of this board, whose registers are words in its 4 KB.
        unsafe { core::ptr::with_exposed_provenance::<u32>(self.base + offset).read_volatile() }
    }

    fn write(&mut self, offset: usize, value: u32) {
        let register = core::ptr::with_exposed_provenance_mut::<u32>(self.base + offset);
        // SAFETY: as for `read`; no register of these peripherals makes the hardware touch memory.
        unsafe { register.write_volatile(value) }
    }
}
