//! Stiffness and damping of a pose by differences of the kernel's wrenches.
//!
//! `(model, state) => entries of M⁻½·K·M⁻½, M⁻½·C·M⁻½`. Bodies without a common element or neighbour are moved
//! together, so the number of evaluations does not grow with the number of bodies.

use std::collections::BTreeSet;

use dbd_kernel::elements::input::InputKind;
use dbd_kernel::forces::{Wrench, wrenches};
use dbd_kernel::laws::{Laws as _, Need};
use dbd_kernel::{Body, BodyIndex, F64, Quaternion, State, Vec3};
use dbd_scene::SceneModel;

use super::error::{ModesError, PROBE, WEIGHTS};

/// An entry of a matrix: row, column, value.
pub(super) type Entry = (usize, usize, f64);

/// A body's state moved along degree of freedom `c`: a translation along a world axis or a rotation about a body axis.
fn move_body(state: &mut State<SceneModel<F64>>, freedom: usize, by: f64) {
    let body = &mut state.bodies[freedom / 6];
    let axis = Vec3::axes()[freedom % 3];
    if freedom % 6 < 3 {
        body.position = body.position + axis * by;
    } else {
        let v = axis * (0.5 * by).sin();
        let turn = Quaternion::new((0.5 * by).cos(), v.x, v.y, v.z);
        body.orientation = body.orientation.product(turn);
    }
}

/// A body's velocity along degree of freedom `c`.
fn set_rate(state: &mut State<SceneModel<F64>>, freedom: usize, by: f64) {
    let body = &mut state.bodies[freedom / 6];
    let rate = Vec3::axes()[freedom % 3] * by;
    if freedom % 6 < 3 {
        body.velocity = rate;
    } else {
        body.angular_velocity = rate;
    }
}

/// 1/√m and 1/√I of every degree of freedom.
pub(super) fn roots(model: &SceneModel<F64>) -> Vec<f64> {
    let inertias = model
        .bodies
        .iter()
        .flat_map(|b| [b.mass, b.mass, b.mass, b.inertia.x, b.inertia.y, b.inertia.z]);
    inertias.map(|m| 1.0 / m.sqrt()).collect()
}

/// The state without velocities.
pub(super) fn at_rest(state: &State<SceneModel<F64>>) -> State<SceneModel<F64>> {
    let mut rest = state.clone();
    for body in &mut rest.bodies {
        (body.velocity, body.angular_velocity) = (Vec3::ZERO, Vec3::ZERO);
    }
    rest
}

/// A body's wrench as six numbers.
pub(super) fn six(wrench: &Wrench<f64>) -> [f64; 6] {
    let ([fx, fy, fz], [tx, ty, tz]) = (wrench.force.to_f64(), wrench.torque.to_f64());
    [fx, fy, fz, tx, ty, tz]
}

/// The pairs of bodies that an element, an interaction or an input couples.
pub(super) fn pairs(model: &SceneModel<F64>) -> BTreeSet<(usize, usize)> {
    let groups = model.groups.iter().map(|group| [group.a, group.b]);
    let torsions = model.torsions.iter().map(|spring| [spring.a, spring.b]);
    let inputs = model.inputs.iter().filter_map(|input| match input.kind {
        InputKind::JointTorque { a, b, .. } | InputKind::JointForce { a, b, .. } => Some([a, b]),
        _ => None,
    });
    let count = model.bodies.len();
    let is_body = |body: BodyIndex| body.row() < count;
    let all = groups.chain(torsions).chain(model.laws.pairs()).chain(inputs);
    all.filter(|[a, b]| is_body(*a) && is_body(*b) && a.row() != b.row())
        .map(|[a, b]| (a.row().min(b.row()), a.row().max(b.row())))
        .collect()
}

/// Each body with those that it is coupled to, and a colour per body: of one colour no two have a neighbour in common.
fn coloured(model: &SceneModel<F64>) -> (Vec<Vec<usize>>, Vec<usize>) {
    let mut near: Vec<Vec<usize>> = (0..model.bodies.len()).map(|body| vec![body]).collect();
    for (a, b) in pairs(model) {
        near[a].push(b);
        near[b].push(a);
    }
    let mut colours = vec![usize::MAX; near.len()];
    for body in 0..near.len() {
        let taken: BTreeSet<usize> =
            near[body].iter().flat_map(|one| &near[*one]).map(|other| colours[*other]).collect();
        colours[body] = (0..).find(|colour| !taken.contains(colour)).unwrap_or(0);
    }
    (near, colours)
}

/// Response of the mass-scaled wrenches, with the sign of a stiffness, to `probe(state, freedom, by)`; 36 entries per
/// pair of coupled bodies.
fn scaled(
    model: &SceneModel<F64>,
    state: &State<SceneModel<F64>>,
    probe: impl Fn(&mut State<SceneModel<F64>>, usize, f64),
) -> Result<Vec<Entry>, ModesError> {
    let (roots, rest) = (roots(model), at_rest(state));
    let (near, colours) = coloured(model);
    let mut entries = Vec::new();
    for colour in 0..colours.iter().max().map_or(0, |most| most + 1) {
        let moved: Vec<usize> = (0..colours.len()).filter(|row| colours[*row] == colour).collect();
        for axis in 0..6 {
            let at = |by: f64| {
                let mut state = rest.clone();
                moved.iter().for_each(|body| probe(&mut state, 6 * body + axis, by));
                wrenches(model, &state, 1e-3)
            };
            let mut sums = vec![[0.0; 6]; model.bodies.len()];
            for (times, weight) in (1_u8..).zip(WEIGHTS) {
                let by = f64::from(times) * PROBE;
                let (plus, minus) = (at(by)?, at(-by)?);
                for (sum, (plus, minus)) in sums.iter_mut().zip(plus.iter().zip(&minus)) {
                    let changes = six(plus).into_iter().zip(six(minus));
                    for (sum, (plus, minus)) in sum.iter_mut().zip(changes) {
                        *sum -= weight * (plus - minus) / PROBE;
                    }
                }
            }
            for body in &moved {
                let column = 6 * body + axis;
                for other in &near[*body] {
                    for (i, sum) in sums[*other].iter().enumerate() {
                        let row = 6 * other + i;
                        entries.push((row, column, sum * roots[row] * roots[column]));
                    }
                }
            }
        }
    }
    match entries.iter().all(|entry| entry.2.is_finite()) {
        true => Ok(entries),
        false => Err(ModesError::Range),
    }
}

/// `M⁻½·K·M⁻½` \[1/s²\].
///
/// # Errors
/// If a law has a rotor, a torsion angle is undefined, or an entry overflows.
pub(super) fn stiffness(
    model: &SceneModel<F64>,
    state: &State<SceneModel<F64>>,
) -> Result<Vec<Entry>, ModesError> {
    if let Some((law, Need::Passes)) = model.laws.memory() {
        return Err(ModesError::Rotor { law });
    }
    if let Some(row) = model.bodies.iter().position(Body::is_driven) {
        return Err(ModesError::Driven { row: row + 1 });
    }
    scaled(model, state, move_body)
}

/// `M⁻½·C·M⁻½` \[1/s\].
///
/// # Errors
/// As [`stiffness`].
pub(super) fn damping(
    model: &SceneModel<F64>,
    state: &State<SceneModel<F64>>,
) -> Result<Vec<Entry>, ModesError> {
    scaled(model, state, set_rate)
}
