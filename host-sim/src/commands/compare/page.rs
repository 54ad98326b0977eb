//! The page of a comparison: both runs, their differences, the first difference.
//!
//! `comparison, scenes, rows => data => HTML`. The rows are read a second time, one run after the other, so that runs of
//! any length fit into memory.

use std::path::Path;

use dbd_golden::Quantity as BodyQuantity;
use dbd_plant::time::display;
use dbd_report::curves::Curves;
use dbd_report::data::{Data, FORMAT, FirstDifference, Kind, Run, Section, Table, Text};
use dbd_report::page::html;
use dbd_report::picture::{Mechanism, Paper, svg};
use dbd_scene::Scene;
use dbd_study::command::quoted;

use crate::commands::compare::charts::ChartList;
use crate::commands::compare::differs::{Differs, differs, grouped};
use crate::commands::compare::replay::{of_rows, of_scene};
use crate::commands::compare::words;
use crate::comparison::Comparison;
use crate::comparison::pairing::Pairing;
use crate::recorded::{Head, Recorded, Row, Unreadable};

/// Largest number of bodies in a still picture.
pub const MAX_PICTURED: usize = 500;

/// Longest description of two runs in a title.
const LONGEST_TITLE: usize = 60;

/// The differences of two runs during the comparison.
pub struct Differences {
    list: ChartList,
    curves: Curves,
    values: Vec<f64>,
    pairing: Pairing,
}

impl Differences {
    /// For two runs before the comparison.
    #[must_use]
    pub fn new(heads: [&Head; 2]) -> Self {
        let pairing = Pairing::of(heads);
        let mut list = ChartList::default();
        for pair in &pairing.values {
            list.add(Section::Readouts, [&pair.name, "A − B", &pair.unit], &[""]);
        }
        list.add(Section::Energy, ["Energy", "A − B", "J"], &["kinetic", "potential", "total"]);
        for pair in &pairing.bodies {
            let texts = [&*format!("{}: position", pair.name), "A − B", "m"];
            list.add(Section::Motion, texts, &["x", "y", "z"]).of_body(pair.rows[0]);
            let texts = [&*format!("{}: rotation between A and B", pair.name), "angle", "rad"];
            list.add(Section::Motion, texts, &[""]).of_body(pair.rows[0]);
        }
        let samples = heads[0].samples.min(heads[1].samples);
        let curves = list.curves(samples);
        Self { list, curves, values: Vec::new(), pairing }
    }

    /// Adds a common sample.
    pub fn look(&mut self, a: &Row, b: &Row) {
        let Self { values, pairing, .. } = self;
        values.clear();
        values.extend(
            pairing.values.iter().map(|pair| a.values[pair.rows[0]] - b.values[pair.rows[1]]),
        );
        let energies = a.energies.zip(b.energies);
        values.extend(energies.map_or([f64::NAN; 3], |(a, b)| [0, 1, 2].map(|of| a[of] - b[of])));
        for pair in &pairing.bodies {
            let (of_a, of_b) = (&a.bodies[pair.rows[0]], &b.bodies[pair.rows[1]]);
            values.extend((0..3).map(|axis| of_a[axis] - of_b[axis]));
            let alike = of_a[3..7] == of_b[3..7];
            values.push(if alike { 0.0 } else { BodyQuantity::Orientation.distance(of_a, of_b) });
        }
        self.curves.push(a.time, values);
    }
}

/// The label of a run, from its differences to the other.
#[must_use]
pub fn labels(comparison: &Comparison) -> [String; 2] {
    const TELLING: [&str; 7] =
        ["scene", "scheme", "precision", "orientation", "newton", "rho", "damping"];
    let differs = grouped(differs(comparison));
    let telling = differs.iter().filter(|fact| {
        TELLING.contains(&fact.what.as_str())
            || fact.what == "step"
            || fact.what.starts_with("set ")
    });
    let facts: Vec<[String; 2]> = telling
        .map(|fact| {
            let sides = fact.sides();
            let name = fact.what.strip_prefix("set ").or((fact.what == "step").then_some("step"));
            sides.map(|side| name.map_or(side.to_owned(), |name| format!("{name} = {side}")))
        })
        .collect();
    ["A", "B"].map(|run| {
        let side = usize::from(run == "B");
        let facts: Vec<&str> = facts.iter().map(|fact| fact[side].as_str()).collect();
        match facts.is_empty() {
            true => run.to_owned(),
            false => format!("{run}: {}", facts.join(", ")),
        }
    })
}

/// The page.
///
/// # Errors
/// Where a run cannot be read again.
pub fn page(
    comparison: &Comparison,
    differences: Differences,
    scenes: &[Result<Scene, String>; 2],
    called: [&Path; 2],
) -> Result<String, Unreadable> {
    let labels = labels(comparison);
    let mut runs = Vec::new();
    let mut warnings = Vec::new();
    for side in [0, 1] {
        let again = Recorded::open(called[side])?;
        let end = comparison.ends[side];
        let of = match &scenes[side] {
            Ok(scene) => of_scene(scene, again, end)?,
            Err(why) => Err(why.clone()),
        };
        let run = match of {
            Ok(run) => run,
            Err(why) => {
                warnings.push(format!("no animation for {}: {why}", ["A", "B"][side]));
                of_rows(Recorded::open(called[side])?, end)?
            }
        };
        runs.push(Run { label: labels[side].clone(), ..run });
    }
    let Differences { list, curves, .. } = differences;
    let differences = list.finish(curves);
    let first = comparison.first.as_ref().map(|first| FirstDifference {
        time: first.time,
        step: first.steps[0],
        text: first.what(),
    });
    let [a, b] = &comparison.heads;
    let name =
        if a.scene == b.scene { a.scene.clone() } else { format!("{} and {}", a.scene, b.scene) };
    let picture =
        scenes.iter().flatten().next().filter(|scene| scene.body_names.len() <= MAX_PICTURED);
    let data = Data {
        format: FORMAT,
        kind: Kind::Compare,
        name: title(&name, &labels, called),
        description: lead(comparison),
        runs,
        differences: differences.charts,
        difference_times: differences.times,
        first_difference: first,
        modes: Vec::new(),
        text: Text {
            failures: Vec::new(),
            warnings,
            picture: picture.map(|scene| svg(&Mechanism::of(scene), Paper::Page)),
            tables: tables(comparison),
            commands: vec![(String::new(), command(called))],
            notes: Vec::new(),
            survey: None,
        },
    };
    Ok(html(&data))
}

/// The title: the scene, and the differences of the runs if short, else their paths.
fn title(name: &str, labels: &[String; 2], called: [&Path; 2]) -> String {
    let facts = labels.each_ref().map(|label| label.split_once(": ").map(|(_, facts)| facts));
    match facts {
        [Some(a), Some(b)] if a.len() + b.len() <= LONGEST_TITLE => format!("{name}: {a} and {b}"),
        _ => format!("{name}: {} and {}", called[0].display(), called[1].display()),
    }
}

fn lead(comparison: &Comparison) -> String {
    let verdict = words::verdict(comparison);
    let apart = comparison.quantities.iter().take(2).filter(|of| !of.is_equal()).map(|of| {
        let [name, _, largest, body, time, _] = words::quantity(of, false);
        format!("in {name} {largest} ({body}, t = {time})")
    });
    let apart = apart.collect::<Vec<_>>().join(", ");
    match apart.is_empty() {
        true => format!("The two runs are {verdict}."),
        false => format!("The two runs are {verdict}. The largest difference is {apart}."),
    }
}

fn command(called: [&Path; 2]) -> String {
    let [a, b] = called.map(|path| quoted(&path.display().to_string()));
    format!("host-sim compare {a} {b}")
}

fn tables(comparison: &Comparison) -> Vec<Table> {
    let texts = |texts: &[&str]| texts.iter().map(|text| (*text).to_owned()).collect::<Vec<_>>();
    let mut rows = vec![
        vec!["A".into(), words::run(&comparison.heads[0], comparison.ends[0])],
        vec!["B".into(), words::run(&comparison.heads[1], comparison.ends[1])],
    ];
    let [from, until] = comparison.span.map(display);
    let compared = format!("{} samples from {from} to {until}", comparison.samples);
    rows.push(vec!["compared".into(), compared]);
    rows.extend(words::notes(comparison).into_iter().map(|note| vec!["note".into(), note]));
    let mut tables = vec![Table { title: "Comparison".into(), columns: Vec::new(), rows }];
    let facts = grouped(differs(comparison));
    if !facts.is_empty() {
        let row = |fact: &Differs| {
            let [a, b] = fact.sides();
            texts(&[&fact.what, a, b])
        };
        let rows = facts.iter().map(row).collect();
        let columns = texts(&["what", "A", "B"]);
        tables.push(Table { title: "Differences of the runs".into(), columns, rows });
    }
    let rows =
        comparison.quantities.iter().map(|of| words::quantity(of, comparison.banded).to_vec());
    let rows = rows.collect();
    tables.push(Table { title: "Distances".into(), columns: texts(&words::COLUMNS), rows });
    tables
}
