//! Identity of a case: a hash of everything that its row depends on.
//!
//! `texts => 128 bits`. FNV-1a 128 (Fowler, Noll & Vo), each text followed by its length, so that different lists of
//! texts differ.

use std::fmt;

/// The hash of a list of texts.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct Digest(u128);

const OFFSET: u128 = 0x6c62_272e_07bb_0142_62b8_2175_6295_c58d;
const PRIME: u128 = 0x0000_0000_0100_0000_0000_0000_0000_013b;

impl Digest {
    /// Of no texts.
    #[must_use]
    pub fn new() -> Self {
        Self(OFFSET)
    }

    /// With one more text.
    #[must_use]
    pub fn with(self, text: &str) -> Self {
        self.bytes(text.as_bytes()).bytes(&(text.len() as u64).to_le_bytes())
    }

    fn bytes(self, bytes: &[u8]) -> Self {
        let byte = |hash: u128, byte: &u8| (hash ^ u128::from(*byte)).wrapping_mul(PRIME);
        Self(bytes.iter().fold(self.0, byte))
    }

    /// Its bits.
    #[must_use]
    pub fn bits(self) -> u128 {
        self.0
    }
}

impl Default for Digest {
    fn default() -> Self {
        Self::new()
    }
}

/// The key of a case.
#[derive(Clone, Copy, Debug, PartialEq, Eq, PartialOrd, Ord, Hash)]
pub struct Key(pub u128);

impl fmt::Display for Key {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        write!(f, "{:032x}", self.0)
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn the_hash_is_fnv_1a_of_128_bits_and_lists_of_texts_differ() {
        // Of the authors' test vectors.
        assert_eq!(Digest::new().bytes(b"").bits(), OFFSET);
        assert_eq!(
            Digest::new().bytes(b"foobar").bits(),
            0x343e_1662_793c_64bf_6f0d_3597_ba44_6f18
        );
        assert_ne!(Digest::new().with("ab").with("c"), Digest::new().with("a").with("bc"));
        assert_ne!(Digest::new().with(""), Digest::new());
        assert_eq!(Key(1).to_string().len(), 32);
    }
}
