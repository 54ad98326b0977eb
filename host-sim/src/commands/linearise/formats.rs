//! A linear system as a file: JSON, CSV, MATLAB source.
//!
//! `report => text`. Each begins with a head of its own, by which a file of this command is recognised.

use dbd_plant::instance::Linear;
use nalgebra::DMatrix;
use serde::Serialize;

use crate::commands::linearise::report::{LinearReport, Pole, Quantity};
use crate::report::SetValue;
use crate::terminal::text::json;

/// The format of a file.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Format {
    /// One object; matrices are arrays of rows.
    Json,
    /// One line per entry: matrix, name of the row, name of the column, value.
    Csv,
    /// Assignments that MATLAB and GNU Octave run.
    Matlab,
}

impl Format {
    /// The format of a file's ending.
    #[must_use]
    pub fn of_ending(ending: &str) -> Option<Self> {
        match ending {
            "json" => Some(Self::Json),
            "csv" => Some(Self::Csv),
            "m" => Some(Self::Matlab),
            _ => None,
        }
    }

    /// How a file begins.
    #[must_use]
    pub fn head(self) -> &'static str {
        match self {
            Self::Json => "{\n  \"command\": \"linearise\",\n",
            Self::Csv => "matrix,row,column,value\n",
            Self::Matlab => "% host-sim linearise",
        }
    }

    /// The whole file.
    #[must_use]
    pub fn text(self, report: &LinearReport) -> String {
        match self {
            Self::Json => whole_json(report),
            Self::Csv => csv(&report.linear),
            Self::Matlab => matlab(report),
        }
    }
}

fn whole_json(report: &LinearReport) -> String {
    #[derive(Serialize)]
    struct Whole<'r> {
        command: &'static str,
        scene: &'r str,
        scene_file: &'r str,
        scene_hash: &'r str,
        #[serde(skip_serializing_if = "<[_]>::is_empty")]
        set: &'r [SetValue],
        time: f64,
        states: &'r [Quantity],
        inputs: &'r [Quantity],
        outputs: &'r [Quantity],
        #[serde(rename = "A")]
        a: Vec<Vec<f64>>,
        #[serde(rename = "B")]
        b: Vec<Vec<f64>>,
        #[serde(rename = "C")]
        c: Vec<Vec<f64>>,
        #[serde(rename = "D")]
        d: Vec<Vec<f64>>,
        drift: &'r [f64],
        poles: &'r [Pole],
        slowest_left_out: f64,
    }
    let rows = |matrix: &DMatrix<f64>| {
        matrix.row_iter().map(|row| row.iter().copied().collect()).collect::<Vec<_>>()
    };
    let Linear { a, b, c, d, drift, slowest_left_out, .. } = &report.linear;
    let [scene_file, scene_hash] = &report.source;
    json(&Whole {
        command: "linearise",
        scene: &report.scene,
        scene_file,
        scene_hash,
        set: &report.set,
        time: report.time,
        states: &report.states,
        inputs: &report.inputs,
        outputs: &report.outputs,
        a: rows(a),
        b: rows(b),
        c: rows(c),
        d: rows(d),
        drift: drift.as_slice(),
        poles: &report.poles,
        slowest_left_out: *slowest_left_out,
    })
}

fn csv(linear: &Linear) -> String {
    let Linear { a, b, c, d, drift, states, inputs, outputs, .. } = linear;
    let drift = DMatrix::from_column_slice(drift.len(), 1, drift.as_slice());
    let none = [String::new()];
    [
        Format::Csv.head().to_owned(),
        entries("A", a, states, states),
        entries("B", b, states, inputs),
        entries("C", c, outputs, states),
        entries("D", d, outputs, inputs),
        entries("drift", &drift, states, &none),
    ]
    .concat()
}

/// A line per entry of a matrix.
fn entries(name: &str, matrix: &DMatrix<f64>, rows: &[String], columns: &[String]) -> String {
    let mut text = String::new();
    for (row, of) in rows.iter().enumerate() {
        for (column, by) in columns.iter().enumerate() {
            let value = format!("{:?}", matrix[(row, column)]);
            text += &([name, of, by, &value].map(quoted).join(",") + "\n");
        }
    }
    text
}

/// A cell of CSV (RFC 4180).
fn quoted(cell: &str) -> String {
    match cell.contains([',', '"', '\n', '\r']) {
        true => format!("\"{}\"", cell.replace('"', "\"\"")),
        false => cell.to_owned(),
    }
}

fn matlab(report: &LinearReport) -> String {
    let Linear { a, b, c, d, drift, states, inputs, outputs, slowest_left_out } = &report.linear;
    let drift = DMatrix::from_column_slice(drift.len(), 1, drift.as_slice());
    let scene = report.scene.replace(['\n', '\r'], " ");
    let mut text = format!("{} {scene}, t = {:?} s\n", Format::Matlab.head(), report.time);
    text += "% x' = drift + A*x + B*u, y = y0 + C*x + D*u; sys = ss(A, B, C, D)\n";
    for (name, matrix) in [("A", a), ("B", b), ("C", c), ("D", d), ("drift", &drift)] {
        text += &format!("{name} = {};\n", matrix_text(matrix));
    }
    for (name, all) in [("states", states), ("inputs", inputs), ("outputs", outputs)] {
        let quoted = all.iter().map(|name| format!("'{}'", name.replace('\'', "''")));
        text += &format!("{name} = {{{}}};\n", quoted.collect::<Vec<_>>().join(", "));
    }
    let left_out = match slowest_left_out.is_finite() {
        true => format!("{slowest_left_out:?}"),
        false => "Inf".to_owned(),
    };
    text + &format!("slowest_left_out = {left_out};\n")
}

fn matrix_text(matrix: &DMatrix<f64>) -> String {
    if matrix.is_empty() {
        return format!("zeros({}, {})", matrix.nrows(), matrix.ncols());
    }
    let rows = matrix.row_iter().map(|row| {
        let values: Vec<String> = row.iter().map(|value| format!("{value:?}")).collect();
        format!("  {}\n", values.join(", "))
    });
    format!("[\n{}]", rows.collect::<String>())
}
