//! A spring and damper between two points whose free length is an input: a winch, a leadscrew, an air spring.
//!
//! Distance `|d|`, free length L with its rate `L̇` ↦ extension `x = |d| − L`, tension `k·x + c·ẋ`. One-sided, as a rope,
//! it has no tension on the other side, and its damper never turns the tension around. The input's power is
//! `−tension·L̇`.

use crate::force_pair::ForcePair;
use crate::geometry::Geometry;
use crate::laws::coordinate::Coordinate;
use crate::laws::coupling::sides;
use crate::laws::end::Seen;
use crate::laws::interaction::{Damper, Interaction, NoStorage, Quantity, Springs, Wrong};
use crate::real::Real;
use crate::schedule::Signal;

law! {
    /// A spring and damper between two points whose free length is an input: a winch, a leadscrew, an air spring.
    pub struct DistanceWinch = "distance-winch" {
        /// A point of the first body and one of the second.
        points: Points,
        /// Input of the free length.
        input: Signal,
        /// Tension per extension.
        stiffness: Number("N/m"),
        /// Tension per rate of the extension.
        damping: Number("N·s/m") = 0.0,
        /// 1, or 0 where it does not pull: it is free when longer than its free length.
        pulls: Number = 1.0,
        /// 1, or 0 where it does not push, like a rope: it is free when shorter than its free length.
        pushes: Number = 1.0,
    }
}

/// The spring at a pose.
struct Wound<P: Geometry> {
    coordinate: Coordinate<P>,
    /// \[m\] L and its rate.
    length: Signal<P::Real>,
    /// \[m\] the part of the extension that has tension.
    deformation: P::Real,
    /// \[N\] its tension.
    tension: P::Real,
}

impl<P: Geometry> DistanceWinch<P> {
    #[inline(always)]
    fn wound(&self, seen: &Seen<'_, P>) -> Wound<P> {
        let coordinate = Coordinate::distance(seen, &self.points);
        let length = seen.signal(self.input);
        let (extension, zero) = (coordinate.value - length.value, P::Real::ZERO);
        let side = P::Real::pick(extension.less_than(zero), self.pushes, self.pulls);
        let deformation = side * extension;
        let tension = self.stiffness * deformation;
        Wound { coordinate, length, deformation, tension }
    }

    /// Whether it may become slack.
    #[inline(always)]
    fn parts(&self) -> bool {
        self.pulls == P::Real::ZERO || self.pushes == P::Real::ZERO
    }

    #[inline(always)]
    fn damper(&self, seen: &Seen<'_, P>, wound: &Wound<P>) -> Damper<P> {
        let (tension, zero) = (wound.tension, P::Real::ZERO);
        if !Interaction::<P>::is_damped(self) {
            return Damper::idle();
        }
        let damper = Damper::new(self.damping, wound.coordinate.direction(seen));
        let damper = damper.towards(wound.length.rate);
        if !self.parts() {
            return damper;
        }
        // Slack it has the bounds [0, 0].
        let [least, most] = damper.bounds();
        let (pulls, pushes) = (zero.less_than(tension), tension.less_than(zero));
        damper.within(P::Real::pick(pushes, least, -tension), P::Real::pick(pulls, most, -tension))
    }
}

impl<P: Geometry> Interaction<P> for DistanceWinch<P> {
    type State = NoStorage;
    type Dampers = [(); 1];
    const DRIVEN: bool = true;
    const QUANTITIES: &'static [Quantity] =
        &[Quantity { name: "tension", unit: "N" }, Quantity { name: "extension", unit: "m" }];

    #[inline(always)]
    fn force_pair(&self, seen: &Seen<'_, P>, _: &NoStorage) -> Option<ForcePair<P::Space>> {
        let Wound { coordinate, tension, .. } = self.wound(seen);
        // Coincident points have no direction for a force.
        let lost = coordinate.value == P::Real::ZERO && tension != P::Real::ZERO;
        (!lost).then(|| coordinate.pull(seen, tension))
    }

    fn energy(&self, seen: &Seen<'_, P>, _: &NoStorage) -> P::Real {
        let wound = self.wound(seen);
        P::Real::HALF * (wound.tension * wound.deformation)
    }

    /// As if it were taut.
    fn tangent(&self, seen: &Seen<'_, P>, _: &NoStorage, visit: Springs<'_, P>) -> [P::Real; 2] {
        let Wound { coordinate, tension, .. } = self.wound(seen);
        visit(self.stiffness, &coordinate.direction(seen));
        coordinate.bent(seen, tension.abs(), visit)
    }

    #[inline(always)]
    fn is_damped(&self) -> bool {
        self.damping != P::Real::ZERO
    }

    #[inline(always)]
    fn dampers(&self, seen: &Seen<'_, P>, _: &NoStorage, visit: &mut impl FnMut(Damper<P>)) {
        visit(self.damper(seen, &self.wound(seen)));
    }

    /// Of its spring; that of its damper follows from [`Self::driven_rate`].
    fn supply(&self, seen: &Seen<'_, P>, _: &NoStorage) -> P::Real {
        let wound = self.wound(seen);
        -(wound.tension * wound.length.rate)
    }

    fn driven_rate(&self, seen: &Seen<'_, P>) -> P::Real {
        seen.signal(self.input).rate
    }

    fn check(&self) -> Result<(), Wrong> {
        let zero = P::Real::ZERO;
        Wrong::unless(self.stiffness > zero, "stiffness", "is not positive", "a stiffness > 0")?;
        Wrong::unless(self.damping >= zero, "damping", "is negative", "a number ≥ 0")?;
        sides(self.pulls, self.pushes)
    }

    fn read(&self, quantity: usize, seen: &Seen<'_, P>, _: &NoStorage) -> P::Real {
        let wound = self.wound(seen);
        if quantity > 0 {
            return wound.coordinate.value - wound.length.value;
        }
        let damper = self.damper(seen, &wound);
        wound.tension + damper.tension(seen.rate(&damper.direction))
    }
}
