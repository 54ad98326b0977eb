//! A number of several lanes, which laws and schemes use as one number.
//!
//! `(lanes, lanes) => lanes`. Decisions in a step become selections, see [`Real`]. Operations without a lane, such as a
//! conversion to `f64`, use the first. Nothing is fused, so a lane has the bits of the scalar operation.

#[cfg(any(test, not(all(target_arch = "x86_64", target_feature = "sse2"))))]
mod array;
mod named;
mod register;
#[cfg(all(target_arch = "x86_64", target_feature = "sse2"))]
mod x86;

#[cfg(not(all(target_arch = "x86_64", target_feature = "sse2")))]
pub use array::{Doubles, Singles};
pub use named::{Named, one_abreast};
pub use register::{Register, Work};
#[cfg(all(target_arch = "x86_64", target_feature = "sse2"))]
pub use x86::{Doubles, Doubles256, Doubles512, Singles, Singles256, Singles512};

use core::cmp::Ordering;
use core::fmt::{Debug, Formatter};
use core::ops::{Add, Div, Mul, Neg, Sub};

use crate::pass_sum::Sum;
use crate::real::{Constant, Mask as _, Real};
use crate::space::Space;
use crate::words::{Word, WordSource};

/// One number per lane of a register.
#[derive(Clone, Copy)]
#[repr(transparent)]
pub struct Lanes<V>(V);

impl<V: Register> Lanes<V> {
    /// A number per lane.
    #[inline(always)]
    pub fn new(lanes: impl Fn(usize) -> V::Number) -> Self {
        Self(V::from_lanes(lanes))
    }

    /// The number in a lane.
    #[inline(always)]
    pub fn lane(self, lane: usize) -> V::Number {
        self.0.lane(lane)
    }

    /// Constants of a register as those of its lanes.
    #[allow(unsafe_code)]
    const fn of(registers: &'static [V]) -> &'static [Self] {
        // SAFETY: the type is transparent.
        unsafe { core::slice::from_raw_parts(registers.as_ptr().cast(), registers.len()) }
    }
}

impl<V: Register> Debug for Lanes<V> {
    fn fmt(&self, f: &mut Formatter<'_>) -> core::fmt::Result {
        f.debug_list().entries((0..V::LANES).map(|lane| self.lane(lane))).finish()
    }
}

impl<V: Register> Default for Lanes<V> {
    fn default() -> Self {
        Self::ZERO
    }
}

/// Equal in every lane.
impl<V: Register> PartialEq for Lanes<V> {
    #[inline(always)]
    fn eq(&self, other: &Self) -> bool {
        self.0.equals(other.0).all()
    }
}

/// Ordered if all lanes have the same order.
impl<V: Register> PartialOrd for Lanes<V> {
    #[inline(always)]
    fn partial_cmp(&self, other: &Self) -> Option<Ordering> {
        if self.0.less_than(other.0).all() {
            Some(Ordering::Less)
        } else if other.0.less_than(self.0).all() {
            Some(Ordering::Greater)
        } else if self == other {
            Some(Ordering::Equal)
        } else {
            None
        }
    }
}

macro_rules! operator {
    ($($operation:ident $function:ident;)*) => {
        $(impl<V: Register> $operation for Lanes<V> {
            type Output = Self;
            #[inline(always)]
            fn $function(self, other: Self) -> Self {
                Self(self.0.$function(other.0))
            }
        })*
    };
}

operator! {
    Add add;
    Sub sub;
    Mul mul;
    Div div;
}

impl<V: Register> Neg for Lanes<V> {
    type Output = Self;
    #[inline(always)]
    fn neg(self) -> Self {
        Self(self.0.neg())
    }
}

macro_rules! named {
    ($number:ty, $name:literal, $register:ty, $sum:ty) => {
        impl Named for $number {
            type Abreast = Lanes<$register>;
            type PassSum<S: Space> = $sum;
            const NAME: &'static str = $name;

            #[inline(always)]
            fn abreast(of: impl Fn(usize) -> Self) -> Self::Abreast {
                Lanes::new(of)
            }
            #[inline(always)]
            fn lane(of: Self::Abreast, lane: usize) -> Self {
                of.lane(lane)
            }
        }
    };
}

named!(f64, "f64", Doubles, ());
named!(f32, "f32", Singles, Sum<S>);

impl<V: Register> Named for Lanes<V> {
    one_abreast!();
    type PassSum<S: Space> = <V::Number as Named>::PassSum<S>;
    const NAME: &'static str = <V::Number as Named>::NAME;
}

impl<V: Register> Real for Lanes<V> {
    const LANES: usize = V::LANES;
    type Mask = V::Mask;
    type Count = V::Count;

    const ZERO: Self = Self(V::NUMBERS[0]);
    const ONE: Self = Self(V::NUMBERS[1]);
    const HALF: Self = Self(V::NUMBERS[2]);
    const TWO: Self = Self(V::NUMBERS[3]);
    const PI: Self = Self(V::NUMBERS[4]);
    const FRAC_PI_2: Self = Self(V::NUMBERS[5]);
    const FRAC_PI_4: Self = Self(V::NUMBERS[6]);
    const TAN_PI_8: Self = Self(V::NUMBERS[7]);
    const ATAN: &'static [Self] = Self::of(V::ATAN);
    const COS: &'static [Self] = Self::of(V::COS);
    const SINC: &'static [Self] = Self::of(V::SINC);

    #[inline(always)]
    fn from_f64(value: f64) -> Self {
        Self(V::splat(V::Number::from_f64(value)))
    }
    #[inline(always)]
    fn constant(value: Constant) -> Self {
        Self(V::splat(V::Number::constant(value)))
    }
    fn to_f64(self) -> f64 {
        self.lane(0).to_f64()
    }
    #[inline(always)]
    fn from_u64(value: u64) -> Self {
        Self(V::splat(V::Number::from_u64(value)))
    }
    #[inline(always)]
    fn from_i32(value: i32) -> Self {
        Self(V::splat(V::Number::from_i32(value)))
    }
    #[inline(always)]
    fn sqrt(self) -> Self {
        Self(self.0.sqrt())
    }
    #[inline(always)]
    fn is_finite(self) -> bool {
        self * Self::ZERO == Self::ZERO
    }
    fn word(self) -> Word {
        self.lane(0).word()
    }
    fn from_words(source: &mut impl WordSource) -> Self {
        Self(V::splat(V::Number::from_words(source)))
    }

    #[inline(always)]
    fn mask(holds: bool) -> V::Mask {
        V::mask(|_| holds)
    }
    #[inline(always)]
    fn equals(self, other: Self) -> V::Mask {
        self.0.equals(other.0)
    }
    #[inline(always)]
    fn less_than(self, other: Self) -> V::Mask {
        self.0.less_than(other.0)
    }
    #[inline(always)]
    fn at_most(self, other: Self) -> V::Mask {
        self.0.at_most(other.0)
    }
    #[inline(always)]
    fn pick(mask: V::Mask, then: Self, otherwise: Self) -> Self {
        Self(V::pick(mask, then.0, otherwise.0))
    }
    #[inline(always)]
    fn only_where(self, mask: V::Mask) -> Option<Self> {
        Some(Self(V::pick(mask, self.0, V::NUMBERS[8])))
    }
    #[inline(always)]
    fn counts(stored: &[i32]) -> &[V::Count] {
        V::counts(stored)
    }
    #[inline(always)]
    fn counts_mut(stored: &mut [i32]) -> &mut [V::Count] {
        V::counts_mut(stored)
    }
    #[inline(always)]
    fn from_count(count: V::Count) -> Self {
        let count = count.as_ref();
        Self(V::from_lanes(|lane| V::Number::from_i32(count[lane])))
    }
    #[inline(always)]
    fn is_odd(count: V::Count) -> V::Mask {
        let count = count.as_ref();
        V::mask(|lane| count[lane] & 1 != 0)
    }
    #[inline(always)]
    fn is_nil(count: V::Count) -> V::Mask {
        let count = count.as_ref();
        V::mask(|lane| count[lane] == 0)
    }
    #[inline(always)]
    fn recount(mut count: V::Count, mask: V::Mask, up: V::Mask) -> V::Count {
        let (mask, up) = (V::bits(mask), V::bits(up));
        if mask != 0 {
            for (lane, count) in count.as_mut().iter_mut().enumerate() {
                let [mask, up] = [mask, up].map(|masks| masks >> lane & 1 != 0);
                *count = V::Number::recount(*count, mask, up);
            }
        }
        count
    }

    #[inline(always)]
    fn reciprocal_or_zero(self) -> Self {
        Self::pick(self.equals(Self::ZERO), Self::ZERO, Self::ONE / self)
    }
    #[inline(always)]
    fn abs(self) -> Self {
        Self::pick(self.less_than(Self::ZERO), -self, self)
    }
}

#[cfg(all(test, target_arch = "x86_64", target_feature = "sse2"))]
mod tests {
    use std::vec::Vec;

    use super::*;

    /// The bits of all that a register makes of two numbers per lane.
    fn bits<V: Register>([a, b]: [&[V::Number]; 2]) -> (Vec<u64>, Vec<u32>) {
        let [a, b] = [a, b].map(|numbers| V::from_lanes(|lane| numbers[lane]));
        let masks = [a.equals(b), a.less_than(b), a.at_most(b), V::mask(|lane| lane % 2 == 0)];
        let joined = [masks[0] & masks[3], masks[1] | masks[3], !masks[2]];
        let numbers = [a.add(b), a.sub(b), a.mul(b), a.div(b), a.neg(), a.sqrt()];
        let picked = masks.map(|mask| V::pick(mask, a, b));
        let lanes = |number: &V| {
            (0..V::LANES).map(|lane| number.lane(lane).word().bits()).collect::<Vec<_>>()
        };
        let numbers = numbers.iter().chain(&picked).flat_map(lanes).collect();
        (numbers, masks.into_iter().chain(joined).map(V::bits).collect())
    }

    #[test]
    fn registers_have_the_bits_of_arrays() {
        fn check<A: Register, B: Register<Number = A::Number>>() {
            assert_eq!(A::LANES, B::LANES);
            let values = [0.0, -0.0, 1.0, -1.5, 3.7e-30, 2.9e20, f64::INFINITY, 0.1];
            let rotated = |by| {
                let mut values = values.map(A::Number::from_f64);
                values.rotate_left(by);
                values
            };
            for i in 0..values.len() {
                for k in 0..values.len() {
                    let pair = [&rotated(i)[..], &rotated(k)[..]];
                    assert_eq!(bits::<A>(pair), bits::<B>(pair), "{i} {k}");
                }
            }
        }
        check::<array::Doubles, Doubles>();
        check::<array::Singles, Singles>();
    }
}
