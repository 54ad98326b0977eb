//! Outlines of solids in a view: bars, plates, boxes, cylinders, links, balls.
//!
//! `(solid, frame) => outline, edges within it => SVG`. In a parallel projection each solid is the hull of its corners,
//! rims or circles.

use dbd_kernel::Vec3;

use crate::picture::ink::{Point, line, path, path_in, through};
use crate::picture::mechanism::{Mechanism, Place, Solid, block, rims};
use crate::picture::paths::{between, hull};
use crate::picture::view::Frame;

/// Points of a circle on paper.
const AROUND: usize = 32;

/// A part of a picture with an outline.
pub(crate) struct Face {
    /// Its corners on paper; two of a bar.
    pub(crate) corners: Vec<Point>,
    /// Lines that its outline does not have.
    edges: Vec<Vec<Point>>,
    /// Its own, `#rrggbb`.
    colour: Option<String>,
    /// Depth out of the paper \[m\].
    depth: f64,
}

impl Face {
    /// Without edges and without a separate colour.
    pub(crate) fn new(corners: Vec<Point>) -> Self {
        Self { corners, edges: Vec::new(), colour: None, depth: 0.0 }
    }

    /// The lines of its outline.
    pub(crate) fn strokes(&self) -> Vec<[Point; 2]> {
        let closed = if self.corners.len() > 2 { self.corners.first() } else { None };
        let around: Vec<Point> = self.corners.iter().chain(closed).copied().collect();
        around.windows(2).map(|pair| [pair[0], pair[1]]).collect()
    }

    /// Where a label points to.
    pub(crate) fn middle(&self) -> Point {
        match self.corners[..] {
            [a, b] => between(a, b, 0.5),
            _ => {
                let share = 1.0 / self.corners.len().max(1) as f64;
                let add = |(x, y): Point, c: &Point| (x + share * c.0, y + share * c.1);
                self.corners.iter().fold((0.0, 0.0), add)
            }
        }
    }

    /// \[pixels²\] Gauss's trapezoid formula.
    pub(crate) fn area(&self) -> f64 {
        let cross = |[a, b]: [Point; 2]| a.0 * b.1 - b.0 * a.1;
        (0.5 * self.strokes().into_iter().map(cross).sum::<f64>()).abs()
    }

    /// Draws it in the colours of two classes, or in its own.
    pub(crate) fn draw(&self, text: &mut String, stroke: &str, fill: &str) {
        if self.corners.len() < 3 {
            line(text, "case", &self.corners);
            line(text, &format!("bar {stroke}"), &self.corners);
            return;
        }
        let outline = through(&self.corners, true);
        path(text, "veil", &outline);
        let edges: String = self.edges.iter().map(|edge| through(edge, false)).collect();
        match &self.colour {
            Some(colour) => {
                path_in(text, "plate", &format!("stroke:{colour};fill:{colour}"), &outline);
                if !edges.is_empty() {
                    path_in(text, "edge", &format!("stroke:{colour}"), &edges);
                }
            }
            None => {
                path(text, &format!("plate {stroke} {fill}"), &outline);
                if !edges.is_empty() {
                    path(text, &format!("edge {stroke}"), &edges);
                }
            }
        }
    }

    /// The outline as the data of a path, as short as it goes.
    pub(crate) fn short(&self) -> String {
        let round = |(x, y): &Point| (libm::round(*x), libm::round(*y));
        let mut corners: Vec<Point> = self.corners.iter().map(round).collect();
        corners.dedup();
        through(&corners, corners.len() > 2)
    }
}

/// A block by its corners, numbered as [`block`] does.
pub(crate) fn block_face(corners_w: &[Vec3<f64>], frame: &Frame) -> Face {
    let all: Vec<Point> = corners_w.iter().map(|corner| frame.at(*corner)).collect();
    // The three edges that meet at the nearest corner lie within the outline.
    let depth = |corner: &usize| frame.depth(corners_w[*corner]);
    let nearest = (0..corners_w.len()).max_by(|a, b| depth(a).total_cmp(&depth(b))).unwrap_or(0);
    let edge = |bit: usize| vec![all[nearest], all[nearest ^ (1 << bit)]];
    Face { edges: vec![edge(0), edge(1), edge(2)], ..Face::new(hull(&all)) }
}

/// The solids of a body or of the ground, the farthest first.
pub(crate) fn solids(
    mechanism: &Mechanism,
    body: Option<usize>,
    solids: &[Solid],
    frame: &Frame,
) -> Vec<Face> {
    let mut faces: Vec<Face> =
        solids.iter().map(|one| solid(mechanism, body, one, frame)).collect();
    faces.sort_by(|a, b| a.depth.total_cmp(&b.depth));
    faces
}

fn solid(mechanism: &Mechanism, body: Option<usize>, solid: &Solid, frame: &Frame) -> Face {
    let world = |point: &[f64; 3]| mechanism.place(&Place { body, point: *point });
    let circle = |middle: &[f64; 3], radius: f64| {
        let (x, y) = frame.at(world(middle));
        let radius = radius * frame.scale;
        (0..AROUND).map(move |n| {
            let (sine, cosine) = libm::sincos(core::f64::consts::TAU * n as f64 / AROUND as f64);
            (x + radius * cosine, y + radius * sine)
        })
    };
    let face = match solid {
        Solid::Box { at, turn, half, .. } => {
            let corners: Vec<Vec3<f64>> = block(at, turn, half).iter().map(world).collect();
            block_face(&corners, frame)
        }
        Solid::Cylinder { ends, radius, .. } => {
            let rims = rims(ends, *radius);
            let near = ends.map(|end| frame.depth(world(&end)));
            let [from, to] = rims.map(|rim| -> Vec<Point> {
                rim.iter().map(|point| frame.at(world(point))).collect()
            });
            let outline = hull(&[from.as_slice(), &to].concat());
            let mut rim = if near[0] > near[1] { from } else { to };
            rim.extend(rim.first().copied());
            Face { edges: vec![rim], ..Face::new(outline) }
        }
        Solid::Link { ends, radius, .. } => {
            let circles = ends.iter().flat_map(|end| circle(end, *radius));
            Face::new(hull(&circles.collect::<Vec<_>>()))
        }
        Solid::Sphere { at, radius, .. } => Face::new(circle(at, *radius).collect()),
    };
    let corners = solid.corners();
    let share = 1.0 / corners.len().max(1) as f64;
    let depth = corners.iter().map(|corner| share * frame.depth(world(corner))).sum();
    Face { colour: solid.colour().map(str::to_owned), depth, ..face }
}
