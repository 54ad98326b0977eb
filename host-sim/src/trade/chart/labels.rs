//! Names on the chart: of the front's points, of the lines where they end.

use std::fmt::Write as _;

use super::place::{Places, Rectangle};
use super::{BOTTOM, Drawing, LABEL, LEFT, Line, RIGHT, TOP};
use crate::report::escape;
use crate::time::{display, rounded};
use crate::trade::advice::is_paper;

impl Drawing<'_> {
    /// Names: of the front's points, then of the lines where they end.
    pub(super) fn labels(&self, text: &mut String, order: &[&Line<'_>], band: &[(f64, f64)]) {
        let (x, y) = (LEFT + 4.0, TOP + 4.0);
        let (width, height) = (RIGHT - LEFT - 8.0, BOTTOM - TOP - 8.0);
        let mut places = Places::new(Rectangle { x, y, width, height });
        for line in &self.lines {
            let at: Vec<_> = line.stable.iter().map(|row| self.at(*row)).collect();
            at.windows(2).for_each(|pair| places.stroke(pair[0], pair[1]));
            at.iter().for_each(|at| places.mark(*at));
        }
        band.windows(2).for_each(|pair| places.stroke(pair[0], pair[1]));
        self.remarks(text, &mut places);
        let named = self.front_labels(text, &mut places);
        // The quiet lines come first to be drawn beneath, and last to be named.
        let (quiet, loud): (Vec<&Line<'_>>, Vec<&Line<'_>>) =
            order.iter().copied().partition(|line| line.quiet);
        for line in loud.into_iter().chain(quiet) {
            let Some(row) = line.stable.last().filter(|row| !named.contains(row)) else { continue };
            let paper = is_paper(line.stepper);
            let name = match paper {
                true => format!("paper's scheme ({})", line.stepper.label()),
                false => line.stepper.label(),
            };
            let worst = if line.quiet { 45.0 } else { 300.0 };
            self.label(text, &mut places, (*row, line), &name, (0.9, 0.3), (worst, paper));
        }
    }

    /// The front's points by name: those first that are the choice for a power of ten.
    /// Rows of those that had room.
    fn front_labels(&self, text: &mut String, places: &mut Places) -> Vec<usize> {
        let mut named = Vec::new();
        let error = |row: usize| self.chart.points[row].error.unwrap_or(0.0);
        let mut rows: Vec<usize> = Vec::new();
        for decade in (-15..=3).rev() {
            let good = |row: &&usize| error(**row) <= 10_f64.powi(decade);
            rows.extend(self.front.iter().find(good).filter(|row| !rows.contains(row)));
        }
        let firsts = rows.len();
        let rest: Vec<usize> =
            self.front.iter().copied().filter(|row| !rows.contains(row)).collect();
        rows.extend(rest);
        for (rank, row) in rows.iter().enumerate() {
            let point = &self.chart.points[*row];
            let Some(line) = self.lines.iter().find(|line| line.stepper == &point.stepper) else {
                continue;
            };
            let name = format!("{} · {}", point.stepper.label(), display(rounded(point.step, 3)));
            let worst = if rank < firsts { 1e4 } else { 70.0 };
            if self.label(text, places, (*row, line), &name, (-0.8, 0.6), (worst, true)) {
                named.push(*row);
            }
        }
        named
    }

    fn label(
        &self,
        text: &mut String,
        places: &mut Places,
        (row, line): (usize, &Line<'_>),
        name: &str,
        wish: (f64, f64),
        (worst, bold): (f64, bool),
    ) -> bool {
        let anchor = self.at(row);
        let share = if bold { 0.66 } else { 0.6 };
        let size = (name.chars().count() as f64 * LABEL * share, LABEL + 3.0);
        let Some(found) = places.place(anchor, size, wish, worst) else {
            return false;
        };
        let colour = line.style.text;
        let _ = write!(text, "<g class=\"stepper\" data-stepper=\"{}\">", line.number);
        let end = found.nearest(anchor);
        if (end.0 - anchor.0).hypot(end.1 - anchor.1) > 13.0 {
            let _ = write!(
                text,
                "<path d=\"M{:.1} {:.1}L{:.1} {:.1}\" stroke=\"{colour}\" stroke-width=\".8\" \
                 fill=\"none\"/>",
                anchor.0, anchor.1, end.0, end.1
            );
        }
        let weight = if bold { " font-weight=\"600\"" } else { "" };
        let _ = writeln!(
            text,
            "<text x=\"{:.1}\" y=\"{:.1}\" text-anchor=\"middle\" fill=\"{colour}\"{weight} \
             stroke=\"#fff\" stroke-width=\"3\" stroke-opacity=\".85\" paint-order=\"stroke\">{}\
             </text></g>",
            found.x + found.width / 2.0,
            found.y + LABEL - 1.0,
            escape(name)
        );
        true
    }
}
