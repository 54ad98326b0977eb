//! Results that lie in files, because they were counted in an emulator or measured by a clock.
//!
//! `docs/costs.csv`, `docs/results/*.csv, tests/bits/hashes.csv => rows`. Lines that begin with `#`
//! say where a file comes from.

use std::cell::RefCell;
use std::collections::BTreeSet;
use std::path::{Path, PathBuf};

/// Where measured data come from, see `xtask/src/provenance.rs`.
const PROVENANCE: &str = "docs/results/provenance.csv";

thread_local! {
    /// What a test has read for the block that it makes.
    static READ: RefCell<BTreeSet<String>> = const { RefCell::new(BTreeSet::new()) };
}

/// A row, its values by the names of their columns.
#[derive(Clone, Debug)]
pub struct Row(Vec<(String, String)>);

impl Row {
    /// The text in a column.
    ///
    /// # Panics
    /// Where there is none of that name.
    #[must_use]
    pub fn text(&self, column: &str) -> &str {
        let found = self.0.iter().find(|(name, _)| name == column);
        &found.unwrap_or_else(|| panic!("no column {column} in {self:?}")).1
    }

    /// The number in a column.
    ///
    /// # Panics
    /// Where there is none.
    #[must_use]
    pub fn number(&self, column: &str) -> f64 {
        self.text(column).parse().unwrap_or_else(|_| panic!("no number in {column} of {self:?}"))
    }

    /// The names of the columns.
    pub fn names(&self) -> impl Iterator<Item = &str> {
        self.0.iter().map(|(name, _)| name.as_str())
    }

    /// Whether columns hold these texts.
    #[must_use]
    pub fn is(&self, wanted: &[(&str, &str)]) -> bool {
        wanted.iter().all(|(column, text)| self.text(column) == *text)
    }
}

/// A file by its path from the root.
#[must_use]
pub fn path(file: &str) -> PathBuf {
    Path::new(env!("CARGO_MANIFEST_DIR")).join("..").join(file)
}

/// The rows of a table by its path from the root.
///
/// # Panics
/// Where it cannot be read.
#[must_use]
pub fn rows(file: &str) -> Vec<Row> {
    rows_of(&data(file))
}

/// The text of a file of data by its path from the root. A block that is made next names its commit.
///
/// # Panics
/// Where it cannot be read.
#[must_use]
pub fn data(file: &str) -> String {
    READ.with_borrow_mut(|read| read.insert(file.to_owned()));
    std::fs::read_to_string(path(file)).unwrap_or_else(|why| panic!("{file}: {why}"))
}

/// A line with commit and date of the measured data that this test has read; empty where there were none.
///
/// # Panics
/// Where the table of all of them cannot be read.
#[must_use]
pub fn origin() -> String {
    let read = READ.with_borrow(BTreeSet::clone);
    let text = std::fs::read_to_string(path(PROVENANCE)).unwrap();
    let noted = rows_of(&text).into_iter().filter(|row| read.contains(row.text("file")));
    let name = |file: &str| file.rsplit('/').next().unwrap_or_default().to_owned();
    let one = |row: Row| {
        let stale = if row.text("stale").is_empty() { "" } else { ", stale" };
        let (file, commit, date) = (name(row.text("file")), row.text("commit"), row.text("date"));
        format!("{file} of {commit} ({date}{stale})")
    };
    let all: Vec<String> = noted.map(one).collect();
    if all.is_empty() { all.concat() } else { format!("\nData: {}.\n", all.join(", ")) }
}

/// The rows of a table.
///
/// # Panics
/// Where a row is shorter than the head.
#[must_use]
pub fn rows_of(text: &str) -> Vec<Row> {
    let mut lines = text.lines().filter(|line| !line.starts_with('#'));
    let head: Vec<&str> = lines.next().unwrap_or_default().split(',').collect();
    lines
        .map(|line| {
            let values: Vec<&str> = line.split(',').collect();
            assert_eq!(values.len(), head.len(), "{line}");
            Row(head.iter().zip(values).map(|(n, v)| ((*n).into(), v.into())).collect())
        })
        .collect()
}

/// What a step of a scene costs on the target, from `docs/costs.csv`.
///
/// # Panics
/// Where that was not counted.
#[must_use]
pub fn cost(scene: &str, scheme: &str, precision: &str) -> Row {
    let wanted = [("scene", scene), ("scheme", scheme), ("precision", precision)];
    let row = rows("docs/costs.csv").into_iter().find(|row| row.is(&wanted));
    row.unwrap_or_else(|| panic!("docs/costs.csv has no {wanted:?}"))
}
