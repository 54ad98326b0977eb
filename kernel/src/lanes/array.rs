//! Registers of any machine: arrays, which the compiler maps to the available ones.

use core::array::from_fn;
use core::ops::{BitAnd, BitOr, Not};

use crate::lanes::register::{Register, Work, constants};
use crate::real::{Mask, Real};

/// Two numbers of double precision.
pub type Doubles = Array<f64, 2>;
/// Four numbers of single precision.
pub type Singles = Array<f32, 4>;

/// `W` numbers.
#[derive(Clone, Copy)]
#[repr(transparent)]
pub struct Array<T, const W: usize>([T; W]);

/// A mask per lane.
#[derive(Clone, Copy)]
pub struct Masks<const W: usize>([bool; W]);

impl<const W: usize> BitAnd for Masks<W> {
    type Output = Self;
    #[inline(always)]
    fn bitand(self, other: Self) -> Self {
        Self(from_fn(|i| self.0[i] & other.0[i]))
    }
}

impl<const W: usize> BitOr for Masks<W> {
    type Output = Self;
    #[inline(always)]
    fn bitor(self, other: Self) -> Self {
        Self(from_fn(|i| self.0[i] | other.0[i]))
    }
}

impl<const W: usize> Not for Masks<W> {
    type Output = Self;
    #[inline(always)]
    fn not(self) -> Self {
        Self(self.0.map(|mask| !mask))
    }
}

impl<const W: usize> Mask for Masks<W> {
    #[inline(always)]
    fn any(self) -> bool {
        self.0.iter().fold(false, |any, mask| any | mask)
    }
    #[inline(always)]
    fn all(self) -> bool {
        self.0.iter().fold(true, |all, mask| all & mask)
    }
}

macro_rules! array {
    ($number:ty, $lanes:literal) => {
        impl Array<$number, $lanes> {
            const fn splat_all<const N: usize>(numbers: &[$number]) -> [Self; N] {
                let mut all = [Self([0.0; $lanes]); N];
                let mut i = 0;
                while i < N {
                    all[i] = Self([numbers[i]; $lanes]);
                    i += 1;
                }
                all
            }
        }

        impl Register for Array<$number, $lanes> {
            type Number = $number;
            type Mask = Masks<$lanes>;
            type Count = [i32; $lanes];

            const LANES: usize = $lanes;
            constants!($number);

            #[inline(always)]
            fn splat(number: $number) -> Self {
                Self([number; $lanes])
            }
            #[inline(always)]
            fn from_lanes(lanes: impl Fn(usize) -> $number) -> Self {
                Self(from_fn(lanes))
            }
            #[inline(always)]
            fn lane(self, lane: usize) -> $number {
                self.0[lane]
            }
            #[inline(always)]
            fn mask(lanes: impl Fn(usize) -> bool) -> Masks<$lanes> {
                Masks(from_fn(lanes))
            }
            #[inline(always)]
            fn bits(mask: Masks<$lanes>) -> u32 {
                (0..$lanes).fold(0, |bits, lane| bits | u32::from(mask.0[lane]) << lane)
            }
            #[inline(always)]
            fn add(self, other: Self) -> Self {
                Self(from_fn(|i| self.0[i] + other.0[i]))
            }
            #[inline(always)]
            fn sub(self, other: Self) -> Self {
                Self(from_fn(|i| self.0[i] - other.0[i]))
            }
            #[inline(always)]
            fn mul(self, other: Self) -> Self {
                Self(from_fn(|i| self.0[i] * other.0[i]))
            }
            #[inline(always)]
            fn div(self, other: Self) -> Self {
                Self(from_fn(|i| self.0[i] / other.0[i]))
            }
            #[inline(always)]
            fn neg(self) -> Self {
                Self(self.0.map(|x| -x))
            }
            #[inline(always)]
            fn sqrt(self) -> Self {
                Self(self.0.map(Real::sqrt))
            }
            #[inline(always)]
            fn equals(self, other: Self) -> Masks<$lanes> {
                Masks(from_fn(|i| self.0[i] == other.0[i]))
            }
            #[inline(always)]
            fn less_than(self, other: Self) -> Masks<$lanes> {
                Masks(from_fn(|i| self.0[i] < other.0[i]))
            }
            #[inline(always)]
            fn at_most(self, other: Self) -> Masks<$lanes> {
                Masks(from_fn(|i| self.0[i] <= other.0[i]))
            }
            #[inline(always)]
            fn pick(mask: Masks<$lanes>, then: Self, otherwise: Self) -> Self {
                Self(from_fn(|i| if mask.0[i] { then.0[i] } else { otherwise.0[i] }))
            }
            #[inline(always)]
            fn counts(stored: &[i32]) -> &[[i32; $lanes]] {
                stored.as_chunks().0
            }
            #[inline(always)]
            fn counts_mut(stored: &mut [i32]) -> &mut [[i32; $lanes]] {
                stored.as_chunks_mut().0
            }
            #[inline(always)]
            fn enter<W: Work>(work: W) -> W::Outcome {
                work.run()
            }
        }
    };
}

array!(f64, 2);
array!(f32, 4);
