//! Results that lie in files, because they were counted in an emulator or measured by a clock.
//!
//! `docs/costs.csv`, `docs/results/*.csv, tests/bits/hashes.csv => rows`. Lines that begin with `#`
//! say where a file comes from.

use std::path::{Path, PathBuf};

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
    let text = std::fs::read_to_string(path(file)).unwrap_or_else(|why| panic!("{file}: {why}"));
    rows_of(&text)
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
