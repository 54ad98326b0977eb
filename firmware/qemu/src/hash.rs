//! Steps every shipped model and prints the state's hash at fixed step counts.
//!
//! `(models, limits) => lines "hash SCENE SCHEME PRECISION STEPS HASH"`. The counts are 1, 2, 5,
//! 10, 20, … and the last one asked for. A line that two machines print for the same model,
//! scheme, precision and count must be the same line; the first that differs tells when.

use core::str::FromStr;

use dbd_kernel::model::ModelOwner;
use dbd_kernel::{Fixed, Geometry, Plant, Scheme};

use crate::models::{Shipped, Visitor, for_each, for_each_further, for_each_solved};
use crate::say;

/// When to stop.
#[derive(Clone, Copy, Debug)]
pub struct Limits {
    /// Most steps per combination.
    pub steps: u64,
    /// Most instructions of the program. What is left is shared out as a combination's turn comes,
    /// more to schemes of fewer evaluations; a count that would exceed a share is not begun.
    pub instructions: u64,
    /// Which combinations.
    pub which: Which,
}

/// Combinations by their precision.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub enum Which {
    /// All of them.
    #[default]
    All,
    /// Those of fixed point.
    Fixed,
}

impl Which {
    fn holds<M: ModelOwner>(self) -> bool {
        self == Self::All || M::Precision::NAME == Fixed::NAME
    }
}

impl FromStr for Which {
    type Err = ();

    fn from_str(name: &str) -> Result<Self, ()> {
        if name == Fixed::NAME { Ok(Self::Fixed) } else { Err(()) }
    }
}

/// Instructions executed since the program began; always 0 without a counter.
pub trait InstructionCounter {
    /// Asked at least once per step.
    fn count(&mut self) -> u64;
}

/// Nobody counts: a host has time.
#[derive(Debug)]
pub struct Uncounted;

impl InstructionCounter for Uncounted {
    fn count(&mut self) -> u64 {
        0
    }
}

/// Prints all lines; `false` where a model did not step.
pub fn run(limits: Limits, counter: &mut impl InstructionCounter) -> bool {
    let mut all = Weights { sum: 0, which: limits.which };
    for_each(&mut all);
    for_each_further(&mut all);
    for_each_solved(&mut all);
    let mut hashing = Hashing { limits, counter, waiting: all.sum, well: true };
    // Cheap ones first: what they leave of their shares goes to the others.
    for_each_further(&mut hashing);
    for_each_solved(&mut hashing);
    for_each(&mut hashing);
    hashing.well
}

/// Prints the lines of models that are shown, without a limit of instructions; `false` where one did not step.
pub fn run_to_the_end(show: impl FnOnce(&mut Hashing<'_, Uncounted>)) -> bool {
    let limits = Limits { steps: u64::MAX, instructions: u64::MAX, which: Which::All };
    let mut hashing = Hashing { limits, counter: &mut Uncounted, waiting: 1, well: true };
    show(&mut hashing);
    hashing.well
}

/// Adds up the combinations' weights.
struct Weights {
    sum: u64,
    which: Which,
}

impl Visitor for Weights {
    fn visit<M: ModelOwner, S: Scheme>(&mut self, shipped: Shipped<M, S>) {
        if self.which.holds::<M>() {
            self.sum += weight(&shipped);
        }
    }
}

/// A combination's weight where instructions are shared out; one of few steps needs little.
fn weight<M, S: Scheme>(shipped: &Shipped<M, S>) -> u64 {
    match shipped.steps {
        u64::MAX => 12 / u64::from(shipped.scheme.evaluations().clamp(1, 12)),
        _ => 1,
    }
}

/// Steps what it is shown and prints the lines.
#[derive(Debug)]
pub struct Hashing<'c, C> {
    limits: Limits,
    counter: &'c mut C,
    /// Weight of the combinations not yet begun.
    waiting: u64,
    well: bool,
}

impl<C: InstructionCounter> Visitor for Hashing<'_, C> {
    fn visit<M: ModelOwner, S: Scheme>(&mut self, shipped: Shipped<M, S>) {
        if !self.limits.which.holds::<M>() {
            return;
        }
        let (precision, variant) = (M::Precision::NAME, shipped.variant);
        let Ok(mut plant) = Plant::new(shipped.model, shipped.scheme, shipped.step) else {
            say!("hash {} {}{} {} refused its step", shipped.scene, S::NAME, variant, precision);
            self.well = false;
            return;
        };
        let start = self.counter.count();
        let weight = weight(&shipped);
        let left = self.limits.instructions.saturating_sub(start);
        let share = left / self.waiting.max(1) * weight;
        self.waiting = self.waiting.saturating_sub(weight);
        let steps = self.limits.steps.min(shipped.steps);
        let mut next = 1;
        while next <= steps {
            let done = plant.state().step;
            let spent = self.counter.count() - start;
            if done > 0 && spent.saturating_mul(next) / done > share {
                return;
            }
            while plant.state().step < next {
                if let Err(failure) = plant.step() {
                    let step = failure.step;
                    let scene = shipped.scene;
                    say!("hash {} {}{} {} failed at {}", scene, S::NAME, variant, precision, step);
                    self.well = false;
                    return;
                }
                self.counter.count();
            }
            let hash = plant.hash();
            let scene = shipped.scene;
            say!("hash {} {}{} {} {} {:016x}", scene, S::NAME, variant, precision, next, hash);
            if next == steps {
                return;
            }
            next = successor(next).min(steps);
        }
    }
}

/// The number after `n` in 1, 2, 5, 10, 20, …
fn successor(n: u64) -> u64 {
    let mut decade = 1;
    while n / decade >= 10 {
        decade *= 10;
    }
    decade
        * if n / decade < 2 {
            2
        } else if n / decade < 5 {
            5
        } else {
            10
        }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn counts_are_those_of_a_preferred_series() {
        let counts: Vec<u64> =
            core::iter::successors(Some(1), |&n| Some(successor(n))).take(8).collect();
        assert_eq!(counts, [1, 2, 5, 10, 20, 50, 100, 200]);
    }
}
