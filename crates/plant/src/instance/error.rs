//! What can go wrong, in words that every tool shows.

use crate::time::display;
use crate::{MethodError, PlanError, PlantError};
use dbd_kernel::plant::InputError;
use dbd_kernel::snapshot::SnapshotError;
use dbd_scene::SceneError;
use miette::Diagnostic;
use thiserror::Error;

/// Why an instance was not made, or did not do what it was asked for.
#[derive(Debug, Error, Diagnostic)]
pub enum InstanceError {
    /// The scene cannot be read or is refused, or a parameter is.
    #[error("{}", placed(.0))]
    #[diagnostic(help("{}", .0.help()))]
    Scene(SceneError),
    /// A scheme, damping or precision that is none.
    #[error("there is no {kind} `{name}`")]
    #[diagnostic(help("{}", .known.join(", ")))]
    Choice {
        /// `scheme`, `damping` or `precision`.
        kind: &'static str,
        /// What was asked for.
        name: String,
        /// All that there are.
        known: Vec<&'static str>,
    },
    /// A combination that is no method.
    #[error(transparent)]
    #[diagnostic(transparent)]
    Method(#[from] MethodError),
    /// No step fits the scene's duration and sampling interval.
    #[error(transparent)]
    #[diagnostic(transparent)]
    Plan(#[from] PlanError),
    /// The precision cannot hold the scene or the step.
    #[error(transparent)]
    #[diagnostic(transparent)]
    Plant(#[from] PlantError),
    /// No input, output or parameter has this name.
    #[error("the scene `{scene}` has no {kind} `{name}`")]
    #[diagnostic(help("{}", meant.as_ref().map_or_else(|| format!("see the list of every {kind}"), |m| format!("did you mean `{m}`?"))))]
    Unknown {
        /// The scene.
        scene: String,
        /// `input`, `output` or `parameter`.
        kind: &'static str,
        /// What was asked for.
        name: String,
        /// What was probably meant.
        meant: Option<String>,
    },
    /// An input cannot take a value.
    #[error("the input `{input}` cannot take {value:?}: {reason}")]
    #[diagnostic(help("finite numbers within the precision"))]
    Input {
        /// Its name.
        input: String,
        /// \[its unit\] the value.
        value: f64,
        /// Why not.
        reason: InputError,
    },
    /// A parameter is not finite.
    #[error("the parameter `{path}` cannot be {value:?}")]
    #[diagnostic(help("a finite number"))]
    Parameter {
        /// Its path.
        path: String,
        /// \[its unit\] the value.
        value: f64,
    },
    /// A time that no whole number of steps leads to.
    #[error("a time of {time:?} s is no whole number of steps of {}", display(*step))]
    #[diagnostic(help("the nearest that are: {before:?} s and {after:?} s"))]
    Multiple {
        /// \[s\] the time.
        time: f64,
        /// \[s\] the step.
        step: f64,
        /// \[s\] the last one before it.
        before: f64,
        /// \[s\] the next one.
        after: f64,
    },
    /// A time that is none, or has passed.
    #[error("a time of {time:?} s cannot be gone to from {now:?} s")]
    #[diagnostic(help("a finite time, not before the present one; restore a state to go back"))]
    Past {
        /// \[s\] the time.
        time: f64,
        /// \[s\] the present one.
        now: f64,
    },
    /// A step failed; the instance stays where it failed.
    #[error("{what} at {time:?} s, in step {step} of {}", display(*step_size))]
    #[diagnostic(help("a shorter step; reset or restore to go on"))]
    Failed {
        /// What went wrong, and with which body or spring.
        what: String,
        /// \[s\] the time after the step that failed.
        time: f64,
        /// The step that failed, counted from 1.
        step: u64,
        /// \[s\] how long it is.
        step_size: f64,
    },
    /// Bytes are no state of this instance.
    #[error("the state cannot be taken: {0}")]
    #[diagnostic(help(
        "a state saved by an instance of the same scene, scheme, precision and step"
    ))]
    State(SnapshotError),
    /// There is no linear system at a state.
    #[error("{what}")]
    #[diagnostic(help("{remedy}"))]
    Linearisation {
        /// What is wrong.
        what: String,
        /// What would be right.
        remedy: &'static str,
    },
}

impl InstanceError {
    /// What is wrong and what would be right, in one line, as tools show it.
    #[must_use]
    pub fn sentence(&self) -> String {
        match self.help() {
            Some(help) => format!("{self}; {help}"),
            None => self.to_string(),
        }
    }
}

impl From<SceneError> for InstanceError {
    fn from(error: SceneError) -> Self {
        Self::Scene(error)
    }
}

/// A refusal with its place: `cart.toml:3:7: …`.
fn placed(error: &SceneError) -> String {
    match (error.line(), error.column()) {
        (Some(line), Some(column)) => format!("{}:{line}:{column}: {error}", error.file()),
        _ => error.to_string(),
    }
}
