//! A plant with named inputs, outputs and parameters.
//!
//! `(inputs, time) => outputs`. Outputs are computed on request. Parameters are those of the scene's text; setting them
//! rebuilds the plant.

use std::collections::BTreeMap;

use crate::readings::append;
use crate::{AnyPlant, plant};
use dbd_scene::parameters::SceneNumber;
use dbd_scene::{BODY_COLUMNS, ENERGY_COLUMNS, Scene, nearest};

use crate::instance::blueprint::Blueprint;
use crate::instance::error::InstanceError;
use crate::instance::settings::Settings;
use crate::instance::variables::{self, Input, Output};

/// Tolerance of a time against a whole number of steps, in steps: callers accumulate their own time.
pub const NEAR: f64 = 0.01;

/// A scene's plant with named values.
///
/// It is `Send`: each thread may have its own. A failure latches until [`Self::reset`],
/// [`Self::restore`] or [`Self::set_parameters`].
pub struct Instance {
    pub(crate) blueprint: Blueprint,
    pub(crate) settings: Settings,
    /// Parameters that were set, by path.
    pub(crate) set: BTreeMap<String, f64>,
    scene: Scene,
    pub(crate) plant: Box<dyn AnyPlant>,
    inputs: Vec<Input>,
    outputs: Vec<Output>,
}

impl Instance {
    /// An instance at t = 0.
    ///
    /// # Errors
    /// If the scene is invalid, or the settings are unknown or incompatible with the scene.
    pub fn new(blueprint: Blueprint, settings: Settings) -> Result<Self, InstanceError> {
        Self::with(blueprint, settings, BTreeMap::new())
    }

    pub(crate) fn with(
        blueprint: Blueprint,
        settings: Settings,
        set: BTreeMap<String, f64>,
    ) -> Result<Self, InstanceError> {
        let scene = blueprint.scene(&set)?;
        let method = settings.method()?;
        let step = settings.step_of(&scene, &method)?;
        let plant = plant(&scene, &method, step)?;
        let state = plant.state();
        let start = |input: dbd_kernel::InputIndex| {
            let signal = state.signals.get(usize::from(input.0));
            signal.map_or([0.0; 2], |signal| [signal.value, signal.rate])
        };
        let inputs = variables::inputs(&scene, start);
        let outputs = variables::outputs(&scene);
        Ok(Self { blueprint, settings, set, scene, plant, inputs, outputs })
    }

    /// Another instance in the same state.
    ///
    /// # Errors
    /// [`InstanceError::State`] where this one has failed.
    pub fn duplicate(&self) -> Result<Self, InstanceError> {
        let state = self.plant.snapshot().map_err(InstanceError::State)?;
        let (blueprint, settings) = (self.blueprint.clone(), self.settings.clone());
        let mut other = Self::with(blueprint, settings, self.set.clone())?;
        other.plant.restore(&state).map_err(InstanceError::State)?;
        Ok(other)
    }

    /// The scene that it was made from.
    #[must_use]
    pub fn blueprint(&self) -> &Blueprint {
        &self.blueprint
    }

    /// The settings as requested.
    #[must_use]
    pub fn settings(&self) -> &Settings {
        &self.settings
    }

    /// Parameters that were set, by their paths.
    #[must_use]
    pub fn set(&self) -> &BTreeMap<String, f64> {
        &self.set
    }

    /// The scene with the parameters applied.
    #[must_use]
    pub fn scene(&self) -> &Scene {
        &self.scene
    }

    /// The plant itself.
    #[must_use]
    pub fn plant(&self) -> &dyn AnyPlant {
        self.plant.as_ref()
    }

    /// The plant itself, for setting states of bodies.
    pub fn plant_mut(&mut self) -> &mut dyn AnyPlant {
        self.plant.as_mut()
    }

    /// \[s\] the present time.
    #[must_use]
    pub fn time(&self) -> f64 {
        self.plant.time()
    }

    /// \[s\] the step.
    #[must_use]
    pub fn step_size(&self) -> f64 {
        self.plant.step_size()
    }

    /// FNV-1a 64 over the state's words: that of `host-sim run` for the same bits.
    #[must_use]
    pub fn hash(&self) -> u64 {
        self.plant.hash()
    }

    /// The inputs, in scene order.
    #[must_use]
    pub fn inputs(&self) -> &[Input] {
        &self.inputs
    }

    /// The outputs: the columns of a trace except the time.
    #[must_use]
    pub fn outputs(&self) -> &[Output] {
        &self.outputs
    }

    /// Which of [`Self::inputs`] has a name.
    ///
    /// # Errors
    /// Where none has.
    pub fn input(&self, name: &str) -> Result<usize, InstanceError> {
        let names = || self.inputs.iter().map(|input| input.name.as_str());
        let found = names().position(|known| known == name);
        found.ok_or_else(|| self.unknown("input", name, names()))
    }

    /// Which of [`Self::outputs`] has a name.
    ///
    /// # Errors
    /// Where none has.
    pub fn output(&self, name: &str) -> Result<usize, InstanceError> {
        let names = || self.outputs.iter().map(|output| output.name.as_str());
        let found = names().position(|known| known == name);
        found.ok_or_else(|| self.unknown("output", name, names()))
    }

    pub(crate) fn unknown<'n>(
        &self,
        kind: &'static str,
        name: &str,
        known: impl Iterator<Item = &'n str>,
    ) -> InstanceError {
        let meant = nearest(name, known).map(str::to_owned);
        InstanceError::Unknown { scene: self.scene.name.clone(), kind, name: name.into(), meant }
    }

    /// Holds an input, given by its index in [`Self::inputs`], until it is set again.
    ///
    /// # Errors
    /// [`InstanceError::Input`] where the value is not finite in the precision, [`InstanceError::Unknown`]
    /// where there is no such input; nothing is changed then.
    pub fn set_input(&mut self, input: usize, value: f64) -> Result<(), InstanceError> {
        let Some(Input { name, index, is_rate, .. }) = self.inputs.get(input) else {
            return Err(self.unknown("input", &format!("number {input}"), std::iter::empty()));
        };
        let held = self.held(input);
        let [value_then, rate] = if *is_rate { [held[0], value] } else { [value, held[1]] };
        self.plant.set(*index, value_then, rate).map_err(|reason| InstanceError::Input {
            input: name.clone(),
            value,
            reason,
        })
    }

    /// The held value of an input; `None` if there is no such input.
    #[must_use]
    pub fn input_value(&self, input: usize) -> Option<f64> {
        let is_rate = self.inputs.get(input)?.is_rate;
        Some(self.held(input)[usize::from(is_rate)])
    }

    /// Value and rate of an input.
    fn held(&self, input: usize) -> [f64; 2] {
        let row = self.inputs.get(input).map(|input| usize::from(input.index.0));
        let state = self.plant.state();
        let signal = row.and_then(|row| state.signals.get(row));
        signal.map_or([0.0; 2], |signal| [signal.value, signal.rate])
    }

    /// The parameters: all numbers that the scene writes, by their paths, as they are now.
    ///
    /// # Errors
    /// None that making the instance has not shown.
    pub fn parameters(&self) -> Result<Vec<SceneNumber>, InstanceError> {
        Ok(self.scene.numbers()?)
    }

    /// Sets parameters by path and resets to t = 0. Inputs keep their held values.
    ///
    /// # Errors
    /// If a path is unknown, a value is not finite, or the scene is invalid with them; nothing is changed then.
    pub fn set_parameters<'p>(
        &mut self,
        parameters: impl IntoIterator<Item = (&'p str, f64)>,
    ) -> Result<(), InstanceError> {
        let mut set = self.set.clone();
        for (path, value) in parameters {
            if !value.is_finite() {
                return Err(InstanceError::Parameter { path: path.to_owned(), value });
            }
            set.insert(path.to_owned(), value);
        }
        let mut other = Self::with(self.blueprint.clone(), self.settings.clone(), set)?;
        for input in 0..self.inputs.len() {
            let value = self.held(input)[usize::from(self.inputs[input].is_rate)];
            other.set_input(input, value)?;
        }
        *self = other;
        Ok(())
    }

    /// Advances by the given number of steps with held inputs.
    ///
    /// # Errors
    /// [`InstanceError::Failed`] where a step fails or one has failed before.
    pub fn advance(&mut self, steps: u64) -> Result<(), InstanceError> {
        self.plant.advance(steps).map_err(|failure| InstanceError::Failed {
            what: dbd_scene::fault(&self.scene, &failure.cause),
            time: failure.step as f64 * self.step_size(),
            step: failure.step,
            step_size: self.step_size(),
        })
    }

    /// Advances to a time that is a whole number of steps, within a hundredth of a step.
    ///
    /// # Errors
    /// [`InstanceError::Multiple`], [`InstanceError::Past`]; nothing is changed then. [`InstanceError::Failed`].
    pub fn advance_to(&mut self, time: f64) -> Result<(), InstanceError> {
        let steps = self.steps_to(time)?;
        self.advance(steps)
    }

    /// How many steps lead to a time.
    ///
    /// # Errors
    /// [`InstanceError::Multiple`], [`InstanceError::Past`].
    pub fn steps_to(&self, time: f64) -> Result<u64, InstanceError> {
        let (step, now, done) = (self.step_size(), self.time(), self.plant.steps());
        let count = time / step;
        let whole = count.round();
        // Beyond 2⁵³ steps a time tells no step from the next.
        if !(count.is_finite() && whole < 9e15)
            || (whole as u64) < done && count < done as f64 - NEAR
        {
            return Err(InstanceError::Past { time, now });
        }
        if (count - whole).abs() > NEAR {
            let [before, after] = [count.floor(), count.ceil()].map(|steps| steps * step);
            return Err(InstanceError::Multiple { time, step, before, after });
        }
        Ok((whole as u64).saturating_sub(done))
    }

    /// Goes back to t = 0 with the parameters as they are; inputs have their first values.
    pub fn reset(&mut self) {
        self.plant.reset();
    }

    /// \[its unit\] the present value of an output, given by its index in [`Self::outputs`]; NaN if it is undefined or
    /// does not exist.
    #[must_use]
    pub fn value(&self, output: usize) -> f64 {
        let mut values = Vec::with_capacity(1);
        self.values_of(&[output], &mut values);
        values[0]
    }

    /// All outputs now, in order.
    #[must_use]
    pub fn values(&self) -> Vec<f64> {
        let all: Vec<usize> = (0..self.outputs.len()).collect();
        let mut values = Vec::with_capacity(all.len());
        self.values_of(&all, &mut values);
        values
    }

    /// Appends the present values of some outputs, given by their indices in [`Self::outputs`]; NaN if undefined or
    /// missing. Other outputs are not computed.
    pub fn values_of(&self, outputs: &[usize], values: &mut Vec<f64>) {
        let bodies = self.scene.body_names.len() * BODY_COLUMNS.len();
        let readings = bodies + ENERGY_COLUMNS.len();
        let asked = |range: std::ops::Range<usize>| outputs.iter().any(|row| range.contains(row));
        let state = asked(0..bodies).then(|| self.plant.state());
        let energy = asked(bodies..readings).then(|| self.plant.energy());
        let energy = energy.map(|all| [all.kinetic, all.potential(), all.total()]);
        let mut read = Vec::new();
        if asked(readings..self.outputs.len()) {
            for info in &self.scene.readouts {
                append(self.plant.read(&info.readout), info.columns.len(), &mut read);
            }
        }
        for &row in outputs {
            let value = if row < bodies {
                let body =
                    state.as_ref().and_then(|state| state.bodies.get(row / BODY_COLUMNS.len()));
                body.map(|body| {
                    let column = row % BODY_COLUMNS.len();
                    match column {
                        0..3 => body.position.to_f64()[column],
                        3..7 => body.orientation.to_f64()[column - 3],
                        7..10 => body.velocity.to_f64()[column - 7],
                        _ => body.angular_velocity.to_f64()[column - 10],
                    }
                })
            } else if row < readings {
                energy.map(|energy| energy[row - bodies])
            } else {
                read.get(row - readings).copied()
            };
            values.push(value.unwrap_or(f64::NAN));
        }
    }
}
