//! Approximate single precision with the square root of `micromath`.
//!
//! It is an approximation by bit shifts with an error of up to several per cent: a spring with such an error of its
//! length exerts a spurious force. For comparison only, never a default; feature `micromath`.

use core::ops::{Add, Div, Mul, Neg, Sub};

use micromath::F32Ext;

use crate::geometry::Float;
use crate::lanes::{Named, one_abreast};
use crate::real::{Constant, Real, one_lane};
use crate::space::Space;
use crate::words::{Word, WordSource};

/// A single-precision number with an approximate square root.
#[derive(Clone, Copy, Debug, Default, PartialEq, PartialOrd)]
#[cfg_attr(all(feature = "defmt", target_os = "none"), derive(defmt::Format))]
#[repr(transparent)]
pub struct Approximate(pub f32);

/// Approximate arithmetic, orientations as quaternions.
pub type Approximate32 = Float<Approximate>;

macro_rules! operator {
    ($($operation:ident $function:ident $sign:tt;)*) => {
        $(impl $operation for Approximate {
            type Output = Self;
            #[inline(always)]
            fn $function(self, other: Self) -> Self {
                Self(self.0 $sign other.0)
            }
        })*
    };
}

operator! {
    Add add +;
    Sub sub -;
    Mul mul *;
    Div div /;
}

impl Neg for Approximate {
    type Output = Self;
    #[inline(always)]
    fn neg(self) -> Self {
        Self(-self.0)
    }
}

impl Named for Approximate {
    one_abreast!();
    type PassSum<S: Space> = <f32 as Named>::PassSum<S>;
    const NAME: &'static str = "f32-micromath";
}

/// The coefficients of single precision.
const fn approximate<const N: usize>(coefficients: &[f32]) -> [Approximate; N] {
    let mut all = [Approximate(0.0); N];
    let mut i = 0;
    while i < N {
        all[i] = Approximate(coefficients[i]);
        i += 1;
    }
    all
}

impl Real for Approximate {
    one_lane!();

    const ZERO: Self = Self(0.0);
    const ONE: Self = Self(1.0);
    const HALF: Self = Self(0.5);
    const TWO: Self = Self(2.0);
    const PI: Self = Self(<f32 as Real>::PI);
    const FRAC_PI_2: Self = Self(<f32 as Real>::FRAC_PI_2);
    const FRAC_PI_4: Self = Self(<f32 as Real>::FRAC_PI_4);
    const TAN_PI_8: Self = Self(<f32 as Real>::TAN_PI_8);
    const ATAN: &'static [Self] =
        &approximate::<{ <f32 as Real>::ATAN.len() }>(<f32 as Real>::ATAN);
    const COS: &'static [Self] = &approximate::<{ <f32 as Real>::COS.len() }>(<f32 as Real>::COS);
    const SINC: &'static [Self] =
        &approximate::<{ <f32 as Real>::SINC.len() }>(<f32 as Real>::SINC);

    #[inline(always)]
    fn from_f64(value: f64) -> Self {
        Self(value as f32)
    }
    #[inline(always)]
    fn constant(value: Constant) -> Self {
        Self(value.single)
    }
    #[inline(always)]
    fn to_f64(self) -> f64 {
        f64::from(self.0)
    }
    #[inline(always)]
    fn from_u64(value: u64) -> Self {
        Self(<f32 as Real>::from_u64(value))
    }
    #[inline(always)]
    fn from_i32(value: i32) -> Self {
        Self(value as f32)
    }
    #[inline(always)]
    fn sqrt(self) -> Self {
        Self(F32Ext::sqrt(self.0))
    }
    #[inline(always)]
    fn is_finite(self) -> bool {
        f32::is_finite(self.0)
    }
    #[inline(always)]
    fn word(self) -> Word {
        Word::F32(self.0)
    }
    fn from_words(source: &mut impl WordSource) -> Self {
        Self(<f32 as Real>::from_words(source))
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn square_roots_are_as_loose_as_said() {
        let mut worst = 0.0_f64;
        for i in 1..2000 {
            let x = f64::from(i) * 1e-3;
            let root = Approximate::from_f64(x).sqrt().to_f64() / libm::sqrt(x) - 1.0;
            worst = worst.max(root.abs());
        }
        assert!((1e-3..0.1).contains(&worst), "{worst}");
    }
}
