//! Bodies that cannot move because joints lock each other, and joints that leave two bodies no motion.

use crate::facts::Facts;
use crate::lint::warning::{Severity, Warning};
use crate::scene::Scene;

/// Most other bodies listed in a warning.
const NAMED: usize = 4;

pub(super) fn check(scene: &Scene, facts: &Facts, warnings: &mut Vec<Warning>) {
    for joints in &facts.jammed {
        let [first, .., last] = joints[..] else { continue };
        let [first, last] = [first, last].map(|row| (row, &scene.joints[row]));
        let [a, b] = &last.1.between;
        warnings.push(Warning {
            severity: Severity::Warning,
            name: format!("joint `{}`", last.1.name),
            line: scene.line_of_joint(last.0),
            text: format!(
                "together with joint `{}` leaves `{a}` and `{b}` no relative motion: hinges \
                 between two bodies must share one axis; check the bodies, or use a `fixed` joint",
                first.1.name
            ),
        });
    }
    let Some((first, others)) = facts.locked.split_first() else { return };
    let name = |row: &usize| format!("`{}`", scene.body_names[*row]);
    let mut names: Vec<_> = others.iter().take(NAMED).map(name).collect();
    if others.len() > NAMED {
        names.push(format!("{} more", others.len() - NAMED));
    }
    let and = if names.is_empty() {
        String::new()
    } else {
        format!(", and {} cannot move either", names.join(", "))
    };
    warnings.push(Warning {
        severity: Severity::Warning,
        name: format!("body {}", name(first)),
        line: scene.line_of_body(*first),
        text: format!(
            "is locked: the joints leave it no degree of freedom at the initial pose{and}; check \
             their bodies, types and axes"
        ),
    });
}
