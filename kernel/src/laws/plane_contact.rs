//! A sphere on a plane: contact, sticking, sliding and rolling.
//!
//! Depth `x ↦ N = k·x·(1 + a·ẋ)` along the normal, the law of [`super::EndStop`]. A tangential spring joins the points
//! of both surfaces that touched at the boundary of a step (Cundall & Strack, Géotechnique 29 (1979) 47): the bodies'
//! motion since then extends it, and a boundary limits its force to the cone `μ·N`, as [`super::Slip`] does, so it
//! dissipates energy at any step and holds without creep at rest. A moment `rolling·N` opposes the rolling.

use crate::force_pair::ForcePair;
use crate::geometry::Geometry;
use crate::laws::coordinate::Coordinate;
use crate::laws::end::Seen;
use crate::laws::interaction::{Damper, Interaction, Quantity, Springs, Wrong};
use crate::laws::stop::{Stopped, check};
use crate::laws::tabled::{drag, inverse_of_rate};
use crate::real::Real;
use crate::space::{Linear, Moment as _, Vector as _};
use crate::vector::Vec3;
use crate::words::{Word, WordSource, WordVisitor, Words};

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

/// The memory of a contact: the points of contact.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub struct Held<V> {
    /// \[m\] the point of A at which the tangential force is 0, from the plane's point, axes of A.
    pub anchor: V,
    /// \[m\] the point of B, from the sphere's centre, axes of B.
    pub arm: V,
    /// Whether the bodies are in contact.
    pub touched: bool,
}

// Planar vectors have three words, too: memories are read in spatial form.
impl<V: Linear> Words for Held<V> {
    fn visit(&self, visitor: &mut impl WordVisitor) {
        self.anchor.in_space().visit(visitor);
        self.arm.in_space().visit(visitor);
        visitor.word(Word::I32(i32::from(self.touched)));
    }
    fn fill(&mut self, source: &mut impl WordSource) {
        let mut vector = || {
            let mut vector = Vec3::ZERO;
            vector.fill(source);
            V::of_space(vector)
        };
        (self.anchor, self.arm) = (vector(), vector());
        self.touched = source.take(4) as i32 != 0;
    }
}

/// A deflection is limited to the cone where it exceeds it by more than rounding, so that an update is idempotent.
const BEYOND: f64 = 1.0 + 1.0 / 65536.0;

/// A contact at a pose.
struct Touching<P: Geometry> {
    stopped: Stopped<P>,
    /// Normal, world.
    normal: P::Vector,
    /// \[m\] the lever arm of A's point, the displacement from it to the sphere's centre and the lever arm of that,
    /// world.
    ways: [P::Vector; 3],
    /// \[m\] from the sphere's centre to the stored point of B, world.
    held: P::Vector,
    /// \[m\] the tangential deflection, axes of A.
    give: P::Vector,
}

impl<P: Geometry> PlaneContact<P> {
    #[inline(always)]
    fn touching(&self, seen: &Seen<'_, P>, memory: &Held<P::Vector>) -> Touching<P> {
        let ((at_a, arm), (at_b, other)) =
            (seen.a.place(&self.points[0]), seen.b.place(&self.points[1]));
        let (way, normal) = (P::displacement(&at_a, &at_b), seen.a.to_world(self.normal));
        let travel = Coordinate::carried(normal.dot(way), normal, [arm, way, other]);
        let range = [self.radius, P::Real::from_f64(1e30)];
        let stopped = Stopped::within(travel, range, [self.stiffness, P::Real::ZERO]);
        let held = seen.b.to_world(memory.arm);
        let mut give = P::Vector::ZERO;
        if memory.touched && stopped.beyond != P::Real::ZERO {
            let moved = seen.a.to_axes(way + held) - memory.anchor;
            give = moved - self.normal * self.normal.dot(moved);
        }
        Touching { stopped, normal, ways: [arm, way, other], held, give }
    }

    /// \[N\] the normal force.
    #[inline(always)]
    fn pressed(&self, seen: &Seen<'_, P>, touching: &Touching<P>) -> P::Real {
        let Touching { stopped, .. } = touching;
        let rate = seen.rate(&stopped.coordinate.direction(seen));
        let more = P::Real::ONE - self.dissipation * rate;
        let more = P::Real::pick(more.less_than(P::Real::ZERO), P::Real::ZERO, more);
        self.stiffness * stopped.depth() * more
    }

    #[inline(always)]
    fn shear_stiffness(&self) -> P::Real {
        self.shear * self.stiffness
    }

    /// \[m\] the lever arms of the stored point, the displacement from A's point to it.
    #[inline(always)]
    fn held_at(touching: &Touching<P>) -> [P::Vector; 3] {
        let [arm, way, other] = touching.ways;
        [arm, way + touching.held, other + touching.held]
    }

    /// The deflection as a coordinate.
    #[inline(always)]
    fn give(&self, seen: &Seen<'_, P>, touching: &Touching<P>) -> Coordinate<P> {
        let give = touching.give;
        let size = give.dot(give).sqrt();
        let along = seen.a.to_world(give * size.reciprocal_or_zero());
        Coordinate::carried(size, along, Self::held_at(touching))
    }

    /// Whether it has friction; depends on constants only.
    #[inline(always)]
    fn is_rough(&self) -> bool {
        self.friction != P::Real::ZERO
    }

    /// The damper of the deflection.
    #[inline(always)]
    fn shear_damper(&self, seen: &Seen<'_, P>, touching: &Touching<P>) -> Damper<P> {
        let [arm, way, other] = Self::held_at(touching);
        let arms = [seen.a.arm_at(arm, way), other];
        let slip = seen.b.point_velocity(arms[1]) - seen.a.point_velocity(arms[0]);
        let slip = slip - touching.normal * touching.normal.dot(slip);
        let along = slip * inverse_of_rate(slip.dot(slip).sqrt());
        // The spring and damper forces together stay within the cone.
        let force = seen.a.to_world(touching.give) * self.shear_stiffness();
        let (limit, same) = (self.friction * self.pressed(seen, touching), force.dot(along));
        let square = same * same + limit * limit - force.dot(force);
        let square = P::Real::pick(square.less_than(P::Real::ZERO), P::Real::ZERO, square);
        let damper = Damper::new(self.damping, seen.along(along, arms));
        damper.within(P::Real::ZERO, square.sqrt() - same)
    }

    /// The rolling resistance.
    #[inline(always)]
    fn rolling_damper(&self, seen: &Seen<'_, P>, touching: &Touching<P>) -> Damper<P> {
        let normal = touching.normal;
        let spin = seen.b.spin() - seen.a.spin();
        let rolling = normal.cross(spin.cross(normal));
        let rate = rolling.dot(rolling).sqrt();
        let direction = seen.about(rolling * inverse_of_rate(rate));
        drag(direction, rate, self.rolling * self.pressed(seen, touching))
    }
}

impl<P: Geometry> Interaction<P> for PlaneContact<P> {
    type State = Held<P::Vector>;
    type Dampers = [(); 3];
    const SLIPS: bool = true;
    const QUANTITIES: &'static [Quantity] = &[
        Quantity { name: "depth", unit: "m" },
        Quantity { name: "force", unit: "N" },
        Quantity { name: "friction", unit: "N" },
    ];

    #[inline(always)]
    fn settle(&self, seen: &Seen<'_, P>, memory: &mut Held<P::Vector>) {
        if !self.is_rough() {
            return;
        }
        let mut touching = self.touching(seen, memory);
        if touching.stopped.beyond == P::Real::ZERO {
            *memory = Held::default();
            return;
        }
        // The height of the centre above the plane.
        let [_, way, _] = touching.ways;
        let foot = -(touching.normal * touching.stopped.coordinate.value);
        let arm = seen.b.to_axes(foot);
        let mut give = touching.give;
        let limit = self.friction * self.pressed(seen, &touching) / self.shear_stiffness();
        let square = give.dot(give);
        let cone = limit * P::Real::from_f64(BEYOND);
        let slides = cone * cone < square;
        if slides {
            give = give * (limit * square.sqrt().reciprocal_or_zero());
        }
        if slides || !memory.touched || arm != memory.arm {
            touching.held = seen.b.to_world(arm);
            let anchor = seen.a.to_axes(way + touching.held) - give;
            *memory = Held { anchor, arm, touched: true };
        }
    }

    #[inline(always)]
    fn force_pair(
        &self,
        seen: &Seen<'_, P>,
        memory: &Held<P::Vector>,
    ) -> Option<ForcePair<P::Space>> {
        let touching = self.touching(seen, memory);
        let normal = touching.stopped.force_pair(seen);
        if !self.is_rough() {
            return Some(normal);
        }
        let give = self.give(seen, &touching);
        let tension = self.shear_stiffness() * give.value;
        Some(normal.with(&seen.pull(&give.direction(seen), tension)))
    }

    fn energy(&self, seen: &Seen<'_, P>, memory: &Held<P::Vector>) -> P::Real {
        let touching = self.touching(seen, memory);
        let give = P::Real::HALF * (self.shear_stiffness() * touching.give.dot(touching.give));
        touching.stopped.energy() + give
    }

    fn tangent(
        &self,
        seen: &Seen<'_, P>,
        memory: &Held<P::Vector>,
        visit: Springs<'_, P>,
    ) -> [P::Real; 2] {
        let touching = self.touching(seen, memory);
        let [a, b] = touching.stopped.tangent(seen, visit);
        if !self.is_rough() {
            return [a, b];
        }
        let ways = Self::held_at(&touching);
        for along in touching.normal.normals() {
            let tangent = Coordinate::<P>::carried(P::Real::ZERO, along, ways);
            visit(self.shear_stiffness(), &tangent.direction(seen));
        }
        let give = self.give(seen, &touching);
        let [of_a, of_b] = give.bent(seen, self.shear_stiffness() * give.value, visit);
        [a + of_a, b + of_b]
    }

    #[inline(always)]
    fn dampers(
        &self,
        seen: &Seen<'_, P>,
        memory: &Held<P::Vector>,
        visit: &mut impl FnMut(Damper<P>),
    ) {
        let zero = P::Real::ZERO;
        let shears = self.is_rough() && self.damping != zero;
        if self.dissipation == zero && !shears && self.rolling == zero {
            return (0..3).for_each(|_| visit(Damper::idle()));
        }
        let touching = self.touching(seen, memory);
        let is_free = P::Real::ONE_LANE && touching.stopped.beyond == zero;
        let dampers = [
            (self.dissipation != zero).then(|| touching.stopped.damper(seen, self.dissipation)),
            (shears && !is_free).then(|| self.shear_damper(seen, &touching)),
            (self.rolling != zero && !is_free).then(|| self.rolling_damper(seen, &touching)),
        ];
        dampers.into_iter().for_each(|damper| visit(damper.unwrap_or_else(Damper::idle)));
    }

    fn turn(memory: &mut Held<P::Vector>, turn: &mut dyn FnMut(usize, [f64; 3]) -> [f64; 3]) {
        memory.anchor = P::Vector::from_f64(turn(0, memory.anchor.to_f64()));
        memory.arm = P::Vector::from_f64(turn(1, memory.arm.to_f64()));
    }

    fn check(&self) -> Result<(), Wrong> {
        let (zero, least) = (P::Real::ZERO, "a number ≥ 0");
        Wrong::unless(self.radius >= zero, "radius", "is negative", least)?;
        check([zero, P::Real::ONE], self.stiffness, self.dissipation)?;
        Wrong::unless(self.friction >= zero, "friction", "is negative", least)?;
        Wrong::unless(self.shear > zero, "shear", "is not positive", "a number > 0")?;
        Wrong::unless(self.damping >= zero, "damping", "is negative", least)?;
        Wrong::unless(self.rolling >= zero, "rolling", "is negative", least)
    }

    fn read(&self, quantity: usize, seen: &Seen<'_, P>, memory: &Held<P::Vector>) -> P::Real {
        let touching = self.touching(seen, memory);
        match quantity {
            0 => touching.stopped.depth(),
            1 => self.pressed(seen, &touching),
            _ => self.shear_stiffness() * touching.give.dot(touching.give).sqrt(),
        }
    }
}
