//! How wrong the kernel's arctangent is, over dense sweeps of every sector.
//!
//! `(sector, inputs) => the largest error, rad and units in the last place of the angle`. In single
//! precision against libm's in double precision, in double precision against 192 binary digits.

use core::f64::consts::{FRAC_PI_4, FRAC_PI_8};

use astro_float_num::{BigFloat, Consts, RoundingMode};
use dbd_kernel::arctangent::atan2;

use crate::square_root::scrambled;

/// Binary digits of the truth, of which the last ones round.
const DIGITS: usize = 192;

/// The largest errors of a sweep.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub struct Worst {
    /// \[rad\] the error.
    pub angle: f64,
    /// In units in the last place of the angle.
    pub places: f64,
}

impl Worst {
    /// The larger of both.
    #[must_use]
    pub fn or(self, other: Self) -> Self {
        Self { angle: self.angle.max(other.angle), places: self.places.max(other.places) }
    }
}

/// A part of the plane that the formula treats alike.
#[derive(Clone, Copy, Debug)]
pub struct Sector {
    /// Its angles.
    pub name: &'static str,
    /// Whether y/x, or else x/y, is the quotient t ≤ 1.
    steep: bool,
    /// Whether x is below 0.
    left: bool,
    /// The quotients, as angles of them \[rad\].
    quotients: [f64; 2],
}

/// All that the formula tells apart; below the x axis is the mirror of above.
pub const SECTORS: [Sector; 6] = [
    Sector { name: "0…π/8", steep: false, left: false, quotients: [0.0, FRAC_PI_8] },
    Sector { name: "π/8…π/4", steep: false, left: false, quotients: [FRAC_PI_8, FRAC_PI_4] },
    Sector { name: "π/4…3π/8", steep: true, left: false, quotients: [FRAC_PI_8, FRAC_PI_4] },
    Sector { name: "3π/8…π/2", steep: true, left: false, quotients: [0.0, FRAC_PI_8] },
    Sector { name: "π/2…3π/4", steep: true, left: true, quotients: [0.0, FRAC_PI_4] },
    Sector { name: "3π/4…π", steep: false, left: true, quotients: [0.0, FRAC_PI_4] },
];

impl Sector {
    /// The quotients at its ends.
    fn ends(&self) -> [f64; 2] {
        self.quotients.map(|angle| if angle == 0.0 { 0.0 } else { libm::tan(angle) })
    }

    /// y and x of a quotient, of these signs.
    fn point<R: core::ops::Neg<Output = R>>(&self, t: R, one: R) -> [R; 2] {
        let [y, x] = if self.steep { [one, t] } else { [t, one] };
        [y, if self.left { -x } else { x }]
    }

    /// The first and the last number in single precision that is a quotient of it, as bits. Below
    /// 2⁻¹³ the polynomial rounds to 1, so the arctangent is the quotient.
    fn bits_f32(&self) -> [u32; 2] {
        self.ends().map(|t| (t as f32).max(f32::EPSILON * 1_024.0).to_bits())
    }

    /// How many numbers those are.
    pub fn count_f32(&self) -> u64 {
        let [first, last] = self.bits_f32();
        u64::from(last - first) + 1
    }

    /// Every quotient of a stride in single precision, at the distance 1.
    #[must_use]
    pub fn every_f32(&self, offset: u32, stride: u32) -> Worst {
        let [first, last] = self.bits_f32();
        let quotients = (first..=last).skip(offset as usize).step_by(stride as usize);
        quotients
            .map(|bits| self.error_f32(f32::from_bits(bits), 1.0))
            .fold(Worst::default(), Worst::or)
    }

    /// So many points in single precision, evenly over the quotients, at random distances.
    #[cfg(test)]
    pub fn even_f32(&self, count: u64) -> Worst {
        let points = self
            .even(count)
            .map(|(t, distance)| self.error_f32((t * distance) as f32, distance as f32));
        points.fold(Worst::default(), Worst::or)
    }

    /// The same in double precision.
    #[must_use]
    pub fn even_f64(&self, from: u64, to: u64, count: u64) -> Worst {
        let mut constants = Consts::new().expect("there is memory");
        let points = self.even(count).skip(from as usize).take((to - from) as usize);
        let errors =
            points.map(|(t, distance)| self.error_f64(t * distance, distance, &mut constants));
        errors.fold(Worst::default(), Worst::or)
    }

    /// Quotients, half of them even and half of them over twelve decades, with distances.
    fn even(&self, count: u64) -> impl Iterator<Item = (f64, f64)> {
        let [first, last] = self.ends();
        (0..count).map(move |i| {
            let random = scrambled(i);
            let share = (i as f64 + 0.5) / count as f64;
            let share = if first == 0.0 && i % 2 == 0 { libm::exp10(-12.0 * share) } else { share };
            let distance = f64::from_bits(random >> 12 | 1 << 62) / 2.0;
            (first + (last - first) * share, distance)
        })
    }

    fn error_f32(&self, small: f32, large: f32) -> Worst {
        let [y, x] = self.point(small, large);
        let reference_solution = libm::atan2(y.into(), x.into());
        let error = (f64::from(atan2(y, x)) - reference_solution).abs();
        let nearest = (reference_solution as f32).abs();
        Worst { angle: error, places: error / f64::from(nearest.next_up() - nearest) }
    }

    fn error_f64(&self, small: f64, large: f64, constants: &mut Consts) -> Worst {
        let [y, x] = self.point(small, large);
        let angle = atan2(y, x);
        let digits = |value: f64| BigFloat::from_f64(value, DIGITS);
        let rounding = RoundingMode::None;
        // The angle of the quotient, and where the sector puts it.
        let quotient = digits(small).div(&digits(large), DIGITS, rounding);
        let mut reference_solution = quotient.atan(DIGITS, rounding, constants);
        let pi = constants.pi(DIGITS, rounding);
        if self.steep {
            reference_solution =
                pi.div(&digits(2.0), DIGITS, rounding).sub(&reference_solution, DIGITS, rounding);
        }
        if self.left {
            reference_solution = pi.sub(&reference_solution, DIGITS, rounding);
        }
        let error = nearest(&digits(angle).sub(&reference_solution, DIGITS, rounding)).abs();
        Worst { angle: error, places: error / (angle.next_up() - angle) }
    }
}

/// A number of many digits, to within a unit in the last place of double precision.
fn nearest(number: &BigFloat) -> f64 {
    let (Some((words, ..)), Some(exponent)) = (number.as_raw_parts(), number.exponent()) else {
        return f64::NAN;
    };
    // The most significant word is the last, its first digit is a half.
    let bits = f64::from(u64::BITS);
    libm::ldexp(words.last().map_or(0.0, |word| *word as f64 / libm::exp2(bits)), exponent)
}

#[cfg(test)]
mod tests {
    use super::*;

    /// What the module's head states, in units of π's last place.
    const BOUND: f64 = 2.0;

    #[test]
    fn errors_are_within_the_stated_bound() {
        let mut most = [0.0_f64; 2];
        for sector in SECTORS {
            let single = sector.every_f32(0, 20_011).or(sector.even_f32(50_000));
            let double = sector.even_f64(0, 4_000, 4_000);
            most = [most[0].max(single.angle), most[1].max(double.angle)];
            assert!(
                single.places < 4.0 && double.places < 4.0,
                "{sector:?}: {single:?} {double:?}"
            );
        }
        assert!(most[0] < BOUND * f64::from(f32::EPSILON) * 2.0, "{most:?}");
        assert!(most[1] < BOUND * f64::EPSILON * 2.0, "{most:?}");
    }

    #[test]
    fn the_truth_has_more_digits_than_double_precision() {
        // π/4 − atan(1) is 0 but for its own rounding, and ⅓ differs from its nearest number by this.
        let mut constants = Consts::new().unwrap();
        let rounding = RoundingMode::None;
        let third =
            BigFloat::from_f64(1.0, DIGITS).div(&BigFloat::from_f64(3.0, DIGITS), DIGITS, rounding);
        let rest = nearest(&third.sub(&BigFloat::from_f64(1.0 / 3.0, DIGITS), DIGITS, rounding));
        assert_eq!(rest, libm::exp2(-54.0) / 3.0);
        let quarter = BigFloat::from_f64(1.0, DIGITS).atan(DIGITS, rounding, &mut constants);
        let four = BigFloat::from_f64(4.0, DIGITS);
        let quarter = constants
            .pi(DIGITS, rounding)
            .div(&four, DIGITS, rounding)
            .sub(&quarter, DIGITS, rounding);
        assert!(nearest(&quarter).abs() < 1e-50);
        // A known error is seen: the arctangent of a neighbour.
        let sector = SECTORS[1];
        let exact = sector.error_f64(0.75, 1.0, &mut constants).angle;
        assert!(exact < 1e-15 && exact > 0.0, "{exact:e}");
    }
}
