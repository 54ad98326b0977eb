//! Charts of the pages as SVG.
//!
//! `(axes, curves) => SVG`, drawn by plotters. Axes are linear or logarithmic; names stand beside
//! the curves in a legend.

use std::ops::Range;

use plotters::coord::Shift;
use plotters::coord::ranged1d::{DefaultFormatting, KeyPointHint};
use plotters::prelude::*;

/// One curve.
pub struct Curve {
    /// What the legend calls it.
    pub name: &'static str,
    /// Its points.
    pub points: Vec<(f64, f64)>,
    /// Its colour.
    pub colour: RGBColor,
    /// Whether it is dashed.
    pub dashed: bool,
}

/// What an axis says and how far it goes.
pub struct Axis {
    /// Quantity and unit.
    pub label: &'static str,
    /// From the least to the largest value.
    pub range: Range<f64>,
    /// Whether a decade is as long as the next.
    pub logarithmic: bool,
}

/// Colours that are told apart by most eyes (Okabe & Ito 2008).
pub const COLOURS: [RGBColor; 5] = [
    RGBColor(0xd5, 0x5e, 0x00),
    RGBColor(0x00, 0x72, 0xb2),
    RGBColor(0x00, 0x9e, 0x73),
    RGBColor(0xcc, 0x79, 0xa7),
    RGBColor(0x56, 0x56, 0x56),
];

/// \[pixels\] width and height.
const SIZE: (u32, u32) = (760, 400);

/// An axis whose values are placed by themselves or by their logarithms.
struct Scale {
    range: Range<f64>,
    logarithmic: bool,
}

impl Scale {
    fn of(&self, value: f64) -> f64 {
        if self.logarithmic { value.log10() } else { value }
    }
}

impl Ranged for Scale {
    type FormatOption = DefaultFormatting;
    type ValueType = f64;

    fn map(&self, value: &f64, (from, to): (i32, i32)) -> i32 {
        let [value, low, high] = [*value, self.range.start, self.range.end].map(|v| self.of(v));
        from + (f64::from(to - from) * (value - low) / (high - low)).round() as i32
    }

    fn key_points<Hint: KeyPointHint>(&self, hint: Hint) -> Vec<f64> {
        let (low, high) = (self.of(self.range.start), self.of(self.range.end));
        if self.logarithmic {
            let decades = low.ceil() as i32..=high.floor() as i32;
            return decades.map(|decade| format!("1e{decade}").parse().unwrap_or(1.0)).collect();
        }
        let coarse = (high - low) / hint.max_num_points().clamp(2, 10) as f64;
        let decade = 10_f64.powf(coarse.log10().floor());
        let step = [1.0, 2.0, 5.0, 10.0].map(|s| s * decade).into_iter().find(|s| *s >= coarse);
        let step = step.unwrap_or(coarse);
        let ticks = (low / step).ceil() as i32..=(high / step + 1e-9).floor() as i32;
        ticks.map(|tick| f64::from(tick) * step).collect()
    }

    fn range(&self) -> Range<f64> {
        self.range.clone()
    }
}

/// A tick's number: short, as the tables have it.
fn tick(value: f64, logarithmic: bool) -> String {
    if logarithmic && !(0.01..=1000.0).contains(&value) {
        format!("{value:e}")
    } else {
        let text = format!("{value:.3}");
        text.trim_end_matches('0').trim_end_matches('.').to_owned()
    }
}

/// Draws curves; `where_to` is the corner in which the legend stands.
pub fn svg(x: &Axis, y: &Axis, curves: &[Curve], legend: SeriesLabelPosition) -> String {
    let mut text = String::new();
    {
        let area = SVGBackend::with_string(&mut text, SIZE).into_drawing_area();
        drawn(&area, x, y, curves, legend);
        area.present().unwrap();
    }
    text
}

fn drawn(
    area: &DrawingArea<SVGBackend<'_>, Shift>,
    x: &Axis,
    y: &Axis,
    curves: &[Curve],
    legend: SeriesLabelPosition,
) {
    area.fill(&WHITE).unwrap();
    let scale = |axis: &Axis| Scale { range: axis.range.clone(), logarithmic: axis.logarithmic };
    let mut chart = ChartBuilder::on(area)
        .margin(12)
        .x_label_area_size(44)
        .y_label_area_size(64)
        .build_cartesian_2d(scale(x), scale(y))
        .unwrap();
    chart
        .configure_mesh()
        .light_line_style(TRANSPARENT)
        .bold_line_style(RGBColor(0xe3, 0xe7, 0xec))
        .axis_style(RGBColor(0x8f, 0x94, 0x9b))
        .label_style(("sans-serif", 15))
        .axis_desc_style(("sans-serif", 16))
        .x_desc(x.label)
        .y_desc(y.label)
        .x_label_formatter(&|value| tick(*value, x.logarithmic))
        .y_label_formatter(&|value| tick(*value, y.logarithmic))
        .draw()
        .unwrap();
    for curve in curves {
        let style = curve.colour.stroke_width(2);
        // What leaves the chart ends there.
        let inside = |&(a, b): &(f64, f64)| x.range.contains(&a) && y.range.contains(&b);
        let points: Vec<_> = curve.points.iter().copied().filter(inside).collect();
        let colour = curve.colour;
        let series = if curve.dashed {
            chart.draw_series(DashedLineSeries::new(points, 6, 4, style))
        } else {
            chart.draw_series(LineSeries::new(points, style))
        };
        let dashed = curve.dashed;
        series.unwrap().label(curve.name).legend(move |(x, y)| {
            let end = if dashed { x + 12 } else { x + 22 };
            PathElement::new(vec![(x, y), (end, y)], colour.stroke_width(3))
        });
    }
    chart
        .configure_series_labels()
        .position(legend)
        .background_style(WHITE.mix(0.85))
        .border_style(RGBColor(0xc8, 0xcc, 0xd2))
        .label_font(("sans-serif", 15))
        .draw()
        .unwrap();
}
