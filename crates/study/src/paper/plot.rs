//! A plot as an SVG, in the paper's axes.
//!
//! `plot => SVG`. What is the paper's is drawn in one colour, hollow or dashed; what is measured here in
//! others.

use std::fmt::Write as _;

use dbd_report::output::dark::adapted;
use dbd_report::output::markup::escape;
use dbd_report::output::svg::{joined, label};

use crate::paper::finding::{Curve, Map, Plot};

/// [pixels]
const SIZE: [f64; 2] = [760.0, 430.0];
const LEFT: f64 = 84.0;
const RIGHT: f64 = 16.0;
const TOP: f64 = 36.0;
const BOTTOM: f64 = 56.0;
const LINE: f64 = 18.0;

const INK: &str = "#333a45";
const GRID: &str = "#d9dee4";
const PAPER: &str = "#c0392b";
const OURS: [&str; 12] = [
    "#0072b2", "#009e73", "#cc79a7", "#e69f00", "#56b4e9", "#8a7f00", "#d55e00", "#6b737e",
    "#00755a", "#a04478", "#946600", "#005e94",
];

/// An axis from one pixel to another.
struct Scale {
    low: f64,
    high: f64,
    from: f64,
    to: f64,
    logarithmic: bool,
}

impl Scale {
    fn new(
        values: impl Iterator<Item = f64>,
        logarithmic: bool,
        [from, to]: [f64; 2],
    ) -> Option<Self> {
        let drawn = |value: &f64| value.is_finite() && (!logarithmic || *value > 0.0);
        let of = |value: f64| if logarithmic { value.log10() } else { value };
        let (low, high) = values
            .filter(drawn)
            .map(of)
            .fold((f64::INFINITY, f64::NEG_INFINITY), |(low, high), v| (low.min(v), high.max(v)));
        if low > high {
            return None;
        }
        let room = if high > low { 0.04 * (high - low) } else { 0.5 };
        // What begins at 0 keeps its 0.
        let low = if !logarithmic && low == 0.0 { 0.0 } else { low - room };
        Some(Self { low, high: high + room, from, to, logarithmic })
    }

    fn at(&self, value: f64) -> f64 {
        let value = if self.logarithmic { value.log10() } else { value };
        self.from + (value - self.low) / (self.high - self.low) * (self.to - self.from)
    }

    /// Values with a grid line, and what is written there.
    fn ticks(&self) -> Vec<(f64, String)> {
        if self.logarithmic {
            let (low, high) = (self.low.ceil() as i32, self.high.floor() as i32);
            let every = ((high - low) / 8).max(1);
            let mut ticks: Vec<(f64, String)> = (low..=high)
                .filter(|decade| (decade - low) % every == 0)
                .map(|decade| (10.0_f64.powi(decade), power(decade)))
                .collect();
            // A narrow axis takes digits, too.
            if ticks.len() < 2 {
                for decade in self.low.floor() as i32..=high {
                    for digit in [2.0, 5.0] {
                        let value = digit * 10.0_f64.powi(decade);
                        if (self.low..=self.high).contains(&value.log10()) {
                            ticks.push((value, format!("{digit}·{}", power(decade))));
                        }
                    }
                }
            }
            return ticks;
        }
        let raw = (self.high - self.low) / 6.0;
        let decade = 10.0_f64.powf(raw.log10().floor());
        let steps = [1.0, 2.0, 5.0, 10.0].map(|digit| digit * decade);
        let step = steps.into_iter().find(|step| *step >= raw).unwrap_or(raw);
        let digits = (-step.log10().floor()).max(0.0) as usize;
        let first = (self.low / step).ceil() as i64;
        let last = (self.high / step).floor() as i64;
        (first..=last).map(|n| (n as f64 * step, format!("{:.digits$}", n as f64 * step))).collect()
    }
}

/// A power of ten.
fn power(decade: i32) -> String {
    const RAISED: [char; 10] = ['⁰', '¹', '²', '³', '⁴', '⁵', '⁶', '⁷', '⁸', '⁹'];
    let digits = decade.unsigned_abs().to_string();
    let sign = if decade < 0 { "⁻" } else { "" };
    let raised = digits.bytes().map(|digit| RAISED[usize::from(digit - b'0')]);
    format!("10{sign}{}", raised.collect::<String>())
}

/// The plot; with words only where there is nothing to draw.
#[must_use]
pub fn svg(plot: &Plot) -> String {
    let all = || plot.curves.iter().flat_map(|curve| &curve.points);
    let map = plot.map.as_ref();
    let rows = plot.curves.len().div_ceil(2);
    let height = SIZE[1] + LINE * rows as f64;
    let title = escape(&plot.title);
    let mut text = format!(
        "<svg xmlns=\"http://www.w3.org/2000/svg\" width=\"{}\" height=\"{height}\" viewBox=\"0 0 {} {height}\" \
         role=\"img\" aria-label=\"{title}\" font-family=\"system-ui, 'DejaVu Sans', sans-serif\" font-size=\"13\" fill=\"{INK}\">\n\
         <rect width=\"{}\" height=\"{height}\" fill=\"#fff\"/>\n\
         <text x=\"{LEFT}\" y=\"22\" font-size=\"15\" font-weight=\"600\">{title}</text>\n",
        SIZE[0], SIZE[0], SIZE[0]
    );
    let x = all().map(|p| p[0]).chain(map.iter().flat_map(|map| map.x.iter().copied()));
    let y = all().map(|p| p[1]).chain(map.iter().flat_map(|map| map.y.iter().copied()));
    let x = Scale::new(x, plot.logarithmic[0], [LEFT, SIZE[0] - RIGHT]);
    let y = Scale::new(y, plot.logarithmic[1], [SIZE[1] - BOTTOM, TOP]);
    match (x, y) {
        (Some(x), Some(y)) => draw(&mut text, plot, &x, &y),
        _ => label(&mut text, (LEFT, TOP + LINE), "start", INK, "Nothing to draw."),
    }
    text.push_str("</svg>\n");
    adapted(&text)
}

fn draw(text: &mut String, plot: &Plot, x: &Scale, y: &Scale) {
    if let Some(map) = &plot.map {
        shade(text, map, x, y);
    }
    for (value, words) in x.ticks() {
        let at = x.at(value);
        let _ = writeln!(
            text,
            "<path d=\"M{at:.1} {TOP}V{:.1}\" stroke=\"{GRID}\"/>",
            SIZE[1] - BOTTOM
        );
        label(text, (at, SIZE[1] - BOTTOM + LINE), "middle", INK, &words);
    }
    for (value, words) in y.ticks() {
        let at = y.at(value);
        let _ = writeln!(
            text,
            "<path d=\"M{LEFT} {at:.1}H{:.1}\" stroke=\"{GRID}\"/>",
            SIZE[0] - RIGHT
        );
        label(text, (LEFT - 8.0, at + 4.0), "end", INK, &words);
    }
    label(
        text,
        (0.5 * (LEFT + SIZE[0] - RIGHT), SIZE[1] - BOTTOM + 2.2 * LINE),
        "middle",
        INK,
        &plot.axes[0],
    );
    let _ = writeln!(
        text,
        "<text transform=\"translate(18 {:.1}) rotate(-90)\" text-anchor=\"middle\">{}</text>",
        0.5 * (TOP + SIZE[1] - BOTTOM),
        escape(&plot.axes[1])
    );
    let mut ours = OURS.iter().cycle();
    for (row, curve) in plot.curves.iter().enumerate() {
        let colour = if curve.paper { PAPER } else { ours.next().map_or(INK, |colour| *colour) };
        trace(text, curve, colour, x, y);
        let place = (LEFT + 340.0 * (row % 2) as f64, SIZE[1] + LINE * (row / 2) as f64);
        let _ = writeln!(
            text,
            "<path d=\"M{:.1} {:.1}h24\" stroke=\"{colour}\" stroke-width=\"3\"/>",
            place.0,
            place.1 - 4.0
        );
        label(text, (place.0 + 30.0, place.1), "start", INK, &curve.name);
    }
}

fn trace(text: &mut String, curve: &Curve, colour: &str, x: &Scale, y: &Scale) {
    let drawn = |[a, b]: &[f64; 2]| {
        let fits = |scale: &Scale, v: f64| v.is_finite() && (!scale.logarithmic || v > 0.0);
        (fits(x, *a) && fits(y, *b)).then(|| (x.at(*a), y.at(*b)))
    };
    let points: Vec<(f64, f64)> = curve.points.iter().filter_map(drawn).collect();
    if curve.line {
        let dash = if curve.paper { " stroke-dasharray=\"6 4\"" } else { "" };
        let _ = writeln!(
            text,
            "<polyline points=\"{}\" fill=\"none\" stroke=\"{colour}\" stroke-width=\"2\"{dash}/>",
            joined(&points)
        );
    }
    // A mark per point would hide a spectrum.
    if points.len() > 400 && curve.line {
        return;
    }
    let fill = if curve.paper { "none" } else { colour };
    let radius = if points.len() > 100 { 1.5 } else { 4.0 };
    for (x, y) in &points {
        let _ = writeln!(
            text,
            "<circle cx=\"{x:.1}\" cy=\"{y:.1}\" r=\"{radius}\" fill=\"{fill}\" stroke=\"{colour}\" stroke-width=\"1.5\"/>"
        );
    }
}

/// Cells of a map, the darker the larger.
fn shade(text: &mut String, map: &Map, x: &Scale, y: &Scale) {
    let edge = |values: &[f64], n: usize, scale: &Scale| {
        let next = values.get(n + 1).copied();
        let step =
            next.map_or_else(|| values[n] - values[n.saturating_sub(1)], |next| next - values[n]);
        (scale.at(values[n] - 0.5 * step), scale.at(values[n] + 0.5 * step))
    };
    for (row, values) in map.values.iter().enumerate() {
        let (low, high) = edge(&map.y, row, y);
        for (column, value) in values.iter().enumerate().filter(|(_, value)| **value > 0.02) {
            let (left, right) = edge(&map.x, column, x);
            let _ = writeln!(
                text,
                "<rect x=\"{left:.1}\" y=\"{high:.1}\" width=\"{:.1}\" height=\"{:.1}\" fill=\"{}\" fill-opacity=\"{value:.2}\"/>",
                right - left,
                low - high,
                OURS[0]
            );
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    fn plot(points: Vec<[f64; 2]>, logarithmic: bool) -> Plot {
        Plot {
            name: String::new(),
            title: "a < b".into(),
            axes: ["x".into(), "y".into()],
            logarithmic: [logarithmic; 2],
            curves: vec![Curve { name: "c".into(), paper: true, line: true, points }],
            map: None,
        }
    }

    #[test]
    fn every_point_lies_on_the_sheet_and_words_are_no_markup() {
        for logarithmic in [false, true] {
            let drawn = svg(&plot(vec![[1e-9, 3.0], [5.0, 1e6], [2.0, f64::NAN]], logarithmic));
            assert!(drawn.contains("a &lt; b"));
            assert_eq!(drawn.matches("<circle").count(), 2);
            for part in drawn.split("<circle cx=\"").skip(1) {
                let mut numbers = part.split('"');
                let x: f64 = numbers.next().unwrap().parse().unwrap();
                let y: f64 = numbers.nth(1).unwrap().parse().unwrap();
                assert!((LEFT..=SIZE[0]).contains(&x) && (TOP..=SIZE[1]).contains(&y), "{x} {y}");
            }
        }
        assert!(svg(&plot(Vec::new(), true)).contains("Nothing to draw."));
        assert!(svg(&plot(vec![[0.0, -1.0]], true)).contains("Nothing to draw."));
    }

    #[test]
    fn axes_have_ticks_that_people_read() {
        let words = |low: f64, high: f64, logarithmic: bool| -> Vec<String> {
            let scale = Scale::new([low, high].into_iter(), logarithmic, [0.0, 100.0]).unwrap();
            scale.ticks().into_iter().map(|(_, words)| words).collect()
        };
        assert_eq!(words(0.0, 1.0, false), ["0.0", "0.2", "0.4", "0.6", "0.8", "1.0"]);
        assert_eq!(words(1e-3, 10.0, true), ["10⁻³", "10⁻²", "10⁻¹", "10⁰", "10¹"]);
        assert!(words(1.5, 6.0, true).len() >= 2);
    }
}
