//! Springs and dampers of a coordinate, given by a function of it or of its rate.
//!
//! `(coordinate q, F) => tension F(q − rest)` with the area as energy, or a damper with the tension F of its rate. Such
//! a damper acts as its tangent at the initial rate r, `F(r) + F'(r)·(ṙ − r)`, so the order is 2, and at most stops the
//! rate, so it is stable at any step.

use crate::force_pair::{Direction, ForcePair};
use crate::geometry::Geometry;
use crate::laws::coordinate::Coordinate;
use crate::laws::curve::Curve;
use crate::laws::end::Seen;
use crate::laws::interaction::{Damper, Springs, Wrong};
use crate::real::Real;

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
    pub(super) fn force_pair(&self, seen: &Seen<'_, P>) -> ForcePair<P::Space> {
        self.coordinate.pull(seen, self.tension())
    }

    /// \[J\] 0 where the extension is 0.
    pub(super) fn energy(&self) -> P::Real {
        self.curve.area(self.extension()) - self.curve.area(P::Real::ZERO)
    }

    /// At its steepest slope.
    pub(super) fn tangent(&self, seen: &Seen<'_, P>, visit: Springs<'_, P>) -> [P::Real; 2] {
        visit(self.curve.steepest(), &self.coordinate.direction(seen));
        self.coordinate.bent(seen, self.tension().abs(), visit)
    }
}

/// Where a curve is flat, its damper uses this fraction of its secant as the coefficient: without a coefficient it
/// would be idle.
const LEAST_SLOPE: f64 = 1.0 / 1024.0;

/// The damper of a coordinate from its force over its rate.
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

/// \[m/s, rad/s\] below this a rate counts as 0.
const REST: f64 = 1e-9;

/// 1 over a rate; 0 at rest.
#[inline(always)]
pub(super) fn inverse_of_rate<R: Real>(rate: R) -> R {
    R::pick(rate.abs().less_than(R::from_f64(REST)), R::ZERO, rate).reciprocal_or_zero()
}

/// A damper with the tension F ≥ 0, independent of the rate.
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

/// Refuses a decreasing table of a spring.
pub(super) fn rising<R: Real, const N: usize>(
    curve: &Curve<R, N>,
    field: &'static str,
) -> Result<(), Wrong> {
    let mut pairs = curve.known().windows(2);
    let rises = pairs.all(|pair| matches!(pair, [before, after] if after[1] >= before[1]));
    Wrong::unless(rises, field, "decreases", "a non-decreasing table")
}

/// Refuses a table of a damper that decreases, or is not 0 at rest.
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
