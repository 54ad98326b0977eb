//! Request of a session: a scene, its settings, changed numbers, a hand on a body.

use std::collections::BTreeMap;

use dbd_plant::instance::{Blueprint, Instance, InstanceError, Settings};

use crate::refused::Refused;

/// Changed values by path.
pub type Set = BTreeMap<String, f64>;

/// A scene and its settings.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct Change {
    /// Name of the text in messages.
    pub file: String,
    /// The scene in TOML.
    pub text: String,
    /// Scheme, damping, precision, step; the default is the scene's value or that of `run`.
    pub settings: Settings,
    /// Changed numbers of the scene, by path.
    pub set: Set,
}

impl Change {
    pub(super) fn instance(&self) -> Result<Instance, Refused> {
        if let Some((path, value)) = self.set.iter().find(|(_, value)| !value.is_finite()) {
            return Err(Refused::new(
                format!("the parameter `{path}` cannot be set to {value:?}"),
                "give a finite number",
            ));
        }
        let changes = self.set.iter().map(|(path, value)| format!("{path}={value:?}"));
        let blueprint = Blueprint {
            file: self.file.clone(),
            text: self.text.as_str().into(),
            changes: changes.collect(),
        };
        Instance::new(blueprint, self.settings.clone()).map_err(|error| {
            // The position of an error in a change is not a position in the scene's text.
            let in_text =
                !matches!(&error, InstanceError::Scene(error) if error.file() != self.file);
            let refused = Refused::from(error);
            if in_text { refused } else { Refused { line: None, column: None, ..refused } }
        })
    }
}

/// A hand at a body.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Grab {
    /// Its row.
    pub body: usize,
    /// \[m\] the held point, body axes.
    pub point: [f64; 3],
    /// \[m\] the target, world axes.
    pub target: [f64; 3],
    /// \[1\] simulated time per real time.
    pub speed: f64,
}
