//! The class `Plant`.
//!
//! `scene, method, step => plant`, its names, units and parameters.

use std::collections::BTreeMap;
use std::sync::{Mutex, MutexGuard, TryLockError};

use dbd_plant::instance::{Blueprint, Instance, Settings};
use pyo3::prelude::*;
use pyo3::types::{PyBytes, PyDict, PyMappingProxy, PyTuple};

use crate::arguments::Seconds;
use crate::error::{Refusal, raise};
use crate::shipped::{Called, called};

/// A scene's plant: a multibody system, bit-identical to the firmware.
///
/// Args:
///     scene: Path of a TOML scene file, or the name of a built-in scene, such as ``four-bar``: a key of
///         ``dbd.SCENES``. A file of that name takes precedence.
///     scheme: Time-stepping scheme, as ``host-sim run --scheme``; default: ``leapfrog``.
///     newton: Newton iterations, for schemes that have them.
///     rho: Spectral radius of ``generalized-alpha`` at infinite frequency, 0 to 0.8.
///     damping: Damping method, as ``host-sim run --damping``.
///     precision: ``f64``, ``f32``, ``fixed``, as ``host-sim run --precision``; default: ``f64``.
///     step: [s] the step, or a text with a unit, ``"250us"``; default: the scene's, else the advised one.
///     changes: Changes of the scene's values, each ``"PATH=VALUE"`` as for ``host-sim run --set``.
///
/// A plant starts at t = 0. It may be used from any thread, one at a time.
///
/// Raises:
///     SceneError: The scene cannot be read or is invalid.
///     MethodError: The scheme, damping or precision is unknown or not compatible with the scene.
///     TimeError: The step's text is not a valid time.
#[pyclass(frozen, subclass, module = "dbd")]
pub(crate) struct Plant {
    pub(crate) instance: Mutex<Instance>,
}

impl Plant {
    fn of(py: Python<'_>, blueprint: Blueprint, settings: Settings) -> PyResult<Self> {
        let instance = py.detach(|| Instance::new(blueprint, settings));
        Ok(Self { instance: Mutex::new(instance.map_err(raise(py))?) })
    }

    /// The instance, or an error if another thread uses it.
    pub(crate) fn held(&self, py: Python<'_>) -> PyResult<MutexGuard<'_, Instance>> {
        match self.instance.try_lock() {
            Ok(instance) => Ok(instance),
            // Its state is plain numbers: consistent after any step.
            Err(TryLockError::Poisoned(poisoned)) => Ok(poisoned.into_inner()),
            Err(TryLockError::WouldBlock) => Err(Refusal::busy().raised(py)),
        }
    }
}

#[pymethods]
impl Plant {
    #[new]
    #[pyo3(signature = (scene, *, scheme=None, newton=None, rho=None, damping=None, precision=None, step=None, changes=Vec::new()))]
    #[expect(clippy::too_many_arguments, reason = "keywords in Python")]
    fn new(
        py: Python<'_>,
        scene: std::path::PathBuf,
        scheme: Option<String>,
        newton: Option<u32>,
        rho: Option<f64>,
        damping: Option<String>,
        precision: Option<String>,
        step: Option<Seconds>,
        changes: Vec<String>,
    ) -> PyResult<Self> {
        let blueprint = match called(&scene) {
            Called::Shipped(name, text) => Blueprint::new(format!("{name}.toml"), text),
            Called::File => Blueprint::load(scene).map_err(|error| raise(py)(error.into()))?,
            Called::Unknown(near) => {
                let help = near.map_or_else(
                    || "dbd.SCENES lists the built-in scenes".to_owned(),
                    |near| format!("did you mean `{near}`?"),
                );
                let sentence = format!("no file or built-in scene `{}`; {help}", scene.display());
                return Err(Refusal::new("SceneError", sentence).raised(py));
            }
        };
        let step = step.map(|step| step.0);
        let settings = Settings { scheme, newton, rho, damping, precision, step };
        Self::of(py, Blueprint { changes, ..blueprint }, settings)
    }

    /// A plant from a scene's text.
    ///
    /// Args:
    ///     text: The scene, TOML.
    ///     name: The text's name in messages.
    ///
    /// The other arguments and the exceptions are those of the class.
    #[staticmethod]
    #[pyo3(signature = (text, name="scene.toml", *, scheme=None, newton=None, rho=None, damping=None, precision=None, step=None, changes=Vec::new()))]
    #[expect(clippy::too_many_arguments, reason = "keywords in Python")]
    fn from_text(
        py: Python<'_>,
        text: &str,
        name: &str,
        scheme: Option<String>,
        newton: Option<u32>,
        rho: Option<f64>,
        damping: Option<String>,
        precision: Option<String>,
        step: Option<Seconds>,
        changes: Vec<String>,
    ) -> PyResult<Self> {
        let step = step.map(|step| step.0);
        let settings = Settings { scheme, newton, rho, damping, precision, step };
        Self::of(py, Blueprint { changes, ..Blueprint::new(name, text) }, settings)
    }

    /// The scene's name.
    #[getter]
    fn name(&self, py: Python<'_>) -> PyResult<String> {
        Ok(self.held(py)?.scene().name.clone())
    }

    /// [s] the scene's duration, at which ``host-sim run`` ends. A plant may continue beyond it.
    #[getter]
    fn duration(&self, py: Python<'_>) -> PyResult<f64> {
        Ok(self.held(py)?.scene().duration)
    }

    /// [s] the time of the present state: steps done times the step.
    #[getter]
    fn time(&self, py: Python<'_>) -> PyResult<f64> {
        Ok(self.held(py)?.time())
    }

    /// [s] the step.
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

    /// Outputs: name → short description.
    #[getter]
    fn descriptions<'py>(&self, py: Python<'py>) -> PyResult<Bound<'py, PyMappingProxy>> {
        let instance = self.held(py)?;
        let outputs = instance.outputs().iter();
        mapping(py, outputs.map(|output| (output.name.as_str(), output.description.as_str())))
    }

    /// Parameters, i.e. all numbers in the scene: path → present value, in SI units. `set_parameters` sets them.
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

    /// Sets parameters, path → value in SI units, and resets to t = 0; inputs are kept.
    ///
    /// Raises:
    ///     SceneError: A path does not exist, or the values make the scene invalid; nothing is changed then.
    ///     InputError: A value is not finite; nothing is changed then.
    fn set_parameters(&self, py: Python<'_>, parameters: BTreeMap<String, f64>) -> PyResult<()> {
        let pairs = parameters.iter().map(|(path, value)| (path.as_str(), *value));
        self.held(py)?.set_parameters(pairs).map_err(raise(py))
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
        keywords.set_item("rho", settings.rho)?;
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

/// A read-only mapping.
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
