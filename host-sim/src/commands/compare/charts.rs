//! Charts of rows of numbers: of a run without its scene, of the differences of two runs.
//!
//! `names, rows => charts with a limited number of values`. Of many bodies those with the largest displacement are
//! drawn.

use dbd_report::curves::{Curves, FEWEST_POINTS, MAX_POINTS};
use dbd_report::data::{Chart, Line, Section, Thinned};
use dbd_report::packed::{F32s, F64s};

/// Values of all lines: 5.4 bytes of text each.
const ROOM: usize = 60_000;

/// Largest number of drawn bodies.
const MAX_BODIES: usize = 40;

/// Charts without values.
#[derive(Clone, Debug, Default)]
pub struct ChartList {
    charts: Vec<Chart>,
}

/// The chart added last.
pub struct Added<'c>(&'c mut Chart);

impl Added<'_> {
    /// Its values are differences from the first.
    pub fn deviation(self) -> Self {
        self.0.lines.iter_mut().for_each(|line| line.deviation = true);
        self
    }

    /// The row of its body, if it has one.
    pub fn of_body(self, body: usize) -> Self {
        self.0.body = Some(body);
        self
    }
}

/// Charts with their curves.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct Charted {
    /// \[s\] their times.
    pub times: F64s,
    /// Notes on omitted values.
    pub thinned: Option<Thinned>,
    /// The charts.
    pub charts: Vec<Chart>,
    /// Bodies without charts.
    pub bodies_left_out: usize,
}

impl ChartList {
    /// Adds a chart of a title, a quantity and a unit, with a line for each name.
    pub fn add(&mut self, section: Section, texts: [&str; 3], names: &[&str]) -> Added<'_> {
        let [title, quantity, unit] = texts.map(str::to_owned);
        let lines = names.iter().map(|name| Line {
            name: (*name).to_owned(),
            values: F32s::default(),
            initial: f64::NAN,
            deviation: false,
            still: false,
            low: f64::NAN,
            high: f64::NAN,
        });
        let lines = lines.collect();
        self.charts.push(Chart { section, title, quantity, unit, body: None, joint: None, lines });
        let last = self.charts.len() - 1;
        Added(&mut self.charts[last])
    }

    /// Adds rows of the given number of samples, a value per line in the order in which lines were added.
    #[must_use]
    pub fn curves(&self, samples: u64) -> Curves {
        let lines = self.charts.iter().flat_map(|chart| &chart.lines);
        Curves::new(lines.map(|line| line.deviation).collect(), samples)
    }

    /// The charts of all rows.
    #[must_use]
    pub fn finish(self, mut curves: Curves) -> Charted {
        curves.finish();
        let samples = curves.samples();
        let mut bodies: Vec<(usize, f64)> = Vec::new();
        let mut first = 0;
        let mut placed = Vec::new();
        for chart in self.charts {
            let lines = first..first + chart.lines.len();
            first = lines.end;
            if let Some(body) = chart.body.filter(|_| chart.unit == "m") {
                let range = |line: usize| curves.extents()[line].range();
                bodies.push((body, lines.clone().map(range).fold(0.0, f64::max)));
            }
            placed.push((chart, lines));
        }
        bodies.sort_by(|a, b| b.1.total_cmp(&a.1));
        let left_out = bodies.split_off(bodies.len().min(MAX_BODIES));
        let drawn = |chart: &Chart| !left_out.iter().any(|(body, _)| chart.body == Some(*body));
        placed.retain(|(chart, _)| drawn(chart));
        let moves = |line: &usize| curves.extents()[*line].range() > 0.0;
        let chosen: Vec<usize> =
            placed.iter().flat_map(|(_, lines)| lines.clone().filter(moves)).collect();
        let points = (ROOM / chosen.len().max(1)).clamp(FEWEST_POINTS, MAX_POINTS);
        let all = curves.drawn(&chosen, points);
        let mut values = all.lines.into_iter();
        let charts = placed.into_iter().map(|(mut chart, lines)| {
            for (line, place) in chart.lines.iter_mut().zip(lines) {
                let extent = curves.extents()[place];
                (line.initial, line.low, line.high) = (extent.initial, extent.low, extent.high);
                line.still = !moves(&place);
                if !line.still {
                    line.values = F32s(values.next().unwrap_or_default());
                }
            }
            chart
        });
        let charts = charts.collect();
        let points = all.times.len();
        let thinned = ((points as u64) < samples).then_some(Thinned { samples, points });
        Charted { times: F64s(all.times), thinned, charts, bodies_left_out: left_out.len() }
    }
}
