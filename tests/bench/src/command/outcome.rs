//! What a bench came to.

use serde::Serialize;

use super::ensembles::Together;
use super::fit::{Counts, Fit, fit};
use super::goals::{Goal, goals};
use super::nets::Net;
use super::ways::Row;

/// All that was measured, and what follows.
#[derive(Clone, Debug, PartialEq, Serialize)]
pub struct Outcome {
    /// Whether the program checks its arithmetic, as one that is not released does: it is slower.
    pub checked: bool,
    /// Rounds of each system.
    pub rounds: usize,
    /// The systems.
    pub systems: Vec<Row>,
    /// Ensembles of the first of them that is small.
    pub ensembles: Vec<Together>,
    /// Nets of point masses.
    pub nets: Vec<Net>,
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
    pub fn new(rounds: usize, systems: Vec<Row>, ensembles: Vec<Together>, nets: Vec<Net>) -> Self {
        let times: Vec<(Counts, f64)> = systems
            .iter()
            .filter_map(|row| {
                let size = &row.size;
                let parts =
                    [size.bodies, row.tumbling, size.tsdas, size.joints, size.torsion_springs];
                Some((parts, row.f64_s?.least))
            })
            .collect();
        let figures = systems.iter().flat_map(|row| {
            [row.f64_s, row.f32.time_s, row.std.time_s, row.plain.time_s].into_iter().flatten()
        });
        let largest_spread = figures.map(|figure| figure.spread).fold(0.0, f64::max);
        Self {
            checked: cfg!(debug_assertions),
            rounds,
            fit: fit(&times),
            goals: goals(&systems, &ensembles, &nets),
            largest_spread,
            systems,
            ensembles,
            nets,
        }
    }
}
