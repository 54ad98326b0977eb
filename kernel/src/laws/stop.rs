//! The stop of a coordinate: a spring with Hunt–Crossley damping beyond an end of its range.
//!
//! `(coordinate, x beyond its range, stiffness k, coefficient a) => tension k·x·(1 + a·|ẋ|)`, which never pulls towards
//! the end (Hunt & Crossley, J. Appl. Mech. 42 (1975) 440).

use crate::force_pair::ForcePair;
use crate::geometry::Geometry;
use crate::laws::coordinate::Coordinate;
use crate::laws::end::Seen;
use crate::laws::interaction::{Damper, Springs, Wrong};
use crate::real::Real;

/// A coordinate at its stop.
pub(super) struct Stopped<P: Geometry> {
    pub(super) coordinate: Coordinate<P>,
    /// \[m, rad\] the excess over the range: above 0 at its upper end, below 0 at its lower one, 0 within.
    pub(super) beyond: P::Real,
    stiffness: P::Real,
}

impl<P: Geometry> Stopped<P> {
    /// For both ends of a range.
    #[inline(always)]
    pub(super) fn within(
        coordinate: Coordinate<P>,
        [from, to]: [P::Real; 2],
        stiffness: P::Real,
    ) -> Self {
        let (above, below) = (coordinate.value - to, coordinate.value - from);
        let zero = P::Real::ZERO;
        let beyond = P::Real::pick(below.less_than(zero), below, zero);
        let beyond = P::Real::pick(zero.less_than(above), above, beyond);
        Self { coordinate, beyond, stiffness }
    }

    /// The record of its spring.
    #[inline(always)]
    pub(super) fn force_pair(&self, seen: &Seen<'_, P>) -> ForcePair<P::Space> {
        if self.is_free() {
            return ForcePair::ZERO;
        }
        seen.pull(&self.coordinate.direction(seen), self.stiffness * self.beyond)
    }

    /// \[J\]
    pub(super) fn energy(&self) -> P::Real {
        P::Real::HALF * (self.stiffness * (self.beyond * self.beyond))
    }

    /// As if it were in contact.
    pub(super) fn tangent(&self, seen: &Seen<'_, P>, visit: Springs<'_, P>) -> [P::Real; 2] {
        visit(self.stiffness, &self.coordinate.direction(seen));
        self.coordinate.bent(seen, (self.stiffness * self.beyond).abs(), visit)
    }

    /// Its damper with the coefficient a \[s/m, s/rad\]: together with the spring it never pulls towards the end.
    #[inline(always)]
    pub(super) fn damper(&self, seen: &Seen<'_, P>, dissipation: P::Real) -> Damper<P> {
        if self.is_free() {
            return Damper::idle();
        }
        let (tension, zero) = (self.stiffness * self.beyond, P::Real::ZERO);
        let damper = Damper::new(dissipation * tension.abs(), self.coordinate.direction(seen));
        let [least, most] = damper.bounds();
        let upper = zero.less_than(tension);
        damper.within(P::Real::pick(upper, -tension, least), P::Real::pick(upper, most, -tension))
    }

    /// Whether it is within its range; always `false` for lanes.
    #[inline(always)]
    fn is_free(&self) -> bool {
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
