//! The state of a law's two bodies.
//!
//! `(frames, orientations, velocities) => points, lever arms, rates, rotations`. Each is computed on demand.

use crate::attitude::Attitude as _;
use crate::body::BodyState;
use crate::force_pair::Direction;
use crate::force_pair::ForcePair;
use crate::geometry::Geometry;
use crate::index::{BodyIndex, InputIndex};
use crate::pass_sum::Sum;
use crate::real::Real;
use crate::schedule::Signal;
use crate::space::{Linear as _, Moment as _, Space, Vector as _};

/// Bodies at an instant.
pub struct Instant<'s, P: Geometry> {
    /// One per body, of the pose.
    pub frames: &'s [P::Frame],
    /// One per body.
    pub bodies: &'s [BodyState<P>],
    /// One per input.
    pub signals: &'s [Signal<P::Real>],
}

impl<P: Geometry> Clone for Instant<'_, P> {
    fn clone(&self) -> Self {
        *self
    }
}

impl<P: Geometry> Copy for Instant<'_, P> {}

impl<'s, P: Geometry> Instant<'s, P> {
    /// The state of a law's two bodies; `None` where the second is not a body.
    #[inline(always)]
    #[must_use]
    pub fn seen(&self, [a, b]: [BodyIndex; 2]) -> Option<Seen<'s, P>> {
        let end = |index: BodyIndex| {
            let (frame, state) = (self.frames.get(index.row())?, self.bodies.get(index.row())?);
            Some(Body { frame, state, sum: None })
        };
        let (a, b) = (End { body: end(a) }, End { body: Some(end(b)?) });
        Some(Seen { a, b, at: *self })
    }
}

/// A body for a law.
pub(crate) struct Body<'s, P: Geometry> {
    pub(crate) frame: &'s P::Frame,
    pub(crate) state: &'s BodyState<P>,
    /// The changes of its velocities in a damper pass so far, where they are apart from them.
    pub(crate) sum: Option<&'s Sum<P::Space>>,
}

impl<P: Geometry> Body<'_, P> {
    /// \[m/s\] world axes.
    #[inline(always)]
    fn velocity(&self) -> P::Vector {
        let velocity = P::velocity(&self.state.velocity);
        self.sum.map_or(velocity, |sum| velocity + sum.linear)
    }

    /// \[rad/s\] body axes.
    #[inline(always)]
    fn spin(&self) -> P::Moment {
        let spin = P::spin(&self.state.angular_velocity);
        self.sum.map_or(spin, |sum| spin + sum.angular)
    }
}

/// One end of an interaction: a body, or the ground.
pub struct End<'s, P: Geometry> {
    pub(crate) body: Option<Body<'s, P>>,
}

impl<'s, P: Geometry> End<'s, P> {
    /// Whether it is the ground.
    #[inline(always)]
    #[must_use]
    pub fn is_ground(&self) -> bool {
        self.body.is_none()
    }

    /// A point's location, and its lever arm \[m\] from the centre of mass in world axes, 0 for the ground.
    #[inline(always)]
    #[must_use]
    pub fn place(&self, local: &P::Local) -> (P::Location, P::Vector) {
        match &self.body {
            Some(body) => P::place(body.frame, local),
            None => (P::ground(local), P::Vector::ZERO),
        }
    }

    /// The lever arm of a point `offset` \[m\] away from the point of `arm`; 0 for the ground.
    #[inline(always)]
    #[must_use]
    pub fn arm_at(&self, arm: P::Vector, offset: P::Vector) -> P::Vector {
        if self.is_ground() { arm } else { arm + offset }
    }

    /// Body axes to world axes.
    #[inline(always)]
    #[must_use]
    pub fn to_world(&self, v: P::Vector) -> P::Vector {
        self.body.as_ref().map_or(v, |body| P::to_world(body.frame, v))
    }

    /// World axes to body axes.
    #[inline(always)]
    #[must_use]
    pub fn to_axes(&self, v: P::Vector) -> P::Vector {
        self.body.as_ref().map_or(v, |body| P::to_body(body.frame, v))
    }

    /// A moment's body axes to world axes.
    #[inline(always)]
    #[must_use]
    pub fn moment_to_world(&self, m: P::Moment) -> P::Moment {
        self.body.as_ref().map_or(m, |body| P::moment_to_world(body.frame, m))
    }

    /// A moment in world axes in body axes; 0 for the ground.
    #[inline(always)]
    #[must_use]
    pub fn moment_to_axes(&self, m: P::Moment) -> P::Moment {
        self.body.as_ref().map_or(P::Moment::ZERO, |body| P::moment_to_body(body.frame, m))
    }

    /// \[m/s\] the velocity of a point of this end at the end of an arm, world axes.
    #[inline(always)]
    #[must_use]
    pub fn point_velocity(&self, arm: P::Vector) -> P::Vector {
        self.body.as_ref().map_or(P::Vector::ZERO, |body| {
            body.velocity() + P::moment_to_world(body.frame, body.spin()).cross(arm)
        })
    }

    /// \[rad/s\] the angular velocity, world axes.
    #[inline(always)]
    #[must_use]
    pub fn spin(&self) -> P::Moment {
        let spin = |body: &Body<'s, P>| P::moment_to_world(body.frame, body.spin());
        self.body.as_ref().map_or(P::Moment::ZERO, spin)
    }

    /// The rotation of the other end in the axes of this one.
    #[inline(always)]
    #[must_use]
    pub fn turn_of(&self, other: &Self) -> <P::Space as Space>::Turn {
        let orientation = |end: &Self| end.body.as_ref().map(|body| &body.state.orientation);
        P::Orientation::relative(orientation(self), orientation(other))
    }
}

/// The two ends of a law: A, which may be the ground, and B, a body.
pub struct Seen<'s, P: Geometry> {
    /// A.
    pub a: End<'s, P>,
    /// B.
    pub b: End<'s, P>,
    pub(crate) at: Instant<'s, P>,
}

impl<'s, P: Geometry> Seen<'s, P> {
    /// The ends of two other bodies; in a damper pass with their velocities before it. `None` where the second is not a
    /// body.
    #[inline(always)]
    #[must_use]
    pub fn between(&self, bodies: [BodyIndex; 2]) -> Option<Seen<'s, P>> {
        self.at.seen(bodies)
    }

    /// \[N, N·m, m\] The value of an input; 0 where the model has no such input.
    #[inline(always)]
    #[must_use]
    pub fn input(&self, input: InputIndex) -> P::Real {
        self.signal(input).value
    }

    /// The value \[by its unit\] and the rate of an input; 0 where the model has no such input.
    #[inline(always)]
    #[must_use]
    pub fn signal(&self, input: InputIndex) -> Signal<P::Real> {
        self.at.signals.get(usize::from(input.0)).copied().unwrap_or_default()
    }

    /// The direction along a unit vector u (world axes) between a point of A and one of B, at their lever arms: its
    /// rate is `u·(v_B − v_A)`.
    #[inline(always)]
    #[must_use]
    pub fn along(&self, u: P::Vector, arms: [P::Vector; 2]) -> Direction<P::Space> {
        let [a, b] = arms;
        let moments = [self.a.moment_to_axes(a.cross(u)), self.b.moment_to_axes(b.cross(u))];
        Direction { along: u, moments }
    }

    /// The direction about a gradient (world axes) of an angle of B in A: its rate is `gradient·(ω_B − ω_A)`.
    #[inline(always)]
    #[must_use]
    pub fn about(&self, gradient: P::Moment) -> Direction<P::Space> {
        let moments = [&self.a, &self.b].map(|end| end.moment_to_axes(gradient));
        Direction { along: P::Vector::ZERO, moments }
    }

    /// \[m/s, rad/s\] the rate along a direction.
    #[inline(always)]
    #[must_use]
    pub fn rate(&self, direction: &Direction<P::Space>) -> P::Real {
        let mut rate = P::Real::ZERO;
        let Direction { along, moments: [of_a, of_b] } = direction;
        if let Some(b) = &self.b.body {
            rate = along.dot(b.velocity()) + of_b.dot(b.spin());
        }
        if let Some(a) = &self.a.body {
            rate = rate - (along.dot(a.velocity()) + of_a.dot(a.spin()));
        }
        rate
    }

    /// The record of a tension \[N, N·m\] along a direction: a positive one pulls B against the direction.
    #[inline(always)]
    #[must_use]
    pub fn pull(&self, direction: &Direction<P::Space>, tension: P::Real) -> ForcePair<P::Space> {
        let Direction { along, moments: [of_a, of_b] } = *direction;
        let torque_a = match self.a.is_ground() {
            true => P::Moment::ZERO,
            false => self.a.moment_to_world(of_a * tension),
        };
        ForcePair {
            force: along * tension,
            torque_a,
            torque_b: self.b.moment_to_world(of_b * tension),
        }
    }
}
