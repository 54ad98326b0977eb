//! What is asked of a session: a scene, how it is stepped, numbers given otherwise, a hand on a body.

use std::collections::BTreeMap;

use dbd_plant::instance::{Blueprint, Instance, InstanceError, Settings};

use crate::refused::Refused;

/// What was set, by path.
pub type Set = BTreeMap<String, f64>;

/// A scene and how it is stepped.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct Change {
    /// What messages call the text.
    pub file: String,
    /// The scene in TOML.
    pub text: String,
    /// Scheme, damping, precision, step; what is not said is the scene's, or `run`'s.
    pub settings: Settings,
    /// Numbers of the scene given otherwise, by their paths.
    pub set: Set,
}

impl Change {
    pub(super) fn instance(&self) -> Result<Instance, Refused> {
        if let Some((path, value)) = self.set.iter().find(|(_, value)| !value.is_finite()) {
            return Err(Refused::new(
                format!("the parameter `{path}` cannot be {value:?}"),
                "a finite number",
            ));
        }
        let changes = self.set.iter().map(|(path, value)| format!("{path}={value:?}"));
        let blueprint = Blueprint {
            file: self.file.clone(),
            text: self.text.as_str().into(),
            changes: changes.collect(),
        };
        Instance::new(blueprint, self.settings.clone()).map_err(|error| {
            // The place of an error in a change is not a place in the scene's text.
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
    /// \[m\] the point that is held, body axes.
    pub point: [f64; 3],
    /// \[m\] where it is pulled to, world.
    pub target: [f64; 3],
    /// \[1\] simulated time per time that is watched.
    pub speed: f64,
}
