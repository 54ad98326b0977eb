//! One panel of curves over time as an SVG.
//!
//! `(unit, curves) => SVG`. Axes carry an SI prefix that keeps the ticks short; names and colours
//! of the curves belong to the caption, not to the drawing.

use plotters::coord::Shift;
use plotters::prelude::*;

/// A curve to draw.
pub struct Line<'c> {
    /// (time \[s\], value).
    pub points: &'c [(f64, f64)],
    /// Its colour.
    pub colour: RGBColor,
}

/// What to draw.
pub struct Panel<'c> {
    /// Pixels.
    pub size: (u32, u32),
    /// What the y axis shows, before its unit.
    pub quantity: &'c str,
    /// Its unit without a prefix.
    pub unit: &'c str,
    /// The curves, in the order they are drawn.
    pub lines: Vec<Line<'c>>,
}

const INK: RGBColor = RGBColor(0x33, 0x3a, 0x45);
const GRID: RGBColor = RGBColor(0xe3, 0xe7, 0xec);
const FONT: &str = "sans-serif";

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
    let mut text = String::new();
    let root = SVGBackend::with_string(&mut text, panel.size).into_drawing_area();
    draw(panel, &root)?;
    root.present().ok()?;
    drop(root);
    Some(text)
}

fn draw(panel: &Panel<'_>, root: &DrawingArea<SVGBackend<'_>, Shift>) -> Option<()> {
    let points = || panel.lines.iter().flat_map(|line| line.points.iter().copied());
    let x = Axis::new("time", "s", points().map(|p| p.0), Room::None)?;
    let y = Axis::new(panel.quantity, panel.unit, points().map(|p| p.1), Room::Some)?;
    let mut chart = ChartBuilder::on(root)
        .margin(6)
        .margin_right(18)
        .x_label_area_size(46)
        .y_label_area_size(76)
        .build_cartesian_2d(x.low..x.high, y.low..y.high)
        .ok()?;
    chart
        .configure_mesh()
        .light_line_style(TRANSPARENT)
        .bold_line_style(GRID)
        .axis_style(INK.mix(0.55))
        .label_style((FONT, 15).into_font().color(&INK))
        .axis_desc_style((FONT, 15).into_font().color(&INK))
        .x_labels(11)
        .y_labels(8)
        .x_desc(&x.label)
        .y_desc(&y.label)
        .x_label_formatter(&|value| tick(*value, x.high - x.low))
        .y_label_formatter(&|value| tick(*value, y.high - y.low))
        .draw()
        .ok()?;
    for line in &panel.lines {
        let scaled = line.points.iter().map(|&(t, v)| (t * x.scale, y.clip(v * y.scale)));
        let style = line.colour.stroke_width(2);
        chart.draw_series(LineSeries::new(scaled, style)).ok()?;
    }
    Some(())
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
        let lines = vec![Line { points, colour: BLUE }];
        svg(&Panel { size: (600, 240), quantity: "energy", unit: "J", lines })
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
