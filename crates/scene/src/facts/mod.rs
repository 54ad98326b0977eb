//! Facts about a scene without running it.
//!
//! `scene => counts of freedoms and equations, per joint its lengths and their rates, islands`.
//! [`warnings`](crate::warnings) reports probable mistakes.

mod damping;
mod islands;
mod lengths;
mod mobility;
mod pose;
mod stiffness;

use crate::scene::Scene;

pub use damping::ElementDamping;
pub use islands::Island;
pub(crate) use lengths::GroupFacts;
pub(crate) use pose::{axis_w, frames};
pub use stiffness::{
    ElementFrequency, JointElement, element_frequencies, joint_elements, with_stiffer_joints,
};

/// Facts about a scene without running it.
#[derive(Clone, Debug, PartialEq)]
pub struct Facts {
    /// Equations of motion: 6 per body that is not driven.
    pub equations: usize,
    /// Equations of a solver with constraints: those and one per independent constraint (Franco & Degani 2026,
    /// Table 7a); where [`Self::freedoms`] is `None`, one per constraint.
    pub constraint_equations: usize,
    /// Degrees of freedom at and near the initial pose: redundant constraints of loops count once, and motions that
    /// exist to first order only, as at a singular pose, do not count. `None` if too many bodies are connected for a
    /// quick answer.
    pub freedoms: Option<usize>,
    /// 6 per body less the rank of the joints' constraints at the initial pose; more than [`Self::freedoms`] at a
    /// singular pose.
    pub first_order_freedoms: Option<usize>,
    /// Indices of bodies that cannot move although no joint fixes them to a body at rest: joints to several others
    /// do.
    pub locked: Vec<usize>,
    /// Indices of joints between two bodies that each leave a rotation or a translation, but together leave none.
    pub jammed: Vec<Vec<usize>>,
    /// The joints in scene order.
    pub joints: Vec<JointFacts>,
    /// Sets of connected bodies, in the order of their first bodies.
    pub islands: Vec<Island>,
    /// Natural frequency of each joint, raw element and torsion spring alone.
    pub frequencies: Vec<ElementFrequency>,
}

/// Facts about a joint without running it.
#[derive(Clone, Debug, PartialEq)]
pub struct JointFacts {
    /// \[m\] free length of its elements.
    pub free_length: f64,
    /// \[m\] the shortest and the longest of its elements at the initial pose; of a point on a
    /// line the distance from it.
    pub initial_length: [f64; 2],
    /// \[m\] the largest |L − L0| at the initial pose.
    pub assembly_error: f64,
    /// \[m/s\] the largest rate of a length at t = 0, from the velocities of the bodies.
    pub stretching_rate: f64,
}

impl Facts {
    /// The element with the highest natural frequency; `None` without elements.
    #[must_use]
    pub fn fastest(&self) -> Option<&ElementFrequency> {
        self.frequencies.iter().max_by(|a, b| a.frequency.total_cmp(&b.frequency))
    }

    /// \[rad/s\] the median of the joints' frequencies, without joints that of all elements.
    #[must_use]
    pub fn median_frequency(&self) -> Option<f64> {
        let count = if self.joints.is_empty() { self.frequencies.len() } else { self.joints.len() };
        let mut sorted: Vec<f64> =
            self.frequencies.iter().take(count).map(|element| element.frequency).collect();
        sorted.sort_by(f64::total_cmp);
        sorted.get(sorted.len() / 2).copied().filter(|median| *median > 0.0)
    }
}

/// Strength of the dampers of joints, raw elements and torsion springs at the initial pose, in scene order.
#[must_use]
pub fn element_dampings(scene: &Scene) -> Vec<ElementDamping> {
    damping::dampings(scene, false)
}

/// [`element_dampings`] for joint-wise damping: the dampers of a joint do not cross one another.
#[must_use]
pub fn joint_dampings(scene: &Scene) -> Vec<ElementDamping> {
    damping::dampings(scene, true)
}

/// Counts, lengths and islands.
#[must_use]
pub fn facts(scene: &Scene) -> Facts {
    let equations = 6 * scene.model.bodies.iter().filter(|body| !body.is_driven()).count();
    let constraints: usize = scene.joints.iter().map(|joint| joint.holds as usize).sum();
    let groups = lengths::groups(scene);
    let joints = scene.joints.iter().map(|joint| {
        let groups = &groups[joint.groups.clone()];
        let all = groups.iter().fold(GroupFacts::NONE, |all, group| all.with(group));
        JointFacts {
            free_length: all.free_length,
            initial_length: [all.shortest, all.longest],
            assembly_error: joint.assembly_error,
            stretching_rate: all.stretching_rate,
        }
    });
    let held = mobility::held(scene);
    let first_order = held.as_ref().map(|held| held.mobility.first_order);
    Facts {
        equations,
        constraint_equations: equations + first_order.map_or(constraints, |free| equations - free),
        freedoms: held.as_ref().map(|held| held.mobility.freedoms),
        first_order_freedoms: first_order,
        jammed: held.as_ref().map_or(Vec::new(), |held| held.jammed.clone()),
        locked: held.map_or(Vec::new(), |held| held.locked),
        joints: joints.collect(),
        islands: islands::islands(scene),
        frequencies: element_frequencies(scene),
    }
}

/// Lengths of the elements of each group.
pub(crate) fn groups(scene: &Scene) -> Vec<GroupFacts> {
    lengths::groups(scene)
}
