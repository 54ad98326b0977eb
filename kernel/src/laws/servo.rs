//! The effort of a motor with its inner loop on a coordinate.
//!
//! `(input u, position y, rate v) => effort τ = gain·u + d·(r₀ − v)`, within ±most, `r₀ = feed·u`, with a stiffness p
//! `r₀ = u̇ + p/d·(u − y)`: a torque, a voltage at a winding without inductance (`d = K²/R`, `feed = 1/K`; Krishnan
//! 2001, ch. 2), a servo of velocity or position. The bound applies to the sum, and d does not limit the step.

use crate::geometry::Geometry;
use crate::laws::coordinate::Coordinate;
use crate::laws::end::Seen;
use crate::laws::interaction::{Damper, Springs, Wrong};
use crate::real::Real;
use crate::schedule::Signal;

/// The constants of an effort, in N, m or N·m, rad.
#[derive(Clone, Copy)]
pub(super) struct Effort<R> {
    /// Effort per unit of the input.
    pub(super) gain: R,
    /// p.
    pub(super) stiffness: R,
    /// d.
    pub(super) damping: R,
    /// Rate per unit of the input.
    pub(super) feed: R,
    pub(super) most: R,
}

impl<R: Real> Effort<R> {
    /// Refuses invalid constants.
    pub(super) fn check(&self) -> Result<(), Wrong> {
        let zero = R::ZERO;
        let not_negative =
            |number: R, field| Wrong::unless(number >= zero, field, "is negative", "a number ≥ 0");
        not_negative(self.stiffness, "servo_stiffness")?;
        not_negative(self.damping, "servo_damping")?;
        let damped = self.damping > zero || self.stiffness == zero;
        Wrong::unless(damped, "servo_damping", "is 0 with a stiffness", "a number > 0")?;
        Wrong::unless(self.most > zero, "most", "is not positive", "a number > 0")
    }

    /// r₀.
    #[inline(always)]
    pub(super) fn towards(&self, signal: Signal<R>, place: R) -> R {
        let rate = self.feed * signal.value;
        if self.stiffness == R::ZERO {
            return rate;
        }
        rate + signal.rate + self.stiffness / self.damping * (signal.value - place)
    }

    /// The effort clamped to its bounds.
    #[inline(always)]
    pub(super) fn bounded(&self, effort: R) -> R {
        let effort = R::pick(self.most.less_than(effort), self.most, effort);
        R::pick(effort.less_than(-self.most), -self.most, effort)
    }
}

/// A coordinate that a servo drives.
pub(super) struct Servo<P: Geometry> {
    coordinate: Coordinate<P>,
    effort: Effort<P::Real>,
    towards: P::Real,
}

impl<P: Geometry> Servo<P> {
    #[inline(always)]
    pub(super) fn new(
        coordinate: Coordinate<P>,
        effort: Effort<P::Real>,
        signal: Signal<P::Real>,
    ) -> Self {
        let towards = effort.towards(signal, coordinate.value);
        Self { coordinate, effort, towards }
    }

    #[inline(always)]
    pub(super) fn damper(&self, seen: &Seen<'_, P>) -> Damper<P> {
        let damper = Damper::new(self.effort.damping, self.coordinate.direction(seen));
        damper.towards(self.towards).within(-self.effort.most, self.effort.most)
    }

    /// The tangent of its stiffness, and of the effort that rotates with the bodies.
    pub(super) fn tangent(&self, seen: &Seen<'_, P>, visit: Springs<'_, P>) -> [P::Real; 2] {
        visit(self.effort.stiffness, &self.coordinate.direction(seen));
        self.coordinate.bent(seen, self.effort(seen).abs(), visit)
    }

    /// \[N, N·m\] its effort along the coordinate.
    pub(super) fn effort(&self, seen: &Seen<'_, P>) -> P::Real {
        let damper = self.damper(seen);
        -damper.tension(seen.rate(&damper.direction))
    }
}
