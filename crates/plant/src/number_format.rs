//! How many digits a precision's numbers have: the shortest text that reads back to its bits.
//!
//! `precision => for each quantity of a body: single or double`. A quantity stored as plain f32
//! words is written as f32, anything else as the f64 it is exactly widened to.

use std::io::{self, Write};

use dbd_kernel::words::{Word, WordVisitor, Words};
use dbd_kernel::{Geometry, Real};

use crate::names::{Named as _, OrientationName, PrecisionName};

/// Which number a text must read back to.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Digits {
    /// An f32.
    Single,
    /// An f64.
    Double,
}

/// The digits of a body's quantities.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct NumberFormat {
    /// Of a position.
    pub position: Digits,
    /// Of an orientation.
    pub orientation: Digits,
    /// Of a velocity, linear or angular.
    pub velocity: Digits,
    /// Of a read-out, which is computed in the precision's forces.
    pub reading: Digits,
}

impl NumberFormat {
    /// The numerals of a precision.
    #[must_use]
    pub fn of<P: Geometry>() -> Self {
        Self {
            position: digits(&P::Position::default(), 3),
            orientation: digits(&P::Orientation::default(), 4),
            velocity: digits(&P::Velocity::default(), 3),
            reading: match P::Real::ZERO.word() {
                Word::F32(_) => Digits::Single,
                _ => Digits::Double,
            },
        }
    }
}

/// `Single` where the quantity is stored as f32 words, one per component.
fn digits(stored: &impl Words, components: usize) -> Digits {
    struct Singles {
        singles: usize,
        others: usize,
    }
    impl WordVisitor for Singles {
        fn word(&mut self, word: Word) {
            match word {
                Word::F32(_) => self.singles += 1,
                _ => self.others += 1,
            }
        }
    }
    let mut count = Singles { singles: 0, others: 0 };
    stored.visit(&mut count);
    let plain = count.singles == components && count.others == 0;
    if plain { Digits::Single } else { Digits::Double }
}

impl Digits {
    /// Writes the shortest text that reads back to the same bits, as `{:?}` has it.
    ///
    /// # Errors
    /// If the writer fails.
    pub fn write(self, value: f64, to: &mut impl Write) -> io::Result<()> {
        let mut buffer = zmij::Buffer::new();
        let text = match self {
            Digits::Single if is_spelled_alike(value, SINGLE) => buffer.format_finite(value as f32),
            Digits::Double if is_spelled_alike(value, DOUBLE) => buffer.format_finite(value),
            _ if value.to_bits() == 0 => "0.0",
            Digits::Single => return write!(to, "{:?}", value as f32),
            Digits::Double => return write!(to, "{value:?}"),
        };
        to.write_all(text.as_bytes())
    }

    /// Reads back the output of [`Self::write`], widened exactly; `None` for any other text, even if it is a number.
    #[must_use]
    pub fn read(self, text: &str) -> Option<f64> {
        match text {
            "NaN" => return Some(f64::NAN),
            "inf" => return Some(f64::INFINITY),
            "-inf" => return Some(f64::NEG_INFINITY),
            _ => {}
        }
        let plain = text.bytes().all(|byte| matches!(byte, b'0'..=b'9' | b'.' | b'e' | b'-'));
        let number = match self {
            _ if !plain => None,
            Digits::Single => text.parse::<f32>().ok().map(f64::from),
            Digits::Double => text.parse().ok(),
        };
        number.filter(|number: &f64| number.is_finite())
    }
}

/// Of two shortest texts that are equally near `{:?}` has the one farther from 0, zmij the even one.
/// The number then is a multiple of 2⁻ⁿ: with p digits at most in the shortest text it has p + 1 at
/// most itself, and 5ⁿ < 10ᵖ⁺¹. 2ⁿ of f32 (p = 9) and f64 (p = 17).
const SINGLE: f64 = (1 << 14) as f64;
const DOUBLE: f64 = (1 << 25) as f64;

/// Whether zmij, which takes a quarter of the time, surely spells a number as `{:?}` does: it turns to
/// exponents elsewhere, and see [`SINGLE`].
fn is_spelled_alike(value: f64, denominator: f64) -> bool {
    let magnitude = value.abs();
    let scaled = magnitude * denominator;
    ((1e-4..1e13).contains(&magnitude) || (1e-300..1e-7).contains(&magnitude))
        && scaled != scaled.trunc()
}

impl NumberFormat {
    /// The numerals of a precision and an orientation representation, by their names; `None` if the precision is
    /// unknown.
    #[must_use]
    pub fn of_names(precision: &str, orientation: &str) -> Option<Self> {
        let precision = PrecisionName::of_name(precision)?;
        let reading = match precision {
            PrecisionName::F64 => Digits::Double,
            _ => Digits::Single,
        };
        // Fixed point and two words of single precision hold more than one has digits for.
        let number = match precision {
            PrecisionName::F32 | PrecisionName::F32Micromath => Digits::Single,
            _ => Digits::Double,
        };
        // Angles are stored otherwise than they are shown.
        let quaternion = orientation == OrientationName::Quaternion.name();
        let orientation = if quaternion { number } else { Digits::Double };
        Some(Self { position: number, orientation, velocity: number, reading })
    }
}

#[cfg(test)]
mod tests {
    use dbd_kernel::{F32, F64};

    use super::*;

    fn text(digits: Digits, value: f64) -> String {
        let mut text = Vec::new();
        digits.write(value, &mut text).unwrap();
        String::from_utf8(text).unwrap()
    }

    #[test]
    fn single_words_have_single_digits() {
        assert_eq!(NumberFormat::of::<F32>().position, Digits::Single);
        assert_eq!(NumberFormat::of::<F32>().velocity, Digits::Single);
        assert_eq!(NumberFormat::of::<F64>().orientation, Digits::Double);
    }

    #[test]
    fn numerals_are_known_by_their_names() {
        let known = |precision, orientation| NumberFormat::of_names(precision, orientation);
        assert_eq!(known("f32", "quaternion"), Some(NumberFormat::of::<F32>()));
        assert_eq!(known("f64", "quaternion"), Some(NumberFormat::of::<F64>()));
        assert_eq!(
            known("f32", "euler-321"),
            Some(NumberFormat::of::<dbd_kernel::euler::EulerF32>())
        );
        let fixed = NumberFormat::of::<dbd_kernel::Fixed>();
        assert_eq!(known("fixed", "quaternion"), Some(fixed));
        assert_eq!(fixed.reading, Digits::Single);
        assert_eq!(known("f16", "quaternion"), None);
    }

    #[test]
    fn nothing_is_read_but_what_is_written() {
        for wrong in [
            "", "-", "nan", "infinity", "+1.0", "1,5", "0x1", "1E5", " 1.0", "1.0d", "1e999",
            "1..0",
        ] {
            for digits in [Digits::Single, Digits::Double] {
                assert_eq!(digits.read(wrong), None, "{wrong}");
            }
        }
        assert_eq!(Digits::Single.read("1e39"), None);
        assert!(Digits::Double.read("NaN").is_some_and(f64::is_nan));
    }

    /// Numbers of all magnitudes, with few digits and few bits, for which two texts may be equally near.
    #[test]
    fn texts_are_those_of_the_standard_library() {
        let mut state = 0x9e37_79b9_7f4a_7c15_u64;
        let mut random = || {
            state ^= state << 13;
            state ^= state >> 7;
            state ^= state << 17;
            state
        };
        let check = |value: f64| {
            if value.is_finite() {
                assert_eq!(text(Digits::Double, value), format!("{value:?}"));
            }
            let single = value as f32;
            if single.is_finite() {
                assert_eq!(text(Digits::Single, single.into()), format!("{single:?}"));
            }
        };
        for _ in 0..100_000 {
            let bits = random();
            check(f64::from_bits(bits));
            check(f32::from_bits(bits as u32).into());
            let digits = (bits >> 44) as f64;
            let exponent = (bits & 63) as i32 - 40;
            check(digits * 10_f64.powi(exponent));
            check(digits * 2_f64.powi(exponent));
            check(-((bits >> 11) as f64) * 2_f64.powi(exponent - 50));
        }
        for value in [0.0, -0.0, 1048591.25, -0.059_570_312_5, 1e-5, 1e-6, 1e16, 5e-324, f64::NAN] {
            check(value);
        }
    }

    #[test]
    fn texts_are_short_and_exact() {
        assert_eq!(text(Digits::Single, f64::from(0.1_f32)), "0.1");
        assert_eq!(text(Digits::Double, f64::from(0.1_f32)), "0.10000000149011612");
        assert_eq!(text(Digits::Double, -0.0), "-0.0");
        for value in [1.0 / 3.0, f64::MIN_POSITIVE, 5e-324, f64::MAX, 2e-5] {
            let read = Digits::Double.read(&text(Digits::Double, value)).unwrap();
            assert_eq!(read.to_bits(), value.to_bits());
            let single = value as f32;
            if single.is_finite() {
                let read = Digits::Single.read(&text(Digits::Single, f64::from(single))).unwrap();
                assert_eq!((read as f32).to_bits(), single.to_bits());
            }
        }
    }
}
