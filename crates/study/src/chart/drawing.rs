//! The drawing: dimensions, lines and marks.
//!
//! `(points, machine) => SVG`. Elements around, below and beside the lines are in the modules after this one.

use std::collections::BTreeMap;
use std::fmt::Write as _;

use dbd_plant::time::display;
use dbd_report::output::dark::adapted;
use dbd_report::output::markup::escape;
use dbd_report::output::svg::{joined, label};

use crate::advice::remark;
use crate::chart::axis::Axis;
use crate::chart::layout::{Layout, NARROW, WIDE};
use crate::chart::style::{FRONT, INK, Style};
use crate::command::Command;
use crate::point::{Machine, Point, Stepper, front, is_paper};
use crate::variants::Compared;
use crate::words::{Cost, times};

/// Data of a chart.
pub struct Chart<'c> {
    /// The scene's name.
    pub scene: &'c str,
    /// Description of the scene.
    pub description: &'c str,
    /// \[s\] the time compared.
    pub window: f64,
    /// \[m\] uncertainty of the reference solution.
    pub uncertainty: f64,
    /// Measured points.
    pub points: &'c [Point],
    /// How its points are run.
    pub command: Command,
    /// Instructions per second of the target's processor: real time.
    pub real_time_instructions: f64,
    /// Processor, build and whatever else the measurements depend on: lines of text.
    pub conditions: &'c [String],
    /// The scene and its variants.
    pub variants: &'c [Compared],
}

/// [pixels] of the largest text; a character is about 0.6 of that wide.
pub(super) const LABEL: f64 = 13.0;
pub(super) const MARK: f64 = 4.6;

/// The chart for a machine, light or dark as the reader's screen is.
#[must_use]
pub fn svg(chart: &Chart<'_>, machine: Machine) -> String {
    drawn(chart, machine, &WIDE)
}

/// The same for a phone: lines, marks and their legend, without words.
#[must_use]
pub fn narrow_svg(chart: &Chart<'_>, machine: Machine) -> String {
    drawn(chart, machine, &NARROW)
}

/// [pixels] free beneath the last line of the legend.
const BELOW_LEGEND: f64 = 15.0;

fn drawn(chart: &Chart<'_>, machine: Machine, layout: &Layout) -> String {
    let Layout { width, left, .. } = *layout;
    let title = escape(&title(chart, machine));
    let (mut drawn, mut height) = (String::new(), layout.height);
    if layout.wide {
        let _ = writeln!(
            drawn,
            "<text x=\"{left}\" y=\"34\" font-size=\"21\" font-weight=\"600\">{title}</text>"
        );
    }
    match Drawing::new(chart, machine, layout) {
        // A long legend makes it higher.
        Some(drawing) => height = height.max(drawing.draw(&mut drawn) + BELOW_LEGEND),
        None => {
            let why = remark(chart.points, machine).unwrap_or("nothing to draw");
            label(&mut drawn, (left, 90.0), "start", INK, &format!("Nothing to draw: {why}."));
        }
    }
    let text = format!(
        "<svg xmlns=\"http://www.w3.org/2000/svg\" width=\"{width}\" height=\"{height}\" \
         viewBox=\"0 0 {width} {height}\" role=\"img\" aria-label=\"{title}\" \
         font-family=\"system-ui, 'DejaVu Sans', sans-serif\" font-size=\"{LABEL}\" fill=\"{INK}\">\n\
         <rect width=\"{width}\" height=\"{height}\" fill=\"#fff\"/>\n{drawn}</svg>\n"
    );
    adapted(&text)
}

fn title(chart: &Chart<'_>, machine: Machine) -> String {
    let whose = match machine {
        Machine::Host => "on this PC",
        Machine::Target => "on a Cortex-M4F",
    };
    format!("{}: accuracy against speed {whose}", chart.scene)
}

/// The steppers in the order in which both charts and the page number them.
#[must_use]
pub fn steppers(points: &[Point]) -> BTreeMap<&Stepper, usize> {
    let mut rows: BTreeMap<&Stepper, usize> =
        points.iter().map(|point| (&point.stepper, 0)).collect();
    rows.values_mut().enumerate().for_each(|(row, number)| *number = row);
    rows
}

/// Tooltip of a point.
#[must_use]
pub fn hover(point: &Point, machine: Machine, real_time: f64) -> String {
    let mut text = format!("{}\nstep {}", point.stepper.label(), display(point.step));
    text += &match point.drawn(machine) {
        Some((_, error)) if point.lost => format!("\nlost: error {error:.2e} m"),
        Some((_, error)) if !point.advisable => {
            format!("\nerror {error:.2e} m, too close to the stability limit to be advised")
        }
        Some((_, error)) => format!("\nerror {error:.2e} m"),
        None => "\nunstable".into(),
    };
    if let Some(cost) = point.cost(machine).filter(|cost| cost.is_finite() && *cost > 0.0) {
        let speed = times(real_time / cost);
        text += &format!("\n{}\n{speed} × real time", Cost(cost, machine));
    }
    if let Some(energy) = point.energy_rms.filter(|energy| energy.is_finite()) {
        text += &format!("\nenergy error {energy:.2e} J rms");
    }
    text
}

/// A chart with its axes.
pub(super) struct Drawing<'d> {
    pub(super) chart: &'d Chart<'d>,
    pub(super) machine: Machine,
    pub(super) layout: &'d Layout,
    /// Cost that is just real time.
    pub(super) real_time: f64,
    pub(super) x: Axis,
    pub(super) y: Axis,
    pub(super) lines: Vec<Line<'d>>,
    pub(super) front: Vec<usize>,
}

/// A stepper on the chart: rows of its points, the cheapest first.
pub(super) struct Line<'d> {
    pub(super) stepper: &'d Stepper,
    pub(super) number: usize,
    pub(super) style: Style,
    /// The paper's scheme.
    pub(super) paper: bool,
    /// A variant without a point on the front: drawn faintly.
    pub(super) quiet: bool,
    pub(super) stable: Vec<usize>,
    pub(super) hollow: Vec<usize>,
    pub(super) unstable: Vec<usize>,
}

impl Line<'_> {
    pub(super) fn opacity(&self) -> &'static str {
        if self.quiet { " opacity=\".4\"" } else { "" }
    }
}

impl<'d> Drawing<'d> {
    pub(super) fn new(chart: &'d Chart<'d>, machine: Machine, layout: &'d Layout) -> Option<Self> {
        let points = chart.points;
        if remark(points, machine).is_some() {
            return None;
        }
        let found = || points.iter().filter_map(|point| point.kept(machine));
        let costs = points.iter().filter_map(|point| point.cost(machine));
        let Layout { left, right, top, bottom, room, .. } = *layout;
        let x = Axis::new(costs, (left, right), room, 62.0)?;
        let errors = found().map(|(_, error)| error);
        // The floor is shown if it is near the measured errors.
        let least = found().map(|(_, error)| error).fold(f64::INFINITY, f64::min);
        let floor = Some(chart.uncertainty).filter(|floor| *floor > least / 100.0);
        let y = Axis::new(errors.chain(floor), (bottom, top), (24.0, 16.0), 16.0)?;
        let real_time = match machine {
            Machine::Host => 1.0,
            Machine::Target => chart.real_time_instructions,
        };
        let front = front(points, machine);
        let mut references = 0;
        let lines = steppers(points)
            .into_iter()
            .map(|(stepper, number)| {
                let paper = is_paper(stepper, machine);
                let row = if stepper.kernel { number } else { references };
                let style = Style::of(stepper, row, paper);
                references += usize::from(!stepper.kernel);
                let cost = |row: &usize| points[*row].cost(machine).filter(|cost| *cost > 0.0);
                let mut rows: Vec<usize> = (0..points.len())
                    .filter(|row| points[*row].stepper == *stepper)
                    .filter(|row| cost(row).is_some_and(f64::is_finite))
                    .collect();
                rows.sort_by(|a, b| cost(a).unwrap_or(0.0).total_cmp(&cost(b).unwrap_or(0.0)));
                let (drawn, unstable): (Vec<_>, Vec<_>) =
                    rows.into_iter().partition(|row| points[*row].drawn(machine).is_some());
                let (stable, hollow) =
                    drawn.into_iter().partition(|row| points[*row].kept(machine).is_some());
                let usual = stepper.precision == "f64" && stepper.orientation == "quaternion";
                let quiet =
                    !usual && !paper && !front.iter().any(|row| points[*row].stepper == *stepper);
                Line { stepper, number, style, paper, quiet, stable, hollow, unstable }
            })
            .collect();
        Some(Self { chart, machine, layout, real_time, x, y, lines, front })
    }

    /// Where a point lies.
    pub(super) fn at(&self, row: usize) -> (f64, f64) {
        let (cost, error) = self.chart.points[row].drawn(self.machine).unwrap_or((0.0, 0.0));
        (self.x.at(cost), self.y.at(error))
    }

    /// Draws it all; the last line of the legend.
    fn draw(&self, text: &mut String) -> f64 {
        self.floor(text);
        self.grid(text);
        self.real_time(text);
        let band = self.band();
        if !band.is_empty() {
            let _ = writeln!(
                text,
                "<polyline points=\"{}\" fill=\"none\" stroke=\"{FRONT}\" stroke-width=\"11\" \
                 stroke-linejoin=\"round\" stroke-linecap=\"round\"/>",
                joined(&band)
            );
        }
        // The paper's line lies beneath the others, so that its width hides none.
        let (paper, others): (Vec<&Line<'_>>, Vec<&Line<'_>>) =
            self.lines.iter().partition(|line| line.paper);
        let (quiet, others): (Vec<_>, Vec<_>) = others.into_iter().partition(|line| line.quiet);
        let (kernel, references): (Vec<_>, Vec<_>) =
            others.into_iter().partition(|line| line.stepper.kernel);
        let order: Vec<&Line<'_>> =
            quiet.into_iter().chain(paper).chain(references).chain(kernel).collect();
        for line in &order {
            self.line(text, line);
        }
        self.strip(text);
        for line in &order {
            self.marks(text, line);
        }
        let wide = self.layout.wide;
        let choices = if wide { self.choices() } else { Vec::new() };
        self.panel(text, &choices);
        self.labels(text, &order, &band, &choices);
        if wide {
            self.key(text);
        }
        self.legend(text)
    }

    /// The front as steps: at each cost the least error that it buys.
    pub(super) fn band(&self) -> Vec<(f64, f64)> {
        let mut corners: Vec<(f64, f64)> = Vec::new();
        for row in &self.front {
            let (x, y) = self.at(*row);
            if let Some((_, last)) = corners.last().copied() {
                corners.push((x, last));
            }
            corners.push((x, y));
        }
        corners
    }

    fn line(&self, text: &mut String, line: &Line<'_>) {
        let corners: Vec<_> = line.stable.iter().map(|row| self.at(*row)).collect();
        if corners.len() < 2 {
            return;
        }
        let points = joined(&corners);
        let _ = writeln!(
            text,
            "<g class=\"stepper\" data-stepper=\"{}\"{}><polyline points=\"{points}\" {}/>\
             <polyline points=\"{points}\" fill=\"none\" stroke=\"#000\" stroke-opacity=\"0\" \
             stroke-width=\"12\"><title>{}</title></polyline></g>",
            line.number,
            line.opacity(),
            line.style.line(),
            escape(&line.stepper.label())
        );
    }

    fn marks(&self, text: &mut String, line: &Line<'_>) {
        let number = line.number;
        let _ = writeln!(text, "<g class=\"stepper\" data-stepper=\"{number}\"{}>", line.opacity());
        let title =
            |row: usize| escape(&hover(&self.chart.points[row], self.machine, self.real_time));
        for row in &line.stable {
            if self.front.contains(row) {
                let (x, y) = self.at(*row);
                let _ = writeln!(
                    text,
                    "<circle cx=\"{x:.1}\" cy=\"{y:.1}\" r=\"9\" fill=\"{FRONT}\" \
                     stroke=\"{INK}\" stroke-width=\"1.4\"/>"
                );
            }
            let size = if line.quiet { 0.75 * MARK } else { MARK };
            text.push_str(&line.style.mark(self.at(*row), size, false, &title(*row)));
        }
        // Those beyond the axis lie at its end.
        for row in &line.hollow {
            text.push_str(&line.style.mark(self.at(*row), 0.75 * MARK, true, &title(*row)));
        }
        // One row in the strip per stepper.
        let (top, bottom) = (self.layout.strip.0 + 6.0, self.layout.strip.1 - 6.0);
        let share = (number as f64 + 0.5) / self.lines.len() as f64;
        for row in &line.unstable {
            let cost = self.chart.points[*row].cost(self.machine).unwrap_or(0.0);
            let at = (self.x.at(cost), top + share * (bottom - top));
            text.push_str(&line.style.mark(at, MARK, true, &title(*row)));
        }
        text.push_str("</g>\n");
    }
}
