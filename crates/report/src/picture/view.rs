//! From which sides a mechanism is seen: views in parallel projection, and their scale.
//!
//! `mechanism => views => points on paper, depth`. Up on paper is against gravity where that lies
//! along an axis of the world, else y, without gravity too. Front, top and side are seen from the
//! front, from above and from the right (third-angle projection). A mechanism that lies in a plane
//! is shown in it; any other obliquely from the front, above, and the side that shows more.

use dbd_kernel::Vec3;

use crate::picture::mechanism::{Bounds, JointKind, Mechanism, Place, Solid};

/// A view direction.
#[derive(Clone, Debug, PartialEq)]
pub struct View {
    /// Its name.
    pub name: &'static str,
    /// To the right on paper, world.
    pub right: Vec3<f64>,
    /// Up on paper, world.
    pub up: Vec3<f64>,
    /// Out of the paper, world.
    pub toward: Vec3<f64>,
}

/// The views of a picture.
#[derive(Clone, Debug, PartialEq)]
pub struct Views {
    /// The large one.
    pub main: View,
    /// The others.
    pub small: Vec<View>,
    /// Whether the mechanism lies in the plane of the large one.
    pub planar: bool,
}

/// A mechanism thinner than this fraction of its size is planar.
const THIN: f64 = 0.02;
/// Sine of the angle within which directions count as one.
const PARALLEL: f64 = 1e-3;
/// \[rad\] elevation of the oblique view: off the angle at which edges of a cube hide each other.
const ELEVATION: f64 = 0.42;
/// \[rad\] azimuths of the oblique view from the front to the right, the usual one first.
const AZIMUTHS: [f64; 6] = [0.62, 0.95, 0.3, -0.62, -0.95, -0.3];
/// Factor by which another azimuth must be better than the default.
const BETTER: f64 = 1.15;

impl View {
    /// The world axis of the view direction, `−z`; `None` if it is oblique.
    #[must_use]
    pub fn seen_along(&self) -> Option<&'static str> {
        const NAMES: [[&str; 2]; 3] = [["x", "−x"], ["y", "−y"], ["z", "−z"]];
        let axes = self.toward.to_f64();
        let row = axes.iter().position(|value| value.abs() > 1.0 - 1e-9)?;
        Some(NAMES[row][usize::from(axes[row] > 0.0)])
    }
}

fn unit(vector: Vec3<f64>) -> Option<Vec3<f64>> {
    let length = libm::sqrt(vector.dot(vector));
    (length > 0.0 && length.is_finite()).then(|| vector * (1.0 / length))
}

fn parallel(a: Vec3<f64>, b: Vec3<f64>) -> bool {
    let across = a.cross(b);
    across.dot(across) <= PARALLEL * PARALLEL
}

/// The axis of the world that a vector lies along, with its sign.
fn axis_of(vector: Vec3<f64>) -> Option<Vec3<f64>> {
    let vector = unit(vector)?;
    let axes = Vec3::axes();
    let along = axes.into_iter().find(|axis| parallel(*axis, vector))?;
    Some(if along.dot(vector) > 0.0 { along } else { -along })
}

impl Views {
    /// The views of a mechanism.
    #[must_use]
    pub fn of(mechanism: &Mechanism) -> Self {
        let gravity = mechanism.gravity.map(|gravity| -Vec3::from_f64(gravity));
        let [x, y, _] = Vec3::axes();
        let up = gravity.and_then(axis_of).unwrap_or(y);
        let right = if parallel(up, x) { y } else { x };
        let out = right.cross(up);
        let front = View { name: "front", right, up, toward: out };
        let top = View { name: "top", right, up: -out, toward: up };
        let side = View { name: "side", right: -out, up, toward: right };
        let all = [front, top, side];
        let Some(normal) = normal(mechanism) else {
            return Self { main: oblique(mechanism, &all[0]), small: all.into(), planar: false };
        };
        if let Some(row) = all.iter().position(|view| parallel(view.toward, normal)) {
            let mut small = Vec::from(all);
            let main = small.remove(row);
            return Self { main, small, planar: true };
        }
        // From the side nearer to the front, top or right.
        let shares = [out, up, right].map(|side| normal.dot(side));
        let largest =
            shares.into_iter().fold(0.0, |a: f64, b| if b.abs() > a.abs() { b } else { a });
        let toward = if largest < 0.0 { -normal } else { normal };
        let up = unit(up - toward * up.dot(toward)).unwrap_or(up);
        let main = View { name: "in its plane", right: up.cross(toward), up, toward };
        let [front, top, _] = all;
        Self { main, small: vec![front, top], planar: true }
    }
}

/// The view from an azimuth, beside the front, and from above.
fn turned(front: &View, azimuth: f64) -> View {
    let (sine, cosine) = (libm::sin(azimuth), libm::cos(azimuth));
    let level = front.right * sine + front.toward * cosine;
    let toward = level * libm::cos(ELEVATION) + front.up * libm::sin(ELEVATION);
    let right = front.right * cosine - front.toward * sine;
    let name = match azimuth > 0.0 {
        true => "from the front, the right and above",
        false => "from the front, the left and above",
    };
    View { name, right, up: toward.cross(right), toward }
}

/// The oblique view in which joints hide each other least.
fn oblique(mechanism: &Mechanism, front: &View) -> View {
    /// Of more joints no angle shows each.
    const MAX: usize = 150;
    /// Fractions of the view's size: larger distances are sufficient.
    const APART: f64 = 0.08;
    let usual = turned(front, AZIMUTHS[0]);
    let mut places: Vec<Vec3<f64>> = Vec::new();
    for joint in &mechanism.joints {
        let place = mechanism.place(&joint.places[0]);
        if !places.contains(&place) {
            places.push(place);
        }
    }
    if places.len() < 2 || places.len() > MAX {
        return usual;
    }
    let reach = reach(mechanism);
    let clear = |view: &View| {
        let ((across, up), middle) = extent(view, &reach);
        let size = across.max(1.2 * up);
        let on_paper = |place: &Vec3<f64>| {
            let from = *place - middle;
            (from.dot(view.right) / size, from.dot(view.up) / size)
        };
        let points: Vec<(f64, f64)> = places.iter().map(on_paper).collect();
        let nearest = |(i, (x, y)): (usize, &(f64, f64))| {
            let others = points.iter().enumerate().filter(|(j, _)| *j != i);
            let gaps = others.map(|(_, other)| libm::hypot(other.0 - x, other.1 - y));
            gaps.fold(APART, f64::min)
        };
        points.iter().enumerate().map(nearest).sum::<f64>()
    };
    let mut best = (BETTER * clear(&usual), usual);
    for azimuth in &AZIMUTHS[1..] {
        let view = turned(front, *azimuth);
        let clear = clear(&view);
        if clear > best.0 {
            best = (clear, view);
        }
    }
    best.1
}

/// The points of a mechanism that define its size, without boxes of bodies.
fn points(mechanism: &Mechanism) -> impl Iterator<Item = Vec3<f64>> {
    let bodies = (0..mechanism.bodies.len()).map(|row| Place { body: Some(row), point: [0.0; 3] });
    let joints = mechanism.joints.iter().map(|joint| joint.places[0]);
    let springs = mechanism.springs.iter().flat_map(|spring| spring.ends);
    let guides = mechanism.guides.iter().map(|guide| guide.point);
    let places = bodies.chain(joints).chain(springs).chain(guides);
    places.map(|place| mechanism.place(&place))
}

/// All that is drawn of a mechanism to scale.
pub(crate) fn reach(mechanism: &Mechanism) -> Vec<Vec3<f64>> {
    let corners = (0..mechanism.bodies.len()).flat_map(|row| mechanism.corners(row));
    let ground = mechanism.ground.iter().flat_map(Solid::corners).map(Vec3::from_f64);
    let forces = mechanism.forces.iter().map(|force| force.at);
    let joints = mechanism.joints.iter().flat_map(|joint| joint.places);
    let lines = mechanism.guides.iter().map(|guide| guide.line);
    let torsions = mechanism.torsions.iter().map(|torsion| torsion.at);
    let interactions = mechanism.interactions.iter();
    let interactions = interactions.flat_map(|one| one.ends.into_iter().flatten().chain([one.at]));
    let symbols = forces.chain(joints).chain(lines).chain(torsions).chain(interactions);
    let symbols = symbols.map(|place| mechanism.place(&place));
    points(mechanism).chain(corners).chain(ground).chain(symbols).collect()
}

/// The normal of the plane that a mechanism lies in, `None` where it lies in none.
fn normal(mechanism: &Mechanism) -> Option<Vec3<f64>> {
    let points: Vec<Vec3<f64>> = points(mechanism).collect();
    let mut bounds = Bounds::default();
    points.iter().for_each(|point| bounds.add(*point));
    let (middle, size) = (bounds.middle(), bounds.longest());
    let thin = |normal: Vec3<f64>| {
        let off = |point: &Vec3<f64>| (*point - middle).dot(normal).abs();
        points.iter().all(|point| off(point) <= 0.5 * THIN * size)
    };
    // Rotation about one direction moves parts in the perpendicular plane.
    let turning = [JointKind::Revolute, JointKind::Cylindrical];
    let hinges = mechanism.joints.iter().filter(|joint| turning.contains(&joint.kind));
    let axes: Vec<Vec3<f64>> =
        hinges.flat_map(|joint| &joint.axes).map(|axis| mechanism.along(axis)).collect();
    if let Some(first) = axes.first() {
        let one = axes.iter().all(|axis| parallel(*first, *axis));
        return (one && thin(*first)).then_some(*first);
    }
    // Else a plane of two axes, where all does not lie on one line.
    let across: Vec<Vec3<f64>> = Vec3::axes().into_iter().filter(|axis| thin(*axis)).collect();
    match across[..] {
        [axis] => Some(axis),
        _ => None,
    }
}

/// A view at a scale, on a part of the paper.
#[derive(Clone, Debug)]
pub(crate) struct Frame {
    pub(crate) view: View,
    /// World point shown at `centre`.
    pub(crate) middle: Vec3<f64>,
    /// \[pixels\].
    pub(crate) centre: (f64, f64),
    /// \[pixels/m\].
    pub(crate) scale: f64,
    /// How large symbols are.
    pub(crate) symbols: f64,
}

impl Frame {
    /// Where a point of the world lies on paper \[pixels, y down\].
    pub(crate) fn at(&self, point: Vec3<f64>) -> (f64, f64) {
        let from = point - self.middle;
        let (x, y) = (from.dot(self.view.right), from.dot(self.view.up));
        (self.centre.0 + self.scale * x, self.centre.1 - self.scale * y)
    }

    /// Depth of a point out of the paper \[m\].
    pub(crate) fn depth(&self, point: Vec3<f64>) -> f64 {
        (point - self.middle).dot(self.view.toward)
    }

    /// A direction on paper, y down; shorter the more it leads out of it.
    pub(crate) fn on_paper(&self, direction: Vec3<f64>) -> (f64, f64) {
        (direction.dot(self.view.right), -direction.dot(self.view.up))
    }

    /// A point some pixels from another along a direction of the world.
    pub(crate) fn off(&self, (x, y): (f64, f64), direction: Vec3<f64>, pixels: f64) -> (f64, f64) {
        let (right, down) = self.on_paper(direction);
        (x + pixels * right, y + pixels * down)
    }
}

/// Width and height \[m\] of points in a view, and their middle in the world.
pub(crate) fn extent(view: &View, points: &[Vec3<f64>]) -> ((f64, f64), Vec3<f64>) {
    let mut bounds = Bounds::default();
    points.iter().for_each(|point| bounds.add(*point));
    let middle = bounds.middle();
    let mut seen = Bounds::default();
    for point in points {
        let from = *point - middle;
        seen.add(Vec3::new(from.dot(view.right), from.dot(view.up), from.dot(view.toward)));
    }
    let (width, height) = seen.sides();
    let Vec3 { x, y, z } = seen.middle();
    ((width, height), middle + view.right * x + view.up * y + view.toward * z)
}
