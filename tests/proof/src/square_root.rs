//! Whether a square root is the one that IEEE 754 demands: by whole numbers alone.
//!
//! `(root, inputs) => inputs whose root is wrong`. With x = X·4ᵏ and a root of n·2ᵏ, n is the nearest
//! whole number to √X where n² − n < X ≤ n² + n; no tie can be. Zeros keep their sign, infinity its
//! own, and what is negative or NaN gives a NaN, whose bits IEEE leaves open.

use dbd_kernel::Real;

/// A way of taking the root, by name.
pub struct Root<R> {
    /// What it is.
    pub name: &'static str,
    /// The root.
    pub of: fn(R) -> R,
}

/// Single precision: the kernel's on this machine, and the one that libm computes without a
/// machine's instruction, which the kernel takes elsewhere.
pub const SINGLE: [Root<f32>; 2] = [
    Root { name: "the kernel's on this machine", of: <f32 as Real>::sqrt },
    Root { name: "libm's in whole numbers", of: libm::generic::sqrt },
];

/// The same in double precision.
pub const DOUBLE: [Root<f64>; 2] = [
    Root { name: "the kernel's on this machine", of: <f64 as Real>::sqrt },
    Root { name: "libm's in whole numbers", of: libm::generic::sqrt },
];

/// Significand of `digits` binary digits and exponent of a finite number above 0.
fn parts(bits: u64, digits: u32, bias: i32) -> (u64, i32) {
    let (fraction, exponent) = (bits & ((1 << (digits - 1)) - 1), (bits >> (digits - 1)) as i32);
    let least = 1 - bias - (digits as i32 - 1);
    if exponent == 0 {
        // Denormal: as if there were no least exponent.
        let shift = digits - (64 - fraction.leading_zeros());
        (fraction << shift, least - shift as i32)
    } else {
        (fraction | (1 << (digits - 1)), least + exponent - 1)
    }
}

/// Whether `root`, of these bits, is the nearest to the root of x, above 0 and finite.
fn is_nearest(x: u64, root: u64, digits: u32, bias: i32) -> bool {
    let (m, e) = parts(x, digits, bias);
    let (n, k) = parts(root, digits, bias);
    let shift = digits as i32 - 1 + (e - (digits as i32 - 1)).rem_euclid(2);
    let (square, n) = (u128::from(m) << shift, u128::from(n));
    (e - shift) == 2 * k && n * n - n < square && square <= n * n + n
}

/// Whether `root` is the root of `x` in single precision.
#[must_use]
pub fn is_right_f32(x: f32, root: f32) -> bool {
    if x.is_nan() || x < 0.0 {
        root.is_nan()
    } else if x == 0.0 || x.is_infinite() {
        root.to_bits() == x.to_bits()
    } else {
        let sound = root.is_finite() && root > 0.0;
        sound && is_nearest(x.to_bits().into(), root.to_bits().into(), 24, 127)
    }
}

/// Whether `root` is the root of `x` in double precision.
#[must_use]
pub fn is_right_f64(x: f64, root: f64) -> bool {
    if x.is_nan() || x < 0.0 {
        root.is_nan()
    } else if x == 0.0 || x.is_infinite() {
        root.to_bits() == x.to_bits()
    } else {
        let sound = root.is_finite() && root > 0.0;
        sound && is_nearest(x.to_bits(), root.to_bits(), 53, 1023)
    }
}

/// How many of these patterns of bits have a wrong root, and the first of them.
pub fn wrong_f32(root: fn(f32) -> f32, bits: impl Iterator<Item = u32>) -> (u64, Option<f32>) {
    let wrong = bits.map(f32::from_bits).filter(|x| !is_right_f32(*x, root(*x)));
    wrong.fold((0, None), |(count, first), x| (count + 1, first.or(Some(x))))
}

/// The same in double precision.
pub fn wrong_f64(root: fn(f64) -> f64, inputs: impl Iterator<Item = f64>) -> (u64, Option<f64>) {
    let wrong = inputs.filter(|x| !is_right_f64(*x, root(*x)));
    wrong.fold((0, None), |(count, first), x| (count + 1, first.or(Some(x))))
}

/// A million patterns: both ends of every exponent of either sign, so zeros, denormals, infinities
/// and NaNs too, and between them an even stride.
#[cfg(test)]
pub fn million_f32() -> impl Iterator<Item = u32> {
    let ends = (0..=u32::from(u16::MAX >> 7)).flat_map(|exponent| {
        let first = exponent << 23;
        (first..first + 100).chain(first + 0x7f_ff9c..=first + 0x7f_ffff)
    });
    // A prime near 2³²/900,000.
    ends.chain((0..900_000).map(|i: u32| i.wrapping_mul(4_787)))
}

/// Numbers in double precision: special ones, of all exponents, and those whose roots lie closest to
/// the middle between two numbers.
pub fn hard_f64(count: u64) -> impl Iterator<Item = f64> {
    let special = [0.0, -0.0, 1.0, -1.0, f64::NAN, f64::INFINITY, -f64::INFINITY, f64::MAX];
    let of_any_exponent = (0..count).flat_map(|i| {
        let random = scrambled(i);
        [f64::from_bits(random), f64::from_bits(random >> 12)]
    });
    let hard = (1..=count).flat_map(|i| {
        [i, i.wrapping_neg()].into_iter().flat_map(|i| {
            [0, 1].into_iter().filter_map(move |start| near_a_middle(2 * i as i64, start))
        })
    });
    special.into_iter().chain(of_any_exponent).chain(hard)
}

/// The x whose X is n² + n − c, so little below or above the square of n + ½. Every even c has two n
/// modulo 2⁵²: n² + n − c has an odd slope, and Newton's iteration doubles the digits that are right.
fn near_a_middle(c: i64, start: u64) -> Option<f64> {
    let mut n = start;
    for _ in 0..6 {
        let slope = n.wrapping_mul(2).wrapping_add(1);
        let inverse = (0..6).fold(slope, |inverse, _| {
            inverse.wrapping_mul(2_u64.wrapping_sub(slope.wrapping_mul(inverse)))
        });
        let residue = n.wrapping_mul(n).wrapping_add(n).wrapping_sub(c as u64);
        n = n.wrapping_sub(residue.wrapping_mul(inverse));
    }
    let n = i128::from((n & ((1 << 52) - 1)) | (1 << 52));
    let square = n * n + n - i128::from(c);
    let shift = square.trailing_zeros().min(53);
    let m = (square >> shift) as u64;
    // X = m·2⁵² is a number's where m has 53 digits; beyond that only where the last is 0.
    (shift >= 52 && m < 1 << 53).then(|| m as f64 * f64::from(shift as i32 - 51))
}

/// A well mixed number (Steele, Lea & Flood 2014, SplitMix64).
#[must_use]
pub fn scrambled(i: u64) -> u64 {
    let z = (i + 1).wrapping_mul(0x9e37_79b9_7f4a_7c15);
    let z = (z ^ (z >> 30)).wrapping_mul(0xbf58_476d_1ce4_e5b9);
    let z = (z ^ (z >> 27)).wrapping_mul(0x94d0_49bb_1331_11eb);
    z ^ (z >> 31)
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn neighbours_of_a_root_are_told_from_it() {
        for i in 0..20_000 {
            let x = f32::from_bits(scrambled(i) as u32 & 0x7fff_ffff);
            if x.is_finite() && x > 0.0 {
                let root = x.sqrt();
                assert!(is_right_f32(x, root), "{x:e}");
                for wrong in [-root, 2.0 * root, root.next_up(), root.next_down(), f32::NAN] {
                    assert!(!is_right_f32(x, wrong), "{x:e} {wrong:e}");
                }
            }
            let x = f64::from_bits(scrambled(i) >> 1);
            if x.is_finite() && x > 0.0 {
                let root = x.sqrt();
                assert!(is_right_f64(x, root), "{x:e}");
                assert!(!is_right_f64(x, root.next_up()) && !is_right_f64(x, root.next_down()));
            }
        }
        assert!(!is_right_f32(-0.0, 0.0) && !is_right_f64(-1.0, 1.0));
    }

    #[test]
    fn a_million_roots_in_single_precision() {
        for root in SINGLE {
            assert_eq!(wrong_f32(root.of, million_f32()), (0, None), "{}", root.name);
        }
        // A root that is nearly right is not.
        let nearly = wrong_f32(|x| (1.0 / x.sqrt()) * x, million_f32()).0;
        assert!(nearly > 10_000, "{nearly}");
    }

    #[test]
    fn hard_roots_in_double_precision() {
        for root in DOUBLE {
            assert_eq!(wrong_f64(root.of, hard_f64(100_000)).0, 0, "{}", root.name);
        }
        // The hard ones lie at less than 1e-10 of a last digit from a middle: rounding twice fails.
        let middle = |x: &f64| *x > 1.0 && *x < 1e17 && x.fract() == 0.0;
        let hard: Vec<f64> = hard_f64(1_000).filter(middle).collect();
        assert!(hard.len() > 1_000, "{}", hard.len());
        let nearly = wrong_f64(|x| (1.0 / x.sqrt()) * x, hard.into_iter()).0;
        assert!(nearly > 500, "{nearly}");
    }
}
