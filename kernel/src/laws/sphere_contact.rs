//! A sphere on a sphere: contact, sticking, sliding and rolling.
//!
//! Depth `x = r_A + r_B − |d| ↦ N = k·x·(1 + a·ẋ)` along the line of the centres, the law of [`super::DistanceStop`]. The
//! tangential spring is that of [`super::PlaneContact`] in the plane that touched both spheres at the boundary of a step;
//! a boundary projects its deflection onto the present plane, and limits its force to the cone `μ·N`.

use crate::force_pair::ForcePair;
use crate::geometry::Geometry;
use crate::laws::contact::{Held, Surface, Touching, vector};
use crate::laws::coordinate::Coordinate;
use crate::laws::end::Seen;
use crate::laws::interaction::{Damper, Interaction, Quantity, Springs, Wrong};
use crate::laws::stop::Stopped;
use crate::real::Real;
use crate::space::Linear;
use crate::words::{WordSource, WordVisitor, Words};

law! {
    /// A sphere or a point of the second body on a sphere or a point of the first body, with friction.
    pub struct SphereContact = "sphere-contact" {
        /// The centres of both spheres.
        points: Points,
        /// Radius of the first body's sphere; 0 is a point, at most one is 0.
        first_radius: Number("m"),
        /// Radius of the second body's sphere.
        second_radius: Number("m"),
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

/// The memory of two spheres: the points of contact and their plane.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub struct Facing<V> {
    /// The points of contact.
    pub held: Held<V>,
    /// \[1\] unit normal of the plane of contact, axes of A.
    pub normal: V,
}

impl<V: Linear> Words for Facing<V> {
    fn visit(&self, visitor: &mut impl WordVisitor) {
        self.held.visit(visitor);
        self.normal.in_space().visit(visitor);
    }
    fn fill(&mut self, source: &mut impl WordSource) {
        self.held.fill(source);
        self.normal = vector(source);
    }
}

/// Spheres at a pose.
struct Met<P: Geometry> {
    touching: Touching<P>,
    /// Unit vector from A's centre to B's, world.
    line: P::Vector,
}

impl<P: Geometry> SphereContact<P> {
    #[inline(always)]
    fn surface(&self) -> Surface<P::Real> {
        let Self { stiffness, dissipation, friction, shear, damping, rolling, .. } = *self;
        Surface { stiffness, dissipation, friction, shear, damping, rolling }
    }

    #[inline(always)]
    fn met(&self, seen: &Seen<'_, P>, memory: &Facing<P::Vector>) -> Met<P> {
        let ((at_a, arm), (at_b, other)) =
            (seen.a.place(&self.points[0]), seen.b.place(&self.points[1]));
        let way = P::displacement(&at_a, &at_b);
        let distance = Coordinate::<P>::between(way, [arm, other]);
        let line = way * distance.value.reciprocal_or_zero();
        let range = [self.first_radius + self.second_radius, P::Real::from_f64(1e30)];
        let stopped = Stopped::within(distance, range, [self.stiffness, P::Real::ZERO]);
        let mut normals = [line, memory.normal];
        if memory.held.touched {
            normals[0] = seen.a.to_world(memory.normal);
        }
        let ways = [arm, way, other];
        let touching = Touching::new(seen, self.surface(), stopped, normals, ways, &memory.held);
        Met { touching, line }
    }
}

impl<P: Geometry> Interaction<P> for SphereContact<P> {
    type State = Facing<P::Vector>;
    type Dampers = [(); 3];
    const SLIPS: bool = true;
    const KEEPS: bool = true;
    const QUANTITIES: &'static [Quantity] = &[
        Quantity { name: "depth", unit: "m" },
        Quantity { name: "force", unit: "N" },
        Quantity { name: "friction", unit: "N" },
    ];

    #[inline(always)]
    fn settle(&self, seen: &Seen<'_, P>, memory: &mut Facing<P::Vector>) {
        if !self.surface().is_rough() {
            return self.keep_pose(seen, memory);
        }
        let Met { touching, line } = self.met(seen, memory);
        if touching.stopped.beyond == P::Real::ZERO {
            *memory = Facing::default();
            memory.held.apart = true;
            return;
        }
        memory.held.apart = false;
        // The point of contact divides the distance as the radii.
        let part = self.second_radius / (self.first_radius + self.second_radius);
        let arm = seen.b.to_axes(-(line * (touching.stopped.coordinate.value * part)));
        let normal = seen.a.to_axes(line);
        let mut give = touching.give;
        let turned = normal != memory.normal;
        if turned {
            give = give - normal * normal.dot(give);
        }
        let (give, slides) = touching.within_cone(seen, give);
        if slides || turned || !memory.held.touched || arm != memory.held.arm {
            *memory = Facing { held: touching.hold(seen, arm, give), normal };
        }
    }

    #[inline(always)]
    fn keep_pose(&self, seen: &Seen<'_, P>, memory: &mut Facing<P::Vector>) {
        memory.held.apart = self.met(seen, memory).touching.stopped.beyond == P::Real::ZERO;
    }

    #[inline(always)]
    fn is_idle(&self, memory: &Facing<P::Vector>) -> bool {
        memory.held.apart
    }

    #[inline(always)]
    fn force_pair(
        &self,
        seen: &Seen<'_, P>,
        memory: &Facing<P::Vector>,
    ) -> Option<ForcePair<P::Space>> {
        let Met { touching, .. } = self.met(seen, memory);
        // Coincident centres have no direction for a force.
        let lost = touching.stopped.coordinate.value == P::Real::ZERO;
        (!lost).then(|| touching.force_pair(seen))
    }

    fn energy(&self, seen: &Seen<'_, P>, memory: &Facing<P::Vector>) -> P::Real {
        self.met(seen, memory).touching.energy()
    }

    fn tangent(
        &self,
        seen: &Seen<'_, P>,
        memory: &Facing<P::Vector>,
        visit: Springs<'_, P>,
    ) -> [P::Real; 2] {
        let Met { touching, .. } = self.met(seen, memory);
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
        memory: &Facing<P::Vector>,
        visit: &mut impl FnMut(Damper<P>),
    ) {
        if !self.surface().is_damped() {
            return (0..3).for_each(|_| visit(Damper::idle()));
        }
        self.met(seen, memory).touching.dampers(seen, None, visit);
    }

    fn turn(memory: &mut Facing<P::Vector>, turn: &mut dyn FnMut(usize, [f64; 3]) -> [f64; 3]) {
        memory.held.turn(turn);
        memory.normal = P::Vector::from_f64(turn(0, memory.normal.to_f64()));
    }

    fn check(&self) -> Result<(), Wrong> {
        let (zero, least) = (P::Real::ZERO, "a number ≥ 0");
        Wrong::unless(self.first_radius >= zero, "first_radius", "is negative", least)?;
        Wrong::unless(self.second_radius >= zero, "second_radius", "is negative", least)?;
        let met = self.first_radius + self.second_radius > zero;
        let expected = "above 0, or `first_radius`";
        Wrong::unless(met, "second_radius", "is 0 like `first_radius`", expected)?;
        self.surface().check()
    }

    fn read(&self, quantity: usize, seen: &Seen<'_, P>, memory: &Facing<P::Vector>) -> P::Real {
        let Met { touching, .. } = self.met(seen, memory);
        match quantity {
            0 => touching.stopped.depth(),
            1 => touching.pressed(seen),
            _ => touching.rubbed(),
        }
    }
}
