//! Lengths of elements at the initial pose and their rates.
//!
//! `scene => per group its free length, its shortest and longest element, the largest rate`. Points and velocities
//! are computed as in the kernel.

use dbd_kernel::model::{Group, Law};
use dbd_kernel::{BodyIndex, F64, Geometry, Vec3};

use crate::facts::pose::frames;
use crate::scene::Scene;

/// Lengths of the elements of one or several groups.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(crate) struct GroupFacts {
    /// \[m\] free length, the largest where groups differ.
    pub(crate) free_length: f64,
    /// \[m\] the shortest element.
    pub(crate) shortest: f64,
    /// \[m\] the longest element.
    pub(crate) longest: f64,
    /// \[m/s\] the largest rate of a length.
    pub(crate) stretching_rate: f64,
}

impl GroupFacts {
    /// Lengths of no element.
    pub(super) const NONE: Self =
        Self { free_length: 0.0, shortest: f64::INFINITY, longest: 0.0, stretching_rate: 0.0 };

    /// The union of two.
    pub(super) fn with(&self, other: &Self) -> Self {
        Self {
            free_length: self.free_length.max(other.free_length),
            shortest: self.shortest.min(other.shortest),
            longest: self.longest.max(other.longest),
            stretching_rate: self.stretching_rate.max(other.stretching_rate),
        }
    }
}

/// Lengths of each group.
pub(super) fn groups(scene: &Scene) -> Vec<GroupFacts> {
    let frames = frames(scene);
    scene.model.groups.iter().map(|group| facts_of(scene, &frames, group)).collect()
}

/// The points of element `i` of a group in the axes of their bodies.
pub(super) fn points(scene: &Scene, group: &Group, i: usize) -> [Vec3<f64>; 2] {
    let (triples, arms) = (usize::from(group.triples), usize::from(group.arms));
    let points = &scene.model.points[usize::from(group.point)..];
    [points[i / arms], points[triples + if group.shared { i % arms } else { i }]]
}

/// The part of the displacement between the points of element `i` along which it acts, world axes: for a point on a
/// line the part normal to the line. `a` is the group's first end.
pub(super) fn along(
    scene: &Scene,
    group: &Group,
    i: usize,
    a: &End<'_>,
    displacement: Vec3<f64>,
) -> Vec3<f64> {
    if group.law != Law::PointOnLine {
        return displacement;
    }
    let line = &scene.model.lines[usize::from(group.element) + i];
    let n = a.to_world(line.direction);
    displacement - n * displacement.dot(n)
}

/// Whether the elements of a group have zero length and act in every direction.
pub(super) fn is_bushing(group: &Group) -> bool {
    matches!(group.law, Law::PointBushing | Law::Revolute | Law::Universal)
}

/// \[m\] Axes of the rotations of its second body that a joint of bushings resists, world, with the lever arm as
/// length.
pub(super) fn held_turns(scene: &Scene, group: &Group, a: &End<'_>, b: &End<'_>) -> Vec<Vec3<f64>> {
    let row = usize::from(group.element);
    match group.law {
        Law::Revolute => {
            let lever = a.to_world(scene.model.revolutes[row].levers[0]);
            let axis = crate::direction::unit(lever);
            axis.map_or(Vec::new(), |axis| axis.normals().map(|n| lever.cross(n)).to_vec())
        }
        Law::Universal => {
            let universal = &scene.model.universals[row];
            vec![b.to_world(universal.axis).cross(a.to_world(universal.lever))]
        }
        _ => Vec::new(),
    }
}

fn facts_of(scene: &Scene, frames: &[<F64 as Geometry>::Frame], group: &Group) -> GroupFacts {
    let element = usize::from(group.element);
    let a = End { scene, frames, body: group.a };
    let b = End { scene, frames, body: group.b };
    let mut all = GroupFacts::NONE;
    for i in 0..group.elements() {
        let [centre, tip] = points(scene, group, i);
        let (centre, tip) = (a.place(centre), b.place(tip));
        let d = tip - centre;
        let (free_length, d, rate) = match group.law {
            Law::Tsda => (
                scene.model.tsdas[element + i].free_length,
                d,
                b.velocity(tip) - a.velocity(centre),
            ),
            Law::PointBushing | Law::Revolute | Law::Universal => {
                (0.0, d, b.velocity(tip) - a.velocity(centre))
            }
            Law::PointOnLine => {
                let line = &scene.model.lines[element + i];
                let n = a.to_world(line.direction);
                let deflection = along(scene, group, i, &a, d);
                let rate = b.velocity(tip) - a.velocity(tip - deflection);
                (line.free_length, deflection, rate - n * rate.dot(n))
            }
        };
        let length = libm::sqrt(d.dot(d));
        // At zero free length or zero length every direction counts.
        let rate = if free_length > 0.0 && length > 0.0 {
            (d.dot(rate) / length).abs()
        } else {
            libm::sqrt(rate.dot(rate))
        };
        all = all.with(&GroupFacts {
            free_length,
            shortest: length,
            longest: length,
            stretching_rate: rate,
        });
    }
    for turn in held_turns(scene, group, &a, &b) {
        let rate = turn.dot(b.spin() - a.spin()).abs();
        all.stretching_rate = all.stretching_rate.max(rate);
    }
    all
}

/// One body of a group, or the world.
pub(super) struct End<'s> {
    pub(super) scene: &'s Scene,
    pub(super) frames: &'s [<F64 as Geometry>::Frame],
    pub(super) body: BodyIndex,
}

impl End<'_> {
    pub(super) fn place(&self, point: Vec3<f64>) -> Vec3<f64> {
        match self.frames.get(self.body.row()) {
            Some(frame) => F64::place(frame, &point).0,
            None => F64::ground(&point),
        }
    }

    /// A world point relative to the centre of mass of this end.
    pub(super) fn to_local(&self, point_w: Vec3<f64>) -> Vec3<f64> {
        match self.scene.model.initial.get(self.body.row()) {
            Some(state) => self.to_body(point_w - state.position),
            None => point_w,
        }
    }

    pub(super) fn to_body(&self, vector: Vec3<f64>) -> Vec3<f64> {
        match self.frames.get(self.body.row()) {
            Some(frame) => F64::to_body(frame, vector),
            None => vector,
        }
    }

    pub(super) fn to_world(&self, vector: Vec3<f64>) -> Vec3<f64> {
        match self.frames.get(self.body.row()) {
            Some(frame) => F64::to_world(frame, vector),
            None => vector,
        }
    }

    /// \[rad/s\] world.
    fn spin(&self) -> Vec3<f64> {
        let state = self.scene.model.initial.get(self.body.row());
        state.map_or(Vec3::ZERO, |state| self.to_world(state.angular_velocity))
    }

    /// `v + ω × r` at a world point.
    fn velocity(&self, point_w: Vec3<f64>) -> Vec3<f64> {
        match self.scene.model.initial.get(self.body.row()) {
            Some(state) => {
                let spin = self.to_world(state.angular_velocity);
                state.velocity + spin.cross(point_w - state.position)
            }
            None => Vec3::ZERO,
        }
    }
}
