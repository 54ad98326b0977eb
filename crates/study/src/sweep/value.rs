//! A value of an axis, for the scene and for the table.
//!
//! `TOML value => text after PATH=, cell`. Numbers have a canonical form, so that 1e3 and 1000.0 are one case; other
//! values keep their text. If all values of an axis have the same quantity, the table has them as numbers in SI.

use dbd_scene::quantity::{Dimension, evaluate};
use toml::Spanned;
use toml::de::DeValue;

use crate::sweep::refusal::Source;

/// A value of an axis.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct Value {
    /// As a change of the scene has it after `PATH=`: TOML.
    pub toml: String,
    /// As the table shows it where not all of its axis are quantities.
    pub cell: String,
}

impl Value {
    /// A number.
    #[must_use]
    pub fn number(number: f64) -> Self {
        let text = format!("{number:?}");
        Self { toml: text.clone(), cell: text }
    }

    /// A number with a suffix, a unit with its blank: a text in TOML.
    #[must_use]
    pub fn with_unit(number: f64, unit: &str) -> Self {
        let cell = format!("{number:?}{unit}");
        Self { toml: format!("\"{cell}\""), cell }
    }

    /// The form in a file.
    pub(crate) fn of(source: &Source, value: &Spanned<DeValue<'_>>) -> Self {
        let written = source.written(value.span()).to_owned();
        match value.get_ref() {
            DeValue::Integer(integer) => {
                let number = i128::from_str_radix(integer.as_str(), integer.radix());
                let text = number.map_or(written, |number| number.to_string());
                Self { cell: text.clone(), toml: text }
            }
            DeValue::Float(float) => match float.as_str().parse::<f64>() {
                Ok(number) if number.is_finite() => Self::number(number),
                // The scene reports the error.
                _ => Self { toml: written.clone(), cell: written },
            },
            DeValue::String(text) => Self { cell: text.as_ref().to_owned(), toml: written },
            _ => Self { toml: written.clone(), cell: written },
        }
    }
}

/// A number and its suffix, blanks included: `30 deg`.
#[must_use]
pub fn split(text: &str) -> Option<(f64, &str)> {
    let text = text.trim();
    // The longest beginning that is a number: of `1e3 N` and of `2e` alike.
    let end = text.char_indices().map(|(at, c)| at + c.len_utf8()).rev().find(|end| {
        let number = &text[..*end];
        let plain = number.bytes().all(|b| b.is_ascii_digit() || b"+-.eE".contains(&b));
        plain && number.parse::<f64>().is_ok_and(f64::is_finite)
    })?;
    Some((text[..end].parse().ok()?, &text[end..]))
}

/// The quantity of numeric values, some with a unit: `None` if one is not numeric, if quantities differ, or if none has
/// a unit.
#[must_use]
pub fn dimension<'v>(values: impl Iterator<Item = &'v Value>) -> Option<Dimension> {
    let mut common = None;
    for value in values {
        let found = evaluate(&value.cell).ok()?.dimension;
        // A plain number is in the SI unit of its target.
        if !found.is_none() && *common.get_or_insert(found) != found {
            return None;
        }
    }
    common
}

impl Value {
    /// The number of a quantity, in SI; else the unchanged text.
    #[must_use]
    pub fn in_si(&self) -> String {
        evaluate(&self.cell)
            .map_or_else(|_| self.cell.clone(), |found| format!("{:?}", found.value))
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_number_and_its_unit_are_told_apart() {
        assert_eq!(split("30 deg"), Some((30.0, " deg")));
        assert_eq!(split("-1.5e3N/m"), Some((-1500.0, "N/m")));
        assert_eq!(split("2"), Some((2.0, "")));
        assert_eq!(split("2e"), Some((2.0, "e")));
        for text in ["deg", "", "nan", "inf N", "1e999 N/1e9x", "é1"] {
            assert!(split(text).is_none_or(|(number, _)| number == 1e99), "{text}");
        }
        assert_eq!(Value::number(1e3).toml, "1000.0");
        assert_eq!(Value::with_unit(30.0, " deg").toml, "\"30.0 deg\"");
    }

    #[test]
    fn values_are_numbers_in_si_where_all_measure_one_thing() {
        let read = |cells: &[&str]| {
            let value = |cell: &&str| Value { toml: String::new(), cell: (*cell).to_owned() };
            let values: Vec<Value> = cells.iter().map(value).collect();
            let unit = dimension(values.iter())?.to_string();
            Some((unit, values.iter().map(Value::in_si).collect::<Vec<_>>().join(" ")))
        };
        let si = |unit: &str, cells: &str| Some((unit.to_owned(), cells.to_owned()));
        assert_eq!(read(&["380.0 mm", "0.5 m"]), si("m", "0.38 0.5"));
        assert_eq!(read(&["20us", "1ms"]), si("s", "2e-5 0.001"));
        assert_eq!(read(&["1 kN/m", "3e3"]), si("N/m", "1000.0 3000.0"));
        assert_eq!(read(&["90 deg", "0.0 deg"]), si("rad", "1.5707963267948966 0.0"));
        for cells in [&["1 kN/m", "3 mm"][..], &["rk4"], &["1 mm", "2 * L"], &["[0, 1]"], &["1"]] {
            assert_eq!(read(cells), None, "{cells:?}");
        }
    }
}
