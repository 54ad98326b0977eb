//! All eigenfrequencies of a pose, from the reference's forces.
//!
//! `(mechanism, state) => ω \[rad/s\], ascending`. The tangent stiffness K comes from central
//! differences of the accelerations of the resting pose, translations along world axes and rotations about body axes,
//! scaled to `M^½·A·M^-½ = −M^-½·K·M^-½`. Out of equilibrium K is not symmetric where an unbalanced torque acts; its
//! symmetric part is used, whose eigenvalues bound the real parts (Bendixson 1902). For small models: 6 per body, a
//! dense matrix.

use nalgebra::{DMatrix, SymmetricEigen, UnitQuaternion, Vector3};

use crate::reference::mechanism::Mechanism;
use crate::reference::signals::Clock;
use crate::reference::state::State;

/// \[m\], \[rad\] of a difference.
const PROBE: f64 = 1e-6;

/// The angular frequencies \[rad/s\] of the pose of a state at a time \[s\], ascending, 6 per body.
/// Rigid motions and driven bodies have 0; an unstable pose has negative ones, whose magnitudes are the growth rates.
#[must_use]
pub fn eigenfrequencies(mechanism: &Mechanism, state: &State, time: f64) -> Vec<f64> {
    let matrix = scaled_stiffness(mechanism, state, time);
    let squares = SymmetricEigen::new(matrix).eigenvalues;
    let mut frequencies: Vec<f64> =
        squares.iter().map(|square| square.abs().sqrt().copysign(*square)).collect();
    frequencies.sort_by(f64::total_cmp);
    frequencies
}

/// The symmetric part of `M^-½·K·M^-½` \[1/s²\].
#[must_use]
pub fn scaled_stiffness(mechanism: &Mechanism, state: &State, time: f64) -> DMatrix<f64> {
    let mut rest = state.clone();
    for body in &mut rest.bodies {
        body.velocity = Vector3::zeros();
        body.rate = Vector3::zeros();
    }
    let roots = mechanism.bodies.iter().flat_map(|body| {
        let [x, y, z] = [body.inertia.x, body.inertia.y, body.inertia.z];
        [body.mass, body.mass, body.mass, x, y, z].map(f64::sqrt)
    });
    let roots: Vec<f64> = roots.collect();
    let size = roots.len();
    let mut matrix = DMatrix::zeros(size, size);
    for column in (0..size).filter(|column| !mechanism.bodies[column / 6].driven) {
        let [plus, minus] = [PROBE, -PROBE].map(|by| {
            let moved = moved(&rest, column, by);
            let at = mechanism.at(&moved, Clock::at(time));
            mechanism.respond(&at)
        });
        for (body, (plus, minus)) in plus.iter().zip(&minus).enumerate() {
            let linear = plus.linear - minus.linear;
            let angular = plus.angular - minus.angular;
            for (i, change) in linear.iter().chain(&angular).enumerate() {
                let row = 6 * body + i;
                matrix[(row, column)] = -change / (2.0 * PROBE) * roots[row] / roots[column];
            }
        }
    }
    let transpose = matrix.transpose();
    (matrix + transpose) * 0.5
}

fn moved(state: &State, freedom: usize, by: f64) -> State {
    let mut state = state.clone();
    let body = &mut state.bodies[freedom / 6];
    let along = Vector3::ith(freedom % 3, by);
    if freedom % 6 < 3 {
        body.position += along;
    } else {
        body.orientation *= UnitQuaternion::from_scaled_axis(along);
    }
    state
}
