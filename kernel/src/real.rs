//! The arithmetic of forces, wrenches and velocities.
//!
//! `Real` is the complete arithmetic of element laws and schemes: the four operations, the square root, comparison and
//! the polynomial coefficients of its precision. Each operation is correctly rounded or exact, so a written order of
//! operations gives the same bits on every target. There is no fused operation and no function of the standard library.
//!
//! A number may be several, one per lane. A decision on a number is therefore written with `choose!` and similar
//! functions: a branch for one number, both branches and a selection for lanes.

use core::fmt::Debug;
use core::ops::{Add, BitAnd, BitOr, Div, Mul, Neg, Not, Sub};

use crate::words::{Word, WordSource};

/// A constant, rounded to each precision by the compiler: a target without double precision in hardware would convert a
/// table of `f64` at run time, by a routine.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Constant {
    /// In double precision.
    pub double: f64,
    /// Rounded once to single precision.
    pub single: f32,
}

impl Constant {
    /// `value`, and `value` rounded once.
    #[must_use]
    pub const fn new(value: f64) -> Self {
        Self { double: value, single: value as f32 }
    }
}

/// The result of a comparison: one mask, or one per lane.
pub trait Mask: Copy + BitAnd<Output = Self> + BitOr<Output = Self> + Not<Output = Self> {
    /// Whether it is set in any lane.
    fn any(self) -> bool;
    /// Whether it is set in every lane.
    fn all(self) -> bool;
}

impl Mask for bool {
    #[inline(always)]
    fn any(self) -> bool {
        self
    }
    #[inline(always)]
    fn all(self) -> bool {
        self
    }
}

/// A value that can be selected lane by lane.
pub trait Lanewise<R: Real>: Copy {
    /// `then` in each lane where `mask` is set, else `otherwise`.
    fn select(mask: R::Mask, then: Self, otherwise: Self) -> Self;
}

impl<R: Real> Lanewise<R> for R {
    #[inline(always)]
    fn select(mask: R::Mask, then: R, otherwise: R) -> R {
        R::pick(mask, then, otherwise)
    }
}

impl<R: Real, A: Lanewise<R>, B: Lanewise<R>> Lanewise<R> for (A, B) {
    #[inline(always)]
    fn select(mask: R::Mask, then: Self, otherwise: Self) -> Self {
        (A::select(mask, then.0, otherwise.0), B::select(mask, then.1, otherwise.1))
    }
}

/// A number in which forces are computed.
pub trait Real:
    Copy
    + Debug
    + Default
    + PartialEq
    + PartialOrd
    + Add<Output = Self>
    + Sub<Output = Self>
    + Mul<Output = Self>
    + Div<Output = Self>
    + Neg<Output = Self>
    + Send
    + Sync
    + 'static
{
    /// The number of lanes.
    const LANES: usize;
    /// Whether it is one number. A branch on a constant, unlike one on a comparison, is decided before code is inlined,
    /// so that the other side costs no compile time.
    const ONE_LANE: bool = Self::LANES == 1;
    /// The result of its comparisons.
    type Mask: Mask;
    /// A revolution count, one per lane.
    type Count: Copy;

    /// 0.
    const ZERO: Self;
    /// 1.
    const ONE: Self;
    /// ½, exact.
    const HALF: Self;
    /// 2, exact.
    const TWO: Self;
    /// π, rounded once.
    const PI: Self;
    /// π/2, rounded once.
    const FRAC_PI_2: Self;
    /// π/4, rounded once.
    const FRAC_PI_4: Self;
    /// tan(π/8), rounded once: the start of the arctangent's argument reduction.
    const TAN_PI_8: Self;
    /// Coefficients of `atan(t)/t` in powers of t², for |t| ≤ tan(π/8).
    ///
    /// Interpolation at Chebyshev nodes; relative error 6.3e-10 (f32) and 1.3e-18 (f64).
    const ATAN: &'static [Self];
    /// Coefficients of `cos(x)` in powers of x² (Taylor); see [`crate::rotation`] for the error.
    const COS: &'static [Self];
    /// Coefficients of `sin(x)/x` in powers of x² (Taylor).
    const SINC: &'static [Self];

    /// The number nearest to `value` (ties to even).
    fn from_f64(value: f64) -> Self;
    /// A constant, without conversion.
    fn constant(value: Constant) -> Self;
    /// The value in double precision, exact.
    fn to_f64(self) -> f64;
    /// The number nearest to a count of steps, exact below 2^24 (f32) or 2^53 (f64).
    fn from_u64(value: u64) -> Self;
    /// The number nearest to a revolution count.
    fn from_i32(value: i32) -> Self;
    /// The correctly rounded square root.
    fn sqrt(self) -> Self;
    /// [`Self::sqrt`] of each.
    #[inline(always)]
    fn roots<const N: usize>(mut values: [Self; N]) -> [Self; N] {
        for value in &mut values {
            *value = value.sqrt();
        }
        values
    }
    /// [`Self::roots`] where little else can be computed meanwhile: by a call where that is cheaper.
    #[inline(always)]
    fn roots_apart<const N: usize>(values: [Self; N]) -> [Self; N] {
        Self::roots(values)
    }
    /// Whether the number is neither infinite nor NaN.
    fn is_finite(self) -> bool;
    /// The number's stored word.
    fn word(self) -> Word;
    /// The number from the next word.
    fn from_words(source: &mut impl WordSource) -> Self;

    /// A mask of every lane.
    fn mask(holds: bool) -> Self::Mask;
    /// Whether the numbers are equal.
    fn equals(self, other: Self) -> Self::Mask;
    /// Whether this number is the smaller one.
    fn less_than(self, other: Self) -> Self::Mask;
    /// Whether this number is at most the other; `false` for NaN.
    fn at_most(self, other: Self) -> Self::Mask;
    /// `then` in each lane where `mask` is set, else `otherwise`.
    fn pick(mask: Self::Mask, then: Self, otherwise: Self) -> Self;
    /// The number, where `mask` is set. Other lanes become NaN, as does every result of theirs; code that steps lanes
    /// detects that.
    fn only_where(self, mask: Self::Mask) -> Option<Self>;

    /// Revolution counts in stored form, one per lane.
    fn counts(stored: &[i32]) -> &[Self::Count];
    /// [`Self::counts`], mutable.
    fn counts_mut(stored: &mut [i32]) -> &mut [Self::Count];
    /// The number nearest to a revolution count.
    fn from_count(count: Self::Count) -> Self;
    /// Whether a revolution count is odd.
    fn is_odd(count: Self::Count) -> Self::Mask;
    /// Whether a revolution count is 0.
    fn is_nil(count: Self::Count) -> Self::Mask;
    /// A revolution count changed where `mask` is set: incremented where `up` is set, too, else decremented.
    fn recount(count: Self::Count, mask: Self::Mask, up: Self::Mask) -> Self::Count;

    /// `1/self`, or 0 where `self` is 0: avoids a division by zero for coincident points.
    #[inline(always)]
    fn reciprocal_or_zero(self) -> Self {
        if self == Self::ZERO { Self::ZERO } else { Self::ONE / self }
    }

    /// The distance from 1 to the next number.
    fn epsilon() -> Self {
        let mut spacing = Self::ONE;
        while Self::ONE + Self::HALF * spacing > Self::ONE {
            spacing = Self::HALF * spacing;
        }
        spacing
    }

    /// The absolute value.
    #[inline(always)]
    fn abs(self) -> Self {
        if self < Self::ZERO { -self } else { self }
    }

    /// Horner's evaluation of `Σ coefficients[i]·xⁱ`, highest power first.
    #[inline(always)]
    fn polynomial(self, coefficients: &[Self]) -> Self {
        let Some((&last, others)) = coefficients.split_last() else { return Self::ZERO };
        others.iter().rev().fold(last, |sum, &c| c + self * sum)
    }
}

/// `choose!(R, mask, then, otherwise)`: the value of `then` where `mask` is set, else that of `otherwise`. One number
/// takes a branch; lanes compute both and select. No closures: the compiler need not inline them, which lanes need, see
/// [`crate::step`].
macro_rules! choose {
    ($real:ty, $mask:expr, $then:expr, $otherwise:expr) => {{
        let mask = $mask;
        if <$real as $crate::real::Real>::ONE_LANE {
            if $crate::real::Mask::any(mask) { $then } else { $otherwise }
        } else {
            let (then, otherwise) = ($then, $otherwise);
            $crate::real::Lanewise::<$real>::select(mask, then, otherwise)
        }
    }};
}
pub(crate) use choose;

/// The comparisons of a [`Real`] with one lane, within its implementation.
#[macro_export]
macro_rules! one_lane {
    () => {
        const LANES: usize = 1;
        type Mask = bool;
        type Count = i32;

        #[inline(always)]
        fn mask(holds: bool) -> bool {
            holds
        }
        #[inline(always)]
        fn equals(self, other: Self) -> bool {
            self == other
        }
        #[inline(always)]
        fn less_than(self, other: Self) -> bool {
            self < other
        }
        #[inline(always)]
        fn at_most(self, other: Self) -> bool {
            self <= other
        }
        #[inline(always)]
        fn pick(mask: bool, then: Self, otherwise: Self) -> Self {
            if mask { then } else { otherwise }
        }
        #[inline(always)]
        fn only_where(self, mask: bool) -> Option<Self> {
            if mask { Some(self) } else { None }
        }
        #[inline(always)]
        fn counts(stored: &[i32]) -> &[i32] {
            stored
        }
        #[inline(always)]
        fn counts_mut(stored: &mut [i32]) -> &mut [i32] {
            stored
        }
        #[inline(always)]
        fn from_count(count: i32) -> Self {
            Self::from_i32(count)
        }
        #[inline(always)]
        fn is_odd(count: i32) -> bool {
            count & 1 != 0
        }
        #[inline(always)]
        fn is_nil(count: i32) -> bool {
            count == 0
        }
        #[inline(always)]
        fn recount(count: i32, mask: bool, up: bool) -> i32 {
            if !mask {
                count
            } else if up {
                count.wrapping_add(1)
            } else {
                count.wrapping_sub(1)
            }
        }
    };
}

pub use one_lane;

impl Real for f64 {
    one_lane!();

    const ZERO: Self = 0.0;
    const ONE: Self = 1.0;
    const HALF: Self = 0.5;
    const TWO: Self = 2.0;
    const PI: Self = core::f64::consts::PI;
    const FRAC_PI_2: Self = core::f64::consts::FRAC_PI_2;
    const FRAC_PI_4: Self = core::f64::consts::FRAC_PI_4;
    const TAN_PI_8: Self = 0.414_213_562_373_095_05;
    const ATAN: &'static [Self] = &[
        1.0,
        -0.333_333_333_333_331_2,
        0.199_999_999_999_406_2,
        -0.142_857_142_792_238_25,
        0.111_111_107_436_052_72,
        -0.090_908_967_710_695_17,
        0.076_920_446_486_449_62,
        -0.066_629_439_708_755_77,
        0.058_468_205_483_397_59,
        -0.050_348_390_947_738_73,
        0.037_958_485_922_477_83,
        -0.017_797_894_580_179_53,
    ];
    const COS: &'static [Self] = &[1.0, -0.5, 1.0 / 24.0, -1.0 / 720.0, 1.0 / 40_320.0];
    const SINC: &'static [Self] = &[1.0, -1.0 / 6.0, 1.0 / 120.0, -1.0 / 5_040.0, 1.0 / 362_880.0];

    #[inline(always)]
    fn from_f64(value: f64) -> Self {
        value
    }
    #[inline(always)]
    fn constant(value: Constant) -> Self {
        value.double
    }
    #[inline(always)]
    fn to_f64(self) -> f64 {
        self
    }
    #[inline(always)]
    fn from_u64(value: u64) -> Self {
        value as f64
    }
    #[inline(always)]
    fn from_i32(value: i32) -> Self {
        f64::from(value)
    }
    #[inline(always)]
    fn sqrt(self) -> Self {
        crate::square_root::sqrt_f64(self)
    }
    #[inline(always)]
    fn is_finite(self) -> bool {
        self.is_finite()
    }
    #[inline(always)]
    fn word(self) -> Word {
        Word::F64(self)
    }
    fn from_words(source: &mut impl WordSource) -> Self {
        Self::from_bits(source.take(8))
    }
}

impl Real for f32 {
    one_lane!();

    const ZERO: Self = 0.0;
    const ONE: Self = 1.0;
    const HALF: Self = 0.5;
    const TWO: Self = 2.0;
    const PI: Self = core::f32::consts::PI;
    const FRAC_PI_2: Self = core::f32::consts::FRAC_PI_2;
    const FRAC_PI_4: Self = core::f32::consts::FRAC_PI_4;
    const TAN_PI_8: Self = 0.414_213_57;
    const ATAN: &'static [Self] =
        &[1.0, -0.333_333_07, 0.199_981_8, -0.142_394_72, 0.105_693_75, -0.060_251_34];
    const COS: &'static [Self] = &[1.0, -0.5, 1.0 / 24.0, -1.0 / 720.0];
    const SINC: &'static [Self] = &[1.0, -1.0 / 6.0, 1.0 / 120.0, -1.0 / 5_040.0];

    #[inline(always)]
    fn from_f64(value: f64) -> Self {
        value as f32
    }
    #[inline(always)]
    fn constant(value: Constant) -> Self {
        value.single
    }
    #[inline(always)]
    fn to_f64(self) -> f64 {
        f64::from(self)
    }
    // In two halves, each of which an FPU without 64-bit conversions can convert.
    #[inline(always)]
    fn from_u64(value: u64) -> Self {
        let (high, low) = ((value >> 32) as u32, value as u32);
        if high == 0 { low as f32 } else { high as f32 * 4_294_967_296.0 + low as f32 }
    }
    #[inline(always)]
    fn from_i32(value: i32) -> Self {
        value as f32
    }
    #[inline(always)]
    fn sqrt(self) -> Self {
        crate::square_root::sqrt_f32(self)
    }
    #[inline(always)]
    fn roots<const N: usize>(values: [Self; N]) -> [Self; N] {
        crate::square_root::roots_f32(values)
    }
    #[inline(always)]
    fn roots_apart<const N: usize>(values: [Self; N]) -> [Self; N] {
        crate::square_root::roots_apart_f32(values)
    }
    #[inline(always)]
    fn is_finite(self) -> bool {
        self.is_finite()
    }
    #[inline(always)]
    fn word(self) -> Word {
        Word::F32(self)
    }
    fn from_words(source: &mut impl WordSource) -> Self {
        Self::from_bits(source.take(4) as u32)
    }
}
