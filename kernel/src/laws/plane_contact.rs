//! A sphere on a plane: contact, sticking, sliding and rolling.
//!
//! Depth `x ↦ N = k·x·(1 + a·ẋ)` along the normal, the law of [`super::EndStop`]. A tangential spring joins the points
//! of both surfaces that touched at the boundary of a step (Cundall & Strack, Géotechnique 29 (1979) 47): the bodies'
//! motion since then extends it, and a boundary limits its force to the cone `μ·N`, as [`super::Slip`] does, so it
//! dissipates energy at any step and holds without creep at rest. A moment `rolling·N` opposes the rolling.

use crate::force_pair::ForcePair;
use crate::geometry::Geometry;
use crate::laws::contact::{Held, Surface, Touching};
use crate::laws::coordinate::Coordinate;
use crate::laws::end::Seen;
use crate::laws::interaction::{Damper, Interaction, Quantity, Springs, Wrong};
use crate::laws::stop::Stopped;
use crate::real::Real;
use crate::space::Linear as _;

law! {
    /// A sphere or a point of the second body on a plane of the first body, with friction.
    pub struct PlaneContact = "plane-contact" {
        /// A point of the plane in the first body, the centre of the sphere in the second.
        points: Points,
        /// Normal of the plane, towards the side where the sphere is free.
        normal: Normal,
        /// Radius of the sphere; 0 is a point.
        radius: Number("m") = 0.0,
        /// Normal force per depth.
        stiffness: Number("N/m"),
        /// Hunt–Crossley coefficient a: the normal force is stiffness · depth · (1 + a · rate of the depth).
        dissipation: Number("s/m") = 0.0,
        /// Coefficient of dry friction: the largest tangential force over the normal force.
        friction: Number = 0.0,
        /// Tangential stiffness over `stiffness` while the contact sticks.
        shear: Number = 0.8,
        /// Damping of the tangential deflection; the tangential force with damping stays within the friction limit.
        damping: Number("N·s/m") = 0.0,
        /// Moment of rolling resistance over the normal force.
        rolling: Number("m") = 0.0,
    }
}

impl<P: Geometry> PlaneContact<P> {
    #[inline(always)]
    fn surface(&self) -> Surface<P::Real> {
        let Self { stiffness, dissipation, friction, shear, damping, rolling, .. } = *self;
        Surface { stiffness, dissipation, friction, shear, damping, rolling }
    }

    #[inline(always)]
    fn touching(&self, seen: &Seen<'_, P>, memory: &Held<P::Vector>) -> Touching<P> {
        let ((at_a, arm), (at_b, other)) =
            (seen.a.place(&self.points[0]), seen.b.place(&self.points[1]));
        let (way, normal) = (P::displacement(&at_a, &at_b), seen.a.to_world(self.normal));
        let ways = [arm, way, other];
        let travel = Coordinate::carried(normal.dot(way), normal, ways);
        let range = [self.radius, P::Real::from_f64(1e30)];
        let stopped = Stopped::within(travel, range, [self.stiffness, P::Real::ZERO]);
        Touching::new(seen, self.surface(), stopped, [normal, self.normal], ways, memory)
    }
}

impl<P: Geometry> Interaction<P> for PlaneContact<P> {
    type State = Held<P::Vector>;
    type Dampers = [(); 3];
    const SLIPS: bool = true;
    const KEEPS: bool = true;
    const QUANTITIES: &'static [Quantity] = &[
        Quantity { name: "depth", unit: "m" },
        Quantity { name: "force", unit: "N" },
        Quantity { name: "friction", unit: "N" },
    ];

    #[inline(always)]
    fn settle(&self, seen: &Seen<'_, P>, memory: &mut Held<P::Vector>) {
        if !self.surface().is_rough() {
            return self.keep_pose(seen, memory);
        }
        let touching = self.touching(seen, memory);
        if touching.stopped.beyond == P::Real::ZERO {
            *memory = Held::default();
            memory.apart = true;
            return;
        }
        memory.apart = false;
        // The height of the centre above the plane.
        let foot = -(touching.normal * touching.stopped.coordinate.value);
        let arm = seen.b.to_axes(foot);
        let (give, slides) = touching.within_cone(seen, touching.give);
        if slides || !memory.touched || arm != memory.arm {
            *memory = touching.hold(seen, arm, give);
        }
    }

    #[inline(always)]
    fn keep_pose(&self, seen: &Seen<'_, P>, memory: &mut Held<P::Vector>) {
        memory.apart = self.touching(seen, memory).stopped.beyond == P::Real::ZERO;
    }

    #[inline(always)]
    fn is_idle(&self, memory: &Held<P::Vector>) -> bool {
        memory.apart
    }

    #[inline(always)]
    fn force_pair(
        &self,
        seen: &Seen<'_, P>,
        memory: &Held<P::Vector>,
    ) -> Option<ForcePair<P::Space>> {
        Some(self.touching(seen, memory).force_pair(seen))
    }

    fn energy(&self, seen: &Seen<'_, P>, memory: &Held<P::Vector>) -> P::Real {
        self.touching(seen, memory).energy()
    }

    fn tangent(
        &self,
        seen: &Seen<'_, P>,
        memory: &Held<P::Vector>,
        visit: Springs<'_, P>,
    ) -> [P::Real; 2] {
        let touching = self.touching(seen, memory);
        let stop = touching.stopped.tangent(seen, visit);
        touching.tangent(seen, stop, visit)
    }

    #[inline(always)]
    fn is_damped(&self) -> bool {
        self.surface().is_damped()
    }

    #[inline(always)]
    fn dampers(
        &self,
        seen: &Seen<'_, P>,
        memory: &Held<P::Vector>,
        visit: &mut impl FnMut(Damper<P>),
    ) {
        if !self.surface().is_damped() {
            return (0..3).for_each(|_| visit(Damper::idle()));
        }
        self.touching(seen, memory).dampers(seen, None, visit);
    }

    fn turn(memory: &mut Held<P::Vector>, turn: &mut dyn FnMut(usize, [f64; 3]) -> [f64; 3]) {
        memory.turn(turn);
    }

    fn check(&self) -> Result<(), Wrong> {
        let holds = self.radius >= P::Real::ZERO;
        Wrong::unless(holds, "radius", "is negative", "a number ≥ 0")?;
        self.surface().check()
    }

    fn read(&self, quantity: usize, seen: &Seen<'_, P>, memory: &Held<P::Vector>) -> P::Real {
        let touching = self.touching(seen, memory);
        match quantity {
            0 => touching.stopped.depth(),
            1 => touching.pressed(seen),
            _ => touching.rubbed(),
        }
    }
}
