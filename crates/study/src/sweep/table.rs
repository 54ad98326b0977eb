//! The table: a row per case, in the order of the cases.
//!
//! `(spec, columns, rows) => header, CSV`. Number of the case from 1, a cell per axis, in SI if it has a unit, which
//! the header names, the result of the case, the requested statistics of each column.

use std::io::{self, Write};

use crate::sweep::axis::Axis;
use crate::sweep::cases::Cases;
use crate::sweep::columns::Column;
use crate::sweep::row::RESULTS;
use crate::sweep::spec::Spec;
use crate::sweep::statistic::Statistic;

/// A table of cases that are finished.
#[derive(Clone, Debug, PartialEq)]
pub struct Table {
    /// The names of its columns.
    pub header: Vec<String>,
    /// How many of them are number and axes.
    pub axes: usize,
    /// Its rows; those of cases that are missing are not among them.
    pub rows: Vec<Vec<String>>,
}

impl Table {
    /// The table of a sweep, from the cells of each case's row.
    #[must_use]
    pub fn new<'r>(
        spec: &Spec,
        columns: &[Column],
        row: &dyn Fn(usize) -> Option<&'r [String]>,
    ) -> Self {
        let mut header = vec!["case".to_owned()];
        let units: Vec<Option<String>> = spec.axes.iter().map(Axis::unit).collect();
        header.extend(spec.axes.iter().zip(&units).map(|(axis, unit)| match unit {
            Some(unit) => format!("{} [{unit}]", axis.path),
            None => axis.path.clone(),
        }));
        let axes = header.len();
        header.extend(RESULTS.map(str::to_owned));
        for column in columns {
            let figures = spec.statistics.iter().map(|of| format!("{}.{}", column.name, of.name()));
            header.extend(figures);
        }
        let row_of = |of: &Statistic| Statistic::ALL.iter().position(|other| other == of);
        let order: Vec<usize> = spec.statistics.iter().filter_map(row_of).collect();
        let cases = Cases::new(spec);
        let mut rows = Vec::new();
        for case in 0..cases.len() {
            let Some(cells) = row(case) else { continue };
            let mut line = vec![(case + 1).to_string()];
            let values = cases.values(case).into_iter().zip(&units);
            line.extend(values.map(|(value, unit)| match unit {
                Some(_) => value.in_si(),
                None => value.cell.clone(),
            }));
            let (results, figures) = cells.split_at(RESULTS.len().min(cells.len()));
            line.extend(results.iter().cloned());
            for column in figures.chunks(Statistic::ALL.len()) {
                line.extend(order.iter().filter_map(|row| column.get(*row)).cloned());
            }
            rows.push(line);
        }
        Self { header, axes, rows }
    }

    /// Writes it as CSV.
    ///
    /// # Errors
    /// If the writer fails.
    pub fn csv(&self, to: impl Write) -> io::Result<()> {
        let mut writer = csv::Writer::from_writer(to);
        writer.write_record(&self.header)?;
        for row in &self.rows {
            writer.write_record(row)?;
        }
        writer.flush()
    }

    /// The column of a name.
    #[must_use]
    pub fn column(&self, name: &str) -> Option<usize> {
        self.header.iter().position(|header| header == name)
    }
}
