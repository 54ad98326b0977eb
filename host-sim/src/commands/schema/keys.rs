//! Meaning and type of each key of a scene, as shown by editors.
//!
//! `(table, key) => schema with description and default`. The keys come from the reader, [`dbd_scene::vocabulary`].

use dbd_scene::vocabulary::TableKeys;
use serde_json::{Value, json};

use super::elements::{
    of_geometry, of_input, of_joint, of_line, of_load, of_readout, of_spring, realisation,
};
use super::elements::{of_torsion, of_tsda};
use super::inner::{self, of_coupling, orientation, within};
use super::interactions;
use super::values::Range::{Any, Positive};
use super::values::{Key, any, array, name, number, numbers, place};

/// The schema of a key; `None` of one that it does not know.
pub(super) fn schema(table: &str, key: &str, tables: &[TableKeys]) -> Option<Value> {
    let found = match table {
        "scene" => of_scene(key),
        "assemble" => of_assemble(key, tables),
        "body" => of_body(key, tables),
        "start" => of_start(key, tables),
        "joint" => of_joint(key, tables).or_else(|| of_spring(key, tables)),
        "tsda" => of_tsda(key, tables).or_else(|| of_spring(key, tables)),
        "point_on_line" => of_line(key).or_else(|| of_spring(key, tables)),
        "torsion_spring" => of_torsion(key, tables).or_else(|| of_spring(key, tables)),
        "interaction" => return interactions::schema(key),
        "coupling" => of_coupling(key, tables),
        "load" => of_load(key),
        "input" => of_input(key, tables),
        "readout" => of_readout(key, tables),
        "geometry" => of_geometry(key, tables),
        _ => return inner::schema(table, key, tables),
    };
    found.map(Key::schema)
}

fn of_scene(key: &str) -> Option<Key> {
    Some(match key {
        "name" => Key(name(), "The scene's name", ""),
        "description" => Key(json!({ "type": "string" }), "Free text", "empty"),
        "gravity" => Key(numbers(3, Any), "[x, y, z] m/s², world: the field of gravity", "none"),
        "duration" => Key(number(Positive), "s, > 0: simulated time, as 0.5 or \"500 ms\"", ""),
        "step" => Key(number(Positive), "s, > 0: the step, as \"20us\"", "chosen by the run"),
        "every" => Key(number(Positive), "s, > 0: time between samples", "chosen by the run"),
        "realisation" => realisation(),
        "planar" => Key(
            json!({ "type": "boolean" }),
            "Whether it runs in its plane, with three degrees of freedom per body; an error if the scene is not planar",
            "false",
        ),
        "settle" => Key(
            json!({ "type": "boolean" }),
            "Whether it starts at rest in the static equilibrium reached from its poses at decreasing potential energy",
            "false",
        ),
        _ => return None,
    })
}

fn of_start(key: &str, tables: &[TableKeys]) -> Option<Key> {
    let is_rate = ["velocity", "angular_velocity"].contains(&key);
    let default = if is_rate { "0" } else { "that of its [[body]]" };
    of_body(key, tables).map(|Key(schema, text, _)| Key(schema, text, default))
}

fn of_assemble(key: &str, tables: &[TableKeys]) -> Option<Key> {
    let rate = any(&[number(Any), within("rate", tables, &[])]);
    Some(match key {
        "fixed" => Key(
            json!({ "type": "array", "items": name() }),
            "Names of bodies that stay fixed, as the world does",
            "none",
        ),
        "angles" => Key(
            json!({ "type": "object", "additionalProperties": number(Any) }),
            "Angles of revolute and cylindrical joints at t = 0, rad from the poses as written",
            "none",
        ),
        "rates" => Key(
            json!({ "type": "object", "additionalProperties": rate }),
            "Velocities at t = 0 by joint: rad/s of a revolute, m/s of a translational joint, { turn = rad/s, slide = \
             m/s } of a cylindrical one",
            "none",
        ),
        "length" => Key(
            number(Positive),
            "m, > 0: the length at which a rotation by one radian counts as a translation by one metre",
            "root-mean-square distance of joints from centres of mass",
        ),
        "tolerance" => Key(number(Positive), "m, > 0: largest remaining gap of a joint", "1e-9"),
        "iterations" => Key(
            json!({ "type": "integer", "minimum": 1 }),
            "A whole number > 0: largest number of steps for connected bodies",
            "200",
        ),
        _ => return None,
    })
}

fn of_body(key: &str, tables: &[TableKeys]) -> Option<Key> {
    let tensor = array(numbers(3, Any), 3);
    Some(match key {
        "name" => Key(name(), "A unique name, not `world`", ""),
        "mass" => Key(number(Positive), "kg, > 0", "that of its link or shape"),
        "inertia" => Key(
            any(&[numbers(3, Positive), tensor]),
            "[Ix, Iy, Iz] kg·m², > 0: principal moments about the centre of mass, none above the sum of the others; or \
             a tensor [[Ixx, Ixy, Ixz], …]",
            "that of its link or shape",
        ),
        "driven" => Key(
            json!({ "type": "boolean" }),
            "Whether inputs of the types velocity and angular_velocity move it, not forces",
            "false",
        ),
        "position" => Key(
            place(),
            "[x, y, z] m or a point: centre of mass, world or in `frame`",
            "that of its link",
        ),
        "orientation" => Key(
            orientation(tables),
            "Body → world: { axis, angle }, { quaternion } or { euler_321 }",
            "none, or that of its link",
        ),
        "velocity" => Key(numbers(3, Any), "[x, y, z] m/s: centre of mass, world", "0"),
        "angular_velocity" => Key(numbers(3, Any), "[x, y, z] rad/s, body axes", "0"),
        "frame" => {
            Key(name(), "The reference body of position, orientation and velocities", "the world")
        }
        "link" => Key(
            within("link", tables, &[]),
            "The two end points of the body, and its shape and material",
            "none",
        ),
        "shape" => Key(
            within("shape", tables, &[]),
            "A uniform body: { type = \"box\", length = m, section = [m, m], density = kg/m³ }",
            "none",
        ),
        _ => return None,
    })
}
