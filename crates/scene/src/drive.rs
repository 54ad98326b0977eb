//! What drives an input: the caller, a table over time, or a source.
//!
//! `keys of [[input]] => drive`. A table over a read-out is read once all read-outs are known, see
//! [`read_over`].

use crate::error::SceneError;
use crate::text::{Choice, Kind, Number, Seconds, Switch, Table, Text, Value};

/// The keys of every input.
pub(crate) const INPUT: &[&str] = &["name", "type"];

/// The keys that say what drives an input.
pub(crate) const KEYS: [&str; 8] =
    ["value", "range", "table", "interpolate", "periodic", "jump", "over", "sine"];

/// The keys of a sine.
pub(crate) const SINE: &[&str] = &["amplitude", "frequency", "phase", "offset"];

/// What drives an input.
#[derive(Clone, Debug, PartialEq)]
pub(crate) enum Drive {
    /// The caller; this value at first.
    Caller(f64),
    /// A table over time.
    Table(Curve),
    /// Amplitude, frequency \[Hz\], phase \[rad\] at t = 0, offset.
    Sine([f64; 4]),
    /// A table over time that repeats; its last knot is the end of the period.
    Periodic(Curve),
    /// A table over a read-out, which is not known yet.
    Over,
}

/// A table of (time or reading, value).
#[derive(Clone, Debug, PartialEq)]
pub(crate) struct Curve {
    /// Ascending, at least one.
    pub(crate) knots: Vec<[f64; 2]>,
    /// Straight lines between the knots instead of steps.
    pub(crate) linear: bool,
}

/// Reads the least and the largest value in `unit` that a caller can set; infinite without `range`.
pub(crate) fn range(
    table: &Table<'_>,
    drive: &Drive,
    unit: &'static str,
) -> Result<[f64; 2], SceneError> {
    let Some(value) = table.value("range") else { return Ok([-f64::INFINITY, f64::INFINITY]) };
    let expected = format!("[least, largest] in {unit}, the second not below the first");
    let entries = value.entries(2, &expected)?;
    let [least, most] = [&entries[0], &entries[1]].map(|entry| Number::any(unit).read(entry));
    let (least, most) = (least?, most?);
    if least > most {
        return Err(value.refuse("is the wrong way round", &expected));
    }
    let Drive::Caller(start) = drive else {
        let help = "it bounds what a caller sets; what the scene drives is as it is written";
        let other = if table.has("sine") { "sine" } else { "table" };
        return Err(table.refuse_key("range", &format!("contradicts `{other}`"), help));
    };
    if !(least..=most).contains(start) {
        let (key, problem) = match table.has("value") {
            true => ("value", "is beyond `range`".to_owned()),
            false => ("range", "does not hold the value 0 at t = 0".to_owned()),
        };
        return Err(table.refuse_key(key, &problem, "a `value` within the range"));
    }
    Ok([least, most])
}

/// Reads what drives an input whose value is in `unit`.
pub(crate) fn read(table: &Table<'_>, unit: &'static str) -> Result<Drive, SceneError> {
    let ways = ["value", "table", "sine"].map(|key| table.has(key));
    if ways.iter().filter(|is_there| **is_there).count() > 1 {
        let help = "a `table` or a `sine` for an input that the scene drives, a `value` for one that \
                    holds until the caller sets it";
        let (key, other) = match ways {
            [true, true, _] => ("value", "table"),
            [true, ..] => ("value", "sine"),
            _ => ("sine", "table"),
        };
        return Err(table.refuse_key(key, &format!("contradicts `{other}`"), help));
    }
    if !table.has("table") {
        for (key, what) in [
            ("interpolate", "says how a `table` goes on between its times"),
            ("periodic", "says that a `table` repeats"),
            ("jump", "lets a periodic `table` end at another value than it begins with"),
            ("over", "names the read-out that a `table` stands over"),
        ] {
            if table.has(key) {
                let help = format!("`{key}` {what}");
                return Err(table.refuse_key(key, "stands without `table`", &help));
            }
        }
        if let Some(sine) = table.value("sine") {
            return Ok(Drive::Sine(self::sine(&sine, unit)?));
        }
        let value = table.optional("value", Number::any(unit))?;
        return Ok(Drive::Caller(value.unwrap_or(0.0)));
    }
    let periodic = table.optional("periodic", Switch)?.unwrap_or_default();
    let jump = table.optional("jump", Switch)?.unwrap_or_default();
    if jump && !periodic {
        let help = "`jump` lets a table with `periodic = true` end at another value than it begins \
                    with";
        return Err(table.refuse_key("jump", "stands without `periodic`", help));
    }
    if table.has("over") {
        table.required("over", Text::Name)?;
        if periodic {
            let help = "a table over time repeats; one over a read-out holds its ends";
            return Err(table.refuse_key("periodic", "contradicts `over`", help));
        }
        return Ok(Drive::Over);
    }
    let curve = curve(table, Argument { unit: "s", name: "time" }, unit)?;
    if !periodic {
        return Ok(Drive::Table(curve));
    }
    let (Some(first), Some(last)) = (curve.knots.first(), curve.knots.last()) else {
        return Ok(Drive::Table(curve));
    };
    if curve.knots.len() < 2 {
        let help = "the last time of a periodic table is the end of its period: at least two times";
        return Err(table.refuse_value("table", "has one time and no period", help));
    }
    if first[1] != last[1] && !jump {
        let problem = format!("ends at {:?} and begins again at {:?}", last[1], first[1]);
        let help = "the last time of a periodic table is the end of its period, at which its first \
                    value acts again: the same value, or `jump = true`";
        return Err(table.refuse_value("table", &problem, help));
    }
    Ok(Drive::Periodic(curve))
}

fn sine(value: &Value<'_>, unit: &'static str) -> Result<[f64; 4], SceneError> {
    let table = value.table("a table: { amplitude = 2, frequency = 50 }")?;
    table.only(&[SINE])?;
    let amplitude = table.required("amplitude", Number::any(unit))?;
    let frequency = table.required("frequency", Number::positive("Hz"))?;
    let phase = table.optional("phase", Number::any("rad"))?.unwrap_or_default();
    let offset = table.optional("offset", Number::any(unit))?.unwrap_or_default();
    Ok([amplitude, frequency, phase, offset])
}

/// Reads a table over something.
pub(crate) fn curve(
    table: &Table<'_>,
    over: Argument,
    unit: &'static str,
) -> Result<Curve, SceneError> {
    let knots = table.required("table", Knots { over, unit })?;
    let interpolate = table.optional("interpolate", Choice(&["held", "linear"]))?;
    Ok(Curve { knots, linear: interpolate == Some(1) })
}

/// What a table stands over.
#[derive(Clone, Copy)]
pub(crate) struct Argument {
    pub(crate) unit: &'static str,
    pub(crate) name: &'static str,
}

/// Pairs of time or reading and value, ascending.
struct Knots {
    over: Argument,
    unit: &'static str,
}

impl Kind for Knots {
    type Output = Vec<[f64; 2]>;

    fn expected(&self) -> String {
        let Argument { unit, name } = self.over;
        format!("an array of [{name} in {unit}, value in {}], ascending in {name}", self.unit)
    }

    fn read(&self, value: &Value<'_>) -> Result<Vec<[f64; 2]>, SceneError> {
        let Argument { unit: over, name } = self.over;
        let mut knots: Vec<[f64; 2]> = Vec::new();
        for entry in value.array(&self.expected())? {
            let expected =
                format!("an array of 2: a {name} in {over} and a value in {}", self.unit);
            let pair = entry.entries(2, &expected)?;
            let argument = if over == "s" { Seconds::any() } else { Number::any(over) };
            let knot = [argument.read(&pair[0])?, Number::any(self.unit).read(&pair[1])?];
            if let Some([last, before]) = knots.last() {
                if knot[0] <= *last {
                    let problem = format!("is at {:?} {over}, not after {last:?} {over}", knot[0]);
                    let help = format!("{name}s ascend from knot to knot");
                    return Err(entry.refuse_with(&problem, help));
                }
                if !((knot[1] - before) / (knot[0] - last)).is_finite() {
                    let problem = "rises faster than a number can say";
                    let help = format!("a smaller value, or a later {name}");
                    return Err(entry.refuse_with(problem, help));
                }
            }
            knots.push(knot);
        }
        if knots.is_empty() {
            return Err(value.refuse("is empty", &self.expected()));
        }
        Ok(knots)
    }
}
