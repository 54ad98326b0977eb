//! A piecewise linear function of one number.

use crate::real::Real;

/// Knots `[x, y]` with ascending x, extrapolated linearly before the first and after the last.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Curve<R, const N: usize> {
    /// \[units of the table\] the knots; those beyond [`Self::count`] are unused.
    pub knots: [[R; 2]; N],
    /// Their number, at least 2.
    pub count: u16,
}

impl<R: Real, const N: usize> Curve<R, N> {
    /// The used knots.
    #[inline(always)]
    #[must_use]
    pub fn known(&self) -> &[[R; 2]] {
        self.knots.get(..usize::from(self.count)).unwrap_or(&self.knots)
    }

    /// The value and the slope at x. The cost is independent of x.
    #[inline(always)]
    #[must_use]
    pub fn at(&self, x: R) -> (R, R) {
        let ([x0, y0], [x1, y1], _) = self.piece(x);
        let rise = (y1 - y0) / (x1 - x0);
        (y0 + rise * (x - x0), rise)
    }

    /// The integral from the first knot to x.
    #[inline(always)]
    #[must_use]
    pub fn area(&self, x: R) -> R {
        let ([x0, y0], [x1, y1], before) = self.piece(x);
        let (rise, way) = ((y1 - y0) / (x1 - x0), x - x0);
        before + way * (y0 + R::HALF * (rise * way))
    }

    /// The knots on both sides of x, and the integral up to the first of them.
    #[inline(always)]
    fn piece(&self, x: R) -> ([R; 2], [R; 2], R) {
        let (mut from, mut to) = ([R::ZERO; 2], [R::ONE, R::ZERO]);
        let (mut before, mut area) = (R::ZERO, R::ZERO);
        for (row, pair) in self.known().windows(2).enumerate() {
            let &[a, b] = pair else { continue };
            let here = if row == 0 { R::mask(true) } else { a[0].at_most(x) };
            let pick = |then: [R; 2], otherwise: [R; 2]| {
                [R::pick(here, then[0], otherwise[0]), R::pick(here, then[1], otherwise[1])]
            };
            (from, to) = (pick(a, from), pick(b, to));
            before = R::pick(here, area, before);
            area = area + (b[0] - a[0]) * (R::HALF * (a[1] + b[1]));
        }
        (from, to, before)
    }

    /// The steepest of its slopes by magnitude.
    #[inline]
    #[must_use]
    pub fn steepest(&self) -> R {
        self.known().windows(2).fold(R::ZERO, |most, pair| {
            let &[[x0, y0], [x1, y1]] = pair else { return most };
            let rise = ((y1 - y0) / (x1 - x0)).abs();
            R::pick(most.less_than(rise), rise, most)
        })
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_curve_is_straight_between_its_knots_and_beyond_them() {
        let curve = Curve { knots: [[-1.0, 2.0], [0.0, 0.0], [2.0, 1.0], [0.0, 0.0]], count: 3 };
        for (x, value, slope) in [
            (-3.0, 6.0, -2.0),
            (-0.5, 1.0, -2.0),
            (0.0, 0.0, 0.5),
            (1.0, 0.5, 0.5),
            (4.0, 2.0, 0.5),
        ] {
            assert_eq!(curve.at(x), (value, slope), "{x}");
        }
        assert_eq!(curve.area(0.0), 1.0);
        assert_eq!(curve.area(2.0), 2.0);
        assert_eq!(curve.area(-1.0), 0.0);
        assert_eq!(curve.steepest(), 2.0);
        // The slope of the area is the value.
        for x in [-2.0, -0.7, 0.3, 1.9, 5.0] {
            let h = 1e-5;
            let slope = (curve.area(x + h) - curve.area(x - h)) / (2.0 * h);
            assert!((slope - curve.at(x).0).abs() < 1e-9, "{x}");
        }
    }
}
