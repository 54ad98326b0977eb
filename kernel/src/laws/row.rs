//! A row of a table for callers, and the operations on rows.

use crate::elements::share::Share;
use crate::force_pair::ForcePair;
use crate::geometry::Geometry;
use crate::index::{BodyIndex, GroupIndex};
use crate::laws::branch::Branch;
use crate::laws::branches::Branches;
use crate::laws::end::{Instant, Seen};
use crate::laws::interaction::{Damper, Inner, Quantity, Springs};
use crate::words::WordVisitor;

/// The forces of a model's groups at the pose of an evaluation.
pub trait GroupForces<P: Geometry> {
    /// \[N\] the force of the springs of a group on its second body, world axes; 0 where the model has no such group.
    fn force(&self, group: GroupIndex) -> P::Vector;
}

/// The options of an evaluation of laws.
pub struct Act<'s, P: Geometry> {
    /// Whether memories are updated first.
    pub settle: bool,
    /// \[s\] the step by which memories are advanced before that.
    pub advance: Option<P::Real>,
    /// Whether dampers act as forces.
    pub damped: bool,
    /// The forces of groups, computed on demand.
    pub groups: &'s dyn GroupForces<P>,
}

impl<P: Geometry> Clone for Act<'_, P> {
    fn clone(&self) -> Self {
        *self
    }
}

impl<P: Geometry> Copy for Act<'_, P> {}

/// A damper pass for laws.
pub trait DamperPass<P: Geometry> {
    /// \[s\] the duration of the dampers' action in it.
    fn time(&self) -> P::Real;
    /// Whether the laws were evaluated at this pose, with the memories that they have.
    fn is_evaluated(&self) -> bool;
    /// The ends of a law between two bodies in the pass.
    fn seen(&self, bodies: [BodyIndex; 2]) -> Option<Seen<'_, P>>;
    /// Applies the dampers of a law, each with its weight, also to the law's internal degree of freedom; `turns` where all
    /// of them act on rotations only.
    fn act(
        &mut self,
        bodies: [BodyIndex; 2],
        turns: bool,
        dampers: &[Damper<P>],
        shares: &[Share<P::Real>],
        inner: Option<&mut Inner<P::Real>>,
    );
    /// Applies a damper along the directions of a law and of its branches.
    fn act_along(
        &mut self,
        bodies: [BodyIndex; 2],
        known: (&Damper<P>, &Share<P::Real>),
        branches: &[Option<Branch<P>>],
    );
}

/// A row of a table with its memory. [`Self::seen`], [`Self::update`] or [`Self::keep_pose`] comes before all that takes a
/// pose.
pub trait Row<P: Geometry> {
    /// The law's name.
    fn name(&self) -> &'static str;
    /// A and B.
    fn bodies(&self) -> [BodyIndex; 2];
    /// Its ends at an instant, whose pose it keeps: for callers outside a step. `None` where the second is not a body.
    fn seen<'s>(&mut self, at: Instant<'s, P>) -> Option<Seen<'s, P>>;
    /// Updates its memory for an evaluation: the force of a group, the step, then the pose.
    fn update(&mut self, seen: &Seen<'_, P>, act: Act<'_, P>);
    /// [`Interaction::KEEPS`](crate::laws::Interaction::KEEPS).
    fn keeps(&self) -> bool;
    /// [`Interaction::keep_pose`](crate::laws::Interaction::keep_pose).
    fn keep_pose(&mut self, seen: &Seen<'_, P>);
    /// [`Interaction::is_idle`](crate::laws::Interaction::is_idle).
    fn is_idle(&self) -> bool;
    /// [`Interaction::force_pair`](crate::laws::Interaction::force_pair).
    fn force_pair(&self, seen: &Seen<'_, P>) -> Option<ForcePair<P::Space>>;
    /// [`Interaction::energy`](crate::laws::Interaction::energy).
    fn energy(&self, seen: &Seen<'_, P>) -> P::Real;
    /// [`Interaction::tangent`](crate::laws::Interaction::tangent).
    fn tangent(&self, seen: &Seen<'_, P>, visit: Springs<'_, P>) -> [P::Real; 2];
    /// [`Interaction::BRANCHES`](crate::laws::Interaction::BRANCHES).
    fn most_branches(&self) -> usize;
    /// [`Interaction::branch_bodies`](crate::laws::Interaction::branch_bodies).
    fn branch_bodies(&self, visit: &mut dyn FnMut([BodyIndex; 2]));
    /// [`Interaction::branches`](crate::laws::Interaction::branches).
    fn branches(&self, seen: &Seen<'_, P>) -> Branches<P>;
    /// [`Interaction::branch_tangent`](crate::laws::Interaction::branch_tangent).
    fn branch_tangent(
        &self,
        branch: usize,
        seen: &Seen<'_, P>,
        visit: Springs<'_, P>,
    ) -> [P::Real; 2];
    /// The number of its dampers.
    fn dampers(&self) -> usize;
    /// [`Interaction::is_damped`](crate::laws::Interaction::is_damped), where it has dampers.
    fn is_damped(&self) -> bool;
    /// [`Interaction::TURNS`](crate::laws::Interaction::TURNS).
    fn turns(&self) -> bool;
    /// [`Interaction::dampers`](crate::laws::Interaction::dampers).
    fn each_damper(&self, seen: &Seen<'_, P>, visit: &mut dyn FnMut(usize, &Damper<P>));
    /// [`Interaction::DRIVES`](crate::laws::Interaction::DRIVES).
    fn drives(&self) -> bool;
    /// [`Interaction::inner`](crate::laws::Interaction::inner) after a kick, where it has one.
    fn inner(&self, kick: P::Real) -> Option<Inner<P::Real>>;
    /// [`Interaction::set_inner`](crate::laws::Interaction::set_inner).
    fn set_inner(&mut self, rate: P::Real);
    /// [`Interaction::kick`](crate::laws::Interaction::kick).
    fn kick(&mut self, seen: &Seen<'_, P>, h: P::Real) -> P::Real;
    /// [`Interaction::drive`](crate::laws::Interaction::drive).
    fn drive(&mut self, seen: &Seen<'_, P>, time_and_kick: [P::Real; 2]);
    /// [`Interaction::inner_square`](crate::laws::Interaction::inner_square).
    fn inner_square(&self) -> P::Real;
    /// [`Interaction::supply`](crate::laws::Interaction::supply).
    fn supply(&self, seen: &Seen<'_, P>) -> P::Real;
    /// [`Interaction::loss`](crate::laws::Interaction::loss).
    fn loss(&self) -> P::Real;
    /// [`Interaction::driven_rate`](crate::laws::Interaction::driven_rate).
    fn driven_rate(&self, seen: &Seen<'_, P>) -> P::Real;
    /// [`Interaction::turn`](crate::laws::Interaction::turn).
    fn turn(&mut self, turn: &mut dyn FnMut(usize, [f64; 3]) -> [f64; 3]);
    /// [`Interaction::QUANTITIES`](crate::laws::Interaction::QUANTITIES).
    fn quantities(&self) -> &'static [Quantity];
    /// [`Interaction::read`](crate::laws::Interaction::read).
    fn read(&self, quantity: usize, seen: &Seen<'_, P>) -> P::Real;
    /// The constants.
    fn visit(&self, visitor: &mut dyn WordVisitor);
}
