//! Checks of every axis before any case runs.
//!
//! `(spec, scene) => base scene | error with position`. Each value of a list and the ends of a range are tried with all
//! other axes at their first values, as well as every combination of a method's choices; the number of cases was
//! checked when the file was read. Errors of combinations of values are rows of their cases.

use std::collections::BTreeSet;
use std::ops::Range as Place;

use dbd_plant::{Method, MethodError};
use dbd_scene::{Scene, SceneError};
use miette::Diagnostic;
use thiserror::Error;

use crate::sweep::axis::{Choices, OWN, Target};
use crate::sweep::cases::{Cases, change, changes, choices};
use crate::sweep::refusal::Refusal;
use crate::sweep::spec::Spec;
use crate::sweep::value::Value;

/// Context of the checks.
pub trait Trial {
    /// The scene with changes.
    ///
    /// # Errors
    /// Where it is refused.
    fn scene(&self, changes: &[String]) -> Result<Scene, SceneError>;

    /// Checks that a method can run the scene: a step fits, and the precision represents the values.
    ///
    /// # Errors
    /// Problem and remedy.
    fn plan(&self, scene: &Scene, method: &Method) -> Result<(), Misfit>;
}

/// Why a run cannot be planned.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct Misfit {
    /// Problem.
    pub message: String,
    /// Remedy.
    pub help: String,
}

/// Errors before a sweep.
#[derive(Debug, Error, Diagnostic)]
pub enum CheckError {
    /// Something in its file.
    #[error(transparent)]
    #[diagnostic(transparent)]
    Refused(#[from] Box<Refusal>),
    /// The scene itself, without any change.
    #[error(transparent)]
    Scene(SceneError),
}

/// A change with the positions of its path and value.
struct Made {
    text: String,
    path: Place<usize>,
    value: Place<usize>,
}

/// Tries every axis; the scene with the first value of each.
///
/// # Errors
/// [`CheckError`] with the first that does not fit.
pub fn check(spec: &Spec, trial: &dyn Trial) -> Result<Scene, CheckError> {
    trial.scene(&[]).map_err(CheckError::Scene)?;
    check_methods(spec)?;
    let first: Vec<&Value> = spec.axes.iter().map(|axis| &axis.tried[0].0).collect();
    // One more of the fixed ones at a time, so that the first that does not fit is named.
    let mut made: Vec<Made> = Vec::new();
    let set = spec.set.iter().map(|change| {
        let place = change.place.clone();
        Made { text: change.text.clone(), path: place.clone(), value: place }
    });
    let settings = spec.fixed.iter().chain(&spec.axes).filter(|axis| axis.target == Target::Scene);
    let settings = settings.map(|axis| {
        let (value, place) = &axis.tried[0];
        Made { text: change(axis, value), path: axis.place.clone(), value: place.clone() }
    });
    for one in set.chain(settings) {
        made.push(one);
    }
    let begin = attempt(spec, trial, &made, &first, None)?;
    for (row, axis) in spec.axes.iter().enumerate() {
        for (value, place) in axis.tried.iter().skip(1) {
            let mut values = first.clone();
            values[row] = value;
            if axis.target == Target::Scene {
                let text = change(axis, value);
                let changed = Made { text, path: axis.place.clone(), value: place.clone() };
                let at = made.iter().position(|made| made.path == axis.place);
                let Some(at) = at else { continue };
                let before = std::mem::replace(&mut made[at], changed);
                let tried = attempt(spec, trial, &made, &values, Some(place));
                made[at] = before;
                tried?;
            } else {
                attempt(spec, trial, &made, &values, Some(place))?;
            }
        }
    }
    Ok(begin)
}

/// Loads and plans a case; `varied` is the position of the tried value.
fn attempt(
    spec: &Spec,
    trial: &dyn Trial,
    made: &[Made],
    values: &[&Value],
    varied: Option<&Place<usize>>,
) -> Result<Scene, CheckError> {
    debug_assert!(made.iter().map(|made| &made.text).eq(&changes(spec, values)));
    let texts: Vec<String> = made.iter().map(|made| made.text.clone()).collect();
    let scene = trial.scene(&texts).map_err(|error| placed(spec, made, varied, &error))?;
    let Ok(method) = choices(spec, values).method() else { return Ok(scene) };
    let refuse = |misfit: Misfit| {
        let time = made.iter().rev().find(|made| made.text.starts_with("step="));
        let place = varied.or(time.map(|made| &made.value)).unwrap_or(&spec.scene.place);
        spec.source.refuse(place.clone(), misfit.message, misfit.help)
    };
    trial.plan(&scene, &method).map_err(refuse)?;
    Ok(scene)
}

/// A scene's error at the position of the change concerned, else of the tried value.
fn placed(
    spec: &Spec,
    made: &[Made],
    varied: Option<&Place<usize>>,
    error: &SceneError,
) -> Box<Refusal> {
    let head = |text: &str| text.split_once('=').map_or(text, |(head, _)| head).trim().to_owned();
    let shown = line_of(error);
    let about = shown.as_ref().and_then(|line| {
        made.iter().rev().find(|made| made.text == *line || head(&made.text) == head(line))
    });
    let place = match about {
        Some(made) => {
            let path = head(&made.text).chars().count();
            let in_path = error.column().is_some_and(|column| column <= path);
            if in_path { made.path.clone() } else { made.value.clone() }
        }
        None => varied.cloned().unwrap_or_else(|| spec.scene.place.clone()),
    };
    // Messages about the scene's own lines name the line.
    let message = match (about, error.line()) {
        (None, Some(line)) => format!("{}:{line}: {}", error.file(), error.message()),
        _ => error.message(),
    };
    spec.source.refuse(place, message, error.help())
}

/// The change that a refusal is about, as it shows it; `None` where it is about the file.
fn line_of(error: &SceneError) -> Option<String> {
    if error.file() != "--set" {
        return None;
    }
    let label = error.labels()?.next()?;
    let shown = error.source_code()?.read_span(label.inner(), 1, 1).ok()?;
    Some(String::from_utf8_lossy(shown.data()).trim_end_matches('\n').to_owned())
}

/// Every combination of a method's choices that a case has.
fn check_methods(spec: &Spec) -> Result<(), Box<Refusal>> {
    let varies = spec.axes.iter().any(|axis| axis.target != Target::Scene);
    let cases = Cases::new(spec);
    let mut known: BTreeSet<Choices<'_>> = BTreeSet::new();
    for case in 0..if varies { cases.len() } else { 1 } {
        let choices = choices(spec, &cases.values(case));
        if known.contains(&choices) {
            continue;
        }
        choices.method().map_err(|error| refused(spec, &cases.values(case), &error))?;
        known.insert(choices);
    }
    Ok(())
}

fn refused(spec: &Spec, values: &[&Value], error: &MethodError) -> Box<Refusal> {
    let targets = match error {
        MethodError::Newton { .. } | MethodError::Iterations { .. } => [Target::Newton; 2],
        MethodError::NoRho { .. } | MethodError::Rho(_) => [Target::Rho; 2],
        MethodError::Damping { .. } => [Target::Damping; 2],
        _ => [Target::Precision, Target::Orientation],
    };
    let all = spec.axes.iter().zip(values.iter().copied());
    let all = all.chain(spec.fixed.iter().filter_map(|axis| Some((axis, axis.values.first()?))));
    let (axis, value) = all
        .filter(|(axis, _)| targets.contains(&axis.target))
        .min_by_key(|(axis, _)| axis.target == Target::Orientation)
        .unzip();
    let place = axis.map_or(spec.scene.place.clone(), |axis| {
        let tried = axis.tried.iter().find(|(tried, _)| Some(tried) == value);
        tried.map_or(axis.place.clone(), |(_, place)| place.clone())
    });
    let help = match error {
        MethodError::Newton { .. } | MethodError::NoRho { .. } | MethodError::Damping { .. } => {
            format!(
                "use \"{OWN}\" for the scheme's default, or `paired` to vary it together with `scheme`"
            )
        }
        _ => error.help().map(|help| help.to_string()).unwrap_or_default(),
    };
    spec.source.refuse(place, error.to_string(), help)
}
