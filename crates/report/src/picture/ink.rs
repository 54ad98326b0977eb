//! SVG elements as text.
//!
//! `(class, points) => element`. Coordinates are pixels, y down, to a tenth, as short as they go.

use std::fmt::Write as _;

use crate::output::markup::escape;

/// A point on paper \[pixels, y down\].
pub(crate) type Point = (f64, f64);

/// A number in the form of a path.
pub(crate) fn number(value: f64) -> String {
    // Beyond any paper; neither infinite nor long.
    let value = if value.is_finite() { value.clamp(-1e5, 1e5) } else { 0.0 };
    let text = format!("{value:.1}");
    let short = text.strip_suffix(".0").unwrap_or(&text);
    if short == "-0" { "0".into() } else { short.into() }
}

/// A point in the form of a path.
pub(crate) fn xy((x, y): Point) -> String {
    format!("{} {}", number(x), number(y))
}

/// Straight lines through points as the data of a path.
pub(crate) fn through(points: &[Point], closed: bool) -> String {
    let mut data = String::new();
    for (i, point) in points.iter().enumerate() {
        let _ = write!(data, "{}{}", if i == 0 { "M" } else { "L" }, xy(*point));
    }
    if points.len() == 1 {
        // A dot with a round cap.
        data.push_str("h0");
    }
    if closed {
        data.push('Z');
    }
    data
}

/// A path.
pub(crate) fn path(text: &mut String, class: &str, data: &str) {
    let _ = writeln!(text, "<path class=\"{class}\" d=\"{data}\"/>");
}

/// A path with a separate style.
pub(crate) fn path_in(text: &mut String, class: &str, style: &str, data: &str) {
    let _ = writeln!(text, "<path class=\"{class}\" style=\"{style}\" d=\"{data}\"/>");
}

/// Straight lines through points.
pub(crate) fn line(text: &mut String, class: &str, points: &[Point]) {
    path(text, class, &through(points, false));
}

/// A circle.
pub(crate) fn circle(text: &mut String, class: &str, (x, y): Point, radius: f64) {
    let (x, y, radius) = (number(x), number(y), number(radius));
    let _ = writeln!(text, "<circle class=\"{class}\" cx=\"{x}\" cy=\"{y}\" r=\"{radius}\"/>");
}

/// Words; `anchor` is `start`, `middle` or `end`.
pub(crate) fn words(text: &mut String, class: &str, (x, y): Point, anchor: &str, words: &str) {
    let class = if class.is_empty() { String::new() } else { format!(" class=\"{class}\"") };
    let anchor = match anchor {
        "start" => String::new(),
        anchor => format!(" text-anchor=\"{anchor}\""),
    };
    let (x, y) = (number(x), number(y));
    let _ = writeln!(text, "<text{class} x=\"{x}\" y=\"{y}\"{anchor}>{}</text>", escape(words));
}

/// Begins a tooltip for the next elements, until [`end`].
pub(crate) fn begin(text: &mut String, title: &str) {
    let _ = writeln!(text, "<g><title>{}</title>", escape(title));
}

/// Ends a group of [`begin`].
pub(crate) fn end(text: &mut String) {
    text.push_str("</g>\n");
}

/// \[pixels\] width of words, rather too much than too little.
pub(crate) fn width(words: &str, letters: f64) -> f64 {
    // Letters of East Asia are as wide as they are high.
    words.chars().map(|c| if c >= '\u{1100}' { 1.05 } else { 0.58 }).sum::<f64>() * letters
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn numbers_are_short_and_finite() {
        let texts = [0.04, -0.04, 12.0, -3.25, 1e300, f64::NAN].map(number);
        assert_eq!(texts, ["0", "0", "12", "-3.2", "100000", "0"]);
        assert_eq!(through(&[(1.0, 2.5)], false), "M1 2.5h0");
        assert_eq!(through(&[(1.0, 2.0), (3.0, 4.0)], true), "M1 2L3 4Z");
    }

    #[test]
    fn words_cannot_become_markup() {
        let mut text = String::new();
        words(&mut text, "n1", (1.0, 2.0), "middle", "<a & \"b\">");
        begin(&mut text, "</g>");
        assert!(text.contains("&lt;a &amp; &quot;b&quot;&gt;") && text.contains("&lt;/g&gt;"));
    }
}
