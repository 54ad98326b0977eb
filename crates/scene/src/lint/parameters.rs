//! Unused parameters.

use crate::lint::warning::{Severity, Warning};
use crate::scene::Scene;

pub(super) fn check(scene: &Scene, warnings: &mut Vec<Warning>) {
    let unused = scene.parameters.iter().filter(|parameter| !parameter.used);
    warnings.extend(unused.map(|parameter| Warning {
        severity: Severity::Warning,
        name: format!("parameter `{}`", crate::shortened(&parameter.name)),
        line: parameter.line,
        text: "is unused: no value of the scene refers to it".into(),
    }));
}
