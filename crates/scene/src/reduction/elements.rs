//! The elements of a group in a plane.
//!
//! `(model, plane, group) => elements in the plane's axes, directions in which they act; whether in-plane motion stays
//! in the plane`. It does where the group's stiffness at rest does not couple the three in-plane degrees of freedom
//! with the three others. Dampers are checked only where there are no springs: those of a guide act on points off its
//! lines, across the directions of its springs.

use dbd_kernel::model::{Group, Law};
use dbd_kernel::{BodyIndex, BodyState, F64, Vec3};

use crate::direction::unit;
use crate::planar::Plane;
use crate::runtime::SceneModel;

/// The bodies of a scene in a plane.
pub(super) struct Placed<'p> {
    pub(super) model: &'p SceneModel<F64>,
    pub(super) plane: &'p Plane,
    /// Their states in the plane.
    pub(super) states: &'p [BodyState<F64>],
}

impl Placed<'_> {
    /// The position of a point of a body in the plane, given in its axes there.
    pub(super) fn place(&self, body: BodyIndex, point: Vec3<f64>) -> Vec3<f64> {
        match self.states.get(body.row()) {
            Some(state) => state.position + state.orientation.rotation().to_world(point),
            None => point,
        }
    }

    /// The elements of a group.
    pub(super) fn elements(&self, group: &Group) -> Vec<Element> {
        (0..group.elements()).filter_map(|i| self.element(group, i)).collect()
    }

    fn element(&self, group: &Group, i: usize) -> Option<Element> {
        let model = self.model;
        let arms = usize::from(group.arms);
        let tip = usize::from(group.triples) + if group.shared { i % arms } else { i };
        let point = |offset| model.points.get(usize::from(group.point) + offset).copied();
        let centre = self.plane.point_inward(group.a.row(), point(i / arms)?);
        let tip = self.plane.point_inward(group.b.row(), point(tip)?);
        let row = usize::from(group.element) + i;
        let (stiffness, free_length, line) = match group.law {
            Law::Tsda => model.tsdas.get(row).map(|e| (e.stiffness, e.free_length, None))?,
            Law::PointBushing => model.bushings.get(row).map(|e| (e.stiffness, 0.0, None))?,
            // In the plane each reduces to its point.
            Law::Revolute => model.revolutes.get(row).map(|e| (e.stiffness, 0.0, None))?,
            Law::Universal => model.universals.get(row).map(|e| (e.stiffness, 0.0, None))?,
            Law::PointOnLine => {
                let line = model.lines.get(row)?;
                let along = self.plane.of_body_inward(group.a.row(), line.direction);
                let along = match self.states.get(group.a.row()) {
                    Some(state) => state.orientation.rotation().to_world(along),
                    None => along,
                };
                (line.stiffness, line.free_length, Some(along))
            }
        };
        let damping = group.damper.row().and_then(|first| model.dampers.get(first + i));
        Some(Element {
            from: self.place(group.a, centre),
            to: self.place(group.b, tip),
            centre,
            tip,
            line,
            stiffness,
            damping: damping.copied().unwrap_or(0.0),
            free_length,
        })
    }
}

/// An element at rest, in the plane's axes; z is the distance from the plane.
#[derive(Clone, Copy, Debug)]
pub(super) struct Element {
    /// \[m\] its first point, or one of its line.
    pub(super) from: Vec3<f64>,
    /// \[m\] its second point.
    pub(super) to: Vec3<f64>,
    /// \[m\] the first point in the axes of its body in the plane.
    pub(super) centre: Vec3<f64>,
    /// \[m\] the second likewise.
    pub(super) tip: Vec3<f64>,
    /// The direction of its line, for a point on a line.
    pub(super) line: Option<Vec3<f64>>,
    /// \[N/m\].
    pub(super) stiffness: f64,
    /// \[N·s/m\].
    pub(super) damping: f64,
    /// \[m\].
    pub(super) free_length: f64,
}

impl Element {
    /// From its first point, or the foot on its line, to its second.
    pub(super) fn deformation(&self) -> Vec3<f64> {
        let d = self.to - self.from;
        match self.line {
            Some(line) => d - line * d.dot(line),
            None => d,
        }
    }

    /// Its direction; `None` without free length or direction.
    pub(super) fn direction(&self) -> Option<Vec3<f64>> {
        if self.free_length == 0.0 { None } else { unit(self.deformation()) }
    }

    /// Whether it lies in the plane within `near` \[m\].
    pub(super) fn is_flat(&self, near: f64) -> bool {
        self.from.z.abs() <= near && self.to.z.abs() <= near
    }

    /// Equivalent springs and dampers along unit directions: (direction, N/m, N·s/m).
    fn acts(&self) -> Vec<(Vec3<f64>, f64, f64)> {
        let (k, c) = (self.stiffness, self.damping);
        match (self.line, self.direction()) {
            (None, Some(along)) => vec![(along, k, c)],
            (None, None) => Vec3::axes().map(|axis| (axis, k, c)).to_vec(),
            (Some(line), Some(across)) => vec![(across, k, c), (line.cross(across), 0.0, c)],
            (Some(line), None) => line.normals().map(|normal| (normal, k, c)).to_vec(),
        }
    }
}

/// Coupling of a group with a plane.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(super) struct Coupling {
    /// \[m\] distance of the centre of its in-plane stiffness from the plane.
    pub(super) height: f64,
    /// \[1\] largest ratio of an out-of-plane force or torque (over the size of the group) to the in-plane force that
    /// accompanies it.
    pub(super) share: f64,
}

/// The coupling of a group's in-plane and out-of-plane forces; points within `near` \[m\] coincide.
pub(super) fn coupling(elements: &[Element], near: f64) -> Coupling {
    let count = elements.len().max(1) as f64;
    let middle = elements.iter().fold(Vec3::ZERO, |sum, e| sum + e.to) * (1.0 / count);
    let middle = Vec3::new(middle.x, middle.y, 0.0);
    let size = elements.iter().map(|e| e.to - middle).map(|r| libm::sqrt(r.dot(r)));
    let size = size.fold(0.0, f64::max);
    // Coincident points have no lever arms; the remainder is rounding.
    let inverse = if size > near { 1.0 / size } else { 0.0 };
    let of = |strength: fn(&(Vec3<f64>, f64, f64)) -> f64| {
        let mut block = [[0.0_f64; 3]; 3];
        let (mut whole, mut moment) = (0.0, 0.0);
        for element in elements {
            let arm = (element.to - middle) * inverse;
            for act in element.acts() {
                let (u, strength) = (act.0, strength(&act));
                let turn = arm.cross(u);
                let (within, beyond) = ([u.x, u.y, turn.z], [u.z, turn.x, turn.y]);
                let in_plane = strength * (u.x * u.x + u.y * u.y);
                whole += in_plane;
                moment += in_plane * element.to.z;
                for (row, a) in block.iter_mut().zip(within) {
                    for (entry, b) in row.iter_mut().zip(beyond) {
                        *entry += strength * a * b;
                    }
                }
            }
        }
        let most = block.as_flattened().iter().fold(0.0_f64, |most, x| most.max(x.abs()));
        (whole > 0.0).then(|| Coupling { height: moment / whole, share: most / whole })
    };
    let none = Coupling { height: 0.0, share: 0.0 };
    of(|act| act.1).or_else(|| of(|act| act.2)).unwrap_or(none)
}
