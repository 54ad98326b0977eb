//! Elements as a std user writes them: one object each, a trait between them and the mechanism.
//!
//! `(instant) => wrenches on bodies`, forces and torques in world axes, and for implicit methods
//! the springs and dampers that its tangent is made of.

use std::f64::consts::TAU;

use nalgebra::{Quaternion, UnitQuaternion, Vector3};

use crate::reference::instant::{End, Instant, Placed, Point, Wrench};

/// Whatever pushes bodies.
pub trait Element: Send + Sync {
    /// Adds its wrenches to the bodies.
    fn act(&self, at: &Instant<'_>, wrenches: &mut [Wrench]);

    /// The ends that its springs join, `None` where it has none.
    fn between(&self) -> Option<[End; 2]> {
        None
    }

    /// Visits its linear springs at this instant, unloaded: the geometric stiffness is omitted, so that the sum is
    /// positive semidefinite.
    fn springs(&self, at: &Instant<'_>, visit: &mut dyn FnMut(Spring)) {
        let _ = (at, visit);
    }
}

/// A spring and damper of one direction between two bodies.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Spring {
    /// First and second body.
    pub ends: [End; 2],
    /// Unit direction, world axes; 0 if it only rotates.
    pub direction: Vector3<f64>,
    /// Lever arm × direction of either end, or the axis of a rotation, world axes.
    pub moments: [Vector3<f64>; 2],
    /// \[m/s, rad/s\] the rate at which it lengthens.
    pub rate: f64,
    /// \[N/m, N·m/rad\].
    pub stiffness: f64,
    /// \[N·s/m, N·m·s/rad\].
    pub damping: f64,
}

/// Two points, the second one perhaps on a line through the first.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Pair {
    /// First attachment point.
    pub a: Point,
    /// Second attachment point.
    pub b: Point,
    /// Unit direction of a line of the first body, its axes.
    pub line: Option<Vector3<f64>>,
}

/// A pair at an instant.
pub(crate) struct Deformation {
    a: Placed,
    b: Placed,
    pub(crate) displacement: Vector3<f64>,
    rate: Vector3<f64>,
    line: Option<Vector3<f64>>,
}

impl Pair {
    fn ends(&self) -> [End; 2] {
        [self.a.end, self.b.end]
    }

    pub(crate) fn at(&self, at: &Instant<'_>) -> Deformation {
        let (mut a, b) = (at.place(&self.a), at.place(&self.b));
        let line = self.line.map(|line| at.to_world(a.end, line));
        if let Some(line) = line {
            let slide = line * line.dot(&(b.position - a.position));
            a = at.material(a.end, a.position + slide);
        }
        let (displacement, rate) = (b.position - a.position, b.velocity - a.velocity);
        let rate = line.map_or(rate, |line| rate - line * line.dot(&rate));
        Deformation { a, b, displacement, rate, line }
    }
}

impl Deformation {
    /// Pulls the ends towards each other with `force` on the first.
    pub(crate) fn pull(&self, force: Vector3<f64>, wrenches: &mut [Wrench]) {
        push(wrenches, &self.a, force);
        push(wrenches, &self.b, -force);
    }

    fn spring(&self, direction: Vector3<f64>, stiffness: f64, damping: f64) -> Spring {
        Spring {
            ends: [self.a.end, self.b.end],
            direction,
            moments: [self.a.arm.cross(&direction), self.b.arm.cross(&direction)],
            rate: direction.dot(&(self.b.velocity - self.a.velocity)),
            stiffness,
            damping,
        }
    }
}

pub(crate) fn push(wrenches: &mut [Wrench], at: &Placed, force: Vector3<f64>) {
    if let End::Body(row) = at.end {
        wrenches[row].force += force;
        wrenches[row].torque += at.arm.cross(&force);
    }
}

pub(crate) fn turn(wrenches: &mut [Wrench], end: End, torque: Vector3<f64>) {
    if let End::Body(row) = end {
        wrenches[row].torque += torque;
    }
}

/// Stiffness, damping, free length and clearance of an element.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Law {
    /// \[N/m\].
    pub stiffness: f64,
    /// \[N·s/m\].
    pub damping: f64,
    /// \[m\].
    pub free_length: f64,
    /// \[m\] the dead band, where there is one.
    pub clearance: Option<f64>,
}

impl Law {
    /// \[m\] the extension of a length beyond free length and clearance, and the damping there,
    /// which grows over the first clearance beyond the edge; `None` within the band.
    fn engaged(&self, length: f64) -> Option<(f64, f64)> {
        let extension = length - self.free_length;
        let Some(band) = self.clearance else { return Some((extension, self.damping)) };
        let excess = extension.abs() - band;
        (excess > 0.0).then(|| {
            let share = if excess < band { excess / band } else { 1.0 };
            (excess.copysign(extension), share * self.damping)
        })
    }
}

/// A translational spring-damper with a free length.
pub struct Tsda {
    /// Its points.
    pub pair: Pair,
    /// Its constants.
    pub law: Law,
}

impl Element for Tsda {
    fn act(&self, at: &Instant<'_>, wrenches: &mut [Wrench]) {
        let deformation = self.pair.at(at);
        let length = deformation.displacement.norm();
        let Some((extension, damping)) = self.law.engaged(length) else { return };
        if length > 0.0 {
            let along = deformation.displacement / length;
            let damped = damping * along.dot(&deformation.rate);
            deformation.pull(along * (self.law.stiffness * extension + damped), wrenches);
        }
    }

    fn between(&self) -> Option<[End; 2]> {
        Some(self.pair.ends())
    }

    fn springs(&self, at: &Instant<'_>, visit: &mut dyn FnMut(Spring)) {
        let deformation = self.pair.at(at);
        let length = deformation.displacement.norm();
        let Some((_, damping)) = self.law.engaged(length) else { return };
        if length > 0.0 {
            let along = deformation.displacement / length;
            visit(deformation.spring(along, self.law.stiffness, damping));
        }
    }
}

/// A spring-damper without free length: the same in every direction.
pub struct PointBushing {
    /// Its points.
    pub pair: Pair,
    /// \[N/m\].
    pub stiffness: f64,
    /// \[N·s/m\].
    pub damping: f64,
}

impl Element for PointBushing {
    fn act(&self, at: &Instant<'_>, wrenches: &mut [Wrench]) {
        let deformation = self.pair.at(at);
        let force = deformation.displacement * self.stiffness + deformation.rate * self.damping;
        deformation.pull(force, wrenches);
    }

    fn between(&self) -> Option<[End; 2]> {
        Some(self.pair.ends())
    }

    fn springs(&self, at: &Instant<'_>, visit: &mut dyn FnMut(Spring)) {
        let deformation = self.pair.at(at);
        for axis in [Vector3::x(), Vector3::y(), Vector3::z()] {
            visit(deformation.spring(axis, self.stiffness, self.damping));
        }
    }
}

/// A revolute joint of bushings: a point, stiffer or softer along the axis than across it, and an axis of
/// either body in line with the other's.
pub struct Revolute {
    /// Its points.
    pub pair: Pair,
    /// \[m\] axis of each body in its own axes, as long as its lever.
    pub levers: [Vector3<f64>; 2],
    /// \[N/m\] across the axis.
    pub stiffness: f64,
    /// \[N·s/m\] across the axis.
    pub damping: f64,
    /// How many times as much of both there is along it.
    pub ratio: f64,
}

impl Revolute {
    /// It acts on the first body where the second's point is.
    fn at(&self, at: &Instant<'_>) -> Deformation {
        let (a, b) = (at.place(&self.pair.a), at.place(&self.pair.b));
        let displacement = b.position - a.position;
        let a = at.material(a.end, b.position);
        Deformation { rate: b.velocity - a.velocity, a, b, displacement, line: None }
    }

    fn levers(&self, at: &Instant<'_>) -> [Vector3<f64>; 2] {
        let ends = self.pair.ends();
        [0, 1].map(|end| at.to_world(ends[end], self.levers[end]))
    }

    /// Axis and normals in the world, each with its part of the constants.
    fn directions(&self, at: &Instant<'_>) -> [(Vector3<f64>, f64); 3] {
        let axis = self.levers(at)[0].normalize();
        let normal = axis.cross(&Vector3::ith(axis.iamin(), 1.0)).normalize();
        [(normal, 1.0), (axis.cross(&normal), 1.0), (axis, self.ratio)]
    }
}

impl Element for Revolute {
    fn act(&self, at: &Instant<'_>, wrenches: &mut [Wrench]) {
        let deformation = self.at(at);
        let pull = deformation.displacement * self.stiffness + deformation.rate * self.damping;
        let along = |(n, part): (Vector3<f64>, f64)| n * (part * n.dot(&pull));
        deformation.pull(self.directions(at).map(along).iter().sum(), wrenches);
        let [a, b] = self.levers(at);
        let ends = self.pair.ends();
        let spin = at.spin(ends[1]) - at.spin(ends[0]);
        let across = spin - a * (a.dot(&spin) / a.norm_squared());
        let torque = a.cross(&b) * self.stiffness + across * (self.damping * a.norm_squared());
        turn(wrenches, ends[0], torque);
        turn(wrenches, ends[1], -torque);
    }

    fn between(&self) -> Option<[End; 2]> {
        Some(self.pair.ends())
    }

    fn springs(&self, at: &Instant<'_>, visit: &mut dyn FnMut(Spring)) {
        let deformation = self.at(at);
        let directions = self.directions(at);
        for (direction, part) in directions {
            visit(deformation.spring(direction, part * self.stiffness, part * self.damping));
        }
        let ends = self.pair.ends();
        let spin = at.spin(ends[1]) - at.spin(ends[0]);
        let lever = self.levers(at)[0].norm();
        for (normal, _) in &directions[..2] {
            let about = normal * lever;
            visit(Spring {
                ends,
                direction: Vector3::zeros(),
                moments: [about; 2],
                rate: about.dot(&spin),
                stiffness: self.stiffness,
                damping: self.damping,
            });
        }
    }
}

/// A universal joint without a spider: a point bushing, and an axis of either body held perpendicular to the other's.
pub struct Universal {
    /// Its points.
    pub pair: Pair,
    /// \[m\] the first body's axis in its axes, as long as its lever.
    pub lever: Vector3<f64>,
    /// Unit axis of the second body in its axes.
    pub axis: Vector3<f64>,
    /// \[N/m\].
    pub stiffness: f64,
    /// \[N·s/m\].
    pub damping: f64,
}

impl Universal {
    /// \[m\] the axes' deviation from perpendicular, and its gradient for a rotation of the second body.
    fn axis_error(&self, at: &Instant<'_>) -> (f64, Vector3<f64>) {
        let lever = at.to_world(self.pair.a.end, self.lever);
        let axis = at.to_world(self.pair.b.end, self.axis);
        (lever.dot(&axis), axis.cross(&lever))
    }

    fn axis_error_rate(&self, at: &Instant<'_>, gradient: &Vector3<f64>) -> f64 {
        gradient.dot(&(at.spin(self.pair.b.end) - at.spin(self.pair.a.end)))
    }
}

impl Element for Universal {
    fn act(&self, at: &Instant<'_>, wrenches: &mut [Wrench]) {
        let deformation = self.pair.at(at);
        let force = deformation.displacement * self.stiffness + deformation.rate * self.damping;
        deformation.pull(force, wrenches);
        let (axis_error, gradient) = self.axis_error(at);
        let size = self.stiffness * axis_error + self.damping * self.axis_error_rate(at, &gradient);
        turn(wrenches, self.pair.a.end, gradient * size);
        turn(wrenches, self.pair.b.end, -gradient * size);
    }

    fn between(&self) -> Option<[End; 2]> {
        Some(self.pair.ends())
    }

    fn springs(&self, at: &Instant<'_>, visit: &mut dyn FnMut(Spring)) {
        let deformation = self.pair.at(at);
        for axis in [Vector3::x(), Vector3::y(), Vector3::z()] {
            visit(deformation.spring(axis, self.stiffness, self.damping));
        }
        let (_, gradient) = self.axis_error(at);
        visit(Spring {
            ends: self.pair.ends(),
            direction: Vector3::zeros(),
            moments: [gradient; 2],
            rate: self.axis_error_rate(at, &gradient),
            stiffness: self.stiffness,
            damping: self.damping,
        });
    }
}

/// A point of the second body held to a line of the first.
pub struct PointOnLine {
    /// Its points and the line.
    pub pair: Pair,
    /// Its constants.
    pub law: Law,
}

impl PointOnLine {
    fn is_isotropic(&self) -> bool {
        self.law.free_length == 0.0 && self.law.clearance.is_none()
    }
}

impl Element for PointOnLine {
    fn act(&self, at: &Instant<'_>, wrenches: &mut [Wrench]) {
        let deformation = self.pair.at(at);
        if self.is_isotropic() {
            let damped = deformation.rate * self.law.damping;
            deformation.pull(deformation.displacement * self.law.stiffness + damped, wrenches);
            return;
        }
        let length = deformation.displacement.norm();
        let Some((extension, damping)) = self.law.engaged(length) else { return };
        let along = deformation.displacement.try_normalize(0.0).unwrap_or_default();
        let damped = deformation.rate * damping;
        deformation.pull(along * (self.law.stiffness * extension) + damped, wrenches);
    }

    fn between(&self) -> Option<[End; 2]> {
        Some(self.pair.ends())
    }

    fn springs(&self, at: &Instant<'_>, visit: &mut dyn FnMut(Spring)) {
        let deformation = self.pair.at(at);
        let Some(line) = deformation.line else { return };
        let length = deformation.displacement.norm();
        let Some((_, damping)) = self.law.engaged(length) else { return };
        let normal = match deformation.displacement.try_normalize(0.0) {
            Some(along) if !self.is_isotropic() => along,
            _ => line.cross(&Vector3::ith(line.iamin(), 1.0)).normalize(),
        };
        let across = if self.is_isotropic() { self.law.stiffness } else { 0.0 };
        visit(deformation.spring(normal, self.law.stiffness, damping));
        visit(deformation.spring(line.cross(&normal), across, damping));
    }
}

/// A torsion spring about an axis of its first body.
pub struct TorsionSpring {
    /// First and second body.
    pub ends: [End; 2],
    /// Its index among the mechanism's torsion springs.
    pub row: usize,
    /// Unit axis in the first body's axes.
    pub axis: Vector3<f64>,
    /// Inverse of the second body's orientation in the first at t = 0.
    pub reference: UnitQuaternion<f64>,
    /// \[N·m/rad\].
    pub stiffness: f64,
    /// \[N·m·s/rad\].
    pub damping: f64,
    /// \[N·m\] torque on the second body at torsion angle 0.
    pub preload: f64,
}

/// A torsion angle at an instant.
pub struct TorsionAngle {
    /// \[rad\] since t = 0, including full revolutions.
    pub angle: f64,
    /// \[rad/s\].
    pub rate: f64,
    /// Gradient of the angle for a small rotation of the second body, world axes.
    gradient: Vector3<f64>,
}

impl TorsionSpring {
    /// The torsion angle: the swing–twist angle about the axis, on the revolution nearest to the last one.
    #[must_use]
    pub fn torsion_angle(&self, at: &Instant<'_>) -> TorsionAngle {
        let [a, b] = self.ends;
        let since = at.orientation(a).inverse() * at.orientation(b) * self.reference;
        let (w, v) = (since.w, since.imag());
        let s = v.dot(&self.axis);
        let principal = 2.0 * s.atan2(w);
        let angle = principal + TAU * ((at.torsion_angles[self.row] - principal) / TAU).round();
        let along = self.axis * (w * w) + v.cross(&self.axis) * w + v * s;
        let gradient = at.to_world(a, along / (w * w + s * s));
        TorsionAngle { angle, rate: gradient.dot(&(at.spin(b) - at.spin(a))), gradient }
    }
}

impl Element for TorsionSpring {
    fn act(&self, at: &Instant<'_>, wrenches: &mut [Wrench]) {
        let torsion_angle = self.torsion_angle(at);
        let torque =
            self.preload - self.stiffness * torsion_angle.angle - self.damping * torsion_angle.rate;
        turn(wrenches, self.ends[0], -torsion_angle.gradient * torque);
        turn(wrenches, self.ends[1], torsion_angle.gradient * torque);
    }

    fn between(&self) -> Option<[End; 2]> {
        Some(self.ends)
    }

    fn springs(&self, at: &Instant<'_>, visit: &mut dyn FnMut(Spring)) {
        let torsion_angle = self.torsion_angle(at);
        visit(Spring {
            ends: self.ends,
            direction: Vector3::zeros(),
            moments: [torsion_angle.gradient; 2],
            rate: torsion_angle.rate,
            stiffness: self.stiffness,
            damping: self.damping,
        });
    }
}

/// The unit quaternion of a kernel quaternion.
pub(crate) fn unit([w, x, y, z]: [f64; 4]) -> UnitQuaternion<f64> {
    UnitQuaternion::new_normalize(Quaternion::new(w, x, y, z))
}
