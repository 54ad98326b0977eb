//! Errors as exceptions of `dbd`.
//!
//! `InstanceError => exception with its sentence`. The classes are written in Python, in `dbd/_errors.py`, because
//! each has two bases: `dbd.Error` and a built-in exception.

use dbd_plant::instance::InstanceError;
use pyo3::prelude::*;
use pyo3::types::PyDict;

/// An exception of a class of `dbd/_errors.py`, to be raised once the interpreter is attached.
pub(crate) struct Refusal {
    class: &'static str,
    sentence: String,
    /// Where a step failed: time \[s\] and step.
    failed: Option<(f64, u64)>,
}

impl Refusal {
    /// An exception of a class with its text.
    pub(crate) fn new(class: &'static str, sentence: impl Into<String>) -> Self {
        Self { class, sentence: sentence.into(), failed: None }
    }

    /// The plant is in use by another thread.
    pub(crate) fn busy() -> Self {
        Self::new(
            "BusyError",
            "the plant is in use by another thread; use copy() to give each thread its own",
        )
    }

    /// Python's exception, or the error of importing its class.
    pub(crate) fn raised(self, py: Python<'_>) -> PyErr {
        self.exception(py).unwrap_or_else(|error| error)
    }

    fn exception(self, py: Python<'_>) -> PyResult<PyErr> {
        let class = py.import("dbd._errors")?.getattr(self.class)?;
        let keywords = PyDict::new(py);
        if let Some((time, step)) = self.failed {
            keywords.set_item("time", time)?;
            keywords.set_item("step", step)?;
        }
        Ok(PyErr::from_value(class.call((self.sentence,), Some(&keywords))?))
    }
}

impl From<InstanceError> for Refusal {
    fn from(error: InstanceError) -> Self {
        let sentence = error.sentence();
        let (class, failed) = match error {
            InstanceError::Scene(_) => ("SceneError", None),
            InstanceError::Choice { .. }
            | InstanceError::Method(_)
            | InstanceError::Plan(_)
            | InstanceError::Plant(_) => ("MethodError", None),
            InstanceError::Unknown { .. } => ("UnknownName", None),
            InstanceError::Input { .. } | InstanceError::Parameter { .. } => ("InputError", None),
            InstanceError::Multiple { .. } | InstanceError::Past { .. } => ("TimeError", None),
            InstanceError::Failed { time, step, .. } => ("StepFailed", Some((time, step))),
            InstanceError::State(_) => ("StateError", None),
            InstanceError::Linearisation { .. } => ("LinearisationError", None),
            InstanceError::Restless(_) => ("EquilibriumError", None),
        };
        Self { class, sentence, failed }
    }
}

/// Raises an error of an instance.
pub(crate) fn raise(py: Python<'_>) -> impl Fn(InstanceError) -> PyErr + '_ {
    move |error| Refusal::from(error).raised(py)
}
