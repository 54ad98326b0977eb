//! Sensors of a coordinate: a rotation about an axis or a translation along one, with noise, bias, walk, resolution, range, sample period and delay.
//!
//! A sensor exerts no force. It takes a sample of its coordinate or of its rate at the end of a step, by
//! [`crate::chain`], and keeps it until the next one.

use crate::chain::{DelayLine, Errors, MAX_DELAY, Sampler, Wander};
use crate::force_pair::ForcePair;
use crate::geometry::Geometry;
use crate::laws::coordinate::Coordinate;
use crate::laws::end::Seen;
use crate::laws::hinge::Turns;
use crate::laws::interaction::{Interaction, Quantity, Springs, Wrong};
use crate::random::Stream;
use crate::real::Real;
use crate::words::{WordSource, WordVisitor, Words};

law! {
    /// A sensor of the rotation of the second body relative to the first about an axis, or of its rate, in rad and s.
    pub struct HingeSensor = "hinge-sensor" {
        /// Axis of rotation; the angle is 0 at t = 0 and includes whole revolutions.
        axis: Axis,
        /// Value at a coordinate of 0.
        offset: Number = 0.0,
        /// 0 for the angle, 1 for its rate.
        of_rate: Number = 0.0,
        /// Standard deviation of the white noise of a sample.
        noise: Number = 0.0,
        /// Constant bias.
        bias: Number = 0.0,
        /// Standard deviation of the random walk of the bias after one second.
        walk: Number = 0.0,
        /// Resolution; 0 for none.
        resolution: Number = 0.0,
        /// Smallest output.
        least: Number = -1e30,
        /// Largest output.
        most: Number = 1e30,
        /// Time between samples; 0 for every step.
        period: Number("s") = 0.0,
        /// Samples by which the output is late, at most 16.
        delay: Count,
        /// Seed of the random numbers.
        seed: Count,
    }
}

law! {
    /// A sensor of the displacement of a point along an axis, or of its rate, in m and s.
    pub struct SlideSensor = "slide-sensor" {
        /// A point of the first body and the sensed point of the second body.
        points: Points,
        /// Axis of the translation.
        axis: Normal,
        /// Value at a coordinate of 0.
        offset: Number = 0.0,
        /// 0 for the displacement, 1 for its rate.
        of_rate: Number = 0.0,
        /// Standard deviation of the white noise of a sample.
        noise: Number = 0.0,
        /// Constant bias.
        bias: Number = 0.0,
        /// Standard deviation of the random walk of the bias after one second.
        walk: Number = 0.0,
        /// Resolution; 0 for none.
        resolution: Number = 0.0,
        /// Smallest output.
        least: Number = -1e30,
        /// Largest output.
        most: Number = 1e30,
        /// Time between samples; 0 for every step.
        period: Number("s") = 0.0,
        /// Samples by which the output is late, at most 16.
        delay: Count,
        /// Seed of the random numbers.
        seed: Count,
    }
}

/// The memory of a sensor.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub struct Sensed<R> {
    /// Half revolutions of its angle.
    pub turns: Turns,
    /// \[unit of the sensor\] its output.
    pub output: R,
    sampler: Sampler<R>,
    wander: Wander<R>,
    line: DelayLine<R>,
}

impl<R: Real> Words for Sensed<R> {
    fn visit(&self, visitor: &mut impl WordVisitor) {
        self.turns.visit(visitor);
        visitor.word(self.output.word());
        self.sampler.visit(visitor);
        self.wander.visit(visitor);
        self.line.visit(visitor);
    }
    fn fill(&mut self, source: &mut impl WordSource) {
        self.turns.fill(source);
        self.output = R::from_words(source);
        self.sampler.fill(source);
        self.wander.fill(source);
        self.line.fill(source);
    }
}

/// The parameters of a sensor.
struct Chain<R> {
    errors: Errors<R>,
    period: R,
    delay: u32,
}

impl<R: Real> Sensed<R> {
    /// Takes the first sample, unless it was taken.
    #[inline(always)]
    fn begin(&mut self, chain: &Chain<R>, seed: u32, actual: R) {
        if self.sampler.begun {
            return;
        }
        self.sampler.begun = true;
        self.wander.noises = Stream::of(u64::from(seed));
        self.wander.walks = Stream::of(u64::from(seed) | 1 << 32);
        let errors = Errors { walk: R::ZERO, ..chain.errors };
        self.output = errors.sample(actual, &mut self.wander);
        self.line.begin(self.output);
    }

    /// Takes a sample after a step of `h` \[s\] if one is due.
    #[inline(always)]
    fn advance(&mut self, chain: &Chain<R>, h: R, actual: R) {
        if self.sampler.begun && self.sampler.is_due(h, chain.period) {
            let between = R::pick(chain.period.less_than(h), h, chain.period);
            let walk = chain.errors.walk * between.sqrt();
            let errors = Errors { walk, ..chain.errors };
            let sample = errors.sample(actual, &mut self.wander);
            self.output = self.line.push(sample, chain.delay);
        }
    }
}

impl<P: Geometry> HingeSensor<P> {
    #[inline(always)]
    fn coordinate(&self, seen: &Seen<'_, P>, turns: &mut Turns) -> Option<Coordinate<P>> {
        let twisted = self.axis.seen(seen)?;
        twisted.settle(turns);
        Coordinate::turn(seen, &self.axis, *turns)
    }
}

impl<P: Geometry> SlideSensor<P> {
    #[inline(always)]
    fn coordinate(&self, seen: &Seen<'_, P>, _: &mut Turns) -> Option<Coordinate<P>> {
        Some(Coordinate::travel(seen, &self.points, self.axis))
    }
}

macro_rules! sensor {
    ($law:ident) => {
        impl<P: Geometry> $law<P> {
            /// The exact value; 0 where the coordinate is undefined.
            #[inline(always)]
            fn actual(&self, seen: &Seen<'_, P>, turns: &mut Turns) -> P::Real {
                let Some(coordinate) = self.coordinate(seen, turns) else { return P::Real::ZERO };
                match self.of_rate == P::Real::ZERO {
                    true => coordinate.value + self.offset,
                    false => seen.rate(&coordinate.direction(seen)) + self.offset,
                }
            }

            #[inline(always)]
            fn chain(&self) -> Chain<P::Real> {
                let Self { noise, bias, walk, resolution, least, most, period, delay, .. } = *self;
                let errors = Errors { noise, bias, walk, resolution, range: [least, most] };
                Chain { errors, period, delay }
            }
        }

        impl<P: Geometry> Interaction<P> for $law<P> {
            type State = Sensed<P::Real>;
            type Dampers = [(); 0];
            const ADVANCES: bool = true;
            const ADVANCE_SETTLES: bool = true;
            const SLIPS: bool = false;
            const QUANTITIES: &'static [Quantity] = &[Quantity { name: "output", unit: "1" }];

            #[inline(always)]
            fn settle(&self, seen: &Seen<'_, P>, sensed: &mut Sensed<P::Real>) {
                let actual = self.actual(seen, &mut sensed.turns);
                sensed.begin(&self.chain(), self.seed, actual);
            }

            #[inline(always)]
            fn advance(&self, seen: &Seen<'_, P>, h: P::Real, sensed: &mut Sensed<P::Real>) {
                let actual = self.actual(seen, &mut sensed.turns);
                sensed.advance(&self.chain(), h, actual);
                sensed.begin(&self.chain(), self.seed, actual);
            }

            #[inline(always)]
            fn force_pair(
                &self,
                _: &Seen<'_, P>,
                _: &Sensed<P::Real>,
            ) -> Option<ForcePair<P::Space>> {
                Some(ForcePair::ZERO)
            }

            fn energy(&self, _: &Seen<'_, P>, _: &Sensed<P::Real>) -> P::Real {
                P::Real::ZERO
            }

            fn tangent(
                &self,
                _: &Seen<'_, P>,
                _: &Sensed<P::Real>,
                _: Springs<'_, P>,
            ) -> [P::Real; 2] {
                [P::Real::ZERO; 2]
            }

            fn check(&self) -> Result<(), Wrong> {
                let zero = P::Real::ZERO;
                for (field, value) in [
                    ("noise", self.noise),
                    ("walk", self.walk),
                    ("resolution", self.resolution),
                    ("period", self.period),
                ] {
                    Wrong::unless(value >= zero, field, "is negative", "a number ≥ 0")?;
                }
                Wrong::unless(self.least < self.most, "most", "is not above `least`", "larger")?;
                let fits = self.delay as usize <= MAX_DELAY;
                Wrong::unless(
                    fits,
                    "delay",
                    "is too long",
                    "at most 16 samples; use a longer `period`",
                )
            }

            fn read(&self, _: usize, seen: &Seen<'_, P>, sensed: &Sensed<P::Real>) -> P::Real {
                // Before the first step there is no sample yet.
                let mut first = *sensed;
                self.settle(seen, &mut first);
                first.output
            }
        }
    };
}

sensor!(HingeSensor);
sensor!(SlideSensor);
