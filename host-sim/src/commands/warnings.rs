//! Warnings of probable mistakes in a scene, its step, or the results of its run.
//!
//! `(scene, method, step, openings) => sentences`. The only source of warnings: `check`, `run` and
//! `trade` report those that they can evaluate. No warning changes an exit code.

use dbd_kernel::damping::Damping;
use dbd_plant::digits::{approximate, significant};
use dbd_plant::monitor::{OPENED, Opening, Reversal, Turning};
use dbd_plant::time::{display, rounded};
use dbd_plant::{Frequencies, Method, Named as _, OrientationName, SchemeName};
use dbd_scene::default_step::LARGEST_TURN;
use dbd_scene::{ElementDamping, Facts, OneSided, Scene, Severity};
use dbd_study::compliance::{Deformation, stretches};
use dbd_study::limits::Limits;

use crate::commands::rounding::{self, COMPOSED, named};

/// h·c/μ up to which slow motion is accurate to 1 %: for interacting dampers, with all that act in parallel, on
/// random mechanisms (`tests/dynamics/strong_dampers.rs`), and for each damper with compositions, by the table in
/// docs/schemes.md.
const STRONGEST_CROSSED: f64 = 2.5;
const STRONGEST_COMPOSED: f64 = 0.3;

/// Largest number of bodies for which the highest frequency is computed if its bound would warn and its estimate does
/// not: takes a tenth of a second.
const SOLVED: usize = 60;

/// Warnings about the scene itself.
#[must_use]
pub fn of_scene(scene: &Scene) -> Vec<String> {
    let [warnings, _] = with_notes(scene, &dbd_scene::facts(scene));
    warnings
}

/// Warnings and notes about the scene itself, if its facts
/// are already computed.
#[must_use]
pub fn with_notes(scene: &Scene, facts: &Facts) -> [Vec<String>; 2] {
    let all = dbd_scene::warnings_with(scene, facts);
    let [mut warnings, notes] = [Severity::Warning, Severity::Note].map(|severity| {
        let of_it = all.iter().filter(|warning| warning.severity == severity);
        of_it.map(ToString::to_string).collect::<Vec<_>>()
    });
    warnings.extend(of_stiffness(scene));
    [warnings, notes]
}

/// Joints that the forces at t = 0 open by more than [`OPENED`] of their free length.
fn of_stiffness(scene: &Scene) -> Option<String> {
    let mut soft = stretches(scene);
    soft.retain(|deformation| deformation.share() > OPENED);
    soft.sort_by(|a, b| b.share().total_cmp(&a.share()));
    let (worst, others) = soft.split_first()?;
    let name = |deformation: &Deformation| format!("`{}`", scene.joints[deformation.joint].name);
    let line = scene.line_of_joint(worst.joint).map(|line| format!(" (line {line})"));
    let mut text = format!(
        "joint {}{}: deflects by {} m under the forces at t = 0, {} % of its free length of {} m",
        name(worst),
        line.unwrap_or_default(),
        significant(worst.extension, 3),
        significant(100.0 * worst.share(), 3),
        significant(worst.free_length, 4),
    );
    if let Some(named) = named(others.iter().map(name)) {
        text += &format!("; deflections above {} % also in {named}", 100.0 * OPENED);
    }
    Some(text + ": check the units: stiffness in N/m, masses in kg, forces in N")
}

/// Errors of a step at t = 0: vibration above the scheme's stability limit, too much rotation per
/// step. `whose` begins the sentence: `the step`.
#[must_use]
pub fn of_step(
    scene: &Scene,
    frequencies: &Frequencies,
    method: &Method,
    step: f64,
    whose: &str,
) -> Vec<String> {
    let limit = method.stability_limit();
    let least = frequencies.estimate * step;
    let mut highest = frequencies.bound;
    if least <= limit && limit < highest * step && scene.model.bodies.len() <= SOLVED {
        highest = highest.min(Limits::of(scene).highest());
    }
    let most = highest * step;
    let mut warnings = Vec::new();
    if most > limit {
        // The estimate is never above the exact frequency. A run may still succeed: exact planar motion, for
        // example, does not excite vibration out of the plane.
        let (z, of, then) = match least > limit {
            true => (least, "estimate", "this vibration grows without bound once it is excited"),
            false => (most, "bound", "the run may diverge"),
        };
        warnings.push(format!(
            "{whose} of {} exceeds the stability limit of {}: ω·h = {} with the {of} of the highest frequency \
             at t = 0, the limit is {}: {then}; use a step of at most {}",
            display(step),
            method.scheme_name(),
            significant(z, 3),
            significant(limit, 4),
            approximate(limit / highest),
        ));
    }
    warnings.extend(of_damping(scene, method, step, whose));
    warnings.extend(rounding::of_step(scene, frequencies, method, step, whose));
    warnings.extend(frequencies.warning(scene, step).map(|turn| turn + of_angles(method)));
    warnings
}

/// Dampers so strong that the damped motion is too fast: all dampers for a composition, whose damper passes
/// enclose the step, interacting dampers for the others; within a joint, joint-wise damping has no such error.
fn of_damping(scene: &Scene, method: &Method, step: f64, whose: &str) -> Option<String> {
    if matches!(method.damping(), Damping::Explicit | Damping::Implicit) {
        return None;
    }
    let composed = COMPOSED.contains(&method.scheme_name());
    let most = if composed { STRONGEST_COMPOSED } else { STRONGEST_CROSSED };
    let rate = |element: &ElementDamping| if composed { element.rate } else { element.crossed };
    let mut strong = match method.damping() {
        Damping::JointWise => dbd_scene::joint_dampings(scene),
        _ => dbd_scene::element_dampings(scene),
    };
    strong.retain(|element| rate(element) * step > most);
    strong.sort_by(|a, b| rate(b).total_cmp(&rate(a)));
    let (worst, others) = strong.split_first()?;
    let line = scene.line_of_element(worst.row).map(|line| format!(" (line {line})"));
    let mut text = format!(
        "{whose} of {} is long for the dampers of {}{}: h·c/μ = {}{}",
        display(step),
        worst.name,
        line.unwrap_or_default(),
        significant(rate(worst) * step, 3),
        if composed { "" } else { " including all dampers that act in parallel" },
    );
    if let Some(named) = named(others.iter().map(|element| element.name.clone())) {
        text += &format!(", and of {named}");
    }
    let shorter = approximate(most / rate(worst));
    text += &format!("; above {most} the damped motion may be too fast by more than 1 %");
    text += &match composed {
        true => {
            format!(" with {}: use leapfrog, or a step of at most {shorter}", method.scheme_name())
        }
        false => format!(
            " if dampers interact: use a step of at most {shorter}, or {}",
            SchemeName::GeneralizedAlpha.name()
        ),
    };
    Some(text)
}

/// Warnings about a run: joints that opened by more than [`OPENED`] of their
/// free length. Bushings have no free length and stay accurate at any opening.
#[must_use]
pub fn of_run(scene: &Scene, openings: &[Opening]) -> Vec<String> {
    let with_length = openings.iter().filter(|opening| opening.free_length > 0.0);
    let mut open: Vec<_> = with_length.filter_map(|o| Some((o, o.since?))).collect();
    open.sort_by(|a, b| b.0.share().total_cmp(&a.0.share()));
    let Some(((worst, since), others)) = open.split_first() else { return Vec::new() };
    let name = |opening: &Opening| format!("`{}`", scene.joints[opening.joint].name);
    let mut text = format!(
        "joint {} opened by {} m at t = {}, {} % of its free length of {} m; beyond {} % from t = {} on",
        name(worst),
        significant(worst.extension, 3),
        display(rounded(worst.time, 6)),
        significant(100.0 * worst.share(), 3),
        significant(worst.free_length, 4),
        100.0 * OPENED,
        display(rounded(*since, 6)),
    );
    if let Some(named) = named(others.iter().map(|(other, _)| name(other))) {
        text += &format!("; so did {named}");
    }
    vec![text + ": stiffness, masses and loads are inconsistent, or the step is too long"]
}

/// Springs named as ropes, tyres or stops that acted in the direction in which the real part cannot.
#[must_use]
pub fn of_springs(reversals: &[Reversal]) -> Vec<String> {
    let sentence = |one: &Reversal| {
        let (since, at_first) = one.since?;
        let OneSided { name, line, word, pulls, .. } = &one.spring;
        let (does, slack) = if *pulls { ("pushed", "slack") } else { ("pulled", "off") };
        let force = |newtons: f64| format!("{} N", significant(newtons.abs(), 3));
        Some(format!(
            "{name} (line {line}): {does} from t = {} on, there with {}, at most with {} at t = {}, which no {word} \
             does: a real one is {slack} then; use a `clearance` or another model that releases it",
            display(rounded(since, 6)),
            force(at_first),
            force(one.most.0),
            display(rounded(one.most.1, 6)),
        ))
    };
    reversals.iter().filter_map(sentence).collect()
}

/// Factor over the rotation per step at t = 0 from which a run warns again.
const TURNS_FASTER: f64 = 1.5;

/// A body that rotated too far in a step during the run. The warning at t = 0 belongs to the step.
#[must_use]
pub fn of_turns(
    scene: &Scene,
    frequencies: &Frequencies,
    method: &Method,
    step: f64,
    turning: &Turning,
) -> Option<String> {
    let since = turning.since?;
    if since == 0.0 && turning.turn <= TURNS_FASTER * frequencies.spin * step {
        return None;
    }
    let body = scene.body_names.get(turning.body).map_or("", String::as_str);
    Some(format!(
        "body `{body}` turned by {} rad in a step at t = {}, a body by more than {LARGEST_TURN} rad from \
         t = {} on: energy and attitude become inaccurate{}; use a step of at most {}",
        significant(turning.turn, 2),
        display(rounded(turning.time, 6)),
        display(rounded(since, 6)),
        of_angles(method),
        approximate(step * LARGEST_TURN / turning.turn),
    ))
}

/// The additional loss with Euler angles: `tests/mechanics/extremes/attitude.rs` measures it.
fn of_angles(method: &Method) -> &'static str {
    match method.orientation() {
        OrientationName::Quaternion => "",
        _ => ", and Euler angles lose angular momentum: a fifth of it in 10,000 steps of 0.5 rad",
    }
}
