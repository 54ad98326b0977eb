//! What is known of a scene without running it.
//!
//! `scene => counts of freedoms and equations, per joint its lengths and how its velocities pull
//! at it, islands`. Facts only; what is probably not meant is said by [`warnings`](crate::warnings).

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

/// What is known of a scene without running it.
#[derive(Clone, Debug, PartialEq)]
pub struct Facts {
    /// Equations of motion: 6 per body.
    pub equations: usize,
    /// Equations that a solver with constraints has: 6 per body and one per independent constraint
    /// (Franco & Degani 2026, Table 7a); where [`Self::freedoms`] is `None`, one per constraint.
    pub constraint_equations: usize,
    /// What the joints leave free at the initial pose and near it: constraints that loops imply count once, and
    /// motions that exist to first order only, as at a singular pose, do not count. `None` where more bodies hang
    /// together than that takes a moment for.
    pub freedoms: Option<usize>,
    /// 6 per body less the rank of the joints' constraints at the initial pose; more than
    /// [`Self::freedoms`] where that pose is singular.
    pub first_order_freedoms: Option<usize>,
    /// Rows of the bodies that cannot move, though no joint holds them rigidly to what stands still:
    /// stiff joints to several others do.
    pub locked: Vec<usize>,
    /// Rows of joints between two bodies that each leave a turn or a slide and together leave none.
    pub jammed: Vec<Vec<usize>>,
    /// The joints in scene order.
    pub joints: Vec<JointFacts>,
    /// Bodies that hang together, in the order of their first bodies.
    pub islands: Vec<Island>,
    /// Joints, raw elements and torsion springs, how fast each alone would vibrate.
    pub frequencies: Vec<ElementFrequency>,
}

/// What is known of a joint without running it.
#[derive(Clone, Debug, PartialEq)]
pub struct JointFacts {
    /// \[m\] free length of its elements.
    pub free_length: f64,
    /// \[m\] the shortest and the longest of its elements at the initial pose; of a point on a
    /// line the distance from it.
    pub initial_length: [f64; 2],
    /// \[m\] the largest |L − L0| at the initial pose.
    pub assembly_error: f64,
    /// \[m/s\] the largest rate of a length at t = 0: what the bodies' velocities do to it.
    pub stretching_rate: f64,
}

impl Facts {
    /// The element that alone would vibrate fastest; `None` where there are none.
    #[must_use]
    pub fn fastest(&self) -> Option<&ElementFrequency> {
        self.frequencies.iter().max_by(|a, b| a.frequency.total_cmp(&b.frequency))
    }

    /// \[rad/s\] the median of the joints' frequencies, of all elements where there are no joints.
    #[must_use]
    pub fn median_frequency(&self) -> Option<f64> {
        let count = if self.joints.is_empty() { self.frequencies.len() } else { self.joints.len() };
        let mut sorted: Vec<f64> =
            self.frequencies.iter().take(count).map(|element| element.frequency).collect();
        sorted.sort_by(f64::total_cmp);
        sorted.get(sorted.len() / 2).copied().filter(|median| *median > 0.0)
    }
}

/// Joints, raw elements and torsion springs that have dampers, in scene order: how strong these
/// are at the initial pose.
#[must_use]
pub fn element_dampings(scene: &Scene) -> Vec<ElementDamping> {
    damping::dampings(scene, false)
}

/// [`element_dampings`] as joint-wise damping has them: the dampers of a joint do not cross one
/// another.
#[must_use]
pub fn joint_dampings(scene: &Scene) -> Vec<ElementDamping> {
    damping::dampings(scene, true)
}

/// Counts, lengths and islands.
#[must_use]
pub fn facts(scene: &Scene) -> Facts {
    let equations = 6 * scene.model.bodies.len();
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

/// What is known of each group's elements.
pub(crate) fn groups(scene: &Scene) -> Vec<GroupFacts> {
    lengths::groups(scene)
}
