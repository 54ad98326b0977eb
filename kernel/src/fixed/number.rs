//! Fixed-point numbers: an integer times a power of two given by the context.
//!
//! `f64, f32 <=> i64`, and the product of two numbers of magnitude 1. Conversions to integers saturate; callers keep
//! sums in range. Results are exact or have a stated error.

/// 2 to a power, exact.
const fn power_of_two(exponent: u32) -> f64 {
    (1_u64 << exponent) as f64
}

/// `value·2^bits` to the nearest integer, ties away from zero. Values out of range saturate; NaN becomes the minimum,
/// which is out of every range.
pub(crate) const fn from_f64(value: f64, bits: u32) -> i64 {
    if value.is_nan() {
        return i64::MIN;
    }
    let scaled = value * power_of_two(bits);
    let whole = scaled as i64;
    let rest = scaled - whole as f64;
    if rest >= 0.5 {
        whole.saturating_add(1)
    } else if rest <= -0.5 {
        whole.saturating_sub(1)
    } else {
        whole
    }
}

/// `value·2^-bits`, rounded once.
pub(crate) const fn to_f64(value: i64, bits: u32) -> f64 {
    value as f64 * (1.0 / power_of_two(bits))
}

/// 2 to a power between −126 and 127, exact.
pub(crate) const fn single_power(exponent: i32) -> f32 {
    f32::from_bits(((exponent + 127) as u32) << 23)
}

/// `value·2^(WHOLE + PART)`, truncated towards zero: the upper part by `2^WHOLE`, its exact remainder by `2^PART`, at
/// most 30. Saturates at `2^(31 + PART)`.
#[inline(always)]
pub(crate) fn from_f32<const WHOLE: i32, const PART: i32>(value: f32) -> i64 {
    let scaled = value * const { single_power(WHOLE) };
    let whole = scaled as i32;
    let part = (scaled - whole as f32) * const { single_power(PART) };
    (i64::from(whole) << PART).wrapping_add(i64::from(part as i32))
}

/// The single-precision number near `value·2^-BITS`: within 2^-23 of it, or 128 where that is more.
#[inline(always)]
pub(crate) fn to_f32<const BITS: i32>(value: i64) -> f32 {
    let (high, low) = ((value >> 32) as i32, value as u32);
    high as f32 * const { single_power(32 - BITS) } + low as f32 * const { single_power(-BITS) }
}

/// The upper and the lower half of a number's digits.
#[inline(always)]
fn digits(value: f32) -> (f32, f32) {
    let upper = f32::from_bits(value.to_bits() & 0xffff_f000);
    (upper, value - upper)
}

/// `(sum − lost)·factor` as two numbers whose sum is it to 2^-35: the product of the upper halves of their digits,
/// which is exact, and the remainder (Dekker 1971).
#[inline(always)]
pub(crate) fn exact_product(sum: f32, lost: f32, factor: f32) -> (f32, f32) {
    let ((a, b), (p, q)) = (digits(sum), digits(factor));
    (a * p, a * q + (b - lost) * factor)
}

/// `value·2^(WHOLE + 32)` without its last two bits, truncated towards zero: the upper word by `2^WHOLE`, the remainder
/// in the lower. For values that fit 64 bits.
#[inline(always)]
pub(crate) fn in_words<const WHOLE: i32>(value: f32) -> i64 {
    let scaled = value * const { single_power(WHOLE) };
    let whole = scaled as i32;
    let part = (scaled - whole as f32) * const { single_power(30) };
    (i64::from(whole) << 32).wrapping_add(i64::from(part as i32) << 2)
}

/// The nearest multiple of 2^32, divided by it, and the remainder.
#[inline(always)]
pub(crate) fn halves(value: i64) -> (i32, i32) {
    let low = value as i32;
    (((value >> 32) as i32).wrapping_add(i32::from(low < 0)), low)
}

/// [`to_f32`], rounded symmetrically about zero.
#[inline(always)]
pub(crate) fn nearest_f32<const BITS: i32>(value: i64) -> f32 {
    let (high, low) = halves(value);
    high as f32 * const { single_power(32 - BITS) } + low as f32 * const { single_power(-BITS) }
}

/// The sum of products of numbers in halves, in units of 2^64: within 2 of them. The sum of the cross terms must stay
/// below 2^63, as for the components of a unit quaternion.
#[inline(always)]
pub(crate) fn sum_of_products<const N: usize>(pairs: [((i32, i32), (i32, i32)); N]) -> i64 {
    let (mut upper, mut across) = (0_i64, 0_i64);
    for ((a, a_low), (b, b_low)) in pairs {
        let [a, a_low, b, b_low] = [a, a_low, b, b_low].map(i64::from);
        upper += a * b;
        across += a * b_low;
        across += a_low * b;
    }
    upper + (across >> 32)
}

/// The square of a number in halves, likewise.
#[inline(always)]
pub(crate) fn square_of_halves((high, low): (i32, i32)) -> i64 {
    let [high, low] = [high, low].map(i64::from);
    high * high + 2 * ((high * low) >> 32)
}

/// The sum of squares, in units of 2^64: within 3 of them. For components below 2^61.
#[inline(always)]
pub(crate) fn squared<const N: usize>(components: &[i64; N]) -> i64 {
    sum_of_squares(components.map(halves))
}

/// [`squared`] of numbers in halves.
#[inline(always)]
pub(crate) fn sum_of_squares<const N: usize>(components: [(i32, i32); N]) -> i64 {
    let (mut upper, mut across) = (0_i64, 0_i64);
    for (high, low) in components {
        let (high, low) = (i64::from(high), i64::from(low));
        upper += high * high;
        across += high * low;
    }
    upper + 2 * (across >> 32)
}

/// The square of a length below 32 m in single precision, in the units of [`squared`] of positions: 50 fraction bits,
/// truncated.
#[inline(always)]
pub(crate) fn square_of(length: f32) -> i64 {
    // Exact from 4 mm on, where the last digit of single precision is 2^-31; truncated there below.
    if length < 1.0 {
        let whole = i64::from((length * const { single_power(31) }) as i32);
        (whole * whole) >> 12
    } else {
        let whole = i64::from((length * const { single_power(26) }) as i32);
        (whole * whole) >> 2
    }
}

/// `a·b` of two numbers with 62 fraction bits, with 60 fraction bits: from 3 below it to 1 above, without the product
/// of both lower halves. For magnitudes up to 1.99.
#[inline(always)]
pub(crate) fn product(a: i64, b: i64) -> i64 {
    let (a_high, b_high) = (a >> 32, b >> 32);
    let (a_low, b_low) = (i64::from(a as u32 >> 1), i64::from(b as u32 >> 1));
    let across = (a_high * b_low).wrapping_add(b_high * a_low);
    (a_high * b_high).wrapping_add(across >> 31)
}

#[cfg(test)]
pub(super) mod tests {
    use super::*;

    /// Pseudo-random words (xorshift, Marsaglia 2003).
    pub(crate) fn words(mut seed: u64) -> impl Iterator<Item = u64> {
        core::iter::repeat_with(move || {
            seed ^= seed << 13;
            seed ^= seed >> 7;
            seed ^= seed << 17;
            seed
        })
    }

    #[test]
    fn double_precision_is_rounded_to_the_nearest_and_saturates() {
        assert_eq!(from_f64(1.5, 57), 3 << 56);
        assert_eq!([from_f64(0.5, 0), from_f64(-0.5, 0), from_f64(2.49, 0)], [1, -1, 2]);
        assert_eq!(from_f64(f64::INFINITY, 57), i64::MAX);
        assert_eq!(from_f64(-1e300, 57), i64::MIN);
        assert_eq!(from_f64(f64::NAN, 57), i64::MIN);
        for word in words(1).take(10_000) {
            let value = (word as i64 >> 11) as f64 * (-70.0_f64).exp2();
            let exact = (word as i64 >> 11) as i128;
            // 2^13 units of 2^-70 per unit of 2^-57.
            let off = i128::from(from_f64(value, 57)) * (1 << 13) - exact;
            assert!(off.abs() <= 1 << 12, "{value:e}: {off}");
            assert_eq!(to_f64(word as i64 >> 11, 57) * 57.0_f64.exp2(), (word as i64 >> 11) as f64);
        }
    }

    #[test]
    fn single_precision_is_cut_off_by_less_than_a_unit() {
        for word in words(2).take(100_000) {
            // Magnitudes from 2^-60 to 1/8.
            let mantissa = 0x0080_0000 | (word as u32 & 0x007f_ffff);
            let exponent = -84 + ((word >> 32) % 58) as i32;
            let sign = if word >> 63 == 0 { 1 } else { -1 };
            let value = sign as f32 * mantissa as f32 * single_power(exponent);
            let exact = (i128::from(sign) * i128::from(mantissa)) << (exponent + 84);
            let off = (i128::from(from_f32::<30, 27>(value)) << 27) - exact;
            assert!(off.abs() < 1 << 27, "{value:e}: {off}");
        }
        assert_eq!(from_f32::<30, 27>(f32::NAN), 0);
        assert_eq!(from_f32::<30, 27>(1e30), (i64::from(i32::MAX) << 27) + i64::from(i32::MAX));
    }

    #[test]
    fn numbers_come_back_to_single_precision() {
        for word in words(3).take(100_000) {
            let value = word as i64 >> (word % 64);
            let back = f64::from(to_f32::<57>(value)) * 57.0_f64.exp2();
            let off = i128::from(value) - back as i128;
            let bound = (value.unsigned_abs() >> 23).max(256);
            assert!(off.unsigned_abs() <= u128::from(bound), "{value}: {off}");
        }
    }

    /// A rounding error of constant sign would accumulate over steps.
    #[test]
    fn the_nearest_of_single_precision_takes_no_side() {
        let (mut sum, mut count) = (0_i128, 0_i128);
        for word in words(8).take(400_000) {
            // Magnitudes from a half to 1, 62 bits: one unit of 24 bits is 2^38 units.
            let magnitude = (word >> 3) as i64 | (1 << 61);
            let value = if word & 1 == 0 { magnitude } else { -magnitude };
            let off = (f64::from(nearest_f32::<62>(value)) * 62.0_f64.exp2()) as i128;
            let off = off - i128::from(value);
            assert!(off.unsigned_abs() <= (1 << 37) + (1 << 31), "{value}: {off}");
            (sum, count) = (sum + off, count + 1);
        }
        let mean = sum / count;
        assert!(mean.abs() < 1 << 30, "{mean}");
    }

    #[test]
    fn sums_of_squares_are_within_their_bounds_of_the_exact_ones() {
        let mut all = words(6);
        for _ in 0..100_000 {
            let v: [i64; 3] = core::array::from_fn(|_| {
                let word = all.next().unwrap();
                (word as i64 >> 2) >> (word & 31)
            });
            let exact: i128 = v.iter().map(|&c| i128::from(c) * i128::from(c)).sum();
            let off = (i128::from(squared(&v)) << 64) - exact;
            assert!(off.abs() < 3 << 64, "{v:?}: {off}");
        }
    }

    #[test]
    fn squares_of_lengths_are_cut_off() {
        for word in words(7).take(100_000) {
            let length = (word as f32 * single_power(-64)) * single_power((word % 10) as i32 - 5);
            // Exact: 2^-31 and its multiples.
            let length = (length * single_power(31)).floor() * single_power(-31);
            let exact = (f64::from(length) * 31.0_f64.exp2()) as i128;
            let off = (i128::from(square_of(length)) << 12) - exact * exact;
            assert!(off <= 0 && off > -1 << 12, "{length}: {off}");
        }
    }

    #[test]
    fn products_are_within_their_bounds_of_the_exact_ones() {
        let mut worst = [0_i128; 2];
        for (a, b) in words(4).zip(words(5)).take(1_000_000) {
            // Magnitudes up to 1.99.
            let [a, b] = [a, b].map(|word| ((word as i64) / 2) + ((word as i64) >> 3));
            let [a, b] = [a, b].map(|v| v >> (v & 15));
            let exact = i128::from(a) * i128::from(b);
            if exact.unsigned_abs() >> 124 > 0 {
                continue;
            }
            // 2^64 units of 2^-124 per unit of 2^-60.
            let off = (i128::from(product(a, b)) << 64) - exact;
            worst = [worst[0].min(off), worst[1].max(off)];
        }
        assert!(worst[0] > -3 << 64 && worst[1] < 1 << 64, "{worst:?}");
    }
}
