//! Inputs and outputs, their names and units.
//!
//! `scene => inputs, outputs in order`. The outputs are the columns of a trace except the time.

use dbd_kernel::InputIndex;
use dbd_scene::{BODY_COLUMNS, ENERGY_COLUMNS, Scene};

/// An input set by the caller. Inputs driven by a table of the scene are excluded.
#[derive(Clone, Debug, PartialEq)]
pub struct Input {
    /// Its name in the scene; the rate of an anchor or of a drive's position has the suffix `.rate`.
    pub name: String,
    /// The SI unit.
    pub unit: &'static str,
    /// Its type in the scene, `joint_torque`.
    pub kind: &'static str,
    /// \[`unit`\] value at t = 0.
    pub start: f64,
    /// \[`unit`\] smallest and largest accepted value; infinite without bounds.
    pub range: [f64; 2],
    /// Index in the model.
    pub(crate) index: InputIndex,
    /// Whether it is the rate of the displacement, which dampers and servos follow.
    pub(crate) is_rate: bool,
}

/// An output of an instance.
#[derive(Clone, Debug, PartialEq)]
pub struct Output {
    /// The column's name in a trace.
    pub name: String,
    /// The SI unit; empty for a plain number.
    pub unit: &'static str,
    /// Short description.
    pub description: String,
}

/// Columns of a body: descriptions and units.
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

/// Descriptions of the energies.
const ENERGY: [&str; ENERGY_COLUMNS.len()] =
    ["kinetic energy", "potential energy, gravity and springs", "kinetic and potential energy"];

/// The inputs of a scene that a caller sets, with their values at t = 0.
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
        if ["anchor", "free_length"].contains(&info.kind) || is_place {
            inputs.push(rated);
        }
    }
    inputs
}

/// The outputs of a scene: bodies, energies, sensors.
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
            let description = format!("sensor of type {}", readout.kind);
            outputs.push(Output { name, unit, description });
        }
    }
    outputs
}
