//! The values of an axis as positions in a drawing.
//!
//! `(axis, table) => names in their order, numbers if all are numeric, scale`.

use std::collections::HashMap;

use dbd_plant::digits::significant;

use crate::plot::{SI, Scale};
use crate::sweep::spec::Spec;
use crate::sweep::table::Table;

/// Ratio of the ends from which on a list of positive numbers is drawn logarithmically.
const DECADES: f64 = 100.0;

/// Digits of a number in a drawing.
const DIGITS: usize = 4;

/// Positions of an axis.
#[derive(Clone, Debug, PartialEq)]
pub(crate) struct Coordinates {
    /// Where the table has its cells.
    place: usize,
    /// The last part of its path.
    pub(crate) short: String,
    /// Its different values as the table shows them: in the order of numbers, else of the file.
    pub(crate) names: Vec<String>,
    /// The same as a drawing has them, numbers in a few digits.
    pub(crate) words: Vec<String>,
    rows: HashMap<String, (usize, f64)>,
    /// Whether its values are numbers.
    pub(crate) is_numeric: bool,
    /// The scale over it.
    pub(crate) scale: Scale,
}

impl Coordinates {
    /// The axes with more than one value, those that go along with another left out.
    pub(crate) fn of_varying(spec: &Spec, table: &Table) -> Vec<Self> {
        let leading = (0..spec.axes.len()).filter(|row| spec.leaders[*row] == *row);
        leading.filter_map(|row| Self::of(spec, table, row)).collect()
    }

    fn of(spec: &Spec, table: &Table, row: usize) -> Option<Self> {
        let (axis, place) = (&spec.axes[row], row + 1);
        let mut names: Vec<String> = Vec::new();
        let mut rows: HashMap<String, (usize, f64)> = HashMap::new();
        for line in &table.rows {
            let cell = &line[place];
            if !rows.contains_key(cell) {
                rows.insert(cell.clone(), (names.len(), names.len() as f64));
                names.push(cell.clone());
            }
        }
        if names.len() < 2 {
            return None;
        }
        let numbers = names.iter().map(|name| name.parse().ok().filter(|n: &f64| n.is_finite()));
        let numbers: Option<Vec<f64>> = numbers.collect();
        let mut label = table.header[place].clone();
        let short = axis.path.rsplit('.').next().unwrap_or_default().to_owned();
        let Some(values) = numbers else {
            let scale = Scale::of_names(names.clone(), label);
            let words = names.clone();
            return Some(Self { place, short, names, words, rows, is_numeric: false, scale });
        };
        // A plain number of the scene is in the SI unit of its quantity.
        if axis.unit().is_none() && axis.path.contains('.') {
            label = format!("{label} [{SI}]");
        }
        let mut sorted: Vec<(f64, String)> = values.iter().copied().zip(names).collect();
        sorted.sort_by(|one, other| one.0.total_cmp(&other.0));
        for (row, (value, name)) in sorted.iter().enumerate() {
            rows.insert(name.clone(), (row, *value));
        }
        let (low, high) = (sorted[0].0, sorted[sorted.len() - 1].0);
        let logarithmic = low > 0.0 && (axis.logarithmic || high / low >= DECADES);
        let scale = Scale::of_numbers(values.into_iter(), logarithmic, false, label)?;
        let words = sorted.iter().map(|(value, _)| significant(*value, DIGITS)).collect();
        let names = sorted.into_iter().map(|(_, name)| name).collect();
        Some(Self { place, short, names, words, rows, is_numeric: true, scale })
    }

    /// The axis's cell of a row of the table.
    pub(crate) fn cell<'r>(&self, row: &'r [String]) -> &'r String {
        &row[self.place]
    }

    /// Which of its values a row of the table has.
    pub(crate) fn row(&self, row: &[String]) -> Option<usize> {
        self.rows.get(self.cell(row)).map(|(row, _)| *row)
    }

    /// Points over the axis from left to right.
    pub(crate) fn sorted<'r>(
        &self,
        rows: impl Iterator<Item = (&'r Vec<String>, Option<f64>)>,
    ) -> Vec<(f64, Option<f64>)> {
        let along = |row: &[String]| self.rows.get(self.cell(row)).map(|(_, along)| *along);
        let mut points: Vec<(f64, Option<f64>)> =
            rows.filter_map(|(row, value)| Some((along(row)?, value))).collect();
        points.sort_by(|one, other| one.0.total_cmp(&other.0));
        points
    }
}
