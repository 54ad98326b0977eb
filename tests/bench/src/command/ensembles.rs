//! Many instances of a system in lockstep and on threads, beside the same ones one after the other.
//!
//! `(system, rounds) => ratios of steps per second, with what they ought to be`. All take turns in one process. What
//! threads bring an ensemble is beside what they bring its instances by themselves, which share nothing.

use std::num::NonZeroUsize;

use dbd_ensemble::{Course, InstructionSet, pace_in_f32, pace_in_f64};
use serde::Serialize;

use super::systems::System;
use super::turns::{Figure, ratio};

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
    /// Its steps per second over those of one thread, the median of the rounds' ratios; of more threads than one.
    pub over_one_thread: Option<f64>,
    /// Half the range of the middle half of those ratios over it.
    pub over_one_thread_spread: Option<f64>,
    /// The same of its instances, each by itself: what the cores have to give.
    pub alone_over_one_thread: Option<f64>,
}

/// Threads, and bodies × steps of an instance in a round, where nobody says how many steps: a round of two threads is
/// long beside their start.
const COURSES: [(NonZeroUsize, u64); 2] =
    [(NonZeroUsize::MIN, 6_000), (NonZeroUsize::MIN.saturating_add(1), 60_000)];

/// More bodies than these are not asked of every instance.
const BODIES: usize = 100;

/// Ensembles of the first system that is small enough; none where it cannot be stepped in lockstep.
#[must_use]
pub fn measured(systems: &[System], rounds: usize, steps: Option<u64>) -> Vec<Together> {
    let mut ensembles = Vec::new();
    let Some(system) =
        systems.iter().find(|system| system.size.bodies <= BODIES && system.planar.is_none())
    else {
        return ensembles;
    };
    let Some(rounds) = NonZeroUsize::new(rounds) else { return ensembles };
    let bodies = system.size.bodies.max(1) as u64;
    for (precision, pace) in [("f64", pace_in_f64 as fn(_, _, _) -> _), ("f32", pace_in_f32)] {
        for set in InstructionSet::ALL.into_iter().filter(|set| set.is_there()) {
            for (threads, work) in COURSES {
                let steps = steps.unwrap_or((work / bodies).max(1));
                let course = Course { set, threads, steps, rounds };
                let Ok(pace) = pace(&system.model, system.size.step_s, course) else {
                    continue;
                };
                let over_one_thread = ratio(&pace.together, &pace.on_one_thread);
                ensembles.push(Together {
                    name: system.size.name.clone(),
                    precision,
                    instructions: set.name(),
                    threads: threads.get(),
                    instances: pace.instances,
                    over_alone: ratio(&pace.together, &pace.alone),
                    over_one_thread: over_one_thread.map(|figure| figure.median),
                    over_one_thread_spread: over_one_thread.map(|figure| figure.spread),
                    alone_over_one_thread: pace.alone_over_one_thread(),
                });
            }
        }
    }
    ensembles
}
