//! An instance for FMI: modes, value references, absolute time.
//!
//! `(variables set, communication steps) => variables got`. Parameters are applied when needed, at the latest at the
//! end of initialisation, so that the plant is rebuilt once.

use std::collections::BTreeMap;
use std::path::Path;

use dbd_plant::instance::NEAR;
use dbd_plant::instance::linearisation::Probe;
use dbd_plant::instance::{Instance, InstanceError};
use dbd_scene::time::{display, rounded};

use crate::description::{Description, Role};
use crate::resource::Resource;
use crate::token::token;
use crate::xml::Fmi;

/// The mode of a component.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Mode {
    /// Instantiated, or reset.
    Instantiated,
    /// Initialisation has begun.
    Initializing,
    /// It can step.
    Stepping,
    /// It can be reset.
    Terminated,
}

/// Why a call failed. Never `Discard`: importers repeat a discarded step from the last successful time, indefinitely if
/// that has not advanced.
#[derive(Clone, Debug, PartialEq, Eq)]
pub enum Refusal {
    /// An invalid call, or a failure.
    Error(String),
}

impl Refusal {
    /// An error with a message.
    pub(crate) fn error(text: impl Into<String>) -> Self {
        Self::Error(text.into())
    }
}

impl From<InstanceError> for Refusal {
    fn from(error: InstanceError) -> Self {
        Self::Error(error.sentence())
    }
}

/// An instance with value references.
pub struct Component {
    pub(crate) resource: Resource,
    pub(crate) description: Description,
    pub(crate) token: String,
    pub(crate) instance: Instance,
    pub(crate) mode: Mode,
    /// \[s\] the importer's time at the plant's t = 0.
    pub(crate) start_time: f64,
    /// Parameters set so far, by value reference.
    pub(crate) set: BTreeMap<u32, f64>,
    /// Whether some are not applied to the plant yet.
    pub(crate) is_waiting: bool,
    /// The plant's parameters, by path.
    pub(crate) parameters: BTreeMap<String, f64>,
    /// The plant in double precision for derivatives, with the present parameters.
    pub(crate) probe: Option<Probe>,
}

impl Component {
    /// Loads a component from an FMU's resources.
    ///
    /// # Errors
    /// The log message: resources are missing or damaged, the scene is refused, or the token does not match.
    pub fn new(folder: &Path, fmi: Fmi, token_asked: &str) -> Result<Self, String> {
        let resource = Resource::read(folder).map_err(|error| error.to_string())?;
        let Resource { blueprint, settings } = resource.clone();
        let made = Instance::new(blueprint, settings);
        let instance = made.map_err(|error| error.sentence())?;
        let description = Description::of(&instance).map_err(|error| error.sentence())?;
        let token = token(&description, &resource, fmi);
        if token != token_asked {
            return Err(format!(
                "the token {token_asked} does not match these resources, {token}; make a new FMU with host-sim \
                 fmu and do not change it afterwards"
            ));
        }
        let mut component = Self {
            resource,
            description,
            token,
            instance,
            mode: Mode::Instantiated,
            start_time: 0.0,
            set: BTreeMap::new(),
            is_waiting: false,
            parameters: BTreeMap::new(),
            probe: None,
        };
        component.note_parameters().map_err(|error| error.sentence())?;
        Ok(component)
    }

    /// Reads the parameters, some of which may depend on others.
    pub(crate) fn note_parameters(&mut self) -> Result<(), InstanceError> {
        self.probe = None;
        let numbers = self.instance.parameters()?;
        self.parameters = numbers.into_iter().map(|number| (number.path, number.value)).collect();
        Ok(())
    }

    /// \[s\] the importer's time.
    #[must_use]
    pub fn time(&self) -> f64 {
        self.start_time + self.instance.time()
    }

    /// Its mode.
    #[must_use]
    pub fn mode(&self) -> Mode {
        self.mode
    }

    pub(crate) fn role(&self, reference: u32) -> Result<&Role, Refusal> {
        let variable = self.description.variables.get(reference as usize);
        variable.map(|variable| &variable.role).ok_or_else(|| {
            Refusal::Error(format!(
                "no variable with the value reference {reference}; the largest is {}",
                self.description.variables.len() - 1
            ))
        })
    }

    pub(crate) fn expect(&self, modes: &[Mode]) -> Result<(), Refusal> {
        if modes.contains(&self.mode) {
            return Ok(());
        }
        let is = match self.mode {
            Mode::Instantiated => "not initialised yet",
            Mode::Initializing => "in initialisation mode",
            Mode::Stepping => "already initialised",
            Mode::Terminated => "terminated",
        };
        Err(Refusal::Error(format!("call out of order: the FMU is {is}")))
    }

    /// Present values of variables, in the requested order.
    ///
    /// # Errors
    /// An unknown value reference, or refused parameters.
    pub fn get(&mut self, references: &[u32]) -> Result<Vec<f64>, Refusal> {
        let mut outputs = Vec::new();
        for reference in references {
            if let Role::Output(place, _) = self.role(*reference)? {
                outputs.push(*place);
            }
        }
        let mut values = Vec::with_capacity(outputs.len());
        if !outputs.is_empty() {
            self.settle()?;
            self.instance.values_of(&outputs, &mut values);
        }
        let mut values = values.into_iter();
        references
            .iter()
            .map(|reference| {
                Ok(match self.role(*reference)? {
                    Role::Time => self.time(),
                    Role::Input(place) => self.instance.input_value(*place).unwrap_or(f64::NAN),
                    Role::Output(..) => values.next().unwrap_or(f64::NAN),
                    Role::Parameter(path) => {
                        let waiting = self.set.get(reference).filter(|_| self.is_waiting);
                        *waiting.or_else(|| self.parameters.get(path)).unwrap_or(&f64::NAN)
                    }
                })
            })
            .collect()
    }

    /// Sets inputs, and parameters before initialisation has ended.
    ///
    /// # Errors
    /// A variable that cannot be set, or not to this value; those before it are set.
    pub fn set(&mut self, references: &[u32], values: &[f64]) -> Result<(), Refusal> {
        self.expect(&[Mode::Instantiated, Mode::Initializing, Mode::Stepping])?;
        for (&reference, &value) in references.iter().zip(values) {
            let name = |this: &Self| this.description.variables[reference as usize].name.clone();
            match self.role(reference)?.clone() {
                Role::Input(place) => self.instance.set_input(place, value)?,
                Role::Parameter(_) if self.mode == Mode::Stepping => {
                    return Err(Refusal::Error(format!(
                        "the parameter {} is fixed once initialisation has ended; reset to set it",
                        name(self)
                    )));
                }
                Role::Parameter(path) if !value.is_finite() => {
                    return Err(InstanceError::Parameter { path, value }.into());
                }
                Role::Parameter(_) => {
                    self.set.insert(reference, value);
                    self.is_waiting = true;
                }
                Role::Time | Role::Output(..) => {
                    return Err(Refusal::Error(format!("{} is computed, not set", name(self))));
                }
            }
        }
        Ok(())
    }

    /// Applies pending parameters to the plant.
    pub(crate) fn settle(&mut self) -> Result<(), Refusal> {
        if !self.is_waiting {
            return Ok(());
        }
        let mut set = Vec::new();
        for (reference, value) in &self.set {
            if let Role::Parameter(path) = self.role(*reference)? {
                set.push((path.clone(), *value));
            }
        }
        self.instance.set_parameters(set.iter().map(|(path, value)| (path.as_str(), *value)))?;
        self.is_waiting = false;
        Ok(self.note_parameters()?)
    }

    /// Sets the start time.
    ///
    /// # Errors
    /// Out of order, or a time that is not finite.
    pub fn setup(&mut self, start_time: f64) -> Result<(), Refusal> {
        self.expect(&[Mode::Instantiated])?;
        if !start_time.is_finite() {
            return Err(Refusal::Error(format!("start time {start_time:?} s is not finite")));
        }
        self.start_time = start_time;
        Ok(())
    }

    /// Enters initialisation.
    ///
    /// # Errors
    /// Out of order.
    pub fn enter_initialization(&mut self) -> Result<(), Refusal> {
        self.expect(&[Mode::Instantiated])?;
        self.mode = Mode::Initializing;
        Ok(())
    }

    /// Exits initialisation: parameters are fixed from now on.
    ///
    /// # Errors
    /// Out of order, or refused parameters; it remains in initialisation then.
    pub fn exit_initialization(&mut self) -> Result<(), Refusal> {
        self.expect(&[Mode::Initializing])?;
        self.settle()?;
        self.mode = Mode::Stepping;
        Ok(())
    }

    /// Performs a communication step from the communication point.
    ///
    /// # Errors
    /// If it is not a multiple of the plant's step, the point differs from the plant's time, or a step fails. Nothing
    /// is changed except in the last case.
    pub fn step(&mut self, point: f64, size: f64) -> Result<(), Refusal> {
        self.expect(&[Mode::Stepping])?;
        let now = self.time();
        if !(point.is_finite() && size.is_finite() && size >= 0.0) {
            return Err(Refusal::Error(format!(
                "invalid communication step of {size:?} s from {point:?} s"
            )));
        }
        if (point - now).abs() > NEAR * self.instance.step_size() {
            return Err(Refusal::Error(format!(
                "the communication point is {point:?} s, but the plant is at {now:?} s; restore a saved state to \
                 go back"
            )));
        }
        self.instance.advance_to(point + size - self.start_time).map_err(|error| match error {
            InstanceError::Multiple { step, .. } => Refusal::Error(no_multiple(size, step)),
            other => other.into(),
        })
    }

    /// Ends the run.
    ///
    /// # Errors
    /// Out of order.
    pub fn terminate(&mut self) -> Result<(), Refusal> {
        self.expect(&[Mode::Initializing, Mode::Stepping])?;
        self.mode = Mode::Terminated;
        Ok(())
    }

    /// Resets it to its initial state.
    ///
    /// # Errors
    /// Only those that instantiation would have reported.
    pub fn reset(&mut self) -> Result<(), Refusal> {
        let Resource { blueprint, settings } = self.resource.clone();
        self.instance = Instance::new(blueprint, settings)?;
        (self.mode, self.start_time) = (Mode::Instantiated, 0.0);
        self.set.clear();
        self.is_waiting = false;
        Ok(self.note_parameters()?)
    }
}

/// The message for a communication step that is not a multiple of the plant's step, with both remedies.
fn no_multiple(size: f64, step: f64) -> String {
    let steps = size / step;
    let seconds = |time| rounded(time, 12).to_string();
    let nearest = [steps.floor(), steps.ceil()].map(|count| count * step);
    let fitting: Vec<String> =
        nearest.into_iter().filter(|time| *time > 0.0).map(seconds).collect();
    format!(
        "a communication step of {size:?} s is not a multiple of the plant's step of {}; set the importer's \
         communication step (output interval) to {} s, or make the FMU with a step that divides it: \
         host-sim fmu --step {}",
        display(step),
        fitting.join(" s or "),
        seconds(size / steps.ceil()),
    )
}
