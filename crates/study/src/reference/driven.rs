//! External excitation of a mechanism: loads, inputs and tables over sensors.
//!
//! `(instant: windows, signals) => wrenches on bodies`.

use dbd_kernel::elements::input::Knot;
use dbd_kernel::elements::source::Sensor as KernelSensor;
use dbd_kernel::{F64, LoadFrame, TorsionIndex};
use nalgebra::Vector3;

use crate::reference::elements::{Element, Pair, TorsionSpring, push, turn};
use crate::reference::instant::{End, Instant, Point, Wrench};
use crate::reference::signals::at;

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

/// A table over a sensor's value, without a delay: the limit of a plant's small steps.
#[derive(Clone, Debug, PartialEq)]
pub struct Sensor {
    /// The input that it drives.
    pub row: usize,
    /// The sensor.
    pub sensor: KernelSensor<F64>,
    /// The direction of a vector's column.
    pub weights: [f64; 3],
    /// In the unit of the reading.
    pub offset: f64,
    /// Knots over the reading.
    pub curve: Vec<Knot<f64>>,
}

impl Sensor {
    /// The value of its input at an instant; `torsions` are the mechanism's.
    #[must_use]
    pub fn value(&self, instant: &Instant<'_>, torsions: &[TorsionSpring]) -> f64 {
        let place = |row: usize, local: [f64; 3]| {
            instant.place(&Point { end: End::Body(row), local: Vector3::from(local) })
        };
        let along = |v: Vector3<f64>| Vector3::from(self.weights).dot(&v);
        let torsion_angle = |spring: TorsionIndex| torsions[spring.row()].torsion_angle(instant);
        let reading = match self.sensor {
            KernelSensor::Angle { spring, offset } => torsion_angle(spring).angle + offset,
            KernelSensor::Rate { spring } => torsion_angle(spring).rate,
            KernelSensor::Point { body, point } => {
                along(place(body.row(), point.to_f64()).position)
            }
            KernelSensor::Velocity { body, point } => {
                along(place(body.row(), point.to_f64()).velocity)
            }
        };
        let reading = reading + self.offset;
        at(&self.curve, reading, reading).value
    }
}

/// An input that pushes.
pub struct Input {
    /// Its index among the mechanism's inputs.
    pub row: usize,
    /// Its effect.
    pub kind: InputKind,
}

/// Effect of an input.
pub enum InputKind {
    /// A force along a direction at a point.
    Force(Point, Vector3<f64>, LoadFrame),
    /// A torque about an axis.
    Torque(End, Vector3<f64>, LoadFrame),
    /// A torque on the second along the gradient of its rotation about an axis, in the axes of each, on the first the
    /// opposite.
    JointTorque([End; 2], [Vector3<f64>; 2]),
    /// A force on the second at its point along an axis of the first, on the first the opposite at the same point.
    JointForce(End, Point, Vector3<f64>),
    /// A tension between two points.
    Actuator(Pair),
    /// A field of gravity along a direction, on bodies of these masses \[kg\].
    Gravity(Vec<f64>, Vector3<f64>),
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
                // Midway between the two axes, with the length that follows from the swing between them.
                let [first, second] = [at.to_world(*a, axes[0]), at.to_world(*b, axes[1])];
                let half = 0.5 * first.angle(&second);
                let torque = (first + second).normalize() * (value / half.cos());
                turn(wrenches, *a, -torque);
                turn(wrenches, *b, torque);
            }
            InputKind::JointForce(first, point, axis) => {
                let force = at.to_world(*first, *axis) * value;
                let place = at.place(point);
                push(wrenches, &place, force);
                push(wrenches, &at.material(*first, place.position), -force);
            }
            InputKind::Actuator(pair) => {
                let deformation = pair.at(at);
                let along = deformation.displacement.try_normalize(0.0).unwrap_or_default();
                deformation.pull(along * value, wrenches);
            }
            InputKind::Gravity(masses, direction) => {
                for (wrench, mass) in wrenches.iter_mut().zip(masses) {
                    wrench.force += direction * (value * mass);
                }
            }
        }
    }
}
