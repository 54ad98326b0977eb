//! One lever of a joint, what it does in half a step, and whether a scheme keeps levers.
//!
//! `(share, time, 1/μ, kick's rate) => impulse per rate, impulse less`.

use crate::damping::pair::Direction;
use crate::elements::share::Share;
use crate::geometry::Geometry;
use crate::index::BodyIndex;
use crate::model::ModelOwner;
use crate::pose::Places;
use crate::real::Real;
use crate::space::Linear as _;

/// One lever of a joint, and what it does in half a step at a pose.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub struct Lever<P: Geometry> {
    /// \[√(N·s/m)\] force on the body that sees it at rest, that body's axes.
    pub(super) along: P::Vector,
    /// Moment about that body's centre of mass, its axes.
    pub(super) moment: P::Moment,
    /// Moment of the same force and moment about the other body's centre of mass, that body's axes.
    pub(super) other: P::Moment,
    /// \[1/s\] rate per impulse, without the other body's turning.
    pub(super) rate: P::Real,
    /// \[s\] impulse per rate.
    pub(super) impulse: P::Real,
    /// \[s\] impulse less per rate that the kick gave: ascending, descending.
    pub(super) told: [P::Real; 2],
    /// The impulse less, for what the kick and moved ground gave: ascending, descending.
    pub(super) less: [P::Real; 2],
    /// What the levers from here on are, in the first of a group.
    pub(super) seat: Seat,
}

/// Whose a group's levers are.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub(super) struct Seat {
    /// The body that sees them at rest and the other one.
    pub(super) ends: [u16; 2],
    /// How many there are.
    pub(super) count: u8,
    /// What acts there.
    pub(super) kind: Kind,
}

/// What acts in a group's place.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub(super) enum Kind {
    /// The group's dampers, one by one.
    #[default]
    Dampers,
    /// The levers of a joint.
    Joint,
    /// The lever of a raw spring.
    Turning,
}

impl<P: Geometry> Lever<P> {
    /// Its direction, seen from the ends of its joint: of the body that sees it and the other one.
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

    /// What it does in half a step `h` \[s\], times its coefficient, with 1/μ = `rate`: of the rate it
    /// takes `1 − 1/(1 + x + x²/2)`, `x = h·rate`, and is told of a kick as any damper
    /// (`damping::pair::Damper`).
    #[inline(always)]
    pub(super) fn weigh(&mut self, share: &Share<P::Real>, h: P::Real, rate: P::Real) {
        let (half, one) = (P::Real::HALF, P::Real::ONE);
        let x = h * rate;
        let y = one + half * x;
        let part = h / (one + x * y);
        let Share { own, later } = *share;
        self.impulse = part * y;
        let given = own * half * part;
        self.told = [given + later * self.impulse, given + (one - (own + later)) * self.impulse];
    }

    /// Tells it the rate that the kick gave.
    #[inline(always)]
    pub(super) fn tell(&mut self, kicked: P::Real) {
        self.less = self.told.map(|told| told * kicked);
    }

    /// `c` parts of it and `s` of another.
    pub(super) fn turned(&self, c: P::Real, other: &Self, s: P::Real) -> Self {
        Self {
            along: self.along * c + other.along * s,
            moment: self.moment * c + other.moment * s,
            other: self.other * c + other.other * s,
            ..*self
        }
    }

    /// So many times itself.
    pub(super) fn scaled(&self, by: P::Real) -> Self {
        self.turned(by, self, P::Real::ZERO)
    }
}

/// Whether a scheme keeps levers in its plant.
pub trait Keep {
    /// Memory for a model's levers.
    type Memory<M: ModelOwner>: AsRef<[Lever<M::Precision>]> + AsMut<[Lever<M::Precision>]>;

    /// Memory without levers yet.
    fn memory<M: ModelOwner>(model: &M) -> Self::Memory<M>;
}

/// No levers: no memory.
#[derive(Clone, Copy, Debug)]
pub struct NoLevers;

impl Keep for NoLevers {
    type Memory<M: ModelOwner> = [Lever<M::Precision>; 0];

    #[inline]
    fn memory<M: ModelOwner>(_: &M) -> Self::Memory<M> {
        []
    }
}

/// Levers: sixteen words per damper in space, eleven in the plane.
#[derive(Clone, Copy, Debug)]
pub struct Levers;

impl Keep for Levers {
    type Memory<M: ModelOwner> = M::PerDamper<Lever<M::Precision>>;

    #[inline]
    fn memory<M: ModelOwner>(model: &M) -> Self::Memory<M> {
        model.per_damper(Lever::default())
    }
}
