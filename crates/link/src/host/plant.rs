//! A scene's plant of any method as a device.

use dbd_kernel::readouts::Readout;
use dbd_kernel::{F64, InputIndex};
use dbd_plant::readings::append;
use dbd_plant::{AnyPlant, Method};
use dbd_scene::Scene;
use thiserror::Error;

use crate::device::{Device, cut};
use crate::message::{Identity, MAX_VALUES, Values};

/// A scene's plant.
pub struct HostPlant {
    plant: Box<dyn AnyPlant>,
    scene: String,
    /// Whether sensors are read in a plane other than a world plane: the bits of their values then differ from
    /// firmware.
    turned: bool,
    inputs: Vec<InputIndex>,
    sensors: Vec<(Readout<F64>, usize)>,
    input_names: Vec<String>,
    names: Vec<String>,
}

/// A scene has more inputs or sensor values than a frame carries.
#[derive(Clone, Debug, PartialEq, Eq, Error)]
#[error("the scene has {count} {what}; a frame carries at most {}", MAX_VALUES - 1)]
pub struct TooMany {
    count: usize,
    what: &'static str,
}

impl HostPlant {
    /// The plant of a scene, stepped by `plant`: its inputs are those not driven by a table of the scene, its sensors
    /// all read-outs, both in the scene's order.
    ///
    /// # Errors
    /// [`TooMany`].
    pub fn new(scene: &Scene, plant: Box<dyn AnyPlant>) -> Result<Self, TooMany> {
        let free = || scene.inputs.iter().filter(|input| !input.table);
        let columns = |info: &dbd_scene::ReadoutInfo| info.columns.len();
        let own = Self {
            plant,
            scene: scene.name.clone(),
            turned: scene.planar.is_some(),
            inputs: free().map(|input| input.index).collect(),
            sensors: scene.readouts.iter().map(|info| (info.readout, columns(info))).collect(),
            input_names: free().map(|input| input.name.clone()).collect(),
            names: (scene.readouts.iter())
                .flat_map(|info| {
                    info.columns.iter().map(move |(part, _)| format!("{}{part}", info.name))
                })
                .collect(),
        };
        for (what, count) in [("inputs", own.inputs.len()), ("sensor values", own.names.len())] {
            if count >= MAX_VALUES {
                return Err(TooMany { count, what });
            }
        }
        Ok(own)
    }

    /// The names of the inputs, in order.
    #[must_use]
    pub fn inputs(&self) -> &[String] {
        &self.input_names
    }

    /// The names of the sensor values, in order.
    #[must_use]
    pub fn sensors(&self) -> &[String] {
        &self.names
    }

    /// The method.
    #[must_use]
    pub fn method(&self) -> &Method {
        self.plant.method()
    }

    /// \[s\] the step.
    #[must_use]
    pub fn step_size(&self) -> f64 {
        self.plant.step_size()
    }

    /// Whether the values of its sensors are bit-identical to those of firmware, as the hash of the state always is.
    #[must_use]
    pub fn compares_values(&self) -> bool {
        !self.turned
    }

    /// The plant.
    #[must_use]
    pub fn plant(&self) -> &dyn AnyPlant {
        self.plant.as_ref()
    }
}

impl Device for HostPlant {
    fn identity(&self) -> Identity {
        let [inputs, outputs] = [self.inputs.len(), self.names.len()].map(|count| count as u8);
        Identity {
            scene: cut(&self.scene),
            scheme: cut(self.plant.method().scheme_name()),
            precision: cut(self.plant.method().precision_name()),
            step: self.plant.step_size(),
            inputs,
            outputs,
            ..Identity::default()
        }
    }

    fn set(&mut self, input: usize, value: f64) -> bool {
        let input = self.inputs.get(input);
        input.is_some_and(|input| self.plant.set(*input, value, 0.0).is_ok())
    }

    fn input(&self, input: usize) -> f64 {
        let index = self.inputs.get(input).map(|input| usize::from(input.0));
        let state = self.plant.state();
        index.and_then(|index| state.signals.get(index)).map_or(0.0, |signal| signal.value)
    }

    fn advance(&mut self, steps: u32) {
        // A failure latches, and `running` shows it.
        let _ = self.plant.advance(u64::from(steps));
    }

    fn step(&self) -> u64 {
        self.plant.steps()
    }

    fn running(&self) -> bool {
        self.plant.status().is_ok()
    }

    fn hash(&self) -> u64 {
        self.plant.hash()
    }

    fn read(&self, values: &mut Values) {
        let mut all = Vec::with_capacity(self.names.len());
        for (readout, columns) in &self.sensors {
            append(self.plant.read(readout), *columns, &mut all);
        }
        // `new` has counted them.
        _ = values.extend_from_slice(&all);
    }

    fn save(&self, buffer: &mut [u8]) -> Option<usize> {
        let bytes = self.plant.snapshot().ok()?;
        buffer.get_mut(..bytes.len())?.copy_from_slice(&bytes);
        Some(bytes.len())
    }

    fn restore(&mut self, bytes: &[u8]) -> bool {
        self.plant.restore(bytes).is_ok()
    }
}
