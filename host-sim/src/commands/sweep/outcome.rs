//! The outcome of a sweep, for people and for programs.
//!
//! `(sweep, finished cases) => rows of text, JSON`. `sweep.json` does not depend on who ran which case.

use dbd_study::sweep::cases::Cases;
use dbd_study::sweep::row::OK;
use dbd_study::sweep::shard::Shard;
use dbd_study::sweep::store::Store;
use serde::Serialize;

use crate::commands::sweep::error::SweepError;
use crate::commands::sweep::loaded::{Sweep, VERSION};

/// Largest number of cases named in a message.
const NAMED: usize = 8;

/// The outcome of a sweep.
#[derive(Clone, Debug, PartialEq, Eq, Serialize)]
pub struct SweepOutcome {
    /// The sweep's file.
    pub sweep_file: String,
    /// FNV-1a 64 of its text.
    pub sweep_hash: String,
    /// The scene's name.
    pub scene: String,
    /// Its file.
    pub scene_file: String,
    /// FNV-1a 64 of its text.
    pub scene_hash: String,
    /// The program's version.
    pub version: &'static str,
    /// How many cases the sweep has.
    pub cases: usize,
    /// How many of them are finished, of the share where it is one.
    pub finished: usize,
    /// How many of these completed.
    pub ok: usize,
    /// The axes in their order.
    pub axes: Vec<AxisOutcome>,
    /// The measured columns of each case.
    pub columns: Vec<ColumnOutcome>,
    /// The share, where it is one.
    #[serde(skip)]
    pub shard: Shard,
    /// Cases that were run now.
    #[serde(skip)]
    pub ran: u64,
    /// Cases that are missing.
    #[serde(skip)]
    pub missing: Vec<usize>,
    /// The first case that did not complete, with its status.
    #[serde(skip)]
    pub first_failure: Option<(usize, String)>,
    /// Files of finished cases that were damaged.
    #[serde(skip)]
    pub damages: Vec<String>,
    /// Where the table was written.
    #[serde(skip)]
    pub written: Option<String>,
}

/// An axis.
#[derive(Clone, Debug, PartialEq, Eq, Serialize)]
pub struct AxisOutcome {
    /// Its path.
    pub path: String,
    /// The SI unit of its values, where they are quantities.
    pub unit: Option<String>,
    /// How many values it has.
    pub values: usize,
}

/// A column of a trace of which the table has figures.
#[derive(Clone, Debug, PartialEq, Eq, Serialize)]
pub struct ColumnOutcome {
    /// Its name.
    pub name: String,
    /// Its unit.
    pub unit: String,
    /// The figures.
    pub statistics: Vec<&'static str>,
}

impl SweepOutcome {
    /// Of a sweep before its rows are counted.
    #[must_use]
    pub fn new(sweep: &Sweep, store: &Store, shard: Shard, ran: u64, missing: Vec<usize>) -> Self {
        let Sweep { spec, file, found, columns, .. } = sweep;
        let statistics = || spec.statistics.iter().map(|statistic| statistic.name()).collect();
        let column = |column: &dbd_study::sweep::columns::Column| ColumnOutcome {
            name: column.name.clone(),
            unit: column.unit.clone(),
            statistics: statistics(),
        };
        let axis = |axis: &dbd_study::sweep::axis::Axis| AxisOutcome {
            path: axis.path.clone(),
            unit: axis.unit(),
            values: axis.values.len(),
        };
        let damage = |damage: &dbd_study::sweep::store::Damage| {
            let (file, lines) = (damage.file.display(), damage.lines);
            let lines = if lines == 1 { "a line".into() } else { format!("{lines} lines") };
            match &damage.aside {
                Some(aside) => format!(
                    "{file} is damaged in {lines}: it is renamed to {}, and the cases of these lines \
                     have to run again",
                    aside.display()
                ),
                None => format!(
                    "{file} is damaged in {lines}, and in use: the program that uses it is \
                                 not notified"
                ),
            }
        };
        let mut damages: Vec<String> = store.damages.iter().map(damage).collect();
        if let Some(key) = store.doubtful.first() {
            damages.push(format!(
                "{} finished cases have two rows that differ, the first with the key {key}: of two \
                 machines that ran it one is wrong",
                store.doubtful.len()
            ));
        }
        Self {
            sweep_file: file.place.clone(),
            sweep_hash: file.hash.clone(),
            scene: found.scene.name.clone(),
            scene_file: found.file.place.clone(),
            scene_hash: found.file.hash.clone(),
            version: VERSION,
            cases: Cases::new(spec).len(),
            finished: 0,
            ok: 0,
            axes: spec.axes.iter().map(axis).collect(),
            columns: columns.iter().map(column).collect(),
            shard,
            ran,
            missing,
            first_failure: None,
            damages,
            written: None,
        }
    }

    /// Counts a finished case by its cells.
    pub fn count(&mut self, case: usize, cells: &[String]) {
        self.finished += 1;
        match cells.first() {
            Some(status) if status == OK => self.ok += 1,
            status if self.first_failure.is_none() => {
                self.first_failure = Some((case, status.cloned().unwrap_or_default()));
            }
            _ => {}
        }
    }

    /// The refusal of a table without the cases that are missing.
    #[must_use]
    pub fn incomplete(&self) -> SweepError {
        SweepError::Incomplete {
            missing: self.missing.len(),
            cases: self.cases,
            named: named(&self.missing),
        }
    }

    /// The rows of a page, independent of who ran which case.
    #[must_use]
    pub fn rows_of_page(&self) -> Vec<(&'static str, String)> {
        let mut rows = self.rows();
        for (name, text) in &mut rows {
            if *name == "cases" {
                *text = format!("{}: {} ok", self.cases, self.ok);
            }
        }
        rows.push(("version", self.version.to_owned()));
        rows
    }

    /// The report for people.
    #[must_use]
    pub fn rows(&self) -> Vec<(&'static str, String)> {
        let axes: Vec<String> =
            self.axes.iter().map(|axis| format!("{} ({})", axis.path, axis.values)).collect();
        let known = self.finished as u64 - self.ran.min(self.finished as u64);
        let cases = match self.shard == Shard::WHOLE {
            true => format!("{}: {} run now, {known} known", self.cases, self.ran),
            false => format!(
                "{} of {} (share {}): {} run now, {known} known",
                self.finished, self.cases, self.shard, self.ran
            ),
        };
        let mut rows = vec![
            ("sweep", self.sweep_file.clone()),
            ("scene", self.scene.clone()),
            ("axes", axes.join(", ")),
            ("cases", cases),
        ];
        if let Some((case, status)) = &self.first_failure {
            let failed = self.finished - self.ok;
            rows.push(("not ok", format!("{failed}, the first case {}: {status}", case + 1)));
        }
        if !self.missing.is_empty() {
            let missing = format!("{}: {}", self.missing.len(), named(&self.missing));
            rows.push(("missing", missing));
        }
        rows.extend(self.written.iter().map(|written| ("written", written.clone())));
        rows
    }
}

/// The numbers of some cases, from 1.
fn named(cases: &[usize]) -> String {
    let some = cases.iter().take(NAMED).map(|case| (case + 1).to_string());
    let more = if cases.len() > NAMED { ", …" } else { "" };
    let word = if cases.len() == 1 { "case" } else { "cases" };
    format!("{word} {}{more}", some.collect::<Vec<_>>().join(", "))
}
