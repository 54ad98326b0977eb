//! The state of a mechanism in nalgebra's types.
//!
//! `kernel state => state`. A torsion spring's revolution is stored as a number near its angle: here the last known
//! angle itself, in the kernel half revolutions.

use std::f64::consts::TAU;

use dbd_kernel::{BodyState as KernelBody, F64, ModelOwner, State as KernelState};
use nalgebra::{Quaternion, UnitQuaternion, Vector3};

/// A body's state.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct BodyState {
    /// \[m\] centre of mass, world.
    pub position: Vector3<f64>,
    /// Body → world.
    pub orientation: UnitQuaternion<f64>,
    /// \[m/s\] world.
    pub velocity: Vector3<f64>,
    /// \[rad/s\] body axes.
    pub rate: Vector3<f64>,
}

/// A mechanism's state.
#[derive(Clone, Debug, PartialEq)]
pub struct State {
    /// One per body.
    pub bodies: Vec<BodyState>,
    /// \[rad\] one per torsion spring, within half a revolution of its angle.
    pub torsion_angles: Vec<f64>,
}

impl BodyState {
    fn of(body: &KernelBody<F64>) -> Self {
        let [w, x, y, z] = body.orientation.to_f64();
        Self {
            position: Vector3::from(body.position.to_f64()),
            orientation: UnitQuaternion::new_normalize(Quaternion::new(w, x, y, z)),
            velocity: Vector3::from(body.velocity.to_f64()),
            rate: Vector3::from(body.angular_velocity.to_f64()),
        }
    }
}

impl State {
    /// A state of the kernel at a step's boundary, where revolution counts are valid.
    pub fn of<M: ModelOwner<Precision = F64>>(state: &KernelState<M>) -> Self {
        Self {
            bodies: state.bodies.as_ref().iter().map(BodyState::of).collect(),
            torsion_angles: state
                .turns
                .as_ref()
                .iter()
                .map(|turns| TAU * f64::from(*turns))
                .collect(),
        }
    }

    /// \[m\] the bodies' positions.
    #[must_use]
    pub fn positions(&self) -> Vec<Vector3<f64>> {
        self.bodies.iter().map(|body| body.position).collect()
    }

    /// Moves all bodies on by `time` \[s\] with their present velocities: positions along straight
    /// lines, orientations by the exponential map.
    pub fn drift(&mut self, time: f64) {
        for body in &mut self.bodies {
            body.position += body.velocity * time;
            body.orientation *= UnitQuaternion::from_scaled_axis(body.rate * time);
        }
    }
}
