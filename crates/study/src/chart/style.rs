//! Appearance of a stepper: colour and mark by scheme, dashes by precision and orientation.
//!
//! Colours of Okabe & Ito (2008), distinct for colour-blind readers; marks and dashes repeat the information.
//! References are grey.

use std::fmt::Write as _;

use crate::point::Stepper;

/// Text and axes.
pub const INK: &str = "#333a45";
/// Secondary text.
pub const FAINT: &str = "#69727f";
/// Grid lines.
pub const GRID: &str = "#d9dee4";
/// The front's band: the palette's yellow, which no line has.
pub const FRONT: &str = "#f0e442";

/// How a stepper is drawn.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Style {
    /// Of line and marks.
    pub colour: &'static str,
    /// Of text: dark enough on white.
    pub text: &'static str,
    /// Of the marks.
    pub shape: Shape,
    /// The line's dashes as SVG has them; empty for a solid line.
    pub dashes: &'static str,
    /// [pixels] the line's width.
    pub width: f64,
}

/// Marks.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Shape {
    /// A circle.
    Circle,
    /// Corners on a circle, the first at an angle [deg] clockwise from the top.
    Polygon(u8, u8),
    /// A star with the given number of points.
    Triple(u8),
}

const SHAPES: [Shape; 9] = [
    Shape::Circle,
    Shape::Polygon(4, 45),
    Shape::Polygon(3, 0),
    Shape::Polygon(4, 0),
    Shape::Polygon(3, 60),
    Shape::Triple(5),
    Shape::Polygon(5, 0),
    Shape::Triple(4),
    Shape::Triple(6),
];

/// Line and text.
const COLOURS: [(&str, &str); 6] = [
    ("#0072b2", "#0072b2"),
    ("#d55e00", "#b04d00"),
    ("#009e73", "#00755a"),
    ("#cc79a7", "#a04478"),
    ("#e69f00", "#946600"),
    ("#56b4e9", "#2477a6"),
];
const BLACK: (&str, &str) = ("#000000", "#000000");
const GREY: (&str, &str) = ("#9aa1ab", "#6b737e");

/// Colour and mark of the schemes known, so that charts of several scenes agree: rows of `COLOURS`
/// (none: black) and of `SHAPES`.
const KNOWN: [(&str, Option<usize>, usize); 10] = [
    ("dbd", None, 0),
    ("leapfrog", Some(0), 1),
    ("pefrl", Some(1), 2),
    ("blanes-moan-s6", Some(2), 3),
    ("rk4", Some(3), 4),
    ("semi-implicit-euler", Some(5), 6),
    ("dbd-p1", Some(4), 5),
    ("dbd-p2", Some(4), 7),
    ("generalized-alpha", Some(3), 8),
    ("generalized-alpha-3", Some(3), 9),
];

impl Style {
    /// The style of a stepper, the `row`-th of those drawn; that decides for schemes not known. The
    /// paper's scheme is thick.
    pub fn of(stepper: &Stepper, row: usize, paper: bool) -> Self {
        let known = KNOWN.iter().find(|(name, ..)| *name == stepper.scheme);
        let (colour, shape) = match known {
            _ if !stepper.kernel => (GREY, row),
            Some((_, colour, shape)) => (colour.map_or(BLACK, |row| COLOURS[row]), *shape),
            None => (COLOURS[row % COLOURS.len()], row),
        };
        // A variant of a scheme has its colour and another mark.
        let newton = stepper.newton.unwrap_or(0) as usize;
        let damping = match stepper.damping.as_deref() {
            None => 0,
            Some("explicit") => 3,
            Some(_) => 5,
        };
        let variant = newton + damping;
        let dashes = match (stepper.precision.as_str(), stepper.orientation.as_str()) {
            ("f64", "quaternion") => "",
            ("f32", "quaternion") => "7 4",
            ("fixed", _) => "14 3",
            ("f64", _) => "11 3 2 3",
            ("f32", _) => "2 3",
            _ => "4 2 1 2",
        };
        Self {
            colour: colour.0,
            text: colour.1,
            shape: SHAPES[(shape + variant) % SHAPES.len()],
            dashes,
            width: if paper { 5.0 } else { 1.8 },
        }
    }

    /// A mark, filled or hollow, with the title that hovering shows (escaped already).
    pub fn mark(&self, (x, y): (f64, f64), radius: f64, hollow: bool, title: &str) -> String {
        let paint = if hollow {
            format!("fill=\"#fff\" stroke=\"{}\" stroke-width=\"1.5\"", self.colour)
        } else {
            format!("fill=\"{}\" stroke=\"#fff\" stroke-width=\".8\"", self.colour)
        };
        let title =
            if title.is_empty() { String::new() } else { format!("<title>{title}</title>") };
        let (corners, first, inner) = match self.shape {
            Shape::Circle => {
                return format!(
                    "<circle cx=\"{x:.1}\" cy=\"{y:.1}\" r=\"{radius:.1}\" {paint}>{title}</circle>\n"
                );
            }
            Shape::Polygon(corners, first) => (corners, f64::from(first), 1.0),
            Shape::Triple(points) => (2 * points, 0.0, 0.45),
        };
        let mut around = String::new();
        for corner in 0..corners {
            let angle = (first + 360.0 * f64::from(corner) / f64::from(corners)).to_radians();
            let reach = 1.25 * radius * if corner % 2 == 1 { inner } else { 1.0 };
            let (sine, cosine) = angle.sin_cos();
            let gap = if corner == 0 { "" } else { " " };
            let _ = write!(around, "{gap}{:.1},{:.1}", x + reach * sine, y - reach * cosine);
        }
        format!("<polygon points=\"{around}\" {paint}>{title}</polygon>\n")
    }

    /// The attributes of its line.
    pub fn line(&self) -> String {
        let dashes = match self.dashes {
            "" => String::new(),
            dashes => format!(" stroke-dasharray=\"{dashes}\""),
        };
        format!(
            "fill=\"none\" stroke=\"{}\" stroke-width=\"{}\"{dashes} stroke-linejoin=\"round\"",
            self.colour, self.width
        )
    }
}

#[cfg(test)]
mod tests {
    use dbd_plant::{DampingName, Method, Named as _, PrecisionName, SchemeName};

    use super::*;
    use crate::ways::Way;

    #[test]
    fn schemes_and_ways_of_damping_differ_in_colour_or_mark() {
        let mut styles = Vec::new();
        for scheme in SchemeName::ALL {
            let name = scheme.name();
            assert!(KNOWN.iter().any(|(known, ..)| *known == name), "{name} has no colour");
            let own = Method::new(*scheme, None, PrecisionName::F64).unwrap();
            let dampings = DampingName::ALL.iter().map(|damping| own.with_damping(*damping));
            for method in dampings.flatten() {
                let mut stepper = Way::Kernel(method).stepper();
                for precision in ["f64", "f32"] {
                    stepper.precision = precision.into();
                    let style = Style::of(&stepper, 0, false);
                    assert!(!styles.contains(&style), "{}", stepper.label());
                    styles.push(style);
                }
            }
        }
    }
}
