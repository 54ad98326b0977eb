//! TOML values with positions, and checks of tables.
//!
//! `text => entries in the order of the file`. The parser's tables are in alphabetical order; the order of axes
//! matters, so entries are sorted by position.

use std::ops::Range;

use dbd_scene::{nearest, shortened};
use toml::Spanned;
use toml::de::{DeTable, DeValue};

use crate::sweep::refusal::{Refusal, Source};

/// A key with its position, and its value.
pub(crate) struct Entry<'t> {
    pub(crate) key: &'t str,
    pub(crate) place: Range<usize>,
    pub(crate) value: &'t Spanned<DeValue<'t>>,
}

/// Parses a file's text.
pub(crate) fn parse(source: &Source) -> Result<DeTable<'_>, Box<Refusal>> {
    match DeTable::parse(&source.text) {
        Ok(document) => Ok(document.into_inner()),
        Err(error) => {
            let end = source.text.len();
            let help = "write the sweep in TOML: https://toml.io";
            Err(source.refuse(error.span().unwrap_or(end..end), error.message(), help))
        }
    }
}

/// The entries of a table in the order of the file.
pub(crate) fn entries<'t>(table: &'t DeTable<'t>) -> Vec<Entry<'t>> {
    let entry = |(key, value): (&'t Spanned<_>, &'t Spanned<DeValue<'t>>)| {
        let name: &std::borrow::Cow<'t, str> = key.get_ref();
        Entry { key: name.as_ref(), place: key.span(), value }
    };
    let mut entries: Vec<Entry<'t>> = table.iter().map(entry).collect();
    entries.sort_by_key(|entry| entry.place.start);
    entries
}

/// Rejects keys other than these; `owner` is the table's name in messages.
pub(crate) fn only(
    source: &Source,
    table: &DeTable<'_>,
    owner: &str,
    keys: &[&str],
) -> Result<(), Box<Refusal>> {
    let Some(Entry { key, place, .. }) =
        entries(table).into_iter().find(|entry| !keys.contains(&entry.key))
    else {
        return Ok(());
    };
    let meant = nearest(key, keys.iter().copied());
    let meant = meant.map(|meant| format!("did you mean `{meant}`? ")).unwrap_or_default();
    let known: Vec<String> = keys.iter().map(|key| format!("`{key}`")).collect();
    let help = format!("{meant}the keys of {owner} are {}", known.join(", "));
    Err(source.refuse(place, format!("{owner} has no key `{}`", shortened(key)), help))
}

/// A text, where the value is one.
pub(crate) fn string<'t>(
    source: &Source,
    value: &'t Spanned<DeValue<'t>>,
    what: &str,
    expected: &str,
) -> Result<&'t str, Box<Refusal>> {
    let text = value.get_ref().as_str();
    text.ok_or_else(|| wrong_type(source, value, what, expected))
}

/// The entries of an array, where the value is one.
pub(crate) fn array<'t>(
    source: &Source,
    value: &'t Spanned<DeValue<'t>>,
    what: &str,
    expected: &str,
) -> Result<Vec<&'t Spanned<DeValue<'t>>>, Box<Refusal>> {
    match value.get_ref() {
        DeValue::Array(array) => Ok(array.iter().collect()),
        _ => Err(wrong_type(source, value, what, expected)),
    }
}

/// A whole number from 0.
pub(crate) fn whole(
    source: &Source,
    value: &Spanned<DeValue<'_>>,
    what: &str,
    expected: &str,
) -> Result<u64, Box<Refusal>> {
    let DeValue::Integer(integer) = value.get_ref() else {
        return Err(wrong_type(source, value, what, expected));
    };
    u64::from_str_radix(integer.as_str(), integer.radix()).map_err(|_| {
        let written = source.written(value.span());
        let help = format!("{what} is {expected}");
        source.refuse(value.span(), format!("{what} is {}", shortened(written)), help)
    })
}

/// The refusal of a value of another type.
pub(crate) fn wrong_type(
    source: &Source,
    value: &Spanned<DeValue<'_>>,
    what: &str,
    expected: &str,
) -> Box<Refusal> {
    let kind = value.get_ref().type_str();
    let article = if matches!(kind, "integer" | "array") { "an" } else { "a" };
    let message = format!("{what} is {article} {kind}");
    source.refuse(value.span(), message, format!("{what} is {expected}"))
}
