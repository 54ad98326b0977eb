//! Statistics over the samples of a run.
//!
//! `samples => energies, drift, RMS error, largest extension, last hash; figures of a column`, one pass,
//! no samples stored.

use dbd_scene::Scene;
use serde::Serialize;

use crate::simulate::Sample;

/// A least-squares line through points, accumulated about their running means (Welford 1962).
#[derive(Clone, Copy, Debug, Default)]
struct Line {
    count: f64,
    mean_x: f64,
    mean_y: f64,
    /// Σ (x − x̄)².
    variation: f64,
    /// Σ (x − x̄)·(y − ȳ).
    covariation: f64,
}

impl Line {
    fn push(&mut self, x: f64, y: f64) {
        self.count += 1.0;
        let dx = x - self.mean_x;
        self.mean_x += dx / self.count;
        self.variation += dx * (x - self.mean_x);
        // The old mean of x with the new one of y, or vice versa; never both old.
        self.mean_y += (y - self.mean_y) / self.count;
        self.covariation += dx * (y - self.mean_y);
    }

    /// 0 for fewer than two points.
    fn slope(&self) -> f64 {
        if self.variation > 0.0 { self.covariation / self.variation } else { 0.0 }
    }
}

/// The largest extension of a joint's element.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub struct Widest {
    /// \[m\].
    pub extension: f64,
    /// The joint's row; `None` where none opened.
    pub joint: Option<usize>,
    /// \[s\] when.
    pub time: f64,
}

/// Accumulates the samples of a run.
#[derive(Clone, Debug, Default)]
pub struct Statistics {
    first: Option<f64>,
    last: f64,
    last_time: f64,
    line: Line,
    squares: f64,
    widest: Widest,
    samples: u64,
    hash: Option<u64>,
    turns: Vec<i32>,
    readings: Vec<Figures>,
}

impl Statistics {
    /// Takes the next sample.
    pub fn push(&mut self, sample: &Sample<'_>) {
        self.readings.resize(sample.readings.len(), Figures::default());
        for (figures, value) in self.readings.iter_mut().zip(sample.readings) {
            figures.push(sample.time, *value);
        }
        self.push_energy(sample.time, sample.energy.total());
        if sample.extension > self.widest.extension {
            let widest = |extension: &f64| *extension == sample.extension;
            let joint = sample.extensions.iter().position(widest);
            self.widest = Widest { extension: sample.extension, joint, time: sample.time };
        }
        self.samples += 1;
        self.hash = Some(sample.hash);
        self.turns.clone_from(&sample.state.turns);
    }

    fn push_energy(&mut self, time: f64, energy: f64) {
        let error = energy - *self.first.get_or_insert(energy);
        self.last = energy;
        self.last_time = time;
        // The error instead of the energy, to keep its digits.
        self.line.push(time, error);
        self.squares += error * error;
    }

    /// \[J\] total energy of the first sample.
    #[must_use]
    pub fn energy_initial(&self) -> f64 {
        self.first.unwrap_or(f64::NAN)
    }

    /// \[J\] total energy of the last sample.
    #[must_use]
    pub fn energy_final(&self) -> f64 {
        if self.first.is_some() { self.last } else { f64::NAN }
    }

    /// \[W\] least-squares slope of the total energy.
    #[must_use]
    pub fn energy_drift_rate(&self) -> f64 {
        self.line.slope()
    }

    /// \[J\] root of the mean square of E − E(0).
    #[must_use]
    pub fn energy_rms_error(&self) -> f64 {
        (self.squares / self.line.count).sqrt()
    }

    /// The torsion springs' revolution counts in the last sample.
    #[must_use]
    pub fn turns(&self) -> &[i32] {
        &self.turns
    }

    /// \[m\] the largest extension of the joints' elements.
    #[must_use]
    pub fn max_joint_extension(&self) -> f64 {
        self.widest.extension
    }

    /// The same with its joint and time.
    #[must_use]
    pub fn widest(&self) -> Widest {
        self.widest
    }

    /// How many samples there were.
    #[must_use]
    pub fn samples(&self) -> u64 {
        self.samples
    }

    /// \[s\] the time of the last sample.
    #[must_use]
    pub fn last_time(&self) -> f64 {
        self.last_time
    }

    /// The figures of each column of the read-outs; none without samples.
    #[must_use]
    pub fn readings(&self) -> &[Figures] {
        &self.readings
    }

    /// The hash of the last sample's state; `None` without samples.
    #[must_use]
    pub fn hash(&self) -> Option<u64> {
        self.hash
    }
}

/// Figures of one column over the samples of a run; samples without a number do not count.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub struct Figures {
    count: f64,
    squares: f64,
    least: f64,
    most: f64,
    time_of_most: f64,
    last: f64,
}

impl Figures {
    /// Takes the value of the next sample.
    pub fn push(&mut self, time: f64, value: f64) {
        if value.is_nan() {
            return;
        }
        let first = self.count == 0.0;
        if first || value < self.least {
            self.least = value;
        }
        if first || value > self.most {
            (self.most, self.time_of_most) = (value, time);
        }
        self.count += 1.0;
        self.squares += value * value;
        self.last = value;
    }

    fn of(&self, figure: f64) -> Option<f64> {
        (self.count > 0.0 && figure.is_finite()).then_some(figure)
    }

    /// Least, largest, root of the mean square, last, and the time \[s\] of the first sample with the
    /// largest; `None` where no sample had a number.
    #[must_use]
    pub fn all(&self) -> [Option<f64>; 5] {
        let rms = (self.squares / self.count).sqrt();
        [self.least, self.most, rms, self.last, self.time_of_most].map(|figure| self.of(figure))
    }
}

/// The figures of a read-out column, SI units.
#[derive(Clone, Debug, PartialEq, Serialize)]
pub struct ReadoutFigures {
    /// The column's name.
    pub name: String,
    /// Its unit.
    pub unit: &'static str,
    /// Its least value.
    pub min: Option<f64>,
    /// Its largest value.
    pub max: Option<f64>,
    /// The root of its mean square.
    pub rms: Option<f64>,
    /// Its last value.
    #[serde(rename = "final")]
    pub last: Option<f64>,
    /// \[s\] the time of the first sample with the largest value.
    pub time_of_max: Option<f64>,
}

impl ReadoutFigures {
    /// Of every column of a scene's read-outs, in their order.
    #[must_use]
    pub fn of(scene: &Scene, figures: &[Figures]) -> Vec<Self> {
        let columns = scene.readouts.iter().flat_map(|readout| {
            readout.columns.iter().map(|(end, unit)| (readout.name.clone() + end, *unit))
        });
        let with_figures = |((name, unit), figures): ((String, &'static str), &Figures)| {
            let [min, max, rms, last, time_of_max] = figures.all();
            Self { name, unit, min, max, rms, last, time_of_max }
        };
        columns.zip(figures).map(with_figures).collect()
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    fn of(points: impl IntoIterator<Item = (f64, f64)>) -> Statistics {
        let mut statistics = Statistics::default();
        for (time, energy) in points {
            statistics.push_energy(time, energy);
        }
        statistics
    }

    #[test]
    fn the_drift_is_the_least_squares_slope() {
        let line = of((0..101).map(|i| (f64::from(i) * 0.01, 1e6 - 3e-3 * f64::from(i) * 0.01)));
        assert!((line.energy_drift_rate() + 3e-3).abs() < 1e-8, "{}", line.energy_drift_rate());
        // By hand: t = 0, 1, 3; E = 1, 3, 2: Σ dt·dE = 1, Σ dt² = 14/3.
        let three = of([(0.0, 1.0), (1.0, 3.0), (3.0, 2.0)]);
        assert!((three.energy_drift_rate() - 3.0 / 14.0).abs() < 1e-15);
        assert_eq!(of([(0.0, 5.0)]).energy_drift_rate(), 0.0);
        assert_eq!((three.energy_initial(), three.energy_final()), (1.0, 2.0));
    }

    #[test]
    fn an_oscillation_of_whole_periods_has_no_drift_to_speak_of() {
        let wave = of((0..=1000).map(|i| {
            let t = f64::from(i) * 1e-3;
            (t, 100.0 + 0.5 * (t * 40.0 * std::f64::consts::TAU).cos())
        }));
        assert!(wave.energy_drift_rate().abs() < 1e-3);
    }

    #[test]
    fn the_rms_error_counts_from_the_first_sample() {
        let statistics = of([(0.0, 10.0), (1.0, 13.0), (2.0, 6.0), (3.0, 10.0)]);
        assert_eq!(statistics.energy_rms_error(), 2.5);
        assert_eq!(of([(0.0, 10.0), (1.0, 10.0)]).energy_rms_error(), 0.0);
    }

    #[test]
    fn figures_are_of_the_samples_that_have_a_number() {
        let mut figures = Figures::default();
        assert_eq!(figures.all(), [None; 5]);
        for (time, value) in [(0.0, -3.0), (1.0, 4.0), (2.0, f64::NAN), (3.0, 4.0), (4.0, 0.0)] {
            figures.push(time, value);
        }
        let rms = (41.0_f64 / 4.0).sqrt();
        assert_eq!(figures.all(), [-3.0, 4.0, rms, 0.0, 1.0].map(Some));
        figures.push(5.0, f64::INFINITY);
        assert_eq!(figures.all(), [Some(-3.0), None, None, None, Some(5.0)]);
    }
}
