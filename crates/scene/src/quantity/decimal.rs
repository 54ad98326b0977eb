//! Numbers in decimal text, until their unit is known.
//!
//! `(digits, exponent, scale) => f64`. A scale's power of ten and its whole factor are applied to the decimal text,
//! which is then read once: `20us` is the f64 nearest to 20e-6, the same as `0.02ms`
//! and `2e-5`; 20.0·1e-6 would differ. Only a divisor (km/h) or π (deg) rounds a second time.

use crate::quantity::unit::Scale;

/// A number ≥ 0 in decimal text.
#[derive(Clone, Copy, Debug)]
pub(super) struct Decimal<'t> {
    /// Digits with at most one point among them.
    digits: &'t str,
    exponent: i64,
}

/// Largest exponent that can matter for the length of any text.
const MAX: i64 = 1_000_000_000_000;

impl<'t> Decimal<'t> {
    /// The number of a unit without one.
    pub(super) const ONE: Decimal<'static> = Decimal { digits: "1", exponent: 0 };

    /// The number at the beginning of a text with its length; `None` without a number.
    pub(super) fn begins(text: &'t str) -> Option<(Self, usize)> {
        let count = |text: &str| text.bytes().take_while(u8::is_ascii_digit).count();
        let whole = count(text);
        let broken = text[whole..].strip_prefix('.').map(count);
        if whole + broken.unwrap_or(0) == 0 {
            return None;
        }
        let length = whole + broken.map_or(0, |digits| digits + 1);
        let digits = &text[..length];
        let rest = text[length..].strip_prefix(['e', 'E']).unwrap_or_default();
        let sign = usize::from(rest.starts_with(['+', '-']));
        let of_exponent = count(&rest[sign..]);
        if of_exponent == 0 {
            return Some((Self { digits, exponent: 0 }, length));
        }
        let size = rest[sign..sign + of_exponent].parse().unwrap_or(MAX).min(MAX);
        let exponent = if rest.starts_with('-') { -size } else { size };
        Some((Self { digits, exponent }, length + 1 + sign + of_exponent))
    }

    /// The number of units in SI; infinite on overflow.
    pub(super) fn of(self, scale: Scale) -> f64 {
        let exponent = self.exponent + i64::from(scale.ten);
        let read = |digits: &str, exponent: i64| {
            format!("{digits}e{exponent}").parse::<f64>().unwrap_or(f64::NAN)
        };
        if scale.pi != 0 {
            return read(self.digits, exponent) * scale.factor();
        }
        let number = match scale.over {
            1 => read(self.digits, exponent),
            over => {
                let places = self.digits.split_once('.').map_or(0, |(_, broken)| broken.len());
                read(&multiplied(self.digits, over), exponent - places as i64)
            }
        };
        number / scale.under as f64
    }
}

/// The product of digits, ignoring their decimal point, and a whole number.
fn multiplied(digits: &str, by: u64) -> String {
    let mut product: Vec<u8> = Vec::new();
    let mut carried: u128 = 0;
    for digit in digits.bytes().rev().filter(u8::is_ascii_digit) {
        carried += u128::from(digit - b'0') * u128::from(by);
        product.push(b'0' + (carried % 10) as u8);
        carried /= 10;
    }
    while carried > 0 {
        product.push(b'0' + (carried % 10) as u8);
        carried /= 10;
    }
    product.iter().rev().map(|digit| char::from(*digit)).collect()
}
