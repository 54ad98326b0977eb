//! What is probably not meant in a scene, in the step it is given, or in what a run of it did.
//!
//! `(scene, method, step, openings) => sentences`. The one place that knows them: `check`, `run` and
//! `trade` say what of it they can know. No warning changes an exit code.

use dbd_kernel::damping::Damping;
use dbd_plant::digits::{approximate, significant};
use dbd_plant::judge::{OPENED, Opening, Reversal, Turning};
use dbd_plant::time::{display, rounded};
use dbd_plant::{Frequencies, Method, Named as _, OrientationName, SchemeName};
use dbd_scene::default_step::LARGEST_TURN;
use dbd_scene::{ElementDamping, Facts, OneSided, Scene, Severity};
use dbd_study::limits::Limits;

use crate::commands::rounding::{self, COMPOSED, named};
use crate::compliance::{Stretch, stretches};

/// h·c/μ up to which slow motion is within 1 %: of dampers that cross with all that act beside them, on
/// mechanisms at random (`tests/dynamics/strong_dampers.rs`), and of each under compositions, by the table in
/// docs/schemes.md.
const STRONGEST_CROSSED: f64 = 2.5;
const STRONGEST_COMPOSED: f64 = 0.3;

/// Bodies up to which the highest frequency is solved for where its bound would warn and its estimate does not: in a
/// tenth of a second.
const SOLVED: usize = 60;

/// What is probably not meant in the scene itself.
#[must_use]
pub fn of_scene(scene: &Scene) -> Vec<String> {
    let [warnings, _] = with_notes(scene, &dbd_scene::facts(scene));
    warnings
}

/// What is probably not meant in the scene itself, and what is good to know of it, where its facts
/// are at hand.
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

/// Joints that the forces at t = 0 alone open by more than [`OPENED`] of their free length.
fn of_stiffness(scene: &Scene) -> Option<String> {
    let mut soft = stretches(scene);
    soft.retain(|stretch| stretch.share() > OPENED);
    soft.sort_by(|a, b| b.share().total_cmp(&a.share()));
    let (worst, others) = soft.split_first()?;
    let name = |stretch: &Stretch| format!("`{}`", scene.joints[stretch.joint].name);
    let line = scene.line_of_joint(worst.joint).map(|line| format!(" (line {line})"));
    let mut text = format!(
        "joint {}{}: gives way by {} m under the forces at t = 0, {} % of its free length of {} m",
        name(worst),
        line.unwrap_or_default(),
        significant(worst.extension, 3),
        significant(100.0 * worst.share(), 3),
        significant(worst.free_length, 4),
    );
    if let Some(named) = named(others.iter().map(name)) {
        text += &format!("; so do, by more than {} % of theirs, {named}", 100.0 * OPENED);
    }
    Some(text + ": is the stiffness in N/m, are masses in kg, forces in N?")
}

/// What is wrong with a step at t = 0: vibration beyond what the scheme bears, a spin beyond what a
/// step may turn. `whose` step it is begins the sentence: `the step`.
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
        // The estimate is never above the truth. A run may yet look well: exact planar motion, for
        // one, does not excite what vibrates out of the plane.
        let (z, of, then) = match least > limit {
            true => (least, "estimate", "what vibrates so grows without bound once it is excited"),
            false => (most, "bound", "the run may diverge"),
        };
        warnings.push(format!(
            "{whose} of {} is beyond what {} bears: ω·h = {} with the {of} of the highest frequency \
             at t = 0, the limit is {}: {then}; a step of at most {}",
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

/// Dampers so strong that what they slow down moves too fast: of all for a composition, whose sweeps
/// lie around the step, of those that cross for the others; within a joint joint-wise damping has none.
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
        if composed { "" } else { " with all that act beside them" },
    );
    if let Some(named) = named(others.iter().map(|element| element.name.clone())) {
        text += &format!(", and of {named}");
    }
    let shorter = approximate(most / rate(worst));
    text += &format!("; beyond {most} what they slow down may move too fast by more than 1 %");
    text += &match composed {
        true => {
            format!(" under {}: leapfrog, or a step of at most {shorter}", method.scheme_name())
        }
        false => format!(
            ", where dampers cross: a step of at most {shorter}, or {}",
            SchemeName::GeneralizedAlpha.name()
        ),
    };
    Some(text)
}

/// What a run did that is probably not meant: joints that opened by more than [`OPENED`] of their
/// free length. Those of bushings have none, and are the same however far they open.
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
    vec![text + ": stiffness, masses and loads do not go together, or the step is too long"]
}

/// Springs named as ropes, tyres or stops that changed to the side on which no such thing acts.
#[must_use]
pub fn of_springs(reversals: &[Reversal]) -> Vec<String> {
    let sentence = |one: &Reversal| {
        let (since, at_first) = one.since?;
        let OneSided { name, line, word, pulls, .. } = &one.spring;
        let (does, slack) = if *pulls { ("pushed", "slack") } else { ("pulled", "off") };
        let force = |newtons: f64| format!("{} N", significant(newtons.abs(), 3));
        Some(format!(
            "{name} (line {line}): {does} from t = {} on, there with {}, at most with {} at t = {}, which no {word} \
             does: it is {slack} then in truth; a `clearance` or another model of it lets it go",
            display(rounded(since, 6)),
            force(at_first),
            force(one.most.0),
            display(rounded(one.most.1, 6)),
        ))
    };
    reversals.iter().filter_map(sentence).collect()
}

/// By so much more than at t = 0 a body must have come to turn in a step for a run to say so, too.
const TURNS_FASTER: f64 = 1.5;

/// A body that came to turn too far in a step on the way. What it does so at t = 0 is said of the step.
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
         t = {} on: energy and attitude go wrong{}; a step of at most {}",
        significant(turning.turn, 2),
        display(rounded(turning.time, 6)),
        display(rounded(since, 6)),
        of_angles(method),
        approximate(step * LARGEST_TURN / turning.turn),
    ))
}

/// What Euler angles lose besides: `tests/mechanics/extremes/attitude.rs` has the figure.
fn of_angles(method: &Method) -> &'static str {
    match method.orientation() {
        OrientationName::Quaternion => "",
        _ => {
            ", and with Euler angles angular momentum is lost: a fifth of it in 10,000 steps of 0.5 rad"
        }
    }
}
