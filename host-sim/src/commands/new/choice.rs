//! Scheme, damping, precision and step of a new project: as requested, else from short runs of the scene.
//!
//! `(scene, options) => method, step, reasons`. On a scene of TSDAs, joint-wise damping costs half of damper passes and
//! is used if it is as accurate; fixed point is used if single precision would lose slow motion.

use clap::Args;
use dbd_kernel::BodyState;
use dbd_plant::digits::significant;
use dbd_plant::plan::step_of;
use dbd_plant::plant::check;
use dbd_plant::rounding::RoundingWatch;
use dbd_plant::time::{Time, display, rounded};
use dbd_plant::{
    DampingName, Frequencies, Method, PlanError, PlantError, PrecisionName, SchemeName, plant,
};
use dbd_scene::Scene;
use dbd_scene::laws::KnownLaw;
use miette::Diagnostic;
use thiserror::Error;

use crate::arguments::names;
use crate::commands::export::ExportPrecision;
use crate::commands::rounding::of_losses;

/// \[s\] Longest time over which damping methods are compared.
const WINDOW: f64 = 1.0;

/// Number of times at which they are compared.
const LOOKS: u64 = 20;

/// Errors are measured against a run with this fraction of the step.
const FINER: u64 = 4;

/// Joint-wise damping counts as accurate as damper passes up to this ratio of errors.
const AS_ACCURATE: f64 = 1.25;

/// \[m\] Errors below this are ignored.
const NEGLIGIBLE: f64 = 1e-9;

/// Largest number of steps checked for lost motion.
const MAX_STEPS: u64 = 1_000_000;

/// What is asked for.
#[derive(Clone, Debug, Default, Args)]
pub struct ChoiceOptions {
    /// Time-stepping scheme of the plant [default: leapfrog]
    #[arg(long, value_parser = names::<SchemeName>())]
    pub scheme: Option<SchemeName>,
    /// Damping method [default: joint-wise if it is as accurate as the scheme's own]
    #[arg(long, value_parser = names::<DampingName>())]
    pub damping: Option<DampingName>,
    /// Precision of the model [default: f32, or fixed if f32 loses slow motion]
    #[arg(long, value_enum)]
    pub precision: Option<ExportPrecision>,
    /// Step, e.g. 20us [default: the scene's, else the advised one]
    #[arg(long, value_name = "TIME", allow_hyphen_values = true)]
    pub step: Option<Time>,
}

/// Why no method can be chosen.
#[derive(Debug, Error, Diagnostic)]
pub enum ChoiceError {
    /// The method is unknown, or cannot represent the scene.
    #[error(transparent)]
    #[diagnostic(transparent)]
    Plant(#[from] PlantError),
    /// No step fits the scene.
    #[error(transparent)]
    #[diagnostic(transparent)]
    Step(#[from] PlanError),
}

/// How a project's plant steps.
#[derive(Clone, Debug, PartialEq)]
pub struct Choice {
    /// The method.
    pub method: Method,
    /// \[s\] the step.
    pub step: f64,
    /// Whether the step was asked for.
    pub step_given: bool,
    /// The reasons, one sentence per choice.
    pub reasons: Vec<String>,
}

impl Choice {
    /// The requested settings, and the rest from short runs.
    ///
    /// # Errors
    /// [`ChoiceError`] if the method is unknown, or cannot represent the scene.
    pub fn of(scene: &Scene, options: &ChoiceOptions) -> Result<Self, ChoiceError> {
        let scheme = options.scheme.unwrap_or_default();
        let asked = options.precision.map(ExportPrecision::name);
        let mut method = Method::new(scheme, None, asked.unwrap_or(PrecisionName::F32))
            .map_err(PlantError::from)?;
        if let Some(damping) = options.damping {
            method = method.with_damping(damping).map_err(PlantError::from)?;
        }
        let longest = || Frequencies::of(scene).default_limit(&method, scene.duration);
        let step = step_of(scene, options.step.map(Time::seconds), longest)?;
        let mut reasons = Vec::new();
        if options.damping.is_none() {
            (method, reasons) = damped(scene, method, step)?;
        }
        if asked.is_none() {
            let fixed = method.with_precision(PrecisionName::Fixed);
            if let Some(reason) = loses(scene, &method, step)? {
                method = match check(scene, &fixed, step) {
                    Ok(()) => {
                        reasons.push(format!("fixed, because in f32 {reason}"));
                        fixed
                    }
                    Err(error) => {
                        reasons.push(format!("f32, though {reason}; fixed: {error}"));
                        method
                    }
                };
            }
        }
        check(scene, &method, step)?;
        Ok(Self { method, step, step_given: options.step.is_some(), reasons })
    }

    /// The call of a build script.
    #[must_use]
    pub fn call(&self, file: &str, laws: &[KnownLaw]) -> String {
        let law = |law: &KnownLaw| format!(".law::<{0}>({0:?})", law.path);
        let mut call: String = laws.iter().map(law).collect();
        if self.method.scheme_name() != Method::default().scheme_name() {
            call += &format!(".scheme({:?})", self.method.scheme_name());
        }
        if let Some(damping) = self.method.foreign_damping() {
            call += &format!(".damping({:?})", damping.name());
        }
        if self.method.precision() != PrecisionName::F32 {
            call += &format!(".precision({:?})", self.method.precision_name());
        }
        if self.step_given {
            call += &format!(".step({:?})", display(self.step));
        }
        match call.is_empty() {
            true => format!("dbd_scene::build({file:?});"),
            false => format!("dbd_scene::Build::scene({file:?}){call}.write();"),
        }
    }

    /// `leapfrog with joint-wise damping, f32, a step of 125us`.
    #[must_use]
    pub fn words(&self) -> String {
        let mut words = self.method.scheme_name().to_owned();
        if let Some(damping) = self.method.foreign_damping() {
            words += &format!(" with {} damping", damping.name());
        }
        words + &format!(", {}, a step of {}", self.method.precision_name(), display(self.step))
    }
}

/// The method with joint-wise damping where the scheme has it, joints are damped, and it is as accurate.
fn damped(scene: &Scene, method: Method, step: f64) -> Result<(Method, Vec<String>), PlantError> {
    let damped = dbd_scene::joint_dampings(scene).iter().any(|element| element.rate > 0.0);
    let joint_wise = method.with_damping(DampingName::JointWise).ok().filter(|_| damped);
    let Some(joint_wise) = joint_wise else { return Ok((method, Vec::new())) };
    let [own, other] = [method, joint_wise].map(|way| way.with_precision(PrecisionName::F64));
    let looks = (WINDOW.min(scene.duration) / step / LOOKS as f64).ceil().max(1.0) as u64;
    let fine = places(scene, &own, step / FINER as f64, looks * FINER)?;
    let error = |way: &Method| -> Result<f64, PlantError> {
        let places = places(scene, way, step, looks)?;
        // A failed run counts as infinitely far.
        let whole = places.len() == fine.len();
        Ok(if whole { distance(&places, &fine) } else { f64::INFINITY })
    };
    let (own, other) = (error(&own)?, error(&other)?);
    if other <= (AS_ACCURATE * own).max(NEGLIGIBLE) {
        let window = display(rounded((looks * LOOKS) as f64 * step, 3));
        let reason = format!(
            "joint-wise damping: error {} m over {window} at that step, `sweeps`: {} m",
            significant(other, 2),
            significant(own, 2),
        );
        Ok((joint_wise, vec![reason]))
    } else {
        Ok((method, Vec::new()))
    }
}

/// The positions of all bodies after every `stride` steps, as far as the run goes.
fn places(
    scene: &Scene,
    method: &Method,
    step: f64,
    stride: u64,
) -> Result<Vec<[f64; 3]>, PlantError> {
    let mut plant = plant(scene, method, step)?;
    let mut places = Vec::new();
    let mut bodies: Vec<BodyState<_>> = Vec::new();
    for _ in 0..LOOKS {
        if plant.advance(stride).is_err() {
            break;
        }
        plant.bodies(&mut bodies);
        places.extend(bodies.iter().map(|body| body.position.to_f64()));
    }
    Ok(places)
}

/// \[m\] The root mean square of the distances of positions.
fn distance(places: &[[f64; 3]], others: &[[f64; 3]]) -> f64 {
    let pairs = places.as_flattened().iter().zip(others.as_flattened());
    let sum: f64 = pairs.map(|(a, b)| (a - b) * (a - b)).sum();
    (sum / places.len().max(1) as f64).sqrt()
}

/// The motion lost in single precision; `None` if none is lost or the run fails.
fn loses(scene: &Scene, method: &Method, step: f64) -> Result<Option<String>, PlantError> {
    check(scene, method, step)?;
    let mut plant = plant(scene, method, step)?;
    let Some(mut watch) = RoundingWatch::new(plant.as_ref()) else { return Ok(None) };
    let steps = ((scene.duration / step).round() as u64).clamp(1, MAX_STEPS);
    for _ in 0..steps {
        if plant.advance(1).is_err() {
            return Ok(None);
        }
        watch.look(plant.as_ref());
    }
    Ok(of_losses(scene, method, &watch.losses()))
}
