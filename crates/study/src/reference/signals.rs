//! Time: active loads and values of tables.
//!
//! `(time) => loads on or off, signals of the inputs`. Loads and tables jump at known times; an integrator goes from
//! one to the next, and between them uses one window only, on whichever side its last stage lies.

use std::f64::consts::TAU;

use dbd_kernel::F64;
use dbd_kernel::elements::input::{Input, Knot};
use dbd_kernel::elements::source::{Source, SourceLaw};

/// Relative tolerance of a reached time, as for the kernel's windows.
const REACHED: f64 = 1e-9;

/// A time, and the time that decides which windows are open.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Clock {
    /// \[s\].
    pub time: f64,
    within: f64,
}

impl Clock {
    /// A time at which windows open and close themselves.
    #[must_use]
    pub fn at(time: f64) -> Self {
        Self { time, within: time + REACHED * time.abs() }
    }

    /// A time of the piece between two jumps: its windows are those of its middle.
    #[must_use]
    pub fn between(time: f64, [start, end]: [f64; 2]) -> Self {
        Self { time, within: 0.5 * (start + end) }
    }

    /// Whether a window \[s\] is open.
    #[must_use]
    pub fn within(&self, from: f64, until: f64) -> bool {
        from <= self.within.max(0.0) && self.within < until
    }
}

/// State of an input at a time.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub struct Signal {
    /// N, N·m, or m for an anchor.
    pub value: f64,
    /// m/s, of an anchor.
    pub rate: f64,
}

/// Value of an input over time.
#[derive(Clone, Debug, PartialEq)]
pub enum Table {
    /// A constant.
    Constant(f64),
    /// Knots; the first's value before all.
    Knots(Vec<Knot<f64>>),
    /// Knots that repeat with a period \[s\].
    Repeated(Vec<Knot<f64>>, f64),
    /// Amplitude, frequency \[rad/s\], phase \[rad\], offset.
    Sine([f64; 4]),
}

impl Table {
    /// The table of an input of a model.
    #[must_use]
    pub fn of(input: &Input<F64>, knots: &[Knot<f64>]) -> Self {
        let range = usize::from(input.knot)..usize::from(input.knot) + usize::from(input.knots);
        if range.is_empty() {
            Self::Constant(input.value)
        } else {
            Self::Knots(knots[range].to_vec())
        }
    }

    /// The signal of a source over time. A table over a sensor has none: it depends on the state.
    #[must_use]
    pub fn of_source(source: &Source<F64>, knots: &[Knot<f64>]) -> Self {
        match source.law {
            SourceLaw::Sine { period, phase, amplitude, offset, .. } => {
                Self::Sine([amplitude, TAU / period, TAU * phase, offset])
            }
            SourceLaw::Periodic { period } => {
                Self::Repeated(source.knots_of(knots).to_vec(), period)
            }
            SourceLaw::Over { .. } => Self::Constant(0.0),
        }
    }

    /// The signal at a time: that of the last knot before it, the first knot's before all.
    #[must_use]
    pub fn at(&self, clock: Clock) -> Signal {
        match self {
            Self::Constant(value) => Signal { value: *value, rate: 0.0 },
            Self::Knots(knots) => at(knots, clock.time, clock.within),
            Self::Repeated(knots, period) => {
                let start = knots.first().map_or(0.0, |knot| knot.time);
                let whole = ((clock.within - start) / period).floor() * period;
                at(knots, clock.time - whole, clock.within - whole)
            }
            Self::Sine([amplitude, frequency, phase, offset]) => {
                let (sine, cosine) = (frequency * clock.time + phase).sin_cos();
                Signal { value: offset + amplitude * sine, rate: amplitude * frequency * cosine }
            }
        }
    }

    /// \[s\] the times from `from` on and before `until` at which it jumps or bends.
    #[must_use]
    pub fn jumps(&self, [from, until]: [f64; 2]) -> Vec<f64> {
        let within = |time: &f64| (from..until).contains(time);
        match self {
            Self::Constant(_) | Self::Sine(_) => Vec::new(),
            Self::Knots(knots) => knots.iter().map(|knot| knot.time).filter(within).collect(),
            Self::Repeated(knots, period) => {
                let of = |knot: &Knot<f64>| {
                    let first = ((from - knot.time) / period).ceil();
                    let count = ((until - knot.time) / period).ceil() - first;
                    let time = knot.time;
                    (0..count.max(0.0) as u64).map(move |i| time + (first + i as f64) * period)
                };
                knots.iter().flat_map(of).filter(within).collect()
            }
        }
    }
}

/// The signal of the last knot that is reached, the first one's value before all.
pub(crate) fn at(knots: &[Knot<f64>], time: f64, within: f64) -> Signal {
    match knots.iter().rfind(|knot| knot.time <= within) {
        Some(knot) => {
            Signal { value: knot.value + knot.slope * (time - knot.time), rate: knot.slope }
        }
        None => Signal { value: knots.first().map_or(0.0, |knot| knot.value), rate: 0.0 },
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_repeated_table_jumps_in_each_period_and_says_the_same() {
        let knot = |time, value, slope| Knot { time, value, slope };
        let table = Table::Repeated(vec![knot(0.1, 0.0, 10.0), knot(0.3, 2.0, -10.0)], 0.4);
        let close = |a: f64, b: f64| assert!((a - b).abs() < 1e-12, "{a} {b}");
        let jumps = table.jumps([0.25, 1.1]);
        assert_eq!(jumps.len(), 4, "{jumps:?}");
        for (time, value) in [(0.0, 1.0), (0.1, 0.0), (0.2, 1.0), (0.35, 1.5), (40.2, 1.0)] {
            close(table.at(Clock::at(time)).value, value);
        }
    }
}
