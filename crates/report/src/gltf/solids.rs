//! Solids as triangles.
//!
//! `boxes, rods, balls, hulls => positions, normals, triangles`, all in the axes of one node.

use dbd_kernel::{Quaternion, Vec3};

/// Sides of round solids.
const ROUND: usize = 16;
/// Rings of a ball from pole to pole.
const RINGS: usize = 8;
/// Of more points no hull is sought.
const MAX_HULL: usize = 24;

type Vector = Vec3<f64>;

/// Triangles with normals.
#[derive(Clone, Debug, Default, PartialEq)]
pub(super) struct Solids {
    /// \[m\].
    pub(super) positions: Vec<[f32; 3]>,
    /// Unit vectors, one per position.
    pub(super) normals: Vec<[f32; 3]>,
    /// Rows of positions, three per triangle, counterclockwise from outside.
    pub(super) triangles: Vec<u32>,
}

impl Solids {
    fn corner(&mut self, at: Vector, normal: Vector) -> u32 {
        self.positions.push(at.to_f64().map(|x| x as f32));
        self.normals.push(unit(normal).to_f64().map(|x| x as f32));
        self.positions.len() as u32 - 1
    }

    /// A flat face with its corners counterclockwise from outside.
    fn face(&mut self, corners: &[Vector], normal: Vector) {
        let rows: Vec<u32> = corners.iter().map(|at| self.corner(*at, normal)).collect();
        for pair in rows.windows(2).skip(1) {
            self.triangles.extend([rows[0], pair[0], pair[1]]);
        }
    }

    /// A box along the axes, by its middle and half of each side \[m\].
    pub(super) fn add_box(&mut self, at: Vector, half: [f64; 3]) {
        self.add_turned_box(at, Quaternion::IDENTITY, half);
    }

    /// A box rotated from the axes by a unit quaternion.
    pub(super) fn add_turned_box(&mut self, at: Vector, turn: Quaternion<f64>, half: [f64; 3]) {
        let rotation = turn.rotation();
        for axis in 0..3 {
            for side in [1.0, -1.0] {
                let along = |axis: usize, by: f64| {
                    let mut vector = [0.0; 3];
                    vector[axis] = by;
                    rotation.to_world(Vec3::from_f64(vector))
                };
                let (u, v) = ((axis + 1) % 3, (axis + 2) % 3);
                let (out, u, v) =
                    (along(axis, side * half[axis]), along(u, half[u]), along(v, side * half[v]));
                let corners = [out - u - v, out + u - v, out + u + v, out - u + v];
                self.face(&corners.map(|corner| at + corner), along(axis, side));
            }
        }
    }

    /// A round bar from one point to another.
    pub(super) fn add_rod(&mut self, from: Vector, to: Vector, radius: f64) {
        self.add_prism(from, to, radius, ROUND);
    }

    /// A bar with the given number of sides; a ball if it is too short.
    pub(super) fn add_prism(&mut self, from: Vector, to: Vector, radius: f64, sides: usize) {
        let way = to - from;
        if way.dot(way).sqrt() < 1e-6 * radius {
            return self.add_ball(from, radius);
        }
        let along = unit(way);
        let [u, v] = along.normals();
        let turned = |side: usize| {
            let (sine, cosine) = (std::f64::consts::TAU * side as f64 / sides as f64).sin_cos();
            u * cosine + v * sine
        };
        let smooth = sides == ROUND;
        for side in 0..sides {
            let (a, b) = (turned(side), turned(side + 1));
            let [na, nb] = if smooth { [a, b] } else { [a + b; 2] };
            let rows = [
                self.corner(from + a * radius, na),
                self.corner(from + b * radius, nb),
                self.corner(to + b * radius, nb),
                self.corner(to + a * radius, na),
            ];
            // The normals define the outside.
            let outward = u.cross(v).dot(along) > 0.0;
            let order = if outward { [0, 1, 2, 0, 2, 3] } else { [0, 2, 1, 0, 3, 2] };
            self.triangles.extend(order.map(|corner| rows[corner]));
        }
        for (end, out) in [(from, -along), (to, along)] {
            let mut rim: Vec<Vector> = (0..sides).map(|side| end + turned(side) * radius).collect();
            if u.cross(v).dot(out) < 0.0 {
                rim.reverse();
            }
            self.face(&rim, out);
        }
    }

    /// A ball.
    pub(super) fn add_ball(&mut self, at: Vector, radius: f64) {
        let first = self.positions.len() as u32;
        for ring in 0..=RINGS {
            let (r, z) = (std::f64::consts::PI * ring as f64 / RINGS as f64).sin_cos();
            for side in 0..=ROUND {
                let (sine, cosine) = (std::f64::consts::TAU * side as f64 / ROUND as f64).sin_cos();
                let out = Vec3::new(r * cosine, r * sine, z);
                self.corner(at + out * radius, out);
            }
        }
        let around = ROUND as u32 + 1;
        for ring in 0..RINGS as u32 {
            for side in 0..ROUND as u32 {
                let a = first + ring * around + side;
                let (b, c, d) = (a + around, a + around + 1, a + 1);
                if ring > 0 {
                    self.triangles.extend([a, b, d]);
                }
                if ring + 1 < RINGS as u32 {
                    self.triangles.extend([d, b, c]);
                }
            }
        }
    }

    /// A solid that connects points: the faces of their hull, two-sided if they lie in a plane, and a bar along each
    /// edge; for many points bars from their centre.
    pub(super) fn add_plate(&mut self, points: &[Vector], radius: f64) {
        points.iter().for_each(|point| self.add_ball(*point, radius));
        let share = 1.0 / points.len().max(1) as f64;
        let middle = points.iter().fold(Vec3::ZERO, |sum, point| sum + *point * share);
        let faces = if points.len() > MAX_HULL { Vec::new() } else { faces(points) };
        if faces.is_empty() {
            points.iter().for_each(|point| self.add_rod(middle, *point, radius));
        }
        for [a, b, c] in &faces {
            let [a, b, c] = [points[*a], points[*b], points[*c]];
            self.face(&[a, b, c], (b - a).cross(c - a));
        }
        let edges = faces.iter().flat_map(|[a, b, c]| [[a, b], [b, c], [c, a]]);
        let mut edges: Vec<[usize; 2]> = edges.map(|[a, b]| [*a.min(b), *a.max(b)]).collect();
        edges.sort_unstable();
        edges.dedup();
        for [a, b] in edges {
            self.add_rod(points[a], points[b], radius);
        }
    }
}

/// The triangles of a hull, by the points on one side of each, from outside; of points in a plane
/// each triangle twice.
fn faces(points: &[Vector]) -> Vec<[usize; 3]> {
    let reach = points.iter().map(|point| point.dot(*point)).fold(0.0, f64::max).sqrt();
    let mut faces = Vec::new();
    let rows = 0..points.len();
    for (a, b, c) in rows
        .clone()
        .flat_map(|a| (a + 1..points.len()).map(move |b| (a, b)))
        .flat_map(|(a, b)| (b + 1..points.len()).map(move |c| (a, b, c)))
    {
        let normal = (points[b] - points[a]).cross(points[c] - points[a]);
        let tall = normal.dot(normal).sqrt();
        if tall <= 1e-9 * reach * reach {
            continue;
        }
        let heights = rows.clone().map(|row| (points[row] - points[a]).dot(normal) / tall);
        let (low, high) = heights
            .fold((0.0_f64, 0.0_f64), |(low, high), height| (low.min(height), high.max(height)));
        let flat = 1e-6 * reach;
        if high <= flat {
            faces.push([a, b, c]);
        }
        if low >= -flat {
            faces.push([a, c, b]);
        }
    }
    faces
}

fn unit(vector: Vector) -> Vector {
    let length = vector.dot(vector).sqrt();
    if length > 0.0 { vector * (1.0 / length) } else { Vec3::new(0.0, 0.0, 1.0) }
}

#[cfg(test)]
mod tests {
    use super::*;

    /// The volume within triangles that face outwards \[m³\].
    fn volume(solids: &Solids) -> f64 {
        let at = |row: &u32| Vector::from_f64(solids.positions[*row as usize].map(f64::from));
        let parts = solids.triangles.chunks(3).map(|rows| {
            let [a, b, c] = [at(&rows[0]), at(&rows[1]), at(&rows[2])];
            // Every triangle is oriented like its normals.
            let normal = Vec3::from_f64(solids.normals[rows[0] as usize].map(f64::from));
            assert!((b - a).cross(c - a).dot(normal) > 0.0);
            a.dot(b.cross(c)) / 6.0
        });
        parts.sum()
    }

    #[test]
    fn solids_are_closed_and_look_outwards() {
        let made = |make: &dyn Fn(&mut Solids)| {
            let mut solids = Solids::default();
            make(&mut solids);
            volume(&solids)
        };
        let at = Vec3::new(0.3, -0.2, 0.1);
        let boxed = made(&|solids| solids.add_box(at, [0.5, 1.0, 1.5]));
        assert!((boxed - 6.0).abs() < 1e-5, "{boxed}");
        for to in [Vector::new(0.0, 0.0, 2.0), Vec3::new(1.0, -1.0, 0.5), Vec3::new(-2.0, 0.0, 0.0)]
        {
            let length = to.dot(to).sqrt();
            let rod = made(&|solids| solids.add_rod(at, at + to, 0.1));
            let round = 0.01 * std::f64::consts::PI * length;
            assert!((rod / round - 0.97).abs() < 0.02, "{rod} {round}");
            let square = made(&|solids| solids.add_prism(at, at + to, 0.1, 4));
            assert!((square / (0.02 * length) - 1.0).abs() < 1e-5);
        }
        let ball = made(&|solids| solids.add_ball(at, 1.0));
        assert!((ball / (4.0 / 3.0 * std::f64::consts::PI) - 0.92).abs() < 0.03, "{ball}");
        let corners = [[0.0; 3], [3.0, 0.0, 0.0], [0.0, 3.0, 0.0], [0.0, 0.0, 3.0]];
        let plate = made(&|solids| solids.add_plate(&corners.map(Vec3::from_f64), 1e-3));
        assert!((plate - 4.5).abs() < 1e-3, "{plate}");
    }
}
