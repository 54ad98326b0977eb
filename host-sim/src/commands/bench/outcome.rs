//! What a bench came to.

use serde::Serialize;

use super::fit::{Fit, fit};
use super::goals::{Goal, goals};
use super::ways::Row;

/// All that was measured, and what follows.
#[derive(Clone, Debug, PartialEq, Serialize)]
pub struct Outcome {
    /// Rounds of each system.
    pub rounds: usize,
    /// The systems.
    pub systems: Vec<Row>,
    /// What a step's time is made of; `None` where the systems do not tell.
    pub fit: Option<Fit>,
    /// What was aimed at.
    pub goals: Vec<Goal>,
    /// The largest spread of a time.
    pub largest_spread: f64,
}

impl Outcome {
    /// What follows from rows.
    #[must_use]
    pub fn new(rounds: usize, systems: Vec<Row>) -> Self {
        let times: Vec<_> =
            systems.iter().filter_map(|row| Some((&row.size, row.f64_s?.least))).collect();
        let figures = systems.iter().flat_map(|row| {
            [row.f64_s, row.f32.time_s, row.std.time_s, row.plain.time_s].into_iter().flatten()
        });
        let largest_spread = figures.map(|figure| figure.spread).fold(0.0, f64::max);
        Self { rounds, fit: fit(&times), goals: goals(&systems), largest_spread, systems }
    }
}
