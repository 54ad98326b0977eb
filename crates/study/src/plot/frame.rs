//! Frame of curves: grid, numbers, axis titles.
//!
//! `(scales, pixels) => SVG`.

use std::fmt::Write as _;

use dbd_report::output::markup::escape;
use dbd_report::output::svg::label;

use crate::plot::{FRAME, GRID, INK, Scale};

/// The beginning of a drawing.
#[must_use]
pub fn begin(width: f64, height: f64) -> String {
    format!(
        "<svg xmlns=\"http://www.w3.org/2000/svg\" width=\"{width}\" height=\"{height}\" \
         viewBox=\"0 0 {width} {height}\" font-family=\"sans-serif\" font-size=\"13\" \
         fill=\"{INK}\">\n"
    )
}

/// Lines at about `ticks` round numbers along and up, the numbers, and the axes, between the pixels left, top, right,
/// bottom.
pub fn grid(
    text: &mut String,
    (x, y): (&Scale, &Scale),
    ticks: [usize; 2],
    [left, top, right, bottom]: [f64; 4],
) {
    for (share, words) in x.ticks(ticks[0]) {
        let at = left + share * (right - left);
        let _ = writeln!(text, "<path d=\"M{at:.1} {top}V{bottom}\" stroke=\"{GRID}\"/>");
        label(text, (at, bottom + 18.0), "middle", INK, &words);
    }
    for (share, words) in y.ticks(ticks[1]) {
        let at = bottom - share * (bottom - top);
        let _ = writeln!(text, "<path d=\"M{left} {at:.1}H{right}\" stroke=\"{GRID}\"/>");
        label(text, (left - 7.0, at + 4.5), "end", INK, &words);
    }
    let _ = writeln!(
        text,
        "<path d=\"M{left} {top}V{bottom}H{right}\" fill=\"none\" stroke=\"{FRAME}\"/>"
    );
}

/// Axis titles.
pub fn sides(
    text: &mut String,
    (x, y): (&Scale, &Scale),
    [left, top, right, bottom]: [f64; 4],
    height: f64,
) {
    label(text, (0.5 * (left + right), height - 10.0), "middle", INK, &x.label);
    let _ = writeln!(
        text,
        "<text transform=\"translate(14 {:.1}) rotate(-90)\" text-anchor=\"middle\">{}</text>",
        0.5 * (top + bottom),
        escape(&y.label)
    );
}
