//! Reading a scene's text: tables that know their place in the file and what they may hold.
//!
//! `text => tables => values of a kind, or a refusal with line and column`. A [`Kind`] says what
//! a value must be; a [`Table`] asks for it by key. Nothing here knows of bodies or joints.

mod kinds;
mod table;
mod value;

pub(crate) use kinds::{Choice, Direction, Number, Numbers, Text};
pub(crate) use table::{Table, root};
pub(crate) use value::{Kind, Value};

use toml::de::DeTable;

use crate::error::{SceneError, Source};

/// Parses the text.
pub(crate) fn parse(source: Source<'_>) -> Result<DeTable<'_>, SceneError> {
    match DeTable::parse(source.text) {
        Ok(document) => Ok(document.into_inner()),
        Err(error) => {
            let (message, help) = explain(error.message());
            let end = source.text.len();
            Err(source.refuse(error.span().unwrap_or(end..end), message, help))
        }
    }
}

/// What is wrong and what would be right, from the parser's message.
fn explain(message: &str) -> (&str, String) {
    let (problem, expected) = message.split_once(", expected ").unwrap_or((message, ""));
    let help = match (problem, expected) {
        // `0.5s` is a float with something behind it to the parser.
        ("invalid float" | "invalid integer", "" | "nothing") => {
            "a number is plain and in SI units, e.g. 0.5 or 2e-5; a unit does not follow it".into()
        }
        ("duplicate key", _) => "a key stands once in its table".into(),
        (_, "" | "nothing") => "see https://toml.io for what TOML allows".into(),
        (_, expected) => format!("expected {expected}"),
    };
    (problem, help)
}
