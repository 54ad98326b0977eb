//! Sources that drive an input other than a plain table over time: a sine, a periodic table, a table over a sensor.
//!
//! `scene => constants`; [`crate::sources`] computes their signals. A model without sources contains neither data nor
//! code for them.

use crate::elements::input::Knot;
use crate::geometry::Geometry;
use crate::index::{BodyIndex, InputIndex, TorsionIndex};
use crate::real::Real;

/// A source of a model: an input and its law. The input has no knots of its own.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Source<P: Geometry> {
    /// The input.
    pub input: InputIndex,
    /// Its first knot among the model's knots.
    pub knot: u16,
    /// The number of its knots; 0 for a sine.
    pub knots: u16,
    /// The law of the input.
    pub law: SourceLaw<P>,
}

/// The law of a source.
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum SourceLaw<P: Geometry> {
    /// `offset + amplitude·sin(2π·(t/period + phase))`.
    Sine {
        /// \[s\] > 0.
        period: f64,
        /// \[1\] revolutions at t = 0.
        phase: f64,
        /// \[N, N·m or m\].
        amplitude: P::Real,
        /// \[1/s\] the amplitude of the value's rate, `2π·amplitude/period`.
        rate: P::Real,
        /// \[N, N·m or m\].
        offset: P::Real,
    },
    /// Its knots, repeated before and after. The first begins the period; the slope of the last applies until its end.
    Periodic {
        /// \[s\] > 0.
        period: f64,
    },
    /// Its knots over a sensor's value at the start of a step, held over the step: their times are values of
    /// `weights·reading + offset`.
    Over {
        /// The sensor.
        sensor: Sensor<P>,
        /// The direction for a vector; a scalar uses the first weight.
        weights: [P::Real; 3],
        /// In the unit of the reading.
        offset: P::Real,
    },
}

/// A sensor of poses and velocities only: its value depends on no force and no input.
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum Sensor<P: Geometry> {
    /// \[rad\] the torsion angle of a torsion spring, unwrapped.
    Angle {
        /// Its index among the torsion springs.
        spring: TorsionIndex,
        /// \[rad\] the value at a torsion angle of 0.
        offset: P::Real,
    },
    /// \[rad/s\] the rate of that torsion angle.
    Rate {
        /// The spring's index among the torsion springs.
        spring: TorsionIndex,
    },
    /// \[m\] the position of a point of a body, world.
    Point {
        /// The body.
        body: BodyIndex,
        /// The point in body axes.
        point: P::Local,
    },
    /// \[m/s\] the velocity of a point of a body, world.
    Velocity {
        /// The body.
        body: BodyIndex,
        /// The point in body axes.
        point: P::Local,
    },
}

impl<P: Geometry> Sensor<P> {
    /// The same sensor in another precision.
    pub fn convert<Q: Geometry>(&self) -> Sensor<Q> {
        let local = |point: P::Local| Q::local_from_f64(P::local_to_f64(&point));
        match *self {
            Sensor::Angle { spring, offset } => {
                Sensor::Angle { spring, offset: Q::Real::from_f64(offset.to_f64()) }
            }
            Sensor::Rate { spring } => Sensor::Rate { spring },
            Sensor::Point { body, point } => Sensor::Point { body, point: local(point) },
            Sensor::Velocity { body, point } => Sensor::Velocity { body, point: local(point) },
        }
    }
}

impl<P: Geometry> Source<P> {
    /// A sine of `frequency` \[1/s\], at t = 0 at the angle `phase` \[rad\]; amplitude and offset in the
    /// unit of the input.
    pub fn sine(input: InputIndex, [amplitude, frequency, phase, offset]: [f64; 4]) -> Self {
        let turn = 2.0 * core::f64::consts::PI;
        let real = P::Real::from_f64;
        let law = SourceLaw::Sine {
            period: 1.0 / frequency,
            phase: phase / turn,
            amplitude: real(amplitude),
            rate: real(turn * frequency * amplitude),
            offset: real(offset),
        };
        Self { input, knot: 0, knots: 0, law }
    }

    /// Its knots, `all` those of the model.
    #[must_use]
    pub fn knots_of<'k, T>(&self, all: &'k [T]) -> &'k [T] {
        let first = self.knot as usize;
        all.get(first..first + self.knots as usize).unwrap_or(&[])
    }

    /// Whether its constants and all of its values are representable in the precision.
    #[must_use]
    pub fn is_finite(&self, knots: &[Knot<P::Real>]) -> bool {
        let knots = self.knots_of(knots);
        let next = |i: usize| knots.get(i + 1);
        let law = match self.law {
            SourceLaw::Sine { amplitude, rate, offset, .. } => {
                rate.is_finite() && (amplitude.abs() + offset.abs()).is_finite()
            }
            SourceLaw::Periodic { period } => P::Real::from_f64(period).is_finite(),
            SourceLaw::Over { .. } => {
                knots.iter().all(|knot| P::Real::from_f64(knot.time).is_finite())
            }
        };
        law && knots.iter().enumerate().all(|(i, knot)| knot.is_finite(next(i)))
    }

    /// The largest magnitude of its value and of its rate; the rate of a jump and that of a table over a sensor are
    /// excluded.
    #[must_use]
    pub fn most(&self, knots: &[Knot<P::Real>]) -> [f64; 2] {
        if let SourceLaw::Sine { amplitude, rate, offset, .. } = self.law {
            return [amplitude.to_f64().abs() + offset.to_f64().abs(), rate.to_f64().abs()];
        }
        let knots = self.knots_of(knots);
        let mut most = [0.0_f64; 2];
        for (i, knot) in knots.iter().enumerate() {
            let (value, slope) = (knot.value.to_f64(), knot.slope.to_f64());
            let span = match (knots.get(i + 1), self.law, knots.first()) {
                (Some(next), ..) => next.time - knot.time,
                (None, SourceLaw::Periodic { period }, Some(first)) => {
                    first.time + period - knot.time
                }
                _ => 0.0,
            };
            let end = value + slope * span;
            most = [most[0].max(value.abs()).max(end.abs()), most[1].max(slope.abs())];
        }
        match self.law {
            SourceLaw::Over { .. } => [most[0], 0.0],
            _ => most,
        }
    }

    /// The same source in another precision.
    pub fn convert<Q: Geometry>(&self) -> Source<Q> {
        let real = |number: P::Real| Q::Real::from_f64(number.to_f64());
        let law = match self.law {
            SourceLaw::Sine { period, phase, amplitude, rate, offset } => SourceLaw::Sine {
                period,
                phase,
                amplitude: real(amplitude),
                rate: real(rate),
                offset: real(offset),
            },
            SourceLaw::Periodic { period } => SourceLaw::Periodic { period },
            SourceLaw::Over { sensor, weights, offset } => SourceLaw::Over {
                sensor: sensor.convert(),
                weights: weights.map(real),
                offset: real(offset),
            },
        };
        Source { input: self.input, knot: self.knot, knots: self.knots, law }
    }
}
