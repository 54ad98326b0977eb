//! Strain energy fractions of a mode by element.
//!
//! `(scene, state, shape) => φᵀ·K_e·φ / φᵀ·K·φ per element`, K_e by differences of the wrenches of the element alone,
//! so that preloads count. The parts of gravity, loads and inputs make up the rest to 1.

use dbd_kernel::elements::input::InputKind;
use dbd_kernel::forces::wrenches;
use dbd_kernel::laws::{ForcePair, Instant, Laws as _};
use dbd_kernel::model::Law;
use dbd_kernel::{BodyIndex, F64, Geometry as _, Quaternion, State, Vec3};
use dbd_scene::{Scene, SceneModel};
use nalgebra::DVectorView;
use std::ops::Range;

use super::error::{ModesError, PROBE, WEIGHTS};
use super::matrices::{at_rest, roots, six};

/// A joint, a raw element, a torsion spring or an interaction of a scene.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct Element {
    /// Its name in messages: ``joint `wrist` ``.
    pub name: String,
    part: Part,
}

#[derive(Clone, Debug, PartialEq, Eq)]
enum Part {
    Groups(Range<usize>),
    Torsion(usize),
    Law(usize),
}

/// The elements of a scene: joints, raw elements, torsion springs, interactions.
#[must_use]
pub fn elements(scene: &Scene) -> Vec<Element> {
    let raw = scene.joints.last().map_or(0, |joint| joint.groups.end);
    let joints = scene.joints.iter().map(|joint| {
        let name = format!("joint `{}`", joint.name);
        Element { name, part: Part::Groups(joint.groups.clone()) }
    });
    let raws = scene.raw_names().iter().zip(raw..);
    let raws = raws.map(|(name, group)| (name, Part::Groups(group..group + 1)));
    let springs = scene.torsion_names.iter().enumerate();
    let springs = springs.map(|(row, name)| (name, Part::Torsion(row)));
    let laws = scene.law_names().iter().enumerate().map(|(row, name)| (name, Part::Law(row)));
    let others = raws.chain(springs).chain(laws);
    joints.chain(others.map(|(name, part)| Element { name: name.clone(), part })).collect()
}

/// The model with an element's stiffness multiplied by a factor; `None` for an interaction, whose law defines it.
#[must_use]
pub fn softened(
    model: &SceneModel<F64>,
    element: &Element,
    factor: f64,
) -> Option<SceneModel<F64>> {
    let mut model = model.clone();
    match &element.part {
        Part::Groups(groups) => {
            for group in model.groups[groups.clone()].iter().copied() {
                for row in (usize::from(group.element)..).take(group.elements()) {
                    *match group.law {
                        Law::Tsda => &mut model.tsdas[row].stiffness,
                        Law::PointBushing => &mut model.bushings[row].stiffness,
                        Law::Revolute => &mut model.revolutes[row].stiffness,
                        Law::Universal => &mut model.universals[row].stiffness,
                        Law::PointOnLine => &mut model.lines[row].stiffness,
                    } *= factor;
                }
            }
        }
        Part::Torsion(row) => model.torsions[*row].stiffness *= factor,
        Part::Law(_) => return None,
    }
    Some(model)
}

/// The model of single elements: without gravity, loads, force inputs and elements.
fn bare(model: &SceneModel<F64>) -> SceneModel<F64> {
    let mut bare = model.clone();
    bare.gravity.clear();
    bare.loads.clear();
    bare.groups.clear();
    bare.laws = Default::default();
    for spring in &mut bare.torsions {
        (spring.stiffness, spring.preload) = (0.0, 0.0);
    }
    for input in &mut bare.inputs {
        // Moved ground stays in place; applied forces are removed.
        if !matches!(input.kind, InputKind::Anchor { .. }) {
            input.kind = InputKind::Anchor { direction: Vec3::ZERO };
        }
    }
    bare
}

/// All bodies moved along a motion \[m, rad\] of six numbers per body.
fn moved(rest: &State<SceneModel<F64>>, motion: &[[f64; 6]], by: f64) -> State<SceneModel<F64>> {
    let mut state = rest.clone();
    for (body, [x, y, z, a, b, c]) in state.bodies.iter_mut().zip(motion) {
        body.position = body.position + Vec3::new(*x, *y, *z) * by;
        let turn = Vec3::new(*a, *b, *c) * by;
        let angle = turn.dot(turn).sqrt();
        let share = if angle > 0.0 { (0.5 * angle).sin() / angle } else { 0.5 };
        let v = turn * share;
        let turn = Quaternion::new((0.5 * angle).cos(), v.x, v.y, v.z);
        body.orientation = body.orientation.product(turn);
    }
    state
}

/// The power \[N·m\] of the wrenches of each law along a motion.
fn law_powers(
    model: &SceneModel<F64>,
    state: &State<SceneModel<F64>>,
    motion: &[[f64; 6]],
) -> Vec<f64> {
    let bodies = state.bodies.iter();
    let frames: Vec<_> = bodies.map(|body| F64::frame(&body.position, &body.orientation)).collect();
    let instant = Instant { frames: &frames, bodies: &state.bodies, signals: &state.signals };
    let mut powers = Vec::new();
    model.laws.look_at_all(&state.laws, &mut |_, law| {
        let seen = law.seen(instant);
        let force_pair = seen.as_ref().and_then(|seen| law.force_pair(seen));
        let along = |body: BodyIndex, force: Vec3<f64>, torque: Vec3<f64>| {
            let Some([x, y, z, a, b, c]) = motion.get(body.row()).copied() else { return 0.0 };
            let torque = state.bodies[body.row()].orientation.rotation().to_body(torque);
            force.dot(Vec3::new(x, y, z)) + torque.dot(Vec3::new(a, b, c))
        };
        let power = |[a, b]: [BodyIndex; 2], force_pair: &ForcePair<f64>| {
            along(a, force_pair.force, force_pair.torque_a)
                - along(b, force_pair.force, force_pair.torque_b)
        };
        let mut sum = force_pair.map_or(0.0, |force_pair| power(law.bodies(), &force_pair));
        if let Some(seen) = &seen {
            for branch in law.branches(seen).iter() {
                let Some(seen) = seen.between(branch.bodies) else { continue };
                sum += power(branch.bodies, &seen.pull(&branch.direction, branch.tension));
            }
        }
        powers.push(sum);
    });
    powers
}

/// Fractions of the strain energy of a shape, scaled by √m and √I, per element; 0 if the total is 0.
///
/// # Errors
/// If a torsion angle is undefined.
pub fn strain_shares(
    model: &SceneModel<F64>,
    state: &State<SceneModel<F64>>,
    elements: &[Element],
    shape: DVectorView<'_, f64>,
) -> Result<Vec<f64>, ModesError> {
    let roots = roots(model);
    let raw: Vec<f64> = shape.iter().zip(&roots).map(|(part, root)| part * root).collect();
    let largest = raw.iter().fold(0.0, |most: f64, part| most.max(part.abs()));
    if largest == 0.0 {
        return Ok(vec![0.0; elements.len()]);
    }
    let motion: Vec<[f64; 6]> =
        raw.chunks_exact(6).map(|body| std::array::from_fn(|i| body[i] / largest)).collect();
    let rest = at_rest(state);
    let probes: Vec<(f64, State<SceneModel<F64>>)> = (1_u8..)
        .zip(WEIGHTS)
        .flat_map(|(times, weight)| {
            let by = f64::from(times) * PROBE;
            [(weight, moved(&rest, &motion, by)), (-weight, moved(&rest, &motion, -by))]
        })
        .collect();
    // −φ·∂w/∂φ of a model's wrenches.
    let stiffness = |model: &SceneModel<F64>| -> Result<f64, ModesError> {
        let mut sum = 0.0;
        for (weight, state) in &probes {
            let wrenches = wrenches(model, state, 1e-3)?;
            let powers = wrenches.iter().map(six).zip(&motion);
            let power: f64 =
                powers.flat_map(|(w, m)| w.into_iter().zip(*m)).map(|(w, m)| w * m).sum();
            sum -= weight * power / PROBE;
        }
        Ok(sum)
    };
    let mut laws = vec![0.0; model.laws.bodies().count()];
    for (weight, state) in &probes {
        let powers = law_powers(model, state, &motion);
        laws.iter_mut().zip(powers).for_each(|(sum, power)| *sum -= weight * power / PROBE);
    }
    let whole = stiffness(model)?;
    let mut single = bare(model);
    let mut parts = Vec::with_capacity(elements.len());
    for element in elements {
        parts.push(match &element.part {
            Part::Groups(groups) => {
                single.groups = model.groups[groups.clone()].to_vec();
                let part = stiffness(&single)?;
                single.groups.clear();
                part
            }
            Part::Torsion(row) => {
                let none = std::mem::replace(&mut single.torsions[*row], model.torsions[*row]);
                let part = stiffness(&single)?;
                single.torsions[*row] = none;
                part
            }
            Part::Law(row) => laws[*row],
        });
    }
    let share = |part: f64| if whole == 0.0 { 0.0 } else { part / whole };
    Ok(parts.into_iter().map(share).collect())
}
