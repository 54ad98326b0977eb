//! One damping mode of a joint and its half-step impulse.
//!
//! `(weight, time, 1/μ, kick's rate) => impulse per rate, impulse correction`.

use crate::elements::share::Share;
use crate::force_pair::Direction;
use crate::geometry::Geometry;
use crate::index::BodyIndex;
use crate::pose::Places;
use crate::real::Real;
use crate::space::Linear as _;

/// One damping mode of a joint, with its half-step coefficients at a pose.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub struct DampingMode<P: Geometry> {
    /// \[√(N·s/m)\] force on the body in whose axes the mode is constant, that body's axes; for a raw spring world
    /// axes.
    pub(super) along: P::Vector,
    /// Moment about that body's centre of mass, its axes.
    pub(super) moment: P::Moment,
    /// Moment of the same force and moment about the other body's centre of mass, that body's axes.
    pub(super) other: P::Moment,
    /// \[1/s\] rate per impulse, without the rotation of the other body.
    pub(super) rate: P::Real,
    /// \[s\] impulse per rate.
    pub(super) impulse: P::Real,
    /// Impulse correction, ascending, descending: to the ground per rate of the kick, otherwise for the kick and moved
    /// ground.
    pub(super) less: [P::Real; 2],
    /// \[1/s\] rate per impulse along each preceding mode, for joints between two bodies, and without the rotation of
    /// the other body. To the ground the first is the rate of the kick.
    pub(super) linked: [P::Real; LINKED],
    pub(super) still: [P::Real; LINKED],
    /// An entry of the damper pass: the entry of the whole model with this row's number.
    pub(super) stop: Stop,
}

/// Modes before the last of six.
pub(super) const LINKED: usize = 5;

/// An entry of the damper pass.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub(super) struct Stop {
    /// The body in whose axes the modes are constant, and the other one.
    pub(super) ends: [u16; 2],
    /// The row of the group or of the torsion spring.
    pub(super) of: u16,
    /// The row of the first mode.
    pub(super) row: u16,
    /// The number of modes; whether dampers act.
    pub(super) count: u8,
    /// The kind of the entry.
    pub(super) kind: Kind,
}

/// The kind of an entry of the damper pass.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub(super) enum Kind {
    /// A group's dampers, one by one.
    #[default]
    Dampers,
    /// The modes of a joint to the ground.
    Ground,
    /// The modes of a joint between two bodies.
    Joint,
    /// The mode of a raw spring.
    Raw,
    /// The mode of a torsion spring.
    Torsion,
}

impl Stop {
    /// An entry with its rows: the kind, its first mode, and the number of modes.
    pub(super) fn new(kind: Kind, ends: [BodyIndex; 2], [of, row, count]: [usize; 3]) -> Self {
        let ends = ends.map(|end| end.0);
        Self { ends, of: of as u16, row: row as u16, count: count as u8, kind }
    }
}

impl<P: Geometry> DampingMode<P> {
    /// Its direction for the ends of its joint: the body in whose axes it is constant and the other one.
    pub(super) fn direction(
        &self,
        places: Places<'_, P>,
        [own, _]: [BodyIndex; 2],
        first: BodyIndex,
    ) -> Direction<P::Space> {
        let along = match places.frames.get(own.row()) {
            Some(frame) => P::to_world(frame, self.along),
            None => P::Vector::ZERO,
        };
        let moments =
            if own == first { [self.moment, self.other] } else { [self.other, self.moment] };
        Direction { along, moments }
    }

    /// Its rate by a kick: that of the linear velocity between the bodies, in its axes, and of both angular velocities.
    #[inline(always)]
    pub(super) fn kicked(&self, pushed: P::Vector, [own, other]: [P::Moment; 2]) -> P::Real {
        self.along.dot(pushed) + self.moment.dot(own) - self.other.dot(other)
    }

    /// Sets the impulse of half a step `h` \[s\], times the coefficient, with 1/μ = `rate`: it removes the fraction
    /// `1 − 1/(1 + x + x²/2)`, `x = h·rate`, of the rate, and like any damper (`damping::pair::Damper`) includes the
    /// rate of the kick, `kicked`.
    #[inline(always)]
    pub(super) fn weigh(
        &mut self,
        share: &Share<P::Real>,
        h: P::Real,
        rate: P::Real,
        kicked: P::Real,
    ) {
        let (half, one) = (P::Real::HALF, P::Real::ONE);
        let x = h * rate;
        let y = one + half * x;
        let part = h / (one + x * y);
        let Share { own, later } = *share;
        let impulse = part * y;
        let given = own * half * part;
        let reported = [given + later * impulse, given + (one - (own + later)) * impulse];
        self.impulse = impulse;
        self.less = reported.map(|reported| reported * kicked);
    }

    /// The linear combination of `c` times it and `s` times another.
    pub(super) fn turned(&self, c: P::Real, other: &Self, s: P::Real) -> Self {
        Self {
            along: self.along * c + other.along * s,
            moment: self.moment * c + other.moment * s,
            other: self.other * c + other.other * s,
            ..*self
        }
    }

    /// Scales it.
    pub(super) fn scaled(&self, by: P::Real) -> Self {
        self.turned(by, self, P::Real::ZERO)
    }
}
