//! The stop of a coordinate: a spring with Hunt–Crossley damping beyond an end of its range.
//!
//! `(coordinate, x beyond its range, stiffness k, coefficient a) => tension k·x·(1 + a·|ẋ|)`, which never pulls towards
//! the end (Hunt & Crossley, J. Appl. Mech. 42 (1975) 440). A soft stop has the stiffness `k·x/s` in place of k up to the
//! depth s: its tension is `k·x²/(2·s)·(1 + a·|ẋ|)` there and `k·(x − s/2)·(1 + a·|ẋ|)` beyond, continuous with its slope.

use crate::force_pair::ForcePair;
use crate::geometry::Geometry;
use crate::laws::coordinate::Coordinate;
use crate::laws::end::Seen;
use crate::laws::interaction::{Damper, Springs, Wrong};
use crate::real::Real;

/// A coordinate at its stop, hard or soft.
pub(super) struct Stopped<P: Geometry, const SOFT: bool = false> {
    pub(super) coordinate: Coordinate<P>,
    /// \[m, rad\] the excess over the range: above 0 at its upper end, below 0 at its lower one, 0 within.
    pub(super) beyond: P::Real,
    stiffness: P::Real,
    /// \[m, rad\] s; unused by a hard stop.
    soft: P::Real,
}

impl<P: Geometry, const SOFT: bool> Stopped<P, SOFT> {
    /// For both ends of a range.
    #[inline(always)]
    pub(super) fn within(
        coordinate: Coordinate<P>,
        [from, to]: [P::Real; 2],
        [stiffness, soft]: [P::Real; 2],
    ) -> Self {
        let (above, below) = (coordinate.value - to, coordinate.value - from);
        let zero = P::Real::ZERO;
        let beyond = P::Real::pick(below.less_than(zero), below, zero);
        let beyond = P::Real::pick(zero.less_than(above), above, beyond);
        Self { coordinate, beyond, stiffness, soft }
    }

    /// \[N, N·m\] of its spring, with the sign of `beyond`.
    #[inline(always)]
    fn tension(&self) -> P::Real {
        if !SOFT {
            return self.stiffness * self.beyond;
        }
        let (part, ratio) = self.start();
        self.stiffness * (P::Real::HALF * (part * ratio.abs()) + (self.beyond - part))
    }

    /// The part of `beyond` within the soft start, and its ratio to s.
    #[inline(always)]
    fn start(&self) -> (P::Real, P::Real) {
        let (soft, beyond) = (self.soft, self.beyond);
        let part = P::Real::pick(soft.less_than(beyond), soft, beyond);
        let part = P::Real::pick(part.less_than(-soft), -soft, part);
        (part, part / soft)
    }

    /// The record of its spring.
    #[inline(always)]
    pub(super) fn force_pair(&self, seen: &Seen<'_, P>) -> ForcePair<P::Space> {
        if self.is_free() {
            return ForcePair::ZERO;
        }
        self.coordinate.pull(seen, self.tension())
    }

    /// \[J\]
    pub(super) fn energy(&self) -> P::Real {
        if !SOFT {
            return P::Real::HALF * (self.stiffness * (self.beyond * self.beyond));
        }
        let (part, ratio) = self.start();
        let third = P::Real::ONE / (P::Real::ONE + P::Real::TWO);
        let start = third * (part * part * ratio.abs());
        P::Real::HALF * (self.stiffness * (start + (self.beyond - part) * self.beyond))
    }

    /// As if it were in contact, beyond a soft start.
    pub(super) fn tangent(&self, seen: &Seen<'_, P>, visit: Springs<'_, P>) -> [P::Real; 2] {
        visit(self.stiffness, &self.coordinate.direction(seen));
        self.coordinate.bent(seen, self.tension().abs(), visit)
    }

    /// Its damper with the coefficient a \[s/m, s/rad\]: together with the spring it never pulls towards the end.
    #[inline(always)]
    pub(super) fn damper(&self, seen: &Seen<'_, P>, dissipation: P::Real) -> Damper<P> {
        if self.is_free() {
            return Damper::idle();
        }
        let (tension, zero) = (self.tension(), P::Real::ZERO);
        let damper = Damper::new(dissipation * tension.abs(), self.coordinate.direction(seen));
        let [least, most] = damper.bounds();
        let upper = zero.less_than(tension);
        damper.within(P::Real::pick(upper, -tension, least), P::Real::pick(upper, most, -tension))
    }

    /// Whether it is within its range; always `false` for lanes.
    #[inline(always)]
    pub(super) fn is_free(&self) -> bool {
        P::Real::ONE_LANE && self.beyond == P::Real::ZERO
    }

    /// \[m, rad\] the depth beyond the range.
    pub(super) fn depth(&self) -> P::Real {
        self.beyond.abs()
    }
}

/// Refuses invalid constants.
pub(super) fn check<R: Real>(
    [from, to]: [R; 2],
    stiffness: R,
    dissipation: R,
) -> Result<(), Wrong> {
    Wrong::unless(to > from, "to", "is not above `from`", "a number above `from`")?;
    Wrong::unless(stiffness > R::ZERO, "stiffness", "is not positive", "a stiffness > 0")?;
    Wrong::unless(dissipation >= R::ZERO, "dissipation", "is negative", "a number ≥ 0")
}

/// Refuses a soft start without a depth.
pub(super) fn check_soft<R: Real>(soft: R) -> Result<(), Wrong> {
    Wrong::unless(soft > R::ZERO, "soft", "is not positive", "a depth > 0")
}
