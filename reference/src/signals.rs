//! Time: what acts when, and what tables say then.
//!
//! `(time) => loads on or off, signals of the inputs`. Loads and tables jump at known times; an
//! integrator goes from one to the next, and between them looks at one window only, whichever
//! side its last stage lies on.

use dbd_kernel::F64;
use dbd_kernel::elements::input::{Input, Knot};

/// What counts as reached, relative: as forgiving as the kernel's windows.
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

/// What an input does at a time.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub struct Signal {
    /// N, N·m, or m for an anchor.
    pub value: f64,
    /// m/s, of an anchor.
    pub rate: f64,
}

/// A table, or a constant where it has no knots.
#[derive(Clone, Debug, PartialEq)]
pub struct Table {
    constant: f64,
    knots: Vec<Knot<f64>>,
}

impl Table {
    /// The table of an input of a model.
    #[must_use]
    pub fn of(input: &Input<F64>, knots: &[Knot<f64>]) -> Self {
        let range = usize::from(input.knot)..usize::from(input.knot) + usize::from(input.knots);
        Self { constant: input.value, knots: knots[range].to_vec() }
    }

    /// The signal at a time: that of the last knot before it, the first knot's before all.
    #[must_use]
    pub fn at(&self, clock: Clock) -> Signal {
        let Some(first) = self.knots.first() else {
            return Signal { value: self.constant, rate: 0.0 };
        };
        match self.knots.iter().rfind(|knot| knot.time <= clock.within) {
            Some(knot) => Signal {
                value: knot.value + knot.slope * (clock.time - knot.time),
                rate: knot.slope,
            },
            None => Signal { value: first.value, rate: 0.0 },
        }
    }

    /// \[s\] the times at which it jumps or bends.
    pub fn jumps(&self) -> impl Iterator<Item = f64> {
        self.knots.iter().map(|knot| knot.time)
    }
}
