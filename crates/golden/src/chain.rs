//! The hash chain: each line's hash includes those of all previous lines.
//!
//! `lines => FNV-1a 64 so far`. A line that is edited, lost or moved is detected at its position or at the next line. A
//! line break counts as one byte, however an editor or a checkout writes it.

use core::fmt::{self, Write};

/// The chain up to some line.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(crate) struct Chain(pub(crate) u64);

impl Chain {
    pub(crate) const fn new() -> Self {
        Self(0xcbf2_9ce4_8422_2325)
    }

    pub(crate) fn add(&mut self, text: &str) {
        for byte in text.bytes() {
            self.0 = (self.0 ^ u64::from(byte)).wrapping_mul(0x0000_0100_0000_01b3);
        }
    }
}

/// Writes to a sink and adds the text to the chain.
pub(crate) struct Chained<'w, W> {
    pub(crate) to: &'w mut W,
    pub(crate) chain: &'w mut Chain,
}

impl<W: Write> Write for Chained<'_, W> {
    fn write_str(&mut self, text: &str) -> fmt::Result {
        self.chain.add(text);
        self.to.write_str(text)
    }
}
