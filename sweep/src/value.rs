//! What an axis may hold: one value as the scene takes it and as the table shows it.
//!
//! `TOML value => text after PATH=, cell`. A number is written in one way whatever it was in the file, so
//! that 1e3 and 1000.0 are one case; any other value stays as it is written.

use dbd_plant::time::Time;
use toml::Spanned;
use toml::de::DeValue;

use crate::refusal::Source;

/// A value of an axis.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct Value {
    /// As a change of the scene has it after `PATH=`: TOML.
    pub toml: String,
    /// As the table shows it.
    pub cell: String,
}

impl Value {
    /// A number.
    #[must_use]
    pub fn number(number: f64) -> Self {
        let text = format!("{number:?}");
        Self { toml: text.clone(), cell: text }
    }

    /// A number with what stands behind it, a unit with its blank: a text to TOML.
    #[must_use]
    pub fn with_unit(number: f64, unit: &str) -> Self {
        let cell = format!("{number:?}{unit}");
        Self { toml: format!("\"{cell}\""), cell }
    }

    /// What stands in a file.
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
                // The scene says what is wrong with it.
                _ => Self { toml: written.clone(), cell: written },
            },
            DeValue::String(text) => Self { cell: text.as_ref().to_owned(), toml: written },
            _ => Self { toml: written.clone(), cell: written },
        }
    }
}

/// A number and what stands behind it, blanks included: `30 deg`.
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

/// Values as numbers, where all are such, and their unit: plain numbers, times in seconds, or numbers
/// before one and the same unit.
#[must_use]
pub fn numbers<'c>(cells: impl Iterator<Item = &'c str> + Clone) -> Option<(Vec<f64>, String)> {
    let plain = cells.clone().map(|cell| cell.parse().ok().filter(|n: &f64| n.is_finite()));
    if let Some(plain) = plain.collect() {
        return Some((plain, String::new()));
    }
    let times = cells.clone().map(|cell| cell.parse::<Time>().ok().map(Time::seconds));
    if let Some(times) = times.collect() {
        return Some((times, "s".into()));
    }
    let parts: Vec<(f64, &str)> = cells.map(split).collect::<Option<_>>()?;
    let unit = parts.first()?.1;
    let same = parts.iter().all(|(_, other)| *other == unit);
    same.then(|| (parts.iter().map(|(number, _)| *number).collect(), unit.trim().to_owned()))
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
    fn values_are_numbers_where_all_are() {
        let numbers = |cells: &[&str]| numbers(cells.iter().copied());
        assert_eq!(numbers(&["1", "2.5"]), Some((vec![1.0, 2.5], String::new())));
        assert_eq!(numbers(&["20us", "1ms"]), Some((vec![2e-5, 1e-3], "s".into())));
        assert_eq!(numbers(&["1 kN/m", "3 kN/m"]), Some((vec![1.0, 3.0], "kN/m".into())));
        for cells in [&["1 kN/m", "3 N/m"][..], &["rk4"], &["1", "rk4"], &["[0, 1]"]] {
            assert_eq!(numbers(cells), None, "{cells:?}");
        }
    }
}
