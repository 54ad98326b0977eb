//! One instant: positions and velocities of bodies and their points, and wrenches.
//!
//! `(state, time, signals) => poses; point => position, arm, velocity in the world`.

use dbd_kernel::LoadFrame;
use nalgebra::{Matrix3, UnitQuaternion, Vector3};

use crate::reference::signals::{Clock, Signal};
use crate::reference::state::{BodyState, State};

/// Mass and principal inertia of a body.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Body {
    /// \[kg\].
    pub mass: f64,
    /// \[kg·m²\] body axes.
    pub inertia: Vector3<f64>,
    /// Whether no force moves it.
    pub driven: bool,
}

/// Force and torque on a body, world axes.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub struct Wrench {
    /// \[N\].
    pub force: Vector3<f64>,
    /// \[N·m\] about the centre of mass.
    pub torque: Vector3<f64>,
}

/// An attachment of an element.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum End {
    /// The ground.
    World,
    /// The ground as an input moves it.
    Anchor(usize),
    /// A body.
    Body(usize),
}

/// A point of a body in its axes, or of the ground.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Point {
    /// Whose point it is.
    pub end: End,
    /// \[m\].
    pub local: Vector3<f64>,
}

/// A point at an instant.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Placed {
    /// Whose point it is.
    pub end: End,
    /// \[m\] world.
    pub position: Vector3<f64>,
    /// \[m\] from the centre of mass, world axes.
    pub arm: Vector3<f64>,
    /// \[m/s\] world.
    pub velocity: Vector3<f64>,
}

/// Pose and motion of all bodies at a time.
pub struct Instant<'s> {
    /// The time.
    pub clock: Clock,
    /// The inputs' signals.
    pub signals: Vec<Signal>,
    /// \[rad\] last known torsion angles.
    pub torsion_angles: &'s [f64],
    state: &'s State,
    poses: Vec<Pose>,
    anchors: &'s [Vector3<f64>],
}

struct Pose {
    rotation: Matrix3<f64>,
    spin: Vector3<f64>,
}

impl<'s> Instant<'s> {
    /// The poses of a state, with the inputs' signals and the directions of their anchors.
    pub(crate) fn new(
        state: &'s State,
        clock: Clock,
        signals: Vec<Signal>,
        anchors: &'s [Vector3<f64>],
    ) -> Self {
        let pose = |body: &BodyState| {
            let rotation = body.orientation.to_rotation_matrix().into_inner();
            Pose { rotation, spin: rotation * body.rate }
        };
        let poses = state.bodies.iter().map(pose).collect();
        Self { clock, signals, torsion_angles: &state.torsion_angles, state, poses, anchors }
    }

    /// \[rad/s\] the angular velocity of a body, body axes.
    #[must_use]
    pub fn rate(&self, row: usize) -> Vector3<f64> {
        self.state.bodies[row].rate
    }

    /// A point in the world, with its motion.
    #[must_use]
    pub fn place(&self, point: &Point) -> Placed {
        match point.end {
            End::Body(row) => {
                let arm = self.poses[row].rotation * point.local;
                self.at_arm(point.end, row, arm)
            }
            End::Anchor(input) => {
                let moved = self.anchors[input] * self.signals[input].value;
                self.material(point.end, point.local + moved)
            }
            End::World => self.material(point.end, point.local),
        }
    }

    /// The material point of an end that is at `position` \[m\].
    #[must_use]
    pub fn material(&self, end: End, position: Vector3<f64>) -> Placed {
        match end {
            End::Body(row) => self.at_arm(end, row, position - self.state.bodies[row].position),
            End::Anchor(input) => {
                let velocity = self.anchors[input] * self.signals[input].rate;
                Placed { end, position, arm: Vector3::zeros(), velocity }
            }
            End::World => {
                Placed { end, position, arm: Vector3::zeros(), velocity: Vector3::zeros() }
            }
        }
    }

    fn at_arm(&self, end: End, row: usize, arm: Vector3<f64>) -> Placed {
        let body = &self.state.bodies[row];
        let velocity = body.velocity + self.poses[row].spin.cross(&arm);
        Placed { end, position: body.position + arm, arm, velocity }
    }

    /// Axes of an end to world axes.
    #[must_use]
    pub fn to_world(&self, end: End, v: Vector3<f64>) -> Vector3<f64> {
        match end {
            End::Body(row) => self.poses[row].rotation * v,
            End::World | End::Anchor(_) => v,
        }
    }

    /// A vector given in world or body axes, in world axes.
    #[must_use]
    pub fn turned(&self, end: End, frame: LoadFrame, v: Vector3<f64>) -> Vector3<f64> {
        match frame {
            LoadFrame::World => v,
            LoadFrame::Body => self.to_world(end, v),
        }
    }

    /// The orientation of an end.
    #[must_use]
    pub fn orientation(&self, end: End) -> UnitQuaternion<f64> {
        match end {
            End::Body(row) => self.state.bodies[row].orientation,
            End::World | End::Anchor(_) => UnitQuaternion::identity(),
        }
    }

    /// \[rad/s\] the angular velocity of an end, world axes.
    #[must_use]
    pub fn spin(&self, end: End) -> Vector3<f64> {
        match end {
            End::Body(row) => self.poses[row].spin,
            End::World | End::Anchor(_) => Vector3::zeros(),
        }
    }

    /// World axes to the axes of a body.
    #[must_use]
    pub fn to_body(&self, row: usize, v: Vector3<f64>) -> Vector3<f64> {
        self.poses[row].rotation.tr_mul(&v)
    }
}
