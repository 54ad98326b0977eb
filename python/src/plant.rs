//! The class `Plant`.
//!
//! `scene, method, step => plant`; `(inputs, steps) => outputs` as numbers and numpy arrays.

use std::collections::BTreeMap;
use std::sync::{Mutex, MutexGuard, TryLockError};

use dbd_instance::{Blueprint, Instance, Settings};
use numpy::{
    AllowTypeChange, PyArray1, PyArray2, PyArrayLikeDyn, PyUntypedArrayMethods as _, ToPyArray as _,
};
use pyo3::exceptions::PyValueError;
use pyo3::prelude::*;
use pyo3::types::{PyBytes, PyDict, PyMappingProxy, PyTuple};

use crate::arguments::{self, Held};
use crate::error::{Refusal, raise};
use crate::jacobian::Probe;
use crate::rollout::{Watch, read};
use crate::states;

/// Rows, columns and values of each Jacobian.
type Matrices<'py> = (Bound<'py, PyArray1<f64>>, [Bound<'py, PyArray2<f64>>; 4]);

/// A scene's plant: a multibody system that is stepped with the bits of the firmware.
///
/// Args:
///     scene: Path of a scene file, TOML.
///     scheme: How it is stepped, as ``host-sim run --scheme``; ``leapfrog`` if not said.
///     newton: Newton iterations of the schemes that have them.
///     damping: How dampers are stepped, as ``host-sim run --damping``.
///     precision: ``f64``, ``f32``, ``fixed``, as ``host-sim run --precision``; ``f64`` if not said.
///     step: \[s\] the step; the scene's if not said, else the advised one.
///     changes: Changes of the scene's values, each ``"PATH=VALUE"`` as of ``host-sim run --set``.
///
/// A plant begins at t = 0. It may be used from any thread, by one at a time.
///
/// Raises:
///     SceneError: The scene cannot be read or is refused.
///     MethodError: There is no such scheme, damping or precision, or it does not go with the scene.
#[pyclass(frozen, subclass, module = "dbd")]
pub(crate) struct Plant {
    pub(crate) instance: Mutex<Instance>,
}

impl Plant {
    fn of(py: Python<'_>, blueprint: Blueprint, settings: Settings) -> PyResult<Self> {
        let instance = py.detach(|| Instance::new(blueprint, settings));
        Ok(Self { instance: Mutex::new(instance.map_err(raise(py))?) })
    }

    /// The instance, or that another thread has it.
    pub(crate) fn held(&self, py: Python<'_>) -> PyResult<MutexGuard<'_, Instance>> {
        match self.instance.try_lock() {
            Ok(instance) => Ok(instance),
            // Its state is plain numbers: whole after any step.
            Err(TryLockError::Poisoned(poisoned)) => Ok(poisoned.into_inner()),
            Err(TryLockError::WouldBlock) => Err(Refusal::busy().raised(py)),
        }
    }

    /// Steps without holding the interpreter.
    fn advanced(
        &self,
        py: Python<'_>,
        steps: impl FnOnce(&Instance) -> Result<u64, dbd_instance::InstanceError>,
    ) -> PyResult<()> {
        let mut instance = self.held(py)?;
        let steps = steps(&instance).map_err(raise(py))?;
        let instance: &mut Instance = &mut instance;
        py.detach(|| Watch::new().advance(instance, steps)).map_err(|stop| stop.raised(py))
    }
}

#[pymethods]
impl Plant {
    #[new]
    #[pyo3(signature = (scene, *, scheme=None, newton=None, damping=None, precision=None, step=None, changes=Vec::new()))]
    #[expect(clippy::too_many_arguments, reason = "keywords in Python")]
    fn new(
        py: Python<'_>,
        scene: std::path::PathBuf,
        scheme: Option<String>,
        newton: Option<u32>,
        damping: Option<String>,
        precision: Option<String>,
        step: Option<f64>,
        changes: Vec<String>,
    ) -> PyResult<Self> {
        let blueprint = Blueprint::load(scene).map_err(|error| raise(py)(error.into()))?;
        let settings = Settings { scheme, newton, damping, precision, step };
        Self::of(py, Blueprint { changes, ..blueprint }, settings)
    }

    /// A plant from a scene's text.
    ///
    /// Args:
    ///     text: The scene, TOML.
    ///     name: What messages call the text.
    ///
    /// The other arguments and what is raised are those of the class.
    #[staticmethod]
    #[pyo3(signature = (text, name="scene.toml", *, scheme=None, newton=None, damping=None, precision=None, step=None, changes=Vec::new()))]
    #[expect(clippy::too_many_arguments, reason = "keywords in Python")]
    fn from_text(
        py: Python<'_>,
        text: &str,
        name: &str,
        scheme: Option<String>,
        newton: Option<u32>,
        damping: Option<String>,
        precision: Option<String>,
        step: Option<f64>,
        changes: Vec<String>,
    ) -> PyResult<Self> {
        let settings = Settings { scheme, newton, damping, precision, step };
        Self::of(py, Blueprint { changes, ..Blueprint::new(name, text) }, settings)
    }

    /// The scene's name.
    #[getter]
    fn name(&self, py: Python<'_>) -> PyResult<String> {
        Ok(self.held(py)?.scene().name.clone())
    }

    /// \[s\] the duration that the scene gives: how long ``host-sim run`` goes on. A plant goes on beyond it.
    #[getter]
    fn duration(&self, py: Python<'_>) -> PyResult<f64> {
        Ok(self.held(py)?.scene().duration)
    }

    /// \[s\] the time of the present state: steps done times the step.
    #[getter]
    fn time(&self, py: Python<'_>) -> PyResult<f64> {
        Ok(self.held(py)?.time())
    }

    /// \[s\] the step.
    #[getter]
    fn step_size(&self, py: Python<'_>) -> PyResult<f64> {
        Ok(self.held(py)?.step_size())
    }

    /// Steps done since t = 0.
    #[getter]
    fn steps(&self, py: Python<'_>) -> PyResult<u64> {
        Ok(self.held(py)?.plant().steps())
    }

    /// FNV-1a 64 over the state's words: equal where all bits are.
    #[getter]
    fn hash(&self, py: Python<'_>) -> PyResult<u64> {
        Ok(self.held(py)?.hash())
    }

    /// The hash as ``host-sim run`` writes it, 16 digits: ``state_hash``.
    #[getter]
    fn hash_text(&self, py: Python<'_>) -> PyResult<String> {
        Ok(format!("{:016x}", self.held(py)?.hash()))
    }

    /// Names of the bodies, in the order of the rows of `state`.
    #[getter]
    fn bodies(&self, py: Python<'_>) -> PyResult<Vec<String>> {
        Ok(self.held(py)?.scene().body_names.clone())
    }

    /// Inputs, in scene order: name → SI unit.
    #[getter]
    fn inputs<'py>(&self, py: Python<'py>) -> PyResult<Bound<'py, PyMappingProxy>> {
        let instance = self.held(py)?;
        mapping(py, instance.inputs().iter().map(|input| (input.name.as_str(), input.unit)))
    }

    /// Outputs, the columns of a trace: name → SI unit, empty for a plain number.
    #[getter]
    fn outputs<'py>(&self, py: Python<'py>) -> PyResult<Bound<'py, PyMappingProxy>> {
        let instance = self.held(py)?;
        mapping(py, instance.outputs().iter().map(|output| (output.name.as_str(), output.unit)))
    }

    /// Outputs: name → what it is, in a few words.
    #[getter]
    fn descriptions<'py>(&self, py: Python<'py>) -> PyResult<Bound<'py, PyMappingProxy>> {
        let instance = self.held(py)?;
        let outputs = instance.outputs().iter();
        mapping(py, outputs.map(|output| (output.name.as_str(), output.description.as_str())))
    }

    /// Parameters, all numbers that the scene writes: path → value now, in SI units. `set_parameters` sets them.
    #[getter]
    fn parameters<'py>(&self, py: Python<'py>) -> PyResult<Bound<'py, PyMappingProxy>> {
        let numbers = self.held(py)?.parameters().map_err(raise(py))?;
        mapping(py, numbers.into_iter().map(|number| (number.path, number.value)))
    }

    /// Parameters: path → SI unit, empty for a plain number.
    #[getter]
    fn parameter_units<'py>(&self, py: Python<'py>) -> PyResult<Bound<'py, PyMappingProxy>> {
        let numbers = self.held(py)?.parameters().map_err(raise(py))?;
        mapping(py, numbers.into_iter().map(|number| (number.path, number.unit)))
    }

    /// Sets parameters, path → value in SI units, and goes back to t = 0; inputs stay as they are held.
    ///
    /// Raises:
    ///     SceneError: A path leads nowhere, or the scene is refused with the values; nothing is changed then.
    ///     InputError: A value is not finite; nothing is changed then.
    fn set_parameters(&self, py: Python<'_>, parameters: BTreeMap<String, f64>) -> PyResult<()> {
        let pairs = parameters.iter().map(|(path, value)| (path.as_str(), *value));
        self.held(py)?.set_parameters(pairs).map_err(raise(py))
    }

    /// One step.
    ///
    /// Raises:
    ///     StepFailed: The step failed, or one has before.
    fn step(&self, py: Python<'_>) -> PyResult<()> {
        self.held(py)?.advance(1).map_err(raise(py))
    }

    /// So many steps with held inputs. Other threads run meanwhile.
    ///
    /// Raises:
    ///     StepFailed: A step failed, or one has before.
    fn advance(&self, py: Python<'_>, steps: u64) -> PyResult<()> {
        self.advanced(py, |_| Ok(steps))
    }

    /// On to a time \[s\], within a hundredth of a step a whole number of steps. Other threads run meanwhile.
    ///
    /// Raises:
    ///     TimeError: It is no whole number of steps, has passed, or is not finite; nothing is changed then.
    ///     StepFailed: A step failed, or one has before.
    fn advance_to(&self, py: Python<'_>, time: f64) -> PyResult<()> {
        self.advanced(py, |instance| instance.steps_to(time))
    }

    /// Back to t = 0 with the parameters as they are; inputs have their first values.
    fn reset(&self, py: Python<'_>) -> PyResult<()> {
        self.held(py)?.reset();
        Ok(())
    }

    /// Holds an input at a value \[its unit\] until it is set again. The same as ``plant[name] = value``.
    ///
    /// Raises:
    ///     UnknownName: There is no such input.
    ///     InputError: The value is not finite in the precision; nothing is changed then.
    fn set(&self, py: Python<'_>, name: &str, value: f64) -> PyResult<()> {
        let mut instance = self.held(py)?;
        let input = instance.input(name).map_err(raise(py))?;
        instance.set_input(input, value).map_err(raise(py))
    }

    /// An output as it is now, or what an input is held at \[its unit\]; NaN where it is undefined. The same as
    /// ``plant[name]``.
    ///
    /// Raises:
    ///     UnknownName: There is no such output or input.
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

    /// Outputs as they are now: all, or those of the names, in their order; ``"time"`` is the time. An array of floats.
    ///
    /// Raises:
    ///     UnknownName: There is no such output.
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

    /// Gives the bodies other states; what is `None` stays. The time, inputs and the turns that are counted at
    /// joints stay, so a joint's angle should be within half a turn of the present one. A failure is forgotten.
    ///
    /// Args:
    ///     state: A `State`, or `None`; what the others give goes before it.
    ///     position: \[m\] bodies × 3, centres of mass in the world.
    ///     orientation: bodies × 4, unit quaternions, scalar first, body to world.
    ///     velocity: \[m/s\] bodies × 3, of the centres of mass in the world.
    ///     angular_velocity: \[rad/s\] bodies × 3, in body axes.
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

    /// The state, inputs and set parameters included, as bytes that a plant of the same scene, scheme,
    /// precision and step takes up on any machine.
    ///
    /// Raises:
    ///     StateError: The plant has failed.
    fn save<'py>(&self, py: Python<'py>) -> PyResult<Bound<'py, PyBytes>> {
        Ok(PyBytes::new(py, &self.held(py)?.save().map_err(raise(py))?))
    }

    /// Goes on from a saved state, bit for bit; a failure is forgotten.
    ///
    /// Raises:
    ///     StateError: The bytes are damaged, or of another scene or method; nothing is changed then.
    fn restore(&self, py: Python<'_>, saved: &[u8]) -> PyResult<()> {
        self.held(py)?.restore(saved).map_err(raise(py))
    }

    /// Another plant in the same state.
    ///
    /// Raises:
    ///     StateError: The plant has failed.
    fn copy(&self, py: Python<'_>) -> PyResult<Self> {
        let other = self.held(py)?.duplicate().map_err(raise(py))?;
        Ok(Self { instance: Mutex::new(other) })
    }

    fn __copy__(&self, py: Python<'_>) -> PyResult<Self> {
        self.copy(py)
    }

    fn __deepcopy__(&self, py: Python<'_>, _memo: &Bound<'_, PyDict>) -> PyResult<Self> {
        self.copy(py)
    }

    /// Runs with inputs that are held for `every` steps each. Other threads run meanwhile.
    ///
    /// Args:
    ///     u: samples × inputs, or samples where there is one input: what inputs are held at \[their units\]; or
    ///         an int, so many samples with the inputs as they are.
    ///     every: Steps of each sample.
    ///     outputs: Names of the columns, ``"time"`` among them is the time; all outputs if not said.
    ///     inputs: Names of the columns of `u`; all inputs, in scene order, if not said.
    ///
    /// Returns:
    ///     An array of samples × outputs: what they are after each hold. The state at the beginning is not in it.
    ///
    /// Raises:
    ///     UnknownName, InputError, StepFailed: as `set` and `advance`; the plant stays where it was refused.
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
        let rows = py.detach(|| course.run(instance, &held)).map_err(|stop| stop.raised(py))?;
        arguments::shaped(py, rows, course.samples, course.columns.len())
    }

    /// The plant as a linear system near its present state. See `dbd.Linear` for what it is.
    ///
    /// Args:
    ///     states: Names of outputs that are the states of the linear system. `None`: twelve coordinates per body.
    ///     inputs: Names; all inputs if not said.
    ///     outputs: Names; the states if not said, without states all read-outs.
    ///     perturb: \[m, rad, m/s, rad/s\] of the differences, which are of fourth order.
    ///
    /// Raises:
    ///     LinearisationError: The states are not those of the slow motions, or something is undefined here.
    ///     UnknownName: There is no such output or input.
    #[pyo3(signature = (states=None, inputs=None, outputs=None, *, perturb=1e-5))]
    fn linearise<'py>(
        slf: &Bound<'py, Self>,
        states: Option<Vec<String>>,
        inputs: Option<Vec<String>>,
        outputs: Option<Vec<String>>,
        perturb: f64,
    ) -> PyResult<Bound<'py, PyAny>> {
        let linear = slf.py().import("dbd._linear")?;
        linear.call_method1("linearise", (slf, states, inputs, outputs, perturb))
    }

    /// The Jacobians that `linearise` stands on, `shift` away from the present state: ẋ, (A, B, C, D).
    fn _jacobians<'py>(
        &self,
        py: Python<'py>,
        inputs: Vec<String>,
        outputs: Vec<String>,
        shift: Vec<f64>,
        perturb: f64,
    ) -> PyResult<Matrices<'py>> {
        if !(perturb.is_finite() && perturb > 0.0 && perturb < 0.1) {
            return Err(PyValueError::new_err(format!(
                "perturb cannot be {perturb:?}; between 0 and 0.1"
            )));
        }
        let instance = self.held(py)?;
        let inputs = arguments::inputs(&instance, Some(inputs)).map_err(raise(py))?;
        let names = outputs.iter().map(|name| instance.output(name));
        let outputs = names.collect::<Result<Vec<_>, _>>().map_err(raise(py))?;
        let mut probe = Probe::new(&instance).map_err(raise(py))?;
        let refused = |refusal: Refusal| refusal.raised(py);
        probe.shift(&shift);
        let all = py.detach(|| probe.jacobians(&inputs, &outputs, perturb)).map_err(refused)?;
        let matrix = |values, rows, columns| arguments::shaped(py, values, rows, columns);
        let (count, width) = (all.count, inputs.len());
        let matrices = [
            matrix(all.a, count, count)?,
            matrix(all.b, count, width)?,
            matrix(all.c, outputs.len(), count)?,
            matrix(all.d, outputs.len(), width)?,
        ];
        Ok((all.rate.to_pyarray(py), matrices))
    }

    /// The scene's text, its name in messages, its changes, the settings and the saved state.
    fn __reduce__<'py>(
        slf: &Bound<'py, Self>,
    ) -> PyResult<(Bound<'py, PyAny>, Bound<'py, PyTuple>)> {
        let py = slf.py();
        let instance = slf.get().held(py)?;
        let (blueprint, settings) = (instance.blueprint(), instance.settings());
        let keywords = PyDict::new(py);
        keywords.set_item("scheme", &settings.scheme)?;
        keywords.set_item("newton", settings.newton)?;
        keywords.set_item("damping", &settings.damping)?;
        keywords.set_item("precision", &settings.precision)?;
        keywords.set_item("step", settings.step)?;
        keywords.set_item("changes", &blueprint.changes)?;
        let saved = PyBytes::new(py, &instance.save().map_err(raise(py))?);
        let parts = (&*blueprint.text, &blueprint.file, keywords, saved);
        Ok((py.import("dbd._state")?.getattr("rebuilt")?, parts.into_pyobject(py)?))
    }

    fn __repr__(&self, py: Python<'_>) -> PyResult<String> {
        let instance = self.held(py)?;
        let (scene, method) = (&instance.scene().name, instance.plant().method());
        Ok(format!(
            "<dbd.Plant {scene}: {}, step {:?} s, t = {:?} s>",
            method.scheme_name(),
            instance.step_size(),
            instance.time()
        ))
    }
}

/// A mapping that nobody changes by mistake.
fn mapping<'py, K: IntoPyObject<'py>, V: IntoPyObject<'py>>(
    py: Python<'py>,
    pairs: impl Iterator<Item = (K, V)>,
) -> PyResult<Bound<'py, PyMappingProxy>> {
    let dict = PyDict::new(py);
    for (key, value) in pairs {
        dict.set_item(key, value)?;
    }
    Ok(PyMappingProxy::new(py, dict.as_mapping()))
}
