//! Bodies in a view: bars, plates, blocks, and their centres of mass.
//!
//! `(outline, frame) => SVG`. Nearer parts have a rim of the paper's colour, which separates them from hidden parts.

use dbd_kernel::Vec3;

use crate::picture::faces::{Face, block_face, solids};
use crate::picture::ink::{Point, begin, circle, end, line, path};
use crate::picture::mechanism::{Mechanism, Outline};
use crate::picture::paths::{between, hull};
use crate::picture::style::COLOURS;
use crate::picture::view::Frame;

/// A colour for each body, another one than of the bodies that it is joined to where there are
/// enough.
pub(crate) fn colours(mechanism: &Mechanism) -> Vec<usize> {
    let count = mechanism.bodies.len();
    let mut joined = vec![Vec::new(); count];
    for joint in &mechanism.joints {
        if let [Some(a), Some(b)] = joint.places.map(|place| place.body) {
            joined[a].push(b);
            joined[b].push(a);
        }
    }
    let mut colours: Vec<usize> = Vec::with_capacity(count);
    for (row, others) in joined.iter().enumerate() {
        let first = row % COLOURS;
        let free = |colour: &usize| others.iter().all(|other| colours.get(*other) != Some(colour));
        let mut wheel = (0..COLOURS).map(|step| (first + step) % COLOURS);
        let found = if mechanism.is_spider(row) { None } else { wheel.find(free) };
        colours.push(found.unwrap_or(first));
    }
    colours
}

/// A body in a view.
pub(crate) struct Drawn {
    /// Where a label points to.
    pub(crate) anchor: Point,
    /// Lines that labels should not hide.
    pub(crate) strokes: Vec<[Point; 2]>,
    /// Depth out of the paper \[m\].
    pub(crate) depth: f64,
    /// Its shapes, the farthest first.
    faces: Vec<Face>,
    /// Its centre of mass.
    pub(crate) centre: Point,
}

/// A body in a view; `None` of a spider.
pub(crate) fn body(mechanism: &Mechanism, row: usize, frame: &Frame) -> Option<Drawn> {
    let shape = mechanism.bodies.get(row)?;
    let corners_w = mechanism.corners(row);
    if corners_w.is_empty() {
        return None;
    }
    let faces = match shape.shapes.is_empty() {
        false => solids(mechanism, Some(row), &shape.shapes, frame),
        true => vec![match &shape.outline {
            Outline::Block { .. } => block_face(&corners_w, frame),
            Outline::Plate { .. } => {
                let all: Vec<Point> = corners_w.iter().map(|corner| frame.at(*corner)).collect();
                Face::new(hull(&all))
            }
            Outline::Bar { .. } | Outline::Spider => {
                Face::new(corners_w.iter().map(|corner| frame.at(*corner)).collect())
            }
        }],
    };
    let centre = frame.at(Vec3::from_f64(shape.position));
    let share = 1.0 / corners_w.len() as f64;
    let depth = corners_w.iter().map(|corner| frame.depth(*corner) * share).sum();
    let strokes = faces.iter().flat_map(Face::strokes).collect();
    let largest = faces.iter().max_by(|a, b| a.area().total_cmp(&b.area()))?;
    Some(Drawn { anchor: largest.middle(), strokes, depth, faces, centre })
}

impl Drawn {
    /// Draws it in a colour; `title` is its tooltip.
    pub(crate) fn draw(&self, text: &mut String, colour: usize, title: &str) {
        begin(text, title);
        let (stroke, fill) = (format!("k{colour}"), format!("m{colour}"));
        self.faces.iter().for_each(|face| face.draw(text, &stroke, &fill));
        end(text);
    }

    /// Its centre of mass, with a line to the bar that it does not lie on.
    pub(crate) fn centre_of_mass(&self, text: &mut String, symbols: f64) {
        if let [Face { corners, .. }] = &self.faces[..]
            && let [from, to] = corners[..]
        {
            let nearest = nearest_on(from, to, self.centre);
            if libm::hypot(nearest.0 - self.centre.0, nearest.1 - self.centre.1) > 5.0 {
                line(text, "thin", &[nearest, self.centre]);
            }
        }
        centre_of_mass(text, self.centre, 4.5 * symbols);
    }

    /// The outline as the data of a path, as short as it goes.
    pub(crate) fn short(&self) -> String {
        self.faces.iter().map(Face::short).collect()
    }
}

fn nearest_on(from: Point, to: Point, point: Point) -> Point {
    let (x, y) = (to.0 - from.0, to.1 - from.1);
    let square = x * x + y * y;
    if square <= 0.0 {
        return from;
    }
    let share = ((point.0 - from.0) * x + (point.1 - from.1) * y) / square;
    between(from, to, share.clamp(0.0, 1.0))
}

/// The symbol of a centre of mass: a disc in quarters.
pub(crate) fn centre_of_mass(text: &mut String, (x, y): Point, radius: f64) {
    circle(text, "joint", (x, y), radius);
    let (left, right) =
        (crate::picture::ink::xy((x - radius, y)), crate::picture::ink::xy((x + radius, y)));
    let (top, bottom) =
        (crate::picture::ink::xy((x, y - radius)), crate::picture::ink::xy((x, y + radius)));
    let (middle, r) = (crate::picture::ink::xy((x, y)), crate::picture::ink::number(radius));
    let quarters =
        format!("M{middle}L{top}A{r} {r} 0 0 1 {right}ZM{middle}L{bottom}A{r} {r} 0 0 1 {left}Z");
    path(text, "full", &quarters);
}
