//! Elements around and below the lines: axes, uncertainty of the reference, real time, the strip, the key.

use std::fmt::Write as _;

use dbd_plant::digits::significant;
use dbd_report::output::label_positions::{LabelPositions, Rectangle};
use dbd_report::output::svg::label;

use crate::chart::drawing::{Drawing, LABEL, Line, MARK};
use crate::chart::layout::Layout;
use crate::chart::style::{FAINT, GRID, INK};
use crate::point::{Machine, Stepper};

impl Drawing<'_> {
    /// Area below the uncertainty of the reference solution.
    pub(super) fn floor(&self, text: &mut String) {
        let Layout { left, right, bottom, .. } = *self.layout;
        if !self.y.holds(self.chart.uncertainty) {
            return;
        }
        let top = self.y.at(self.chart.uncertainty);
        let _ = writeln!(
            text,
            "<rect x=\"{left}\" y=\"{top:.1}\" width=\"{:.1}\" height=\"{:.1}\" \
             fill=\"#dfe4ea\"/>",
            right - left,
            bottom - top
        );
    }

    pub(super) fn grid(&self, text: &mut String) {
        let Layout { left, right, top, bottom, strip, wide, .. } = *self.layout;
        for tick in self.x.ticks() {
            let x = self.x.at(tick.value());
            let stroke = if tick.digit == 1 { GRID } else { "#f1f3f5" };
            let _ = writeln!(
                text,
                "<path d=\"M{x:.1} {top}V{bottom}\" stroke=\"{stroke}\" fill=\"none\"/>"
            );
            if tick.labelled {
                let unit = if self.machine == Machine::Host { "s" } else { "" };
                let name = tick.prefixed(unit);
                label(text, (x, bottom + 20.0), "middle", INK, &name);
            }
        }
        for tick in self.y.ticks() {
            let y = self.y.at(tick.value());
            let stroke = if tick.digit == 1 { GRID } else { "#f1f3f5" };
            let _ = writeln!(
                text,
                "<path d=\"M{left} {y:.1}H{right}\" stroke=\"{stroke}\" fill=\"none\"/>"
            );
            if tick.labelled {
                let near = if wide { 54.0 } else { 8.0 };
                label(text, (left - near, y + 4.5), "end", INK, &tick.prefixed("m"));
                if wide {
                    label(text, (left - 8.0, y + 4.5), "end", FAINT, &tick.scientific());
                }
            }
        }
        let speed = self.x.inverse(self.real_time);
        for tick in speed.ticks().into_iter().filter(|tick| tick.labelled) {
            let x = speed.at(tick.value());
            let _ = writeln!(
                text,
                "<path d=\"M{x:.1} {:.1}v6\" stroke=\"{FAINT}\" fill=\"none\"/>",
                strip.0 - 6.0
            );
            label(text, (x, strip.0 - 11.0), "middle", INK, &format!("{}×", tick.plain()));
        }
        let (width, height) = (right - left, bottom - top);
        let _ = writeln!(
            text,
            "<rect x=\"{left}\" y=\"{top}\" width=\"{width}\" height=\"{height}\" fill=\"none\" \
             stroke=\"#aab2bc\"/>"
        );
        let axis = match self.machine {
            Machine::Host => "cost: seconds of one core per simulated second",
            Machine::Target => "cost: instructions per simulated second",
        };
        label(text, ((left + right) / 2.0, bottom + 44.0), "middle", INK, axis);
        if wide {
            label(text, (left, bottom + 44.0), "start", FAINT, "← cheaper");
            label(text, (right, bottom + 44.0), "end", FAINT, "more expensive →");
        }
        let times = format!(
            "times faster than real time{}",
            if self.machine == Machine::Target { " at 168 MHz" } else { "" }
        );
        label(text, ((left + right) / 2.0, strip.0 - 31.0), "middle", INK, &times);
        let _ = writeln!(
            text,
            "<text transform=\"translate({} {:.1}) rotate(-90)\" text-anchor=\"middle\">error: \
             distance from the reference solution, root mean square{}</text>",
            if wide { 24.0 } else { 13.0 },
            (top + bottom) / 2.0,
            if wide { " over bodies and time" } else { "" },
        );
    }

    /// The cost of real time, and the area slower than it.
    pub(super) fn real_time(&self, text: &mut String) {
        let Layout { right, top, bottom, .. } = *self.layout;
        if !self.x.holds(self.real_time) {
            return;
        }
        let x = self.x.at(self.real_time);
        let _ = writeln!(
            text,
            "<rect x=\"{x:.1}\" y=\"{top}\" width=\"{:.1}\" height=\"{:.1}\" fill=\"#d55e00\" \
             fill-opacity=\".06\"/>\n<path d=\"M{x:.1} {top}V{bottom}\" stroke=\"{INK}\" \
             stroke-dasharray=\"1 3\" stroke-width=\"2\" fill=\"none\"/>",
            right - x,
            bottom - top
        );
    }

    pub(super) fn strip(&self, text: &mut String) {
        let Layout { left, right, strip: (top, bottom), .. } = *self.layout;
        let _ = writeln!(
            text,
            "<rect x=\"{left}\" y=\"{top}\" width=\"{:.1}\" height=\"{:.1}\" fill=\"#f4f6f8\" \
             stroke=\"#aab2bc\"/>",
            right - left,
            bottom - top
        );
        label(text, (left - 8.0, (top + bottom) / 2.0 + 5.0), "end", INK, "unstable");
    }

    /// Labels at the floor and at real time.
    pub(super) fn remarks(&self, text: &mut String, positions: &mut LabelPositions) {
        let Layout { left, right, top, bottom, .. } = *self.layout;
        let mut remark = |anchor: (f64, f64), to_left: bool, said: &str| {
            let width = said.chars().count() as f64 * LABEL * 0.6;
            let x = if to_left { anchor.0 - width } else { anchor.0 };
            positions.reserve(Rectangle { x, y: anchor.1 - LABEL, width, height: LABEL + 4.0 });
            label(text, anchor, if to_left { "end" } else { "start" }, FAINT, said);
        };
        if self.y.holds(self.chart.uncertainty) {
            let y = (self.y.at(self.chart.uncertainty) + 15.0).min(bottom - 5.0);
            let floor = significant(self.chart.uncertainty, 2);
            remark(
                (left + 8.0, y),
                false,
                &format!("the reference solution is accurate to {floor} m"),
            );
        }
        if self.x.holds(self.real_time) {
            let x = self.x.at(self.real_time);
            let said = match self.machine {
                Machine::Host => "real time",
                Machine::Target => "real time at 168 MHz",
            };
            let to_left = right - x < 190.0;
            remark((if to_left { x - 6.0 } else { x + 6.0 }, top + 18.0), to_left, said);
        }
    }

    /// How to read it, above and beneath.
    pub(super) fn key(&self, text: &mut String) {
        let Layout { left, bottom, .. } = *self.layout;
        let window = significant(self.chart.window, 3);
        let above = format!(
            "Down is more accurate, left is faster; {window} s compared. Yellow band: the Pareto \
             front; no measured point is both faster and more accurate."
        );
        label(text, (left, 58.0), "start", FAINT, &above);
        let paper = match self.machine {
            Machine::Host => "Thick: the paper's scheme, dbd in f64.",
            Machine::Target => "Thick: the paper's scheme, dbd in f64 and (dashed) in f32.",
        };
        let beneath = [
            "Each mark is a step; hollow at the top: unstable, elsewhere: lost or too close to the limit. \
             Lines: solid f64, dashed f32, long dashes fixed, dotted other orientations."
                .to_owned(),
            format!(
                "{paper} Grey: references in plain Rust. Faint: variants without a point on the Pareto front."
            ),
        ];
        for (row, words) in beneath.into_iter().enumerate() {
            let y = bottom + 76.0 + 19.0 * row as f64;
            label(text, (left, y), "start", FAINT, &words);
        }
    }

    /// Mark and name of every scheme; returns the position of the last line.
    pub(super) fn legend(&self, text: &mut String) -> f64 {
        let Layout { width: whole, left, bottom, legend, .. } = *self.layout;
        let mut known: Vec<(String, &Line<'_>)> = Vec::new();
        let mut lines: Vec<&Line<'_>> = self.lines.iter().collect();
        // A scheme is represented by its plainest stepper: f64, quaternions.
        lines.sort_by_key(|line| (!line.stepper.kernel, line.stepper.precision != "f64"));
        for line in lines {
            let Stepper { scheme, newton, damping, .. } = line.stepper;
            let mut name = scheme.clone();
            if let Some(newton) = newton.filter(|newton| *newton > 0) {
                name += &format!(" +{newton}");
            }
            if let Some(damping) = damping {
                name += &format!(" ({damping})");
            }
            let used =
                !line.stable.is_empty() || !line.unstable.is_empty() || !line.hollow.is_empty();
            if used && !known.iter().any(|(other, _)| *other == name) {
                known.push((name, line));
            }
        }
        let start = if self.layout.wide { left } else { 12.0 };
        let (mut x, mut y) = (start, bottom + legend);
        for (name, line) in known {
            let width = name.chars().count() as f64 * LABEL * 0.58 + 30.0;
            if x + width > whole - 8.0 {
                (x, y) = (start, y + 19.0);
            }
            text.push_str(&line.style.mark((x + 6.0, y - 4.5), MARK, false, ""));
            label(text, (x + 16.0, y), "start", line.style.text, &name);
            x += width;
        }
        y
    }
}
