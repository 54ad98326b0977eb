//! Elements of drawings as SVG.
//!
//! `(text so far, element) => text`. Coordinates are pixels, y down, written to a tenth.

use std::fmt::Write as _;

use crate::output::markup::escape;

/// Points in the form of a polyline.
#[must_use]
pub fn joined(points: &[(f64, f64)]) -> String {
    points.iter().map(|(x, y)| format!("{x:.1},{y:.1}")).collect::<Vec<_>>().join(" ")
}

/// Writes words at a point; `anchor` is `start`, `middle` or `end`.
pub fn label(text: &mut String, (x, y): (f64, f64), anchor: &str, colour: &str, words: &str) {
    let words = escape(words);
    let _ = writeln!(
        text,
        "<text x=\"{x:.1}\" y=\"{y:.1}\" text-anchor=\"{anchor}\" fill=\"{colour}\">{words}</text>"
    );
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn words_cannot_become_markup() {
        let mut text = String::new();
        label(&mut text, (1.0, 2.25), "end", "#000", "a < b");
        assert!(text.contains("x=\"1.0\" y=\"2.2\"") && text.contains("a &lt; b"), "{text}");
        assert_eq!(joined(&[(0.0, 1.0), (2.04, -3.0)]), "0.0,1.0 2.0,-3.0");
    }
}
