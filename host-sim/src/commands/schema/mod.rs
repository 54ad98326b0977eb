//! `host-sim schema`: the JSON Schema of scene files, from which editors complete keys and show what they mean.
//!
//! `() => schema`. The tables and keys come from the reader itself ([`dbd_scene::vocabulary`]), their meanings from
//! `keys.rs`, `elements.rs` and `inner.rs`. Required keys are enforced only if the scene has no `[defaults]`, which may
//! provide them.

mod elements;
mod inner;
mod interactions;
mod keys;
mod values;

use dbd_scene::vocabulary::{TableKeys, defaults, vocabulary};
use serde_json::{Map, Value, json};

use crate::terminal::text::json as text_of;
use values::{any, number, object, place};

/// The name of the schema file next to a scene.
pub const FILE: &str = "scene.schema.json";

/// The title that identifies a schema of this program.
pub const TITLE: &str = "DBD scene";

/// The schema as the text of a file.
#[must_use]
pub fn text() -> String {
    let mut schema = schema();
    // A fixed order, independent of map features that other crates enable.
    schema.sort_all_objects();
    text_of(&schema)
}

/// Tables of which there are many, and what one of them is.
const MANY: [(&str, &str); 11] = [
    ("body", "A rigid body: mass, inertia, pose and velocity at t = 0"),
    ("joint", "A joint of springs and dampers"),
    ("tsda", "A spring and damper between two points"),
    ("point_on_line", "A point of one body, constrained to a line of another"),
    ("torsion_spring", "A spring and damper about an axis"),
    ("interaction", "An interaction of two bodies by a law: a stop, friction, or a custom law"),
    ("coupling", "A spring on a sum of joint coordinates: gears, a rack, a belt, a differential"),
    ("load", "A constant force or torque over a time window"),
    ("input", "An input, driven by a controller or a table at run time"),
    ("readout", "A sensor"),
    ("geometry", "The appearance of a body or the ground, for pictures only"),
];

/// Required keys of a table, for all types.
fn required(table: &str) -> &'static [&'static str] {
    match table {
        "joint" => &["type", "between", "stiffness"],
        "tsda" => &["between", "points", "stiffness"],
        "point_on_line" => {
            &["between", "line_point", "line_direction", "point", "free_length", "stiffness"]
        }
        "torsion_spring" => &["between", "axis", "stiffness"],
        "interaction" => &["law", "between"],
        "coupling" => &["of", "stiffness"],
        "load" => &["body"],
        "input" | "readout" => &["type"],
        "geometry" => &["body", "shape"],
        _ => &[],
    }
}

/// Further required keys of a table of a given type.
fn required_of(table: &str, kind: &str) -> Vec<&'static str> {
    let keys: &[&str] = match (table, kind) {
        ("joint", "spherical") => &["at", "arm"],
        ("joint", "revolute") => &["at", "axis", "span"],
        ("joint", "universal") => &["at", "axes", "spider", "span"],
        ("joint", "cylindrical") => &["at", "axis", "span", "offset"],
        ("joint", "translational") => &["at", "axis", "span", "gauge", "offset"],
        ("joint", "fixed") => &["at", "axis", "span", "arm"],
        ("input", "force" | "torque" | "velocity" | "angular_velocity") => &["body", "axis"],
        ("input", "gravity") => &["axis"],
        ("input", "anchor") => &["target", "axis"],
        ("input", "drive") => &["target", "mode"],
        ("input", "signal") => &[],
        ("input", _) => &["target"],
        ("interaction", law) => return interactions::required(law),
        ("readout", "interaction") => &["target", "quantity"],
        ("readout", "point" | "point_velocity" | "imu") => &["body"],
        ("readout", _) => &["target"],
        ("geometry", "box") => &["size"],
        ("geometry", "link") => &["from", "to"],
        ("link", "cylinder" | "tube" | "sphere") => &["diameter"],
        ("link", "box") => &["section"],
        ("link", "plate") => &["width"],
        ("shape", "sphere") => &["diameter"],
        ("shape", "cylinder" | "tube") => &["diameter", "length"],
        ("shape", "box") => &["section", "length"],
        ("shape", "plate") => &["width", "length"],
        ("shape", _) => &["length"],
        _ => &[],
    };
    keys.into()
}

/// The key that selects the kind of a table.
fn kind_key(table: &str) -> &'static str {
    match table {
        "link" | "geometry" => "shape",
        "interaction" => "law",
        _ => "type",
    }
}

fn schema() -> Value {
    let tables = vocabulary();
    let mut properties = Map::new();
    for key in keys_of("scene", &tables) {
        if let Some(value) = keys::schema("scene", key, &tables) {
            properties.insert(key.into(), value);
        }
    }
    properties.insert("parameters".into(), parameters());
    properties.insert("points".into(), points(&tables));
    properties.insert("assemble".into(), assemble(&tables));
    properties.insert("defaults".into(), of_defaults(&tables));
    properties.insert("start".into(), start(&tables));
    let mut whole = Map::new();
    for (table, meaning) in MANY {
        let items = one(table, meaning, &tables);
        let many = json!({ "type": "array", "items": items, "description": format!("{meaning}.") });
        properties.insert(table.into(), many);
        whole.insert(table.into(), json!({ "items": complete(table, &tables) }));
    }
    properties["body"]["minItems"] = json!(1);
    json!({
        "$schema": "http://json-schema.org/draft-07/schema#",
        "title": TITLE,
        "description": "A mechanism of rigid bodies, joints and springs: docs/scene-reference.md.",
        "type": "object",
        "properties": properties,
        "required": ["name", "duration", "body"],
        "additionalProperties": false,
        "if": { "anyOf": [{ "required": ["defaults"] }, { "required": ["realisation"] }] },
        "then": {},
        "else": { "properties": whole },
    })
}

/// All keys of a table, for all kinds.
fn keys_of(table: &str, tables: &[TableKeys]) -> Vec<&'static str> {
    let mut all: Vec<&'static str> = Vec::new();
    for key in tables.iter().filter(|known| known.table == table).flat_map(|known| &known.keys) {
        if !all.contains(key) {
            all.push(key);
        }
    }
    all
}

/// A table: all keys of all its kinds, and of each kind only its own.
fn one(table: &'static str, meaning: &str, tables: &[TableKeys]) -> Value {
    let keys = keys_of(table, tables);
    let named: &[&str] = match table {
        "body" | "joint" | "input" | "readout" => &["name"],
        _ => &[],
    };
    let properties = keys.iter().filter_map(|key| Some((*key, keys::schema(table, key, tables)?)));
    let mut schema = object(properties, named);
    schema["description"] = json!(format!("{meaning}."));
    if table == "interaction" {
        // The keys of a law of another program.
        schema["additionalProperties"] = json!(true);
    }
    let rules = own_keys(table, tables);
    if !rules.is_empty() {
        schema["allOf"] = json!(rules);
    }
    if table == "body" {
        for nested in ["link", "shape"] {
            schema["properties"][nested]["allOf"] = json!(own_keys(nested, tables));
        }
    }
    schema
}

/// Of each kind only its own keys.
fn own_keys(table: &str, tables: &[TableKeys]) -> Vec<Value> {
    let own = |keys: &[&str]| json!({ "propertyNames": { "enum": keys } });
    of_kinds(table, tables).map(|(kind, keys)| when(table, kind, own(keys))).collect()
}

fn of_kinds<'t>(
    table: &'t str,
    tables: &'t [TableKeys],
) -> impl Iterator<Item = (&'static str, &'t [&'static str])> {
    let of = tables.iter().filter(move |known| known.table == table);
    of.filter_map(|known| Some((known.kind?, known.keys.as_slice())))
}

/// A rule for tables of one kind.
fn when(table: &str, kind: &str, then: Value) -> Value {
    let key = kind_key(table);
    json!({ "if": { "properties": { key: { "const": kind } }, "required": [key] }, "then": then })
}

/// Required keys of a table without defaults.
fn complete(table: &str, tables: &[TableKeys]) -> Value {
    let has = |key: &str| json!({ "required": [key] });
    let within = |key: &str, keys: &[&str]| {
        let keys: Vec<Value> = keys.iter().map(|key| has(key)).collect();
        json!({ "required": [key], "properties": { key: any(&keys) } })
    };
    // A bushing has no use for them.
    let free = |key: &str| table == "joint" && matches!(key, "arm" | "spider");
    let bushing = json!({
        "required": ["realisation"],
        "properties": { "realisation": { "const": "bushing" } },
    });
    let rules = |table: &str| -> Vec<Value> {
        let of = |kind| {
            let keys = required_of(table, kind);
            let always: Vec<_> = keys.iter().filter(|key| !free(key)).collect();
            let mut then = json!({ "required": always });
            if let Some(key) = keys.iter().find(|key| free(key)) {
                then["anyOf"] = any(&[has(key), bushing.clone()])["anyOf"].take();
            }
            then
        };
        of_kinds(table, tables).map(|(kind, _)| when(table, kind, of(kind))).collect()
    };
    match table {
        "body" => json!({
            "allOf": [
                any(&[has("mass"), within("link", &["mass", "density"]), within("shape", &["mass", "density"])]),
                any(&[has("inertia"), has("link"), has("shape")]),
                any(&[has("position"), has("link")]),
            ],
            "properties": {
                "link": { "required": ["from", "to"], "allOf": rules("link") },
                "shape": { "required": ["type"], "allOf": rules("shape") },
            },
        }),
        "load" => json!({
            "required": required(table),
            "anyOf": [has("force"), has("torque")],
        }),
        "geometry" => {
            let mut rules = rules(table);
            let size = any(&[has("radius"), has("diameter")]);
            for kind in ["cylinder", "link", "sphere"] {
                rules.push(when(table, kind, size.clone()));
            }
            let ends = json!({ "required": ["from", "to"] });
            let middle = json!({ "required": ["axis", "length"] });
            rules.push(when(table, "cylinder", any(&[ends, middle])));
            json!({ "required": required(table), "allOf": rules })
        }
        _ => {
            let mut schema = json!({ "required": required(table) });
            // None is not taken for all of none.
            let rules = rules(table);
            if !rules.is_empty() {
                schema["allOf"] = json!(rules);
            }
            schema
        }
    }
}

fn parameters() -> Value {
    json!({
        "type": "object",
        "description": "Named values for repeated use in the scene: numbers, or texts with units and \
            arithmetic that may refer to each other.",
        "additionalProperties": number(values::Range::Any),
    })
}

fn points(tables: &[TableKeys]) -> Value {
    let form = inner::within("point", tables, &[]);
    json!({
        "type": "object",
        "description": "Named points in the world at the initial pose: [x, y, z] m, or relative to other points.",
        "additionalProperties": any(&[place(), form]),
    })
}

fn assemble(tables: &[TableKeys]) -> Value {
    let keys = keys_of("assemble", tables);
    let keys = keys.iter().filter_map(|key| Some((*key, keys::schema("assemble", key, tables)?)));
    let mut schema = object(keys, &[]);
    schema["description"] = json!("Bodies are moved until all joints are closed.");
    schema
}

fn start(tables: &[TableKeys]) -> Value {
    let keys = keys_of("start", tables);
    let keys = keys.iter().filter_map(|key| Some((*key, keys::schema("body", key, tables)?)));
    json!({
        "type": "object",
        "description": "States at t = 0 by body, if they differ from the assembled ones.",
        "additionalProperties": object(keys, &[]),
    })
}

fn of_defaults(tables: &[TableKeys]) -> Value {
    let kinds = defaults();
    let joint_types: Vec<&str> = of_kinds("joint", tables).map(|(kind, _)| kind).collect();
    let all = kinds.iter().map(|(kind, keys)| {
        // The keys of a type of joint are those of joints; links and shapes stand in bodies.
        let table = match *kind {
            "link" | "shape" => format!("body/items/properties/{kind}"),
            kind if joint_types.contains(&kind) => "joint/items".into(),
            kind => format!("{kind}/items"),
        };
        let like = |key: &str| json!({ "$ref": format!("#/properties/{table}/properties/{key}") });
        (*kind, object(keys.iter().map(|key| (*key, like(key))), &[]))
    });
    let mut schema = object(all, &[]);
    schema["description"] = json!("Default keys of the tables of each kind.");
    schema
}

#[cfg(test)]
mod tests {
    use super::*;

    /// Every key that the reader accepts is described.
    #[test]
    fn every_key_of_the_reader_is_described() {
        let tables = vocabulary();
        let apart = ["points", "defaults", "parameters", "assemble", "start"];
        for known in &tables {
            for key in &known.keys {
                let is_table = MANY.iter().any(|(table, _)| table == key) || apart.contains(key);
                if known.table == "halves" || known.table == "scene" && is_table {
                    continue;
                }
                let found = keys::schema(known.table, key, &tables);
                let words = found.as_ref().and_then(|schema| schema["description"].as_str());
                assert!(words.is_some_and(|words| words.len() > 4), "{}.{key}", known.table);
            }
        }
        let scene = keys_of("scene", &tables);
        assert!(MANY.iter().all(|(table, _)| scene.contains(table)));
        let own = schema();
        let keys = own["properties"].as_object().map(|keys| keys.len());
        assert_eq!(keys, Some(scene.len()));
    }
}
