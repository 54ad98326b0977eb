//! Stops that are engaged at t = 0.

use crate::interactions::interactions_at_start;
use crate::lint::warning::{Severity, Warning, short};
use crate::scene::Scene;

pub(super) fn check(scene: &Scene, warnings: &mut Vec<Warning>) {
    // A scene in equilibrium may rest on its stops.
    if scene.settled.is_some() {
        return;
    }
    for (row, start) in interactions_at_start(scene).iter().enumerate() {
        let Some((depth, unit)) = start.depth.filter(|(depth, _)| *depth > 0.0) else { continue };
        let (load, load_unit) =
            if start.force > 0.0 { (start.force, "N") } else { (start.torque, "N·m") };
        warnings.push(Warning {
            severity: Severity::Warning,
            name: scene.law_names.get(row).cloned().unwrap_or_default(),
            line: scene.line_of_interaction(row),
            text: format!(
                "is engaged at t = 0: a depth of {} {unit}, {} {load_unit}; check its geometry, or start in \
                 equilibrium with `settle = true`",
                short(depth),
                short(load)
            ),
        });
    }
}
