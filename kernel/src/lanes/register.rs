//! The interface of a register of an instruction set, and work that uses one.
//!
//! `(register, register) => register`, with IEEE 754 operations in every lane.

use crate::lanes::Named;
use crate::real::{Mask, Real};

/// A register of numbers. Its operations require its instruction set: whoever makes numbers of a register beyond the
/// target's baseline finds out first whether the processor has it. Within [`Register::enter`] each is an instruction,
/// elsewhere a call.
pub trait Register: Copy + Send + Sync + 'static {
    /// The number in each lane.
    type Number: Real<Mask = bool, Count = i32> + Named;
    /// A mask per lane.
    type Mask: Mask;
    /// A revolution count per lane, as stored.
    type Count: Copy + AsRef<[i32]> + AsMut<[i32]>;

    /// Number of lanes, at most 32.
    const LANES: usize;
    /// The coefficients of [`Real`], in every lane.
    const ATAN: &'static [Self];
    /// Likewise.
    const COS: &'static [Self];
    /// Likewise.
    const SINC: &'static [Self];
    /// 0, 1, ½, 2, π, π/2, π/4, tan(π/8) and NaN, in every lane.
    const NUMBERS: [Self; 9];

    /// The same number in every lane.
    fn splat(number: Self::Number) -> Self;
    /// A number per lane.
    fn from_lanes(lanes: impl Fn(usize) -> Self::Number) -> Self;
    /// The number in a lane.
    fn lane(self, lane: usize) -> Self::Number;
    /// A mask per lane.
    fn mask(lanes: impl Fn(usize) -> bool) -> Self::Mask;
    /// The mask bits, lane 0 lowest.
    fn bits(mask: Self::Mask) -> u32;

    fn add(self, other: Self) -> Self;
    fn sub(self, other: Self) -> Self;
    fn mul(self, other: Self) -> Self;
    fn div(self, other: Self) -> Self;
    fn neg(self) -> Self;
    fn sqrt(self) -> Self;
    fn equals(self, other: Self) -> Self::Mask;
    fn less_than(self, other: Self) -> Self::Mask;
    fn at_most(self, other: Self) -> Self::Mask;
    fn pick(mask: Self::Mask, then: Self, otherwise: Self) -> Self;
    /// Revolution counts as stored, for all lanes of a register.
    fn counts(stored: &[i32]) -> &[Self::Count];
    /// Likewise.
    fn counts_mut(stored: &mut [i32]) -> &mut [Self::Count];

    /// Runs `work` with the instruction set enabled.
    fn enter<W: Work>(work: W) -> W::Outcome;
}

/// Work with an instruction set.
pub trait Work {
    /// Its result.
    type Outcome;
    /// Runs it. Must be inlined with everything that it calls: code compiled separately uses only the baseline
    /// instruction set.
    fn run(self) -> Self::Outcome;
}

/// The constants of a register, from those of its number.
macro_rules! constants {
    ($number:ty) => {
        const ATAN: &'static [Self] =
            &Self::splat_all::<{ <$number as Real>::ATAN.len() }>(<$number as Real>::ATAN);
        const COS: &'static [Self] =
            &Self::splat_all::<{ <$number as Real>::COS.len() }>(<$number as Real>::COS);
        const SINC: &'static [Self] =
            &Self::splat_all::<{ <$number as Real>::SINC.len() }>(<$number as Real>::SINC);
        const NUMBERS: [Self; 9] = Self::splat_all(&[
            <$number as Real>::ZERO,
            <$number as Real>::ONE,
            <$number as Real>::HALF,
            <$number as Real>::TWO,
            <$number as Real>::PI,
            <$number as Real>::FRAC_PI_2,
            <$number as Real>::FRAC_PI_4,
            <$number as Real>::TAN_PI_8,
            <$number>::NAN,
        ]);
    };
}
pub(super) use constants;
