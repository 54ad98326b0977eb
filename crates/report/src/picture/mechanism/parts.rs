//! The parts of a mechanism, and where they are.
//!
//! `(part, poses of the bodies) => points in the world`.

use dbd_kernel::{Quaternion, Vec3};
use serde::Serialize;

use super::solid::{Solid, block};

/// A mechanism at a pose.
#[derive(Clone, Debug, PartialEq, Serialize)]
pub struct Mechanism {
    /// The scene's name.
    pub name: String,
    /// The bodies in the model's order, spiders of universal joints among them.
    pub bodies: Vec<BodyShape>,
    /// Solids of the ground, world.
    pub ground: Vec<Solid>,
    /// The joints in scene order.
    pub joints: Vec<JointMark>,
    /// The TSDAs that joints are made of, in the model's order.
    pub joint_springs: Vec<JointSpring>,
    /// Raw TSDAs and point bushings.
    pub springs: Vec<SpringMark>,
    /// Raw points on lines.
    pub guides: Vec<GuideMark>,
    /// Torsion springs.
    pub torsions: Vec<TorsionMark>,
    /// Interactions whose law has points or an axis.
    pub interactions: Vec<InteractionMark>,
    /// Loads and inputs.
    pub forces: Vec<ForceMark>,
    /// \[m/s²\] the field of gravity, world; `None` without one.
    pub gravity: Option<[f64; 3]>,
}

/// A point of a body or of the ground.
#[derive(Clone, Copy, Debug, PartialEq, Serialize)]
pub struct Place {
    /// The body; `None` for the ground.
    pub body: Option<usize>,
    /// \[m\] in the body's axes from its centre of mass; world for the ground.
    pub point: [f64; 3],
}

/// A direction in the axes of a body or of the world.
#[derive(Clone, Copy, Debug, PartialEq, Serialize)]
pub struct Along {
    /// The body; `None` for the world.
    pub body: Option<usize>,
    /// Unit vector.
    pub vector: [f64; 3],
}

/// A body.
#[derive(Clone, Debug, PartialEq, Serialize)]
pub struct BodyShape {
    /// Its name.
    pub name: String,
    /// \[kg\].
    pub mass: f64,
    /// \[m\] its centre of mass, world.
    pub position: [f64; 3],
    /// Unit quaternion, scalar first, body → world.
    pub orientation: [f64; 4],
    /// Its outline if it has no shapes.
    pub outline: Outline,
    /// The solids of the scene's `[[geometry]]`; where there are some it is drawn by them.
    pub shapes: Vec<Solid>,
}

/// Outline of a body, in its axes from its centre of mass.
#[derive(Clone, Debug, PartialEq, Serialize)]
pub enum Outline {
    /// Straight between two points of joints and elements, or between one and the centre of mass.
    Bar {
        /// \[m\].
        ends: [[f64; 3]; 2],
    },
    /// The hull of three or more points of joints and elements.
    Plate {
        /// \[m\].
        points: Vec<[f64; 3]>,
    },
    /// The box of its mass and inertia, for nothing else tells its size.
    Block {
        /// \[m\] half of each side, along the body's axes.
        half: [f64; 3],
    },
    /// The spider of a universal joint, drawn as the joint's cross.
    Spider,
}

/// A joint's type.
#[derive(Clone, Copy, Debug, PartialEq, Eq, PartialOrd, Ord, Serialize)]
#[serde(rename_all = "snake_case")]
pub enum JointKind {
    /// No relative motion.
    Fixed,
    /// Lets slide along an axis.
    Translational,
    /// Sliding along an axis and rotation about it.
    Cylindrical,
    /// Rotation about an axis.
    Revolute,
    /// Rotation about two axes.
    Universal,
    /// Rotation about any axis.
    Spherical,
    /// One that this crate has no symbol for.
    Other,
}

/// A joint.
#[derive(Clone, Debug, PartialEq, Serialize)]
pub struct JointMark {
    /// Its name.
    pub name: String,
    /// Its type.
    pub kind: JointKind,
    /// Its point on the first body and the same on the second.
    pub places: [Place; 2],
    /// The axes about which or along which it moves: two of a universal joint, one of a revolute,
    /// cylindrical and translational joint, else none.
    pub axes: Vec<Along>,
}

/// A TSDA of a joint.
#[derive(Clone, Debug, PartialEq, Serialize)]
pub struct JointSpring {
    /// The joint's row.
    pub joint: usize,
    /// Its ends.
    pub ends: [Place; 2],
}

/// A spring and damper between two points.
#[derive(Clone, Debug, PartialEq, Serialize)]
pub struct SpringMark {
    /// Its name, where it has one.
    pub name: Option<String>,
    /// Its ends.
    pub ends: [Place; 2],
    /// \[m\] its free length; 0 of a point bushing.
    pub free_length: f64,
    /// Whether an input pulls along it.
    pub driven: bool,
}

/// A point on a line.
#[derive(Clone, Debug, PartialEq, Serialize)]
pub struct GuideMark {
    /// Its name, where it has one.
    pub name: Option<String>,
    /// The point of the line that is nearest to the guided one at the initial pose.
    pub line: Place,
    /// The line's direction.
    pub direction: Along,
    /// The point that it guides.
    pub point: Place,
}

/// A torsion spring.
#[derive(Clone, Debug, PartialEq, Serialize)]
pub struct TorsionMark {
    /// Its name, where it has one.
    pub name: Option<String>,
    /// Where it is drawn: at the joint of its two bodies, else between them.
    pub at: Place,
    /// Its axis.
    pub axis: Along,
}

/// An interaction between two bodies.
#[derive(Clone, Debug, PartialEq, Serialize)]
pub struct InteractionMark {
    /// Its name, where it has one.
    pub name: Option<String>,
    /// The name of its law.
    pub law: &'static str,
    /// Its points on the first and on the second body, where its law has points.
    pub ends: Option<[Place; 2]>,
    /// The normal of the plane through the first point, where its law has one.
    pub normal: Option<Along>,
    /// Its axis, where its law has one.
    pub axis: Option<Along>,
    /// Where its axis is drawn: at the joint of its two bodies, else at the centre of the second.
    pub at: Place,
}

/// Kind of a force.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Serialize)]
#[serde(rename_all = "snake_case")]
pub enum ForceKind {
    /// Pushes along its direction.
    Force,
    /// Torque about its direction.
    Torque,
    /// Moves the ground's points along its direction.
    Shift,
}

/// A load, or an input that is no actuator.
#[derive(Clone, Debug, PartialEq, Serialize)]
pub struct ForceMark {
    /// The input's name; `None` for a load.
    pub input: Option<String>,
    /// Its kind.
    pub kind: ForceKind,
    /// The unit of its value.
    pub unit: &'static str,
    /// Where.
    pub at: Place,
    /// Its direction, the one of a positive value.
    pub direction: Along,
}

impl Mechanism {
    /// A point in the world \[m\].
    #[must_use]
    pub fn place(&self, place: &Place) -> Vec3<f64> {
        let point = self.turned(place.body, place.point);
        match place.body.and_then(|row| self.bodies.get(row)) {
            Some(body) => Vec3::from_f64(body.position) + point,
            None => point,
        }
    }

    /// A direction in the world.
    #[must_use]
    pub fn along(&self, along: &Along) -> Vec3<f64> {
        self.turned(along.body, along.vector)
    }

    /// A point of the world in the axes of its owner.
    #[must_use]
    pub fn local(&self, body: Option<usize>, point_w: Vec3<f64>) -> Place {
        let point = match body.and_then(|row| self.bodies.get(row)) {
            Some(shape) => {
                let rotation = Quaternion::from_f64(shape.orientation).rotation();
                rotation.to_body(point_w - Vec3::from_f64(shape.position))
            }
            None => point_w,
        };
        Place { body, point: point.to_f64() }
    }

    fn turned(&self, body: Option<usize>, vector: [f64; 3]) -> Vec3<f64> {
        let vector = Vec3::from_f64(vector);
        match body.and_then(|row| self.bodies.get(row)) {
            Some(body) => Quaternion::from_f64(body.orientation).rotation().to_world(vector),
            None => vector,
        }
    }

    /// The corners of a body's shapes or of its outline in the world \[m\]; none of a spider.
    #[must_use]
    pub fn corners(&self, row: usize) -> Vec<Vec3<f64>> {
        let Some(body) = self.bodies.get(row) else { return Vec::new() };
        let place = |point: &[f64; 3]| self.place(&Place { body: Some(row), point: *point });
        if !body.shapes.is_empty() {
            return body
                .shapes
                .iter()
                .flat_map(Solid::corners)
                .map(|point| place(&point))
                .collect();
        }
        match &body.outline {
            Outline::Bar { ends } => ends.iter().map(place).collect(),
            Outline::Plate { points } => points.iter().map(place).collect(),
            Outline::Block { half } => {
                block(&[0.0; 3], &[1.0, 0.0, 0.0, 0.0], half).iter().map(place).collect()
            }
            Outline::Spider => Vec::new(),
        }
    }

    /// \[m\] how long a body is, along the axis of the world along which it is longest; `None` of a
    /// spider.
    #[must_use]
    pub fn size(&self, row: usize) -> Option<f64> {
        let mut bounds = Bounds::default();
        let corners = self.corners(row);
        corners.iter().for_each(|corner| bounds.add(*corner));
        (!corners.is_empty()).then(|| bounds.longest())
    }

    /// Whether a body is the spider of a universal joint.
    #[must_use]
    pub fn is_spider(&self, row: usize) -> bool {
        self.bodies.get(row).is_some_and(|body| body.outline == Outline::Spider)
    }
}

/// The smallest box along the world's axes about points.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(crate) struct Bounds {
    low: Vec3<f64>,
    high: Vec3<f64>,
}

impl Default for Bounds {
    fn default() -> Self {
        let all = |value| Vec3::new(value, value, value);
        Self { low: all(f64::INFINITY), high: all(f64::NEG_INFINITY) }
    }
}

impl Bounds {
    pub(crate) fn add(&mut self, point: Vec3<f64>) {
        let each = |a: Vec3<f64>, b: Vec3<f64>, f: fn(f64, f64) -> f64| {
            Vec3::new(f(a.x, b.x), f(a.y, b.y), f(a.z, b.z))
        };
        self.low = each(self.low, point, f64::min);
        self.high = each(self.high, point, f64::max);
    }

    /// \[m\] its longest side; 0 where there is no point.
    pub(crate) fn longest(&self) -> f64 {
        let sides = (self.high - self.low).to_f64();
        sides.into_iter().fold(0.0, f64::max)
    }

    /// \[m\] its first two sides.
    pub(crate) fn sides(&self) -> (f64, f64) {
        let sides = self.high - self.low;
        (sides.x.max(0.0), sides.y.max(0.0))
    }

    /// Its middle; the origin where there is no point.
    pub(crate) fn middle(&self) -> Vec3<f64> {
        let middle = self.low * 0.5 + self.high * 0.5;
        if middle.is_finite() { middle } else { Vec3::ZERO }
    }
}

/// \[m\].
pub(super) fn length(vector: Vec3<f64>) -> f64 {
    libm::sqrt(vector.dot(vector))
}
