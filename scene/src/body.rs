//! `[[body]]`: mass, principal inertia and state at t = 0.
//!
//! `table => body in the assembly`.

use dbd_kernel::{Body, BodyState, F64};

use crate::assembly::{Assembly, WORLD};
use crate::error::SceneError;
use crate::names::Names;
use crate::orientation::Orientation;
use crate::text::{Number, Numbers, Table, Value};

const KEYS: &[&str] =
    &["name", "mass", "inertia", "position", "orientation", "velocity", "angular_velocity"];

/// Relative slack of the triangle inequality: an inertia computed for a thin plate meets it with
/// equality but for rounding.
const TRIANGLE_SLACK: f64 = 1e-9;

/// Reads all bodies in scene order.
pub(crate) fn read_all(root: &Table<'_>, assembly: &mut Assembly) -> Result<(), SceneError> {
    let tables = root.list("body")?;
    if tables.is_empty() {
        let help = "a scene has at least one [[body]] with a name, a mass and an inertia";
        return Err(match root.value("body") {
            Some(value) => value.refuse_with("holds no body", help),
            None => root.refuse("has no bodies", help),
        });
    }
    let mut names = Names::default();
    for table in tables {
        table.only(&[KEYS])?;
        let name = names.read(&table, "body", ())?;
        if name == WORLD {
            let help = "the world is there without being declared; a body has another name";
            return Err(table.refuse_value("name", "is \"world\"", help));
        }
        let (body, state) = read(&table)?;
        assembly.add_body(&name, body, state).map_err(|defect| defect.refuse(&table))?;
    }
    Ok(())
}

fn read(table: &Table<'_>) -> Result<(Body<f64>, BodyState<F64>), SceneError> {
    let body = mass_and_inertia(table)?;
    let position = table.required("position", Numbers(Number::any("m")))?;
    let orientation = table.optional("orientation", Orientation)?.unwrap_or([1.0, 0.0, 0.0, 0.0]);
    let velocity = table.optional("velocity", Numbers(Number::any("m/s")))?.unwrap_or_default();
    let angular_velocity =
        table.optional("angular_velocity", Numbers(Number::any("rad/s")))?.unwrap_or_default();
    let state = BodyState::from_f64(position, orientation, velocity, angular_velocity);
    Ok((body, state))
}

/// Reads `mass` and `inertia`.
pub(crate) fn mass_and_inertia(table: &Table<'_>) -> Result<Body<f64>, SceneError> {
    let mass = table.required("mass", Number::positive("kg"))?;
    let inertia = table.required("inertia", Numbers(Number::positive("kg·m²")))?;
    if let Some(value) = table.value("inertia") {
        refuse_impossible(&value, inertia)?;
    }
    Ok(Body::from_f64(mass, inertia))
}

/// Refuses an inertia that no distribution of mass has: one moment above the sum of the others.
fn refuse_impossible(value: &Value<'_>, inertia: [f64; 3]) -> Result<(), SceneError> {
    let [x, y, z] = inertia;
    for (name, one, others, sum) in
        [("Ix", x, "Iy + Iz", y + z), ("Iy", y, "Ix + Iz", x + z), ("Iz", z, "Ix + Iy", x + y)]
    {
        if one > sum * (1.0 + TRIANGLE_SLACK) {
            let problem = format!("breaks the triangle inequality: {name} = {one:?} > {sum:?}");
            let help = format!(
                "{name} ≤ {others}, and likewise for the others: principal moments of a rigid \
                 body about its centre of mass"
            );
            return Err(value.refuse_with(&problem, help));
        }
    }
    Ok(())
}
