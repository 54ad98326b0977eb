//! Strength of the dampers of each element relative to the masses they act on.

use dbd_kernel::damping::{DampersOf, Strength, strengths, strengths_of_joints};
use dbd_kernel::{Geometry, Planar64, State};

use crate::runtime::SceneModel;
use crate::scene::Scene;

/// Strength of the dampers of a joint, a raw element or a torsion spring at t = 0.
#[derive(Clone, Debug, PartialEq)]
pub struct ElementDamping {
    /// Its label in messages: ``joint `wrist` ``.
    pub name: String,
    /// Its index in the order joints, raw elements, torsion springs, interactions.
    pub row: usize,
    /// \[1/s\] c/μ of its strongest damper, the rate at which this damper alone stops its bodies.
    pub rate: f64,
    /// \[1/s\] the same for all dampers along the motion of one that others cross obliquely; 0 without one:
    /// [`Strength::crossed`].
    pub crossed: f64,
}

/// Joints, raw elements, torsion springs and interactions with dampers in scene order, as stepped: in the plane of a
/// planar scene; `joint_wise` for joint-wise damping.
pub(super) fn dampings(scene: &Scene, joint_wise: bool) -> Vec<ElementDamping> {
    let raw = scene.joints.last().map_or(0, |joint| joint.groups.end);
    let springs = scene.joints.len() + scene.raw_names.len();
    let laws = springs + scene.torsion_names.len();
    let owners = scene.joints.iter().enumerate();
    let owners = owners.flat_map(|(row, joint)| joint.groups.clone().map(move |_| row));
    let owners: Vec<usize> = owners.collect();
    let mut found: Vec<ElementDamping> = Vec::new();
    let visit = |strength: Strength| {
        let (row, name) = match strength.of {
            DampersOf::Group(group) if group < raw => {
                let Some(&row) = owners.get(group) else { return };
                (row, format!("joint `{}`", scene.joints[row].name))
            }
            DampersOf::Group(group) => {
                (scene.joints.len() + group - raw, scene.raw_names[group - raw].clone())
            }
            DampersOf::Torsion(spring) => (springs + spring, scene.torsion_names[spring].clone()),
            DampersOf::Law(law) => (laws + law, scene.law_names[law].clone()),
        };
        match found.last_mut().filter(|last| last.row == row) {
            Some(last) => {
                last.rate = last.rate.max(strength.rate);
                last.crossed = last.crossed.max(strength.crossed);
            }
            None => {
                let (rate, crossed) = (strength.rate, strength.crossed);
                found.push(ElementDamping { name, row, rate, crossed });
            }
        }
    };
    match &scene.planar {
        Some(planar) => each::<Planar64>(&planar.model.convert(), joint_wise, visit),
        None => each(&scene.model, joint_wise, visit),
    }
    found
}

fn each<P: Geometry>(model: &SceneModel<P>, joint_wise: bool, visit: impl FnMut(Strength)) {
    let state = State::initial(model);
    if joint_wise {
        strengths_of_joints(model, &state, visit);
    } else {
        strengths(model, &state, visit);
    }
}
