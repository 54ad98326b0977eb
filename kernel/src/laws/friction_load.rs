//! Dry friction whose limit grows with the force of a joint across its axis: [`super::HingeFriction`] and
//! [`super::SlideFriction`] with other constants at every boundary of a step.
//!
//! `N ↦ limit F(v) + μ·r·N`, for a translation without r. N is the force of the springs of the joint's group at the pose
//! of the evaluation, without its dampers. The elastic deflection keeps its stiffness, `(breakaway + μ·r·N₀)/give`.

use crate::force_pair::ForcePair;
use crate::geometry::Geometry;
use crate::index::GroupIndex;
use crate::laws::end::Seen;
use crate::laws::hinge_friction::{HingeFriction, TurnSlip};
use crate::laws::interaction::{Damper, Interaction, Quantity, Springs, Wrong};
use crate::laws::slide_friction::SlideFriction;
use crate::laws::slip::Slip;
use crate::real::Real;
use crate::space::Linear as _;
use crate::words::{WordSource, WordVisitor, Words};

law! {
    /// Dry friction between two bodies that rotate about an axis, which grows with the radial force of their joint.
    pub struct HingeFrictionLoad = "hinge-friction-load" {
        /// Axis of rotation.
        axis: Axis,
        /// Joint whose force across the axis loads the bearing.
        joint: JointGroup,
        /// Coefficient of friction of the load.
        mu: Number,
        /// Radius at which the friction of the load acts.
        radius: Number("m"),
        /// Load included in the friction torque at which the elastic rotation is `give`.
        force: Number("N") = 0.0,
        /// Torque of sliding friction at high rates, without load.
        coulomb: Number("N·m"),
        /// Torque at which sliding begins from rest, without load, not below `coulomb`.
        breakaway: Number("N·m"),
        /// Rate at which the torque is midway between `breakaway` and `coulomb`.
        stribeck: Number("rad/s") = 0.05,
        /// Elastic rotation at the breakaway torque with the load `force`.
        give: Number("rad") = 0.001,
        /// Damping of the elastic rotation; the torque with damping stays within the friction limit.
        damping: Number("N·m·s/rad") = 0.0,
        /// Viscous friction.
        viscous: Number("N·m·s/rad") = 0.0,
    }
}

law! {
    /// Dry friction between two bodies that slide along an axis, which grows with the force of their joint across it.
    pub struct SlideFrictionLoad = "slide-friction-load" {
        /// A point of the first body and the sliding point of the second body.
        points: Points,
        /// Axis of the translation.
        axis: Normal,
        /// Joint whose force across the axis loads the guide.
        joint: JointGroup,
        /// Coefficient of friction of the load.
        mu: Number,
        /// Load included in the friction force at which the elastic displacement is `give`.
        force: Number("N") = 0.0,
        /// Force of sliding friction at high rates, without load.
        coulomb: Number("N"),
        /// Force at which sliding begins from rest, without load, not below `coulomb`.
        breakaway: Number("N"),
        /// Rate at which the force is midway between `breakaway` and `coulomb`.
        stribeck: Number("m/s") = 0.01,
        /// Elastic displacement at the breakaway force with the load `force`.
        give: Number("m") = 1e-4,
        /// Damping of the elastic displacement; the force with damping stays within the friction limit.
        damping: Number("N·s/m") = 0.0,
        /// Viscous friction.
        viscous: Number("N·s/m") = 0.0,
    }
}

/// The memory of friction with a load.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub struct Loaded<T, R> {
    /// That of the friction.
    pub slip: T,
    /// \[N, N·m\] what the load adds to its limit.
    pub load: R,
}

impl<T: Words, R: Real> Words for Loaded<T, R> {
    fn visit(&self, visitor: &mut impl WordVisitor) {
        self.slip.visit(visitor);
        visitor.word(self.load.word());
    }
    fn fill(&mut self, source: &mut impl WordSource) {
        self.slip.fill(source);
        self.load = R::from_words(source);
    }
}

/// Friction with a load: breakaway friction and deflection there, of an unloaded one.
#[inline(always)]
fn loaded<R: Real>([breakaway, give]: [R; 2], [load, nominal]: [R; 2]) -> [R; 2] {
    let stiffness = (breakaway + nominal) / give;
    let limit = breakaway + load;
    [limit, limit / stiffness]
}

impl<P: Geometry> HingeFrictionLoad<P> {
    /// Friction per force.
    #[inline(always)]
    fn factor(&self) -> P::Real {
        self.mu * self.radius
    }

    /// The friction with a load.
    #[inline(always)]
    fn friction(&self, load: P::Real) -> HingeFriction<P> {
        let Self { bodies, axis, coulomb, stribeck, damping, viscous, .. } = *self;
        let coulomb = coulomb + load;
        let loads = [load, self.factor() * self.force];
        let [breakaway, give] = loaded([self.breakaway, self.give], loads);
        HingeFriction { bodies, axis, coulomb, breakaway, stribeck, give, damping, viscous }
    }

    /// \[N\] the part of a force across the axis.
    #[inline(always)]
    fn across(&self, seen: &Seen<'_, P>, force: P::Vector) -> P::Real {
        use crate::space::Moment as _;
        let across = seen.a.moment_to_world(self.axis.axis).cross(force);
        across.dot(across).sqrt()
    }

    /// Refuses an invalid radius.
    fn check_size(&self) -> Result<(), Wrong> {
        Wrong::unless(self.radius >= P::Real::ZERO, "radius", "is negative", "a radius ≥ 0")
    }
}

impl<P: Geometry> SlideFrictionLoad<P> {
    /// Friction per force.
    #[inline(always)]
    fn factor(&self) -> P::Real {
        self.mu
    }

    /// The friction with a load.
    #[inline(always)]
    fn friction(&self, load: P::Real) -> SlideFriction<P> {
        let Self { bodies, points, axis, coulomb, stribeck, damping, viscous, .. } = *self;
        let coulomb = coulomb + load;
        let loads = [load, self.factor() * self.force];
        let [breakaway, give] = loaded([self.breakaway, self.give], loads);
        SlideFriction { bodies, points, axis, coulomb, breakaway, stribeck, give, damping, viscous }
    }

    /// \[N\] the part of a force across the axis.
    #[inline(always)]
    fn across(&self, seen: &Seen<'_, P>, force: P::Vector) -> P::Real {
        let axis = seen.a.to_world(self.axis);
        let across = force - axis * axis.dot(force);
        across.dot(across).sqrt()
    }

    fn check_size(&self) -> Result<(), Wrong> {
        Ok(())
    }
}

/// The law of a friction, with its memory and the unit of its friction and of its deflection.
macro_rules! with_load {
    ($law:ident of $friction:ty, $memory:ty, $effort:literal, $unit:literal) => {
        impl<P: Geometry> Interaction<P> for $law<P> {
            type State = Loaded<$memory, P::Real>;
            type Dampers = [(); 2];
            const TURNS: bool = <$friction as Interaction<P>>::TURNS;
            const ADVANCES: bool = true;
            const ADVANCE_SETTLES: bool = true;
            const BEARS: bool = true;
            const KEEPS: bool = <$friction as Interaction<P>>::KEEPS;
            const QUANTITIES: &'static [Quantity] =
                &[Quantity { name: "slip", unit: $unit }, Quantity { name: "load", unit: $effort }];

            #[inline(always)]
            fn group(&self) -> GroupIndex {
                self.joint
            }

            #[inline(always)]
            fn bear(&self, seen: &Seen<'_, P>, force: P::Vector, memory: &mut Self::State) {
                memory.load = self.factor() * self.across(seen, force);
            }

            #[inline(always)]
            fn advance(&self, seen: &Seen<'_, P>, h: P::Real, memory: &mut Self::State) {
                self.friction(memory.load).advance(seen, h, &mut memory.slip);
            }

            #[inline(always)]
            fn settle(&self, seen: &Seen<'_, P>, memory: &mut Self::State) {
                self.friction(memory.load).settle(seen, &mut memory.slip);
            }

            #[inline(always)]
            fn keep_pose(&self, seen: &Seen<'_, P>, memory: &mut Self::State) {
                self.friction(memory.load).keep_pose(seen, &mut memory.slip);
            }

            #[inline(always)]
            fn force_pair(
                &self,
                seen: &Seen<'_, P>,
                memory: &Self::State,
            ) -> Option<ForcePair<P::Space>> {
                self.friction(memory.load).force_pair(seen, &memory.slip)
            }

            fn energy(&self, seen: &Seen<'_, P>, memory: &Self::State) -> P::Real {
                self.friction(memory.load).energy(seen, &memory.slip)
            }

            fn tangent(
                &self,
                seen: &Seen<'_, P>,
                memory: &Self::State,
                visit: Springs<'_, P>,
            ) -> [P::Real; 2] {
                self.friction(memory.load).tangent(seen, &memory.slip, visit)
            }

            #[inline(always)]
            fn is_damped(&self) -> bool {
                self.damping != P::Real::ZERO || self.viscous != P::Real::ZERO
            }

            #[inline(always)]
            fn dampers(
                &self,
                seen: &Seen<'_, P>,
                memory: &Self::State,
                visit: &mut impl FnMut(Damper<P>),
            ) {
                self.friction(memory.load).dampers(seen, &memory.slip, visit);
            }

            fn check(&self) -> Result<(), Wrong> {
                let not_negative = |number: P::Real, field| {
                    Wrong::unless(number >= P::Real::ZERO, field, "is negative", "a number ≥ 0")
                };
                not_negative(self.mu, "mu")?;
                not_negative(self.force, "force")?;
                self.check_size()?;
                self.friction(P::Real::ZERO).check()
            }

            fn read(&self, quantity: usize, seen: &Seen<'_, P>, memory: &Self::State) -> P::Real {
                match quantity {
                    0 => self.friction(memory.load).read(0, seen, &memory.slip),
                    _ => memory.load,
                }
            }
        }
    };
}

with_load!(HingeFrictionLoad of HingeFriction<P>, TurnSlip<P>, "N·m", "rad");
with_load!(SlideFrictionLoad of SlideFriction<P>, Slip<P::Real>, "N", "m");
