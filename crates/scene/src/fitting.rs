//! Steps of which a duration and a sampling interval are whole multiples.
//!
//! `(duration, every) => span; span => steps that divide it`. Uses only + − × ÷ and conversions to integers, so every
//! host finds the same steps.

use std::cmp::Ordering;

/// Relative tolerance of a whole quotient.
pub const WHOLE: f64 = 1e-9;

/// Maximum number of parts of the sampling interval to try. More would make the step unreasonably short, and
/// eventually any number fits within 1e-9.
const MAX_INTERVALS: u64 = 1000;

/// Mantissas of round steps.
const MANTISSAS: [f64; 7] = [8.0, 5.0, 4.0, 2.5, 2.0, 1.25, 1.0];

/// \[s\] common intervals of controllers that a round step divides.
const COMMON: [f64; 2] = [1e-3, 1.0];

/// Beyond this every quotient is whole and may overflow an integer.
const LARGEST: f64 = (1_u64 << 53) as f64;

/// `quotient` as a whole number ≥ 1, within [`WHOLE`]; `None` beyond 2⁵³.
#[must_use]
pub fn whole(quotient: f64) -> Option<u64> {
    // NaN is not whole.
    if !matches!(quotient.partial_cmp(&LARGEST), Some(Ordering::Less | Ordering::Equal)) {
        return None;
    }
    let nearest = (quotient + 0.5) as u64;
    let excess = quotient - nearest as f64;
    let tolerance = WHOLE * quotient;
    (nearest >= 1 && -tolerance <= excess && excess <= tolerance).then_some(nearest)
}

/// The longest time that every fitting step divides: the sampling interval or, without one, the duration.
#[derive(Clone, Copy, Debug)]
pub struct Span {
    duration: f64,
    every: Option<f64>,
    /// A fitting step divides each sampling interval into a multiple of this number of parts.
    intervals: u64,
}

impl Span {
    /// The span of a duration \[s\] and a sampling interval \[s\]; `None` where no step divides both.
    #[must_use]
    pub fn new(duration: f64, every: Option<f64>) -> Option<Self> {
        let ratio = duration / every.unwrap_or(duration);
        let intervals = (1..=MAX_INTERVALS).find(|count| whole(ratio * *count as f64).is_some())?;
        Some(Self { duration, every, intervals })
    }

    fn time(&self) -> f64 {
        self.every.unwrap_or(self.duration)
    }

    /// The longest step that fits.
    #[must_use]
    pub fn longest(&self) -> f64 {
        self.step(self.intervals)
    }

    /// \[s\] the step for this number of parts of the span.
    #[must_use]
    pub fn step(&self, parts: u64) -> f64 {
        self.time() / parts as f64
    }

    /// The smallest number of parts with a length of at most `limit`.
    #[must_use]
    pub fn parts_at_most(&self, limit: f64) -> u64 {
        let exact = self.time() / limit / self.intervals as f64;
        let below = exact as u64;
        let above = if (below as f64) < exact { below + 1 } else { below };
        above.max(1) * self.intervals
    }

    /// \[s\] The longest round step up to `limit`: 1, 1.25, 2, 2.5, 4, 5 or 8 times a power of ten, of which 1 ms,
    /// beyond that 1 s, is a multiple as well. If none of at least a third of the longest fitting step fits, the
    /// latter.
    #[must_use]
    pub fn round_step(&self, limit: f64) -> f64 {
        let longest = self.step(self.parts_at_most(limit));
        let text = format!("{longest:e}");
        let exponent = text.split_once('e').and_then(|(_, digits)| digits.parse::<i32>().ok());
        let round = exponent.into_iter().flat_map(|exponent| {
            let of = move |power: i32| MANTISSAS.map(|m| format!("{m}e{power}").parse::<f64>());
            of(exponent).into_iter().chain(of(exponent - 1)).flatten()
        });
        let common = |step: f64| COMMON.into_iter().find(|time| step <= *time);
        let is_fit = |step: &f64| {
            *step <= limit
                && *step <= longest * (1.0 + WHOLE)
                && 3.0 * *step >= longest
                && self.fits(*step)
                && common(*step).is_none_or(|time| whole(time / *step).is_some())
        };
        round.into_iter().find(is_fit).unwrap_or(longest)
    }

    /// The two fitting steps nearest to `step`, one on each side if it exists.
    #[must_use]
    pub fn nearest_steps(&self, step: f64) -> Vec<f64> {
        let below = (self.time() / step / self.intervals as f64) as u64;
        let first = below.max(1);
        let steps = [first, first + 1].map(|count| self.step(count * self.intervals));
        let mut fitting: Vec<f64> = steps.into_iter().filter(|step| self.fits(*step)).collect();
        let distance = |t: &f64| if *t > step { t - step } else { step - t };
        fitting.sort_by(|a, b| distance(a).total_cmp(&distance(b)));
        fitting
    }

    fn fits(&self, step: f64) -> bool {
        whole(self.duration / step).is_some() && whole(self.time() / step).is_some()
    }
}
