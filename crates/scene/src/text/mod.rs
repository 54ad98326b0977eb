//! Reading a scene's text: tables that know their place in the file and what they may hold.
//!
//! `text => tables => values of a kind, or a refusal with line and column`. A [`Kind`] says what
//! a value must be; a [`Table`] asks for it by key. Nothing here knows of bodies or joints.

mod kinds;
mod name;
mod number;
mod table;
mod value;

pub(crate) use kinds::{Choice, Direction, Switch, Text};
pub use name::is_name;
pub(crate) use number::{Measure, Number, Numbers, Seconds};
pub(crate) use table::{Table, root};
pub(crate) use value::{Kind, Value};

use std::ops::Range;

use toml::de::DeTable;

use crate::error::{SceneError, Source};
use crate::shortened::shortened;

/// Parses the file's text.
pub(crate) fn parse(source: Source<'_>) -> Result<DeTable<'_>, SceneError> {
    parse_at(source, source.text.get(..source.own).unwrap_or(source.text))
}

/// Parses a text whose places are those of the source.
pub(crate) fn parse_at<'t>(source: Source<'t>, text: &'t str) -> Result<DeTable<'t>, SceneError> {
    match DeTable::parse(text) {
        Ok(document) => Ok(document.into_inner()),
        Err(error) => {
            let end = text.len();
            let span = error.span().unwrap_or(end..end);
            let (message, help) = explain(source, &span, error.message());
            Err(source.refuse(span, message, help))
        }
    }
}

/// What is wrong and what would be right, from the parser's message and its place.
fn explain(source: Source<'_>, span: &Range<usize>, message: &str) -> (String, String) {
    let (problem, expected) = message.split_once(", expected ").unwrap_or((message, ""));
    let written = source.text.get(span.clone()).unwrap_or_default();
    let help = match (problem, expected) {
        // `0.5s` is a float with something behind it to the parser.
        ("invalid float" | "invalid integer", "" | "nothing") => {
            "a number alone is in SI units, e.g. 0.5 or 2e-5; with its unit or in a sum it stands in \
             quotes: \"20us\", \"30 deg\", \"2 * L\""
                .into()
        }
        ("duplicate key", _) => match opened_by(source, span) {
            Some(name) => {
                let name = shortened(name);
                let problem = format!("`{name}` is opened again, and somewhere by [{name}] alone");
                return (problem, format!("each of many is opened by [[{name}]], in two brackets"));
            }
            None => "a key stands once in its table".into(),
        },
        // `0 1` is a text without quotes to it.
        ("string values must be quoted", _) if are_numbers(written) => {
            return ("missing comma between array elements".into(), COMMAS.into());
        }
        ("string values must be quoted", _) => {
            return (
                "a text without quotes".into(),
                format!("a text stands in quotes: \"{}\"", shortened(written)),
            );
        }
        ("unexpected key or value", _) if at(source, span).starts_with(',') => {
            "a number has a decimal point: 0.5; several stand in brackets: [0, 5]".into()
        }
        (problem, _) if problem.starts_with("missing comma") => COMMAS.into(),
        ("unclosed array table" | "unclosed table", _) => {
            "one of many is opened by two brackets and closed by two: [[body]]".into()
        }
        (_, "" | "nothing") => "see https://toml.io for what TOML allows".into(),
        (_, expected) => format!("expected {expected}"),
    };
    (problem.into(), help)
}

const COMMAS: &str = "entries of an array and keys within braces are separated by commas: \
                      [0, 0, 1], { axis = [0, 0, 1], angle = 0.5 }";

/// The text from a place on.
fn at<'t>(source: Source<'t>, span: &Range<usize>) -> &'t str {
    source.text.get(span.start..).unwrap_or_default()
}

/// The name in `[NAME]` or `[[NAME]]` where that is what stands at a place.
fn opened_by<'t>(source: Source<'t>, span: &Range<usize>) -> Option<&'t str> {
    let before = source.text.get(..span.start)?;
    let line = before.rsplit('\n').next()?;
    let is_header = line.trim_start().starts_with('[') && !line.contains(['=', '"']);
    if is_header { source.text.get(span.clone()) } else { None }
}

/// Whether a text is two numbers or more, with nothing but space between them.
fn are_numbers(text: &str) -> bool {
    let words = || text.split_whitespace();
    words().count() > 1 && words().all(|word| word.parse::<f64>().is_ok())
}
