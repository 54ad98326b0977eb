//! Numbers as text that a page unpacks at once.
//!
//! `words => base64 of their little-endian bytes`. A word may be infinite or not a number, which
//! numbers of JSON cannot.

use base64::Engine as _;
use base64::engine::general_purpose::STANDARD;
use serde::{Serialize, Serializer};

/// Numbers in double precision.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct F64s(pub Vec<f64>);

/// Numbers in single precision.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct F32s(pub Vec<f32>);

/// Whole numbers of 16 bits.
#[derive(Clone, Debug, Default, PartialEq, Eq)]
pub struct I16s(pub Vec<i16>);

fn text<const BYTES: usize>(words: impl Iterator<Item = [u8; BYTES]>) -> String {
    STANDARD.encode(words.flatten().collect::<Vec<u8>>())
}

impl Serialize for F64s {
    fn serialize<S: Serializer>(&self, to: S) -> Result<S::Ok, S::Error> {
        to.serialize_str(&text(self.0.iter().map(|word| word.to_le_bytes())))
    }
}

impl Serialize for F32s {
    fn serialize<S: Serializer>(&self, to: S) -> Result<S::Ok, S::Error> {
        to.serialize_str(&text(self.0.iter().map(|word| word.to_le_bytes())))
    }
}

impl Serialize for I16s {
    fn serialize<S: Serializer>(&self, to: S) -> Result<S::Ok, S::Error> {
        to.serialize_str(&text(self.0.iter().map(|word| word.to_le_bytes())))
    }
}

impl F32s {
    /// Numbers rounded to single precision.
    #[must_use]
    pub fn rounded(values: impl IntoIterator<Item = f64>) -> Self {
        Self(values.into_iter().map(|value| value as f32).collect())
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    fn bytes(packed: &impl Serialize) -> Vec<u8> {
        let text: String = serde_json::from_value(serde_json::to_value(packed).unwrap()).unwrap();
        STANDARD.decode(text).unwrap()
    }

    #[test]
    fn words_read_back_to_their_bits() {
        let doubles = [0.0, -0.0, 1.0 / 3.0, f64::MAX, f64::NEG_INFINITY, f64::NAN];
        let back = bytes(&F64s(doubles.to_vec()));
        let back: Vec<_> =
            back.as_chunks().0.iter().map(|word| f64::from_le_bytes(*word)).collect();
        assert_eq!(back.iter().map(|v| v.to_bits()).collect::<Vec<_>>(), doubles.map(f64::to_bits));
        let singles = [1e-45_f32, -7.25, f32::INFINITY, f32::NAN];
        let back = bytes(&F32s(singles.to_vec()));
        let back: Vec<_> =
            back.as_chunks().0.iter().map(|word| f32::from_le_bytes(*word)).collect();
        assert_eq!(back.iter().map(|v| v.to_bits()).collect::<Vec<_>>(), singles.map(f32::to_bits));
        let whole = [i16::MIN, -1, 0, 258, i16::MAX];
        let back = bytes(&I16s(whole.to_vec()));
        let back: Vec<_> =
            back.as_chunks().0.iter().map(|word| i16::from_le_bytes(*word)).collect();
        assert_eq!(back, whole);
        assert!(bytes(&F32s::default()).is_empty());
    }
}
