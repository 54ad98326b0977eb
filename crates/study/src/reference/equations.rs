//! A mechanism as a system of first-order equations, for any integrator.
//!
//! `y => ẏ`: per body x, q, v, ω with `ẋ = v`, `q̇ = ½·q∘ω`; then the torsion angles, whose integral counts revolutions
//! that a pose does not determine; then the time. Poses are read from q/|q|, so that the drift of its length has no
//! effect. The time is a state like any other, so that stages follow the integrator's matrix, independent of the nodes
//! in its table.

use nalgebra::{Quaternion, UnitQuaternion, Vector3};

use crate::reference::mechanism::Mechanism;
use crate::reference::signals::Clock;
use crate::reference::state::{BodyState, State};

/// Numbers per body.
const PER_BODY: usize = 13;

/// A mechanism between two jumps of its loads and tables.
#[derive(Clone, Copy)]
pub struct Equations<'m> {
    mechanism: &'m Mechanism,
    piece: [f64; 2],
}

impl<'m> Equations<'m> {
    /// The equations between two times \[s\].
    #[must_use]
    pub fn new(mechanism: &'m Mechanism, piece: [f64; 2]) -> Self {
        Self { mechanism, piece }
    }

    /// The derivative.
    ///
    /// # Panics
    /// Where the numbers are not those of this mechanism.
    pub fn derivative(&self, y: &[f64], derivative: &mut [f64]) {
        let state = unpack(y, self.mechanism.bodies.len());
        let at = self.mechanism.at(&state, Clock::between(y[y.len() - 1], self.piece));
        let accelerations = self.mechanism.respond(&at);
        let (bodies, others) = derivative.split_at_mut(PER_BODY * state.bodies.len());
        let (time, torsion_angles) = others.split_last_mut().expect("the time is a state");
        *time = 1.0;
        let rows = bodies.chunks_exact_mut(PER_BODY).zip(y.chunks_exact(PER_BODY));
        for ((out, y), (body, acceleration)) in rows.zip(state.bodies.iter().zip(&accelerations)) {
            let q = Quaternion::new(y[3], y[4], y[5], y[6]);
            let turning = q * Quaternion::from_imag(body.rate) * 0.5;
            write(out, &body.velocity, &turning, &acceleration.linear, &acceleration.angular);
        }
        for (out, rate) in torsion_angles.iter_mut().zip(self.mechanism.torsion_angle_rates(&at)) {
            *out = rate;
        }
    }
}

fn write(
    out: &mut [f64],
    position: &Vector3<f64>,
    q: &Quaternion<f64>,
    velocity: &Vector3<f64>,
    rate: &Vector3<f64>,
) {
    out[0..3].copy_from_slice(position.as_slice());
    out[3..7].copy_from_slice(&[q.w, q.i, q.j, q.k]);
    out[7..10].copy_from_slice(velocity.as_slice());
    out[10..13].copy_from_slice(rate.as_slice());
}

/// A state at a time \[s\] as numbers.
#[must_use]
pub fn pack(state: &State, time: f64) -> Vec<f64> {
    let mut y = vec![0.0; PER_BODY * state.bodies.len()];
    for (out, body) in y.chunks_exact_mut(PER_BODY).zip(&state.bodies) {
        write(out, &body.position, &body.orientation, &body.velocity, &body.rate);
    }
    y.extend(&state.torsion_angles);
    y.push(time);
    y
}

/// A state of numbers; orientations are brought to unit length.
///
/// # Panics
/// Where there are too few numbers for the bodies and the time.
#[must_use]
pub fn unpack(y: &[f64], bodies: usize) -> State {
    let (bodies, torsion_angles) = y.split_at(PER_BODY * bodies);
    let body = |y: &[f64]| BodyState {
        position: Vector3::new(y[0], y[1], y[2]),
        orientation: UnitQuaternion::new_normalize(Quaternion::new(y[3], y[4], y[5], y[6])),
        velocity: Vector3::new(y[7], y[8], y[9]),
        rate: Vector3::new(y[10], y[11], y[12]),
    };
    State {
        bodies: bodies.chunks_exact(PER_BODY).map(body).collect(),
        torsion_angles: torsion_angles[..torsion_angles.len() - 1].to_vec(),
    }
}
