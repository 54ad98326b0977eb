//! A state from which a motion is run a second time: each body a little moved and turned, along fixed directions.

use dbd_kernel::{F64, Quaternion, State as KernelState, Vec3};
use dbd_scene::SceneModel;
use nalgebra::{UnitQuaternion, Vector3};

use crate::reference::state::State;

/// \[m\], \[rad\] by how much a body is perturbed.
pub const PERTURBATION: f64 = 1e-9;

/// The state with every body moved and turned by [`PERTURBATION`], each along its own direction:
/// points of a golden spiral on the sphere.
#[must_use]
pub fn perturbed(state: &State) -> State {
    let mut state = state.clone();
    let count = state.bodies.len();
    for (row, body) in state.bodies.iter_mut().enumerate() {
        let [shift, turn] = direction(row, count);
        body.position += shift;
        body.orientation *= UnitQuaternion::from_scaled_axis(turn);
    }
    state
}

/// Translates and rotates the bodies of a state of the kernel as [`perturbed`] does.
pub fn perturbation(state: &mut KernelState<SceneModel<F64>>) {
    let count = state.bodies.len();
    for (row, body) in state.bodies.iter_mut().enumerate() {
        let [shift, turn] = direction(row, count).map(|by| Vec3::from_f64(by.into()));
        body.position = body.position + shift;
        // The cosine of half of it rounds to 1.
        let half = turn * 0.5;
        body.orientation = body.orientation.product(Quaternion::new(1.0, half.x, half.y, half.z));
    }
}

/// \[m\] the translation and \[rad\] the rotation of a body out of the given number.
fn direction(row: usize, bodies: usize) -> [Vector3<f64>; 2] {
    let count = 2 * bodies;
    [2 * row, 2 * row + 1].map(|i| {
        let z = 1.0 - (2 * i + 1) as f64 / count as f64;
        let (sin, cos) = (i as f64 * 2.399_963_229_728_653).sin_cos();
        let radius = (1.0 - z * z).sqrt();
        Vector3::new(radius * cos, radius * sin, z) * PERTURBATION
    })
}
