//! Coordinates of a law between two bodies: a rotation about an axis, a translation along one, a distance.
//!
//! `(state of the ends) => value, direction; force => its effect on rotations of the bodies`. The direction is the
//! gradient of the value: its rate is the rate of the value.

use crate::force_pair::{Direction, ForcePair};
use crate::geometry::Geometry;
use crate::laws::end::Seen;
use crate::laws::hinge::{Hinge, Turns};
use crate::laws::interaction::Springs;
use crate::real::Real;
use crate::space::Linear as _;
use crate::words::{WordSource, WordVisitor, Words};

/// \[m, m/s\] the travel of B's point from A's along an axis of A, and its rate.
#[inline(always)]
pub(crate) fn travel<P: Geometry>(
    seen: &Seen<'_, P>,
    points: &[P::Local; 2],
    axis: P::Vector,
) -> [P::Real; 2] {
    let travel = Coordinate::travel(seen, points, axis);
    [travel.value, seen.rate(&travel.direction(seen))]
}

/// A coordinate at a pose.
pub(super) struct Coordinate<P: Geometry> {
    /// \[m, rad\]
    pub(super) value: P::Real,
    way: CoordinateKind<P>,
}

/// The data of its gradient and of the gradient's dependence on the pose.
enum CoordinateKind<P: Geometry> {
    /// The gradient of a rotation, world.
    Turn(P::Moment),
    /// The axis, world; \[m\] the lever arm of A's point, the displacement from it to B's and the lever arm of B's
    /// point.
    Travel(P::Vector, [P::Vector; 3]),
    /// \[m\] the displacement, and both lever arms.
    Distance(P::Vector, [P::Vector; 2]),
}

/// Half revolutions of a torsion angle with the angle at a pose: memory of a law about an axis. The angle is kept for
/// further calls at that pose and is no part of the words.
#[derive(Clone, Copy)]
pub struct TurnPose<P: Geometry> {
    /// Half revolutions.
    pub turns: Turns,
    /// \[rad\] the angle and its gradient, world; `None` where undefined.
    kept: Option<(P::Real, P::Moment)>,
}

impl<P: Geometry> Default for TurnPose<P> {
    fn default() -> Self {
        Self { turns: Turns::default(), kept: None }
    }
}

impl<P: Geometry> Words for TurnPose<P> {
    fn visit(&self, visitor: &mut impl WordVisitor) {
        self.turns.visit(visitor);
    }
    fn fill(&mut self, source: &mut impl WordSource) {
        self.turns.fill(source);
    }
}

impl<P: Geometry> TurnPose<P> {
    /// Updates the half revolutions at a pose and keeps its angle, of which `part` of the half revolutions count; returns
    /// the angle with that part of those before.
    #[inline(always)]
    pub(super) fn settle(
        &mut self,
        seen: &Seen<'_, P>,
        axis: &Hinge<P::Space>,
        part: impl Fn(Turns) -> Turns,
    ) -> Option<Coordinate<P>> {
        self.kept = None;
        let torsion_angle = axis.seen(seen)?;
        let before = part(self.turns);
        torsion_angle.settle(&mut self.turns);
        let after = part(self.turns);
        let (mut value, gradient) = torsion_angle.angle(after);
        let gradient = seen.a.moment_to_world(gradient);
        self.kept = Some((value, gradient));
        if before != after {
            value = torsion_angle.angle(before).0;
        }
        Some(Coordinate { value, way: CoordinateKind::Turn(gradient) })
    }

    /// Keeps the angle of a pose with these half revolutions.
    #[inline(always)]
    pub(super) fn keep(&mut self, seen: &Seen<'_, P>, axis: &Hinge<P::Space>, turns: Turns) {
        self.kept = Coordinate::turned(seen, axis, turns);
    }

    /// The angle of the pose as a coordinate; `None` where it is undefined.
    #[inline(always)]
    pub(super) fn coordinate(&self) -> Option<Coordinate<P>> {
        let (value, gradient) = self.kept?;
        Some(Coordinate { value, way: CoordinateKind::Turn(gradient) })
    }
}

impl<P: Geometry> Coordinate<P> {
    /// The angle of B in A about an axis since t = 0 and its gradient, world; `None` where that is undefined.
    #[inline(always)]
    fn turned(
        seen: &Seen<'_, P>,
        axis: &Hinge<P::Space>,
        turns: Turns,
    ) -> Option<(P::Real, P::Moment)> {
        let (value, gradient) = axis.seen(seen)?.angle(turns);
        Some((value, seen.a.moment_to_world(gradient)))
    }

    /// The angle of B in A about an axis since t = 0; `None` where that is undefined.
    #[inline(always)]
    pub(super) fn turn(seen: &Seen<'_, P>, axis: &Hinge<P::Space>, turns: Turns) -> Option<Self> {
        let (value, gradient) = Self::turned(seen, axis, turns)?;
        Some(Self { value, way: CoordinateKind::Turn(gradient) })
    }

    /// The displacement of B's point from A's along an axis of A.
    #[inline(always)]
    pub(super) fn travel(seen: &Seen<'_, P>, points: &[P::Local; 2], axis: P::Vector) -> Self {
        let ((at_a, arm), (at_b, other)) = (seen.a.place(&points[0]), seen.b.place(&points[1]));
        let (way, axis) = (P::displacement(&at_a, &at_b), seen.a.to_world(axis));
        Self { value: axis.dot(way), way: CoordinateKind::Travel(axis, [arm, way, other]) }
    }

    /// A translation along a direction of A, world, of a point common to both bodies; `ways` are the lever arm of A's
    /// point, the displacement from it to B's and the lever arm of B's point.
    #[inline(always)]
    pub(super) fn carried(value: P::Real, axis: P::Vector, ways: [P::Vector; 3]) -> Self {
        Self { value, way: CoordinateKind::Travel(axis, ways) }
    }

    /// The distance of two points; without a direction where they coincide.
    #[inline(always)]
    pub(super) fn distance(seen: &Seen<'_, P>, points: &[P::Local; 2]) -> Self {
        let ((at_a, arm), (at_b, other)) = (seen.a.place(&points[0]), seen.b.place(&points[1]));
        Self::between(P::displacement(&at_a, &at_b), [arm, other])
    }

    /// The distance of two points from their displacement and their lever arms.
    #[inline(always)]
    pub(super) fn between(way: P::Vector, arms: [P::Vector; 2]) -> Self {
        Self { value: way.dot(way).sqrt(), way: CoordinateKind::Distance(way, arms) }
    }

    /// The record of a tension \[N, N·m\] along it: a positive one pulls B against the gradient.
    #[inline(always)]
    pub(super) fn pull(&self, seen: &Seen<'_, P>, tension: P::Real) -> ForcePair<P::Space> {
        let CoordinateKind::Turn(gradient) = self.way else {
            return seen.pull(&self.direction(seen), tension);
        };
        let torque_b = gradient * tension;
        let torque_a = if seen.a.is_ground() { P::Moment::ZERO } else { torque_b };
        ForcePair { force: P::Vector::ZERO, torque_a, torque_b }
    }

    /// Its gradient.
    #[inline(always)]
    pub(super) fn direction(&self, seen: &Seen<'_, P>) -> Direction<P::Space> {
        match self.way {
            CoordinateKind::Turn(gradient) => seen.about(gradient),
            // The force on A acts at B's point, so that both forces are collinear.
            CoordinateKind::Travel(axis, [arm, way, other]) => {
                seen.along(axis, [seen.a.arm_at(arm, way), other])
            }
            CoordinateKind::Distance(way, arms) => {
                seen.along(way * self.value.reciprocal_or_zero(), arms)
            }
        }
    }

    /// \[N·m\] an upper bound of the effect of a force along it on a rotation of A and of B; its effect on translations
    /// is visited as springs: for [`crate::laws::Interaction::tangent`].
    pub(super) fn bent(
        &self,
        seen: &Seen<'_, P>,
        force: P::Real,
        visit: Springs<'_, P>,
    ) -> [P::Real; 2] {
        let length = |v: P::Vector| v.dot(v).sqrt();
        match &self.way {
            CoordinateKind::Turn(gradient) => [P::Real::HALF * force * gradient.dot(*gradient); 2],
            // The axis rotates with A. For the force F, the lever arm r of A's point and the displacement d to B's, a
            // translation ξ and a rotation φ of A contribute at most 2·F·|φ|·|ξ| + F·(3·|r| + |d|)·φ², and 2·|φ|·|ξ| ≤
            // ξ²/l + l·φ².
            CoordinateKind::Travel(_, ways) => {
                let [arm, far, other] = ways.map(length);
                let elongation = arm + far;
                let across = force * elongation.reciprocal_or_zero();
                for axis in P::Vector::axes() {
                    visit(across, &Direction { along: axis, moments: [P::Moment::ZERO; 2] });
                }
                let three = P::Real::ONE + P::Real::TWO;
                [force * (three * arm + far + elongation), force * other]
            }
            CoordinateKind::Distance(_, arms) => {
                let across = force * self.value.reciprocal_or_zero();
                for axis in P::Vector::axes() {
                    visit(across, &seen.along(axis, *arms));
                }
                arms.map(|arm| force * length(arm))
            }
        }
    }
}
