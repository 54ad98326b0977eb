//! The choice for each power of ten: to the right of its line, and by number at its mark.

use std::fmt::Write as _;

use dbd_report::output::label_positions::LabelPositions;
use dbd_report::output::markup::escape;
use dbd_report::output::svg::label;

use crate::advice::choice;
use crate::chart::drawing::{Drawing, LABEL};
use crate::chart::layout::Layout;
use crate::chart::style::{FAINT, INK};
use crate::words::shown;

/// The cheapest point for an accuracy.
pub(super) struct Choice {
    /// \[m\] the power of ten.
    pub(super) accuracy: f64,
    /// The point's row.
    pub(super) row: usize,
    /// Its number on the chart: from 1, the coarsest accuracy first.
    pub(super) number: usize,
}

/// [pixels] of a number's disc.
const DISC: f64 = 9.0;

impl Drawing<'_> {
    /// One for each power of ten on the axis above the uncertainty of the reference solution that the kernel reaches.
    pub(super) fn choices(&self) -> Vec<Choice> {
        let mut choices: Vec<Choice> = Vec::new();
        let mut rows: Vec<usize> = Vec::new();
        for tick in self.y.ticks().into_iter().rev().filter(|tick| tick.digit == 1) {
            let accuracy = tick.value();
            if accuracy < self.chart.uncertainty {
                break;
            }
            let Some(row) = choice(self.chart.points, self.machine, accuracy, true) else { break };
            if !rows.contains(&row) {
                rows.push(row);
            }
            let number = 1 + rows.iter().position(|known| *known == row).unwrap_or(0);
            choices.push(Choice { accuracy, row, number });
        }
        choices
    }

    /// Name and step of each choice at the line of its accuracy.
    pub(super) fn panel(&self, text: &mut String, choices: &[Choice]) {
        if choices.is_empty() {
            return;
        }
        let Layout { right, strip, width: whole, .. } = *self.layout;
        let x = right + 18.0;
        label(text, (x - 10.0, strip.0 + 12.0), "start", INK, "cheapest method for each accuracy:");
        label(text, (x - 10.0, strip.0 + 29.0), "start", FAINT, "scheme, precision, step");
        for choice in choices {
            let y = self.y.at(choice.accuracy);
            let _ = writeln!(
                text,
                "<path d=\"M{right} {y:.1}H{:.1}\" stroke=\"{INK}\" fill=\"none\"/>",
                x - DISC
            );
            disc(text, (x, y), choice.number);
            let Some(line) = self.line_of(choice.row) else { continue };
            let point = &self.chart.points[choice.row];
            let name = format!("{} · {}", point.stepper.label(), shown(point.step));
            // A long name is set narrower rather than cut.
            let room = whole - x - DISC - 12.0;
            let width = name.chars().count() as f64 * LABEL * 0.64;
            let fitted = match width > room {
                true => format!(" textLength=\"{room:.0}\" lengthAdjust=\"spacingAndGlyphs\""),
                false => String::new(),
            };
            let _ = writeln!(
                text,
                "<g class=\"stepper\" data-stepper=\"{}\"><text x=\"{:.1}\" y=\"{:.1}\" \
                 font-weight=\"600\" fill=\"{}\"{fitted}>{}</text></g>",
                line.number,
                x + DISC + 6.0,
                y + 4.5,
                line.style.text,
                escape(&name)
            );
        }
    }

    /// Each choice's number near its mark, and the line down to it from its accuracy.
    pub(super) fn numbers(
        &self,
        text: &mut String,
        positions: &mut LabelPositions,
        choices: &[Choice],
    ) {
        for (rank, choice) in choices.iter().enumerate() {
            let (x, y) = self.at(choice.row);
            let top = self.y.at(choice.accuracy);
            let _ = writeln!(
                text,
                "<path d=\"M{:.1} {top:.1}h8M{x:.1} {top:.1}V{y:.1}\" stroke=\"{INK}\" \
                 stroke-dasharray=\"2 2\" fill=\"none\"/>",
                x - 4.0
            );
            if choices[..rank].iter().any(|other| other.row == choice.row) {
                continue;
            }
            let size = (2.0 * DISC, 2.0 * DISC);
            if let Some(found) = positions.find((x, y), size, (-0.7, 0.7), 1e4) {
                let at = (found.x + DISC, found.y + DISC);
                let _ = writeln!(
                    text,
                    "<path d=\"M{x:.1} {y:.1}L{:.1} {:.1}\" stroke=\"{INK}\" fill=\"none\"/>",
                    at.0, at.1
                );
                disc(text, at, choice.number);
            }
        }
    }
}

fn disc(text: &mut String, (x, y): (f64, f64), number: usize) {
    let _ = writeln!(
        text,
        "<circle cx=\"{x:.1}\" cy=\"{y:.1}\" r=\"{DISC}\" fill=\"{INK}\"/><text x=\"{x:.1}\" \
         y=\"{:.1}\" text-anchor=\"middle\" font-size=\"11.5\" font-weight=\"600\" \
         fill=\"#fff\">{number}</text>",
        y + 4.0
    );
}
