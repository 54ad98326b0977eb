//! A function of one number by its knots, straight between them; springs and dampers of a coordinate by such functions.
//!
//! `(coordinate q, F) => tension F(q − rest)` with the area as energy, or a damper with the tension F of its rate. Such a
//! damper acts as its tangent at the rate r where it begins, `F(r) + F'(r)·(ṙ − r)`, so the order is 2, and takes no more
//! than all of the rate, so that no step is too long.

use crate::geometry::Geometry;
use crate::laws::coordinate::Coordinate;
use crate::laws::end::Seen;
use crate::laws::interaction::{Damper, Springs, Wrong};
use crate::real::Real;
use crate::record::{Direction, Record};

/// Knots `[x, y]` with ascending x; before the first and after the last it goes on straight.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Curve<R, const N: usize> {
    /// \[units of the table\] the knots; those beyond [`Self::count`] are unused.
    pub knots: [[R; 2]; N],
    /// How many there are, at least 2.
    pub count: u16,
}

impl<R: Real, const N: usize> Curve<R, N> {
    /// The knots that mean something.
    #[inline(always)]
    #[must_use]
    pub fn known(&self) -> &[[R; 2]] {
        self.knots.get(..usize::from(self.count)).unwrap_or(&self.knots)
    }

    /// The value and the slope at x. The cost is that of all knots, wherever x is.
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
            let here = if row == 0 { R::truth(true) } else { a[0].at_most(x) };
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

/// A spring of a coordinate.
pub(super) struct Spring<'c, P: Geometry, const N: usize> {
    pub(super) coordinate: Coordinate<P>,
    /// \[m, rad\] the coordinate at which the curve is at 0.
    pub(super) rest: P::Real,
    pub(super) curve: &'c Curve<P::Real, N>,
}

impl<P: Geometry, const N: usize> Spring<'_, P, N> {
    #[inline(always)]
    fn extension(&self) -> P::Real {
        self.coordinate.value - self.rest
    }

    /// \[N, N·m\]
    #[inline(always)]
    pub(super) fn tension(&self) -> P::Real {
        self.curve.at(self.extension()).0
    }

    #[inline(always)]
    pub(super) fn record(&self, seen: &Seen<'_, P>) -> Record<P::Space> {
        seen.pull(&self.coordinate.direction(seen), self.tension())
    }

    /// \[J\] 0 where the extension is 0.
    pub(super) fn energy(&self) -> P::Real {
        self.curve.area(self.extension()) - self.curve.area(P::Real::ZERO)
    }

    /// As if it were where it is steepest.
    pub(super) fn tangent(&self, seen: &Seen<'_, P>, visit: Springs<'_, P>) -> [P::Real; 2] {
        visit(self.curve.steepest(), &self.coordinate.direction(seen));
        self.coordinate.bent(seen, self.tension().abs(), visit)
    }
}

/// Where a curve is flat, its damper has this share of its secant as the coefficient: one without a coefficient is idle.
const LEAST_SLOPE: f64 = 1.0 / 1024.0;

/// The damper of a coordinate by its force over its rate.
#[inline(always)]
pub(super) fn brake<P: Geometry, const N: usize>(
    seen: &Seen<'_, P>,
    coordinate: &Coordinate<P>,
    curve: &Curve<P::Real, N>,
) -> Damper<P> {
    let direction = coordinate.direction(seen);
    let rate = seen.rate(&direction);
    let (tension, slope) = curve.at(rate);
    let least = tension * P::Real::from_f64(LEAST_SLOPE) * inverse_of_rate(rate);
    let coefficient = P::Real::pick(slope.less_than(least), least, slope);
    let towards = rate - tension * coefficient.reciprocal_or_zero();
    Damper::new(coefficient, direction).towards(towards).braking()
}

/// \[m/s, rad/s\] below this a rate is rest.
const REST: f64 = 1e-9;

/// 1 over a rate; 0 at rest.
#[inline(always)]
pub(super) fn inverse_of_rate<R: Real>(rate: R) -> R {
    R::pick(rate.abs().less_than(R::from_f64(REST)), R::ZERO, rate).reciprocal_or_zero()
}

/// A damper that takes the tension F ≥ 0 from a rate, whatever that is.
#[inline(always)]
pub(super) fn drag<P: Geometry>(
    direction: Direction<P::Space>,
    rate: P::Real,
    tension: P::Real,
) -> Damper<P> {
    let coefficient = tension * P::Real::from_f64(LEAST_SLOPE) * inverse_of_rate(rate);
    let towards = rate - rate * P::Real::from_f64(1.0 / LEAST_SLOPE);
    Damper::new(coefficient, direction).towards(towards).braking()
}

/// Refuses a spring's table that falls.
pub(super) fn rising<R: Real, const N: usize>(
    curve: &Curve<R, N>,
    field: &'static str,
) -> Result<(), Wrong> {
    let mut pairs = curve.known().windows(2);
    let rises = pairs.all(|pair| matches!(pair, [before, after] if after[1] >= before[1]));
    Wrong::unless(rises, field, "falls", "a table that never falls")
}

/// Refuses a damper's table that falls, or is not 0 at rest.
pub(super) fn braking<R: Real, const N: usize>(
    curve: &Curve<R, N>,
    field: &'static str,
) -> Result<(), Wrong> {
    rising(curve, field)?;
    let most = curve.known().iter().fold(R::ZERO, |most, [_, y]| {
        let y = y.abs();
        R::pick(most.less_than(y), y, most)
    });
    let at_rest = curve.at(R::ZERO).0.abs() <= most * R::from_f64(1e-9);
    Wrong::unless(at_rest, field, "is not 0 at rest", "a table through [0, 0]")
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
