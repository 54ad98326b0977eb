//! Tables of the file as axes.
//!
//! `[axes] => axes in the order of the file`. A path is one key in quotes, or keys separated by dots, which TOML reads
//! as nested tables: they are joined again.

use std::ops::Range as Place;

use dbd_scene::shortened;
use toml::Spanned;
use toml::de::{DeTable, DeValue};

use crate::sweep::axis::{Axis, Target};
use crate::sweep::random::Sample;
use crate::sweep::range::Range;
use crate::sweep::refusal::{Refusal, Source};
use crate::sweep::text::{Entry, entries, only, string, whole, wrong_type};
use crate::sweep::value::{Value, split};

const RANGE: [&str; 4] = ["from", "to", "count", "scale"];

const EXPECTED: &str = "a list of values, or a range: { from = 1e3, to = 1e6, count = 10, scale = \
                        \"logarithmic\" }";

/// The values of a table that are one axis each; `most` is the maximum number of cases.
pub(crate) struct Axes<'s> {
    pub(crate) source: &'s Source,
    pub(crate) sample: Option<Sample>,
    pub(crate) most: u64,
}

impl Axes<'_> {
    /// All axes of a table and of those within it; `above` is the path so far, and its position.
    pub(crate) fn read(
        &self,
        table: &DeTable<'_>,
        above: Option<(&str, usize)>,
        into: &mut Vec<Axis>,
    ) -> Result<(), Box<Refusal>> {
        for Entry { key, place, value } in entries(table) {
            let (path, place) = match above {
                // As a change has it.
                None => (key.to_owned(), place),
                Some((above, start)) => {
                    let quoted = key.contains(['.', '[', '=', '"']);
                    let key = if quoted { format!("\"{key}\"") } else { key.to_owned() };
                    // Keys on one line are one path; below a separate header a key is a path itself.
                    let on_one_line =
                        !self.source.written(start..place.start).contains(['\n', ']']);
                    let start = if on_one_line { start } else { place.start };
                    (format!("{above}.{key}"), start..place.end)
                }
            };
            match value.get_ref() {
                DeValue::Table(inner) if !self.is_range(value, inner) => {
                    self.read(inner, Some((&path, place.start)), into)?;
                }
                _ => into.push(self.axis(path, place, value)?),
            }
        }
        Ok(())
    }

    /// Whether a table is a range and no part of a path.
    fn is_range(&self, value: &Spanned<DeValue<'_>>, inner: &DeTable<'_>) -> bool {
        let inline = self.source.written(value.span()).starts_with('{');
        inline || RANGE.iter().filter(|key| inner.contains_key(**key)).count() > 1
    }

    fn axis(
        &self,
        path: String,
        place: Place<usize>,
        value: &Spanned<DeValue<'_>>,
    ) -> Result<Axis, Box<Refusal>> {
        let what = format!("the axis `{}`", shortened(&path));
        match value.get_ref() {
            DeValue::Array(array) => {
                if array.is_empty() {
                    let message = format!("{what} has no values");
                    return Err(self.source.refuse(
                        value.span(),
                        message,
                        "give one value or more",
                    ));
                }
                let entry = |entry| (Value::of(self.source, entry), entry.span());
                let listed: Vec<(Value, Place<usize>)> = array.iter().map(entry).collect();
                let values = match self.sample {
                    Some(sample) => {
                        let row = |share: f64| (share * listed.len() as f64) as usize;
                        let shares = sample.shares(&path).into_iter();
                        shares.map(|share| listed[row(share)].0.clone()).collect()
                    }
                    None => listed.iter().map(|(value, _)| value.clone()).collect(),
                };
                let target = Target::of(&path);
                Ok(Axis { path, place, target, values, tried: listed, logarithmic: false })
            }
            DeValue::Table(table) => self.range(&what, path, place, (table, value.span())),
            _ => Err(wrong_type(self.source, value, &what, EXPECTED)),
        }
    }

    fn range(
        &self,
        what: &str,
        path: String,
        place: Place<usize>,
        (table, span): (&DeTable<'_>, Place<usize>),
    ) -> Result<Axis, Box<Refusal>> {
        let source = self.source;
        only(source, table, what, &RANGE)?;
        let missing = |key: &str| {
            source.refuse(
                span.clone(),
                format!("{what} has no `{key}`"),
                format!("it is {EXPECTED}"),
            )
        };
        let end = |key: &'static str| {
            let value = table.get(key).ok_or_else(|| missing(key))?;
            end_of(source, what, key, value)
        };
        let [from, to] = [end("from")?, end("to")?];
        let scale = table.get("scale");
        let logarithmic = match scale {
            None => false,
            Some(value) => {
                let expected = "\"linear\" or \"logarithmic\"";
                match string(source, value, "`scale`", expected)? {
                    "linear" => false,
                    "logarithmic" | "log" => true,
                    other => {
                        let message = format!("there is no scale \"{}\"", shortened(other));
                        return Err(source.refuse(value.span(), message, expected));
                    }
                }
            }
        };
        let place_of = |key: &str| table.get(key).map_or(span.clone(), Spanned::span);
        if from.1 != to.1 {
            let help = "give both ends as plain numbers, or both with the same unit";
            let message = format!("the ends of {what} have different units");
            return Err(source.refuse(place_of("to"), message, help));
        }
        if from.0 == to.0 {
            let help = "give two different ends, or a single value in a list";
            let message = format!("both ends of {what} are equal");
            return Err(source.refuse(place_of("to"), message, help));
        }
        for (key, number) in [("from", from.0), ("to", to.0)] {
            if logarithmic && number < f64::MIN_POSITIVE {
                let message =
                    format!("`{key}` of {what} is {number}, but its scale is logarithmic");
                let help = "give both ends of a logarithmic range > 0";
                return Err(source.refuse(place_of(key), message, help));
            }
        }
        let range = Range { from: from.0, to: to.0, logarithmic, unit: from.1 };
        let target = Target::of(&path);
        let values: Vec<Value> = match (self.sample, table.get("count")) {
            (Some(sample), None) => {
                sample.shares(&path).into_iter().map(|share| range.at(share)).collect()
            }
            (Some(_), Some(count)) => {
                let message = format!("{what} has its own `count`");
                let help = "remove it: `count` of `sample` sets the number of cases";
                return Err(source.refuse(count.span(), message, help));
            }
            (None, None) => return Err(missing("count")),
            (None, Some(count)) => {
                let expected = "a whole number from 2";
                let number = whole(source, count, "`count`", expected)?;
                if number < 2 {
                    let message = format!("`count` of {what} is {number}");
                    let help = "give a count of two or more, or a single value in a list";
                    return Err(source.refuse(count.span(), message, help));
                }
                if number > self.most {
                    return Err(too_many(source, count.span(), u128::from(number), self.most));
                }
                range.values(number as usize)
            }
        };
        // A check at both ends is valid between them, except whether steps fit.
        let tried = match Axis::is_time(&path) {
            true => values.iter().map(|value| (value.clone(), span.clone())).collect(),
            false => vec![(range.at(0.0), place_of("from")), (range.at(1.0), place_of("to"))],
        };
        Ok(Axis { path, place, target, values, tried, logarithmic })
    }
}

/// The error of too many cases.
pub(crate) fn too_many(
    source: &Source,
    place: Place<usize>,
    cases: u128,
    most: u64,
) -> Box<Refusal> {
    let help = "use fewer values, or a sample of them: sample = { kind = \"latin-hypercube\", count = \
                1000, seed = 1 }";
    source.refuse(place, format!("{cases} cases exceed the maximum of {most}"), help)
}

/// An end of a range: a number, and the unit where it has one.
fn end_of(
    source: &Source,
    what: &str,
    key: &str,
    value: &Spanned<DeValue<'_>>,
) -> Result<(f64, Option<String>), Box<Refusal>> {
    let expected = "a finite number, or one with its unit in quotes: \"9 kN/mm\"";
    let called = format!("`{key}` of {what}");
    let refused = || {
        let written = shortened(source.written(value.span())).into_owned();
        let help = format!("{called} is {expected}");
        source.refuse(value.span(), format!("{called} is {written}"), help)
    };
    match value.get_ref() {
        DeValue::Integer(_) | DeValue::Float(_) => {
            let number = Value::of(source, value).cell.parse::<f64>().ok();
            let number = number.filter(|number| number.is_finite()).ok_or_else(refused)?;
            Ok((number, None))
        }
        DeValue::String(text) => {
            let (number, unit) = split(text).ok_or_else(refused)?;
            let plain = |c: char| c.is_alphanumeric() || " /*·^²³%°µ-".contains(c);
            if unit.is_empty() || !unit.chars().all(plain) {
                return Err(refused());
            }
            Ok((number, Some(unit.to_owned())))
        }
        _ => Err(wrong_type(source, value, &called, expected)),
    }
}
