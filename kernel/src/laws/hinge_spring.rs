//! A spring about an axis with a table of torque over angle: progressive, one-sided, with a dead zone.
//!
//! Torsion angle `θ ↦ torque T(θ)` against it, along the angle's gradient; its energy is the area.

use crate::force_pair::ForcePair;
use crate::geometry::Geometry;
use crate::laws::coordinate::Coordinate;
use crate::laws::end::Seen;
use crate::laws::hinge::Turns;
use crate::laws::interaction::{Interaction, Quantity, Springs, Wrong};
use crate::laws::tabled::{Spring, rising};
use crate::real::Real;

law! {
    /// A spring about an axis with a table of torque over angle: progressive, one-sided, with a dead zone.
    pub struct HingeSpring = "hinge-spring" {
        /// Axis of rotation; the angle is 0 at t = 0 and includes whole revolutions.
        axis: Axis,
        /// Torque against the angle, non-decreasing; extrapolated linearly beyond the first and the last knot.
        torque: Table<16>("rad", "N·m"),
    }
}

impl<P: Geometry> HingeSpring<P> {
    #[inline(always)]
    fn spring(&self, seen: &Seen<'_, P>, turns: Turns) -> Option<Spring<'_, P, 16>> {
        let coordinate = Coordinate::turn(seen, &self.axis, turns)?;
        Some(Spring { coordinate, rest: P::Real::ZERO, curve: &self.torque })
    }
}

impl<P: Geometry> Interaction<P> for HingeSpring<P> {
    type State = Turns;
    type Dampers = [(); 0];
    const QUANTITIES: &'static [Quantity] = &[Quantity { name: "torque", unit: "N·m" }];

    #[inline(always)]
    fn settle(&self, seen: &Seen<'_, P>, turns: &mut Turns) {
        if let Some(torsion_angle) = self.axis.seen(seen) {
            torsion_angle.settle(turns);
        }
    }

    #[inline(always)]
    fn force_pair(&self, seen: &Seen<'_, P>, turns: &Turns) -> Option<ForcePair<P::Space>> {
        Some(self.spring(seen, *turns)?.force_pair(seen))
    }

    fn energy(&self, seen: &Seen<'_, P>, turns: &Turns) -> P::Real {
        self.spring(seen, *turns).map_or(P::Real::ZERO, |spring| spring.energy())
    }

    fn tangent(&self, seen: &Seen<'_, P>, turns: &Turns, visit: Springs<'_, P>) -> [P::Real; 2] {
        let Some(spring) = self.spring(seen, *turns) else { return [P::Real::ZERO; 2] };
        spring.tangent(seen, visit)
    }

    fn check(&self) -> Result<(), Wrong> {
        rising(&self.torque, "torque")
    }

    fn read(&self, _: usize, seen: &Seen<'_, P>, turns: &Turns) -> P::Real {
        self.spring(seen, *turns).map_or(P::Real::ZERO, |spring| spring.tension())
    }
}
