//! One coloured cell per pair of values.
//!
//! `(names along, names up, values) => SVG`. Cells are evenly spaced; a cell without a value, of a case that did not
//! complete, is hatched.

use std::fmt::Write as _;

use dbd_plant::digits::significant;
use dbd_report::output::dark::adapted;
use dbd_report::output::markup::escape;
use dbd_report::output::svg::label;

use crate::plot::frame::{begin, sides};
use crate::plot::{FAILED, FRAME, INK, Scale};

/// Data of the drawing.
pub struct Heat<'h> {
    /// Quantity and unit.
    pub title: &'h str,
    /// \[pixels\] width and height.
    pub size: (f64, f64),
    /// Along, by names.
    pub x: &'h Scale,
    /// Up, by names.
    pub y: &'h Scale,
    /// How many cells lie along and up.
    pub cells: [usize; 2],
    /// Values of the cells, row by row from the bottom; `None` if missing.
    pub values: &'h [Option<f64>],
}

/// Viridis (van der Walt & Smith 2015) at even positions: perceptually uniform, also in grey.
const COLOURS: [[f64; 3]; 9] = [
    [68.0, 1.0, 84.0],
    [71.0, 44.0, 122.0],
    [59.0, 81.0, 139.0],
    [44.0, 113.0, 142.0],
    [33.0, 144.0, 141.0],
    [39.0, 173.0, 129.0],
    [92.0, 200.0, 99.0],
    [170.0, 220.0, 50.0],
    [253.0, 231.0, 37.0],
];

/// \[pixels\] left, top, right and bottom of the cells within a drawing.
const MARGINS: [f64; 4] = [92.0, 10.0, 86.0, 50.0];

/// Maximum number of cells with a tooltip.
const SPEAKING: usize = 4_000;

/// The SVG.
#[must_use]
pub fn svg(heat: &Heat<'_>) -> String {
    let Heat { title, size: (width, height), x, y, cells: [along, above], values } = *heat;
    let (quantity, unit) = title.split_once(" [").unwrap_or((title, ""));
    let unit = unit.trim_end_matches(']');
    let [left, top] = [MARGINS[0], MARGINS[1]];
    let [right, bottom] = [width - MARGINS[2], height - MARGINS[3]];
    let finite = || values.iter().flatten().copied().filter(|value| value.is_finite());
    let low = finite().reduce(f64::min).unwrap_or(0.0);
    let high = finite().reduce(f64::max).unwrap_or(0.0);
    let share = |value: f64| if high > low { (value - low) / (high - low) } else { 0.5 };
    let mut text = begin(width, height);
    text.push_str(
        "<defs><pattern id=\"gap\" width=\"6\" height=\"6\" patternUnits=\"userSpaceOnUse\">\
         <rect width=\"6\" height=\"6\" fill=\"#f4f6f8\"/>",
    );
    let _ = writeln!(
        text,
        "<path d=\"M0 6L6 0\" stroke=\"{FAILED}\" stroke-width=\"0.8\"/></pattern></defs>"
    );
    let along_x: Vec<String> = (0..along).map(|column| x.said(column as f64)).collect();
    let along_y: Vec<String> = (0..above).map(|row| y.said(row as f64)).collect();
    let (wide, tall) = ((right - left) / along.max(1) as f64, (bottom - top) / above.max(1) as f64);
    for (at, value) in values.iter().enumerate().take(along * above) {
        let (column, row) = (at % along, at / along);
        let fill = match value.filter(|value| value.is_finite()) {
            Some(value) => colour(share(value)),
            None => "url(#gap)".to_owned(),
        };
        let _ = write!(
            text,
            "<rect x=\"{:.2}\" y=\"{:.2}\" width=\"{:.2}\" height=\"{:.2}\" fill=\"{fill}\"",
            left + column as f64 * wide,
            bottom - (row + 1) as f64 * tall,
            wide + 0.3,
            tall + 0.3,
        );
        match values.len() <= SPEAKING {
            true => {
                let value = value.map_or("not ok".into(), |value| {
                    let figure = significant(value, 5).replace('-', "−");
                    format!("{quantity} = {figure} {unit}")
                });
                let said = format!("{}\n{}\n{}", along_x[column], along_y[row], value.trim_end());
                let _ = writeln!(text, "><title>{}</title></rect>", escape(&said));
            }
            false => text.push_str("/>\n"),
        }
    }
    let _ = writeln!(
        text,
        "<rect x=\"{left}\" y=\"{top}\" width=\"{:.1}\" height=\"{:.1}\" fill=\"none\" stroke=\"{FRAME}\"/>",
        right - left,
        bottom - top
    );
    for (at, words) in x.ticks(5) {
        label(&mut text, (left + at * (right - left), bottom + 18.0), "middle", INK, &words);
    }
    for (at, words) in y.ticks(8) {
        label(&mut text, (left - 7.0, bottom - at * (bottom - top) + 4.5), "end", INK, &words);
    }
    sides(&mut text, (x, y), [left, top, right, bottom], height);
    legend(&mut text, [right + 14.0, top, bottom], [low, high]);
    text.push_str("</svg>\n");
    adapted(&text)
}

/// Colour scale.
fn legend(text: &mut String, [left, top, bottom]: [f64; 3], [low, high]: [f64; 2]) {
    const STRIPES: usize = 40;
    let tall = (bottom - top) / STRIPES as f64;
    for stripe in 0..STRIPES {
        let _ = writeln!(
            text,
            "<rect x=\"{left}\" y=\"{:.2}\" width=\"12\" height=\"{:.2}\" fill=\"{}\"/>",
            bottom - (stripe + 1) as f64 * tall,
            tall + 0.3,
            colour((stripe as f64 + 0.5) / STRIPES as f64),
        );
    }
    for (at, value) in
        [(bottom, low), (0.5 * (top + bottom), 0.5 * low + 0.5 * high), (top + 9.0, high)]
    {
        let words = significant(value, 3).replace('-', "−");
        label(text, (left + 16.0, at), "start", INK, &words);
    }
}

/// The colour at a fraction of the scale.
fn colour(share: f64) -> String {
    let at = share.clamp(0.0, 1.0) * (COLOURS.len() - 1) as f64;
    let below = (at.floor() as usize).min(COLOURS.len() - 2);
    let mixed: [f64; 3] = std::array::from_fn(|i| {
        let part = at - below as f64;
        COLOURS[below][i] * (1.0 - part) + COLOURS[below + 1][i] * part
    });
    let [r, g, b] = mixed.map(|part| part.round() as u8);
    format!("#{r:02x}{g:02x}{b:02x}")
}
