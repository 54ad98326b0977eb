//! The damper forces of moving ground alone.
//!
//! `(groups at moved ground, signals) => wrenches`. Part of the external forces: a rate jumps at a knot of a table, as
//! a force does.

use crate::forces::directions::springs;
use crate::forces::force_pair::Wrench;
use crate::geometry::Geometry;
use crate::model::{Group, ModelRef, Terms};
use crate::pose::{End, Places, placed};
use crate::space::{Linear as _, Vector as _};

/// Adds the force `c·(u·ṡ)·u` of each damper to moved ground, ṡ the ground's rate; torques in world axes.
pub(super) fn push<P: Geometry, T: Terms<P>>(
    model: &ModelRef<'_, P, T>,
    places: Places<'_, P>,
    wrenches: &mut [Wrench<P::Space>],
) {
    for (number, group) in model.groups.iter().enumerate() {
        let Group { a, b, .. } = *group;
        let moved = if a.anchor_row().is_some() { a } else { b };
        let (Some(_), Some(damper)) = (moved.anchor_row(), group.damper.row()) else { continue };
        let rate = End::new(model, places, moved, None).velocity;
        let Some(wrench) = wrenches.get_mut(if moved == a { b } else { a }.row()) else { continue };
        for i in 0..group.elements() {
            let (Some(element), Some(&damping)) =
                (placed(model, places, (number, group), i), model.dampers.get(damper + i))
            else {
                continue;
            };
            let known = (damping, model.clearance(group));
            let law = model.element(group.law, element.index);
            let springs = law.and_then(|law| springs(model, &law, &element.deformation, known));
            let Some(springs) = springs else { continue };
            let arm = if moved == a { element.arm_b } else { element.arm_a };
            let parts = springs.directions.into_iter().zip(springs.constants);
            for (u, [_, c]) in parts.take(springs.count) {
                let force = u * (c * u.dot(rate));
                wrench.force = wrench.force + force;
                wrench.torque = wrench.torque + arm.cross(force);
            }
        }
    }
}
