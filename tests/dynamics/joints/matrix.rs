//! The stiffness or damping matrix of a joint, measured.
//!
//! `scene of two bodies and one joint => matrix (6 × 6)` by central differences of the wrenches
//! on the second body, in the joint's axes (reference, binormal, axis) about `at`; what stands
//! between, a spider, is condensed. Entries are in units of k or c, and lengths in spans (of a
//! spherical joint: arms), so that one tolerance fits forces and torques.

use dbd_kernel::forces::wrenches;
use dbd_kernel::{F64, Quaternion, State, Vec3};
use dbd_scene::{Scene, SceneModel};
use dbd_tests::turned;

/// Shift and turn along and about the joint's axes.
pub type Matrix = [[f64; 6]; 6];

/// \[N/m\] per TSDA.
pub const K: f64 = 2e5;
/// \[m\] the place of every joint here.
pub const AT: [f64; 3] = [0.3, -0.2, 0.1];

/// The joint's axes (e1, e2, axis), world: none along an axis of the world or of a body.
pub fn axes() -> [Vec3<f64>; 3] {
    let rotation = Quaternion::from_f64(turned([2.0 / 3.0, -1.0 / 3.0, 2.0 / 3.0], 0.8)).rotation();
    Vec3::axes().map(|axis| rotation.to_world(axis))
}

/// A matrix that couples nothing.
pub fn diagonal(shift: [f64; 3], turn: [f64; 3]) -> Matrix {
    let mut matrix = Matrix::default();
    for i in 0..3 {
        matrix[i][i] = shift[i];
        matrix[i + 3][i + 3] = turn[i];
    }
    matrix
}

/// Turns a body by `turn` about `AT` and shifts it.
pub fn shifted(
    state: &State<SceneModel<F64>>,
    body: usize,
    turn: [f64; 4],
    shift: Vec3<f64>,
) -> State<SceneModel<F64>> {
    let mut state = state.clone();
    let body = &mut state.bodies[body];
    let (turn, at) = (Quaternion::from_f64(turn), Vec3::from_f64(AT));
    body.position = at + turn.rotation().to_world(body.position - at) + shift;
    body.orientation = turn.product(body.orientation);
    state
}

/// Force on a body and torque about `AT`, world, in one column.
pub fn load(
    model: &SceneModel<F64>,
    state: &State<SceneModel<F64>>,
    body: usize,
) -> [Vec3<f64>; 2] {
    let wrench = wrenches(model, state, 1e-3).unwrap()[body];
    let body = &state.bodies[body];
    let arm = body.position - Vec3::from_f64(AT);
    let torque = body.orientation.rotation().to_world(wrench.torque) + arm.cross(wrench.force);
    [wrench.force, torque]
}

/// How the load on `loaded` answers a motion of `moved`, with the sign of a stiffness and in the
/// joint's axes; `answer` moves the body by plus and minus a little along freedom i and gives
/// the loads and the distance between them.
pub fn matrix(
    length: f64,
    unit: f64,
    answer: impl Fn(usize) -> ([[Vec3<f64>; 2]; 2], f64),
) -> Matrix {
    let columns: Matrix = std::array::from_fn(|freedom| {
        let ([plus, minus], distance) = answer(freedom);
        let slope = |row: usize| {
            let change = plus[row / 3] - minus[row / 3];
            let turns = i32::from(row >= 3) + i32::from(freedom >= 3);
            -axes()[row % 3].dot(change) / (distance * unit * length.powi(turns))
        };
        std::array::from_fn(slope)
    });
    std::array::from_fn(|row| columns.map(|column| column[row]))
}

/// The stiffness between a motion of one body and the load on another.
fn block(scene: &Scene, length: f64, moved: usize, loaded: usize) -> Matrix {
    let state = State::initial(&scene.model);
    matrix(length, K, |freedom| {
        let axis = axes()[freedom % 3];
        // The cube of a step is what central differences leave over, 1e-16 its rounding.
        let step = if freedom < 3 { 1e-5 * length } else { 1e-5 };
        let at = |step: f64| {
            let moved = if freedom < 3 {
                shifted(&state, moved, turned([0.0; 3], 0.0), axis * step)
            } else {
                shifted(&state, moved, turned(axis.to_f64(), step), Vec3::ZERO)
            };
            load(&scene.model, &moved, loaded)
        };
        ([at(step), at(-step)], 2.0 * step)
    })
}

/// The stiffness that the second body sees, whatever stands between condensed.
pub fn stiffness(scene: &Scene, length: f64) -> Matrix {
    let mut seen = block(scene, length, 1, 1);
    if scene.model.bodies.len() > 2 {
        let between = block(scene, length, 2, 2);
        let (into, out) = (block(scene, length, 1, 2), block(scene, length, 2, 1));
        let follows = solve(between, into);
        for (i, row) in seen.iter_mut().enumerate() {
            for (j, entry) in row.iter_mut().enumerate() {
                *entry -= (0..6).map(|l| out[i][l] * follows[l][j]).sum::<f64>();
            }
        }
    }
    seen
}

/// A⁻¹·B by elimination with the largest pivot.
fn solve(mut a: Matrix, mut b: Matrix) -> Matrix {
    for column in 0..6 {
        let largest =
            (column..6).max_by(|i, j| a[*i][column].abs().total_cmp(&a[*j][column].abs()));
        let pivot = largest.unwrap_or(column);
        a.swap(column, pivot);
        b.swap(column, pivot);
        for row in 0..6 {
            if row != column {
                let factor = a[row][column] / a[column][column];
                for j in 0..6 {
                    a[row][j] -= factor * a[column][j];
                    b[row][j] -= factor * b[column][j];
                }
            }
        }
    }
    std::array::from_fn(|i| b[i].map(|entry| entry / a[i][i]))
}

pub fn largest_difference(a: &Matrix, b: &Matrix) -> f64 {
    let pairs = a.as_flattened().iter().zip(b.as_flattened());
    pairs.map(|(a, b)| (a - b).abs()).fold(0.0, f64::max)
}
