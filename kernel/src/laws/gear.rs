//! A gear with the rotor behind it: its constants, and the rotor's memory; see [`super::rotor`].

use crate::laws::interaction::{Inner, Wrong};
use crate::real::Real;
use crate::words::{Word, WordSource, WordVisitor, Words};

/// A drive's memory of its rotor, at the side of the coordinate.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Rotor<R> {
    /// \[m, rad\] the coordinate at the end of the last step.
    pub last: R,
    /// \[m, rad\] δ, the rotor's lead over it.
    pub ahead: R,
    /// \[m/s, rad/s\] its rate v.
    pub rate: R,
    /// \[N, N·m\] the effort τ.
    pub effort: R,
    /// Whether its rate is initialised: at first it equals that of the coordinate.
    pub begun: bool,
}

impl<R: Real> Default for Rotor<R> {
    fn default() -> Self {
        let zero = R::ZERO;
        Self { last: zero, ahead: zero, rate: zero, effort: zero, begun: false }
    }
}

impl<R: Real> Rotor<R> {
    /// Advances its lead by `h` \[s\].
    #[inline(always)]
    pub(super) fn advance(&mut self, h: R) {
        self.ahead = self.ahead + h * self.rate;
    }

    /// \[W\] the power of the effort.
    pub(super) fn supply(&self) -> R {
        self.effort * self.rate
    }
}

impl<R: Real> Words for Rotor<R> {
    fn visit(&self, visitor: &mut impl WordVisitor) {
        let numbers = [self.last, self.ahead, self.rate, self.effort];
        numbers.iter().for_each(|number| visitor.word(number.word()));
        visitor.word(Word::I32(i32::from(self.begun)));
    }
    fn fill(&mut self, source: &mut impl WordSource) {
        for number in [&mut self.last, &mut self.ahead, &mut self.rate, &mut self.effort] {
            *number = R::from_words(source);
        }
        self.begun = source.take(4) != 0;
    }
}

/// The constants of a gear with the rotor behind it, in N, m or N·m, rad.
#[derive(Clone, Copy)]
pub(super) struct Gear<R> {
    /// m.
    pub(super) inertia: R,
    /// k.
    pub(super) stiffness: R,
    /// c.
    pub(super) damping: R,
    pub(super) play: R,
    /// \[s\] T.
    pub(super) lag: R,
}

impl<R: Real> Gear<R> {
    /// Refuses invalid constants.
    pub(super) fn check(&self) -> Result<(), Wrong> {
        let zero = R::ZERO;
        Wrong::unless(self.inertia > zero, "inertia", "is not positive", "an inertia > 0")?;
        Wrong::unless(self.stiffness > zero, "stiffness", "is not positive", "a stiffness > 0")?;
        Wrong::unless(self.damping >= zero, "damping", "is negative", "a number ≥ 0")?;
        Wrong::unless(self.play >= zero, "play", "is negative", "a number ≥ 0")?;
        Wrong::unless(self.lag >= zero, "lag", "is negative", "a time ≥ 0")
    }

    /// The rotor as a degree of freedom; `kick` \[m/s, rad/s\] is its change by the kick.
    #[inline(always)]
    pub(super) fn inner(&self, rotor: &Rotor<R>, kick: R) -> Inner<R> {
        Inner { rate: rotor.rate, kick, inverse_inertia: R::ONE / self.inertia }
    }

    /// \[rad²/s²\] the square of the rotor's natural frequency with a fixed coordinate, including the stiffness of a
    /// servo.
    pub(super) fn square(&self, servo: R) -> R {
        (self.stiffness + servo) / self.inertia
    }

    /// The part of δ beyond half of the backlash.
    #[inline(always)]
    pub(super) fn dead(&self, ahead: R) -> R {
        let half = R::HALF * self.play;
        let (above, below) = (ahead - half, ahead + half);
        let beyond = R::pick(R::ZERO.less_than(above), above, R::ZERO);
        R::pick(below.less_than(R::ZERO), below, beyond)
    }
}
