//! Numbers in a golden file: the shortest text that reads back to the same bits.
//!
//! `number => text => number`. A number of single precision is written and read as such, and stored as the double to
//! which it is widened exactly.

use core::fmt::{self, Write};

use dbd_kernel::words::Word;

/// Marks a double among singles.
const DOUBLE: char = 'd';

/// The precision of a number.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Digits {
    /// An f32.
    Single,
    /// An f64.
    Double,
}

impl Digits {
    /// Its name in a file.
    pub(crate) const fn name(self) -> &'static str {
        match self {
            Digits::Single => "f32",
            Digits::Double => "f64",
        }
    }

    pub(crate) fn of_name(name: &str) -> Option<Self> {
        [Digits::Single, Digits::Double].into_iter().find(|digits| digits.name() == name)
    }

    /// Writes a number. Among singles, a number without an exact single gets a mark.
    pub(crate) fn write(self, value: f64, to: &mut impl Write) -> fmt::Result {
        match self {
            Digits::Single if is_single(value) => write!(to, "{:?}", value as f32),
            Digits::Single => write!(to, "{value:?}{DOUBLE}"),
            Digits::Double => write!(to, "{value:?}"),
        }
    }

    /// Reads a number back.
    pub(crate) fn read(self, text: &str) -> Option<f64> {
        match (self, text.strip_suffix(DOUBLE)) {
            (Digits::Single, Some(double)) => double.parse().ok(),
            (Digits::Single, None) => text.parse().ok().map(f64::from as fn(f32) -> f64),
            (Digits::Double, _) => text.parse().ok(),
        }
    }

    /// Distance of two numbers in ULP; none for a NaN. Among singles, a number without an exact single is counted in
    /// doubles.
    #[must_use]
    pub fn ulps(self, a: f64, b: f64) -> Option<u64> {
        if a.is_nan() || b.is_nan() {
            return None;
        }
        let single = self == Digits::Single && is_single(a) && is_single(b);
        let place = |value: f64| {
            let (bits, sign) = match single {
                true => (i64::from((value as f32).to_bits()), 1_i64 << 31),
                false => (value.to_bits() as i64, i64::MIN),
            };
            // Negative numbers count downwards from zero.
            if bits & sign != 0 { i128::from(bits ^ sign).wrapping_neg() } else { bits.into() }
        };
        u64::try_from((place(a) - place(b)).unsigned_abs()).ok()
    }
}

/// Whether it is exact in single precision.
fn is_single(value: f64) -> bool {
    value.is_nan() || same(f64::from(value as f32), value)
}

/// Whether two numbers have the same bits; all NaNs are equal.
#[must_use]
pub fn same(a: f64, b: f64) -> bool {
    Word::F64(a).bits() == Word::F64(b).bits()
}

/// A hash as text: 16 hexadecimal digits in lower case.
pub(crate) fn read_hash(text: &str) -> Option<u64> {
    let digits = text.len() == 16 && text.bytes().all(|b| matches!(b, b'0'..=b'9' | b'a'..=b'f'));
    if digits { u64::from_str_radix(text, 16).ok() } else { None }
}

#[cfg(test)]
mod tests {
    use std::string::String;

    use super::*;

    fn text(digits: Digits, value: f64) -> String {
        let mut text = String::new();
        digits.write(value, &mut text).unwrap();
        text
    }

    #[test]
    fn texts_are_short_and_exact() {
        assert_eq!(text(Digits::Single, f64::from(0.1_f32)), "0.1");
        assert_eq!(text(Digits::Single, 0.1), "0.1d");
        assert_eq!(text(Digits::Double, f64::from(0.1_f32)), "0.10000000149011612");
        for digits in [Digits::Single, Digits::Double] {
            for value in
                [0.0, -0.0, 1.5, 2e-5, 1.0 / 3.0, 5e-324, f64::MAX, f64::INFINITY, f64::NAN]
            {
                for value in [value, -value, f64::from(value as f32)] {
                    let read = digits.read(&text(digits, value)).unwrap();
                    assert!(same(read, value), "{value:?} {read:?}");
                }
            }
            for wrong in ["", "x", "1.0f", "1,5", "0x1", "d", "1.0 "] {
                assert_eq!(digits.read(wrong), None, "{wrong}");
            }
        }
        assert_eq!(Digits::Double.read("1.0d"), None);
    }

    #[test]
    fn numbers_are_counted_between_two() {
        let next = f64::from(f32::from_bits(0.25_f32.to_bits() + 3));
        assert_eq!(Digits::Single.ulps(0.25, next), Some(3));
        assert_eq!(Digits::Double.ulps(0.25, next), Some(3 << 29));
        assert_eq!(Digits::Double.ulps(5e-324, -5e-324), Some(2));
        assert_eq!(Digits::Single.ulps(0.0, -0.0), Some(0));
        assert_eq!(Digits::Double.ulps(f64::MAX, f64::MIN), Some(2 * f64::MAX.to_bits()));
        assert_eq!(Digits::Single.ulps(f64::NAN, 0.0), None);
    }

    #[test]
    fn a_hash_has_sixteen_digits() {
        assert_eq!(read_hash("00000000000000ff"), Some(255));
        for wrong in ["ff", "+0000000000000ff", "", "00000000000000fg", "00000000000000FF"] {
            assert_eq!(read_hash(wrong), None);
        }
    }
}
