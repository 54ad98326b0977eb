//! Angles that are probably degrees.

use std::f64::consts::TAU;

use crate::Scene;
use crate::lint::{Severity, Warning, short};

/// \[rad\] Nobody turns a body by more than once round; a turn written with three digits is one.
const WHOLE_TURN: f64 = 1.001 * TAU;

pub(super) fn judge(scene: &Scene, warnings: &mut Vec<Warning>) {
    for written in scene.written_angles.iter().filter(|written| written.angle.abs() > WHOLE_TURN) {
        let angle = written.angle;
        warnings.push(Warning {
            severity: Severity::Warning,
            name: written.owner.clone(),
            line: Some(written.line),
            text: format!(
                "`{}` of its orientation is {} rad, more than a whole turn: {} degrees are {} rad",
                written.key,
                short(angle),
                short(angle),
                short(angle.to_radians()),
            ),
        });
    }
}
