//! Which of a model's groups belong to which joint.
//!
//! `scene => per joint a range of groups`. Joints come first, in scene order; each expands into
//! one group or several, whose elements make up its TSDAs.

use std::ops::Range;

use dbd_scene::Scene;

/// The groups of each joint, in scene order.
#[must_use]
pub fn joint_groups(scene: &Scene) -> Vec<Range<usize>> {
    let groups = &scene.model.groups;
    let mut end = 0;
    let range_of_joint = |tsdas: usize| {
        let first = end;
        let mut elements = 0;
        while elements < tsdas && end < groups.len() {
            elements += groups[end].elements();
            end += 1;
        }
        first..end
    };
    scene.joints.iter().map(|joint| joint.tsdas).map(range_of_joint).collect()
}
