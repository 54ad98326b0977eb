//! Signal chains: the error model of a sensor, sampling, delay, lag and limits of a signal.
//!
//! `value => (((value + bias + walk) + noise) limited, rounded to a multiple of the resolution)`. Each term is skipped if
//! its parameter is 0. Terms as in IEEE Std 952-1997, annex C: white noise by its deviation per sample, random walk by
//! its deviation after one second.

use crate::random::Stream;
use crate::real::{Constant, Mask as _, Real};
use crate::words::{Word, WordSource, WordVisitor, Words};

/// The largest delay in samples.
pub const MAX_DELAY: usize = 16;

/// Errors of a sensor in a precision.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Errors<R> {
    /// \[unit\] standard deviation of the white noise of a sample, ≥ 0.
    pub noise: R,
    /// \[unit\] constant bias.
    pub bias: R,
    /// \[unit\] standard deviation of the change of the bias between samples, ≥ 0.
    pub walk: R,
    /// \[unit\] resolution, ≥ 0; 0 for none.
    pub resolution: R,
    /// \[unit\] smallest and largest output.
    pub range: [R; 2],
}

/// Random numbers of a sensor, and the walk of its bias.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub struct Wander<R> {
    /// The stream of the noise.
    pub noises: Stream,
    /// The stream of the walk.
    pub walks: Stream,
    /// \[unit\] the walk so far.
    pub walk: R,
}

impl<R: Real> Errors<R> {
    /// The next sample of an exact value.
    #[inline]
    pub fn sample(&self, actual: R, wander: &mut Wander<R>) -> R {
        let mut value = actual + self.bias;
        if self.walk != R::ZERO {
            wander.walk = wander.walk + self.walk * wander.walks.normal::<R>();
            value = value + wander.walk;
        }
        if self.noise != R::ZERO {
            value = value + self.noise * wander.noises.normal::<R>();
        }
        value = limited(value, self.range);
        if self.resolution != R::ZERO {
            value = rounded(value / self.resolution) * self.resolution;
        }
        value
    }
}

/// A value within bounds.
#[inline(always)]
#[must_use]
pub fn limited<R: Real>(value: R, [least, most]: [R; 2]) -> R {
    let value = R::pick(value.less_than(least), least, value);
    R::pick(most.less_than(value), most, value)
}

/// 1/ε: from here on every number is an integer; below, the last place of the sum with it is 1.
const WHOLE: Constant = Constant { double: 4_503_599_627_370_496.0, single: 8_388_608.0 };

/// The nearest integer, ties to even. By additions: `core` has no rounding.
#[inline(always)]
#[must_use]
pub fn rounded<R: Real>(value: R) -> R {
    let whole = R::constant(WHOLE);
    let away = R::pick(value.less_than(R::ZERO), -whole, whole);
    R::pick(value.abs().less_than(whole), (value + away) - away, value)
}

/// The times of samples at a fixed period.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub struct Sampler<R> {
    /// Whether the first sample was taken.
    pub begun: bool,
    /// \[s\] time since the last sample.
    pub phase: R,
}

impl<R: Real> Sampler<R> {
    /// Whether a sample is due after a further step of `h` \[s\]: within half a step of its time. A period of 0 samples
    /// every step.
    #[inline(always)]
    pub fn is_due(&mut self, h: R, period: R) -> bool {
        let phase = self.phase + h;
        let is_due = period.at_most(phase + R::HALF * h);
        self.phase = R::pick(is_due, phase - period, phase);
        if period == R::ZERO {
            self.phase = R::ZERO;
        }
        is_due.any()
    }
}

/// The last samples, to delay a signal.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub struct DelayLine<R> {
    values: [R; MAX_DELAY],
    next: u32,
}

impl<R: Real> DelayLine<R> {
    /// Fills it with the first sample.
    #[inline(always)]
    pub fn begin(&mut self, value: R) {
        self.values = [value; MAX_DELAY];
        self.next = 0;
    }

    /// Adds a sample; returns that of `delay` samples ago, at most [`MAX_DELAY`].
    #[inline(always)]
    pub fn push(&mut self, value: R, delay: u32) -> R {
        let Some(place) = self.values.get_mut(self.next as usize).filter(|_| delay > 0) else {
            return value;
        };
        let old = core::mem::replace(place, value);
        self.next = if self.next + 1 < delay { self.next + 1 } else { 0 };
        old
    }
}

/// A first-order lag over a step of `h` \[s\]: from `from` towards `to`. The exponential is 1/(1 + x + x²/2) for x =
/// h/lag (Padé (0,2), L-stable); a lag of 0 follows at once.
#[inline(always)]
#[must_use]
pub fn lagged<R: Real>([from, to]: [R; 2], h: R, lag: R) -> R {
    if lag == R::ZERO {
        return to;
    }
    let x = h / lag;
    let growth = x + R::HALF * (x * x);
    from + (to - from) * (growth / (R::ONE + growth))
}

impl<R: Real> Words for Wander<R> {
    fn visit(&self, visitor: &mut impl WordVisitor) {
        self.noises.visit(visitor);
        self.walks.visit(visitor);
        visitor.word(self.walk.word());
    }
    fn fill(&mut self, source: &mut impl WordSource) {
        self.noises.fill(source);
        self.walks.fill(source);
        self.walk = R::from_words(source);
    }
}

impl<R: Real> Words for Sampler<R> {
    fn visit(&self, visitor: &mut impl WordVisitor) {
        visitor.word(Word::I32(i32::from(self.begun)));
        visitor.word(self.phase.word());
    }
    fn fill(&mut self, source: &mut impl WordSource) {
        self.begun = source.take(4) != 0;
        self.phase = R::from_words(source);
    }
}

impl<R: Real> Words for DelayLine<R> {
    fn visit(&self, visitor: &mut impl WordVisitor) {
        self.values.iter().for_each(|value| visitor.word(value.word()));
        visitor.word(Word::I32(self.next as i32));
    }
    fn fill(&mut self, source: &mut impl WordSource) {
        self.values.iter_mut().for_each(|value| *value = R::from_words(source));
        // A damaged count only misplaces samples.
        self.next = (source.take(4) as u32).min(MAX_DELAY as u32 - 1);
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn numbers_are_rounded_to_the_nearest_even() {
        for (x, nearest) in [
            (0.5, 0.0),
            (1.5, 2.0),
            (-0.75, -1.0),
            (-2.5, -2.0),
            (3.49, 3.0),
            (1e15, 1e15),
            (1e300, 1e300),
        ] {
            assert_eq!(rounded(x), nearest, "{x}");
        }
        assert_eq!((rounded(2.5_f32), rounded(-7.6_f32), rounded(5e6_f32)), (2.0, -8.0, 5e6));
    }

    /// Samples at 1 ms with steps of 0.3 ms: within half a step of their times, none lost.
    #[test]
    fn samples_are_taken_at_their_times() {
        let mut sampler = Sampler::default();
        let taken: std::vec::Vec<u32> = (1..=40).filter(|_| sampler.is_due(0.3_f32, 1.0)).collect();
        let expected: std::vec::Vec<u32> =
            (1..=12).map(|sample| (f64::from(sample) / 0.3).round() as u32).collect();
        assert_eq!(taken, expected);
        assert!((1..4).all(|_| Sampler::default().is_due(0.1_f64, 0.0)));
    }

    #[test]
    fn a_delay_is_exact_in_samples() {
        for delay in 0..=MAX_DELAY as u32 {
            let mut line = DelayLine::default();
            line.begin(-1.0);
            for sample in 0..50 {
                let old = line.push(f64::from(sample), delay);
                let expected = if sample < delay { -1.0 } else { f64::from(sample - delay) };
                assert_eq!(old, expected);
            }
        }
    }

    /// The error of a uniform quantity rounded to a resolution q is uniform: deviation q/√12, within ±q/2.
    #[test]
    fn the_error_of_a_resolution_is_uniform() {
        let errors =
            Errors { noise: 0.0, bias: 0.0, walk: 0.0, resolution: 0.01, range: [-1e9, 1e9] };
        let (mut square, mut most, count) = (0.0, 0.0_f64, 100_000);
        for step in 0..count {
            let value = f64::from(step) * 0.000_317_7;
            let error = errors.sample(value, &mut Wander::default()) - value;
            (square, most) = (square + error * error, most.max(error.abs()));
        }
        let deviation = (square / f64::from(count)).sqrt();
        assert!(
            (deviation - 0.01 / 12.0_f64.sqrt()).abs() < 1e-5 && most <= 0.005 + 1e-9,
            "{deviation} {most}"
        );
    }

    #[test]
    fn a_lag_follows_an_exponential() {
        for (h, off) in [(0.1, 2e-3), (0.05, 5e-4)] {
            let mut value = 0.0;
            for _ in 0..(1.0 / h) as u32 {
                value = lagged([value, 1.0], h, 0.5);
            }
            assert!((value - (1.0 - (-2.0_f64).exp())).abs() < off, "{value}");
        }
        // A lag far below the step is stable and at its end.
        assert!((lagged([0.0, 1.0], 1.0, 1e-6) - 1.0_f64).abs() < 1e-10);
        assert_eq!(lagged([0.0, 1.0], 1.0, 0.0), 1.0);
    }
}
