//! Plants of Discrete Body Dynamics in Python: the compiled half of the package `dbd`.
//!
//! # Modules
//!
//! Each uses only those before it:
//!
//! - `error`: what went wrong, as the exceptions of `dbd`.
//! - `shipped`: the scenes that ship, by name.
//! - `rollout`: runs of many steps, and of many plants on threads.
//! - `arguments`: what Python hands over, and what it gets back as arrays.
//! - `states`: the bodies' states as arrays.
//! - `plant`: the class `Plant`, its names and parameters.
//! - `motion`: its methods that step, set, read and save.

mod error;
mod shipped;

mod rollout;

mod arguments;
mod states;

mod plant;

mod motion;

pub use dbd_scene::laws;

use numpy::{PyArray1, PyArray3, PyArrayMethods as _};
use pyo3::exceptions::PyValueError;
use pyo3::prelude::*;

use crate::arguments::Held;
use crate::plant::Plant;

/// Runs several plants of the same scene on threads, without holding the interpreter.
///
/// Args:
///     plants: Plants that have the same inputs and outputs by name, each once.
///     u: plants × samples × inputs, or plants × samples where there is one input: what inputs are held
///         at [their units]; or an int, so many samples with the inputs as they are.
///     every: Steps of each sample.
///     outputs: Names of the columns, ``"time"`` among them is the time; all outputs if not said.
///     inputs: Names of the columns of `u`; all inputs, in scene order, if not said.
///     threads: How many; as many as the machine runs at once if not said.
///
/// Returns:
///     An array of plants × samples × outputs, each with the bits of `Plant.rollout`, whatever the threads.
///
/// Raises:
///     As `Plant.rollout`, of the first plant that was refused, ``error.plant`` being its place; the others have run.
#[pyfunction]
#[pyo3(signature = (plants, u, every=1, outputs=None, *, inputs=None, threads=None))]
fn rollouts<'py>(
    py: Python<'py>,
    plants: Vec<Bound<'py, Plant>>,
    u: Held<'py>,
    every: u64,
    outputs: Option<Vec<String>>,
    inputs: Option<Vec<String>>,
    threads: Option<usize>,
) -> PyResult<Bound<'py, PyArray3<f64>>> {
    let Some(first) = plants.first() else {
        return Err(PyValueError::new_err("there is no plant to run; one at least"));
    };
    for (row, plant) in plants.iter().enumerate() {
        if plants[..row].iter().any(|other| other.is(plant)) {
            return Err(PyValueError::new_err(format!(
                "plant {row} is there twice; copy() makes another"
            )));
        }
        alike(py, first, plant, row)?;
    }
    let like = first.get().held(py)?;
    let (course, held) =
        arguments::course(py, &like, u, every, outputs, inputs, Some(plants.len()))?;
    drop(like);
    let threads = threads.or_else(|| std::thread::available_parallelism().ok().map(usize::from));
    let instances: Vec<_> = plants.iter().map(|plant| &plant.get().instance).collect();
    let rows = py.detach(|| course.run_all(&instances, &held, threads.unwrap_or(1)));
    let rows = rows.map_err(|(row, stop)| {
        let error = stop.raised(py);
        // An exception that takes no attributes is still the exception.
        drop(error.value(py).setattr("plant", row));
        error
    })?;
    PyArray1::from_vec(py, rows).reshape([plants.len(), course.samples, course.columns.len()])
}

/// Refuses a plant of another scene's inputs or outputs.
fn alike(
    py: Python<'_>,
    first: &Bound<'_, Plant>,
    plant: &Bound<'_, Plant>,
    row: usize,
) -> PyResult<()> {
    if first.is(plant) {
        return Ok(());
    }
    let (one, other) = (first.get().held(py)?, plant.get().held(py)?);
    let inputs = |instance: &dbd_plant::instance::Instance| {
        instance.inputs().iter().map(|input| input.name.clone()).collect::<Vec<_>>()
    };
    if inputs(&one) == inputs(&other) && one.outputs() == other.outputs() {
        return Ok(());
    }
    Err(PyValueError::new_err(format!(
        "plant {row} has other inputs or outputs than the first; one scene's plants"
    )))
}

/// The compiled half of `dbd`.
#[pymodule]
mod _dbd {
    use pyo3::prelude::*;
    use pyo3::types::{PyDict, PyMappingProxy};

    #[pymodule_export]
    use crate::plant::Plant;
    #[pymodule_export]
    use crate::rollouts;

    /// The scene that `dbd.gym` steps.
    #[pymodule_export]
    const CART_PENDULUM: &str = include_str!("../../scenes/cart-pendulum.toml");

    #[pymodule_init]
    fn init(module: &Bound<'_, PyModule>) -> PyResult<()> {
        let scenes = PyDict::new(module.py());
        for (name, text) in crate::shipped::SCENES {
            scenes.set_item(name, text)?;
        }
        module.add("SCENES", PyMappingProxy::new(module.py(), scenes.as_mapping()))?;
        module.add("__version__", env!("CARGO_PKG_VERSION"))
    }
}
