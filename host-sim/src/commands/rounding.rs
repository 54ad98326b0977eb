//! Rounding errors of a scene in a precision other than double, reported before and after a run.
//!
//! `(scene, method, step) => sentences`; `(losses, read-outs of a run) => sentences`. Used by `warnings.rs`.

use dbd_kernel::BodyIndex;
use dbd_kernel::readouts::Readout;
use dbd_plant::digits::significant;
use dbd_plant::rounding::Loss;
use dbd_plant::time::{display, rounded};
use dbd_plant::{Frequencies, Method, PrecisionName};
use dbd_scene::single::{last_digit, slow_start};
use dbd_scene::{JointElement, Scene};

use crate::report::ReadoutFigures;

/// Largest number of joints that a warning names besides the worst.
const NAMED: usize = 4;

/// Schemes composed of several kicks.
pub(super) const COMPOSED: [&str; 2] = ["pefrl", "blanes-moan-s6"];

/// ω·h with the bound below which the error in single precision is several times its
/// minimum on every mechanism of the table in docs/schemes.md.
const SHORTEST: f64 = 0.0125;

/// The same for compositions, which round every part of a step.
const SHORTEST_COMPOSED: f64 = 0.03;

/// The same for first-order schemes, whose error decreases slowly with the step.
const SHORTEST_FIRST: f64 = 0.003;

/// \[m\] resolution of positions and body points in `fixed`.
const FIXED_DIGIT: f64 = 1.0 / (1 << 27) as f64;

/// \[1\] Largest rounding error of a point in `fixed`, relative to the mechanism's size, without a warning.
const COARSE: f64 = 1e-6;

/// \[1\] Largest noise of a force, relative to the force, without a warning.
const NOISY: f64 = 0.01;

/// The first of these names, and how many more there are; `None` without any.
pub(super) fn named(names: impl ExactSizeIterator<Item = String>) -> Option<String> {
    let more = names.len().saturating_sub(NAMED);
    let mut names: Vec<String> = names.take(NAMED).collect();
    if more > 0 {
        names.push(format!("{more} more"));
    }
    (!names.is_empty()).then(|| names.join(", "))
}

/// Rounding errors of a precision and step, as known at t = 0.
#[must_use]
pub fn of_step(
    scene: &Scene,
    frequencies: &Frequencies,
    method: &Method,
    step: f64,
    whose: &str,
) -> Vec<String> {
    let single = method.precision().is_single();
    let [short, slow] = match single {
        true => [short(frequencies, method, step, whose), slow_start(scene, step, whose)],
        false => [None, None],
    };
    let small = (method.precision() == PrecisionName::Fixed).then(|| small(scene)).flatten();
    [short, slow, small].into_iter().flatten().collect()
}

/// A step so short that rounding in single precision outweighs the gain of a shorter
/// step.
fn short(frequencies: &Frequencies, method: &Method, step: f64, whose: &str) -> Option<String> {
    let product = frequencies.bound * step;
    let [order, _] = method.orders();
    let shortest = match method.scheme_name() {
        _ if order < 2 => SHORTEST_FIRST,
        name if COMPOSED.contains(&name) => SHORTEST_COMPOSED,
        _ => SHORTEST,
    };
    (0.0 < product && product < shortest).then(|| {
        format!(
            "{whose} of {} is short for {} in single precision: ω·h = {}, and below {shortest} rounding \
             outweighs the gain of a shorter step; use a longer step, which is more accurate, or f64",
            display(step),
            method.scheme_name(),
            significant(product, 3),
        )
    })
}

/// A mechanism too small for the resolution of body points in fixed point.
fn small(scene: &Scene) -> Option<String> {
    let elements = dbd_scene::joint_elements(scene);
    let levers = elements.iter().flat_map(|element| element.moments).map(|m| m.dot(m).sqrt());
    let size = levers.fold(0.0, f64::max);
    (size > 0.0 && 0.5 * FIXED_DIGIT > COARSE * size).then(|| {
        format!(
            "fixed resolves points to {} m, and the longest lever arm of a joint is {} m: use f64, f32, or lengths in \
             another unit",
            significant(FIXED_DIGIT, 2),
            significant(size, 3),
        )
    })
}

/// Read-outs of forces and accelerations with noise from rounding in stiff joints: relative to their values in
/// a run, or before it to the weight of all bodies.
#[must_use]
pub fn of_noise(
    scene: &Scene,
    method: &Method,
    figures: Option<&[ReadoutFigures]>,
) -> Option<String> {
    let digit = |position: [f64; 3]| match method.precision() {
        PrecisionName::Fixed => FIXED_DIGIT,
        precision if precision.is_single() => last_digit(position),
        _ => 0.0,
    };
    let places: Vec<f64> =
        scene.model.initial.iter().map(|state| digit(state.position.to_f64())).collect();
    let elements = dbd_scene::joint_elements(scene);
    let masses: Vec<f64> = scene.model.bodies.iter().map(|body| body.mass).collect();
    let field = scene.model.gravity.first().map_or(0.0, |g| g.dot(*g).sqrt());
    let weight = field * masses.iter().sum::<f64>();
    let mut noisy: Vec<(&str, f64, f64, &str)> = Vec::new();
    let mut column = 0;
    for info in &scene.readouts {
        let columns = column..column + info.columns.len();
        column = columns.end;
        let (noise, forces, unit) = match info.readout {
            Readout::JointForce { group } => {
                let owner = scene.joints.iter().position(|j| j.groups.contains(&group.row()));
                let of = |element: &&JointElement| Some(element.joint) == owner;
                (noise(elements.iter().filter(of), &places), columns, "N")
            }
            Readout::Imu { body: BodyIndex(body), .. } => {
                let row = usize::from(body);
                let of = |element: &&JointElement| element.bodies.contains(&Some(row));
                let forces = columns.start..columns.start + 3;
                (noise(elements.iter().filter(of), &places) / masses[row], forces, "m/s²")
            }
            _ => continue,
        };
        let shown = match figures {
            Some(figures) => {
                let ends = figures[forces].iter().flat_map(|one| [one.min, one.max]);
                ends.flatten().fold(0.0, |most: f64, end| most.max(end.abs()))
            }
            None if unit == "N" => weight,
            None => field,
        };
        if noise > NOISY * shown && shown > 0.0 {
            noisy.push((&info.name, noise, shown, unit));
        }
    }
    noisy.sort_by(|a, b| (b.1 / b.2).total_cmp(&(a.1 / a.2)));
    let ((worst, noise, shown, unit), others) = noisy.split_first()?;
    let mut text = format!(
        "read-out `{worst}` may have an error of about {} {unit} or more at any time, {} {} {unit}",
        significant(*noise, 1),
        if figures.is_some() { "with a maximum of" } else { "compared with a weight of" },
        significant(*shown, 2),
    );
    if let Some(named) = named(others.iter().map(|(name, ..)| format!("`{name}`"))) {
        text += &format!(", as may {named}");
    }
    Some(
        text + &format!(
            ": the joint's stiffness amplifies the last digit of a position in {}; use f64{} or softer joints",
            method.precision_name(),
            if method.precision().is_single() { ", fixed" } else { "" },
        ),
    )
}

/// \[N\] Force noise from the last digits \[m\] of body positions in some elements, in the stiffest world
/// axis.
fn noise<'e>(elements: impl Iterator<Item = &'e JointElement>, places: &[f64]) -> f64 {
    let mut squares = [0.0; 3];
    for element in elements {
        let digits = element.bodies.iter().flatten().map(|row| places[*row] * places[*row]);
        let digit = digits.sum::<f64>().sqrt();
        for (sum, n) in squares.iter_mut().zip(element.direction_w.to_f64()) {
            *sum += element.stiffness * n * n * digit;
        }
    }
    squares.into_iter().fold(0.0, f64::max)
}

/// Bodies that lost more motion in single precision than permitted.
#[must_use]
pub fn of_losses(scene: &Scene, method: &Method, losses: &[Loss]) -> Option<String> {
    let (worst, others) = losses.split_first()?;
    let name =
        |loss: &Loss| format!("`{}`", scene.body_names.get(loss.body).map_or("", String::as_str));
    let unit = if worst.turn { "rad" } else { "m" };
    let mut text = format!(
        "body {} has lost {} {unit} of {} {unit} by t = {}: {} rounds the increments of slow motion",
        name(worst),
        significant(worst.lost, 2),
        significant(worst.moved, 3),
        display(rounded(worst.time, 6)),
        method.precision_name(),
    );
    let mut names: Vec<String> = others.iter().map(name).collect();
    names.retain(|other| *other != name(worst));
    names.dedup();
    if let Some(named) = named(names.into_iter()) {
        text += &format!(", also of {named}");
    }
    Some(text + "; use fixed or f64, or a longer step, which loses less")
}
