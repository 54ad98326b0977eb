//! Steps of which a duration and a sampling interval are whole multiples.
//!
//! `(duration, every) => span; span => steps that divide it`. In + − × ÷ and conversions to
//! integers only, so that every host finds the same steps.

use std::cmp::Ordering;

/// Relative deviation up to which a quotient counts as whole.
pub const WHOLE: f64 = 1e-9;

/// Sampling intervals that are searched for a number which the duration divides. More would
/// shorten the step beyond what can be meant, and in the end any number fits within 1e-9.
const MOST_INTERVALS: u64 = 1000;

/// Steps that are looked at for a round one.
const ROUND_STEPS: usize = 10_000;

/// Beyond this every quotient is a whole number, and an integer may not hold it.
const LARGEST: f64 = (1_u64 << 53) as f64;

/// The whole number ≥ 1 that `quotient` is, within [`WHOLE`]; none beyond 2⁵³.
pub fn whole(quotient: f64) -> Option<u64> {
    // Not a number is no whole number either.
    if !matches!(quotient.partial_cmp(&LARGEST), Some(Ordering::Less | Ordering::Equal)) {
        return None;
    }
    let nearest = (quotient + 0.5) as u64;
    let excess = quotient - nearest as f64;
    let tolerance = WHOLE * quotient;
    (nearest >= 1 && -tolerance <= excess && excess <= tolerance).then_some(nearest)
}

/// The longest time of which every fitting step is a whole part: the sampling interval, without
/// one the duration.
#[derive(Clone, Copy, Debug)]
pub struct Span {
    duration: f64,
    every: Option<f64>,
    /// How many sampling intervals the duration divides first: a fitting step divides each into
    /// a multiple of so many parts.
    intervals: u64,
}

impl Span {
    /// The span of a duration \[s\] and a sampling interval \[s\]; `None` where no step divides both.
    #[must_use]
    pub fn new(duration: f64, every: Option<f64>) -> Option<Self> {
        let ratio = duration / every.unwrap_or(duration);
        let intervals =
            (1..=MOST_INTERVALS).find(|count| whole(ratio * *count as f64).is_some())?;
        Some(Self { duration, every, intervals })
    }

    fn time(&self) -> f64 {
        self.every.unwrap_or(self.duration)
    }

    /// The longest step that fits.
    pub fn longest(&self) -> f64 {
        self.step(self.intervals)
    }

    /// \[s\] the step of so many parts of the span.
    #[must_use]
    pub fn step(&self, parts: u64) -> f64 {
        self.time() / parts as f64
    }

    /// The least number of parts whose length is at most `limit`.
    pub fn parts_at_most(&self, limit: f64) -> u64 {
        let exact = self.time() / limit / self.intervals as f64;
        let below = exact as u64;
        let above = if (below as f64) < exact { below + 1 } else { below };
        above.max(1) * self.intervals
    }

    /// The step of at least so many parts, at most half as many more, that is shortest to write.
    pub fn round_step(&self, least: u64) -> f64 {
        let digits = |step: &f64| format!("{step:e}").split('e').next().map_or(0, str::len);
        let counts = least / self.intervals..=(least + least / 2) / self.intervals;
        let steps = counts.take(ROUND_STEPS).map(|count| self.step(count * self.intervals));
        steps.min_by_key(digits).unwrap_or_else(|| self.step(least))
    }

    /// The two fitting steps nearest to `step`, one on either side where there is one.
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
