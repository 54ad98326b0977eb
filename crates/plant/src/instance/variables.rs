//! Inputs and outputs, their names and units.
//!
//! `scene => inputs, outputs in order`. The outputs are the columns of a trace but the time.

use dbd_kernel::index::InputIndex;
use dbd_scene::{BODY_COLUMNS, ENERGY_COLUMNS, Scene};

/// What a caller drives. Inputs that a table of the scene drives are none.
#[derive(Clone, Debug, PartialEq)]
pub struct Input {
    /// Its name in the scene; that of the rate of an anchor or of a drive's place has `.rate` behind it.
    pub name: String,
    /// The SI unit.
    pub unit: &'static str,
    /// Its type in the scene, `joint_torque`.
    pub kind: &'static str,
    /// \[`unit`\] what it is at t = 0.
    pub start: f64,
    /// \[`unit`\] the least and the largest value that it takes; infinite without bounds.
    pub range: [f64; 2],
    /// In the model.
    pub(crate) index: InputIndex,
    /// Whether it is the rate of the displacement, which dampers and servos follow.
    pub(crate) is_rate: bool,
}

/// What an instance shows.
#[derive(Clone, Debug, PartialEq)]
pub struct Output {
    /// The column's name in a trace.
    pub name: String,
    /// The SI unit; empty for a plain number.
    pub unit: &'static str,
    /// What it is, in a few words.
    pub description: String,
}

/// Columns of a body: what they are, and their units.
const BODY: [(&str, &str); BODY_COLUMNS.len()] = [
    ("position of the centre of mass in the world, x", "m"),
    ("position of the centre of mass in the world, y", "m"),
    ("position of the centre of mass in the world, z", "m"),
    ("orientation, body to world, unit quaternion, scalar part", ""),
    ("orientation, body to world, unit quaternion, x", ""),
    ("orientation, body to world, unit quaternion, y", ""),
    ("orientation, body to world, unit quaternion, z", ""),
    ("velocity of the centre of mass in the world, x", "m/s"),
    ("velocity of the centre of mass in the world, y", "m/s"),
    ("velocity of the centre of mass in the world, z", "m/s"),
    ("angular velocity in principal axes, x", "rad/s"),
    ("angular velocity in principal axes, y", "rad/s"),
    ("angular velocity in principal axes, z", "rad/s"),
];

/// Likewise of the energies.
const ENERGY: [&str; ENERGY_COLUMNS.len()] =
    ["kinetic energy", "potential energy, gravity and springs", "kinetic and potential energy"];

/// The inputs of a scene that a caller drives, with what they are at t = 0.
pub(crate) fn inputs(scene: &Scene, start: impl Fn(InputIndex) -> [f64; 2]) -> Vec<Input> {
    let mut inputs = Vec::new();
    for info in scene.inputs.iter().filter(|info| !info.table) {
        let [value, rate] = start(info.index);
        let input = Input {
            name: info.name.clone(),
            unit: info.unit,
            kind: info.kind,
            start: value,
            range: info.range,
            index: info.index,
            is_rate: false,
        };
        let name = format!("{}.rate", info.name);
        let range = [f64::NEG_INFINITY, f64::INFINITY];
        let unit = if info.unit == "rad" { "rad/s" } else { "m/s" };
        let rated = Input { name, unit, start: rate, range, is_rate: true, ..input.clone() };
        inputs.push(input);
        let is_place = info.kind == "drive" && ["rad", "m"].contains(&info.unit);
        if info.kind == "anchor" || is_place {
            inputs.push(rated);
        }
    }
    inputs
}

/// The outputs of a scene: bodies, energies, read-outs.
pub(crate) fn outputs(scene: &Scene) -> Vec<Output> {
    let mut outputs = Vec::new();
    for body in &scene.body_names {
        for (column, (what, unit)) in BODY_COLUMNS.iter().zip(BODY) {
            let (name, description) = (format!("{body}{column}"), format!("{body}: {what}"));
            outputs.push(Output { name, unit, description });
        }
    }
    for (name, what) in ENERGY_COLUMNS.iter().zip(ENERGY) {
        outputs.push(Output { name: (*name).into(), unit: "J", description: what.into() });
    }
    for readout in &scene.readouts {
        for (column, unit) in &readout.columns {
            let name = format!("{}{column}", readout.name);
            let description = format!("read-out of the type {}", readout.kind);
            outputs.push(Output { name, unit, description });
        }
    }
    outputs
}
