//! Registers of x86-64: SSE2, AVX2 and AVX-512.
// Operations on masks of bits are safe, those on registers are not; one macro writes both.
#![allow(unsafe_code, unused_unsafe)]

use core::arch::x86_64::*;
use core::ops::{BitAnd, BitOr, Not};

use crate::lanes::register::{Register, Work, constants};
use crate::real::{Mask, Real};

// SAFETY of all below: every target of this file has SSE2. Whoever uses one of the other registers has found its
// instructions on the processor, as `dbd_ensemble::InstructionSet` does. Arrays and registers of the same size have
// interchangeable bits.

macro_rules! register {
    (
        $(#[$doc:meta])* $name:ident, $number:ty, $lanes:literal, $inner:ty, $feature:literal,
        $mask:ident, $mask_inner:ty,
        add $add:ident, sub $sub:ident, mul $mul:ident, div $div:ident, sqrt $sqrt:ident,
        splat $splat:ident,
        neg $neg:expr, compare $compare:ident, pick $pick:expr,
        and $and:expr, or $or:expr, not $not:expr, bits $bits:expr, mask $from:ident,
    ) => {
        $(#[$doc])*
        #[derive(Clone, Copy)]
        #[repr(transparent)]
        pub struct $name($inner);

        /// A mask per lane.
        #[derive(Clone, Copy)]
        #[repr(transparent)]
        pub struct $mask($mask_inner);

        impl BitAnd for $mask {
            type Output = Self;
            #[inline(always)]
            fn bitand(self, other: Self) -> Self {
                // SAFETY: see above.
                Self(unsafe { ($and)(self.0, other.0) })
            }
        }

        impl BitOr for $mask {
            type Output = Self;
            #[inline(always)]
            fn bitor(self, other: Self) -> Self {
                // SAFETY: see above.
                Self(unsafe { ($or)(self.0, other.0) })
            }
        }

        impl Not for $mask {
            type Output = Self;
            #[inline(always)]
            fn not(self) -> Self {
                // SAFETY: see above.
                Self(unsafe { ($not)(self.0) })
            }
        }

        impl Mask for $mask {
            #[inline(always)]
            fn any(self) -> bool {
                <$name>::bits(self) != 0
            }
            #[inline(always)]
            fn all(self) -> bool {
                <$name>::bits(self) == (1 << $lanes) - 1
            }
        }

        impl $name {
            const fn splat_all<const N: usize>(numbers: &[$number]) -> [Self; N] {
                let mut all = [Self::of_array([0.0; $lanes]); N];
                let mut i = 0;
                while i < N {
                    all[i] = Self::of_array([numbers[i]; $lanes]);
                    i += 1;
                }
                all
            }

            #[inline(always)]
            const fn of_array(lanes: [$number; $lanes]) -> Self {
                // SAFETY: see above.
                Self(unsafe { core::mem::transmute::<[$number; $lanes], $inner>(lanes) })
            }

            #[inline(always)]
            fn to_array(self) -> [$number; $lanes] {
                // SAFETY: see above.
                unsafe { core::mem::transmute(self.0) }
            }
        }

        impl Register for $name {
            type Number = $number;
            type Mask = $mask;
            type Count = [i32; $lanes];

            const LANES: usize = $lanes;
            constants!($number);

            #[inline(always)]
            fn splat(number: $number) -> Self {
                // SAFETY: see above.
                Self(unsafe { $splat(number) })
            }
            #[inline(always)]
            fn from_lanes(lanes: impl Fn(usize) -> $number) -> Self {
                Self::of_array(core::array::from_fn(lanes))
            }
            #[inline(always)]
            fn lane(self, lane: usize) -> $number {
                self.to_array()[lane]
            }
            #[inline(always)]
            fn mask(lanes: impl Fn(usize) -> bool) -> $mask {
                // SAFETY: see above.
                $mask(unsafe { $from!($mask_inner, $lanes, lanes) })
            }
            #[inline(always)]
            fn bits(mask: $mask) -> u32 {
                // SAFETY: see above.
                unsafe { ($bits)(mask.0) }
            }
            #[inline(always)]
            fn add(self, other: Self) -> Self {
                // SAFETY: see above.
                Self(unsafe { $add(self.0, other.0) })
            }
            #[inline(always)]
            fn sub(self, other: Self) -> Self {
                // SAFETY: see above.
                Self(unsafe { $sub(self.0, other.0) })
            }
            #[inline(always)]
            fn mul(self, other: Self) -> Self {
                // SAFETY: see above.
                Self(unsafe { $mul(self.0, other.0) })
            }
            #[inline(always)]
            fn div(self, other: Self) -> Self {
                // SAFETY: see above.
                Self(unsafe { $div(self.0, other.0) })
            }
            #[inline(always)]
            fn neg(self) -> Self {
                // SAFETY: see above.
                Self(unsafe { ($neg)(self.0) })
            }
            #[inline(always)]
            fn sqrt(self) -> Self {
                // SAFETY: see above.
                Self(unsafe { $sqrt(self.0) })
            }
            #[inline(always)]
            fn equals(self, other: Self) -> $mask {
                // SAFETY: see above.
                $mask(unsafe { $compare!(_CMP_EQ_OQ, self.0, other.0) })
            }
            #[inline(always)]
            fn less_than(self, other: Self) -> $mask {
                // SAFETY: see above.
                $mask(unsafe { $compare!(_CMP_LT_OQ, self.0, other.0) })
            }
            #[inline(always)]
            fn at_most(self, other: Self) -> $mask {
                // SAFETY: see above.
                $mask(unsafe { $compare!(_CMP_LE_OQ, self.0, other.0) })
            }
            #[inline(always)]
            fn pick(mask: $mask, then: Self, otherwise: Self) -> Self {
                // SAFETY: see above.
                Self(unsafe { ($pick)(mask.0, then.0, otherwise.0) })
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
                #[target_feature(enable = $feature)]
                fn with_instructions<W: Work>(work: W) -> W::Outcome {
                    work.run()
                }
                // SAFETY: see above.
                unsafe { with_instructions(work) }
            }
        }
    };
}

macro_rules! compare_128_double {
    (_CMP_EQ_OQ, $a:expr, $b:expr) => {
        _mm_cmpeq_pd($a, $b)
    };
    (_CMP_LT_OQ, $a:expr, $b:expr) => {
        _mm_cmplt_pd($a, $b)
    };
    (_CMP_LE_OQ, $a:expr, $b:expr) => {
        _mm_cmple_pd($a, $b)
    };
}
macro_rules! compare_128_single {
    (_CMP_EQ_OQ, $a:expr, $b:expr) => {
        _mm_cmpeq_ps($a, $b)
    };
    (_CMP_LT_OQ, $a:expr, $b:expr) => {
        _mm_cmplt_ps($a, $b)
    };
    (_CMP_LE_OQ, $a:expr, $b:expr) => {
        _mm_cmple_ps($a, $b)
    };
}

macro_rules! compare_256_single {
    ($how:ident, $a:expr, $b:expr) => {
        _mm256_cmp_ps::<$how>($a, $b)
    };
}

macro_rules! compare_256_double {
    ($how:ident, $a:expr, $b:expr) => {
        _mm256_cmp_pd::<$how>($a, $b)
    };
}

macro_rules! compare_512_single {
    ($how:ident, $a:expr, $b:expr) => {
        _mm512_cmp_ps_mask::<$how>($a, $b)
    };
}

macro_rules! compare_512_double {
    ($how:ident, $a:expr, $b:expr) => {
        _mm512_cmp_pd_mask::<$how>($a, $b)
    };
}

// A mask of as many bits as the number has, for each lane.
macro_rules! mask_single {
    ($inner:ty, $lanes:literal, $mask:expr) => {{
        let lanes: [u32; $lanes] = core::array::from_fn(|i| if $mask(i) { u32::MAX } else { 0 });
        core::mem::transmute::<[u32; $lanes], $inner>(lanes)
    }};
}

macro_rules! mask_double {
    ($inner:ty, $lanes:literal, $mask:expr) => {{
        let lanes: [u64; $lanes] = core::array::from_fn(|i| if $mask(i) { u64::MAX } else { 0 });
        core::mem::transmute::<[u64; $lanes], $inner>(lanes)
    }};
}

// A bit for each lane.
macro_rules! mask_bits {
    ($inner:ty, $lanes:literal, $mask:expr) => {
        (0..$lanes).fold(0, |bits, lane| bits | (u32::from($mask(lane)) << lane)) as $inner
    };
}

register! {
    /// Two numbers of double precision.
    Doubles, f64, 2, __m128d, "sse2", Masks2x64, __m128d,
    add _mm_add_pd, sub _mm_sub_pd, mul _mm_mul_pd, div _mm_div_pd,
    sqrt _mm_sqrt_pd, splat _mm_set1_pd,
    neg |x| _mm_xor_pd(x, _mm_set1_pd(-0.0)), compare compare_128_double,
    pick |mask, then, otherwise| _mm_or_pd(_mm_and_pd(mask, then), _mm_andnot_pd(mask, otherwise)),
    and _mm_and_pd, or _mm_or_pd,
    not |x| _mm_xor_pd(x, _mm_castsi128_pd(_mm_set1_epi32(-1))),
    bits |x| _mm_movemask_pd(x) as u32, mask mask_double,
}

register! {
    /// Four numbers of single precision.
    Singles, f32, 4, __m128, "sse2", Masks4x32, __m128,
    add _mm_add_ps, sub _mm_sub_ps, mul _mm_mul_ps, div _mm_div_ps,
    sqrt _mm_sqrt_ps, splat _mm_set1_ps,
    neg |x| _mm_xor_ps(x, _mm_set1_ps(-0.0)), compare compare_128_single,
    pick |mask, then, otherwise| _mm_or_ps(_mm_and_ps(mask, then), _mm_andnot_ps(mask, otherwise)),
    and _mm_and_ps, or _mm_or_ps,
    not |x| _mm_xor_ps(x, _mm_castsi128_ps(_mm_set1_epi32(-1))),
    bits |x| _mm_movemask_ps(x) as u32, mask mask_single,
}

register! {
    /// Eight numbers of single precision.
    Singles256, f32, 8, __m256, "avx2", Masks8x32, __m256,
    add _mm256_add_ps, sub _mm256_sub_ps, mul _mm256_mul_ps, div _mm256_div_ps,
    sqrt _mm256_sqrt_ps, splat _mm256_set1_ps,
    neg |x| _mm256_xor_ps(x, _mm256_set1_ps(-0.0)), compare compare_256_single,
    pick |mask, then, otherwise| _mm256_blendv_ps(otherwise, then, mask),
    and _mm256_and_ps, or _mm256_or_ps,
    not |x| _mm256_xor_ps(x, _mm256_castsi256_ps(_mm256_set1_epi32(-1))),
    bits |x| _mm256_movemask_ps(x) as u32, mask mask_single,
}

register! {
    /// Four numbers of double precision.
    Doubles256, f64, 4, __m256d, "avx2", Masks4x64, __m256d,
    add _mm256_add_pd, sub _mm256_sub_pd, mul _mm256_mul_pd, div _mm256_div_pd,
    sqrt _mm256_sqrt_pd, splat _mm256_set1_pd,
    neg |x| _mm256_xor_pd(x, _mm256_set1_pd(-0.0)), compare compare_256_double,
    pick |mask, then, otherwise| _mm256_blendv_pd(otherwise, then, mask),
    and _mm256_and_pd, or _mm256_or_pd,
    not |x| _mm256_xor_pd(x, _mm256_castsi256_pd(_mm256_set1_epi32(-1))),
    bits |x| _mm256_movemask_pd(x) as u32, mask mask_double,
}

register! {
    /// Sixteen numbers of single precision.
    Singles512, f32, 16, __m512, "avx512f,avx512dq", Masks16, __mmask16,
    add _mm512_add_ps, sub _mm512_sub_ps, mul _mm512_mul_ps, div _mm512_div_ps,
    sqrt _mm512_sqrt_ps, splat _mm512_set1_ps,
    neg |x| _mm512_xor_ps(x, _mm512_set1_ps(-0.0)), compare compare_512_single,
    pick |mask, then, otherwise| _mm512_mask_blend_ps(mask, otherwise, then),
    and BitAnd::bitand, or BitOr::bitor, not Not::not,
    bits |x: __mmask16| u32::from(x), mask mask_bits,
}

register! {
    /// Eight numbers of double precision.
    Doubles512, f64, 8, __m512d, "avx512f,avx512dq", Masks8, __mmask8,
    add _mm512_add_pd, sub _mm512_sub_pd, mul _mm512_mul_pd, div _mm512_div_pd,
    sqrt _mm512_sqrt_pd, splat _mm512_set1_pd,
    neg |x| _mm512_xor_pd(x, _mm512_set1_pd(-0.0)), compare compare_512_double,
    pick |mask, then, otherwise| _mm512_mask_blend_pd(mask, otherwise, then),
    and BitAnd::bitand, or BitOr::bitor, not Not::not,
    bits |x: __mmask8| u32::from(x), mask mask_bits,
}
