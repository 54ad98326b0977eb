//! The sheet: a large view with names, small ones from the other sides, a legend.
//!
//! `mechanism => SVG`. Every number is rounded to a tenth of a pixel and every order is the
//! scene's, so the same scene gives the same text.

use crate::output::label_positions::Rectangle;
use crate::output::markup::escape;
use dbd_kernel::Vec3;

use crate::picture::bodies::colours;
use crate::picture::drawing::{Drawing, LINES, crowded};
use crate::picture::ink::{Point, line, width, words};
use crate::picture::legend;
use crate::picture::mechanism::Mechanism;
use crate::picture::style::{LETTERS, ROOT, sheet};
use crate::picture::symbols::Symbols;
use crate::picture::view::{Frame, View, Views, extent, reach};

/// Background of a picture.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Paper {
    /// A separate file: with the scene's name, dark on a dark screen.
    File,
    /// A page that has a heading and a background, dark where the reader's screen is.
    Page,
}

/// \[pixels\] width of the sheet: narrow, so that letters can be read where it is scaled down.
pub(crate) const WIDTH: f64 = 640.0;
pub(crate) const MARGIN: f64 = 12.0;
/// \[pixels\] margin around the drawing to scale, for symbols and names.
const ROUND_MAIN: (f64, f64) = (70.0, 52.0);
pub(crate) const ROUND_SMALL: (f64, f64) = (30.0, 30.0);
/// \[pixels\] least and greatest height of the drawn part of a view.
const HEIGHT_MAIN: (f64, f64) = (90.0, 400.0);
const HEIGHT_SMALL: (f64, f64) = (20.0, 190.0);
/// \[pixels\] of the strip below a view: axes, gravity, scale.
const STRIP: f64 = 76.0;
/// \[pixels\] of letters in lines of many: their widths average out.
const PROSE: f64 = 0.92 * LETTERS;
/// \[pixels\] of a line of text.
const LINE: f64 = 26.0;

/// The picture of a mechanism.
#[must_use]
pub fn svg(mechanism: &Mechanism, paper: Paper) -> String {
    let mut sheet = Sheet {
        mechanism,
        colours: colours(mechanism),
        reach: reach(mechanism),
        crowded: crowded(mechanism),
        text: String::new(),
        y: MARGIN,
    };
    if paper == Paper::File {
        let name = crate::picture::names::short(&mechanism.name);
        sheet.write("title", &name);
    }
    let views = Views::of(mechanism);
    let left_out = sheet.main(&views);
    sheet.small(&views.small);
    sheet.foot(&views, left_out);
    sheet.finish(paper)
}

struct Sheet<'s> {
    mechanism: &'s Mechanism,
    colours: Vec<usize>,
    /// All that is drawn to scale.
    reach: Vec<Vec3<f64>>,
    crowded: bool,
    text: String,
    /// \[pixels\] where the next thing begins.
    y: f64,
}

impl Sheet<'_> {
    /// A line of text, wrapped if too long.
    fn write(&mut self, class: &str, line: &str) {
        let mut rest = String::new();
        for word in line.split(' ') {
            let longer = if rest.is_empty() { word.into() } else { format!("{rest} {word}") };
            if !rest.is_empty() && width(&longer, PROSE) > WIDTH - 2.0 * MARGIN {
                self.put(class, &rest);
                rest = word.into();
            } else {
                rest = longer;
            }
        }
        self.put(class, &rest);
    }

    fn put(&mut self, class: &str, line: &str) {
        words(&mut self.text, class, (MARGIN, self.y + 16.0), "start", line);
        self.y += LINE - 3.0;
    }

    /// The large view; returns how many names were left out.
    fn main(&mut self, views: &Views) -> usize {
        let title = match views.main.seen_along() {
            Some(axis) => format!("{} view, seen along {axis}", views.main.name),
            None if views.planar => "in the plane, seen along the hinge axes".into(),
            None => format!("oblique view {}", views.main.name),
        };
        self.write("", &title);
        let ((across, up), middle) = extent(&views.main, &self.reach);
        let room = (WIDTH - 2.0 * (MARGIN + ROUND_MAIN.0), HEIGHT_MAIN.1);
        let scale = scale(fitting(across, up, room));
        let height = (up * scale).clamp(HEIGHT_MAIN.0, HEIGHT_MAIN.1) + 2.0 * ROUND_MAIN.1;
        let centre = (0.5 * WIDTH, self.y + 0.5 * height);
        let mut frame = Frame { view: views.main.clone(), middle, centre, scale, symbols: 1.0 };
        frame.symbols = symbols(self.mechanism, &frame, 1.0);
        let drawing = Drawing { mechanism: self.mechanism, frame: &frame, colours: &self.colours };
        let left_out = if self.crowded {
            drawing.lines(&mut self.text);
            0
        } else {
            // The letters of the axes below reach up a little.
            let (x, y) = (MARGIN, self.y);
            let room = Rectangle { x, y, width: WIDTH - 2.0 * MARGIN, height: height - 10.0 };
            drawing.symbols(&mut self.text, Some(&room))
        };
        self.y += height;
        self.strip(&frame, (MARGIN, WIDTH - 2.0 * MARGIN), views.main.seen_along().is_some());
        self.y += STRIP;
        left_out
    }

    /// The small views side by side, at one scale.
    fn small(&mut self, views: &[View]) {
        line(&mut self.text, "rule", &[(MARGIN, self.y + 4.0), (WIDTH - MARGIN, self.y + 4.0)]);
        self.y += 10.0;
        let cell = (WIDTH - 2.0 * MARGIN) / views.len().max(1) as f64;
        let extents: Vec<_> = views.iter().map(|view| extent(view, &self.reach)).collect();
        let room = (cell - 2.0 * ROUND_SMALL.0, HEIGHT_SMALL.1);
        let scales = extents.iter().map(|((across, up), _)| fitting(*across, *up, room));
        let scale = scale(scales.fold(f64::INFINITY, f64::min));
        let highest = extents.iter().map(|((_, up), _)| up * scale).fold(0.0, f64::max);
        let height = highest.clamp(HEIGHT_SMALL.0, HEIGHT_SMALL.1) + 2.0 * ROUND_SMALL.1;
        for (n, (view, (_, middle))) in views.iter().zip(extents).enumerate() {
            let left = MARGIN + n as f64 * cell;
            let along = view.seen_along().unwrap_or("");
            let title = format!("{}, along {along}", view.name);
            words(&mut self.text, "", (left, self.y + 16.0), "start", &title);
            let centre = (left + 0.5 * cell, self.y + LINE + 0.5 * height);
            let mut frame = Frame { view: view.clone(), middle, centre, scale, symbols: 0.72 };
            frame.symbols = symbols(self.mechanism, &frame, 0.72);
            let drawing =
                Drawing { mechanism: self.mechanism, frame: &frame, colours: &self.colours };
            if self.crowded {
                drawing.lines(&mut self.text);
            } else {
                drawing.symbols(&mut self.text, None);
            }
            let y = self.y;
            self.y += LINE + height;
            self.strip(&frame, (left, cell - 8.0), true);
            self.y = y;
        }
        self.y += LINE + height + STRIP;
    }

    /// Axes, gravity and scale below a view.
    fn strip(&mut self, frame: &Frame, (left, room): (f64, f64), scaled: bool) {
        let frame = &Frame { symbols: 0.8, ..frame.clone() };
        let symbols = Symbols { mechanism: self.mechanism, frame };
        let text = &mut self.text;
        let centre = (left + 36.0, self.y + 36.0);
        let mut axes: Vec<_> = Vec3::<f64>::axes().into_iter().zip(["x", "y", "z"]).collect();
        // Axes out of the paper are drawn above the others.
        axes.sort_by(|(a, _), (b, _)| {
            a.dot(frame.view.toward).abs().total_cmp(&b.dot(frame.view.toward).abs())
        });
        for (axis, name) in axes {
            arrow_with_name(text, &symbols, centre, axis, name);
        }
        let mut x = left + 98.0;
        if let Some(gravity) = self.mechanism.gravity {
            let down = Vec3::from_f64(gravity);
            let length = libm::sqrt(down.dot(down));
            if length.is_normal() {
                let down = down * (1.0 / length);
                let begin = frame.off((x, self.y + 34.0), down, -16.0);
                arrow_with_name(text, &symbols, begin, down, "g");
                x += 24.0;
            }
        }
        let most = (left + room - x - 6.0).min(150.0);
        let (length, name) = round_length(most / frame.scale);
        let name = if scaled { name } else { format!("{name}, parallel to the paper") };
        let pixels = length * frame.scale;
        if pixels.is_finite() && pixels > 1.0 {
            let fits = x + 0.5 * (pixels + width(&name, LETTERS)) < left + room;
            let x = if fits { x.max(x + 0.5 * (width(&name, LETTERS) - pixels)) } else { x };
            legend::scale_bar(text, (x, self.y + 42.0), (pixels, &name));
        }
    }

    /// Legend, omissions and projection.
    fn foot(&mut self, views: &Views, left_out: usize) {
        line(&mut self.text, "rule", &[(MARGIN, self.y), (WIDTH - MARGIN, self.y)]);
        self.y += 8.0;
        let corner = (MARGIN, self.y);
        if !self.crowded {
            self.y += legend::write(&mut self.text, self.mechanism, corner, WIDTH - 2.0 * MARGIN);
        }
        let Mechanism { bodies, joints, springs, guides, .. } = self.mechanism;
        let notes = if self.crowded {
            let shown = |count: usize, what: &str| match count {
                0 => String::new(),
                count if count <= LINES => format!(" {count} {what},"),
                count => format!(" {LINES} of {count} {what}, evenly sampled,"),
            };
            let parts = [
                shown(bodies.len(), "bodies"),
                shown(joints.len(), "joints as dots"),
                shown(springs.len(), "TSDAs as lines"),
            ];
            let parts = parts.concat();
            let Mechanism { torsions, interactions, forces, .. } = self.mechanism;
            let other = guides.len() + torsions.len() + interactions.len() + forces.len();
            let left = match other {
                0 => "Omitted: names, symbols.".into(),
                n => format!(
                    "Omitted: names, symbols, {n} points on lines, torsion springs, interactions, loads, inputs."
                ),
            };
            format!("Drawn:{}. {left}", parts.trim_end_matches(','))
        } else if left_out > 0 {
            let names = if left_out == 1 { "name" } else { "names" };
            format!(
                "{left_out} {names} omitted for lack of space: point at a part to show its name."
            )
        } else {
            String::new()
        };
        if !notes.is_empty() {
            self.write("quiet", &notes);
        }
        let middle = extent(&views.main, &self.reach).1;
        let size = extent(&views.main, &self.reach).0;
        let far = libm::sqrt(middle.dot(middle)) > 3.0 * size.0.max(size.1) && size != (0.0, 0.0);
        if far {
            let [x, y, z] = middle.to_f64().map(|value| format!("{value:.6e}"));
            self.write(
                "quiet",
                &format!("Far from the origin: the centre is at ({x}, {y}, {z}) m."),
            );
        }
        self.write("quiet", "Parallel projection at t = 0: top from above, side from the right.");
        self.y += MARGIN - 4.0;
    }

    fn finish(self, paper: Paper) -> String {
        let height = self.y.ceil();
        let name =
            escape(&dbd_scene::shortened(&self.mechanism.name).replace(char::is_control, " "));
        let background = match paper {
            Paper::File => {
                format!("<rect class=\"paper\" width=\"{WIDTH}\" height=\"{height}\"/>\n")
            }
            Paper::Page => String::new(),
        };
        format!(
            "<svg xmlns=\"http://www.w3.org/2000/svg\" class=\"{ROOT}\" width=\"{WIDTH}\" \
             height=\"{height}\" viewBox=\"0 0 {WIDTH} {height}\" role=\"img\">\n\
             <title>The mechanism {name}</title>\n<style>\n{}</style>\n{background}{}</svg>\n",
            sheet(),
            self.text
        )
    }
}

/// How large symbols are, so that those of joints do not hide bodies.
pub(crate) fn symbols(mechanism: &Mechanism, frame: &Frame, most: f64) -> f64 {
    /// \[pixels\] of a body whose symbols have their full size.
    const ROOMY: f64 = 60.0;
    let size = |row: usize| mechanism.size(row).map(|size| size * frame.scale);
    let mut sizes: Vec<f64> = (0..mechanism.bodies.len()).filter_map(size).collect();
    sizes.sort_by(f64::total_cmp);
    let usual = sizes.get(sizes.len() / 3).copied().unwrap_or(ROOMY);
    (usual / ROOMY).clamp(0.45 * most, most)
}

/// \[pixels/m\] at which a width and a height \[m\] fit into a room \[pixels\]; infinite of a point.
pub(crate) fn fitting(across: f64, up: f64, room: (f64, f64)) -> f64 {
    let fits = |size: f64, room: f64| if size > 0.0 { room / size } else { f64::INFINITY };
    fits(across, room.0).min(fits(up, room.1))
}

/// The scale, or a default.
pub(crate) fn scale(fitting: f64) -> f64 {
    if fitting.is_finite() && fitting > 0.0 { fitting } else { 100.0 }
}

/// An arrow from a point along a direction, with a letter at its end.
fn arrow_with_name(
    text: &mut String,
    symbols: &Symbols<'_>,
    at: Point,
    direction: Vec3<f64>,
    name: &str,
) {
    const LENGTH: f64 = 22.0;
    symbols.arrow(text, at, direction, (0.0, LENGTH), "ink");
    let (x, y) = symbols.frame.on_paper(direction);
    let length = libm::hypot(x, y);
    // Beside the circle of an axis out of the paper.
    let tip = if length > 0.12 {
        let reach = LENGTH * length.max(0.35) / length + 10.0 / length;
        (at.0 + reach * x, at.1 + reach * y)
    } else {
        (at.0 - 14.0, at.1 + 14.0)
    };
    words(text, "", (tip.0, tip.1 + 5.0), "middle", name);
}

/// The longest of 1, 2 and 5 times a power of ten that is at most so long \[m\], and its name.
fn round_length(most: f64) -> (f64, String) {
    if !(most.is_finite() && most > 0.0) {
        return (0.0, String::new());
    }
    let exponent = libm::floor(libm::log10(most)) as i32;
    let power = libm::pow(10.0, f64::from(exponent));
    let digit = [5.0, 2.0].into_iter().find(|digit| digit * power <= most).unwrap_or(1.0);
    let (unit, shift) = match exponent {
        3..6 => ("km", 3),
        -2..3 => ("m", 0),
        -3 => ("mm", -3),
        -6..-3 => ("µm", -6),
        -9..-6 => ("nm", -9),
        _ => return (digit * power, format!("{digit}e{exponent} m")),
    };
    let (unit, shift) = if exponent == -2 { ("mm", -3) } else { (unit, shift) };
    let value = digit * libm::pow(10.0, f64::from(exponent - shift));
    (digit * power, format!("{} {unit}", (value * 1e3).round() / 1e3))
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn scales_are_round_and_have_a_unit() {
        for (most, length, name) in [
            (1.7, 1.0, "1 m"),
            (0.3, 0.2, "0.2 m"),
            (0.06, 0.05, "50 mm"),
            (0.0021, 0.002, "2 mm"),
            (7300.0, 5000.0, "5 km"),
            (23.0, 20.0, "20 m"),
            (3e-5, 2e-5, "20 µm"),
            (4e9, 2e9, "2e9 m"),
        ] {
            let (found, words) = round_length(most);
            assert!((found / length - 1.0).abs() < 1e-12, "{most}: {found}");
            assert_eq!(words, name);
        }
        assert_eq!(round_length(f64::NAN).0, 0.0);
    }
}
