//! Small vibrations about a pose: undamped eigenfrequencies, shapes, and who stores their energy.
//!
//! `(model, state) => M⁻½·K·M⁻½ => frequencies, shapes`, K by central differences of the kernel's
//! wrenches. Freedoms are, per body, shifts along the world's axes and turns about the body's.
//! Preloads and gravity are in K, which is symmetric where the pose is at rest in equilibrium.

use dbd_kernel::forces::wrenches;
use dbd_kernel::{F64, Leapfrog, Plant, Quaternion, State, Vec3};
use dbd_scene::{Scene, SceneModel};
use nalgebra::{DMatrix, SymmetricEigen};

/// \[m, rad\] half the distance of the differences: errors of its square (the third derivative)
/// and of 1e-16 over it (rounding) are both below 1e-9 of the stiffness.
const PROBE: f64 = 1e-6;

/// The modes of a model about a pose.
pub struct Modes {
    /// \[Hz\] ascending; that of a negative stiffness is negative.
    pub frequencies: Vec<f64>,
    /// Shapes in the same order, in columns: shifts and turns per body, scaled by √m and √I, of
    /// unit length.
    pub shapes: DMatrix<f64>,
    /// The largest difference of K and its transpose over the largest entry.
    pub asymmetry: f64,
}

/// A body's state moved along freedom `c`: a shift along a world axis or a turn about its own.
fn moved(state: &State<SceneModel<F64>>, freedom: usize, by: f64) -> State<SceneModel<F64>> {
    let mut state = state.clone();
    let body = &mut state.bodies[freedom / 6];
    let axis = Vec3::axes()[freedom % 3];
    if freedom % 6 < 3 {
        body.position = body.position + axis * by;
    } else {
        let v = axis * libm::sin(0.5 * by);
        let turn = Quaternion::new(libm::cos(0.5 * by), v.x, v.y, v.z);
        body.orientation = body.orientation.product(turn);
    }
    state
}

/// 1/√m and 1/√I of every freedom.
fn roots(model: &SceneModel<F64>) -> Vec<f64> {
    let inertias = model
        .bodies
        .iter()
        .flat_map(|b| [b.mass, b.mass, b.mass, b.inertia.x, b.inertia.y, b.inertia.z]);
    inertias.map(|m| 1.0 / m.sqrt()).collect()
}

/// The state without velocities.
fn at_rest(state: &State<SceneModel<F64>>) -> State<SceneModel<F64>> {
    let mut rest = state.clone();
    for body in &mut rest.bodies {
        (body.velocity, body.angular_velocity) = (Vec3::ZERO, Vec3::ZERO);
    }
    rest
}

/// How the mass-scaled wrenches answer, with the sign of a stiffness, to `probe(freedom, ±1e-6)`.
fn scaled(
    model: &SceneModel<F64>,
    probe: impl Fn(usize, f64) -> State<SceneModel<F64>>,
) -> DMatrix<f64> {
    let roots = roots(model);
    let mut matrix = DMatrix::zeros(roots.len(), roots.len());
    for column in 0..roots.len() {
        let at = |by: f64| wrenches(model, &probe(column, by), 1e-3).unwrap();
        let (plus, minus) = (at(PROBE), at(-PROBE));
        for (body, (plus, minus)) in plus.iter().zip(&minus).enumerate() {
            let force = (plus.force - minus.force).to_f64();
            let torque = (plus.torque - minus.torque).to_f64();
            for (i, change) in force.into_iter().chain(torque).enumerate() {
                let row = 6 * body + i;
                matrix[(row, column)] = -change / (2.0 * PROBE) * roots[row] * roots[column];
            }
        }
    }
    matrix
}

/// `M⁻½·K·M⁻½` \[1/s²\] and its asymmetry.
///
/// # Panics
/// Where a twist is undefined.
#[must_use]
pub fn scaled_stiffness(
    model: &SceneModel<F64>,
    state: &State<SceneModel<F64>>,
) -> (DMatrix<f64>, f64) {
    let rest = at_rest(state);
    let matrix = scaled(model, |freedom, by| moved(&rest, freedom, by));
    let transpose = matrix.transpose();
    let asymmetry = (&matrix - &transpose).amax() / matrix.amax();
    ((matrix + transpose) * 0.5, asymmetry)
}

/// `M⁻½·C·M⁻½` \[1/s\].
///
/// # Panics
/// Where a twist is undefined.
#[must_use]
pub fn scaled_damping(model: &SceneModel<F64>, state: &State<SceneModel<F64>>) -> DMatrix<f64> {
    let rest = at_rest(state);
    scaled(model, |freedom, by| {
        let mut state = rest.clone();
        let body = &mut state.bodies[freedom / 6];
        let rate = Vec3::axes()[freedom % 3] * by;
        if freedom % 6 < 3 {
            body.velocity = rate;
        } else {
            body.angular_velocity = rate;
        }
        state
    })
}

/// The modes about the pose of `state`, whatever its velocities.
#[must_use]
pub fn modes(model: &SceneModel<F64>, state: &State<SceneModel<F64>>) -> Modes {
    let (matrix, asymmetry) = scaled_stiffness(model, state);
    let eigen = SymmetricEigen::new(matrix);
    let mut order: Vec<usize> = (0..eigen.eigenvalues.len()).collect();
    order.sort_by(|a, b| eigen.eigenvalues[*a].total_cmp(&eigen.eigenvalues[*b]));
    let frequency = |square: f64| square.abs().sqrt().copysign(square) / std::f64::consts::TAU;
    Modes {
        frequencies: order.iter().map(|i| frequency(eigen.eigenvalues[*i])).collect(),
        shapes: DMatrix::from_fn(order.len(), order.len(), |row, column| {
            eigen.eigenvectors[(row, order[column])]
        }),
        asymmetry,
    }
}

/// The model with those joints and torsion springs only whose names `keep` likes, without
/// gravity, loads, inputs and raw elements.
#[must_use]
pub fn held_by(scene: &Scene, keep: impl Fn(&str) -> bool) -> SceneModel<F64> {
    let mut model = scene.model.clone();
    model.gravity.clear();
    model.loads.clear();
    let kept = |group: usize| {
        scene.joints.iter().any(|joint| joint.groups.contains(&group) && keep(&joint.name))
    };
    let groups: Vec<_> = (0..model.groups.len()).filter(|g| kept(*g)).collect();
    model.groups = groups.iter().map(|g| model.groups[*g]).collect();
    let springs = model.torsions.iter_mut().zip(&scene.torsion_names);
    for (spring, _) in springs.filter(|(_, name)| !keep(name)) {
        (spring.stiffness, spring.preload) = (0.0, 0.0);
    }
    model
}

/// The state after `time` \[s\] of the scene.
///
/// # Panics
/// Where the run fails.
#[must_use]
pub fn after(scene: &Scene, time: f64) -> State<SceneModel<F64>> {
    let step = scene.step.expect("the scene states its step");
    let mut plant = Plant::new(&scene.model, Leapfrog, step).unwrap();
    plant.advance((time / step).round() as u64).ok().unwrap();
    plant.state().clone()
}
