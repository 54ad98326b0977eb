//! Units by name, with their conversion to SI.
//!
//! `name => scale and dimension`. A scale is stored exactly as `10^e · n/d · π^p`, so that a number with its units is
//! converted in one rounding: kN/mm is 10^6. Inch, foot, pound and pound-force are those of the international agreement
//! of 1959 with standard gravity.

use crate::quantity::dimension::Dimension;

/// The value of one unit in SI: `10^ten · over/under · π^pi`.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(super) struct Scale {
    pub(super) ten: i32,
    pub(super) over: u64,
    pub(super) under: u64,
    pub(super) pi: i8,
}

impl Scale {
    pub(super) const ONE: Self = Self { ten: 0, over: 1, under: 1, pi: 0 };

    /// The product with another, or the quotient; `None` where it cannot be represented exactly.
    pub(super) fn times(self, other: Self, divided: bool) -> Option<Self> {
        let (over, under, sign) = match divided {
            false => (other.over, other.under, 1),
            true => (other.under, other.over, -1),
        };
        let (over, under) = (self.over.checked_mul(over)?, self.under.checked_mul(under)?);
        let common = common_divisor(over, under);
        Some(Self {
            ten: self.ten.checked_add(other.ten.checked_mul(sign)?)?,
            over: over / common,
            under: under / common,
            pi: self.pi.checked_add(other.pi.checked_mul(sign as i8)?)?,
        })
    }

    /// The factor without the power of ten.
    pub(super) fn factor(self) -> f64 {
        let mut pi = 1.0;
        for _ in 0..self.pi.unsigned_abs() {
            pi *= core::f64::consts::PI;
        }
        match self.pi < 0 {
            false => pi * self.over as f64 / self.under as f64,
            true => self.over as f64 / self.under as f64 / pi,
        }
    }

    /// A number of it in SI.
    pub(super) fn of(self, number: f64) -> f64 {
        let tens = || (0..self.ten.unsigned_abs()).fold(1.0, |power, _| power * 10.0);
        let shifted = match self.ten {
            0 => number,
            1.. => number * tens(),
            _ => number / tens(),
        };
        if self.pi == 0 {
            shifted * self.over as f64 / self.under as f64
        } else {
            shifted * self.factor()
        }
    }
}

fn common_divisor(mut a: u64, mut b: u64) -> u64 {
    while b > 0 {
        (a, b) = (b, a % b);
    }
    a.max(1)
}

/// A unit.
#[derive(Clone, Copy, Debug)]
pub(super) struct Unit {
    pub(super) name: &'static str,
    pub(super) scale: Scale,
    pub(super) dimension: Dimension,
}

const LENGTH: Dimension = Dimension::new(1, 0, 0, 0);
const MASS: Dimension = Dimension::new(0, 1, 0, 0);
const TIME: Dimension = Dimension::new(0, 0, 1, 0);
const ANGLE: Dimension = Dimension::new(0, 0, 0, 1);
const RATE: Dimension = Dimension::new(0, 0, -1, 0);
const FORCE: Dimension = Dimension::new(1, 1, -2, 0);
const WORK: Dimension = Dimension::new(2, 1, -2, 0);
const POWER: Dimension = Dimension::new(2, 1, -3, 0);
const PRESSURE: Dimension = Dimension::new(-1, 1, -2, 0);
const CURRENT: Dimension = Dimension::new(0, 0, 0, 0).per_ampere(-1);
const VOLTAGE: Dimension = POWER.per_ampere(1);
const RESISTANCE: Dimension = POWER.per_ampere(2);
const INDUCTANCE: Dimension = WORK.per_ampere(2);

const fn decimal(name: &'static str, ten: i32, dimension: Dimension) -> Unit {
    other(name, ten, 1, 1, 0, dimension)
}

const fn other(
    name: &'static str,
    ten: i32,
    over: u64,
    under: u64,
    pi: i8,
    dimension: Dimension,
) -> Unit {
    Unit { name, scale: Scale { ten, over, under, pi }, dimension }
}

/// All units, the preferred spelling first; listed in `docs/scene-reference.md`.
pub(super) static UNITS: &[Unit] = &[
    decimal("m", 0, LENGTH),
    decimal("km", 3, LENGTH),
    decimal("dm", -1, LENGTH),
    decimal("cm", -2, LENGTH),
    decimal("mm", -3, LENGTH),
    decimal("um", -6, LENGTH),
    decimal("µm", -6, LENGTH),
    decimal("μm", -6, LENGTH),
    decimal("nm", -9, LENGTH),
    other("in", -4, 254, 1, 0, LENGTH),
    other("ft", -4, 3048, 1, 0, LENGTH),
    decimal("kg", 0, MASS),
    decimal("g", -3, MASS),
    decimal("mg", -6, MASS),
    decimal("t", 3, MASS),
    other("lb", -8, 45_359_237, 1, 0, MASS),
    decimal("s", 0, TIME),
    decimal("ms", -3, TIME),
    decimal("us", -6, TIME),
    decimal("µs", -6, TIME),
    decimal("μs", -6, TIME),
    decimal("ns", -9, TIME),
    other("min", 0, 60, 1, 0, TIME),
    other("h", 0, 3600, 1, 0, TIME),
    decimal("rad", 0, ANGLE),
    decimal("mrad", -3, ANGLE),
    other("deg", 0, 1, 180, 1, ANGLE),
    other("°", 0, 1, 180, 1, ANGLE),
    other("turn", 0, 2, 1, 1, ANGLE),
    other("rev", 0, 2, 1, 1, ANGLE),
    decimal("Hz", 0, RATE),
    decimal("kHz", 3, RATE),
    decimal("MHz", 6, RATE),
    other("rpm", 0, 1, 30, 1, Dimension::new(0, 0, -1, 1)),
    decimal("N", 0, FORCE),
    decimal("mN", -3, FORCE),
    decimal("kN", 3, FORCE),
    decimal("MN", 6, FORCE),
    other("lbf", -13, 44_482_216_152_605, 1, 0, FORCE),
    decimal("Nm", 0, WORK),
    decimal("mNm", -3, WORK),
    decimal("kNm", 3, WORK),
    decimal("J", 0, WORK),
    decimal("mJ", -3, WORK),
    decimal("kJ", 3, WORK),
    decimal("W", 0, POWER),
    decimal("mW", -3, POWER),
    decimal("kW", 3, POWER),
    decimal("Pa", 0, PRESSURE),
    decimal("kPa", 3, PRESSURE),
    decimal("MPa", 6, PRESSURE),
    decimal("GPa", 9, PRESSURE),
    decimal("bar", 5, PRESSURE),
    decimal("A", 0, CURRENT),
    decimal("mA", -3, CURRENT),
    decimal("V", 0, VOLTAGE),
    decimal("mV", -3, VOLTAGE),
    decimal("kV", 3, VOLTAGE),
    decimal("ohm", 0, RESISTANCE),
    decimal("mohm", -3, RESISTANCE),
    decimal("Ω", 0, RESISTANCE),
    decimal("mΩ", -3, RESISTANCE),
    decimal("H", 0, INDUCTANCE),
    decimal("mH", -3, INDUCTANCE),
    decimal("uH", -6, INDUCTANCE),
    decimal("µH", -6, INDUCTANCE),
];

/// Units of one capital letter, which parameters may hide: `H` is more often a height than a henry.
pub(super) const HIDDEN: [&str; 3] = ["A", "V", "H"];

/// The unit of a name.
pub(super) fn find(name: &str) -> Option<&'static Unit> {
    UNITS.iter().find(|unit| unit.name == name)
}
