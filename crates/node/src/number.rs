//! Conversion of a plant's numbers to integers for registers.
//!
//! `x => nearest integer, x rounded down`.

use dbd_kernel::Real;
use dbd_kernel::chain::rounded;

/// A number that a sensor can turn into counts.
pub trait Number: Real {
    /// The nearest integer, ties to even; saturates, 0 for NaN.
    fn nearest(self) -> i32;

    /// The largest integer not above; saturates, 0 for NaN.
    #[inline(always)]
    fn whole_below(self) -> i32 {
        let whole = self.nearest();
        if Self::from_i32(whole) > self { whole.saturating_sub(1) } else { whole }
    }
}

impl Number for f32 {
    #[inline(always)]
    fn nearest(self) -> i32 {
        rounded(self) as i32
    }
}

impl Number for f64 {
    #[inline(always)]
    fn nearest(self) -> i32 {
        rounded(self) as i32
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn whole_numbers_are_the_nearest_and_the_lower() {
        for (x, nearest, floor) in [
            (0.0, 0, 0),
            (0.5, 0, 0),
            (1.5, 2, 1),
            (2.5, 2, 2),
            (-0.5, 0, -1),
            (-1.5, -2, -2),
            (0.75, 1, 0),
            (-0.25, 0, -1),
            (4_194_303.5, 4_194_304, 4_194_303),
            (8_388_607.0, 8_388_607, 8_388_607),
            (-16_777_216.0, -16_777_216, -16_777_216),
            (1e12, i32::MAX, i32::MAX),
            (-1e12, i32::MIN, i32::MIN),
            (f64::NAN, 0, 0),
            (f64::INFINITY, i32::MAX, i32::MAX),
        ] {
            assert_eq!((x.nearest(), x.whole_below()), (nearest, floor), "{x}");
            let single = x as f32;
            assert_eq!((single.nearest(), single.whole_below()), (nearest, floor), "{x}");
        }
        // The number just below one half, which adding one half would round up.
        assert_eq!(0.499_999_97_f32.nearest(), 0);
        assert_eq!(0.499_999_999_999_999_94_f64.nearest(), 0);
    }
}
