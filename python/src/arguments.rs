//! Arguments from Python, and results as arrays.
//!
//! `names => indices; array or count => held inputs`.

use dbd_plant::instance::{Instance, InstanceError};
use dbd_scene::TIME_COLUMN;
use dbd_scene::time;
use numpy::{
    AllowTypeChange, PyArray1, PyArray2, PyArrayLikeDyn, PyArrayMethods as _,
    PyUntypedArrayMethods as _,
};
use pyo3::exceptions::{PyTypeError, PyValueError};
use pyo3::prelude::*;

use crate::error::{Refusal, raise};
use crate::rollout::Course;

/// A time \[s\]: a number, or a text as in a scene, `250us`.
#[derive(Clone, Copy)]
pub(crate) struct Seconds(pub(crate) f64);

impl<'py> FromPyObject<'_, 'py> for Seconds {
    type Error = PyErr;

    fn extract(given: Borrowed<'_, 'py, PyAny>) -> PyResult<Self> {
        let Ok(text) = given.extract::<String>() else { return given.extract().map(Self) };
        time::seconds(&text).map(Self).map_err(|error| {
            Refusal::new("TimeError", format!("`{text}`: {error}")).raised(given.py())
        })
    }
}

/// The held inputs of a run.
pub(crate) enum Held<'py> {
    /// The given number of samples with the present inputs.
    Count(usize),
    /// An array of samples × inputs, or plants × samples × inputs for several plants.
    Array(PyArrayLikeDyn<'py, f64, AllowTypeChange>),
}

impl<'a, 'py> FromPyObject<'a, 'py> for Held<'py> {
    type Error = PyErr;

    fn extract(given: Borrowed<'a, 'py, PyAny>) -> PyResult<Self> {
        if let Ok(count) = given.extract::<usize>() {
            return Ok(Self::Count(count));
        }
        match given.extract() {
            Ok(array) => Ok(Self::Array(array)),
            Err(_) => Err(PyTypeError::new_err(
                "u must be an array of numbers, samples × inputs, or the number of samples",
            )),
        }
    }
}

/// The indices of outputs by name; `None` for the time.
pub(crate) fn columns(
    instance: &Instance,
    names: Option<Vec<String>>,
) -> Result<Vec<Option<usize>>, InstanceError> {
    let Some(names) = names else {
        return Ok((0..instance.outputs().len()).map(Some).collect());
    };
    let place = |name: &String| match name.as_str() {
        TIME_COLUMN => Ok(None),
        name => instance.output(name).map(Some),
    };
    names.iter().map(place).collect()
}

/// The indices of inputs by name.
pub(crate) fn inputs(
    instance: &Instance,
    names: Option<Vec<String>>,
) -> Result<Vec<usize>, InstanceError> {
    match names {
        Some(names) => names.iter().map(|name| instance.input(name)).collect(),
        None => Ok((0..instance.inputs().len()).collect()),
    }
}

/// A run of one plant, or of several like `instance`, with their held inputs.
pub(crate) fn course(
    py: Python<'_>,
    instance: &Instance,
    u: Held<'_>,
    every: u64,
    outputs: Option<Vec<String>>,
    driven: Option<Vec<String>>,
    plants: Option<usize>,
) -> PyResult<(Course, Vec<f64>)> {
    let columns = columns(instance, outputs).map_err(raise(py))?;
    let array = match u {
        Held::Count(samples) => {
            rows(samples, plants.unwrap_or(1), columns.len())?;
            return Ok((Course { inputs: Vec::new(), columns, samples, every }, Vec::new()));
        }
        Held::Array(array) => array,
    };
    let inputs = inputs(instance, driven).map_err(raise(py))?;
    let mut shape = array.shape().to_vec();
    if shape.len() == 1 + usize::from(plants.is_some()) && inputs.len() == 1 {
        shape.push(1);
    }
    let samples = match (plants, shape.as_slice()) {
        (None, [samples, width]) if *width == inputs.len() => *samples,
        (Some(plants), [these, samples, width]) if *these == plants && *width == inputs.len() => {
            *samples
        }
        (of, _) => {
            let of = of.map_or_else(String::new, |plants| format!("{plants} × "));
            let (width, shape) = (inputs.len(), array.shape());
            return Err(PyValueError::new_err(format!(
                "u has shape {shape:?}, expected {of}samples × {width}"
            )));
        }
    };
    rows(samples, plants.unwrap_or(1), columns.len())?;
    let held = array.as_array().iter().copied().collect();
    Ok((Course { inputs, columns, samples, every }, held))
}

/// Rejects results that exceed the memory before the allocation.
fn rows(samples: usize, plants: usize, columns: usize) -> PyResult<()> {
    let all = samples.checked_mul(plants).and_then(|rows| rows.checked_mul(columns.max(1)));
    if all.is_some_and(|numbers| numbers < 1 << 40) {
        return Ok(());
    }
    Err(PyValueError::new_err(format!(
        "{samples} samples of {columns} outputs exceed the available memory"
    )))
}

/// Rows one after another as an array of rows × columns.
pub(crate) fn shaped(
    py: Python<'_>,
    values: Vec<f64>,
    rows: usize,
    columns: usize,
) -> PyResult<Bound<'_, PyArray2<f64>>> {
    PyArray1::from_vec(py, values).reshape([rows, columns])
}
