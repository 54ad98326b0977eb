//! The dimension of a value, as powers of metre, kilogram, second, radian and ampere.
//!
//! `powers => the SI unit as messages show it`: `N·m/rad`. An angle counts as a dimension, so that stiffness along a
//! line and about an axis, or Hz and rad/s, are not confused.

use std::fmt;

/// Powers of the base units; all 0 for a plain number.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub struct Dimension {
    metre: i8,
    kilogram: i8,
    second: i8,
    radian: i8,
    ampere: i8,
}

/// Largest exponent.
const MAX: i8 = 24;

/// Dimensions with a unit name.
const NAMES: &[(Dimension, &str)] = &[
    (Dimension::new(1, 1, -2, 0), "N"),
    (Dimension::new(0, 1, -2, 0), "N/m"),
    (Dimension::new(0, 1, -1, 0), "N·s/m"),
    (Dimension::new(2, 1, -2, 0), "N·m"),
    (Dimension::new(2, 1, -2, -1), "N·m/rad"),
    (Dimension::new(2, 1, -1, -1), "N·m·s/rad"),
    (Dimension::new(2, 1, -3, 0), "W"),
    (Dimension::new(-1, 1, -2, 0), "Pa"),
    (Dimension::new(2, 1, -3, 0).per_ampere(1), "V"),
    (Dimension::new(2, 1, -3, 0).per_ampere(2), "ohm"),
    (Dimension::new(2, 1, -2, 0).per_ampere(2), "H"),
    (Dimension::new(2, 1, -2, 0).per_ampere(1), "N·m/A"),
];

impl Dimension {
    /// Powers of metre, kilogram, second, radian.
    pub(crate) const fn new(metre: i8, kilogram: i8, second: i8, radian: i8) -> Self {
        Self { metre, kilogram, second, radian, ampere: 0 }
    }

    /// Divides by a power of the ampere.
    pub(crate) const fn per_ampere(self, power: i8) -> Self {
        Self { ampere: self.ampere - power, ..self }
    }

    /// Whether it is dimensionless.
    #[must_use]
    pub fn is_none(self) -> bool {
        self == Self::default()
    }

    /// The product with a power of another; `None` where an exponent is too large.
    pub(super) fn times(self, other: Self, power: i8) -> Option<Self> {
        let sum = |a: i8, b: i8| {
            a.checked_add(b.checked_mul(power)?).filter(|sum| (-MAX..=MAX).contains(sum))
        };
        Some(Self {
            metre: sum(self.metre, other.metre)?,
            kilogram: sum(self.kilogram, other.kilogram)?,
            second: sum(self.second, other.second)?,
            radian: sum(self.radian, other.radian)?,
            ampere: sum(self.ampere, other.ampere)?,
        })
    }

    /// The square root; `None` where an exponent is odd.
    pub(super) fn root(self) -> Option<Self> {
        let Self { metre, kilogram, second, radian, ampere } = self;
        let is_even = [metre, kilogram, second, radian, ampere].iter().all(|power| power % 2 == 0);
        let half = || Self::new(metre / 2, kilogram / 2, second / 2, radian / 2);
        is_even.then(|| half().per_ampere(-ampere / 2))
    }

    /// How many powers of an angle another has more, where they differ in nothing else.
    pub(crate) fn angles_to(self, other: Self) -> Option<i8> {
        let same = Self { radian: other.radian, ..self } == other;
        (same && self != other).then(|| other.radian - self.radian)
    }
}

impl fmt::Display for Dimension {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        if let Some((_, name)) = NAMES.iter().find(|(dimension, _)| dimension == self) {
            return f.write_str(name);
        }
        let bases = [
            ("kg", self.kilogram),
            ("m", self.metre),
            ("s", self.second),
            ("A", self.ampere),
            ("rad", self.radian),
        ];
        let powers = |sign: i8| {
            let of_sign = bases.iter().filter(|(_, power)| power.signum() == sign);
            let shown = of_sign.map(|(base, power)| format!("{base}{}", raised(power.abs())));
            shown.collect::<Vec<_>>()
        };
        let (above, below) = (powers(1), powers(-1));
        match (above.is_empty(), &below[..]) {
            (_, []) => f.write_str(&above.join("·")),
            (true, [one]) => write!(f, "1/{one}"),
            (true, many) => write!(f, "1/({})", many.join("·")),
            (false, [one]) => write!(f, "{}/{one}", above.join("·")),
            (false, many) => write!(f, "{}/({})", above.join("·"), many.join("·")),
        }
    }
}

/// An exponent > 0 in superscript digits.
fn raised(power: i8) -> String {
    if power == 1 {
        return String::new();
    }
    let raised = ['⁰', '¹', '²', '³', '⁴', '⁵', '⁶', '⁷', '⁸', '⁹'];
    let digits = power.to_string();
    digits.bytes().map(|digit| raised[usize::from(digit - b'0') % 10]).collect()
}
