//! Volume, centre and inertia enclosed by a triangle mesh.
//!
//! `triangles, rule => volume, centre, tensor`. Each triangle forms a tetrahedron with a common point; the signed sums
//! over them give the integrals of the enclosed volume for any such point (Mirtich 1996). MuJoCo uses the centre of
//! area as the point to compute the centre of mass, and the centre of mass for the rest; this matters for its legacy
//! rule, whose sums are unsigned.

use std::collections::{BTreeMap, BTreeSet};

use chull::ConvexHullWrapper;
use nalgebra::{Isometry3, Matrix3, Vector3};

use crate::mass::Mass;

/// \[m³, m²\] smaller meshes have no mass in MuJoCo.
const LEAST: f64 = 1e-15;
/// \[1\] volumes of two rules within this relative difference are considered equal.
const ALIKE: f64 = 1e-6;

/// The part of a mesh that has mass.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(crate) enum Rule {
    /// The unsigned sum of its tetrahedra, which counts parts of a non-convex mesh twice.
    Legacy,
    /// Its convex hull.
    Convex,
    /// The enclosed volume.
    Exact,
    /// Its surface.
    Shell,
}

/// Triangles.
#[derive(Clone, Debug, Default, PartialEq)]
pub(crate) struct Surface {
    /// \[m\]
    pub(crate) points: Vec<Vector3<f64>>,
    /// Three vertices each, counter-clockwise as seen from outside.
    pub(crate) faces: Vec<[usize; 3]>,
    /// Number of further objects in its file.
    pub(crate) others: usize,
}

/// Mass properties at a density of 1.
#[derive(Clone, Debug, PartialEq)]
pub(crate) struct Bulk {
    /// Its mass, which is its volume, or of a shell its area.
    mass: Mass,
    /// Description.
    pub(crate) words: String,
    /// \[m³\] the enclosed volume, where the rule yields another.
    pub(crate) enclosed: Option<f64>,
}

impl Bulk {
    /// \[m³, m²\] volume, or area for a shell.
    pub(crate) fn size(&self) -> f64 {
        self.mass.mass
    }

    /// Its mass at a pose.
    pub(crate) fn mass(&self, mass: f64, pose: &Isometry3<f64>) -> Mass {
        self.mass.scaled(mass / self.size()).seen_from(pose)
    }
}

impl Surface {
    /// The triangles of an element; without faces, those of its convex hull.
    pub(crate) fn of_numbers(vertices: &[f64], faces: &[f64]) -> Result<Self, String> {
        // MuJoCo stores vertices in single precision.
        let single = |part: &f64| f64::from(*part as f32);
        let points: Vec<Vector3<f64>> = vertices
            .chunks_exact(3)
            .map(|point| Vector3::new(single(&point[0]), single(&point[1]), single(&point[2])))
            .collect();
        let mut corners = Vec::with_capacity(faces.len());
        for corner in faces {
            let is_one = *corner >= 0.0 && corner.fract() == 0.0 && *corner < points.len() as f64;
            if !is_one {
                return Err(format!("a face refers to vertex {corner}, which does not exist"));
            }
            corners.push(*corner as usize);
        }
        let whole =
            vertices.len().is_multiple_of(3) && corners.len().is_multiple_of(3) && points.len() > 3;
        if !whole {
            return Err(
                "it needs at least four vertices and three numbers for each vertex and face".into(),
            );
        }
        let faces = corners.chunks_exact(3).map(|face| [face[0], face[1], face[2]]).collect();
        let surface = Self { points, faces, others: 0 };
        if surface.faces.is_empty() { surface.hull() } else { Ok(surface) }
    }

    /// Its mass properties by a rule; `Err`: why it has none.
    pub(crate) fn bulk(&self, rule: Rule) -> Result<Bulk, String> {
        if self.faces.is_empty() {
            return Err("it has no faces".into());
        }
        if !self.points.iter().all(|point| point.iter().all(|part| part.is_finite())) {
            return Err("its vertices are not finite".into());
        }
        let signed = |volume: f64| volume;
        let (mass, enclosed) = match rule {
            Rule::Shell => (self.shell(), None),
            Rule::Convex => (self.hull()?.filled(f64::abs), None),
            Rule::Exact => {
                self.check_sides()?;
                (self.filled(signed), None)
            }
            Rule::Legacy => {
                let (mass, enclosed) = (self.filled(f64::abs), self.filled(signed).mass.abs());
                let differs = (mass.mass - enclosed).abs() > ALIKE * mass.mass;
                (mass, differs.then_some(enclosed))
            }
        };
        if mass.mass < 0.0 {
            return Err("its faces are oriented inwards: the volume is negative".into());
        }
        if mass.mass < LEAST {
            return Err("it encloses no volume: use inertia=\"shell\" for a surface".into());
        }
        let words = match rule {
            Rule::Shell => format!("shell of a mesh, {:.6e} m²", mass.mass),
            Rule::Convex => format!("convex hull of a mesh, {:.6e} m³", mass.mass),
            Rule::Exact | Rule::Legacy => format!("mesh, {:.6e} m³", mass.mass),
        };
        let words = match self.others {
            0 => words,
            others => format!("{words}, the first of {} objects", others + 1),
        };
        Ok(Bulk { mass, words, enclosed })
    }

    fn corners(&self) -> impl Iterator<Item = [Vector3<f64>; 3]> {
        self.faces.iter().map(|face| face.map(|corner| self.points[corner]))
    }

    /// The centre of area, and the area.
    fn centre_of_area(&self) -> (Vector3<f64>, f64) {
        let (mut sum, mut area) = (Vector3::zeros(), 0.0);
        for [a, b, c] in self.corners() {
            let one = (b - a).cross(&(c - a)).norm() / 2.0;
            sum += (a + b + c) / 3.0 * one;
            area += one;
        }
        (if area > 0.0 { sum / area } else { sum }, area)
    }

    /// Mass properties of its tetrahedra, each weighted by `count` of its volume.
    fn filled(&self, count: impl Fn(f64) -> f64) -> Mass {
        let (inside, _) = self.centre_of_area();
        let volume = |[a, b, c]: [Vector3<f64>; 3]| count(a.dot(&b.cross(&c)) / 6.0);
        let (mut sum, mut whole) = (Vector3::zeros(), 0.0);
        for corners in self.corners() {
            let about = corners.map(|corner| corner - inside);
            let own = volume(about);
            sum += (about[0] + about[1] + about[2]) / 4.0 * own;
            whole += own;
        }
        if whole == 0.0 {
            return Mass::default();
        }
        let centre = inside + sum / whole;
        let (mut second, mut whole) = (Matrix3::zeros(), 0.0);
        for corners in self.corners() {
            let about = corners.map(|corner| corner - centre);
            let own = volume(about);
            second += moments(about) * (own / 20.0);
            whole += own;
        }
        solid(whole, &second, centre)
    }

    /// Mass properties of its faces.
    fn shell(&self) -> Mass {
        let (centre, area) = self.centre_of_area();
        let mut second = Matrix3::zeros();
        for [a, b, c] in self.corners() {
            let own = (b - a).cross(&(c - a)).norm() / 2.0;
            second += moments([a, b, c].map(|corner| corner - centre)) * (own / 12.0);
        }
        solid(area, &second, centre)
    }

    /// Refuses inconsistently oriented faces: two that traverse an edge in the same direction.
    fn check_sides(&self) -> Result<(), String> {
        // Files repeat vertices; coincident ones are merged.
        let mut places = BTreeMap::new();
        let place = |point: &Vector3<f64>| [point.x, point.y, point.z].map(|x| (x + 0.0).to_bits());
        let one: Vec<usize> = (0..self.points.len())
            .map(|point| *places.entry(place(&self.points[point])).or_insert(point))
            .collect();
        let mut edges = BTreeSet::new();
        for face in &self.faces {
            for side in 0..3 {
                let [from, to] = [face[side], face[(side + 1) % 3]].map(|corner| one[corner]);
                if from != to && !edges.insert((from, to)) {
                    let p = self.points[from];
                    return Err(format!(
                        "its faces are oriented inconsistently at {} {} {}",
                        p.x, p.y, p.z
                    ));
                }
            }
        }
        Ok(())
    }

    /// Its convex hull.
    fn hull(&self) -> Result<Self, String> {
        let points: Vec<Vec<f64>> =
            self.points.iter().map(|point| vec![point.x, point.y, point.z]).collect();
        let hull = ConvexHullWrapper::try_new(&points, None)
            .map_err(|_| "its vertices span no volume".to_owned())?;
        let (points, corners) = hull.vertices_indices();
        let points = points.iter().map(|point| Vector3::from_column_slice(point)).collect();
        let faces = corners.chunks_exact(3).map(|face| [face[0], face[1], face[2]]).collect();
        Ok(Self { points, faces, others: 0 })
    }
}

/// Σ p·pᵀ and the same of the sum of all p: the second moments of a tetrahedron with the origin times
/// 20/volume, of a triangle times 12/area.
fn moments([a, b, c]: [Vector3<f64>; 3]) -> Matrix3<f64> {
    let sum = a + b + c;
    let square = |p: Vector3<f64>| p * p.transpose();
    square(a) + square(b) + square(c) + square(sum)
}

/// A mass with its second moments about its centre.
fn solid(mass: f64, second: &Matrix3<f64>, centre: Vector3<f64>) -> Mass {
    let tensor = Matrix3::identity() * second.trace() - second;
    Mass::tensor(mass, &tensor, &Isometry3::translation(centre.x, centre.y, centre.z))
}
