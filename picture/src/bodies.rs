//! Bodies in a view: bars, plates, blocks, and their centres of mass.
//!
//! `(outline, frame) => SVG`. What is nearer has a rim of the paper's colour, which sets it off from
//! what it hides.

use dbd_kernel::Vec3;

use crate::ink::{Point, begin, circle, end, line, path, through};
use crate::mechanism::{Mechanism, Outline};
use crate::paths::{between, hull};
use crate::style::COLOURS;
use crate::view::Frame;

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
    /// How far out of the paper it lies \[m\].
    pub(crate) depth: f64,
    /// Its corners on paper.
    corners: Vec<Point>,
    /// Edges that its outline does not have.
    edges: Vec<[Point; 2]>,
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
    let all: Vec<Point> = corners_w.iter().map(|corner| frame.at(*corner)).collect();
    let centre = frame.at(Vec3::from_f64(shape.position));
    let share = 1.0 / corners_w.len() as f64;
    let depth = corners_w.iter().map(|corner| frame.depth(*corner) * share).sum();
    let (corners, edges) = match &shape.outline {
        Outline::Bar { .. } | Outline::Spider => (all, Vec::new()),
        Outline::Plate { .. } => (hull(&all), Vec::new()),
        Outline::Block { .. } => {
            // The three edges that meet at the nearest corner lie within the outline.
            let depth = |corner: &usize| frame.depth(corners_w[*corner]);
            let nearest = (0..8).max_by(|a, b| depth(a).total_cmp(&depth(b))).unwrap_or(0);
            let edge = |bit: usize| [all[nearest], all[nearest ^ (1 << bit)]];
            (hull(&all), vec![edge(0), edge(1), edge(2)])
        }
    };
    let closed = if corners.len() > 2 { corners.first() } else { None };
    let around: Vec<Point> = corners.iter().chain(closed).copied().collect();
    let strokes = around.windows(2).map(|pair| [pair[0], pair[1]]).collect();
    let anchor = match corners[..] {
        [a, b] => between(a, b, 0.5),
        _ => {
            let share = 1.0 / corners.len() as f64;
            corners.iter().fold((0.0, 0.0), |(x, y), c| (x + share * c.0, y + share * c.1))
        }
    };
    Some(Drawn { anchor, strokes, depth, corners, edges, centre })
}

impl Drawn {
    /// Draws it in a colour; `title` is what pointing at it shows.
    pub(crate) fn draw(&self, text: &mut String, colour: usize, title: &str) {
        begin(text, title);
        if self.corners.len() < 3 {
            line(text, "case", &self.corners);
            line(text, &format!("bar k{colour}"), &self.corners);
        } else {
            let outline = through(&self.corners, true);
            path(text, "veil", &outline);
            path(text, &format!("plate k{colour} m{colour}"), &outline);
            let edges: String = self.edges.iter().map(|edge| through(edge, false)).collect();
            if !edges.is_empty() {
                path(text, &format!("edge k{colour}"), &edges);
            }
        }
        end(text);
    }

    /// Its centre of mass, with a line to the bar that it does not lie on.
    pub(crate) fn centre_of_mass(&self, text: &mut String, symbols: f64) {
        if let [from, to] = self.corners[..] {
            let nearest = nearest_on(from, to, self.centre);
            if libm::hypot(nearest.0 - self.centre.0, nearest.1 - self.centre.1) > 5.0 {
                line(text, "thin", &[nearest, self.centre]);
            }
        }
        centre_of_mass(text, self.centre, 4.5 * symbols);
    }

    /// The outline as the data of a path, as short as it goes.
    pub(crate) fn short(&self) -> String {
        let round = |(x, y): &Point| (libm::round(*x), libm::round(*y));
        let mut corners: Vec<Point> = self.corners.iter().map(round).collect();
        corners.dedup();
        through(&corners, corners.len() > 2)
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
    let (left, right) = (crate::ink::xy((x - radius, y)), crate::ink::xy((x + radius, y)));
    let (top, bottom) = (crate::ink::xy((x, y - radius)), crate::ink::xy((x, y + radius)));
    let (middle, r) = (crate::ink::xy((x, y)), crate::ink::number(radius));
    let quarters =
        format!("M{middle}L{top}A{r} {r} 0 0 1 {right}ZM{middle}L{bottom}A{r} {r} 0 0 1 {left}Z");
    path(text, "full", &quarters);
}
