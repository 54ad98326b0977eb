//! The curves a report shows, kept small while a run goes on.
//!
//! `samples => curves of at most about 2000 points`. Of each interval a curve keeps its lowest
//! and its highest value, so that no peak is lost however long the run.

use dbd_kernel::Energy;

use crate::simulate::Sample;

/// Intervals a curve is divided into.
const INTERVALS: u64 = 1000;

/// A quantity over time.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct Curve {
    /// (time \[s\], value).
    pub points: Vec<(f64, f64)>,
    lowest: Option<(f64, f64)>,
    highest: Option<(f64, f64)>,
}

impl Curve {
    fn push(&mut self, time: f64, value: f64) {
        let point = (time, value);
        if self.lowest.is_none_or(|low| value < low.1) {
            self.lowest = Some(point);
        }
        if self.highest.is_none_or(|high| value > high.1) {
            self.highest = Some(point);
        }
    }

    /// Ends an interval.
    fn close(&mut self) {
        if let (Some(low), Some(high)) = (self.lowest.take(), self.highest.take()) {
            let (first, second) = if low.0 <= high.0 { (low, high) } else { (high, low) };
            self.points.push(first);
            if second.0 > first.0 {
                self.points.push(second);
            }
        }
    }
}

/// The curves of a run.
#[derive(Clone, Debug, PartialEq)]
pub struct Curves {
    /// \[J\] kinetic energy.
    pub kinetic: Curve,
    /// \[J\] potential energy.
    pub potential: Curve,
    /// \[J\] total energy less that of the first sample.
    pub change: Curve,
    /// \[m\] per body x, y, z.
    pub positions: Vec<[Curve; 3]>,
    /// The read-outs, one curve per column.
    pub readings: Vec<Curve>,
    initial: Option<f64>,
    samples_per_interval: u64,
    samples: u64,
}

impl Curves {
    /// No curves yet, of a run with so many bodies, columns of read-outs and samples.
    #[must_use]
    pub fn new(bodies: usize, readings: usize, samples: u64) -> Self {
        Self {
            kinetic: Curve::default(),
            potential: Curve::default(),
            change: Curve::default(),
            positions: vec![Default::default(); bodies],
            readings: vec![Curve::default(); readings],
            initial: None,
            samples_per_interval: samples.div_ceil(INTERVALS).max(1),
            samples: 0,
        }
    }

    /// Takes the next sample.
    pub fn push(&mut self, sample: &Sample<'_>) {
        let positions = sample.state.bodies.iter().map(|body| body.position.to_f64());
        for (curve, value) in self.readings.iter_mut().zip(sample.readings) {
            curve.push(sample.time, *value);
        }
        self.push_values(sample.time, &sample.energy, positions);
    }

    fn push_values(
        &mut self,
        time: f64,
        energy: &Energy<f64>,
        positions: impl Iterator<Item = [f64; 3]>,
    ) {
        let initial = *self.initial.get_or_insert(energy.total());
        self.kinetic.push(time, energy.kinetic);
        self.potential.push(time, energy.potential());
        self.change.push(time, energy.total() - initial);
        for (curves, position) in self.positions.iter_mut().zip(positions) {
            for (curve, value) in curves.iter_mut().zip(position) {
                curve.push(time, value);
            }
        }
        self.samples += 1;
        if self.samples.is_multiple_of(self.samples_per_interval) {
            self.close();
        }
    }

    /// Ends the last interval; nothing where it has ended already.
    pub fn close(&mut self) {
        for curve in [&mut self.kinetic, &mut self.potential, &mut self.change] {
            curve.close();
        }
        for curve in self.positions.as_flattened_mut().iter_mut().chain(&mut self.readings) {
            curve.close();
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn long_runs_stay_small_and_keep_their_peaks() {
        let samples = 123_457;
        let mut curves = Curves::new(1, 0, samples);
        for i in 0..samples {
            let kinetic = if i == 70_001 { 9.0 } else { (i % 7) as f64 * 0.1 };
            let energy = Energy { kinetic, ..Energy::default() };
            curves.push_values(i as f64, &energy, [[i as f64, 0.0, 0.0]].into_iter());
        }
        curves.close();
        let points = &curves.kinetic.points;
        assert!(points.len() <= 2 * INTERVALS as usize, "{}", points.len());
        assert!(points.contains(&(70_001.0, 9.0)));
        assert!(points.windows(2).all(|pair| pair[0].0 < pair[1].0));
        assert_eq!(curves.positions[0][0].points.last(), Some(&(123_456.0, 123_456.0)));
    }

    #[test]
    fn short_runs_keep_every_sample() {
        let mut curves = Curves::new(0, 0, 501);
        for i in 0..501 {
            let energy = Energy { kinetic: 2.0, ..Energy::default() };
            curves.push_values(f64::from(i), &energy, std::iter::empty());
        }
        curves.close();
        assert_eq!(curves.change.points.len(), 501);
        assert_eq!(curves.change.points[500], (500.0, 0.0));
    }
}
