//! What the keys of interactions mean and take, by the laws that this program knows.
//!
//! `key => schema`. Several laws may have a key of one name; its description then states each. A law of another name
//! belongs to another program: it allows any keys.

use dbd_kernel::laws::Field;
use dbd_plant::digits::significant;
use dbd_scene::laws::{KnownLaw, known_laws};
use serde_json::{Value, json};

use super::elements::between;
use super::values::Range::{Any, NotNegative};
use super::values::{Key, any, array, heading, name, number, numbers, place};

/// The schema of a key; `None` of one that no law has.
pub(super) fn schema(key: &str) -> Option<Value> {
    let found = match key {
        "name" => Key(name(), "A name, unique among joints and elements", "none"),
        "law" => return Some(law()),
        "between" => between(),
        _ => return constant(key),
    };
    Some(found.schema())
}

/// The required keys of a law besides the common ones.
pub(super) fn required(law: &str) -> Vec<&'static str> {
    let fields = known_laws().into_iter().find(|known| known.name == law).map(|law| law.fields);
    let needed = fields.unwrap_or_default().iter().filter(|field| field.default.is_none());
    needed.map(|field| field.name).collect()
}

fn law() -> Value {
    let one = |name, about: &str| json!({ "const": name, "description": about });
    let laws = known_laws().into_iter().filter(KnownLaw::is_between);
    let mut laws: Vec<Value> = laws.map(|law| one(law.name, law.about)).collect();
    laws.push(json!({ "type": "string", "minLength": 1 }));
    let mut schema = any(&laws);
    schema["description"] = json!("The law between the two bodies.");
    schema
}

/// A constant of one law or of several.
fn constant(key: &str) -> Option<Value> {
    let (mut takes, mut says) = (Vec::new(), Vec::new());
    for law in known_laws().into_iter().filter(KnownLaw::is_between) {
        let Some(field) = law.fields.iter().find(|field| field.name == key) else { continue };
        let kind = of_kind(field);
        if !takes.contains(&kind) {
            takes.push(kind);
        }
        says.push(format!("{}: {}", law.name, meaning(field)));
    }
    let mut schema = match &takes[..] {
        [] => return None,
        [one] => one.clone(),
        several => any(several),
    };
    schema["description"] = json!(says.join(" "));
    Some(schema)
}

fn of_kind(field: &Field) -> Value {
    match field.kind {
        "count" => number(NotNegative),
        "points" => array(place(), 2),
        "normal" | "axis" | "axle" => heading(),
        "matrix" => array(numbers(6, Any), 6),
        "table" => json!({ "type": "array", "items": numbers(2, Any), "minItems": 2 }),
        _ => number(Any),
    }
}

/// Its units, meaning and default.
fn meaning(field: &Field) -> String {
    let units = match field.kind {
        "points" => {
            "[[x, y, z], [x, y, z]] m in the axes of the two bodies, or names of points; ".into()
        }
        "normal" | "axis" | "axle" => "[x, y, z] or two points, world at the initial pose; ".into(),
        _ if field.units.is_empty() => String::new(),
        _ => format!("{}; ", field.units.join(", ")),
    };
    let default = field.default.map(|value| format!(" Default: {}.", significant(value, 15)));
    let default = default.unwrap_or_default();
    format!("{units}{}{default}", field.about)
}
