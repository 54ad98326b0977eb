//! A line of a trace and its numbers.
//!
//! `line, names, digits => row; or the column without a number`.

use dbd_plant::number_format::{Digits, NumberFormat};
use dbd_scene::BODY_COLUMNS;

use crate::recorded::row::Row;

/// An error in a line.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct WrongText {
    /// The position in the line, in characters from 1.
    pub column: usize,
    /// The problem.
    pub problem: String,
}

/// The digits of a number of a body, by its column.
#[must_use]
pub fn digits_of(number_format: NumberFormat, column: usize) -> Digits {
    match column {
        0..3 => number_format.position,
        3..7 => number_format.orientation,
        _ => number_format.velocity,
    }
}

/// The names in a line, without the quotes that some need.
#[must_use]
pub fn fields(line: &str) -> Vec<String> {
    let mut reader = csv::ReaderBuilder::new().has_headers(false).from_reader(line.as_bytes());
    let first = reader.records().next().and_then(Result::ok);
    first.map_or(Vec::new(), |names| names.iter().map(str::to_owned).collect())
}

/// Where the field of a number, from 0, begins in a line: characters from 1.
#[must_use]
pub fn place(line: &str, number: usize) -> usize {
    let (mut commas, mut quoted) = (0, false);
    let before = line.chars().take_while(|c| {
        quoted ^= *c == '"';
        let within = commas < number;
        commas += usize::from(*c == ',' && !quoted);
        within
    });
    1 + before.count()
}

/// The error for a line whose names are not separated by commas.
#[must_use]
pub fn separated(line: &str) -> Option<&'static str> {
    if line.contains(',') {
        return None;
    }
    let by = [
        (
            ';',
            "columns must be separated by commas, not semicolons: a spreadsheet has saved this file",
        ),
        (
            '\t',
            "columns must be separated by commas, not tabs: another program has saved this file",
        ),
    ];
    by.into_iter().find(|(mark, _)| line.contains(*mark)).map(|(_, words)| words)
}

/// Reads a line into a row of the given numbers of bodies and values.
///
/// # Errors
/// The first column that is missing, superfluous, or not a number.
pub fn read(
    line: &str,
    names: &[String],
    number_format: NumberFormat,
    row: &mut Row,
) -> Result<(), WrongText> {
    let mut texts = line.split(',');
    let mut next = 0;
    // A state is finite; a read-out may be NaN.
    let mut number = |digits: Digits, finite: bool| -> Result<f64, WrongText> {
        let place = next;
        next += 1;
        let Some(text) = texts.next() else {
            let columns = names.len();
            let problem =
                format!("the line has {place} of {columns} columns: it was truncated or edited");
            return Err(WrongText { column: line.chars().count() + 1, problem });
        };
        let name = names.get(place).map_or("", String::as_str);
        let wrong = |problem: String| {
            let offset = text.as_ptr() as usize - line.as_ptr() as usize;
            WrongText { column: 1 + line[..offset].chars().count(), problem }
        };
        let Some(value) = digits.read(text) else {
            let shown: String = text.chars().take(40).collect();
            let precision = if digits == Digits::Single { " of single precision" } else { "" };
            return Err(wrong(format!(
                "column `{name}`: `{shown}` is not a number{precision} as written in a trace"
            )));
        };
        if finite && !value.is_finite() {
            return Err(wrong(format!(
                "column `{name}`: `{text}` is not finite, as it must be in every row of a trace"
            )));
        }
        Ok(value)
    };
    row.time = number(Digits::Double, true)?;
    for body in &mut row.bodies {
        for (column, value) in body.iter_mut().enumerate() {
            debug_assert!(column < BODY_COLUMNS.len());
            *value = number(digits_of(number_format, column), true)?;
        }
    }
    let mut energies = [0.0; 3];
    for energy in &mut energies {
        *energy = number(Digits::Double, true)?;
    }
    row.energies = Some(energies);
    for value in &mut row.values {
        *value = number(number_format.reading, false)?;
    }
    row.hash = None;
    if texts.next().is_some() {
        let (found, columns) = (line.split(',').count(), names.len());
        let problem = format!("the line has {found} columns, not {columns}: it was edited");
        return Err(WrongText { column: place(line, columns), problem });
    }
    Ok(())
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn names_may_hold_commas_and_quotes() {
        let line = "time,\"a,b.x\",\"q\"\"q\",\u{e9}.x,z";
        assert_eq!(fields(line), ["time", "a,b.x", "q\"q", "\u{e9}.x", "z"]);
        assert_eq!([0, 1, 2, 3, 4].map(|number| place(line, number)), [1, 6, 14, 21, 25]);
        assert!(separated("time;a.x").is_some() && separated("time,a.x;").is_none());
    }

    #[test]
    fn a_line_is_read_to_its_bits_or_its_column_is_named() {
        let number_format = NumberFormat::of_names("f32", "quaternion").unwrap();
        let names: Vec<String> = std::iter::once("time".to_owned())
            .chain(BODY_COLUMNS.map(|end| format!("b{end}")))
            .chain(
                ["energy.kinetic", "energy.potential", "energy.total", "angle"].map(str::to_owned),
            )
            .collect();
        let mut row = Row { bodies: vec![[0.0; 13]], values: vec![0.0], ..Row::default() };
        let good = "0.1,0.1,-0.0,3,1,0,0,0,7,8,9,10,11,12,0.25,1,1.25,NaN";
        read(good, &names, number_format, &mut row).unwrap();
        assert_eq!((row.time, row.bodies[0][0]), (0.1, f64::from(0.1_f32)));
        assert!(row.bodies[0][1].is_sign_negative() && row.values[0].is_nan());
        assert_eq!(row.energies, Some([0.25, 1.0, 1.25]));
        let mut wrong = |from: &str, to: &str| {
            let line = good.replacen(from, to, 1);
            let wrong = read(&line, &names, number_format, &mut row).unwrap_err();
            (wrong.column, wrong.problem)
        };
        assert_eq!(
            wrong(",NaN", ""),
            (50, "the line has 17 of 18 columns: it was truncated or edited".into())
        );
        assert_eq!(
            wrong("NaN", "NaN,"),
            (55, "the line has 19 columns, not 18: it was edited".into())
        );
        let (column, problem) = wrong("-0.0", "-0,0");
        assert_eq!((column, &*problem), (51, "the line has 19 columns, not 18: it was edited"));
        for (text, part) in [
            (
                "nan",
                "column `b.y`: `nan` is not a number of single precision as written in a trace",
            ),
            ("NaN", "column `b.y`: `NaN` is not finite"),
            ("1e39", "column `b.y`: `1e39` is not a number of single precision"),
        ] {
            let (column, problem) = wrong("-0.0", text);
            assert_eq!(column, 9);
            assert!(problem.starts_with(part), "{problem}");
        }
    }
}
