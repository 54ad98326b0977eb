//! `host-sim advise`: a method and step for a scene on a microcontroller, verified by running it.
//!
//! `(scene, microcontroller, clock, rate, accuracy) => recommendation => rows, JSON`.

use dbd_plant::digits::{approximate, significant};
use dbd_plant::time::display;
use dbd_scene::Scene;
use dbd_scene::quantity::evaluate;
use dbd_study::command::with_changes;
use dbd_study::recommend::{Change, Limit, MCUS, Mcu, Recommendation, Way};
use dbd_study::words::{percent, times};
use miette::Diagnostic;
use thiserror::Error;

/// An invalid argument.
#[derive(Debug, Error, Diagnostic)]
pub enum AskedError {
    /// Unknown microcontroller.
    #[error("unknown microcontroller `{name}`")]
    #[diagnostic(help("use one of {}", known()))]
    Mcu {
        /// As asked for.
        name: String,
    },
    /// Not a positive number in the unit.
    #[error("--{option}: invalid value `{text}`")]
    #[diagnostic(help(
        "give a positive number with its unit, for example {example}{}",
        clocks(option)
    ))]
    Number {
        /// The option.
        option: &'static str,
        /// As asked for.
        text: String,
        /// One that would do.
        example: &'static str,
    },
}

fn known() -> String {
    let name = |mcu: &Mcu| format!("{} ({} MHz)", mcu.name, mcu.clock * 1e-6);
    MCUS.iter().map(name).collect::<Vec<_>>().join(", ")
}

/// The usual clocks, where a clock is asked for.
fn clocks(option: &str) -> String {
    if option == "clock" { format!("; usual: {}", known()) } else { String::new() }
}

/// A microcontroller by its name.
///
/// # Errors
/// [`AskedError::Mcu`] names the known ones.
pub fn mcu(name: &str) -> Result<&'static Mcu, AskedError> {
    Mcu::of_name(name).ok_or_else(|| AskedError::Mcu { name: name.to_owned() })
}

/// \[`unit`\] a positive number of an option, with a unit or in SI units.
///
/// # Errors
/// [`AskedError::Number`] if it is not one.
pub fn positive(
    option: &'static str,
    unit: &str,
    example: &'static str,
    text: &str,
) -> Result<f64, AskedError> {
    let wanted = evaluate(&format!("1 {unit}")).map(|one| one.dimension).ok();
    let read = evaluate(text).ok();
    let fits = |dimension| Some(dimension) == wanted;
    let value = read.filter(|q| q.dimension.is_none() || fits(q.dimension)).map(|q| q.value);
    let value = value.filter(|value| value.is_finite() && *value > 0.0);
    value.ok_or_else(|| AskedError::Number { option, text: text.to_owned(), example })
}

/// A length for people.
fn length(value: f64) -> String {
    format!("{value:.1e} m")
}

/// `leapfrog with joint-wise damping, f32, step 100us`.
fn named(way: &Way) -> String {
    let mut text = way.scheme.to_owned();
    if let Some(newton) = way.newton.filter(|newton| *newton > 0) {
        text += &format!(" +{newton}");
    }
    if let Some(damping) = way.damping {
        text += &format!(" with {damping} damping");
    }
    format!("{text}, {}, step {}", way.precision, display(way.step))
}

fn because(found: &Recommendation) -> String {
    match &found.limit {
        Limit::Vibration { frequency_hz, element } => {
            let stable = found.stable_step.map_or_else(String::new, |stable| {
                format!(
                    ", {} of the largest stable step, {}",
                    percent(found.way.step / stable),
                    approximate(stable)
                )
            });
            let element = element.as_ref().map_or_else(String::new, |element| {
                format!("; {element} is the element with the highest natural frequency")
            });
            format!("vibration at {} Hz{stable}{element}", significant(*frequency_hz, 3))
        }
        Limit::Spin { body } => {
            format!("angular velocity of body `{body}`: at most 0.1 rad per step")
        }
        Limit::Motion { fails } => {
            format!("motion: a longer step, stable at t = 0, fails at t = {}", approximate(*fails))
        }
        Limit::Accuracy => "accuracy: a longer step is stable but less accurate".into(),
        Limit::Period => {
            let whose = match found.rate {
                Some(rate) => format!("the controller's period, {}", display(1.0 / rate)),
                None => "the common divisor of duration and sampling interval".into(),
            };
            let stable = found.stable_step.map_or_else(String::new, |stable| {
                format!("; the largest stable step is {}", approximate(stable))
            });
            format!("a whole number of steps in {whose}{stable}")
        }
    }
}

fn changed(change: &Change) -> String {
    let ratio = |cost: f64| format!("{} of the cost", percent(cost));
    let measured = match (change.measured, change.step) {
        (Some(measured), Some(step)) => {
            format!("measured {} at a step of {}", ratio(measured), display(step))
        }
        _ => "measured: no step completed the run".into(),
    };
    let moves = change
        .moves
        .map_or_else(String::new, |moves| format!("; the motion differs by {}", length(moves)));
    let set = change.set.iter().map(|set| format!(" --set '{set}'"));
    let set = if change.set.len() <= 4 { set.collect() } else { String::new() };
    format!("{}: predicted {}, {measured}{moves}{set}", change.what, ratio(change.predicted))
}

/// The report for people: names and texts.
#[must_use]
pub fn rows(scene: &Scene, called: &str, found: &Recommendation) -> Vec<(&'static str, String)> {
    let way = &found.way;
    let mut rows = Vec::new();
    let model = match found.set.is_empty() {
        true => String::new(),
        false => format!(", model `{}`: {}", way.model, found.set.join(", ")),
    };
    let title = if found.meets { "recommended" } else { "nearest" };
    rows.push((title, format!("{}{model}", named(way))));
    if let Some(why) = &found.shortfall {
        rows.push(("not met", why.clone()));
    }
    let asked = if found.accuracy_asked { "asked" } else { "1 % of the bodies' displacement" };
    rows.push((
        "accuracy",
        format!(
            "error {} over {} ({asked}: {}; the reference solution is accurate to {})",
            length(way.error),
            display(found.window),
            length(found.accuracy),
            length(found.uncertainty),
        ),
    ));
    let basis = match (way.counted, way.scheme) {
        (true, _) => "counted in an emulator",
        // The fill-in of its matrix depends on the mechanism.
        (false, "generalized-alpha" | "generalized-alpha-3") => {
            "estimated by elements, within a factor of 2"
        }
        (false, _) => "estimated by elements",
    };
    let verdict = if way.load <= 1.0 {
        format!("real time with a margin of {}", times(1.0 / way.load))
    } else {
        "not in real time".to_owned()
    };
    rows.push((
        "chip",
        format!(
            "{verdict}: {} instructions per step ({basis}), {} of {} at {} MHz with {} cycles per instruction (estimated)",
            way.instructions.round(),
            percent(way.load),
            found.mcu,
            significant(found.clock * 1e-6, 4),
            found.cycles_per_instruction,
        ),
    ));
    rows.push(("limited by", because(found)));
    let (steps, time) = found.verified;
    let ends = found.ends.as_ref().map_or_else(String::new, |ends| {
        let what = ends.joint.as_ref().map_or_else(
            || "the scene fails with every step: `host-sim run` reports the reason".to_owned(),
            |joint| format!("joint `{joint}` opens by more than its own size with every step"),
        );
        format!("; the window ends there: at t = {} {what}", approximate(ends.time))
    });
    let went = format!("{steps} steps to {} without failure{ends}", approximate(time));
    rows.push(("verified", went));
    if let Some(error) = found.error_in_f64.filter(|_| way.precision != "f64") {
        let text = format!("in f64 the error is {}", length(error));
        rows.push(("rounding", text));
    }
    let (tried, all) = found.tried;
    rows.push(("examined", format!("{tried} of {all} methods were run; no other can cost less")));
    for change in &found.changes {
        rows.push(("would help", changed(change)));
    }
    let scene = with_changes(scene, called);
    let set = found.set.iter().map(|set| format!(" --set {set}"));
    let mut options = format!(" --scheme {}", way.scheme);
    if let Some(newton) = way.newton.filter(|newton| *newton > 0) {
        options += &format!(" --newton {newton}");
    }
    if let Some(damping) = way.damping {
        options += &format!(" --damping {damping}");
    }
    options += &format!(" --precision {} --step {}", way.precision, display(way.step));
    let set: String = set.collect();
    rows.push(("run it", format!("host-sim run {scene}{set}{options}")));
    rows
}
