//! Actuators at a joint: a torque about an axis or a force along one that follows a command with a sample period, a
//! delay, limits, a rate limit and a lag, by [`crate::chain`].
//!
//! The command is sampled at the end of a step: a step has the effort of the command before it, so that the shortest
//! delay is one step.

use crate::chain::{DelayLine, MAX_DELAY, Sampler, lagged, limited};
use crate::force_pair::ForcePair;
use crate::geometry::Geometry;
use crate::laws::coordinate::Coordinate;
use crate::laws::end::Seen;
use crate::laws::hinge::Turns;
use crate::laws::interaction::{Interaction, Quantity, Springs, Wrong};
use crate::real::Real;
use crate::words::{WordSource, WordVisitor, Words};

law! {
    /// A torque about an axis that follows a command with delay, limits and lag.
    pub struct HingeActuator = "hinge-actuator" {
        /// Axis of the torque on the second body.
        axis: Axis,
        /// Input that commands it.
        input: Signal,
        /// Time constant of its lag.
        lag: Number("s") = 0.0,
        /// Smallest effort.
        least: Number("N·m") = -1e30,
        /// Largest effort.
        most: Number("N·m") = 1e30,
        /// Largest rate of change of the effort.
        rate_limit: Number("N·m/s") = 1e30,
        /// Time between samples of the command; 0 for every step.
        period: Number("s") = 0.0,
        /// Samples by which the command is late, at most 16.
        delay: Count,
    }
}

law! {
    /// A force along an axis that follows a command with delay, limits and lag.
    pub struct SlideActuator = "slide-actuator" {
        /// A point of the first body and the driven point of the second body.
        points: Points,
        /// Axis of the force on the second body.
        axis: Normal,
        /// Input that commands it.
        input: Signal,
        /// Time constant of its lag.
        lag: Number("s") = 0.0,
        /// Smallest effort.
        least: Number("N") = -1e30,
        /// Largest effort.
        most: Number("N") = 1e30,
        /// Largest rate of change of the effort.
        rate_limit: Number("N/s") = 1e30,
        /// Time between samples of the command; 0 for every step.
        period: Number("s") = 0.0,
        /// Samples by which the command is late, at most 16.
        delay: Count,
    }
}

/// The memory of an actuator.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub struct Actuated<R> {
    /// \[N, N·m\] its effort.
    pub effort: R,
    /// \[N, N·m\] the command that it follows.
    pub command: R,
    sampler: Sampler<R>,
    line: DelayLine<R>,
}

impl<R: Real> Words for Actuated<R> {
    fn visit(&self, visitor: &mut impl WordVisitor) {
        visitor.word(self.effort.word());
        visitor.word(self.command.word());
        self.sampler.visit(visitor);
        self.line.visit(visitor);
    }
    fn fill(&mut self, source: &mut impl WordSource) {
        self.effort = R::from_words(source);
        self.command = R::from_words(source);
        self.sampler.fill(source);
        self.line.fill(source);
    }
}

/// The parameters of an actuator.
struct Chain<R> {
    lag: R,
    range: [R; 2],
    rate_limit: R,
    period: R,
    delay: u32,
}

impl<R: Real> Actuated<R> {
    /// Starts at the command at t = 0.
    #[inline(always)]
    fn begin(&mut self, chain: &Chain<R>, command: R) {
        if self.sampler.begun {
            return;
        }
        self.sampler.begun = true;
        self.command = limited(command, chain.range);
        self.effort = self.command;
        self.line.begin(self.command);
    }

    /// Follows the command over a step of `h` \[s\].
    #[inline(always)]
    fn advance(&mut self, chain: &Chain<R>, h: R, command: R) {
        if !self.sampler.begun {
            return;
        }
        if self.sampler.is_due(h, chain.period) {
            self.command = self.line.push(limited(command, chain.range), chain.delay);
        }
        let towards = lagged([self.effort, self.command], h, chain.lag);
        let most = chain.rate_limit * h;
        self.effort = self.effort + limited(towards - self.effort, [-most, most]);
    }
}

impl<P: Geometry> HingeActuator<P> {
    #[inline(always)]
    fn coordinate(&self, seen: &Seen<'_, P>) -> Option<Coordinate<P>> {
        Coordinate::turn(seen, &self.axis, Turns::default())
    }
}

impl<P: Geometry> SlideActuator<P> {
    #[inline(always)]
    fn coordinate(&self, seen: &Seen<'_, P>) -> Option<Coordinate<P>> {
        Some(Coordinate::travel(seen, &self.points, self.axis))
    }
}

macro_rules! actuator {
    ($law:ident, $unit:literal) => {
        impl<P: Geometry> $law<P> {
            #[inline(always)]
            fn chain(&self) -> Chain<P::Real> {
                let Self { lag, least, most, rate_limit, period, delay, .. } = *self;
                Chain { lag, range: [least, most], rate_limit, period, delay }
            }
        }

        impl<P: Geometry> Interaction<P> for $law<P> {
            type State = Actuated<P::Real>;
            type Dampers = [(); 0];
            const ADVANCES: bool = true;
            const SLIPS: bool = false;
            const QUANTITIES: &'static [Quantity] = &[Quantity { name: "effort", unit: $unit }];

            #[inline(always)]
            fn settle(&self, seen: &Seen<'_, P>, actuated: &mut Actuated<P::Real>) {
                actuated.begin(&self.chain(), seen.input(self.input));
            }

            #[inline(always)]
            fn advance(&self, seen: &Seen<'_, P>, h: P::Real, actuated: &mut Actuated<P::Real>) {
                actuated.advance(&self.chain(), h, seen.input(self.input));
            }

            #[inline(always)]
            fn force_pair(
                &self,
                seen: &Seen<'_, P>,
                actuated: &Actuated<P::Real>,
            ) -> Option<ForcePair<P::Space>> {
                Some(self.coordinate(seen)?.pull(seen, -actuated.effort))
            }

            fn energy(&self, _: &Seen<'_, P>, _: &Actuated<P::Real>) -> P::Real {
                P::Real::ZERO
            }

            fn tangent(
                &self,
                seen: &Seen<'_, P>,
                actuated: &Actuated<P::Real>,
                visit: Springs<'_, P>,
            ) -> [P::Real; 2] {
                let Some(coordinate) = self.coordinate(seen) else { return [P::Real::ZERO; 2] };
                coordinate.bent(seen, actuated.effort.abs(), visit)
            }

            fn supply(&self, seen: &Seen<'_, P>, actuated: &Actuated<P::Real>) -> P::Real {
                let Some(coordinate) = self.coordinate(seen) else { return P::Real::ZERO };
                actuated.effort * seen.rate(&coordinate.direction(seen))
            }

            fn check(&self) -> Result<(), Wrong> {
                let zero = P::Real::ZERO;
                for (field, value) in [("lag", self.lag), ("period", self.period)] {
                    Wrong::unless(value >= zero, field, "is negative", "a time ≥ 0")?;
                }
                let moves = self.rate_limit > zero;
                Wrong::unless(moves, "rate_limit", "is not positive", "a number > 0")?;
                Wrong::unless(self.least < self.most, "most", "is not above `least`", "larger")?;
                let fits = self.delay as usize <= MAX_DELAY;
                Wrong::unless(
                    fits,
                    "delay",
                    "is too long",
                    "at most 16 samples; use a longer `period`",
                )
            }

            fn read(&self, _: usize, seen: &Seen<'_, P>, actuated: &Actuated<P::Real>) -> P::Real {
                // Before the first step it has not begun.
                let mut first = *actuated;
                self.settle(seen, &mut first);
                first.effort
            }
        }
    };
}

actuator!(HingeActuator, "N·m");
actuator!(SlideActuator, "N");
