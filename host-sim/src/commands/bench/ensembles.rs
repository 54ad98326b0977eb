//! Many instances of a system in lockstep and on threads, beside the same ones one after the other.
//!
//! `(system, rounds) => ratios of steps per second, with what they ought to be`. Both take turns in one process; where
//! two threads have no two quiet cores, their figure says so.

use std::num::NonZeroUsize;

use dbd_ensemble::{Course, InstructionSet, pace_in_f32, pace_in_f64};
use serde::Serialize;

use super::systems::System;
use super::turns::{Figure, ratio};

/// Bodies × steps of an instance in a round, where nobody says how many steps.
const WORK: u64 = 6_000;

/// More bodies than these are not asked of every instance.
const BODIES: usize = 100;

/// An ensemble.
#[derive(Clone, Debug, PartialEq, Serialize)]
pub struct Together {
    /// The system.
    pub name: String,
    /// `f64` or `f32`.
    pub precision: &'static str,
    /// The instruction set.
    pub instructions: &'static str,
    /// Threads.
    pub threads: usize,
    /// Instances, one per lane of every thread.
    pub instances: usize,
    /// Its steps per second over those of its instances one after the other on one thread, round by round.
    pub over_alone: Option<Figure>,
    /// Its steps per second over those of one thread, of all rounds the median; of more threads than one.
    pub over_one_thread: Option<f64>,
}

/// Ensembles of the first system that is small enough; none where it cannot be stepped in lockstep.
#[must_use]
pub fn measured(systems: &[System], rounds: usize, steps: Option<u64>) -> Vec<Together> {
    let mut ensembles = Vec::new();
    let Some(system) = systems.iter().find(|system| system.size.bodies <= BODIES) else {
        return ensembles;
    };
    let Some(rounds) = NonZeroUsize::new(rounds) else { return ensembles };
    let steps = steps.unwrap_or((WORK / system.size.bodies.max(1) as u64).max(1));
    for (precision, pace) in [("f64", pace_in_f64 as fn(_, _, _) -> _), ("f32", pace_in_f32)] {
        for set in InstructionSet::ALL.into_iter().filter(|set| set.is_there()) {
            let mut one_thread = None;
            for threads in [NonZeroUsize::MIN, NonZeroUsize::MIN.saturating_add(1)] {
                let course = Course { set, threads, steps, rounds };
                let Ok(pace) = pace(&system.model, system.size.step_s, course) else { continue };
                let own = Figure::of(pace.together.clone()).map(|rate| rate.median);
                ensembles.push(Together {
                    name: system.size.name.clone(),
                    precision,
                    instructions: set.name(),
                    threads: threads.get(),
                    instances: pace.instances,
                    over_alone: ratio(&pace.together, &pace.alone),
                    over_one_thread: one_thread.and_then(|one: f64| Some(own? / one)),
                });
                one_thread = one_thread.or(own);
            }
        }
    }
    ensembles
}
