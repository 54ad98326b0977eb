//! Two surfaces in contact: what the contact laws have in common.
//!
//! `(stop along the normal, constants, stored points) => forces, energy, tangent, dampers`. Along the normal
//! `N = k·x·(1 + a·ẋ)`, the law of [`super::EndStop`]. A tangential spring joins the points of both surfaces that touched
//! at the boundary of a step (Cundall & Strack, Géotechnique 29 (1979) 47): the bodies' motion since then extends it.
//! What a boundary leaves of its deflection is the law's.

use crate::force_pair::ForcePair;
use crate::geometry::Geometry;
use crate::laws::coordinate::Coordinate;
use crate::laws::end::Seen;
use crate::laws::interaction::{Damper, Springs, Wrong};
use crate::laws::stop::{Stopped, check};
use crate::laws::tabled::{drag, inverse_of_rate};
use crate::real::Real;
use crate::space::{Linear, Moment as _, Vector as _};
use crate::vector::Vec3;
use crate::words::{Word, WordSource, WordVisitor, Words};

/// The memory of a contact: the points of contact.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub struct Held<V> {
    /// \[m\] the point of A at which the tangential force is 0, from A's point of the law, axes of A.
    pub anchor: V,
    /// \[m\] the point of B, from the centre, axes of B.
    pub arm: V,
    /// Whether the bodies are in contact.
    pub touched: bool,
    /// Whether they are apart at the pose of the last evaluation: no part of the words.
    pub apart: bool,
}

impl<V: Linear> Held<V> {
    /// Replaces its vectors, see [`crate::laws::Interaction::turn`].
    pub(super) fn turn(&mut self, turn: &mut dyn FnMut(usize, [f64; 3]) -> [f64; 3]) {
        self.anchor = V::from_f64(turn(0, self.anchor.to_f64()));
        self.arm = V::from_f64(turn(1, self.arm.to_f64()));
    }
}

// Planar vectors have three words, too: memories are read in spatial form.
impl<V: Linear> Words for Held<V> {
    fn visit(&self, visitor: &mut impl WordVisitor) {
        self.anchor.in_space().visit(visitor);
        self.arm.in_space().visit(visitor);
        visitor.word(Word::I32(i32::from(self.touched)));
    }
    fn fill(&mut self, source: &mut impl WordSource) {
        (self.anchor, self.arm) = (vector(source), vector(source));
        self.touched = source.take(4) as i32 != 0;
    }
}

/// A vector from its three words.
pub(super) fn vector<V: Linear>(source: &mut impl WordSource) -> V {
    let mut vector = Vec3::ZERO;
    vector.fill(source);
    V::of_space(vector)
}

/// A deflection is limited to the cone where it exceeds it by more than rounding, so that an update is idempotent.
pub(super) const BEYOND: f64 = 1.0 + 1.0 / 65536.0;

/// The constants of two surfaces.
#[derive(Clone, Copy)]
pub(super) struct Surface<R> {
    /// \[N/m\] normal force per depth.
    pub(super) stiffness: R,
    /// \[s/m\] Hunt–Crossley coefficient.
    pub(super) dissipation: R,
    /// \[1\] coefficient of dry friction.
    pub(super) friction: R,
    /// \[1\] tangential stiffness over `stiffness`.
    pub(super) shear: R,
    /// \[N·s/m\] of the tangential deflection.
    pub(super) damping: R,
    /// \[m\] moment of rolling resistance over the normal force.
    pub(super) rolling: R,
}

impl<R: Real> Surface<R> {
    /// Whether it has friction; depends on constants only.
    #[inline(always)]
    pub(super) fn is_rough(&self) -> bool {
        self.friction != R::ZERO
    }

    /// Whether it has a damper of the tangential deflection.
    #[inline(always)]
    pub(super) fn shears(&self) -> bool {
        self.is_rough() && self.damping != R::ZERO
    }

    /// Whether it has a damper.
    #[inline(always)]
    pub(super) fn is_damped(&self) -> bool {
        self.dissipation != R::ZERO || self.shears() || self.rolling != R::ZERO
    }

    /// \[N/m\]
    #[inline(always)]
    pub(super) fn shear_stiffness(&self) -> R {
        self.shear * self.stiffness
    }

    /// Refuses invalid constants.
    pub(super) fn check(&self) -> Result<(), Wrong> {
        let (zero, least) = (R::ZERO, "a number ≥ 0");
        check([zero, R::ONE], self.stiffness, self.dissipation)?;
        Wrong::unless(self.friction >= zero, "friction", "is negative", least)?;
        Wrong::unless(self.shear > zero, "shear", "is not positive", "a number > 0")?;
        Wrong::unless(self.damping >= zero, "damping", "is negative", least)?;
        Wrong::unless(self.rolling >= zero, "rolling", "is negative", least)
    }
}

/// A contact at a pose.
pub(super) struct Touching<P: Geometry> {
    pub(super) surface: Surface<P::Real>,
    pub(super) stopped: Stopped<P>,
    /// Normal of the tangential plane, world.
    pub(super) normal: P::Vector,
    /// \[m\] the lever arm of A's point, the displacement from it to B's centre and the lever arm of that, world.
    pub(super) ways: [P::Vector; 3],
    /// \[m\] from B's centre to the stored point of B, world.
    pub(super) held: P::Vector,
    /// \[m\] the tangential deflection, axes of A.
    pub(super) give: P::Vector,
}

impl<P: Geometry> Touching<P> {
    /// With the normal of the tangential plane in the world and in the axes of A.
    #[inline(always)]
    pub(super) fn new(
        seen: &Seen<'_, P>,
        surface: Surface<P::Real>,
        stopped: Stopped<P>,
        [normal, of_a]: [P::Vector; 2],
        ways: [P::Vector; 3],
        memory: &Held<P::Vector>,
    ) -> Self {
        let [_, way, _] = ways;
        let held = seen.b.to_world(memory.arm);
        let mut give = P::Vector::ZERO;
        if memory.touched && stopped.beyond != P::Real::ZERO {
            let moved = seen.a.to_axes(way + held) - memory.anchor;
            give = moved - of_a * of_a.dot(moved);
        }
        Self { surface, stopped, normal, ways, held, give }
    }

    /// \[N\] the normal force.
    #[inline(always)]
    pub(super) fn pressed(&self, seen: &Seen<'_, P>) -> P::Real {
        let Self { surface, stopped, .. } = self;
        let rate = seen.rate(&stopped.coordinate.direction(seen));
        let more = P::Real::ONE - surface.dissipation * rate;
        let more = P::Real::pick(more.less_than(P::Real::ZERO), P::Real::ZERO, more);
        surface.stiffness * stopped.depth() * more
    }

    /// \[m\] the deflection at which the tangential force is at its limit.
    #[inline(always)]
    pub(super) fn limit(&self, seen: &Seen<'_, P>) -> P::Real {
        self.surface.friction * self.pressed(seen) / self.surface.shear_stiffness()
    }

    /// A deflection limited to the cone, and whether it exceeds it.
    #[inline(always)]
    pub(super) fn within_cone(&self, seen: &Seen<'_, P>, mut give: P::Vector) -> (P::Vector, bool) {
        let limit = self.limit(seen);
        let square = give.dot(give);
        let cone = limit * P::Real::from_f64(BEYOND);
        let slides = cone * cone < square;
        if slides {
            give = give * (limit * square.sqrt().reciprocal_or_zero());
        }
        (give, slides)
    }

    /// The memory of a contact at a point of B with a deflection.
    #[inline(always)]
    pub(super) fn hold(
        &self,
        seen: &Seen<'_, P>,
        arm: P::Vector,
        give: P::Vector,
    ) -> Held<P::Vector> {
        let [_, way, _] = self.ways;
        let anchor = seen.a.to_axes(way + seen.b.to_world(arm)) - give;
        Held { anchor, arm, touched: true, apart: false }
    }

    /// \[m\] the lever arms of the stored point, the displacement from A's point to it.
    #[inline(always)]
    fn held_at(&self) -> [P::Vector; 3] {
        let [arm, way, other] = self.ways;
        [arm, way + self.held, other + self.held]
    }

    /// The deflection as a coordinate.
    #[inline(always)]
    fn give(&self, seen: &Seen<'_, P>) -> Coordinate<P> {
        let give = self.give;
        let size = give.dot(give).sqrt();
        let along = seen.a.to_world(give * size.reciprocal_or_zero());
        Coordinate::carried(size, along, self.held_at())
    }

    /// The record of its springs.
    #[inline(always)]
    pub(super) fn force_pair(&self, seen: &Seen<'_, P>) -> ForcePair<P::Space> {
        let normal = self.stopped.force_pair(seen);
        if !self.surface.is_rough() {
            return normal;
        }
        let give = self.give(seen);
        let tension = self.surface.shear_stiffness() * give.value;
        normal.with(&give.pull(seen, tension))
    }

    /// \[J\]
    pub(super) fn energy(&self) -> P::Real {
        let stiffness = self.surface.shear_stiffness();
        let give = P::Real::HALF * (stiffness * self.give.dot(self.give));
        self.stopped.energy() + give
    }

    /// \[N\] the magnitude of the tangential force.
    pub(super) fn rubbed(&self) -> P::Real {
        self.surface.shear_stiffness() * self.give.dot(self.give).sqrt()
    }

    /// Of the tangential spring, added to that of the stop.
    pub(super) fn tangent(
        &self,
        seen: &Seen<'_, P>,
        [a, b]: [P::Real; 2],
        visit: Springs<'_, P>,
    ) -> [P::Real; 2] {
        if !self.surface.is_rough() {
            return [a, b];
        }
        let (stiffness, ways) = (self.surface.shear_stiffness(), self.held_at());
        for along in self.normal.normals() {
            let tangent = Coordinate::<P>::carried(P::Real::ZERO, along, ways);
            visit(stiffness, &tangent.direction(seen));
        }
        let give = self.give(seen);
        let [of_a, of_b] = give.bent(seen, stiffness * give.value, visit);
        [a + of_a, b + of_b]
    }

    /// \[m\] the lever arms of the stored point.
    #[inline(always)]
    fn arms(&self, seen: &Seen<'_, P>) -> [P::Vector; 2] {
        let [arm, way, other] = self.held_at();
        [seen.a.arm_at(arm, way), other]
    }

    /// \[m/s\] the tangential velocity of B's stored point relative to A, world.
    #[inline(always)]
    pub(super) fn slip(&self, seen: &Seen<'_, P>) -> P::Vector {
        let arms = self.arms(seen);
        let slip = seen.b.point_velocity(arms[1]) - seen.a.point_velocity(arms[0]);
        slip - self.normal * self.normal.dot(slip)
    }

    /// The damper of the deflection, which grows at a velocity \[m/s\]; `pressed` is the normal force \[N\].
    #[inline(always)]
    fn shear_damper(&self, seen: &Seen<'_, P>, growing: P::Vector, pressed: P::Real) -> Damper<P> {
        let along = growing * inverse_of_rate(growing.dot(growing).sqrt());
        // The spring and damper forces together stay within the cone.
        let force = seen.a.to_world(self.give) * self.surface.shear_stiffness();
        let (limit, same) = (self.surface.friction * pressed, force.dot(along));
        let square = same * same + limit * limit - force.dot(force);
        let square = P::Real::pick(square.less_than(P::Real::ZERO), P::Real::ZERO, square);
        let damper = Damper::new(self.surface.damping, seen.along(along, self.arms(seen)));
        damper.within(P::Real::ZERO, square.sqrt() - same)
    }

    /// \[rad/s\] the tangential part of B's angular velocity relative to A, world.
    #[inline(always)]
    fn rolling(&self, seen: &Seen<'_, P>) -> P::Moment {
        let spin = seen.b.spin() - seen.a.spin();
        self.normal.cross(spin.cross(self.normal))
    }

    /// The resistance to a rolling \[rad/s\]; `pressed` is the normal force \[N\].
    #[inline(always)]
    fn rolling_damper(
        &self,
        seen: &Seen<'_, P>,
        rolling: P::Moment,
        pressed: P::Real,
    ) -> Damper<P> {
        let rate = rolling.dot(rolling).sqrt();
        let direction = seen.about(rolling * inverse_of_rate(rate));
        drag(direction, rate, self.surface.rolling * pressed)
    }

    /// Visits its dampers: along the normal, of the deflection, of the rolling. A wheel states the part of its slip
    /// \[m/s\] that does not extend the tangential spring, and its axle, the unit axis of its rolling, both in the world.
    #[inline(always)]
    pub(super) fn dampers(
        &self,
        seen: &Seen<'_, P>,
        wheel: Option<(P::Vector, P::Moment)>,
        visit: &mut impl FnMut(Damper<P>),
    ) {
        let (surface, zero) = (&self.surface, P::Real::ZERO);
        let is_free = P::Real::ONE_LANE && self.stopped.beyond == zero;
        let (shears, rolls) = (surface.shears() && !is_free, surface.rolling != zero && !is_free);
        let pressed = if shears || rolls { self.pressed(seen) } else { zero };
        let dampers = [
            (surface.dissipation != zero).then(|| self.stopped.damper(seen, surface.dissipation)),
            shears.then(|| {
                let slip = self.slip(seen);
                let Some((creep, _)) = wheel else {
                    return self.shear_damper(seen, slip, pressed);
                };
                let damper = self.shear_damper(seen, slip - creep, pressed);
                let towards = creep.dot(damper.direction.along);
                damper.towards(towards).braking()
            }),
            rolls.then(|| {
                let rolling = self.rolling(seen);
                let rolling = wheel.map_or(rolling, |(_, axle)| axle * axle.dot(rolling));
                self.rolling_damper(seen, rolling, pressed)
            }),
        ];
        dampers.into_iter().for_each(|damper| visit(damper.unwrap_or_else(Damper::idle)));
    }
}
