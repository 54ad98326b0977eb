//! What tables of laws have in common: names of inputs and joints, constants by field, modes of drives.

use crate::error::SceneError;
use crate::nearest::nearest;
use crate::shortened::shortened;
use crate::text::{Kind, Value};

/// Constants of a law by field; the others have the defaults of the law.
#[derive(Default)]
pub(super) struct Constants(Vec<(&'static str, f64)>);

impl Constants {
    pub(super) fn add(&mut self, field: &'static str, number: f64) {
        self.0.push((field, number));
    }

    /// The constant of a field.
    pub(super) fn get(&self, field: &str) -> Option<f64> {
        self.0.iter().find(|(known, _)| *known == field).map(|(_, number)| *number)
    }
}

/// The quantity of the input of a drive.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(super) enum Mode {
    Position,
    Velocity,
    Torque,
    Current,
    Voltage,
}

impl Mode {
    pub(super) const ALL: [Self; 5] =
        [Self::Position, Self::Velocity, Self::Torque, Self::Current, Self::Voltage];
    pub(super) const TURN: [&str; 5] = ["position", "velocity", "torque", "current", "voltage"];
    pub(super) const TRAVEL: [&str; 5] = ["position", "velocity", "force", "current", "voltage"];

    pub(super) fn is_wound(self) -> bool {
        matches!(self, Self::Current | Self::Voltage)
    }

    pub(super) fn is_servo(self) -> bool {
        matches!(self, Self::Position | Self::Velocity)
    }
}

/// The name of an input.
pub(super) struct InputName<'a>(pub(super) &'a [String]);

impl Kind for InputName<'_> {
    type Output = u32;

    fn expected(&self) -> String {
        "the name of an input".into()
    }

    fn read(&self, value: &Value<'_>) -> Result<u32, SceneError> {
        let name = value.get().as_str().ok_or_else(|| value.wrong_type(&self.expected()))?;
        let row = self.0.iter().position(|known| known == name);
        row.and_then(|row| u32::try_from(row).ok()).ok_or_else(|| {
            let help = match nearest(name, self.0.iter().map(String::as_str)) {
                Some(meant) => format!("did you mean \"{meant}\"?"),
                None => "name an input of the type \"signal\" or of another type".into(),
            };
            value.refuse_with(&format!("names no input: \"{}\"", shortened(name)), help)
        })
    }
}

/// The name of a joint.
pub(super) struct JointName<'a>(pub(super) &'a [(String, usize)]);

impl Kind for JointName<'_> {
    type Output = usize;

    fn expected(&self) -> String {
        "the name of a joint".into()
    }

    fn read(&self, value: &Value<'_>) -> Result<usize, SceneError> {
        let name = value.get().as_str().ok_or_else(|| value.wrong_type(&self.expected()))?;
        let group = self.0.iter().find(|(known, _)| known == name).map(|(_, group)| *group);
        group.ok_or_else(|| {
            let help = match nearest(name, self.0.iter().map(|(known, _)| known.as_str())) {
                Some(meant) => format!("did you mean \"{meant}\"?"),
                None => "name a joint between the two bodies".into(),
            };
            value.refuse_with(&format!("names no joint: \"{}\"", shortened(name)), help)
        })
    }
}
