//! One panel of curves over time as an SVG.
//!
//! `(unit, curves) => SVG`. Axes carry an SI prefix that keeps the ticks short; names and colours
//! of the curves belong to the caption, not to the drawing.

use std::fmt::Write as _;

use crate::output::dark::adapted;
use crate::output::markup::escape;
use crate::output::svg::{joined, label};

/// A curve to draw.
pub struct Line<'c> {
    /// (time \[s\], value).
    pub points: &'c [(f64, f64)],
    /// Its colour, as `#rrggbb`.
    pub colour: &'c str,
}

/// What to draw.
pub struct Panel<'c> {
    /// \[pixels\] width and height.
    pub size: (f64, f64),
    /// What the y axis shows, before its unit.
    pub quantity: &'c str,
    /// Its unit without a prefix.
    pub unit: &'c str,
    /// The curves, in the order they are drawn.
    pub lines: Vec<Line<'c>>,
}

const INK: &str = "#333a45";
const AXIS: &str = "#8f949b";
const GRID: &str = "#e3e7ec";

/// \[pixels\] left, top, right and bottom of the axes within the drawing.
const MARGINS: [f64; 4] = [82.0, 8.0, 20.0, 52.0];

/// \[pixels\] at least from one tick to the next, across and up.
const APART: [f64; 2] = [70.0, 22.0];

/// Axes of fewer values show them all.
const FEWEST_TO_CUT: usize = 50;

/// SI prefixes and their exponents.
const PREFIXES: [(&str, i32); 10] = [
    ("p", -12),
    ("n", -9),
    ("µ", -6),
    ("m", -3),
    ("", 0),
    ("k", 3),
    ("M", 6),
    ("G", 9),
    ("T", 12),
    ("P", 15),
];

/// Draws a panel; `None` where there is nothing to draw.
#[must_use]
pub fn svg(panel: &Panel<'_>) -> Option<String> {
    let points = || panel.lines.iter().flat_map(|line| line.points.iter().copied());
    let x = Axis::new("time", "s", points().map(|p| p.0), Room::None)?;
    let y = Axis::new(panel.quantity, panel.unit, points().map(|p| p.1), Room::Some)?;
    let (width, height) = panel.size;
    let [left, top] = [MARGINS[0], MARGINS[1]];
    let [right, bottom] = [width - MARGINS[2], height - MARGINS[3]];
    let across = |value: f64| left + (value - x.low) / (x.high - x.low) * (right - left);
    let up = |value: f64| bottom - (value - y.low) / (y.high - y.low) * (bottom - top);
    let mut text = format!(
        "<svg xmlns=\"http://www.w3.org/2000/svg\" width=\"{width}\" height=\"{height}\" \
         viewBox=\"0 0 {width} {height}\" font-family=\"sans-serif\" font-size=\"15\" \
         fill=\"{INK}\">\n"
    );
    for value in x.ticks((right - left) / APART[0]) {
        let at = across(value);
        let _ = writeln!(text, "<path d=\"M{at:.1} {top}V{bottom}\" stroke=\"{GRID}\"/>");
        label(&mut text, (at, bottom + 20.0), "middle", INK, &tick(value, x.high - x.low));
    }
    for value in y.ticks((bottom - top) / APART[1]) {
        let at = up(value);
        let _ = writeln!(text, "<path d=\"M{left} {at:.1}H{right}\" stroke=\"{GRID}\"/>");
        label(&mut text, (left - 8.0, at + 5.0), "end", INK, &tick(value, y.high - y.low));
    }
    let (middle, centre) = (0.5 * (left + right), 0.5 * (top + bottom));
    let _ = writeln!(
        text,
        "<path d=\"M{left} {top}V{bottom}H{right}\" fill=\"none\" stroke=\"{AXIS}\"/>\n\
         <text transform=\"translate(15 {centre:.1}) rotate(-90)\" text-anchor=\"middle\">{}</text>",
        escape(&y.label),
    );
    label(&mut text, (middle, height - 10.0), "middle", INK, &x.label);
    for line in &panel.lines {
        let drawn = line.points.iter().filter(|(t, v)| t.is_finite() && !v.is_nan());
        let corners: Vec<(f64, f64)> =
            drawn.map(|&(t, v)| (across(t * x.scale), up(y.clip(v * y.scale)))).collect();
        let _ = writeln!(
            text,
            "<polyline points=\"{}\" fill=\"none\" stroke=\"{}\" stroke-width=\"2\" \
             stroke-linejoin=\"round\"/>",
            joined(&corners),
            line.colour,
        );
    }
    text.push_str("</svg>\n");
    Some(adapted(&text))
}

/// Whether an axis ends at its outermost values or somewhat beyond.
enum Room {
    None,
    Some,
}

/// An axis in a prefixed unit.
struct Axis {
    low: f64,
    high: f64,
    scale: f64,
    label: String,
}

impl Axis {
    fn new(
        quantity: &str,
        unit: &str,
        values: impl Iterator<Item = f64>,
        room: Room,
    ) -> Option<Self> {
        let mut sorted: Vec<f64> = values.filter(|value| value.is_finite()).collect();
        sorted.sort_by(f64::total_cmp);
        let (mut low, mut high) = (*sorted.first()?, *sorted.last()?);
        // A run that diverges would hide all that came before: show the middle 90 % and a margin.
        let at = |share: f64| sorted[((sorted.len() - 1) as f64 * share) as usize];
        let (usual_low, usual_high) = (at(0.05), at(0.95));
        let usual = usual_high - usual_low;
        let cut = sorted.len() >= FEWEST_TO_CUT && usual > 0.0 && high - low > 100.0 * usual;
        if cut {
            low = low.max(usual_low - 2.0 * usual);
            high = high.min(usual_high + 2.0 * usual);
        }
        let largest = low.abs().max(high.abs());
        // A curve that does not move is flat, not a picture of its rounding.
        let least = if largest > 0.0 { 1e-6 * largest } else { 1.0 };
        if let Room::Some = room {
            let padding = ((high - low) * 0.06).max(least);
            (low, high) = (low - padding, high + padding);
        } else if high <= low {
            high = low + least;
        }
        let (prefix, exponent) = prefix(if largest > 0.0 { largest } else { 1.0 });
        let scale = 10_f64.powi(-exponent);
        let remark = if cut { ", cut off" } else { "" };
        let label = format!("{quantity} [{prefix}{unit}]{remark}");
        Some(Self { low: low * scale, high: high * scale, scale, label })
    }

    /// Round numbers along the axis: at most `most`, and three at least where it is long enough.
    fn ticks(&self, most: f64) -> Vec<f64> {
        let range = self.high - self.low;
        let coarse = range / most.max(1.0);
        let decade = 10_f64.powf(coarse.log10().floor());
        let steps = [1.0, 2.0, 5.0, 10.0].map(|step| step * decade);
        let step = steps.into_iter().find(|step| *step >= coarse).unwrap_or(steps[3]);
        let first = (self.low / step).ceil();
        let last = (self.high / step).floor();
        let count = (last - first).clamp(-1.0, 100.0) as i32;
        (0..=count).map(|n| (first + f64::from(n)) * step).collect()
    }

    fn clip(&self, value: f64) -> f64 {
        value.clamp(self.low, self.high)
    }
}

/// The largest prefix whose unit is not larger than `value`; one of the outermost beyond them.
fn prefix(value: f64) -> (&'static str, i32) {
    let fits = |(_, exponent): &&(&str, i32)| 10_f64.powi(*exponent) <= value;
    *PREFIXES.iter().rev().find(fits).unwrap_or(&PREFIXES[0])
}

/// A tick's number, with the digits that tell it from its neighbours.
fn tick(value: f64, range: f64) -> String {
    // Ticks stand at multiples of a tenth of the range or so; what is much smaller is rounding.
    if value.abs() < 1e-6 * range {
        return "0".into();
    }
    let digits = (2.0 - range.log10()).ceil().clamp(0.0, 12.0) as usize;
    let text = format!("{value:.digits$}");
    if value.abs() >= 1e7 {
        return format!("{value:.2e}");
    }
    match text.contains('.') {
        true => text.trim_end_matches('0').trim_end_matches('.').replace('-', "−"),
        false => text.replace('-', "−"),
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    fn drawn(points: &[(f64, f64)]) -> Option<String> {
        let lines = vec![Line { points, colour: "#0072b2" }];
        svg(&Panel { size: (600.0, 240.0), quantity: "energy", unit: "J", lines })
    }

    #[test]
    fn any_curve_can_be_drawn() {
        let curves: [&[(f64, f64)]; 6] = [
            &[(0.0, 0.0)],
            &[(0.0, 0.0), (1.0, 0.0)],
            &[(0.0, 3.8), (1e-6, 3.8 + 1e-15)],
            &[(0.0, 1e300), (1.0, -1e300)],
            &[(0.0, 1e-300), (1.0, 2e-300)],
            &[(0.0, 5e-324), (1e9, f64::NAN)],
        ];
        for points in curves {
            let svg = drawn(points).unwrap();
            assert!(svg.starts_with("<svg") && svg.trim_end().ends_with("</svg>"));
        }
        assert_eq!(drawn(&[]), None);
        assert_eq!(drawn(&[(0.0, f64::NAN)]), None);
    }

    #[test]
    fn axes_have_prefixes_and_short_ticks() {
        let svg = drawn(&[(0.0, 1e-6), (0.5, 4e-6)]).unwrap();
        assert!(svg.contains("energy [µJ]") && svg.contains("time [ms]"), "{svg}");
        let axis = Axis::new("a", "m", [-0.3, 1.0].into_iter(), Room::None).unwrap();
        assert_eq!(
            axis.ticks(5.0).iter().map(|t| tick(*t, 1.3)).collect::<Vec<_>>(),
            ["0", "0.5", "1"]
        );
        assert_eq!(prefix(999.0).0, "");
        assert_eq!(prefix(1000.0).0, "k");
        assert_eq!(prefix(1e-30).0, "p");
        assert_eq!(tick(0.1 + 0.2, 1.0), "0.3");
        assert_eq!(tick(-2.5, 8.0), "−2.5");
        assert_eq!(tick(1e-17, 1.0), "0");
        assert_eq!(tick(100.0, 500.0), "100");
    }

    #[test]
    fn what_diverges_does_not_hide_what_came_before() {
        let points: Vec<(f64, f64)> = (0..200)
            .map(|i| (f64::from(i), if i < 195 { f64::from(i % 10) } else { 1e200 }))
            .collect();
        let values = points.iter().map(|p| p.1);
        let axis = Axis::new("energy", "J", values, Room::Some).unwrap();
        assert!(axis.high < 100.0 && axis.low < 0.0, "{} {}", axis.low, axis.high);
        assert_eq!(axis.label, "energy [J], cut off");
    }
}
