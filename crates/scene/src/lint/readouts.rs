//! Read-outs of undamped joint forces.

use dbd_kernel::readouts::Readout;

use crate::lint::warning::{Severity, Warning};
use crate::scene::Scene;

pub(super) fn check(scene: &Scene, warnings: &mut Vec<Warning>) {
    for info in &scene.readouts {
        let Readout::JointForce { group } = info.readout else { continue };
        let number = group.row();
        let Some(joint) = scene.joints.iter().find(|joint| joint.groups.contains(&number)) else {
            continue;
        };
        if scene.model.groups[number].damper.row().is_some() {
            continue;
        }
        warnings.push(Warning {
            severity: Severity::Note,
            name: format!("read-out `{}`", info.name),
            line: scene.file_lines.readouts.get(info.table).copied(),
            text: format!(
                "joint `{}` is undamped, so its force oscillates about the load; give the joint a \
                 `damping_ratio` with a `frequency`",
                joint.name
            ),
        });
    }
}
