//! The drive of an input: the caller, a table over time, or a source.
//!
//! `keys of [[input]] => drive`. A table over a read-out is read once all read-outs are known, see
//! [`read_over`].

use crate::error::SceneError;
use crate::text::{Choice, Kind, Number, Seconds, Switch, Table, Text, Value};

/// The keys of every input.
pub(crate) const INPUT: &[&str] = &["name", "type"];

/// The keys of the drive of an input.
pub(crate) const KEYS: [&str; 8] =
    ["value", "range", "table", "interpolate", "periodic", "jump", "over", "sine"];

/// The keys of a sine.
pub(crate) const SINE: &[&str] = &["amplitude", "frequency", "phase", "offset"];

/// The drive of an input.
#[derive(Clone, Debug, PartialEq)]
pub(crate) enum Drive {
    /// The caller, with this initial value.
    Caller(f64),
    /// A table over time.
    Table(Curve),
    /// Amplitude, frequency \[Hz\], phase \[rad\] at t = 0, offset.
    Sine([f64; 4]),
    /// A table over time that repeats; its last knot is the end of the period.
    Periodic(Curve),
    /// A table over a read-out, which is resolved later.
    Over,
}

impl Drive {
    /// Its value at t = 0; 0 over a read-out.
    pub(crate) fn start(&self) -> f64 {
        match self {
            Self::Caller(value) => *value,
            Self::Table(curve) => curve.at(0.0),
            Self::Sine([amplitude, _, phase, offset]) => offset + amplitude * libm::sin(*phase),
            Self::Periodic(curve) => {
                let [[first, _], .., [last, _]] = curve.knots[..] else { return 0.0 };
                curve.at(first + (-first).rem_euclid(last - first))
            }
            Self::Over => 0.0,
        }
    }

    /// Its smallest value; 0 over a read-out.
    pub(crate) fn least(&self) -> f64 {
        match self {
            Self::Caller(value) => *value,
            Self::Table(curve) | Self::Periodic(curve) => curve.least(),
            Self::Sine([amplitude, _, _, offset]) => offset - amplitude.abs(),
            Self::Over => 0.0,
        }
    }
}

impl Curve {
    /// Its smallest value.
    pub(crate) fn least(&self) -> f64 {
        self.knots.iter().fold(f64::INFINITY, |least, knot| least.min(knot[1]))
    }

    fn at(&self, x: f64) -> f64 {
        let next = self.knots.partition_point(|knot| knot[0] <= x);
        let before = next.checked_sub(1).and_then(|row| self.knots.get(row));
        match (before, self.knots.get(next)) {
            (Some([x0, y0]), Some([x1, y1])) if self.linear => {
                y0 + (y1 - y0) / (x1 - x0) * (x - x0)
            }
            (Some([_, y]), _) | (None, Some([_, y])) => *y,
            (None, None) => 0.0,
        }
    }
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
    let expected = || format!("[lower, upper] in {unit}, with lower ≤ upper");
    let entries = value.entries(2, expected)?;
    let [least, most] = [&entries[0], &entries[1]].map(|entry| Number::any(unit).read(entry));
    let (least, most) = (least?, most?);
    if least > most {
        return Err(value.refuse("has its bounds in the wrong order", &expected()));
    }
    let Drive::Caller(start) = drive else {
        let help = "remove `range`: it limits the values that a caller sets, not those that the scene drives";
        let other = if table.has("sine") { "sine" } else { "table" };
        return Err(table.refuse_key("range", &format!("contradicts `{other}`"), help));
    };
    if !(least..=most).contains(start) {
        let (key, problem) = match table.has("value") {
            true => ("value", "is outside `range`".to_owned()),
            false => ("range", "does not contain the value 0 at t = 0".to_owned()),
        };
        return Err(table.refuse_key(key, &problem, "give a `value` within the range"));
    }
    Ok([least, most])
}

/// Reads the drive of an input with a value in `unit`.
pub(crate) fn read(table: &Table<'_>, unit: &'static str) -> Result<Drive, SceneError> {
    let ways = ["value", "table", "sine"].map(|key| table.has(key));
    if ways.iter().filter(|is_there| **is_there).count() > 1 {
        let help = "give a `table` or a `sine` for an input that the scene drives, a `value` for one \
                    that the caller sets";
        let (key, other) = match ways {
            [true, true, _] => ("value", "table"),
            [true, ..] => ("value", "sine"),
            _ => ("sine", "table"),
        };
        return Err(table.refuse_key(key, &format!("contradicts `{other}`"), help));
    }
    if !table.has("table") {
        for (key, what) in [
            ("interpolate", "selects the interpolation of a `table`"),
            ("periodic", "makes a `table` repeat"),
            ("jump", "allows a periodic `table` to end at another value than its first"),
            ("over", "names the read-out that a `table` depends on"),
        ] {
            if table.has(key) {
                let help = format!("`{key}` {what}");
                return Err(table.refuse_key(key, "requires `table`", &help));
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
        let help =
            "`jump` allows a table with `periodic = true` to end at another value than its first";
        return Err(table.refuse_key("jump", "requires `periodic = true`", help));
    }
    if table.has("over") {
        table.required("over", Text::Name)?;
        if periodic {
            let help =
                "only a table over time can repeat; a table over a read-out holds its end values";
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
        let help = "give at least two times; the last one is the end of the period";
        return Err(table.refuse_value("table", "has only one time and therefore no period", help));
    }
    if first[1] != last[1] && !jump {
        let problem = format!("ends at {:?} but restarts at {:?}", last[1], first[1]);
        let help = "give the first value at the last time, which is the end of the period, or set `jump = true`";
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

/// Reads a table over time or a read-out.
pub(crate) fn curve(
    table: &Table<'_>,
    over: Argument,
    unit: &'static str,
) -> Result<Curve, SceneError> {
    let knots = table.required("table", Knots { over, unit })?;
    let interpolate = table.optional("interpolate", Choice(&["held", "linear"]))?;
    Ok(Curve { knots, linear: interpolate == Some(1) })
}

/// The argument of a table.
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
        for entry in value.array(|| self.expected())? {
            let expected =
                || format!("an array of 2: a {name} in {over} and a value in {}", self.unit);
            let pair = entry.entries(2, expected)?;
            let argument = if over == "s" { Seconds::any() } else { Number::any(over) };
            let knot = [argument.read(&pair[0])?, Number::any(self.unit).read(&pair[1])?];
            if let Some([last, before]) = knots.last() {
                if knot[0] <= *last {
                    let problem = format!("is at {:?} {over}, not after {last:?} {over}", knot[0]);
                    let help = format!("give knots in ascending order of {name}");
                    return Err(entry.refuse_with(&problem, help));
                }
                if !((knot[1] - before) / (knot[0] - last)).is_finite() {
                    let problem = "has a slope out of the range of double precision";
                    let help = format!("use a smaller value or a larger {name}");
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
