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
            let (message, help) = match error.message().split_once(", expected ") {
                Some((message, expected)) => (message, format!("expected {expected}")),
                None if error.message() == "duplicate key" => {
                    ("duplicate key", "a key stands once in its table".to_owned())
                }
                None => (error.message(), "see https://toml.io for what TOML allows".to_owned()),
            };
            let end = source.text.len();
            Err(source.refuse(error.span().unwrap_or(end..end), message, help))
        }
    }
}
