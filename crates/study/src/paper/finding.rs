//! Result of an item: rows with verdicts, assumptions, curves.
//!
//! `(paper's value, this one's, tolerance) => verdict`.

use serde::{Deserialize, Serialize};

/// Whether a result of the paper is reproduced; later variants are worse.
#[derive(Clone, Copy, Debug, PartialEq, Eq, PartialOrd, Ord, Serialize, Deserialize)]
#[serde(rename_all = "kebab-case")]
pub enum Verdict {
    /// It does.
    Reproduced,
    /// Reproduced up to a stated factor.
    ReproducedUpToFactor,
    /// The text lacks required data.
    NotReproducible,
    /// It does not, and the numbers show it.
    Contradicted,
}

impl Verdict {
    /// As people read it.
    #[must_use]
    pub fn words(self) -> &'static str {
        match self {
            Self::Reproduced => "reproduced",
            Self::ReproducedUpToFactor => "reproduced up to a stated factor",
            Self::NotReproducible => "not reproducible from the text",
            Self::Contradicted => "contradicted",
        }
    }
}

/// Tolerance of a value.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Tolerance {
    /// Relative deviation up to which it is reproduced.
    pub within: f64,
    /// Factor up to which it is reproduced up to that factor.
    pub factor: f64,
}

/// Exact counts.
pub const EXACT: Tolerance = Tolerance { within: 0.0, factor: 1.0 };

/// A value that a pose or a reading of the text moves by some tens of per cent.
pub const APPROXIMATE: Tolerance = Tolerance { within: 0.15, factor: 3.0 };

/// A result of the paper and of this project.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
pub struct Row {
    /// The compared quantity.
    pub quantity: String,
    /// Its unit; empty where it has none.
    pub unit: String,
    /// The paper's value; `None` for a qualitative statement.
    pub paper: Option<f64>,
    /// The measured value.
    pub ours: Option<f64>,
    /// The verdict; `None` for a row that the paper lacks.
    pub verdict: Option<Verdict>,
    /// Reason, evidence or explanation.
    pub note: String,
}

impl Row {
    /// Two numbers with a verdict.
    #[must_use]
    pub fn compared(
        quantity: impl Into<String>,
        unit: &str,
        paper: f64,
        ours: f64,
        tolerance: Tolerance,
    ) -> Self {
        let ratio = ours / paper;
        let verdict = if (ratio - 1.0).abs() <= tolerance.within {
            Verdict::Reproduced
        } else if ratio > 0.0 && ratio.max(1.0 / ratio) <= tolerance.factor {
            Verdict::ReproducedUpToFactor
        } else {
            Verdict::Contradicted
        };
        Self {
            quantity: quantity.into(),
            unit: unit.into(),
            paper: Some(paper),
            ours: Some(ours),
            verdict: Some(verdict),
            note: String::new(),
        }
    }

    /// A true or false statement.
    #[must_use]
    pub fn claim(quantity: impl Into<String>, holds: bool, note: impl Into<String>) -> Self {
        Self {
            quantity: quantity.into(),
            unit: String::new(),
            paper: None,
            ours: None,
            verdict: Some(if holds { Verdict::Reproduced } else { Verdict::Contradicted }),
            note: note.into(),
        }
    }

    /// A quantity that the text does not determine, and the reason.
    #[must_use]
    pub fn open(
        quantity: impl Into<String>,
        unit: &str,
        paper: Option<f64>,
        ours: Option<f64>,
        reason: impl Into<String>,
    ) -> Self {
        Self {
            quantity: quantity.into(),
            unit: unit.into(),
            paper,
            ours,
            verdict: Some(Verdict::NotReproducible),
            note: reason.into(),
        }
    }

    /// A number that the paper lacks.
    #[must_use]
    pub fn extra(quantity: impl Into<String>, unit: &str, ours: f64) -> Self {
        Self {
            quantity: quantity.into(),
            unit: unit.into(),
            paper: None,
            ours: Some(ours),
            verdict: None,
            note: String::new(),
        }
    }

    /// The same with a note.
    #[must_use]
    pub fn noted(self, note: impl Into<String>) -> Self {
        Self { note: note.into(), ..self }
    }

    /// This one's value over the paper's.
    #[must_use]
    pub fn ratio(&self) -> Option<f64> {
        Some(self.ours? / self.paper?)
    }
}

/// Points of a plot.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
pub struct Curve {
    /// Their name.
    pub name: String,
    /// Whether they are the paper's.
    pub paper: bool,
    /// Whether a line joins them.
    pub line: bool,
    /// x and y.
    pub points: Vec<[f64; 2]>,
}

/// Curves in common axes.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
pub struct Plot {
    /// Suffix of the item's name in a file's name; empty for its first.
    pub name: String,
    /// Title.
    pub title: String,
    /// Words at both axes, with units.
    pub axes: [String; 2],
    /// Whether they are logarithmic.
    pub logarithmic: [bool; 2],
    /// The curves.
    pub curves: Vec<Curve>,
    /// A map of magnitudes beneath them: rows from low to high y, each from low to high x.
    #[serde(skip_serializing_if = "Option::is_none", default)]
    pub map: Option<Map>,
}

/// Magnitudes over a grid.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
pub struct Map {
    /// The grid's x, ascending.
    pub x: Vec<f64>,
    /// The grid's y, ascending.
    pub y: Vec<f64>,
    /// From 0 to 1, a row for each y.
    pub values: Vec<Vec<f64>>,
}

/// Result of an item.
#[derive(Clone, Debug, Default, PartialEq, Serialize, Deserialize)]
pub struct Finding {
    /// Its name.
    pub item: String,
    /// Where the paper has it.
    pub place: String,
    /// Title.
    pub title: String,
    /// Assumptions for open points of the text.
    pub assumptions: Vec<String>,
    /// The compared quantity.
    pub rows: Vec<Row>,
    /// Plots.
    pub plots: Vec<Plot>,
}

impl Finding {
    /// The worst verdict of its rows; `None` without one.
    #[must_use]
    pub fn verdict(&self) -> Option<Verdict> {
        self.rows.iter().filter_map(|row| row.verdict).max()
    }
}

/// Assumptions as they are written in an item.
pub(super) fn assumptions(texts: &[&str]) -> Vec<String> {
    texts.iter().map(|text| (*text).to_owned()).collect()
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn verdicts_follow_from_the_ratio() {
        let verdict = |ours| Row::compared("x", "m", 2.0, ours, APPROXIMATE).verdict.unwrap();
        for (ours, expected) in [
            (2.2, Verdict::Reproduced),
            (1.75, Verdict::Reproduced),
            (2.4, Verdict::ReproducedUpToFactor),
            (0.7, Verdict::ReproducedUpToFactor),
            (6.1, Verdict::Contradicted),
            (0.6, Verdict::Contradicted),
            (-2.0, Verdict::Contradicted),
            (0.0, Verdict::Contradicted),
            (f64::NAN, Verdict::Contradicted),
        ] {
            assert_eq!(verdict(ours), expected, "{ours}");
        }
        assert_eq!(Row::compared("x", "", 35.0, 35.0, EXACT).verdict, Some(Verdict::Reproduced));
        assert_eq!(Row::compared("x", "", 35.0, 36.0, EXACT).verdict, Some(Verdict::Contradicted));
    }

    #[test]
    fn an_item_is_as_its_worst_row() {
        let rows = vec![
            Row::claim("a", true, ""),
            Row::open("b", "", None, None, "no numbers"),
            Row::extra("c", "s", 1.0),
        ];
        let finding = Finding { rows, ..Finding::default() };
        assert_eq!(finding.verdict(), Some(Verdict::NotReproducible));
        assert_eq!(Finding::default().verdict(), None);
    }
}
