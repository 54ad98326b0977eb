//! Reading a scene's text: tables with their position in the file and their allowed keys.
//!
//! `text => tables => values of a kind, or an error with line and column`. A [`Kind`] defines a valid value; a
//! [`Table`] reads it by key. This module is independent of bodies and joints.

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

use toml::Spanned;
use toml::de::{DeTable, DeValue};

use crate::error::{SceneError, Source};
use crate::shortened::shortened;

/// Parses the file's text.
pub(crate) fn parse(source: Source<'_>) -> Result<DeTable<'_>, SceneError> {
    parse_at(source, source.text.get(..source.own).unwrap_or(source.text), 0)
}

/// Parses a text; its positions are those of the source, where it begins at `start`.
pub(crate) fn parse_at<'t>(
    source: Source<'t>,
    text: &'t str,
    start: usize,
) -> Result<DeTable<'t>, SceneError> {
    match DeTable::parse(text) {
        Ok(document) if start == 0 => Ok(document.into_inner()),
        Ok(document) => Ok(moved_table(document.into_inner(), start)),
        Err(error) => {
            let end = text.len();
            let span = error.span().unwrap_or(end..end);
            let span = start + span.start..start + span.end;
            let (message, help) = explain(source, &span, error.message());
            Err(source.refuse(span, message, help))
        }
    }
}

/// A table whose positions are later by `by` bytes.
fn moved_table(table: DeTable<'_>, by: usize) -> DeTable<'_> {
    table
        .into_iter()
        .map(|(key, value)| (moved(key, by, |key, _| key), moved_value(value, by)))
        .collect()
}

fn moved_value(value: Spanned<DeValue<'_>>, by: usize) -> Spanned<DeValue<'_>> {
    moved(value, by, |value, by| match value {
        DeValue::Array(items) => {
            DeValue::Array(items.into_iter().map(|item| moved_value(item, by)).collect())
        }
        DeValue::Table(table) => DeValue::Table(moved_table(table, by)),
        other => other,
    })
}

fn moved<T>(spanned: Spanned<T>, by: usize, inner: impl Fn(T, usize) -> T) -> Spanned<T> {
    let span = spanned.span();
    Spanned::new(span.start + by..span.end + by, inner(spanned.into_inner(), by))
}

/// Problem and remedy, from the parser's message and its position.
fn explain(source: Source<'_>, span: &Range<usize>, message: &str) -> (String, String) {
    let (problem, expected) = message.split_once(", expected ").unwrap_or((message, ""));
    let written = source.text.get(span.clone()).unwrap_or_default();
    let help = match (problem, expected) {
        // The parser reads `0.5s` as a float followed by other text.
        ("invalid float" | "invalid integer", "" | "nothing") => {
            "write a plain number in SI units, e.g. 0.5 or 2e-5; put a number with a unit or an \
             expression in quotes: \"20us\", \"30 deg\", \"2 * L\""
                .into()
        }
        ("duplicate key", _) => match opened_by(source, span) {
            Some(name) => {
                let name = shortened(name);
                let problem = format!("`{name}` is defined again, and elsewhere as [{name}]");
                return (
                    problem,
                    format!("start each of them with [[{name}]], in double brackets"),
                );
            }
            None => "give each key once per table".into(),
        },
        // The parser reads `0 1` as text without quotes.
        ("string values must be quoted", _) if are_numbers(written) => {
            return ("missing comma between array elements".into(), COMMAS.into());
        }
        ("string values must be quoted", _) => {
            return (
                "text without quotes".into(),
                format!("put the text in quotes: \"{}\"", shortened(written)),
            );
        }
        ("unexpected key or value", _) if at(source, span).starts_with(',') => {
            "use a decimal point: 0.5; put several numbers in brackets: [0, 5]".into()
        }
        (problem, _) if problem.starts_with("missing comma") => COMMAS.into(),
        ("unclosed array table" | "unclosed table", _) => {
            "open and close the header with the same number of brackets: [[body]]".into()
        }
        (_, "" | "nothing") => "see https://toml.io for the syntax of TOML".into(),
        (_, expected) => format!("expected {expected}"),
    };
    (problem.into(), help)
}

const COMMAS: &str = "separate array entries and keys within braces with commas: \
                      [0, 0, 1], { axis = [0, 0, 1], angle = 0.5 }";

/// The text from a position on.
fn at<'t>(source: Source<'t>, span: &Range<usize>) -> &'t str {
    source.text.get(span.start..).unwrap_or_default()
}

/// The name in `[NAME]` or `[[NAME]]` at a position, if any.
fn opened_by<'t>(source: Source<'t>, span: &Range<usize>) -> Option<&'t str> {
    let before = source.text.get(..span.start)?;
    let line = before.rsplit('\n').next()?;
    let is_header = line.trim_start().starts_with('[') && !line.contains(['=', '"']);
    if is_header { source.text.get(span.clone()) } else { None }
}

/// Whether a text is two or more numbers separated only by space.
fn are_numbers(text: &str) -> bool {
    let words = || text.split_whitespace();
    words().count() > 1 && words().all(|word| word.parse::<f64>().is_ok())
}
