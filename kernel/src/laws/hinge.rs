//! The rotation of B in A about an axis: the torsion angle of torsion springs, for laws about an axis.

use crate::elements::torsion_spring::{SinceStart, TorsionSpring};
use crate::geometry::Geometry;
use crate::index::{BodyIndex, DamperIndex};
use crate::laws::end::Seen;
use crate::real::Real;
use crate::space::{Linear as _, Moment as _, Space, Turn as _};
use crate::words::{Word, WordSource, WordVisitor, Words};

/// \[½ revolution\] the number of half revolutions of a torsion angle: memory of a law about an axis.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub struct Turns(pub i32);

impl Turns {
    /// Only its parity: with it a torsion angle stays near 0 at any revolution count.
    #[inline(always)]
    #[must_use]
    pub fn odd(self) -> Self {
        Self(self.0 & 1)
    }

    /// \[rad\] a torsion angle minus that of [`Self::odd`].
    #[inline(always)]
    #[must_use]
    pub fn whole<R: Real>(self) -> R {
        let even = self.0 - (self.0 & 1);
        R::counts(&[even]).first().map_or(R::ZERO, |count| R::from_count(*count) * (R::TWO * R::PI))
    }
}

impl Words for Turns {
    fn visit(&self, visitor: &mut impl WordVisitor) {
        visitor.word(Word::I32(self.0));
    }
    fn fill(&mut self, source: &mut impl WordSource) {
        self.0 = source.take(4) as i32;
    }
}

/// An axis of A about which B rotates, see [`crate::elements::torsion_spring`].
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Hinge<S: Space> {
    /// \[1\] unit axis in A's axes.
    pub axis: S::Moment,
    /// \[1\] inverse of B's orientation in A at t = 0.
    pub reference: S::Turn,
}

/// A torsion angle at a pose.
pub struct Twisted<S: Space> {
    spring: TorsionSpring<S>,
    since: SinceStart<S>,
}

impl<S: Space> Hinge<S> {
    /// \[1\] the axis in B's axes, if it is fixed in B.
    #[inline(always)]
    #[must_use]
    pub fn of_b(&self) -> S::Moment {
        let (mut w, mut v) = (S::Real::ZERO, S::Moment::ZERO);
        for axis in S::Moment::axes() {
            let (cosine, sine) = self.reference.about(axis);
            (w, v) = (cosine, v + axis * sine);
        }
        let across = v.commutator(self.axis) * S::Real::TWO;
        self.axis + across * w + v.commutator(across)
    }

    /// The rotation of B since t = 0; `None` where its torsion angle is undefined. Not for lanes.
    #[inline(always)]
    pub fn seen<P: Geometry<Space = S>>(&self, seen: &Seen<'_, P>) -> Option<Twisted<S>> {
        let spring = TorsionSpring {
            a: BodyIndex::WORLD,
            b: BodyIndex::WORLD,
            axis: self.axis,
            reference: self.reference,
            stiffness: S::Real::ZERO,
            preload: S::Real::ZERO,
            damper: DamperIndex::NONE,
        };
        let since = spring.since_start(seen.a.turn_of(&seen.b))?;
        Some(Twisted { spring, since })
    }
}

impl<S: Space> Twisted<S> {
    /// Updates a revolution count to the half revolution nearest to the pose.
    #[inline(always)]
    pub fn settle(&self, turns: &mut Turns) {
        let counts = core::slice::from_mut(&mut turns.0);
        if let Some(count) = S::Real::counts_mut(counts).first_mut() {
            *count = self.since.settled(*count);
        }
    }

    /// \[rad\] the unwrapped torsion angle since t = 0, and \[1\] its gradient with respect to a rotation of B in A's
    /// axes.
    #[inline(always)]
    pub fn angle(&self, turns: Turns) -> (S::Real, S::Moment) {
        match S::Real::counts(&[turns.0]).first() {
            Some(count) => {
                let torsion_angle = self.spring.torsion_angle(&self.since, *count);
                (torsion_angle.angle, torsion_angle.gradient)
            }
            None => (S::Real::ZERO, self.gradient()),
        }
    }

    /// \[1\] its gradient only.
    #[inline(always)]
    pub fn gradient(&self) -> S::Moment {
        self.since.gradient(self.spring.axis)
    }
}
