//! Names in a view: bodies first, then driven parts, joints and springs, within the available space.
//!
//! `(anchors, drawn parts) => labels without overlap, number of omitted ones`.

use crate::output::label_positions::{LabelPositions, Rectangle};

use crate::picture::ink::{Point, line, width, words};
use crate::picture::style::LETTERS;

/// Letters of a label; the rest of a name is left out.
const LONGEST: usize = 22;
/// Labels that a view has at most.
const MAX: usize = 48;

/// A name that is to be written.
pub(crate) struct Label {
    /// The whole name.
    pub(crate) name: String,
    /// Its part.
    pub(crate) anchor: Point,
    /// Its class in the style sheet.
    pub(crate) class: String,
    /// \[pixels\] how much it may hide before it is left out.
    pub(crate) worst: f64,
}

/// A name as labels have it.
pub(crate) fn short(name: &str) -> String {
    let letters: Vec<char> = name.chars().map(|c| if c.is_control() { ' ' } else { c }).collect();
    if letters.len() <= LONGEST {
        return letters.into_iter().collect();
    }
    // The end tells names apart that begin alike.
    let (begin, end) = (LONGEST - 8, 7);
    let head: String = letters[..begin].iter().collect();
    let tail: String = letters[letters.len() - end..].iter().collect();
    format!("{}…{}", head.trim_end(), tail.trim_start())
}

/// Writes labels, those that come first before the others, away from `middle`; returns how many
/// found no room.
pub(crate) fn write(
    text: &mut String,
    positions: &mut LabelPositions,
    labels: &[Label],
    middle: Point,
) -> usize {
    let mut left_out = labels.len().saturating_sub(MAX);
    for label in labels.iter().take(MAX) {
        let name = short(&label.name);
        let size = (width(&name, LETTERS) + 2.0, LETTERS + 3.0);
        let (x, y) = (label.anchor.0 - middle.0, label.anchor.1 - middle.1);
        let away = libm::hypot(x, y);
        let wish = if away > 1.0 { (x / away, y / away) } else { (0.0, -1.0) };
        let Some(found) = positions.find(label.anchor, size, wish, label.worst) else {
            left_out += 1;
            continue;
        };
        let end = found.nearest(label.anchor);
        if libm::hypot(end.0 - label.anchor.0, end.1 - label.anchor.1) > 15.0 {
            line(text, "thin", &[label.anchor, end]);
        }
        write_at(text, &label.class, &found, &name);
    }
    left_out
}

fn write_at(text: &mut String, class: &str, found: &Rectangle, name: &str) {
    let at = (found.x + 0.5 * found.width, found.y + LETTERS - 1.0);
    words(text, &format!("{class} halo"), at, "middle", name);
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn long_names_keep_both_ends() {
        assert_eq!(short("crank"), "crank");
        let name = short("the left front wheel's upper wishbone 12");
        assert_eq!(name, "the left front…bone 12");
        assert!(name.chars().count() <= LONGEST);
        assert_eq!(short("a\nb"), "a b");
    }
}
