//! Result of a case.
//!
//! `figures => cells`, each number the shortest text that reads back to its bits; a cell is empty where there is
//! no number. It contains no measured times: the row of a case does not depend on the machine and time of its run.

use crate::sweep::statistic::Statistic;

/// The columns of every row before those of the trace's columns.
pub const RESULTS: [&str; 8] = [
    "status",
    "state_hash",
    "step_s",
    "steps",
    "simulated_s",
    "force_evaluations",
    "energy_drift_rate",
    "max_joint_extension",
];

/// Result of a case.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct Row {
    /// `ok`, or the failure.
    pub status: String,
    /// The hash of the last sample's state.
    pub state_hash: Option<String>,
    /// \[s\] the step.
    pub step: Option<f64>,
    /// Steps done.
    pub steps: Option<u64>,
    /// \[s\] simulated time.
    pub simulated: Option<f64>,
    /// Force evaluations performed.
    pub force_evaluations: Option<u64>,
    /// \[W\] least-squares slope of the total energy.
    pub energy_drift_rate: Option<f64>,
    /// \[m\] the largest extension of the joints' elements.
    pub max_joint_extension: Option<f64>,
    /// Of each column the figures in the order of [`Statistic::ALL`].
    pub figures: Vec<[Option<f64>; Statistic::ALL.len()]>,
}

/// Number of cells of a row with the given columns.
#[must_use]
pub fn length(columns: usize) -> usize {
    RESULTS.len() + columns * Statistic::ALL.len()
}

/// Status of a completed case.
pub const OK: &str = "ok";

impl Row {
    /// The row of a case that could not be run, with the given columns.
    #[must_use]
    pub fn refused(status: String, columns: usize) -> Self {
        Self { status, figures: vec![[None; Statistic::ALL.len()]; columns], ..Self::default() }
    }

    /// Its cells.
    #[must_use]
    pub fn cells(&self) -> Vec<String> {
        let count = |count: Option<u64>| count.map(|n| n.to_string()).unwrap_or_default();
        // A line of the store is a row.
        let status = self.status.replace(['\n', '\r'], " ");
        let mut cells = vec![
            status,
            self.state_hash.clone().unwrap_or_default(),
            number(self.step),
            count(self.steps),
            number(self.simulated),
            count(self.force_evaluations),
            number(self.energy_drift_rate),
            number(self.max_joint_extension),
        ];
        cells.extend(self.figures.as_flattened().iter().map(|figure| number(*figure)));
        cells
    }
}

/// A number as a cell; empty if not finite.
fn number(number: Option<f64>) -> String {
    number.filter(|n| n.is_finite()).map(|n| format!("{n:?}")).unwrap_or_default()
}
