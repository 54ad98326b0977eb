//! Errors of an instance, with the messages that all tools show.

use crate::time::display;
use crate::{MethodError, PlanError, PlantError};
use dbd_kernel::plant::InputError;
use dbd_kernel::snapshot::SnapshotError;
use dbd_scene::{Restless, SceneError};
use miette::Diagnostic;
use thiserror::Error;

/// Reason why an instance was not created or an operation failed.
#[derive(Debug, Error, Diagnostic)]
pub enum InstanceError {
    /// The scene cannot be read or is refused, or a parameter is.
    #[error("{}", placed(.0))]
    #[diagnostic(help("{}", .0.help()))]
    Scene(SceneError),
    /// Unknown scheme, damping or precision.
    #[error("there is no {kind} `{name}`")]
    #[diagnostic(help("expected one of {}", .known.join(", ")))]
    Choice {
        /// `scheme`, `damping` or `precision`.
        kind: &'static str,
        /// The requested name.
        name: String,
        /// All valid names.
        known: Vec<&'static str>,
    },
    /// Invalid combination of method options.
    #[error(transparent)]
    #[diagnostic(transparent)]
    Method(#[from] MethodError),
    /// No step fits the scene's duration and sampling interval.
    #[error(transparent)]
    #[diagnostic(transparent)]
    Plan(#[from] PlanError),
    /// The precision cannot represent the scene or the step.
    #[error(transparent)]
    #[diagnostic(transparent)]
    Plant(#[from] PlantError),
    /// No input, output or parameter has this name.
    #[error("the scene `{scene}` has no {kind} `{name}`")]
    #[diagnostic(help("{}", meant.as_ref().map_or_else(|| format!("see the list of {kind}s"), |m| format!("did you mean `{m}`?"))))]
    Unknown {
        /// The scene.
        scene: String,
        /// `input`, `output` or `parameter`.
        kind: &'static str,
        /// The requested name.
        name: String,
        /// The closest valid name.
        meant: Option<String>,
    },
    /// Invalid value of an input.
    #[error("the input `{input}` cannot take {value:?}: {reason}")]
    #[diagnostic(help("give a finite number that the precision can represent"))]
    Input {
        /// Its name.
        input: String,
        /// \[its unit\] the value.
        value: f64,
        /// Why not.
        reason: InputError,
    },
    /// A parameter is not finite.
    #[error("the parameter `{path}` cannot be set to {value:?}")]
    #[diagnostic(help("give a finite number"))]
    Parameter {
        /// Its path.
        path: String,
        /// \[its unit\] the value.
        value: f64,
    },
    /// A time that is not a whole number of steps.
    #[error("time {time:?} s is not a whole number of steps of {}", display(*step))]
    #[diagnostic(help("the nearest valid times are {before:?} s and {after:?} s"))]
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
    /// A time that is not finite or has passed.
    #[error("cannot advance to {time:?} s from {now:?} s")]
    #[diagnostic(help(
        "give a finite time not before the present one; restore a state to go back"
    ))]
    Past {
        /// \[s\] the time.
        time: f64,
        /// \[s\] the present one.
        now: f64,
    },
    /// A step failed; the instance stays where it failed.
    #[error("{what} at {time:?} s, in step {step} of {}", display(*step_size))]
    #[diagnostic(help("use a shorter step; reset or restore to continue"))]
    Failed {
        /// The failure and the body or spring concerned.
        what: String,
        /// \[s\] the time after the step that failed.
        time: f64,
        /// The step that failed, counted from 1.
        step: u64,
        /// \[s\] how long it is.
        step_size: f64,
    },
    /// The bytes are not a valid state of this instance.
    #[error("the state cannot be restored: {0}")]
    #[diagnostic(help(
        "use a state saved by an instance of the same scene, scheme, precision and step"
    ))]
    State(SnapshotError),
    /// The linearisation at a state failed.
    #[error("{what}")]
    #[diagnostic(help("{remedy}"))]
    Linearisation {
        /// Problem.
        what: String,
        /// Remedy.
        remedy: &'static str,
    },
    /// The scene has no equilibrium near the state.
    #[error(transparent)]
    #[diagnostic(transparent)]
    Restless(#[from] Restless),
}

impl InstanceError {
    /// Problem and remedy in one line, as tools show it.
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

/// An error with its position: `cart.toml:3:7: …`.
fn placed(error: &SceneError) -> String {
    match (error.line(), error.column()) {
        (Some(line), Some(column)) => format!("{}:{line}:{column}: {error}", error.file()),
        _ => error.to_string(),
    }
}
