//! End stop: a point of B against a plane of A.
//!
//! Depth `x = −n·d ↦ F = k·x·(1 + a·ẋ)` along the plane's normal n where x > 0 (Hunt & Crossley, J. Appl. Mech. 42
//! (1975) 440, with exponent 1). The spring is a force with the energy `½·k·x²`; the rest is a damper `a·k·x` whose
//! tension never exceeds the spring's: it never pulls.

use crate::geometry::Geometry;
use crate::laws::end::Seen;
use crate::laws::interaction::{Damper, Interaction, Nothing, Quantity, Springs, Wrong};
use crate::real::Real;
use crate::record::Direction;
use crate::record::Record;
use crate::space::Linear as _;

law! {
    /// A point of the second body that a plane of the first one stops.
    pub struct EndStop = "end-stop" {
        /// A point of the plane and the point that it stops.
        points: Points,
        /// Normal of the plane, towards the free side.
        normal: Normal,
        /// Force per depth.
        stiffness: Number("N/m"),
        /// Hunt–Crossley coefficient a: the force is stiffness · depth · (1 + a · rate of the depth).
        dissipation: Number("s/m") = 0.0,
    }
}

struct Contact<P: Geometry> {
    direction: Direction<P::Space>,
    arms: [P::Vector; 2],
    /// \[m\] from A's point to B's.
    way: P::Vector,
    /// \[m\] 0 where they do not touch.
    depth: P::Real,
}

impl<P: Geometry> EndStop<P> {
    #[inline(always)]
    fn contact(&self, seen: &Seen<'_, P>) -> Contact<P> {
        let ((at_a, arm_a), (at_b, arm_b)) =
            (seen.a.place(&self.points[0]), seen.b.place(&self.points[1]));
        let (way, normal) = (P::displacement(&at_a, &at_b), seen.a.to_world(self.normal));
        let zero = P::Real::ZERO;
        let depth = -normal.dot(way);
        let depth = P::Real::pick(zero.less_than(depth), depth, zero);
        // The force on A acts where B's point is: both then lie on one line.
        let direction = seen.along(normal, [seen.a.arm_at(arm_a, way), arm_b]);
        Contact { direction, arms: [arm_a, arm_b], way, depth }
    }
}

impl<P: Geometry> Interaction<P> for EndStop<P> {
    type State = Nothing;
    type Dampers = [(); 1];
    const QUANTITIES: &'static [Quantity] = &[Quantity { name: "depth", unit: "m" }];

    #[inline(always)]
    fn record(&self, seen: &Seen<'_, P>, _: &Nothing) -> Option<Record<P::Space>> {
        let Contact { direction, depth, .. } = self.contact(seen);
        Some(seen.pull(&direction, -(self.stiffness * depth)))
    }

    fn energy(&self, seen: &Seen<'_, P>, _: &Nothing) -> P::Real {
        let depth = self.contact(seen).depth;
        P::Real::HALF * (self.stiffness * (depth * depth))
    }

    /// As if it touched.
    fn tangent(&self, seen: &Seen<'_, P>, _: &Nothing, visit: Springs<'_, P>) -> [P::Real; 2] {
        let Contact { direction, arms: [arm, other], way, depth } = self.contact(seen);
        visit(self.stiffness, &direction);
        // The normal turns with A. Of the force F, the arm r of A's point and the way d to B's, a move ξ and a turn φ
        // of A meet 2·F·|φ|·|ξ| + F·(3·|r| + |d|)·φ² at most, and 2·|φ|·|ξ| ≤ ξ²/l + l·φ².
        let force = self.stiffness * depth;
        let [arm, far, other] = [arm, way, other].map(|v| v.dot(v).sqrt());
        let length = arm + far;
        let across = force * length.reciprocal_or_zero();
        for axis in P::Vector::axes() {
            visit(across, &Direction { along: axis, moments: [P::Moment::ZERO; 2] });
        }
        let three = P::Real::ONE + P::Real::TWO;
        [force * (three * arm + far + length), force * other]
    }

    #[inline(always)]
    fn dampers(&self, seen: &Seen<'_, P>, _: &Nothing, visit: &mut impl FnMut(Damper<P>)) {
        let Contact { direction, depth, .. } = self.contact(seen);
        let force = self.stiffness * depth;
        let damper = Damper::new(self.dissipation * force, direction);
        let least = damper.bounds()[0];
        visit(damper.within(least, force));
    }

    fn check(&self) -> Result<(), Wrong> {
        let zero = P::Real::ZERO;
        Wrong::unless(self.stiffness > zero, "stiffness", "is not positive", "a stiffness > 0")?;
        Wrong::unless(self.dissipation >= zero, "dissipation", "is negative", "a number ≥ 0")
    }

    fn read(&self, _: usize, seen: &Seen<'_, P>, _: &Nothing) -> P::Real {
        self.contact(seen).depth
    }
}
