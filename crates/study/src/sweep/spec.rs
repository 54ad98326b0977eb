//! A sweep's file: scene, axes, columns of the table.
//!
//! `text => scene, axes in their order, changes, columns, statistics`. Axes are in the order of the file; in a grid the
//! last varies fastest. A constant is an axis of one value.

use std::ops::Range as Place;
use std::path::Path;

use dbd_scene::file::read_text;
use dbd_scene::{nearest, shortened};
use toml::Spanned;
use toml::de::{DeTable, DeValue};

use crate::sweep::axis::{Axis, Target};
use crate::sweep::random::{Sample, SampleKind};
use crate::sweep::read::{Axes, too_many};
use crate::sweep::refusal::{Refusal, Source, SpecError};
use crate::sweep::statistic::Statistic;
use crate::sweep::text::{array, only, parse, string, whole, wrong_type};
use crate::sweep::value::Value;

/// More cases than this are refused.
pub const MAX_CASES: u64 = 1_000_000;

const KEYS: [&str; 15] = [
    "scene",
    "axes",
    "paired",
    "sample",
    "set",
    "scheme",
    "newton",
    "rho",
    "damping",
    "precision",
    "orientation",
    "step",
    "duration",
    "every",
    "columns",
];
const STATISTICS: &str = "statistics";

/// A text and its position.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct Placed {
    /// The text.
    pub text: String,
    /// Its position in the file.
    pub place: Place<usize>,
}

/// Request of a sweep.
#[derive(Clone, Debug, PartialEq)]
pub struct Spec {
    /// The file.
    pub source: Source,
    /// The scene, as a command line names one.
    pub scene: Placed,
    /// The axes, in the order of the file.
    pub axes: Vec<Axis>,
    /// Constants of all cases: method, step, duration, interval.
    pub fixed: Vec<Axis>,
    /// Changes of the scene that are the same for all cases, each `PATH=VALUE`.
    pub set: Vec<Placed>,
    /// For each axis the first of those that it goes along with, itself where it goes alone.
    pub leaders: Vec<usize>,
    /// The sample, where cases are not a grid.
    pub sample: Option<Sample>,
    /// Columns of a trace by name, with wildcards; sensors and energies if empty.
    pub columns: Vec<Placed>,
    /// Statistics of each column.
    pub statistics: Vec<Statistic>,
}

impl Spec {
    /// Reads a file.
    ///
    /// # Errors
    /// Where it cannot be read or is refused.
    pub fn load(path: &Path) -> Result<Self, SpecError> {
        let file = path.display().to_string();
        match read_text(path) {
            Ok(text) => Ok(Self::parse(&text, &file)?),
            Err(reason) => Err(SpecError::Unreadable { file, reason }),
        }
    }

    /// Reads a text; `file` is its name in messages.
    ///
    /// # Errors
    /// If it is invalid.
    pub fn parse(text: &str, file: &str) -> Result<Self, Box<Refusal>> {
        let source = Source { file: file.to_owned(), text: text.into() };
        let table = parse(&source)?;
        only(&source, &table, "a sweep", &[&KEYS[..], &[STATISTICS]].concat())?;
        let whole_file = 0..text.len().min(1);
        let Some(scene) = table.get("scene") else {
            let help =
                "add `scene`: a scene by name, or a path to a .toml file from this file's folder";
            return Err(source.refuse(whole_file, "the sweep has no `scene`", help));
        };
        let expected = "a scene by name, or a path to a .toml file from this file's folder";
        let scene_text = string(&source, scene, "`scene`", expected)?.to_owned();
        let sample = table.get("sample").map(|sample| read_sample(&source, sample)).transpose()?;
        let mut axes = Vec::new();
        match table.get("axes") {
            Some(value) => {
                let DeValue::Table(of_axes) = value.get_ref() else {
                    let expected = "a table [axes] of the varied quantities and their values";
                    return Err(wrong_type(&source, value, "`axes`", expected));
                };
                let most = MAX_CASES;
                Axes { source: &source, sample, most }.read(of_axes, None, &mut axes)?;
            }
            None => {
                let help = "add a table [axes] of the varied quantities: \"joint.crank.stiffness\" = [1e5, 1e6]";
                return Err(source.refuse(whole_file, "the sweep has no `axes`", help));
            }
        }
        if axes.is_empty() {
            let place = table.get("axes").map_or(whole_file, Spanned::span);
            let help = "add one axis or more: \"joint.crank.stiffness\" = [1e5, 1e6]";
            return Err(source.refuse(place, "the table [axes] is empty", help));
        }
        let fixed = read_fixed(&source, &table)?;
        for axis in &axes {
            if fixed.iter().any(|other| other.path == axis.path) {
                let message = format!("`{}` is both an axis and a fixed value", axis.path);
                return Err(source.refuse(axis.place.clone(), message, "remove one of the two"));
            }
        }
        for axis in axes.iter().chain(&fixed) {
            check_choices(&source, axis)?;
        }
        let leaders = read_pairs(&source, &table, &axes, sample.is_some())?;
        let statistics = read_statistics(&source, &table)?;
        let spec = Self {
            scene: Placed { text: scene_text, place: scene.span() },
            set: read_texts(&source, &table, "set", "changes, each \"PATH=VALUE\" in quotes")?,
            columns: read_texts(&source, &table, "columns", "names of columns in quotes")?,
            statistics,
            source: source.clone(),
            axes,
            fixed,
            leaders,
            sample,
        };
        let cases = spec.count();
        if cases > u128::from(MAX_CASES) {
            let place = table.get("axes").map_or(whole_file, Spanned::span);
            return Err(too_many(&source, place, cases, MAX_CASES));
        }
        Ok(spec)
    }

    /// How many cases there are.
    #[must_use]
    pub fn count(&self) -> u128 {
        if let Some(sample) = self.sample {
            return sample.count as u128;
        }
        let alone = self.axes.iter().zip(&self.leaders).enumerate();
        let alone = alone.filter(|(row, (_, leader))| row == *leader);
        alone.fold(1, |all, (_, (axis, _))| all.saturating_mul(axis.values.len() as u128))
    }
}

fn check_choices(source: &Source, axis: &Axis) -> Result<(), Box<Refusal>> {
    for (value, place) in &axis.tried {
        if let Some(expected) = axis.target.misfit(&value.cell) {
            let cell = shortened(&value.cell);
            let message = format!("there is no {} `{cell}`", axis.path);
            let help = format!("`{}` is {expected}", axis.path);
            return Err(source.refuse(place.clone(), message, help));
        }
    }
    Ok(())
}

/// Constants of all cases.
fn read_fixed(source: &Source, table: &DeTable<'_>) -> Result<Vec<Axis>, Box<Refusal>> {
    let mut fixed = Vec::new();
    let method = Target::OF_METHOD.iter().map(|(name, _)| *name);
    for key in method.chain(["step", "duration", "every"]) {
        let Some((name, value)) = table.get_key_value(key) else { continue };
        if matches!(value.get_ref(), DeValue::Array(_) | DeValue::Table(_)) {
            let what = format!("`{key}`");
            let expected = "one value here; put varied quantities in [axes]";
            return Err(wrong_type(source, value, &what, expected));
        }
        let one = Value::of(source, value);
        fixed.push(Axis {
            path: key.to_owned(),
            place: name.span(),
            target: Target::of(key),
            values: vec![one.clone()],
            tried: vec![(one, value.span())],
            logarithmic: false,
        });
    }
    Ok(fixed)
}

fn read_sample(source: &Source, value: &Spanned<DeValue<'_>>) -> Result<Sample, Box<Refusal>> {
    let expected = "{ kind = \"random\" or \"latin-hypercube\", count = 100, seed = 1 }";
    let DeValue::Table(table) = value.get_ref() else {
        return Err(wrong_type(source, value, "`sample`", expected));
    };
    only(source, table, "`sample`", &["kind", "count", "seed"])?;
    let get = |key: &str| {
        table.get(key).ok_or_else(|| {
            let help = format!("it is {expected}");
            source.refuse(value.span(), format!("`sample` has no `{key}`"), help)
        })
    };
    let kind = get("kind")?;
    let kinds = "\"random\" or \"latin-hypercube\"";
    let kind = match string(source, kind, "`kind` of `sample`", kinds)? {
        "random" => SampleKind::Random,
        "latin-hypercube" => SampleKind::LatinHypercube,
        other => {
            let message = format!("there is no sample of the kind \"{}\"", shortened(other));
            return Err(source.refuse(kind.span(), message, kinds));
        }
    };
    let count = get("count")?;
    let number = whole(source, count, "`count` of `sample`", "a whole number from 1")?;
    if number == 0 {
        return Err(source.refuse(count.span(), "the sample has no cases", "give 1 case or more"));
    }
    if number > MAX_CASES {
        return Err(too_many(source, count.span(), u128::from(number), MAX_CASES));
    }
    let seed = whole(source, get("seed")?, "`seed` of `sample`", "a whole number from 0")?;
    Ok(Sample { kind, count: number as usize, seed })
}

/// Texts of a list.
fn read_texts(
    source: &Source,
    table: &DeTable<'_>,
    key: &str,
    expected: &str,
) -> Result<Vec<Placed>, Box<Refusal>> {
    let Some(value) = table.get(key) else { return Ok(Vec::new()) };
    let what = format!("`{key}`");
    let expected = format!("a list of {expected}");
    let placed = |entry: &Spanned<DeValue<'_>>| {
        let text = string(source, entry, &format!("an entry of {what}"), "a text in quotes")?;
        Ok(Placed { text: text.to_owned(), place: entry.span() })
    };
    array(source, value, &what, &expected)?.into_iter().map(placed).collect()
}

fn read_statistics(source: &Source, table: &DeTable<'_>) -> Result<Vec<Statistic>, Box<Refusal>> {
    let texts = read_texts(source, table, STATISTICS, "statistics in quotes")?;
    if texts.is_empty() {
        return Ok(Statistic::ALL.to_vec());
    }
    let names = || Statistic::ALL.iter().map(|statistic| statistic.name());
    let mut statistics = Vec::new();
    for Placed { text, place } in texts {
        let Some(found) = Statistic::ALL.iter().find(|known| known.name() == text) else {
            let meant = nearest(&text, names()).map(|meant| format!("did you mean {meant}? "));
            let known = names().collect::<Vec<_>>().join(", ");
            let help = format!("{}the statistics are {known}", meant.unwrap_or_default());
            let message = format!("there is no statistic `{}`", shortened(&text));
            return Err(source.refuse(place, message, help));
        };
        if !statistics.contains(found) {
            statistics.push(*found);
        }
    }
    Ok(statistics)
}

/// For each axis the first of those that it goes along with.
fn read_pairs(
    source: &Source,
    table: &DeTable<'_>,
    axes: &[Axis],
    is_sample: bool,
) -> Result<Vec<usize>, Box<Refusal>> {
    let mut leaders: Vec<usize> = (0..axes.len()).collect();
    let Some(value) = table.get("paired") else { return Ok(leaders) };
    if is_sample {
        let help = "remove one of the two: in a sample every axis varies independently";
        return Err(source.refuse(value.span(), "`paired` requires a grid, not a sample", help));
    }
    let expected = "a list of lists of axes that vary together: [[\"a.b.c\", \"d.e.f\"]]";
    let mut seen: Vec<usize> = Vec::new();
    for group in array(source, value, "`paired`", expected)? {
        let mut leader: Option<usize> = None;
        for entry in array(source, group, "an entry of `paired`", expected)? {
            let path = string(source, entry, "an axis in `paired`", "an axis in quotes")?;
            let Some(row) = axes.iter().position(|axis| axis.path == path) else {
                let names = || axes.iter().map(|axis| axis.path.as_str());
                let meant = nearest(path, names()).map(|meant| format!("did you mean {meant}? "));
                let known = names().collect::<Vec<_>>().join(", ");
                let help = format!("{}the axes are {known}", meant.unwrap_or_default());
                let message = format!("there is no axis `{}`", shortened(path));
                return Err(source.refuse(entry.span(), message, help));
            };
            if seen.contains(&row) {
                let message = format!("the axis `{path}` is paired twice");
                return Err(source.refuse(
                    entry.span(),
                    message,
                    "name each axis in one group only",
                ));
            }
            seen.push(row);
            let first = *leader.get_or_insert(row);
            let [long, short] = [first, row].map(|row| axes[row].values.len());
            if long != short {
                let message = format!(
                    "the axis `{path}` has {short} values, and `{}` {long}",
                    axes[first].path
                );
                let help = "give axes that vary together the same number of values";
                return Err(source.refuse(entry.span(), message, help));
            }
            leaders[row] = first;
        }
    }
    // The first in the order of the file leads.
    let first_of = |leader: usize| leaders.iter().position(|other| *other == leader);
    Ok(leaders.iter().map(|leader| first_of(*leader).unwrap_or(*leader)).collect())
}
