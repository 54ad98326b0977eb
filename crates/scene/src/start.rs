//! `[start.BODY]`: the state of a body at t = 0 where it differs from the one at which the joints are assembled.
//!
//! `tables => initial states`. Joints, free lengths and angles are those of the poses of `[[body]]`. A body with a
//! table here starts without the velocities that `[[body]]` gives it.

use dbd_kernel::{BodyIndex, BodyState, F64, Quaternion, Vec3};

use crate::assembly::Assembly;
use crate::error::SceneError;
use crate::orientation::Orientation;
use crate::text::{Number, Numbers, Table};

/// The keys of a body's table.
pub(crate) const KEYS: &[&str] = &["position", "orientation", "velocity", "angular_velocity"];

/// The states at t = 0 that a scene gives, with their bodies' rows.
pub(crate) fn read(
    root: &Table<'_>,
    assembly: &Assembly,
) -> Result<Vec<(usize, BodyState<F64>)>, SceneError> {
    let Some(value) = root.value("start") else { return Ok(Vec::new()) };
    let start = value.table("tables of states by body: [start.NAME]")?.called("[start]");
    let mut states = Vec::new();
    for (_, name, value) in start.values() {
        let Some(row) = assembly.body_names().iter().position(|known| known == name) else {
            let help = "the name of a body, spiders as `JOINT.spider`, in quotes where it has a space or a point";
            return Err(start.refuse_key(name, "is no body of the scene", help));
        };
        let table = value.table("a table of a state")?.called(&format!("[start.{name}]"));
        table.only(&[KEYS])?;
        let body = BodyIndex(row as u16);
        let given = assembly.states()[row];
        let position = table.optional("position", Numbers(Number::any("m")))?;
        let velocity = table.optional("velocity", Numbers(Number::any("m/s")))?;
        let spin = table.optional("angular_velocity", Numbers(Number::any("rad/s")))?;
        let orientation = table.optional("orientation", Orientation)?;
        states.push((
            row,
            BodyState {
                position: position.map_or(given.position, Vec3::from_f64),
                orientation: orientation.map_or(given.orientation, |written| {
                    Quaternion::from_f64(assembly.orientation_of_written(body, written))
                }),
                velocity: Vec3::from_f64(velocity.unwrap_or_default()),
                angular_velocity: assembly
                    .of_written(body, Vec3::from_f64(spin.unwrap_or_default())),
            },
        ));
    }
    Ok(states)
}
