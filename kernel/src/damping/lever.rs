//! One lever of a joint, what it does in half a step, and whether a scheme keeps levers.
//!
//! `(share, time, 1/μ, kick's rate) => impulse per rate, impulse less`.

use crate::elements::share::Share;
use crate::geometry::Geometry;
use crate::index::BodyIndex;
use crate::pose::Places;
use crate::real::Real;
use crate::record::Direction;
use crate::space::Linear as _;

/// One lever of a joint, and what it does in half a step at a pose.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub struct Lever<P: Geometry> {
    /// \[√(N·s/m)\] force on the body that sees it at rest, that body's axes; of a raw spring world
    /// axes.
    pub(super) along: P::Vector,
    /// Moment about that body's centre of mass, its axes.
    pub(super) moment: P::Moment,
    /// Moment of the same force and moment about the other body's centre of mass, that body's axes.
    pub(super) other: P::Moment,
    /// \[1/s\] rate per impulse, without the other body's turning.
    pub(super) rate: P::Real,
    /// \[s\] impulse per rate.
    pub(super) impulse: P::Real,
    /// The impulse less, ascending, descending: to the ground per rate that the kick gave, else for
    /// what the kick and moved ground gave.
    pub(super) less: [P::Real; 2],
    /// \[1/s\] rate per impulse along each of the levers before it, of joints between two bodies; and
    /// without the other body's turning. To the ground the first is the rate that the kick gave.
    pub(super) linked: [P::Real; LINKED],
    pub(super) still: [P::Real; LINKED],
    /// A stop of the sweeps: of the whole model's in order the one of this row's number.
    pub(super) stop: Stop,
}

/// Levers before the last of six.
pub(super) const LINKED: usize = 5;

/// Where a sweep stops, and what acts there.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub(super) struct Stop {
    /// The body that sees the levers at rest and the other one.
    pub(super) ends: [u16; 2],
    /// The row of the group or of the torsion spring.
    pub(super) of: u16,
    /// The row of the first lever.
    pub(super) row: u16,
    /// How many levers there are; whether dampers act.
    pub(super) count: u8,
    /// What acts there.
    pub(super) kind: Kind,
}

/// What acts at a stop.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub(super) enum Kind {
    /// A group's dampers, one by one.
    #[default]
    Dampers,
    /// The levers of a joint to the ground.
    Ground,
    /// The levers of a joint between two bodies.
    Joint,
    /// The lever of a raw spring.
    Raw,
    /// The lever of a torsion spring.
    Torsion,
}

impl Stop {
    /// A stop with its rows: what acts, its first lever, and how many levers.
    pub(super) fn new(kind: Kind, ends: [BodyIndex; 2], [of, row, count]: [usize; 3]) -> Self {
        let ends = ends.map(|end| end.0);
        Self { ends, of: of as u16, row: row as u16, count: count as u8, kind }
    }
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
    /// takes `1 − 1/(1 + x + x²/2)`, `x = h·rate`, and is told as any damper (`damping::pair::Damper`)
    /// of the rate that the kick gave, `kicked`.
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
        let told = [given + later * impulse, given + (one - (own + later)) * impulse];
        self.impulse = impulse;
        self.less = told.map(|told| told * kicked);
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
