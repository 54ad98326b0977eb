//! Plants of Discrete Body Dynamics in Python: the compiled half of the package `dbd`.
//!
//! # Modules
//!
//! Each uses only those before it:
//!
//! - `error`: errors as exceptions of `dbd`.
//! - `shipped`: the built-in scenes, by name.
//! - `rollout`: runs of many steps.
//! - `lanes`: runs of similar plants in SIMD lanes.
//! - `alone`: one by one, without the feature `lanes`.
//! - `threads`: runs of many plants on threads.
//! - `arguments`: arguments from Python, and results as arrays.
//! - `states`: the bodies' states as arrays.
//! - `plant`: the class `Plant`, its names and parameters.
//! - `film`: samples of a plant, and the page that shows them.
//! - `motion`: its methods for stepping, setting, reading and saving.

mod error;
mod shipped;

#[cfg(not(feature = "lanes"))]
mod alone;
#[cfg(feature = "lanes")]
mod lanes;
mod rollout;
mod threads;

mod arguments;
mod states;

mod plant;

mod film;
mod motion;

pub use dbd_scene::laws;

use numpy::{PyArray1, PyArray3, PyArrayMethods as _};
use pyo3::exceptions::PyValueError;
use pyo3::prelude::*;

use crate::arguments::Held;
use crate::plant::Plant;

/// Runs several plants of the same scene on threads; the interpreter is released meanwhile.
///
/// Args:
///     plants: Distinct plants with the same input and output names.
///     u: plants × samples × inputs, or plants × samples for one input: the held input values
///         [their units]; or an int, the number of samples with the present inputs.
///     every: Steps per sample.
///     outputs: Names of the columns, including ``"time"``; default: all outputs.
///     inputs: Names of the columns of `u`; default: all inputs, in scene order.
///     threads: Number of threads; default: as many as the machine runs in parallel.
///
/// Returns:
///     An array of plants × samples × outputs, bit-identical to `Plant.rollout` for any number of threads.
///
/// Raises:
///     As `Plant.rollout`, for the first plant with an error; ``error.plant`` is its index; the others have run.
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
        return Err(PyValueError::new_err("no plants given; pass at least one"));
    };
    for (row, plant) in plants.iter().enumerate() {
        if plants[..row].iter().any(|other| other.is(plant)) {
            return Err(PyValueError::new_err(format!(
                "plant {row} is given twice; use copy() to make another"
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
        // An exception that rejects attributes is raised without them.
        drop(error.value(py).setattr("plant", row));
        error
    })?;
    PyArray1::from_vec(py, rows).reshape([plants.len(), course.samples, course.columns.len()])
}

/// Rejects a plant with other inputs or outputs.
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
        "plant {row} has other inputs or outputs than the first; use plants of one scene"
    )))
}

/// The compiled half of `dbd`.
#[pymodule]
mod _dbd {
    use pyo3::prelude::*;
    use pyo3::types::{PyDict, PyMappingProxy};

    #[pymodule_export]
    use crate::film::Film;
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
