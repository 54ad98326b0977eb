//! Curves and points over a scale.
//!
//! `(scales, series) => SVG`. A curve connects the cases; a case that did not complete is a gap and a mark at the
//! bottom.

use std::fmt::Write as _;

use dbd_report::output::dark::adapted;
use dbd_report::output::markup::escape;
use dbd_report::output::svg::joined;

use crate::plot::frame::{begin, grid, sides};
use crate::plot::{COLOURS, FAILED, Scale};

/// One series: a value of another axis, or a figure.
#[derive(Clone, Debug, PartialEq)]
pub struct Series {
    /// Name.
    pub name: String,
    /// Abscissa and ordinate; the latter is `None` if the case did not complete.
    pub points: Vec<(f64, Option<f64>)>,
}

/// Data of the drawing.
pub struct Drawing<'d> {
    /// \[pixels\] width and height.
    pub size: (f64, f64),
    /// Along.
    pub x: &'d Scale,
    /// Up.
    pub y: &'d Scale,
    /// The series in the order of the colours.
    pub series: &'d [Series],
    /// Whether points are joined.
    pub joined: bool,
}

/// \[pixels\] left, top, right and bottom of the axes within a drawing.
const MARGINS: [f64; 4] = [74.0, 10.0, 18.0, 50.0];

/// Points up to which each of a curve is marked.
const MARKED: usize = 60;

/// Maximum number of points with a tooltip.
const SPEAKING: usize = 2_000;

/// The SVG.
#[must_use]
pub fn svg(drawing: &Drawing<'_>) -> String {
    let Drawing { size: (width, height), x, y, series, .. } = *drawing;
    let [left, top] = [MARGINS[0], MARGINS[1]];
    let [right, bottom] = [width - MARGINS[2], height - MARGINS[3]];
    let across = |share: f64| left + share * (right - left);
    let up = |share: f64| bottom - share * (bottom - top);
    let mut text = begin(width, height);
    grid(&mut text, (x, y), [5, 6], [left, top, right, bottom]);
    sides(&mut text, (x, y), [left, top, right, bottom], height);
    let speaking = series.iter().map(|one| one.points.len()).sum::<usize>() <= SPEAKING;
    for (row, one) in series.iter().enumerate() {
        let colour = COLOURS[row % COLOURS.len()];
        let placed = |(along, value): &(f64, Option<f64>)| {
            Some((across(x.at(*along)?), up(y.at((*value)?)?)))
        };
        let places: Vec<Option<(f64, f64)>> = one.points.iter().map(placed).collect();
        if drawing.joined {
            for run in places.split(Option::is_none).filter(|run| run.len() > 1) {
                let corners: Vec<(f64, f64)> = run.iter().flatten().copied().collect();
                let _ = writeln!(
                    text,
                    "<polyline points=\"{}\" fill=\"none\" stroke=\"{colour}\" stroke-width=\"2\" \
                     stroke-linejoin=\"round\"/>",
                    joined(&corners)
                );
            }
        }
        let alone = |at: usize| {
            let there = |at: Option<usize>| at.and_then(|at| places.get(at)?.as_ref()).is_some();
            !there(at.checked_sub(1)) && !there(at.checked_add(1))
        };
        for (at, (place, (along, value))) in places.iter().zip(&one.points).enumerate() {
            let (Some((px, py)), Some(value)) = (place, value) else { continue };
            let marked = !drawing.joined || places.len() <= MARKED || alone(at);
            if !marked && !speaking {
                continue;
            }
            let said =
                if speaking { said(x, *along, &one.name, &y.said(*value)) } else { String::new() };
            let unseen = if marked { "" } else { " fill-opacity=\"0\"" };
            let _ = writeln!(
                text,
                "<circle cx=\"{px:.1}\" cy=\"{py:.1}\" r=\"2.6\" fill=\"{colour}\"{unseen}>{said}</circle>"
            );
        }
        for (along, _) in one.points.iter().filter(|(_, value)| value.is_none()) {
            let Some(share) = x.at(*along) else { continue };
            let at = across(share);
            let said = if speaking { said(x, *along, &one.name, "not ok") } else { String::new() };
            let _ = writeln!(
                text,
                "<path d=\"M{:.1} {:.1}l7 -7m0 7l-7 -7\" stroke=\"{FAILED}\" stroke-width=\"1.6\">{said}</path>",
                at - 3.5,
                bottom - 4.0
            );
        }
    }
    text.push_str("</svg>\n");
    adapted(&text)
}

/// Tooltip of a case.
fn said(x: &Scale, along: f64, series: &str, words: &str) -> String {
    let series = if series.is_empty() { String::new() } else { format!("{series}\n") };
    format!("<title>{}</title>", escape(&format!("{series}{}\n{words}", x.said(along))))
}

#[cfg(test)]
mod tests {
    use dbd_report::output::dark::unpaired;

    use super::*;

    #[test]
    fn every_case_says_its_values_and_no_colour_stays_light_in_the_dark() {
        let scale = |values: [f64; 2], label: &str| {
            Scale::of_numbers(values.into_iter(), false, true, label.into()).unwrap()
        };
        let (x, y) = (scale([0.0, 2.0], "body.cart.mass [kg]"), scale([-1.0, 1.0], "tip.max [m]"));
        let points = |count: u32| -> Vec<(f64, Option<f64>)> {
            (0..count).map(|i| (2.0 * f64::from(i) / f64::from(count), Some(0.25))).collect()
        };
        let drawn = |points: Vec<(f64, Option<f64>)>| {
            let series = [Series { name: "a < b".into(), points }];
            svg(&Drawing { size: (490.0, 300.0), x: &x, y: &y, series: &series, joined: true })
        };
        let few = drawn(vec![(0.0, Some(-0.5)), (1.0, None), (2.0, Some(1.0))]);
        assert!(few.contains("<title>a &lt; b\nbody.cart.mass = 1 kg\nnot ok</title>"), "{few}");
        assert!(few.contains("<title>a &lt; b\nbody.cart.mass = 0 kg\ntip.max = −0.5 m</title>"));
        assert_eq!(unpaired(&few), [""; 0]);
        // Of many, those between are not seen but speak; of very many none does.
        let many = drawn(points(200));
        assert_eq!(
            (many.matches("<title>").count(), many.matches("opacity=\"0\"").count()),
            (200, 200)
        );
        assert_eq!(drawn(points(3_000)).matches("<title>").count(), 0);
    }
}
