//! The methods of `Plant` for stepping, setting, reading and saving.
//!
//! `(inputs, steps) => outputs, states` as numbers and numpy arrays.

use std::sync::atomic::AtomicBool;

use dbd_plant::instance::{Instance, LinearOptions};
use nalgebra::DMatrix;
use numpy::{
    AllowTypeChange, PyArray1, PyArray2, PyArrayLikeDyn, PyUntypedArrayMethods as _, ToPyArray as _,
};
use pyo3::prelude::*;
use pyo3::types::{PyBytes, PyDict, PyTuple};

use crate::arguments::{self, Held, Seconds};
use crate::error::{Refusal, raise};
use crate::plant::Plant;
use crate::rollout::{Watch, read};
use crate::states;

impl Plant {
    /// Steps without holding the interpreter.
    fn advanced(
        &self,
        py: Python<'_>,
        steps: impl FnOnce(&Instance) -> Result<u64, dbd_plant::instance::InstanceError>,
    ) -> PyResult<()> {
        let mut instance = self.held(py)?;
        let steps = steps(&instance).map_err(raise(py))?;
        let instance: &mut Instance = &mut instance;
        py.detach(|| Watch::new(&AtomicBool::new(false)).advance(instance, steps))
            .map_err(|stop| stop.raised(py))
    }
}

#[pymethods]
impl Plant {
    /// One step.
    ///
    /// Raises:
    ///     StepFailed: The step failed, or one has before.
    fn step(&self, py: Python<'_>) -> PyResult<()> {
        self.held(py)?.advance(1).map_err(raise(py))
    }

    /// Advances by the given number of steps with held inputs. Other threads run meanwhile.
    ///
    /// Raises:
    ///     StepFailed: A step failed, or one has before.
    fn advance(&self, py: Python<'_>, steps: u64) -> PyResult<()> {
        self.advanced(py, |_| Ok(steps))
    }

    /// Advances to a time [s], or a text with a unit as ``"20ms"``; it must be a whole number of steps to 0.01 steps.
    /// Other threads run meanwhile.
    ///
    /// Raises:
    ///     TimeError: It is not a valid time or whole number of steps, or has passed; nothing is changed then.
    ///     StepFailed: A step failed, or one has before.
    fn advance_to(&self, py: Python<'_>, time: Seconds) -> PyResult<()> {
        self.advanced(py, |instance| instance.steps_to(time.0))
    }

    /// Resets to t = 0 with the present parameters and the initial inputs.
    fn reset(&self, py: Python<'_>) -> PyResult<()> {
        self.held(py)?.reset();
        Ok(())
    }

    /// Sets an input to a value [its unit], held until it is set again. The same as ``plant[name] = value``.
    ///
    /// Raises:
    ///     UnknownName: No input has this name.
    ///     InputError: The value is not finite in the precision; nothing is changed then.
    fn set(&self, py: Python<'_>, name: &str, value: f64) -> PyResult<()> {
        let mut instance = self.held(py)?;
        let input = instance.input(name).map_err(raise(py))?;
        instance.set_input(input, value).map_err(raise(py))
    }

    /// The present value of an output or input [its unit]; NaN if undefined. The same as
    /// ``plant[name]``.
    ///
    /// Raises:
    ///     UnknownName: No output or input has this name.
    fn get(&self, py: Python<'_>, name: &str) -> PyResult<f64> {
        let instance = self.held(py)?;
        if let Ok(input) = instance.input(name) {
            return Ok(instance.input_value(input).unwrap_or(f64::NAN));
        }
        let columns =
            arguments::columns(&instance, Some(vec![name.to_owned()])).map_err(raise(py))?;
        let mut value = Vec::with_capacity(1);
        read(&instance, &columns, &mut value);
        Ok(value[0])
    }

    fn __setitem__(&self, py: Python<'_>, name: &str, value: f64) -> PyResult<()> {
        self.set(py, name, value)
    }

    fn __getitem__(&self, py: Python<'_>, name: &str) -> PyResult<f64> {
        self.get(py, name)
    }

    /// The present outputs: all, or the named ones, in this order; ``"time"`` is the time. An array of floats.
    ///
    /// Raises:
    ///     UnknownName: No output has this name.
    #[pyo3(signature = (names=None))]
    fn read<'py>(
        &self,
        py: Python<'py>,
        names: Option<Vec<String>>,
    ) -> PyResult<Bound<'py, PyArray1<f64>>> {
        let instance = self.held(py)?;
        let columns = arguments::columns(&instance, names).map_err(raise(py))?;
        let mut values = Vec::with_capacity(columns.len());
        read(&instance, &columns, &mut values);
        Ok(PyArray1::from_vec(py, values))
    }

    /// The bodies' positions, orientations, velocities and angular velocities: a `State` of copies.
    #[getter]
    fn state<'py>(&self, py: Python<'py>) -> PyResult<Bound<'py, PyAny>> {
        let all = states::arrays(self.held(py)?.plant());
        let arrays = all.into_iter().zip(states::PARTS).map(|(part, (_, width))| {
            let bodies = part.len() / width;
            arguments::shaped(py, part, bodies, width)
        });
        let arrays = arrays.collect::<PyResult<Vec<_>>>()?;
        py.import("dbd._state")?.getattr("State")?.call1(PyTuple::new(py, arrays)?)
    }

    /// Sets the states of the bodies; `None` keeps a part. The time, inputs and revolution counts of
    /// joints are kept, so a joint's angle should be within half a revolution of the present one. Clears a failure.
    ///
    /// Args:
    ///     state: A `State`, or `None`; the other arguments take precedence.
    ///     position: [m] bodies × 3, centres of mass in the world.
    ///     orientation: bodies × 4, unit quaternions, scalar first, body to world.
    ///     velocity: [m/s] bodies × 3, of the centres of mass in the world.
    ///     angular_velocity: [rad/s] bodies × 3, in body axes.
    ///
    /// Raises:
    ///     StateError: It is of another shape, not finite, a quaternion is not of unit length within 1e-3,
    ///         or the precision cannot hold it; nothing is changed then.
    #[pyo3(signature = (state=None, *, position=None, orientation=None, velocity=None, angular_velocity=None))]
    fn set_state<'py>(
        &self,
        py: Python<'py>,
        state: Option<Bound<'py, PyAny>>,
        position: Option<Bound<'py, PyAny>>,
        orientation: Option<Bound<'py, PyAny>>,
        velocity: Option<Bound<'py, PyAny>>,
        angular_velocity: Option<Bound<'py, PyAny>>,
    ) -> PyResult<()> {
        let given = [position, orientation, velocity, angular_velocity];
        let mut parts: [Option<Vec<f64>>; 4] = Default::default();
        let mut instance = self.held(py)?;
        let bodies = instance.scene().body_names.len();
        for ((part, given), (name, width)) in parts.iter_mut().zip(given).zip(states::PARTS) {
            let of_state = || state.as_ref().map(|state| state.getattr(name)).transpose();
            if let Some(array) = given.map_or_else(of_state, |array| Ok(Some(array)))? {
                let array: PyArrayLikeDyn<'_, f64, AllowTypeChange> = array.extract()?;
                if array.shape() != [bodies, width] {
                    let shape = format!(
                        "{name} is an array of {:?}; {bodies} × {width} is its shape here",
                        array.shape()
                    );
                    return Err(Refusal::new("StateError", shape).raised(py));
                }
                *part = Some(array.as_array().iter().copied().collect());
            }
        }
        states::set(&mut instance, &parts).map_err(|refusal| refusal.raised(py))
    }

    /// The state, including inputs and set parameters, as bytes for a plant of the same scene, scheme,
    /// precision and step on any machine.
    ///
    /// Raises:
    ///     StateError: The plant has failed.
    fn save<'py>(&self, py: Python<'py>) -> PyResult<Bound<'py, PyBytes>> {
        Ok(PyBytes::new(py, &self.held(py)?.save().map_err(raise(py))?))
    }

    /// Restores a saved state bit for bit; clears a failure.
    ///
    /// Raises:
    ///     StateError: The bytes are damaged, or of another scene or method; nothing is changed then.
    fn restore(&self, py: Python<'_>, saved: &[u8]) -> PyResult<()> {
        self.held(py)?.restore(saved).map_err(raise(py))
    }

    /// Runs with inputs that are held for `every` steps each. Other threads run meanwhile.
    ///
    /// Args:
    ///     u: samples × inputs, or samples for one input: the held input values [their units]; or
    ///         an int, the number of samples with the present inputs.
    ///     every: Steps per sample.
    ///     outputs: Names of the columns, including ``"time"``; default: all outputs.
    ///     inputs: Names of the columns of `u`; default: all inputs, in scene order.
    ///
    /// Returns:
    ///     An array of samples × outputs, after each hold. The initial state is not included.
    ///
    /// Raises:
    ///     UnknownName, InputError, StepFailed: as `set` and `advance`; the plant stays at the failed sample.
    #[pyo3(signature = (u, every=1, outputs=None, *, inputs=None))]
    fn rollout<'py>(
        &self,
        py: Python<'py>,
        u: Held<'py>,
        every: u64,
        outputs: Option<Vec<String>>,
        inputs: Option<Vec<String>>,
    ) -> PyResult<Bound<'py, PyArray2<f64>>> {
        let mut instance = self.held(py)?;
        let (course, held) = arguments::course(py, &instance, u, every, outputs, inputs, None)?;
        let instance: &mut Instance = &mut instance;
        let rows = py
            .detach(|| course.run(instance, &held, Watch::new(&AtomicBool::new(false))))
            .map_err(|stop| stop.raised(py))?;
        arguments::shaped(py, rows, course.samples, course.columns.len())
    }

    /// Moves the bodies to the static equilibrium with the held inputs, downhill from the present pose, without
    /// velocities. Time, inputs and revolution counts are kept. Clears a failure.
    ///
    /// Raises:
    ///     EquilibriumError: Nothing holds a body, or there are more than 200; nothing is changed then.
    fn settle(&self, py: Python<'_>) -> PyResult<()> {
        self.held(py)?.settle().map_err(raise(py))
    }

    /// Inverse dynamics: the inputs that give velocities the wanted accelerations in the present state, as
    /// computed-torque control needs them. The plant does not change.
    ///
    /// Args:
    ///     states: As for `linearise`: names of a position and its rate for each degree of freedom.
    ///     accelerations: Name of a velocity among the states → its wanted acceleration [its unit/s].
    ///     inputs: Names; default: all inputs. Of several solutions, the one with the least sum of squared changes
    ///         in SI units is returned.
    ///     perturb: As for `linearise`.
    ///
    /// Returns:
    ///     Input name → value [its unit].
    ///
    /// Raises:
    ///     LinearisationError: As `linearise`, or the inputs cannot give these accelerations.
    ///     UnknownName: No state or input has this name.
    #[pyo3(signature = (states, accelerations, inputs=None, *, perturb=1e-5))]
    fn inverse_dynamics(
        &self,
        py: Python<'_>,
        states: Vec<String>,
        accelerations: Bound<'_, PyDict>,
        inputs: Option<Vec<String>>,
        perturb: f64,
    ) -> PyResult<Py<PyDict>> {
        let options = LinearOptions { states: Some(states), inputs, outputs: None, perturb };
        let wanted: Vec<(String, f64)> = accelerations
            .iter()
            .map(|(name, rate)| Ok((name.extract()?, rate.extract()?)))
            .collect::<PyResult<_>>()?;
        let mut instance = self.held(py)?;
        let instance: &mut Instance = &mut instance;
        let found =
            py.detach(move || instance.inverse_dynamics(&options, &wanted)).map_err(raise(py))?;
        let values = PyDict::new(py);
        for (name, value) in found {
            values.set_item(name, value)?;
        }
        Ok(values.unbind())
    }

    /// The plant as a linear system near its present state, see `dbd.Linear`.
    ///
    /// Args:
    ///     states: Names of outputs to use as states of the linear system. `None`: twelve coordinates per body.
    ///     inputs: Names; default: all inputs.
    ///     outputs: Names; default: the states, or all read-outs without states.
    ///     perturb: [m, rad, m/s, rad/s] perturbation of the fourth-order differences.
    ///
    /// Raises:
    ///     LinearisationError: The states do not describe the slow motions, `perturb` is not between 0 and 0.1,
    ///         or a value is undefined in this state.
    ///     UnknownName: No output or input has this name.
    #[pyo3(signature = (states=None, inputs=None, outputs=None, *, perturb=1e-5))]
    fn linearise<'py>(
        &self,
        py: Python<'py>,
        states: Option<Vec<String>>,
        inputs: Option<Vec<String>>,
        outputs: Option<Vec<String>>,
        perturb: f64,
    ) -> PyResult<Bound<'py, PyAny>> {
        let options = LinearOptions { states, inputs, outputs, perturb };
        let mut instance = self.held(py)?;
        // A plant may be sent to a thread, but not shared.
        let instance: &mut Instance = &mut instance;
        let linear = py.detach(move || instance.linearise(&options)).map_err(raise(py))?;
        let matrix = |of: &DMatrix<f64>| {
            let rows = of.transpose().as_slice().to_vec();
            arguments::shaped(py, rows, of.nrows(), of.ncols())
        };
        let class = py.import("dbd._linear")?.getattr("Linear")?;
        class.call1((
            matrix(&linear.a)?,
            matrix(&linear.b)?,
            matrix(&linear.c)?,
            matrix(&linear.d)?,
            linear.drift.as_slice().to_pyarray(py),
            linear.states,
            linear.inputs,
            linear.outputs,
            linear.slowest_left_out,
        ))
    }
}
