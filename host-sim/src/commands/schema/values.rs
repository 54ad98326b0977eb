//! Values of a scene in JSON Schema: numbers with units or as texts, points, directions, names.
//!
//! `(kind, meaning) => schema`. Only the reader can check whether a text is a value with a unit, a sum or a parameter's
//! name.

use serde_json::{Value, json};

/// A key: its schema, its meaning, and its default as text.
pub(super) struct Key(pub(super) Value, pub(super) &'static str, pub(super) &'static str);

impl Key {
    /// With its description.
    pub(super) fn schema(self) -> Value {
        let Self(mut schema, meaning, default) = self;
        let default = match default {
            "" => String::new(),
            words => format!(" Default: {words}."),
        };
        schema["description"] = json!(format!("{meaning}.{default}"));
        schema
    }
}

/// The permitted numbers.
#[derive(Clone, Copy)]
pub(super) enum Range {
    Any,
    NotNegative,
    Positive,
}

/// A number, or a text with its unit or arithmetic.
pub(super) fn number(range: Range) -> Value {
    let mut schema = json!({ "type": ["number", "string"], "minLength": 1 });
    match range {
        Range::Any => {}
        Range::NotNegative => schema["minimum"] = json!(0),
        Range::Positive => schema["exclusiveMinimum"] = json!(0),
    }
    schema
}

/// A whole number up to `most`, or a text.
pub(super) fn whole(most: u32) -> Value {
    json!({ "type": ["integer", "string"], "minLength": 1, "minimum": 0, "maximum": most })
}

/// A fixed number of numbers.
pub(super) fn numbers(count: usize, range: Range) -> Value {
    array(number(range), count)
}

/// A fixed number of items of a kind.
pub(super) fn array(items: Value, count: usize) -> Value {
    json!({ "type": "array", "items": items, "minItems": count, "maxItems": count })
}

/// One of some kinds.
pub(super) fn any(kinds: &[Value]) -> Value {
    json!({ "anyOf": kinds })
}

/// One of a few words.
pub(super) fn choice(words: &[&str]) -> Value {
    json!({ "type": "string", "enum": words })
}

/// A name of one visible line.
pub(super) fn name() -> Value {
    json!({ "type": "string", "minLength": 1, "maxLength": 200 })
}

/// `[x, y, z]` or the name of a point.
pub(super) fn place() -> Value {
    any(&[name(), numbers(3, Range::Any)])
}

/// `[x, y, z]`, or two points from the first to the second.
pub(super) fn heading() -> Value {
    any(&[numbers(3, Range::Any), array(place(), 2)])
}

/// A value, or one of each body.
pub(super) fn halves(value: &Value, keys: &[&str]) -> Value {
    any(&[value.clone(), object(keys.iter().map(|key| (*key, value.clone())), keys)])
}

/// A table of these keys and no other.
pub(super) fn object<'k>(
    properties: impl IntoIterator<Item = (&'k str, Value)>,
    required: &[&str],
) -> Value {
    let properties: serde_json::Map<String, Value> =
        properties.into_iter().map(|(key, value)| (key.to_owned(), value)).collect();
    let mut schema = json!({
        "type": "object",
        "properties": properties,
        "additionalProperties": false,
    });
    if !required.is_empty() {
        schema["required"] = json!(required);
    }
    schema
}
