//! Input tables and sines that the run hardly reaches or its step does not resolve, and drives in scenes where a joint
//! may be missing.

use std::collections::BTreeSet;

use crate::facts::Facts;
use crate::lint::warning::{Severity, Warning, short};
use crate::scene::Scene;
use dbd_kernel::elements::input::InputKind;
use dbd_kernel::elements::source::SourceLaw;

/// A linear table may end beyond the run, but hardly by this many durations.
const FAR: f64 = 100.0;

/// Fewest steps per period.
const COARSE: f64 = 10.0;

pub(super) fn check(scene: &Scene, facts: &Facts, warnings: &mut Vec<Warning>) {
    undriven(scene, facts, warnings);
    sources(scene, warnings);
    for (row, info) in scene.inputs.iter().enumerate().filter(|(_, info)| info.table) {
        let input = &scene.model.inputs[usize::from(info.index.0)];
        let knots = &scene.model.knots[usize::from(input.knot)..][..usize::from(input.knots)];
        let late = knots.iter().filter(|knot| knot.time > scene.duration).count();
        let last = knots.last().map_or(0.0, |knot| knot.time);
        // With linear interpolation the first knot beyond the end is used as well.
        let is_linear = knots.iter().any(|knot| knot.slope != 0.0);
        let unused = if is_linear { late.saturating_sub(1) } else { late };
        if unused == 0 && (late == 0 || last <= FAR * scene.duration) {
            continue;
        }
        warnings.push(Warning {
            severity: Severity::Warning,
            name: format!("input `{}`", info.name),
            line: scene.file_lines.inputs.get(row).copied(),
            text: format!(
                "{late} of the {} times of its table are after the end of the run at {} s, the \
                 last at {} s; check that they are in s and that the `duration` is long enough",
                knots.len(),
                short(scene.duration),
                short(last)
            ),
        });
    }
}

/// Sines and periodic tables that the run hardly covers, or whose period its step does not resolve.
fn sources(scene: &Scene, warnings: &mut Vec<Warning>) {
    for source in &scene.model.sources {
        let row = usize::from(source.input.0);
        let (SourceLaw::Sine { period, .. } | SourceLaw::Periodic { period }) = source.law else {
            continue;
        };
        let is_table = matches!(source.law, SourceLaw::Periodic { .. });
        let is_coarse = |step: &f64| period < COARSE * step;
        let text = if let Some(step) = scene.step.filter(is_coarse) {
            format!(
                "its period of {} s is only {} steps of {} s; use a smaller `step`",
                short(period),
                short(period / step),
                short(step)
            )
        } else if period > if is_table { 1.0 } else { FAR } * scene.duration * (1.0 + 1e-9) {
            let what = if is_table { "table repeats" } else { "sine repeats" };
            format!(
                "its {what} every {} s, but the run ends at {} s; check that its time is in s and \
                 that the `duration` is long enough",
                short(period),
                short(scene.duration)
            )
        } else {
            continue;
        };
        let name = scene.inputs.get(row).map_or("", |info| &info.name);
        warnings.push(Warning {
            severity: Severity::Warning,
            name: format!("input `{name}`"),
            line: scene.file_lines.inputs.get(row).copied(),
            text,
        });
    }
}

/// Degrees of freedom without drive or spring in a scene whose joints or springs are driven.
fn undriven(scene: &Scene, facts: &Facts, warnings: &mut Vec<Warning>) {
    let is_drive = |kind: &InputKind<_>| {
        matches!(
            kind,
            InputKind::JointTorque { .. }
                | InputKind::JointForce { .. }
                | InputKind::Actuator { .. }
        )
    };
    let Some(first) = scene.model.inputs.iter().position(|input| is_drive(&input.kind)) else {
        return;
    };
    let [driven, springs] = [scene.inputs.len(), scene.raw_names.len() + scene.torsion_springs()];
    // Friction and stops count as springs; several at one joint count once.
    let laws = scene.model.laws.bodies().map(|ends| ends.map(|end| end.0));
    let laws = laws.collect::<BTreeSet<[u16; 2]>>().len();
    let acted_on = driven + springs + laws;
    let Some(freedoms) = facts.freedoms.filter(|freedoms| *freedoms > acted_on) else { return };
    let with_laws = match laws {
        0 => String::new(),
        laws => format!(", {laws} with interactions"),
    };
    let are = |count: usize| if count == 1 { "is" } else { "are" };
    warnings.push(Warning {
        severity: Severity::Note,
        name: format!("input `{}`", scene.inputs[first].name),
        line: scene.file_lines.inputs.get(first).copied(),
        text: format!(
            "joints leave {freedoms} degrees of freedom, of which {driven} {} driven and {springs} \
             {} sprung{with_laws}; check for a missing joint",
            are(driven),
            are(springs)
        ),
    });
}
