//! Angles that are probably degrees.

use crate::lint::warning::{Severity, Warning, short};
use crate::scene::Scene;

pub(super) fn check(scene: &Scene, warnings: &mut Vec<Warning>) {
    for written in &scene.written_angles {
        let angle = written.angle;
        warnings.push(Warning {
            severity: Severity::Warning,
            name: written.owner.clone(),
            line: Some(written.line),
            text: format!(
                "{} is {} rad, more than one revolution: {} deg would be {} rad",
                written.key,
                short(angle),
                short(angle),
                short(angle.to_radians()),
            ),
        });
    }
}
