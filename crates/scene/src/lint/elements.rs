//! Joints and raw elements without effect, overstretched at t = 0 or separated by the initial velocities.

use dbd_kernel::model::{Group, Law};

use crate::facts::{self, GroupFacts};
use crate::lint::warning::{Severity, Warning, short};
use crate::scene::Scene;

/// \[m/s\] Velocities given with three digits separate a joint more slowly.
const STRETCHING_RATE: f64 = 1e-3;

pub(super) fn check(scene: &Scene, warnings: &mut Vec<Warning>) {
    let groups = facts::groups(scene);
    for (number, joint) in scene.joints.iter().enumerate() {
        let mut warn = |severity, text: &str| {
            let line = scene.file_lines.joints.get(number).copied();
            let name = format!("joint `{}`", joint.name);
            warnings.push(Warning { severity, name, line, text: text.into() });
        };
        let Some(group) = scene.model.groups.get(joint.groups.start) else { continue };
        if stiffness(scene, group) == 0.0 {
            let text = if group.damper.row().is_none() {
                "has neither stiffness nor damping: it has no effect"
            } else {
                "has damping but no stiffness: it constrains no position"
            };
            warn(Severity::Warning, text);
        }
        if joint.mass_left_out > 0.0 {
            let mass = short(joint.mass_left_out);
            warn(Severity::Note, &format!("is a bushing: the {mass} kg of its spider are ignored"));
        }
        let facts = &groups[joint.groups.clone()];
        let rate = facts.iter().map(|group| group.stretching_rate).fold(0.0, f64::max);
        if rate > STRETCHING_RATE {
            let rate = short(rate);
            warn(
                Severity::Note,
                &format!("the initial velocities separate it at {rate} m/s: it will oscillate"),
            );
        }
    }
    let raw = scene.joints.last().map_or(0, |joint| joint.groups.end);
    let mut lines = scene.file_lines.raws();
    let rows = scene.model.groups[raw..].iter().zip(&groups[raw..]);
    for ((group, facts), name) in rows.zip(&scene.raw_names) {
        let line = lines.next().copied();
        let mut warn = |text: String| {
            let (name, severity) = (name.clone(), Severity::Warning);
            warnings.push(Warning { severity, name, line, text });
        };
        if stiffness(scene, group) == 0.0 && group.damper.row().is_none() {
            warn("has neither stiffness nor damping: it has no effect".into());
        }
        if overstretched(facts) {
            warn(format!(
                "is {} m long at t = 0, more than twice its free length of {} m; check that its \
                 points are in the axes of their bodies",
                short(facts.longest),
                short(facts.free_length)
            ));
        }
    }
}

/// Stretched by more than its own free length.
fn overstretched(facts: &GroupFacts) -> bool {
    facts.free_length > 0.0 && facts.longest > 2.0 * facts.free_length
}

/// \[N/m\] stiffness of an element; the elements of a group share one.
pub(super) fn stiffness(scene: &Scene, group: &Group) -> f64 {
    let element = usize::from(group.element);
    match group.law {
        Law::Tsda => scene.model.tsdas[element].stiffness,
        Law::PointBushing => scene.model.bushings[element].stiffness,
        Law::Revolute => scene.model.revolutes[element].stiffness,
        Law::Universal => scene.model.universals[element].stiffness,
        Law::PointOnLine => scene.model.lines[element].stiffness,
    }
}
