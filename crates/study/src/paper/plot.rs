//! A plot as an SVG, in the paper's axes.
//!
//! `plot => SVG`. The paper's data are drawn in one colour, hollow or dashed; measured data in others.

use std::fmt::Write as _;

use dbd_report::output::dark::adapted;
use dbd_report::output::markup::escape;
use dbd_report::output::svg::{joined, label};

use crate::paper::finding::{Curve, Map, Plot};
use crate::plot::frame::{begin, grid, sides};
use crate::plot::{INK, Scale};

/// \[pixels\] width and height, without the names of the curves.
const SIZE: [f64; 2] = [760.0, 430.0];
/// \[pixels\] left, top, right and bottom of the axes.
const AREA: [f64; 4] = [84.0, 36.0, 744.0, 374.0];
/// \[pixels\] from a line of text to the next.
const LINE: f64 = 18.0;

const PAPER: &str = "#c0392b";
const OURS: [&str; 12] = [
    "#0072b2", "#009e73", "#cc79a7", "#e69f00", "#56b4e9", "#8a7f00", "#d55e00", "#6b737e",
    "#00755a", "#a04478", "#946600", "#005e94",
];

/// The plot; with words only where there is nothing to draw.
#[must_use]
pub fn svg(plot: &Plot) -> String {
    let all = || plot.curves.iter().flat_map(|curve| &curve.points);
    let map = plot.map.as_ref();
    let height = SIZE[1] + LINE * plot.curves.len().div_ceil(2) as f64;
    let mut text = begin(SIZE[0], height);
    let title = escape(&plot.title);
    let _ = writeln!(
        text,
        "<title>{title}</title>\n\
         <text x=\"{}\" y=\"22\" font-size=\"15\" font-weight=\"600\">{title}</text>",
        AREA[0]
    );
    let x = all().map(|p| p[0]).chain(map.iter().flat_map(|map| map.x.iter().copied()));
    let y = all().map(|p| p[1]).chain(map.iter().flat_map(|map| map.y.iter().copied()));
    let [x_name, y_name] = plot.axes.clone();
    let x = Scale::of_numbers(x, plot.logarithmic[0], true, x_name);
    let y = Scale::of_numbers(y, plot.logarithmic[1], true, y_name);
    match (x, y) {
        (Some(x), Some(y)) => draw(&mut text, plot, &x, &y),
        _ => label(&mut text, (AREA[0], AREA[1] + LINE), "start", INK, "Nothing to draw."),
    }
    text.push_str("</svg>\n");
    adapted(&text)
}

/// The pixels of a point; `None` beyond the axes.
fn place([a, b]: [f64; 2], x: &Scale, y: &Scale) -> Option<(f64, f64)> {
    let [left, top, right, bottom] = AREA;
    Some((left + x.at(a)? * (right - left), bottom - y.at(b)? * (bottom - top)))
}

fn draw(text: &mut String, plot: &Plot, x: &Scale, y: &Scale) {
    if let Some(map) = &plot.map {
        shade(text, map, x, y);
    }
    grid(text, (x, y), [8, 6], AREA);
    sides(text, (x, y), AREA, SIZE[1] - 14.0);
    let mut ours = OURS.iter().cycle();
    for (row, curve) in plot.curves.iter().enumerate() {
        let colour = if curve.paper { PAPER } else { ours.next().map_or(INK, |colour| *colour) };
        trace(text, curve, colour, x, y);
        let place = (AREA[0] + 340.0 * (row % 2) as f64, SIZE[1] + LINE * (row / 2) as f64);
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
    let points = curve.points.iter().filter_map(|point| place(*point, x, y));
    let points: Vec<(f64, f64)> = points.collect();
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
    let edges = |values: &[f64], n: usize| {
        let step = match values.get(n + 1) {
            Some(next) => next - values[n],
            None => values[n] - values[n.saturating_sub(1)],
        };
        [values[n] - 0.5 * step, values[n] + 0.5 * step]
    };
    for (row, values) in map.values.iter().enumerate() {
        let [low, high] = edges(&map.y, row);
        for (column, value) in values.iter().enumerate().filter(|(_, value)| **value > 0.02) {
            let [left, right] = edges(&map.x, column);
            let [left, right] =
                [left, right].map(|at| AREA[0] + x.clamped(at) * (AREA[2] - AREA[0]));
            let [top, bottom] = [high, low].map(|at| AREA[3] - y.clamped(at) * (AREA[3] - AREA[1]));
            let _ = writeln!(
                text,
                "<rect x=\"{left:.1}\" y=\"{top:.1}\" width=\"{:.1}\" height=\"{:.1}\" fill=\"{}\" fill-opacity=\"{value:.2}\"/>",
                right - left,
                bottom - top,
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
                assert!(
                    (AREA[0]..=AREA[2]).contains(&x) && (AREA[1]..=AREA[3]).contains(&y),
                    "{x} {y}"
                );
            }
        }
        assert!(svg(&plot(Vec::new(), true)).contains("Nothing to draw."));
        assert!(svg(&plot(vec![[0.0, -1.0]], true)).contains("Nothing to draw."));
    }
}
