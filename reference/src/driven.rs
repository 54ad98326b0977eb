//! What drives a mechanism from outside: loads and inputs.
//!
//! `(instant: windows, signals) => wrenches on bodies`.

use dbd_kernel::LoadFrame;
use nalgebra::Vector3;

use crate::elements::{Element, Pair, push, turn};
use crate::instant::{End, Instant, Point, Wrench};

/// A constant force and torque over a window of time.
pub struct Load {
    /// The body.
    pub end: End,
    /// The axes of both.
    pub frame: LoadFrame,
    /// \[N\] at the centre of mass.
    pub force: Vector3<f64>,
    /// \[N·m\].
    pub torque: Vector3<f64>,
    /// \[s\] start and end, the end excluded.
    pub window: [f64; 2],
}

impl Element for Load {
    fn act(&self, at: &Instant<'_>, wrenches: &mut [Wrench]) {
        let End::Body(row) = self.end else { return };
        if at.clock.within(self.window[0], self.window[1]) {
            wrenches[row].force += at.turned(self.end, self.frame, self.force);
            wrenches[row].torque += at.turned(self.end, self.frame, self.torque);
        }
    }
}

/// An input that pushes.
pub struct Input {
    /// Its place among the mechanism's inputs.
    pub row: usize,
    /// What it does.
    pub kind: InputKind,
}

/// What an input does with its signal.
pub enum InputKind {
    /// A force along a direction at a point.
    Force(Point, Vector3<f64>, LoadFrame),
    /// A torque about an axis.
    Torque(End, Vector3<f64>, LoadFrame),
    /// A torque on the second along the gradient of its turn about an axis, in the axes of each, on the
    /// first the opposite.
    JointTorque([End; 2], [Vector3<f64>; 2]),
    /// A tension between two points.
    Actuator(Pair),
}

impl Element for Input {
    fn act(&self, at: &Instant<'_>, wrenches: &mut [Wrench]) {
        let value = at.signals[self.row].value;
        match &self.kind {
            InputKind::Force(point, direction, frame) => {
                let force = at.turned(point.end, *frame, *direction) * value;
                push(wrenches, &at.place(point), force);
            }
            InputKind::Torque(end, axis, frame) => {
                turn(wrenches, *end, at.turned(*end, *frame, *axis) * value);
            }
            InputKind::JointTorque([a, b], axes) => {
                // Half way between the two axes, with the length that the swing between them asks for.
                let [first, second] = [at.to_world(*a, axes[0]), at.to_world(*b, axes[1])];
                let half = 0.5 * first.angle(&second);
                let torque = (first + second).normalize() * (value / half.cos());
                turn(wrenches, *a, -torque);
                turn(wrenches, *b, torque);
            }
            InputKind::Actuator(pair) => {
                let stretch = pair.at(at);
                let along = stretch.displacement.try_normalize(0.0).unwrap_or_default();
                stretch.pull(along * value, wrenches);
            }
        }
    }
}
