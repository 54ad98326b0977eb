//! The elements of a plain loop.
//!
//! `bodies => forces and torques on them`. Dampers act as forces at the present velocities.

use std::f64::consts::TAU;

use crate::vectors::{
    Quaternion, Vector, cross, difference, dot, inverse, product, scaled, sum, turned,
};

use super::body::Body;

/// What an element holds on to: a body's row, or the ground.
pub type End = Option<usize>;

/// How a spring pulls.
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum Deformation {
    /// Along the line between its points, beyond its free length \[m\].
    Length(f64),
    /// In every direction.
    Anywhere,
    /// Across a line of the first body with this unit direction, its axes, beyond a free distance \[m\].
    Across(Vector, f64),
}

/// A spring and damper between two points.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Spring {
    /// First and second body.
    pub ends: [End; 2],
    /// \[m\] its points in their axes.
    pub points: [Vector; 2],
    /// How it pulls.
    pub deformation: Deformation,
    /// \[N/m\].
    pub stiffness: f64,
    /// \[N·s/m\].
    pub damping: f64,
}

/// A point in the world: position, arm from the centre of mass.
type Placed = (Vector, Vector);

fn place(bodies: &[Body], end: End, point: Vector) -> Placed {
    match end {
        Some(row) => {
            let arm = turned(&bodies[row].rotation, point);
            (sum(bodies[row].position, arm), arm)
        }
        None => (point, [0.0; 3]),
    }
}

fn velocity(bodies: &[Body], end: End, arm: Vector) -> Vector {
    match end {
        Some(row) => sum(bodies[row].velocity, cross(bodies[row].spin, arm)),
        None => [0.0; 3],
    }
}

fn push(bodies: &mut [Body], end: End, arm: Vector, force: Vector) {
    if let Some(row) = end {
        let body = &mut bodies[row];
        body.force = sum(body.force, force);
        body.torque = sum(body.torque, cross(arm, force));
    }
}

impl Spring {
    /// Adds what it does to the bodies.
    pub(super) fn pull(&self, bodies: &mut [Body]) {
        let [a, b] = self.ends;
        let (from, mut arm_a) = place(bodies, a, self.points[0]);
        let (to, arm_b) = place(bodies, b, self.points[1]);
        let mut away = difference(to, from);
        let mut line = None;
        if let Deformation::Across(direction, _) = self.deformation {
            let direction = a.map_or(direction, |row| turned(&bodies[row].rotation, direction));
            let slide = scaled(direction, dot(away, direction));
            away = difference(away, slide);
            if a.is_some() {
                arm_a = sum(arm_a, slide);
            }
            line = Some(direction);
        }
        let mut rate = [0.0; 3];
        if self.damping != 0.0 {
            rate = difference(velocity(bodies, b, arm_b), velocity(bodies, a, arm_a));
            if let Some(line) = line {
                rate = difference(rate, scaled(line, dot(rate, line)));
            }
        }
        let force = match self.deformation {
            Deformation::Length(free) => {
                let length = dot(away, away).sqrt();
                if length == 0.0 {
                    return;
                }
                let along = scaled(away, 1.0 / length);
                let tension = self.stiffness * (length - free) + self.damping * dot(along, rate);
                scaled(along, tension)
            }
            Deformation::Across(_, free) if free != 0.0 => {
                let length = dot(away, away).sqrt();
                if length == 0.0 {
                    return;
                }
                let pull = scaled(away, self.stiffness * (length - free) / length);
                sum(pull, scaled(rate, self.damping))
            }
            Deformation::Anywhere | Deformation::Across(..) => {
                sum(scaled(away, self.stiffness), scaled(rate, self.damping))
            }
        };
        push(bodies, a, arm_a, force);
        push(bodies, b, arm_b, scaled(force, -1.0));
    }
}

/// A torsion spring about an axis of its first body.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Torsion {
    /// First and second body.
    pub ends: [End; 2],
    /// Unit axis, the first body's axes.
    pub axis: Vector,
    /// Inverse of the second body's orientation in the first at t = 0.
    pub reference: Quaternion,
    /// \[N·m/rad\].
    pub stiffness: f64,
    /// \[N·m·s/rad\].
    pub damping: f64,
    /// \[N·m\] torque on the second body at twist 0.
    pub preload: f64,
    /// \[rad\] the last known twist.
    pub torsion_angle: f64,
}

impl Torsion {
    /// Adds what it does to the bodies; its twist is on the winding nearest the last known.
    pub(super) fn turn(&mut self, bodies: &mut [Body]) {
        let orientation =
            |end: End| end.map_or([1.0, 0.0, 0.0, 0.0], |row| bodies[row].orientation);
        let spin = |end: End| end.map_or([0.0; 3], |row| bodies[row].spin);
        let [a, b] = self.ends;
        let relative = product(inverse(orientation(a)), orientation(b));
        let [w, x, y, z] = product(relative, self.reference);
        let v = [x, y, z];
        let s = dot(v, self.axis);
        let principal = 2.0 * s.atan2(w);
        self.torsion_angle = principal + TAU * ((self.torsion_angle - principal) / TAU).round();
        let along =
            sum(sum(scaled(self.axis, w * w), scaled(cross(v, self.axis), w)), scaled(v, s));
        let gradient = scaled(along, 1.0 / (w * w + s * s));
        let gradient = a.map_or(gradient, |row| turned(&bodies[row].rotation, gradient));
        let rate = dot(gradient, difference(spin(b), spin(a)));
        let torque = self.preload - self.stiffness * self.torsion_angle - self.damping * rate;
        for (end, torque) in [(a, -torque), (b, torque)] {
            if let Some(row) = end {
                bodies[row].torque = sum(bodies[row].torque, scaled(gradient, torque));
            }
        }
    }
}
