//! A comparison for programs: `compare.json` and the output of `--json`.

use std::path::Path;

use serde::Serialize;

use crate::commands::compare::differs::{Differs, differs};
use crate::commands::compare::words::notes;
use crate::comparison::pairing::Alone;
use crate::comparison::{Beyond, Comparison, First, Quantity, Verdict};
use crate::recorded::{Head, Kind};
use crate::report::SetValue;

/// A comparison. SI units; non-finite values are null.
#[derive(Clone, Debug, PartialEq, Serialize)]
pub struct Record {
    /// `equal`, `within` or `different`.
    pub verdict: &'static str,
    /// The first run.
    pub a: RunRecord,
    /// The second.
    pub b: RunRecord,
    /// Their differences in settings.
    pub differs: Vec<Differs>,
    /// The samples that both have.
    pub common: Common,
    /// The first number that differs; `None` where none does.
    pub first_difference: Option<First>,
    /// The first sample beyond a band; `None` where none is, or no bands were stated.
    pub beyond: Option<Beyond>,
    /// The distances.
    pub quantities: Vec<Quantity>,
    /// What only the first has.
    pub only_a: Alone,
    /// What only the second has.
    pub only_b: Alone,
    /// Notes, one sentence each.
    pub notes: Vec<String>,
    /// The version of host-sim that compared.
    pub version: &'static str,
}

/// The properties of a run.
#[derive(Clone, Debug, PartialEq, Serialize)]
pub struct RunRecord {
    /// The whole path of the file that holds its samples.
    pub path: String,
    /// `run` or `golden`.
    pub kind: Kind,
    /// The scene's name.
    pub scene: String,
    /// The scheme.
    pub scheme: String,
    /// Newton iterations, where there are some.
    pub newton: Option<u32>,
    /// ρ∞, of the scheme that has it.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub rho: Option<f64>,
    /// The damping method, if recorded.
    pub damping: Option<String>,
    /// The precision.
    pub precision: String,
    /// The representation of orientations.
    pub orientation: String,
    /// \[s\] the step.
    pub step: f64,
    /// Samples.
    pub samples: u64,
    /// \[s\] from sample to sample.
    pub every: Option<f64>,
    /// \[s\] the last sample.
    pub until: f64,
    /// `ok`, or why it ended early; `None` where it is not recorded.
    pub status: Option<String>,
    /// The changed values of the scene.
    pub set: Vec<SetValue>,
}

/// The samples that both runs have.
#[derive(Clone, Copy, Debug, PartialEq, Serialize)]
pub struct Common {
    /// How many.
    pub samples: u64,
    /// \[s\] the first.
    pub from: f64,
    /// \[s\] the last.
    pub until: f64,
}

/// The whole path of a file.
pub(super) fn whole(path: &Path) -> String {
    path.canonicalize().unwrap_or_else(|_| path.to_owned()).display().to_string()
}

impl Record {
    /// The record of a comparison.
    #[must_use]
    pub fn of(comparison: &Comparison) -> Self {
        let run = |side: usize| {
            let (head, end) = (comparison.heads[side].clone(), comparison.ends[side]);
            let Head { kind, scene, scheme, newton, rho, damping, precision, orientation, .. } =
                head;
            RunRecord {
                path: whole(&head.file),
                kind,
                scene,
                scheme,
                newton,
                rho,
                damping,
                precision,
                orientation,
                step: head.step,
                samples: end.samples,
                every: end.every,
                until: end.until,
                status: head.status,
                set: head.set,
            }
        };
        let [from, until] = comparison.span;
        let [only_a, only_b] = comparison.pairing.alone.clone();
        Self {
            verdict: match comparison.verdict() {
                Verdict::Equal => "equal",
                Verdict::Within => "within",
                Verdict::Different => "different",
            },
            a: run(0),
            b: run(1),
            differs: differs(comparison),
            common: Common { samples: comparison.samples, from, until },
            first_difference: comparison.first.clone(),
            beyond: comparison.beyond.clone(),
            quantities: comparison.quantities.clone(),
            only_a,
            only_b,
            notes: notes(comparison),
            version: env!("CARGO_PKG_VERSION"),
        }
    }
}
