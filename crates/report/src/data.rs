//! Data of the page, embedded as JSON.
//!
//! The page's scripts read this format; an incompatible change increments [`FORMAT`]. Large arrays are packed; plain
//! numbers that are not finite are null.

use crate::picture::Mechanism;
use crate::picture::mechanism::Place;
use serde::{Serialize, Serializer};
use serde_json::Value;

use crate::packed::{F32s, F64s, I16s};

/// The format of the data.
pub const FORMAT: u32 = 1;

/// All that a page is made from.
#[derive(Clone, Debug, PartialEq, Serialize)]
#[serde(rename_all = "camelCase")]
pub struct Data {
    /// [`FORMAT`].
    pub format: u32,
    /// Subject of the page.
    pub kind: Kind,
    /// Its title.
    pub name: String,
    /// Description of the scene, free text; may be empty.
    pub description: String,
    /// One run; two of a comparison.
    pub runs: Vec<Run>,
    /// First run less second, of a comparison.
    #[serde(skip_serializing_if = "Vec::is_empty")]
    pub differences: Vec<Chart>,
    /// \[s\] the times of the differences.
    #[serde(skip_serializing_if = "no_times")]
    pub difference_times: F64s,
    /// Where two runs first differ; `None` where they never do, or there is one.
    pub first_difference: Option<FirstDifference>,
    /// Shapes in which the mechanism swings; may be empty.
    #[serde(skip_serializing_if = "Vec::is_empty")]
    pub modes: Vec<Mode>,
    /// Content readable without scripts; embedded as HTML instead.
    #[serde(skip)]
    pub text: Text,
}

impl Data {
    /// A page about one run; its text is yet to come.
    #[must_use]
    pub fn of_run(name: &str, description: &str, run: Run) -> Self {
        Self {
            format: FORMAT,
            kind: Kind::Run,
            name: name.into(),
            description: description.into(),
            runs: vec![run],
            differences: Vec::new(),
            difference_times: F64s::default(),
            first_difference: None,
            modes: Vec::new(),
            text: Text::default(),
        }
    }
}

/// Subject of a page.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Serialize)]
#[serde(rename_all = "lowercase")]
pub enum Kind {
    /// One run.
    Run,
    /// Two of them.
    Compare,
}

/// The parts of a page that people read without scripts.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct Text {
    /// Why a run failed, a sentence each, without the last full stop.
    pub failures: Vec<String>,
    /// Warnings.
    pub warnings: Vec<String>,
    /// The mechanism as SVG at t = 0; `None` where it would be too large.
    pub picture: Option<String>,
    /// The tables at the foot of the page, in order: summary, versions.
    pub tables: Vec<Table>,
    /// Command lines that reproduce it, each with its result; empty for the only one.
    pub commands: Vec<(String, String)>,
    /// Paragraphs below the commands.
    pub notes: Vec<String>,
    /// Result of a study of the same scene, if available.
    pub survey: Option<Survey>,
}

/// Result of a study of accuracy against speed.
#[derive(Clone, Debug, Default, PartialEq, Eq)]
pub struct Survey {
    /// Choices: a sentence without its last full stop and a command line each.
    pub advice: Vec<(String, String)>,
    /// Its chart as SVG; `None` where it would be too large.
    pub chart: Option<String>,
    /// The file with all results.
    pub page: String,
}

/// A table of text.
#[derive(Clone, Debug, Default, PartialEq, Eq)]
pub struct Table {
    /// Its heading.
    pub title: String,
    /// Column headings, including the first; empty for none.
    pub columns: Vec<String>,
    /// Its rows, each starting with its name.
    pub rows: Vec<Vec<String>>,
}

/// A run.
#[derive(Clone, Debug, Default, PartialEq, Serialize)]
#[serde(rename_all = "camelCase")]
pub struct Run {
    /// Its name among others on the same page; empty for the only one.
    pub label: String,
    /// The mechanism at t = 0, with numbers rounded below visibility.
    #[serde(serialize_with = "rounded")]
    pub mechanism: Option<Mechanism>,
    /// How it moved; `None` where nothing was seen of it.
    pub film: Option<Film>,
    /// \[s\] the times of all charts.
    pub times: F64s,
    /// Where charts show less than was sampled.
    pub thinned: Option<Thinned>,
    /// Bodies of which there is no chart; 0 where all have theirs.
    #[serde(skip_serializing_if = "is_zero")]
    pub bodies_left_out: usize,
    /// Joints of which there is no chart.
    #[serde(skip_serializing_if = "is_zero")]
    pub joints_left_out: usize,
    /// Curves over time.
    pub charts: Vec<Chart>,
}

/// How much was thinned.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Serialize)]
pub struct Thinned {
    /// Samples of the run.
    pub samples: u64,
    /// Points of a curve.
    pub points: usize,
}

/// How a mechanism moved: frames, each with all bodies.
#[derive(Clone, Debug, Default, PartialEq, Serialize)]
#[serde(rename_all = "camelCase")]
pub struct Film {
    /// \[s\] one per frame.
    pub times: F64s,
    /// Bodies in a frame.
    pub bodies: usize,
    /// \[m\] the least coordinates of all bodies in all frames.
    pub low: [f64; 3],
    /// \[m\] the largest.
    pub high: [f64; 3],
    /// Frame by frame, body by body: x, y, z as `low + (v + 32767)/65534·(high − low)`, then the unit
    /// quaternion, scalar first, body → world, as `v/32767`.
    pub poses: I16s,
    /// \[N\] frame by frame the tensions of the mechanism's springs; they pull where positive.
    pub springs: F32s,
    /// Frame by frame and joint by joint \[N\] the force on its second body and \[m\] the largest
    /// extension of its elements.
    pub joints: F32s,
    /// \[N\] frame by frame the tensions of the joints' springs; empty where they are too many.
    #[serde(skip_serializing_if = "no_numbers")]
    pub joint_springs: F32s,
    /// \[N, N·m, m\] frame by frame the values of the mechanism's forces.
    pub forces: F32s,
    /// Points with a drawn path.
    pub traces: Vec<Trace>,
}

/// A point whose path can be drawn.
#[derive(Clone, Debug, PartialEq, Serialize)]
pub struct Trace {
    /// Name.
    pub name: String,
    /// Where it is.
    pub place: Place,
}

/// Section of a chart.
#[derive(Clone, Copy, Debug, PartialEq, Eq, PartialOrd, Ord, Serialize)]
#[serde(rename_all = "lowercase")]
pub enum Section {
    /// Sensors.
    Readouts,
    /// Inputs.
    Inputs,
    /// Its energies.
    Energy,
    /// Deflections and forces of its joints.
    Joints,
    /// Positions, rotations and speeds of its bodies.
    Motion,
}

/// Curves in one pair of axes.
#[derive(Clone, Debug, PartialEq, Serialize)]
pub struct Chart {
    /// Its section.
    pub section: Section,
    /// Its heading.
    pub title: String,
    /// Title of its axis, before the unit.
    pub quantity: String,
    /// The unit, without a prefix.
    pub unit: String,
    /// The row of the body that it is about.
    pub body: Option<usize>,
    /// The row of the joint that it is about.
    pub joint: Option<usize>,
    /// Its curves.
    pub lines: Vec<Line>,
}

/// A curve.
#[derive(Clone, Debug, PartialEq, Serialize)]
pub struct Line {
    /// Its name among its neighbours; may be empty.
    pub name: String,
    /// One value per time of the run; none where it is still.
    #[serde(skip_serializing_if = "no_numbers")]
    pub values: F32s,
    /// Its value in the first sample.
    pub initial: f64,
    /// Whether the values are differences from the initial one.
    pub deviation: bool,
    /// Whether it never moved.
    pub still: bool,
    /// Its least value in all samples, a difference where the values are.
    pub low: f64,
    /// Its largest.
    pub high: f64,
}

/// Where two runs first differ.
#[derive(Clone, Debug, PartialEq, Serialize)]
pub struct FirstDifference {
    /// \[s\] the time.
    pub time: f64,
    /// The step.
    pub step: u64,
    /// The differences as text.
    pub text: String,
}

/// A shape in which a mechanism swings.
#[derive(Clone, Debug, PartialEq, Serialize)]
pub struct Mode {
    /// \[Hz\] its frequency; negative where it grows instead.
    pub frequency: f64,
    /// Per body the translation \[m\] in world axes and the rotation \[rad\] about the body's axes, the largest 1.
    pub shape: F32s,
}

/// Significant digits of a mechanism's numbers, and those of one with many bodies.
const DIGITS: [usize; 2] = [7, 5];
const MANY: usize = 1000;

/// With numbers that are as short as they may be.
fn rounded<S: Serializer>(mechanism: &Option<Mechanism>, to: S) -> Result<S::Ok, S::Error> {
    let mut value = serde_json::to_value(mechanism).map_err(serde::ser::Error::custom)?;
    let many = mechanism.as_ref().is_some_and(|mechanism| mechanism.bodies.len() > MANY);
    shorten(&mut value, DIGITS[usize::from(many)]);
    value.serialize(to)
}

fn shorten(value: &mut Value, digits: usize) {
    match value {
        Value::Array(values) => values.iter_mut().for_each(|value| shorten(value, digits)),
        Value::Object(values) => values.values_mut().for_each(|value| shorten(value, digits)),
        Value::Number(number) if number.is_f64() => {
            let exact = number.as_f64().unwrap_or_default();
            let short = format!("{exact:.*e}", digits - 1).parse().unwrap_or(exact);
            // A whole number needs no point.
            if short == short.trunc() && short.abs() < 1e15 {
                *value = Value::from(short as i64);
            } else {
                *value = Value::from(short);
            }
        }
        _ => {}
    }
}

fn no_times(times: &F64s) -> bool {
    times.0.is_empty()
}

fn no_numbers(numbers: &F32s) -> bool {
    numbers.0.is_empty()
}

#[expect(clippy::trivially_copy_pass_by_ref, reason = "as serde calls it")]
fn is_zero(number: &usize) -> bool {
    *number == 0
}
