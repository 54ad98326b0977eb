//! The sum of two doubles, the second at most half a unit in the last place of the first.

use std::ops::{Add, Div, Mul, Neg, Sub};

/// A number with 32 digits.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(crate) struct Precise {
    /// The double nearest to it.
    high: f64,
    /// The remainder.
    low: f64,
}

impl Precise {
    pub(crate) const ZERO: Self = Self::new(0.0, 0.0);
    pub(crate) const ONE: Self = Self::new(1.0, 0.0);

    /// The sum of two doubles that do not overlap.
    pub(crate) const fn new(high: f64, low: f64) -> Self {
        Self { high, low }
    }

    /// The double nearest to it.
    pub(crate) fn nearest(self) -> f64 {
        self.high
    }

    /// The square root; 0 for numbers ≤ 0.
    pub(crate) fn root(self) -> Self {
        if self.high <= 0.0 {
            return Self::ZERO;
        }
        // One step of Newton from the root of the nearest double.
        let root = Self::from(libm::sqrt(self.high));
        root + (self - root * root) / (root + root)
    }
}

impl From<f64> for Precise {
    fn from(number: f64) -> Self {
        Self::new(number, 0.0)
    }
}

/// The rounded sum of two doubles and its rounding error (Knuth).
fn sum(a: f64, b: f64) -> (f64, f64) {
    let s = a + b;
    let b_of_s = s - a;
    (s, (a - (s - b_of_s)) + (b - b_of_s))
}

/// The same where |a| ≥ |b| or a = 0 (Dekker).
fn sum_of_ordered(a: f64, b: f64) -> Precise {
    let s = a + b;
    Precise::new(s, b - (s - a))
}

/// The upper and the lower half of a double's digits (Veltkamp).
fn halves(a: f64) -> (f64, f64) {
    const SPLIT: f64 = 134_217_729.0; // 2^27 + 1
    let scaled = SPLIT * a;
    let upper = scaled - (scaled - a);
    (upper, a - upper)
}

/// The rounded product of two doubles and its rounding error (Dekker).
fn product(a: f64, b: f64) -> (f64, f64) {
    let p = a * b;
    let ((a1, a2), (b1, b2)) = (halves(a), halves(b));
    (p, ((a1 * b1 - p) + a1 * b2 + a2 * b1) + a2 * b2)
}

impl Add for Precise {
    type Output = Self;
    fn add(self, other: Self) -> Self {
        let (high, rest) = sum(self.high, other.high);
        let (low, last) = sum(self.low, other.low);
        let first = sum_of_ordered(high, rest + low);
        sum_of_ordered(first.high, first.low + last)
    }
}

impl Neg for Precise {
    type Output = Self;
    fn neg(self) -> Self {
        Self::new(-self.high, -self.low)
    }
}

impl Sub for Precise {
    type Output = Self;
    fn sub(self, other: Self) -> Self {
        self + -other
    }
}

impl Mul for Precise {
    type Output = Self;
    fn mul(self, other: Self) -> Self {
        let (high, low) = product(self.high, other.high);
        sum_of_ordered(high, low + (self.high * other.low + self.low * other.high))
    }
}

impl Div for Precise {
    type Output = Self;
    /// Long division by doubles, three digits of 53 bits.
    fn div(self, other: Self) -> Self {
        let first = self.high / other.high;
        let rest = self - other * Self::from(first);
        let second = rest.high / other.high;
        let rest = rest - other * Self::from(second);
        let third = rest.high / other.high;
        let quotient = sum_of_ordered(first, second);
        quotient + Self::from(third)
    }
}
