//! Names on the chart: of the lines where they end, of points on the front.

use std::fmt::Write as _;

use dbd_report::output::label_positions::{LabelPositions, Rectangle};
use dbd_report::output::markup::escape;

use crate::chart::choices::Choice;
use crate::chart::drawing::{Drawing, LABEL, Line};
use crate::chart::layout::Layout;
use crate::words::shown;

impl Drawing<'_> {
    /// Numbers of the choices, then names: of the front's other points, of the lines where they end.
    pub(super) fn labels(
        &self,
        text: &mut String,
        order: &[&Line<'_>],
        band: &[(f64, f64)],
        choices: &[Choice],
    ) {
        let Layout { left, right, top, bottom, wide, .. } = *self.layout;
        let (x, y) = (left + 4.0, top + 4.0);
        let (width, height) = (right - left - 8.0, bottom - top - 8.0);
        let mut positions = LabelPositions::new(Rectangle { x, y, width, height });
        for line in &self.lines {
            let at: Vec<_> = line.stable.iter().map(|row| self.at(*row)).collect();
            at.windows(2).for_each(|pair| positions.stroke(pair[0], pair[1]));
            at.iter().for_each(|at| positions.mark(*at));
        }
        band.windows(2).for_each(|pair| positions.stroke(pair[0], pair[1]));
        self.remarks(text, &mut positions);
        if !wide {
            return;
        }
        self.numbers(text, &mut positions, choices);
        // The paper's lines first: everything is compared with them. The quiet ones last.
        let mut lines: Vec<&Line<'_>> = order.to_vec();
        lines.sort_by_key(|line| (!line.paper, line.quiet));
        for line in lines {
            let name = match line.paper {
                true => format!("paper's scheme ({})", line.stepper.label()),
                false => line.stepper.label(),
            };
            let worst = if line.quiet { 45.0 } else { 300.0 };
            // The paper's name is placed along its line if there is no room at the end.
            let most = if line.paper { line.stable.len() } else { 1 };
            for row in line.stable.iter().rev().take(most) {
                let how = (worst, line.paper);
                if self.label(text, &mut positions, (*row, line), &name, (0.9, 0.3), how) {
                    break;
                }
            }
        }
        for row in &self.front {
            if choices.iter().any(|choice| choice.row == *row) {
                continue;
            }
            let Some(line) = self.line_of(*row) else { continue };
            let point = &self.chart.points[*row];
            let name = format!("{} · {}", point.stepper.label(), shown(point.step));
            self.label(text, &mut positions, (*row, line), &name, (-0.8, 0.6), (70.0, true));
        }
    }

    /// The line that a point lies on.
    pub(super) fn line_of(&self, row: usize) -> Option<&Line<'_>> {
        let stepper = &self.chart.points[row].stepper;
        self.lines.iter().find(|line| line.stepper == stepper)
    }

    fn label(
        &self,
        text: &mut String,
        positions: &mut LabelPositions,
        (row, line): (usize, &Line<'_>),
        name: &str,
        wish: (f64, f64),
        (worst, bold): (f64, bool),
    ) -> bool {
        let anchor = self.at(row);
        let share = if bold { 0.66 } else { 0.6 };
        let size = (name.chars().count() as f64 * LABEL * share, LABEL + 3.0);
        let Some(found) = positions.find(anchor, size, wish, worst) else {
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
