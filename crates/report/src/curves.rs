//! Curves on one grid of times, thinned during a run.
//!
//! `rows of values => per interval lowest and highest of each line`. They are placed in their order at the interval's
//! first and last time, so that no peak is lost in a long run. The first and the last sample are separate intervals.

/// Points of a line at most.
pub const MAX_POINTS: usize = 2000;
/// Points of a line at least, where there are as many samples.
pub const FEWEST_POINTS: usize = 64;
/// Maximum number of stored values of all lines.
const MAX_VALUES: usize = 16_000_000;

/// The lowest and the highest value of an interval, in their order; none, or twice the same.
type Pair = [f32; 2];

/// An interval that is not at its end.
#[derive(Clone, Copy, Debug)]
struct Open {
    low: (f32, u64),
    high: (f32, u64),
}

impl Open {
    const NONE: Self = Self { low: (f32::NAN, 0), high: (f32::NAN, 0) };

    fn add(&mut self, value: f32, number: u64) {
        // NaN is neither, and is stored only if there is nothing else.
        if value < self.low.0 || self.low.0.is_nan() {
            self.low = (value, number);
        }
        if value > self.high.0 || self.high.0.is_nan() {
            self.high = (value, number);
        }
    }

    fn pair(&self) -> Pair {
        let [low, high] = [self.low.0, self.high.0];
        if self.low.1 <= self.high.1 { [low, high] } else { [high, low] }
    }
}

/// Summary of a line over all samples.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Extent {
    /// Its value in the first sample.
    pub initial: f64,
    /// Its smallest value, or difference if differences are stored; NaN if it never was a number.
    pub low: f64,
    /// Its largest.
    pub high: f64,
}

impl Extent {
    /// Its range.
    #[must_use]
    pub fn range(&self) -> f64 {
        if self.low.is_nan() { 0.0 } else { self.high - self.low }
    }
}

/// Lines that share their times.
#[derive(Clone, Debug)]
pub struct Curves {
    /// Whether a line is kept as differences from its first value.
    deviations: Vec<bool>,
    /// Samples of an interval, and of the whole run.
    samples_per_interval: u64,
    planned: u64,
    taken: u64,
    /// \[s\] first and last time of each interval.
    times: Vec<[f64; 2]>,
    /// Interval by interval, line by line.
    pairs: Vec<Pair>,
    open: Vec<Open>,
    opened: Option<(f64, u64)>,
    last_time: f64,
    extents: Vec<Extent>,
}

/// Lines as they are drawn.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct Drawn {
    /// \[s\].
    pub times: Vec<f64>,
    /// Values of each requested line.
    pub lines: Vec<Vec<f32>>,
}

impl Curves {
    /// Empty, for the given number of samples; per line whether it is stored as differences from its first value.
    #[must_use]
    pub fn new(deviations: Vec<bool>, planned: u64) -> Self {
        let most = (MAX_VALUES / deviations.len().max(1)).clamp(FEWEST_POINTS, MAX_POINTS) as u64;
        let between = planned.saturating_sub(2);
        let intervals = most / 2 - 1;
        let samples_per_interval = if planned <= most { 1 } else { between.div_ceil(intervals) };
        let lines = deviations.len();
        let nowhere = Extent { initial: f64::NAN, low: f64::NAN, high: f64::NAN };
        Self {
            deviations,
            samples_per_interval,
            planned,
            taken: 0,
            times: Vec::new(),
            pairs: Vec::new(),
            open: vec![Open::NONE; lines],
            opened: None,
            last_time: 0.0,
            extents: vec![nowhere; lines],
        }
    }

    /// Takes the values of the sample at `time` \[s\], one per line.
    pub fn push(&mut self, time: f64, values: &[f64]) {
        let number = self.taken;
        if self.opened.is_some() && number + 1 == self.planned {
            self.close();
        }
        let (_, first) = *self.opened.get_or_insert((time, number));
        let lines = self.open.iter_mut().zip(&mut self.extents).zip(&self.deviations);
        for (((open, extent), deviation), value) in lines.zip(values) {
            if number == 0 || (extent.initial.is_nan() && *deviation) {
                extent.initial = *value;
            }
            let value = if *deviation { value - extent.initial } else { *value };
            extent.low = extent.low.min(value);
            extent.high = extent.high.max(value);
            open.add(value as f32, number);
        }
        self.taken += 1;
        self.last_time = time;
        if number == 0 || self.taken - first == self.samples_per_interval {
            self.close();
        }
    }

    fn close(&mut self) {
        let Some((begun, _)) = self.opened.take() else { return };
        self.times.push([begun, self.last_time]);
        for open in &mut self.open {
            self.pairs.push(open.pair());
            *open = Open::NONE;
        }
    }

    /// Ends the last interval, however many samples it has.
    pub fn finish(&mut self) {
        self.close();
    }

    /// Samples taken.
    #[must_use]
    pub fn samples(&self) -> u64 {
        self.taken
    }

    /// Summary of each line.
    #[must_use]
    pub fn extents(&self) -> &[Extent] {
        &self.extents
    }

    /// The chosen lines with at most the given number of points, or [`FEWEST_POINTS`], of the completed intervals.
    #[must_use]
    pub fn drawn(&self, chosen: &[usize], points: usize) -> Drawn {
        let blocks = self.blocks(points.max(FEWEST_POINTS));
        let ends = |block: &std::ops::Range<usize>| {
            [self.times[block.start][0], self.times[block.end - 1][1]]
        };
        let twice = |[first, last]: [f64; 2]| last > first;
        let times = blocks.iter().flat_map(|block| {
            let ends = ends(block);
            ends.into_iter().take(if twice(ends) { 2 } else { 1 })
        });
        let lines = chosen.iter().map(|line| {
            let values = blocks.iter().flat_map(|block| {
                let pair = self.merged(block.clone(), *line);
                pair.into_iter().take(if twice(ends(block)) { 2 } else { 1 })
            });
            values.collect()
        });
        Drawn { times: times.collect(), lines: lines.collect() }
    }

    /// Intervals that are drawn as one.
    fn blocks(&self, points: usize) -> Vec<std::ops::Range<usize>> {
        let count = self.times.len();
        let per_interval = if self.samples_per_interval > 1 { 2 } else { 1 };
        if count * per_interval <= points || count <= 2 {
            return (0..count).map(|row| row..row + 1).collect();
        }
        let together = (count - 2).div_ceil((points / 2 - 2).max(1));
        let inner = (1..count - 1).step_by(together);
        let inner = inner.map(|row| row..(row + together).min(count - 1));
        let last = std::iter::once(count - 1..count);
        std::iter::once(0..1).chain(inner).chain(last).collect()
    }

    fn merged(&self, block: std::ops::Range<usize>, line: usize) -> Pair {
        let mut open = Open::NONE;
        for row in block {
            let pair = self.pairs[row * self.deviations.len() + line];
            for (place, value) in pair.into_iter().enumerate() {
                open.add(value, (2 * row + place) as u64);
            }
        }
        open.pair()
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    fn taken(planned: u64, samples: u64, deviation: bool, value: impl Fn(u64) -> f64) -> Curves {
        let mut curves = Curves::new(vec![deviation], planned);
        for i in 0..samples {
            curves.push(i as f64, &[value(i)]);
        }
        curves.finish();
        curves
    }

    #[test]
    fn long_runs_stay_small_and_keep_their_peaks() {
        for samples in [2001, 2002, 3999, 123_457, 1_000_000] {
            let value = |i| if i == 1501 { 9.0 } else { (i % 7) as f64 * 0.1 };
            let curves = taken(samples, samples, false, value);
            assert!(curves.pairs.len() <= MAX_POINTS / 2 + 1, "{samples}");
            for points in [MAX_POINTS, 700, 100, 1] {
                let Drawn { times, lines } = curves.drawn(&[0], points);
                assert!(times.len() <= points.max(FEWEST_POINTS), "{samples} {points}");
                assert_eq!(lines[0].len(), times.len());
                assert!(times.is_sorted_by(|a, b| a < b));
                assert_eq!((times[0], times[times.len() - 1]), (0.0, (samples - 1) as f64));
                let [first, last] = [0, lines[0].len() - 1].map(|at| lines[0][at]);
                assert_eq!(first, 0.0);
                assert_eq!(last, value(samples - 1) as f32);
                let peak = lines[0].iter().position(|value| *value == 9.0).unwrap();
                let near = times[peak.saturating_sub(1)]..=times[(peak + 1).min(times.len() - 1)];
                assert!(near.contains(&1501.0), "{samples} {points} {near:?}");
            }
        }
    }

    #[test]
    fn short_runs_keep_every_sample() {
        for samples in [1, 2, 501, 2000] {
            let curves = taken(samples, samples, true, |i| 3.0 + i as f64);
            let Drawn { times, lines } = curves.drawn(&[0], MAX_POINTS);
            assert_eq!(times, (0..samples).map(|i| i as f64).collect::<Vec<_>>());
            assert_eq!(lines[0], (0..samples).map(|i| i as f32).collect::<Vec<_>>());
            let Extent { initial, low, high } = curves.extents()[0];
            assert_eq!((initial, low, high), (3.0, 0.0, (samples - 1) as f64));
        }
    }

    #[test]
    fn a_run_may_end_early_or_have_no_number() {
        let curves = taken(1_000_000, 2500, false, |i| i as f64);
        assert_eq!(curves.drawn(&[0], MAX_POINTS).times.last(), Some(&2499.0));
        assert_eq!(
            taken(10, 0, false, |_| 0.0).drawn(&[0], 100),
            Drawn { times: vec![], lines: vec![vec![]] }
        );
        let curves = taken(5000, 5000, false, |_| f64::NAN);
        assert!(curves.drawn(&[0], 100).lines[0].iter().all(|value| value.is_nan()));
        assert!(curves.extents()[0].low.is_nan() && curves.extents()[0].range() == 0.0);
        let curves = taken(5000, 5000, true, |i| if i < 10 { f64::NAN } else { i as f64 });
        assert_eq!(curves.extents()[0].initial, 10.0);
        assert_eq!(curves.extents()[0].high, 4989.0);
    }
}
