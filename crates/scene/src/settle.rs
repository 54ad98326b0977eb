//! `settle = true`: static equilibrium under load, before t = 0.
//!
//! `model => poses of static equilibrium`. Pseudo-transient continuation (Kelley & Keyes 1998):
//! implicit Euler steps of a motion without inertia, `(M/τ + K)·δ = F`, K = −∂F/∂q by central differences and
//! symmetrised, τ growing from step to step. A step is accepted only where the matrix is positive definite, so the
//! motion descends to a stable equilibrium. A planar scene settles with its planar model. Sums have a fixed order: the
//! same bits on every host.

use dbd_kernel::{Body, F64, Quaternion, State, Vec3, forces};
use miette::Diagnostic;
use thiserror::Error;

use crate::closure::{MAX_BODIES, Pose, length};
use crate::error::SceneError;
use crate::joints::{Moved, ROUNDING};
use crate::orientation::settled;
use crate::runtime::SceneModel;
use crate::scene::{Scene, Settled};
use crate::text::Table;

/// Maximum number of steps.
const STEPS: usize = 500;

/// \[rad; fraction of the model's size\] largest rotation and displacement of a step.
const LARGEST: f64 = 0.2;

/// \[rad; fraction of the model's size\] step of the central differences.
const DIFFERENCE: f64 = 1e-6;

/// \[rad; fraction of the model's size\] convergence limit of a step.
const STILL: f64 = 1e-12;

/// The same where steps no longer shrink: rounding of forces moves softly supported bodies.
const ROUNDED: f64 = 1e-8;

/// Unknowns of a body in space, and in the plane z = 0: displacements, then rotations.
const SPACE: &[usize] = &[0, 1, 2, 3, 4, 5];
const PLANE: &[usize] = &[0, 1, 5];

/// Growth of τ per step.
const GROWTH: f64 = 4.0;

/// Why a scene was not brought to rest.
#[derive(Clone, Debug, PartialEq, Error, Diagnostic)]
pub enum Restless {
    /// Too many bodies.
    #[error("cannot bring {bodies} bodies to rest: the limit is {MAX_BODIES}")]
    #[diagnostic(help("bring the scene to rest in parts, or give the poses"))]
    TooMany {
        /// Number of bodies.
        bodies: usize,
    },
    /// A body keeps moving.
    #[error(
        "no equilibrium found: nothing holds `{body}`, which accelerates at {acceleration:.3e} \
         m/s² and {angular:.3e} rad/s²"
    )]
    #[diagnostic(help(
        "add a spring, joint or stop that holds it against gravity, loads and inputs"
    ))]
    NotHeld {
        /// The body that moves most.
        body: String,
        /// \[m/s²\] of its centre of mass where the search ended.
        acceleration: f64,
        /// \[rad/s²\] its angular acceleration there.
        angular: f64,
    },
    /// A torsion spring has no angle.
    #[error(
        "no equilibrium found: the search reaches a pose at which a torsion angle is undefined"
    )]
    #[diagnostic(help("give poses closer to the equilibrium"))]
    Undefined,
}

/// The scene in equilibrium with the forces at t = 0; [`Scene::settled`] lists the moved bodies. Initial velocities are
/// dropped.
///
/// # Errors
/// Where it has more than 200 bodies, nothing holds a body, or a torsion angle becomes undefined.
pub fn relaxed(scene: &Scene) -> Result<Scene, Restless> {
    let mut scene = scene.clone();
    let planar = scene.planar.as_mut().map(|planar| &mut planar.model.initial);
    for state in scene.model.initial.iter_mut().chain(planar.into_iter().flatten()) {
        (state.velocity, state.angular_velocity) = (Vec3::ZERO, Vec3::ZERO);
    }
    scene.settled = Some(rest(&mut scene)?);
    // Normalise so that written states read back to the same bits.
    for state in &mut scene.model.initial {
        state.orientation = Quaternion::from_f64(settled(state.orientation.to_f64()));
    }
    Ok(scene)
}

/// Moves the bodies of a scene with `settle = true` to equilibrium.
pub(crate) fn settle(root: &Table<'_>, scene: &mut Scene) -> Result<Settled, SceneError> {
    let refuse = |problem: String, help: &str| root.refuse_value("settle", &problem, help);
    let names = &scene.body_names;
    let is_moving = |row: &usize| {
        let state = &scene.stepped().initial[*row];
        state.velocity.dot(state.velocity) + state.angular_velocity.dot(state.angular_velocity)
            > 0.0
    };
    if let Some(row) = (0..names.len()).find(is_moving) {
        let problem =
            format!("cannot bring `{}` to rest, which has an initial velocity", names[row]);
        return Err(refuse(problem, "use either `settle`, or velocities and `rates`"));
    }
    if let Some(row) = scene.stepped().bodies.iter().position(Body::is_driven) {
        let problem = format!("cannot bring `{}` to rest, which inputs move", names[row]);
        return Err(refuse(problem, "remove `settle` and give the poses, or remove `driven`"));
    }
    rest(scene).map_err(|restless| match restless {
        Restless::TooMany { bodies } => {
            let problem = format!("cannot bring {bodies} bodies to rest");
            refuse(problem, &format!("the limit is {MAX_BODIES}; give the poses instead"))
        }
        Restless::NotHeld { body, .. } => {
            let problem = format!("finds no pose at which `{body}` is at rest");
            refuse(problem, "add a spring, joint or stop that holds it against gravity and loads")
        }
        Restless::Undefined => {
            let problem = "reaches a pose at which a torsion angle is undefined".to_owned();
            refuse(problem, "give poses closer to the equilibrium")
        }
    })
}

/// A state of a model at rest in equilibrium with its inputs, reached downhill from a given one.
///
/// # Errors
/// As [`relaxed`].
pub fn relaxed_state(
    names: &[String],
    model: &SceneModel<F64>,
    state: &State<SceneModel<F64>>,
) -> Result<State<SceneModel<F64>>, Restless> {
    let rest = searched(names, model, state, SPACE)?;
    let mut state = state.clone();
    for (body, pose) in state.bodies.iter_mut().zip(&rest.poses) {
        (body.position, body.orientation) = (pose.position, pose.orientation);
        (body.velocity, body.angular_velocity) = (Vec3::ZERO, Vec3::ZERO);
    }
    Ok(state)
}

/// Moves the bodies of a scene without velocities to equilibrium.
fn rest(scene: &mut Scene) -> Result<Settled, Restless> {
    let model = scene.stepped();
    let unknowns = if scene.planar.is_some() { PLANE } else { SPACE };
    let state = State::initial(model);
    let given = poses(&state);
    let mut search = searched(&scene.body_names, model, &state, unknowns)?;
    let [force, torque] = search.residual().ok_or(Restless::Undefined)?;
    let (poses, iterations) = (search.poses, search.steps);
    let mut moved = Vec::new();
    for (row, (pose, given)) in poses.iter().zip(&given).enumerate() {
        let mut state = scene.stepped().initial[row];
        (state.position, state.orientation) = (pose.position, pose.orientation);
        scene.model.initial[row] = match &mut scene.planar {
            Some(planar) => {
                planar.model.initial[row] = state;
                planar.plane.state_outward(row, &state)
            }
            None => state,
        };
        let [distance, angle] = pose.since(given).map(length);
        if distance > ROUNDING || angle > ROUNDING {
            moved.push(Moved { body: scene.body_names[row].clone(), distance, angle });
        }
    }
    Ok(Settled { moved, iterations, force, torque })
}

/// The poses of a state.
fn poses(state: &State<SceneModel<F64>>) -> Vec<Pose> {
    state.bodies.iter().map(|body| Pose::new(body.position, body.orientation)).collect()
}

/// The search from a state to its end in equilibrium.
fn searched<'m>(
    names: &[String],
    model: &'m SceneModel<F64>,
    state: &State<SceneModel<F64>>,
    unknowns: &'static [usize],
) -> Result<Search<'m>, Restless> {
    if model.bodies.len() > MAX_BODIES {
        return Err(Restless::TooMany { bodies: model.bodies.len() });
    }
    let mut search = Search::of(model, state.clone(), unknowns);
    match search.run() {
        End::AtRest => Ok(search),
        End::Moving(row) => {
            let [acceleration, angular] = search.acceleration(row).ok_or(Restless::Undefined)?;
            Err(Restless::NotHeld { body: names[row].clone(), acceleration, angular })
        }
        End::Undefined => Err(Restless::Undefined),
    }
}

/// The result of a search.
enum End {
    AtRest,
    /// The body that moves most.
    Moving(usize),
    Undefined,
}

struct Search<'m> {
    model: &'m SceneModel<F64>,
    state: State<SceneModel<F64>>,
    poses: Vec<Pose>,
    /// \[m\] at which a radian counts as a metre.
    size: f64,
    /// Of each body.
    unknowns: &'static [usize],
    steps: usize,
}

impl<'m> Search<'m> {
    fn of(
        model: &'m SceneModel<F64>,
        mut state: State<SceneModel<F64>>,
        unknowns: &'static [usize],
    ) -> Self {
        let poses = poses(&state);
        for body in &mut state.bodies {
            (body.velocity, body.angular_velocity) = (Vec3::ZERO, Vec3::ZERO);
        }
        // The largest distance of two bodies' centres, free length, or radius of gyration.
        let mut size = model.tsdas.iter().map(|tsda| tsda.free_length).fold(0.0_f64, f64::max);
        for (pose, body) in poses.iter().zip(&model.bodies) {
            let apart = pose.position - poses[0].position;
            size = size.max(length(apart)).max(libm::sqrt(largest_moment(body) / body.mass));
        }
        Self { model, state, poses, size, unknowns, steps: 0 }
    }

    fn run(&mut self) -> End {
        // \[s²\].
        let mut tau = 1e-6;
        let (mut worst, mut before) = (0, f64::INFINITY);
        for _ in 0..STEPS {
            self.steps += 1;
            let Some(force) = self.forces(&self.poses.clone()) else { return End::Undefined };
            let Some(stiffness) = self.stiffness() else { return End::Undefined };
            let (step, largest) = loop {
                if let Some(step) = self.step(&stiffness, &force, tau) {
                    let (largest, row) = self.largest(&step);
                    worst = row;
                    if largest <= LARGEST {
                        break (step, largest);
                    }
                }
                tau /= GROWTH;
                if tau < 1e-30 {
                    return End::Moving(worst);
                }
            };
            let step: Vec<_> =
                step.chunks_exact(self.unknowns.len()).map(|own| self.split(own)).collect();
            for (pose, [shift, turn]) in self.poses.iter_mut().zip(step) {
                *pose = pose.moved(shift, turn);
            }
            let is_still = largest <= STILL || (largest <= ROUNDED && 2.0 * largest >= before);
            // Only once τ no longer limits the motion.
            if is_still && (tau >= 1.0 || largest == 0.0) {
                return End::AtRest;
            }
            before = largest;
            tau = (tau * GROWTH).min(1e12);
        }
        End::Moving(worst)
    }

    /// The forces \[N\] and torques \[N·m, world axes\] on the bodies; `None` where a torsion angle is undefined.
    fn wrenches(&mut self) -> Option<Vec<[Vec3<f64>; 2]>> {
        let size = self.size;
        let forces = self.forces(&self.poses.clone())?;
        let split = |own: &[f64]| {
            let [force, torque] = self.split(own);
            [force, torque * (size * size)]
        };
        Some(forces.chunks_exact(self.unknowns.len()).map(split).collect())
    }

    /// \[N, N·m\] the largest force and torque on a body.
    fn residual(&mut self) -> Option<[f64; 2]> {
        let all = self.wrenches()?;
        let largest = |which: usize| all.iter().map(|own| length(own[which])).fold(0.0, f64::max);
        Some([0, 1].map(largest))
    }

    /// \[m/s², rad/s²\] of a body.
    fn acceleration(&mut self, row: usize) -> Option<[f64; 2]> {
        let [force, torque] = self.wrenches()?[row];
        let (body, pose) = (&self.model.bodies[row], &self.poses[row]);
        let Vec3 { x, y, z } = pose.orientation.rotation().to_body(torque);
        let inertia = body.inertia;
        let angular = Vec3::new(x / inertia.x, y / inertia.y, z / inertia.z);
        Some([length(force) / body.mass, length(angular)])
    }

    /// \[N\] on all bodies, torques over the size; `None` where a torsion angle is undefined.
    fn forces(&mut self, poses: &[Pose]) -> Option<Vec<f64>> {
        for (state, pose) in self.state.bodies.iter_mut().zip(poses) {
            (state.position, state.orientation) = (pose.position, pose.orientation);
        }
        let wrenches = forces::wrenches(self.model, &self.state, 1.0).ok()?;
        let mut all = Vec::with_capacity(self.unknowns.len() * poses.len());
        for (wrench, pose) in wrenches.iter().zip(poses) {
            let torque = pose.turned(wrench.torque) * (1.0 / self.size);
            let own = [wrench.force.to_f64(), torque.to_f64()];
            all.extend(self.unknowns.iter().map(|axis| own.as_flattened()[*axis]));
        }
        Some(all)
    }

    /// \[N/m\] `−∂F/∂q`, its lower half.
    fn stiffness(&mut self) -> Option<Vec<Vec<f64>>> {
        let per = self.unknowns.len();
        let count = per * self.poses.len();
        let by = DIFFERENCE * self.size;
        let mut columns = Vec::with_capacity(count);
        for unknown in 0..count {
            let mut at = |by: f64| {
                let mut own = vec![0.0; per];
                own[unknown % per] = by;
                let [shift, turn] = self.split(&own);
                let mut poses = self.poses.clone();
                let pose = &mut poses[unknown / per];
                *pose = pose.moved(shift, turn);
                self.forces(&poses)
            };
            let (ahead, behind) = (at(by)?, at(-by)?);
            let column = ahead.iter().zip(&behind).map(|(a, b)| (b - a) / (2.0 * by));
            columns.push(column.collect::<Vec<f64>>());
        }
        let half = |i: usize| (0..=i).map(|j| 0.5 * (columns[i][j] + columns[j][i])).collect();
        Some((0..count).map(half).collect())
    }

    /// `(M/τ + K)⁻¹·F`; `None` where the matrix is not positive definite.
    fn step(&self, stiffness: &[Vec<f64>], force: &[f64], tau: f64) -> Option<Vec<f64>> {
        let mut matrix = stiffness.to_vec();
        for (i, row) in matrix.iter_mut().enumerate() {
            let body = &self.model.bodies[i / self.unknowns.len()];
            let turning = largest_moment(body) / (self.size * self.size);
            let is_shift = self.unknowns[i % self.unknowns.len()] < 3;
            row[i] += if is_shift { body.mass } else { turning } / tau;
        }
        solve(matrix, force)
    }

    /// The displacement \[m\] and rotation \[rad\] of a body's unknowns.
    fn split(&self, own: &[f64]) -> [Vec3<f64>; 2] {
        let mut all = [0.0; 6];
        for (axis, value) in self.unknowns.iter().zip(own) {
            all[*axis] = *value;
        }
        let [x, y, z, a, b, c] = all;
        [Vec3::new(x, y, z), Vec3::new(a, b, c) * (1.0 / self.size)]
    }

    /// The largest displacement over the size, or rotation \[rad\], and its body.
    fn largest(&self, step: &[f64]) -> (f64, usize) {
        let sizes = step.chunks_exact(self.unknowns.len()).map(|own| {
            let [shift, turn] = self.split(own).map(length);
            let shift = shift / self.size;
            if shift > turn { shift } else { turn }
        });
        // NaN counts as the largest.
        sizes.enumerate().fold(
            (0.0, 0),
            |best, (row, size)| {
                if size <= best.0 { best } else { (size, row) }
            },
        )
    }
}

/// \[kg·m²\].
fn largest_moment(body: &Body<f64>) -> f64 {
    body.inertia.to_f64().into_iter().fold(0.0, f64::max)
}

/// Solves a symmetric system given by its lower half, by Cholesky decomposition.
fn solve(mut matrix: Vec<Vec<f64>>, right: &[f64]) -> Option<Vec<f64>> {
    let count = right.len();
    for i in 0..count {
        let (above, rest) = matrix.split_at_mut(i);
        let own = &mut rest[0];
        for j in 0..i {
            let share = own[..j].iter().zip(&above[j][..j]).fold(own[j], |sum, (a, b)| sum - a * b);
            own[j] = share / above[j][j];
        }
        let left = own[..i].iter().fold(own[i], |sum, a| sum - a * a);
        if !(left > 0.0 && left.is_finite()) {
            return None;
        }
        own[i] = libm::sqrt(left);
    }
    let mut solution = right.to_vec();
    for i in 0..count {
        let sum = (0..i).fold(solution[i], |sum, j| sum - matrix[i][j] * solution[j]);
        solution[i] = sum / matrix[i][i];
    }
    for i in (0..count).rev() {
        let sum = (i + 1..count).fold(solution[i], |sum, j| sum - matrix[j][i] * solution[j]);
        solution[i] = sum / matrix[i][i];
    }
    Some(solution)
}
