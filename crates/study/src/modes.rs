//! Small vibrations about a pose: undamped eigenfrequencies and shapes.
//!
//! `(model, state) => M⁻½·K·M⁻½ => frequencies, shapes`, K by differences of the kernel's wrenches.
//! Degrees of freedom are, per body, translations along the world's axes and rotations about the body's. K includes
//! preloads and gravity; it is symmetric if the pose is in equilibrium. Dampers and velocities are excluded; clearances
//! are as in the pose.

use std::f64::consts::TAU;

use dbd_kernel::forces::wrenches;
use dbd_kernel::{BodyState, Cause, F64, State, Vec3};
use dbd_plant::digits::significant;
use dbd_scene::{Scene, SceneModel};
use nalgebra::{DMatrix, DVector, SymmetricEigen};

use error::PROBE;
use matrices::{at_rest, roots, six};

mod damped;
mod error;
mod iterative;
mod matrices;
mod shares;
mod table;

pub use error::{MAX_BODIES, ModesError};
pub use iterative::extremes;
pub use shares::{Element, elements, softened, strain_shares};
pub use table::{Fastest, Matrices, ModeRow, QUADRATIC, RatioSource, Table, table};

/// Beyond it K is not that of a pose in equilibrium.
const SYMMETRIC: f64 = 1e-3;

/// \[√kg·m/s², m/s²\] from which on a pose is not in equilibrium: of a body of 1 kg a thousandth of a g.
const CALM: f64 = 1e-2;

/// The modes of a model about a pose.
#[derive(Clone, Debug)]
pub struct Modes {
    /// \[Hz\] ascending; that of a negative stiffness is negative, one below `resolution` is 0.
    pub frequencies: Vec<f64>,
    /// Shapes in the same order, in columns: translations and rotations per body, scaled by √m and √I, of
    /// unit length.
    pub shapes: DMatrix<f64>,
    /// The largest difference of K and its transpose over the largest entry, both scaled by mass.
    pub asymmetry: f64,
    /// \[Hz\] rounding makes frequencies up to here of none.
    pub resolution: f64,
}

impl Modes {
    /// Motion of the bodies in a mode: translations along the world's axes \[m\], then rotations about each body's axes
    /// \[rad\]; the largest of all numbers is 1 and positive.
    #[must_use]
    pub fn motion(&self, model: &SceneModel<F64>, mode: usize) -> Vec<[f64; 6]> {
        let roots = roots(model);
        let raw: Vec<f64> =
            roots.iter().enumerate().map(|(row, root)| self.shapes[(row, mode)] * root).collect();
        let largest =
            raw.iter().copied().fold(0.0, |a: f64, b| if b.abs() > a.abs() { b } else { a });
        let scale = if largest == 0.0 { 0.0 } else { 1.0 / largest };
        raw.chunks_exact(6).map(|body| std::array::from_fn(|i| body[i] * scale)).collect()
    }

    /// Response of the bodies to forces scaled by 1/√m and 1/√I: deflection of the elastic modes \[m\] and acceleration
    /// of the others \[m/s²\]; of each the body with the largest value, and that value.
    fn answer(&self, model: &SceneModel<F64>, forces: &DVector<f64>) -> [(usize, f64); 2] {
        let roots = roots(model);
        let most = |weight: &dyn Fn(f64) -> f64| {
            let share = |mode: usize| {
                let shape = self.shapes.column(mode);
                shape * (shape.dot(forces) * weight(self.frequencies[mode]))
            };
            let modes = 0..self.frequencies.len();
            let sum = modes.fold(DVector::zeros(roots.len()), |sum, mode| sum + share(mode));
            let shift = |row: usize| {
                let parts = (6 * row..6 * row + 3).map(|i| sum[i] * roots[i]);
                parts.map(|part| part * part).sum::<f64>().sqrt()
            };
            let bodies = (0..model.bodies.len()).map(|row| (row, shift(row)));
            bodies.max_by(|a, b| a.1.total_cmp(&b.1)).unwrap_or_default()
        };
        [
            most(&|frequency| if frequency > 0.0 { (TAU * frequency).powi(-2) } else { 0.0 }),
            most(&|frequency| if frequency > 0.0 { 0.0 } else { 1.0 }),
        ]
    }

    /// How many of the lowest modes have no stiffness: rigid motions and mobilities.
    #[must_use]
    pub fn free(&self) -> usize {
        self.frequencies.iter().filter(|frequency| **frequency == 0.0).count()
    }

    /// How many run away.
    #[must_use]
    pub fn unstable(&self) -> usize {
        self.frequencies.iter().filter(|frequency| **frequency < 0.0).count()
    }
}

/// M⁻½·Q \[√kg·m/s²\], bodies at rest: all forces except dampers and gyroscopic ones.
///
/// # Errors
/// Where a force is undefined.
pub fn weighted_forces(
    model: &SceneModel<F64>,
    state: &State<SceneModel<F64>>,
) -> Result<DVector<f64>, Cause> {
    let forces = wrenches(model, &at_rest(state), 1e-3)?;
    let weighted = forces.iter().flat_map(six).zip(roots(model)).map(|(force, root)| force * root);
    Ok(DVector::from_vec(weighted.collect()))
}

/// `M⁻½·K·M⁻½` \[1/s²\] and its asymmetry, 0 where K is 0.
///
/// # Errors
/// If a torsion angle is undefined, or an entry overflows.
pub fn scaled_stiffness(
    model: &SceneModel<F64>,
    state: &State<SceneModel<F64>>,
) -> Result<(DMatrix<f64>, f64), ModesError> {
    let matrix = dense(model, &matrices::stiffness(model, state)?);
    let transpose = matrix.transpose();
    let largest = matrix.amax();
    let asymmetry = if largest == 0.0 { 0.0 } else { (&matrix - &transpose).amax() / largest };
    Ok(((matrix + transpose) * 0.5, asymmetry))
}

/// `M⁻½·C·M⁻½` \[1/s\].
///
/// # Errors
/// If a torsion angle is undefined, or an entry overflows.
pub fn scaled_damping(
    model: &SceneModel<F64>,
    state: &State<SceneModel<F64>>,
) -> Result<DMatrix<f64>, ModesError> {
    Ok(dense(model, &matrices::damping(model, state)?))
}

fn dense(model: &SceneModel<F64>, entries: &[matrices::Entry]) -> DMatrix<f64> {
    let size = 6 * model.bodies.len();
    let mut matrix = DMatrix::zeros(size, size);
    entries.iter().for_each(|(row, column, value)| matrix[(*row, *column)] = *value);
    matrix
}

/// \[Hz\] rounding makes frequencies up to here of none, with a largest `ω²`.
fn resolution(state: &State<SceneModel<F64>>, largest: f64) -> f64 {
    let far = state.bodies.iter().flat_map(|body| body.position.to_f64());
    let far = far.fold(1.0, |far: f64, place| far.max(place.abs()));
    (8.0 * f64::EPSILON * far / PROBE * largest).sqrt() / TAU
}

/// \[Hz\] of an eigenvalue: negative where it is, 0 below the resolution.
fn frequency(square: f64, resolution: f64) -> f64 {
    let frequency = square.abs().sqrt() / TAU;
    if frequency <= resolution { 0.0 } else { frequency.copysign(square) }
}

/// The modes about the pose of `state`, whatever its velocities: six per body.
///
/// # Errors
/// If there are more than [`MAX_BODIES`] bodies, a torsion angle is undefined, or numbers overflow.
pub fn modes(model: &SceneModel<F64>, state: &State<SceneModel<F64>>) -> Result<Modes, ModesError> {
    if model.bodies.len() > MAX_BODIES {
        return Err(ModesError::TooMany { bodies: model.bodies.len() });
    }
    let (matrix, asymmetry) = scaled_stiffness(model, state)?;
    let eigen = SymmetricEigen::new(matrix);
    let mut order: Vec<usize> = (0..eigen.eigenvalues.len()).collect();
    order.sort_by(|a, b| eigen.eigenvalues[*a].total_cmp(&eigen.eigenvalues[*b]));
    let resolution = resolution(state, eigen.eigenvalues.amax());
    Ok(Modes {
        frequencies: order.iter().map(|i| frequency(eigen.eigenvalues[*i], resolution)).collect(),
        shapes: DMatrix::from_fn(order.len(), order.len(), |row, column| {
            eigen.eigenvectors[(row, order[column])]
        }),
        asymmetry,
        resolution,
    })
}

/// Remarks on the modes of a scene at t = 0: moving pose, pose out of equilibrium, unstable modes.
///
/// # Errors
/// If a torsion angle is undefined.
pub fn remarks(scene: &Scene, modes: &Modes) -> Result<Vec<String>, ModesError> {
    let (model, state) = (&scene.model, State::initial(&scene.model));
    let mut remarks = Vec::new();
    let moving =
        |body: &BodyState<F64>| body.velocity != Vec3::ZERO || body.angular_velocity != Vec3::ZERO;
    if state.bodies.iter().any(moving) {
        remarks.push(
            "the scene moves at t = 0; the modes are those of the same pose at rest".to_owned(),
        );
    }
    let off = weighted_forces(model, &state)?;
    if off.iter().any(|acceleration| acceleration.abs() > CALM) || modes.asymmetry > SYMMETRIC {
        let [held, free] = modes.answer(model, &off);
        let name = |row: usize| scene.body_names.get(row).map_or("a body", String::as_str);
        let place = if free.1 > CALM {
            let (name, rate) = (name(free.0), significant(free.1, 3));
            format!("`{name}` is unsupported and accelerates with {rate} m/s²")
        } else {
            let (name, way) = (name(held.0), significant(1e3 * held.1, 3));
            format!("`{name}` reaches equilibrium about {way} mm away")
        };
        remarks.push(format!(
            "the pose is not in equilibrium: released at rest, {place}; the modes are those about the \
             given pose, and low modes, which depend on weight and preload, differ at equilibrium"
        ));
    }
    match modes.unstable() {
        0 => {}
        1 => remarks.push("one mode has a negative frequency: it is unstable".to_owned()),
        n => remarks.push(format!("{n} modes have negative frequencies: they are unstable")),
    }
    Ok(remarks)
}

#[cfg(test)]
mod tests;
