//! Approximation of ideal joints: stiffness, scheme and step.
//!
//! `(scene, tolerance, duration) => changes, scheme, step, error`. The step, the deflection of joints and another model
//! of the mechanism may each use a third of the tolerance; each is measured by running:
//!
//! - the step is halved until two runs agree, by [`SchemeName::GeneralizedAlpha3`], whose step no stiffness bounds;
//! - joints are made ten times as stiff until the motion no longer changes: their deflection falls as 1/k, so that it
//!   is ten ninths of the change; the step is then searched again;
//! - `generalized-alpha`, whose steps cost about a quarter, and the cheapest model of the mechanism are used if they
//!   give the same motion.
//!
//! Distances are root mean squares over bodies and samples ([`Metric`](crate::reference::metric::Metric)), as in
//! `advise`.

use dbd_plant::digits::significant;
use dbd_plant::plant::check_laws;
use dbd_plant::{Frequencies, Method, PrecisionName, SchemeName, plant};
use dbd_scene::Scene;
use miette::Diagnostic;
use thiserror::Error;

use crate::reference::State;
use crate::variants::{AS_IT_IS, SPATIAL, distance, sampled, variants};

/// About how many samples are compared.
const SAMPLES: u64 = 50;
/// \[s\] a step longer than this is not looked at.
const LONGEST: f64 = 5e-3;
/// Steps of one run, times bodies, beyond which the search ends.
const MAX: f64 = 4e6;
/// \[m\] smallest valid tolerance.
const LEAST: f64 = 1e-10;
/// Steps of the ladder of stiffness.
const STIFFER: f64 = 10.0;
/// \[N/m\] the stiffest joints that are looked at: rounding moves the bodies beyond it.
const STIFFEST: f64 = 1e13;

/// How a scene is run with joints that are as good as ideal.
#[derive(Clone, Debug)]
pub struct Ideal {
    /// The scene with its changes.
    pub scene: Scene,
    /// The changes in the form of `--set`.
    pub set: Vec<String>,
    /// \[N/m\] the stiffest joint's stiffness.
    pub stiffness: f64,
    /// Name of the model of the mechanism: `as it is`, `planar-bushing`.
    pub model: &'static str,
    /// Scheme and precision.
    pub method: Method,
    /// \[s\] the step.
    pub step: f64,
    /// \[m\] error of the step.
    pub by_step: f64,
    /// \[m\] error of the joints' deflection.
    pub by_joints: f64,
    /// \[m\] error of the other model; 0 for the scene as it is.
    pub by_model: f64,
}

impl Ideal {
    /// \[m\] total error.
    #[must_use]
    pub fn off(&self) -> f64 {
        self.by_step + self.by_joints + self.by_model
    }
}

/// Why joints cannot be ideal.
#[derive(Clone, Debug, Error, Diagnostic, PartialEq)]
pub enum IdealError {
    /// The scene has no joint whose stiffness may be chosen.
    #[error("the scene `{scene}` has no joint that could be made ideal")]
    #[diagnostic(help(
        "add a joint without clearance: joints with a clearance and TSDAs cannot be ideal"
    ))]
    NoJoint {
        /// Its name.
        scene: String,
    },
    /// No stiffness and step that were tried are good enough.
    #[error(
        "joint error of at most {} m is not reachable over {} s: {what}",
        significant(*.asked, 2),
        significant(*.duration, 3)
    )]
    #[diagnostic(help(
        "use a shorter --duration, because errors grow along sensitive motion, or a tolerance larger than {} m",
        significant(*.asked, 2)
    ))]
    NotReached {
        /// \[m\].
        asked: f64,
        /// \[s\].
        duration: f64,
        /// Result of the last trial.
        what: String,
    },
}

/// A run with the given steps per unit, and the error of its step.
struct Run {
    steps: u64,
    off: f64,
    /// Of twice as many steps.
    states: Vec<State>,
}

/// Sampling of the runs.
struct Frame {
    /// \[s\] the time that steps divide.
    unit: f64,
    /// Units between samples.
    between: u64,
    samples: u64,
    third: f64,
}

impl Frame {
    /// Fractions of the sampling interval, if there is one.
    fn new(duration: f64, every: Option<f64>, third: f64) -> Self {
        let Some(every) = every.filter(|every| *every < duration) else {
            return Self { unit: duration / SAMPLES as f64, between: 1, samples: SAMPLES, third };
        };
        let units = (duration / every).round().max(1.0) as u64;
        let between = units.div_ceil(SAMPLES);
        Self { unit: every, between, samples: units / between, third }
    }

    fn step(&self, steps: u64) -> f64 {
        self.unit / steps as f64
    }

    /// Steps of a run times bodies.
    fn work(&self, scene: &Scene, steps: u64) -> f64 {
        (self.samples * self.between * steps) as f64 * scene.model.bodies.len() as f64
    }

    /// The states at the samples; `None` where the run fails or is too long.
    fn motion(&self, scene: &Scene, scheme: SchemeName, steps: u64) -> Option<Vec<State>> {
        if self.work(scene, steps) > MAX {
            return None;
        }
        let method = Method::new(scheme, None, PrecisionName::F64).ok()?;
        sampled(plant(scene, &method, self.step(steps)).ok()?, self.between * steps, self.samples)
    }

    /// The fewest steps per unit, from `least` on, whose errors are a third of the tolerance.
    fn resolved(&self, scene: &Scene, least: u64) -> Result<Run, String> {
        let scheme = SchemeName::GeneralizedAlpha3;
        let (mut steps, mut best) = (least, f64::INFINITY);
        let mut coarse = self.motion(scene, scheme, steps);
        loop {
            if self.work(scene, 2 * steps) > MAX {
                return Err(match best.is_finite() {
                    true => format!("halving the step still changes the motion by {best:.1e} m"),
                    false => "no run completes".into(),
                });
            }
            let fine = self.motion(scene, scheme, 2 * steps);
            if let (Some(coarse), Some(fine)) = (&coarse, &fine) {
                let off = distance((scene, fine), (scene, coarse));
                best = best.min(off);
                if off <= self.third {
                    return Ok(Run { steps, off, states: fine.clone() });
                }
            }
            (coarse, steps) = (fine, 2 * steps);
        }
    }
}

/// How to run a scene with an error of at most `tolerance` \[m\] from ideal joints over `duration` \[s\], in steps that
/// divide `every` \[s\].
///
/// # Errors
/// [`IdealError`].
pub fn ideal(
    scene: &Scene,
    tolerance: f64,
    (duration, every): (f64, Option<f64>),
    progress: &mut dyn FnMut(),
) -> Result<Ideal, IdealError> {
    let names = ideal_joints(scene);
    if names.is_empty() {
        return Err(IdealError::NoJoint { scene: scene.name.clone() });
    }
    let frame = Frame::new(duration, every, tolerance / 3.0);
    let refuse = |what: String| IdealError::NotReached { asked: tolerance, duration, what };
    if tolerance < LEAST {
        return Err(refuse("rounding errors are as large".into()));
    }
    for scheme in [SchemeName::GeneralizedAlpha3, SchemeName::GeneralizedAlpha] {
        let method = Method::new(scheme, None, PrecisionName::F64);
        let method = method.map_err(|error| refuse(error.to_string()))?;
        check_laws(scene, &method).map_err(|error| refuse(error.to_string()))?;
    }
    let frequencies = Frequencies::of(scene);
    let longest = LONGEST.min(frequencies.longest_turn()).min(frequencies.period / 40.0);
    // Halves of round steps are round.
    let least = ((frame.step(1) / longest).ceil().max(1.0) as u64).next_power_of_two();
    let own = dbd_scene::joint_elements(scene)
        .iter()
        .map(|element| element.stiffness)
        .fold(0.0, f64::max);
    let mut present = (scene.clone(), Vec::new(), own);
    let mut run = frame.resolved(&present.0, least);
    let by_joints = loop {
        progress();
        let stiffness = next(present.2);
        if stiffness > STIFFEST {
            let tried = format!("with joints of up to {:.0e} N/m", present.2);
            return Err(refuse(match run {
                Ok(_) => format!("{tried} the motion still depends on their stiffness"),
                Err(what) => format!("{tried} {what}"),
            }));
        }
        let set: Vec<String> =
            names.iter().map(|name| format!("joint.{name}.stiffness={stiffness:e}")).collect();
        let stiffer = set.iter().try_fold(scene.clone(), |scene, change| scene.with(change));
        let stiffer = stiffer.map_err(|error| refuse(error.to_string()))?;
        // Soft joints with visible vibration need steps that resolve it; stiff ones hardly move.
        let from = run.as_ref().map_or(least, |run| run.steps.div_ceil(2));
        let other = frame.resolved(&stiffer, from);
        if let (Ok(run), Ok(other)) = (&run, &other) {
            let change = distance((&stiffer, &other.states), (&present.0, &run.states));
            // The deflection falls as 1/k; this excludes that of the stiffer joints.
            let off = change / (1.0 - present.2 / stiffness);
            if off <= frame.third {
                break off;
            }
        }
        (present, run) = ((stiffer, set, stiffness), other);
    };
    let (stiff, mut set, stiffness) = present;
    let mut run = run.map_err(refuse)?;
    // Softer joints, which vibrate visibly, may have needed shorter steps.
    if run.steps > least {
        progress();
        run = frame.resolved(&stiff, least).map_err(refuse)?;
    }
    let reference_solution = (&stiff, &run.states[..]);
    // The cheapest first: in the plane, of few elements.
    let mut models = vec![(AS_IT_IS, stiff.clone())];
    models.extend(variants(&stiff).into_iter().map(|variant| (variant.name, variant.scene)));
    models.retain(|(name, _)| !name.starts_with(SPATIAL));
    models.sort_by_key(|(_, scene)| (scene.planar.is_none(), scene.stepped().tsda_count()));
    for (name, model) in models {
        progress();
        let by_model = match name == AS_IT_IS {
            true => 0.0,
            false => match frame.motion(&model, SchemeName::GeneralizedAlpha3, 2 * run.steps) {
                Some(states) => distance(reference_solution, (&model, &states)),
                None => continue,
            },
        };
        if by_model > frame.third {
            continue;
        }
        let mut found = (SchemeName::GeneralizedAlpha3, run.steps, run.off);
        for steps in [run.steps, 2 * run.steps] {
            let states = frame.motion(&stiff, SchemeName::GeneralizedAlpha, steps);
            let off = states
                .map_or(f64::INFINITY, |states| distance(reference_solution, (&stiff, &states)));
            if off <= frame.third {
                found = (SchemeName::GeneralizedAlpha, steps, off);
                break;
            }
        }
        let (scheme, steps, by_step) = found;
        let method = Method::new(scheme, None, PrecisionName::F64)
            .map_err(|error| refuse(error.to_string()))?;
        if name.contains("planar") {
            set.push("planar=true".into());
        }
        if name.contains("bushing") {
            set.push("realisation=bushing".into());
        }
        return Ok(Ideal {
            scene: model,
            set,
            stiffness,
            model: name,
            method,
            step: frame.step(steps),
            by_step,
            by_joints,
            by_model,
        });
    }
    Err(refuse("no model of the mechanism completes the run".into()))
}

/// \[N/m\] the next power of ten that is at least half a ladder's step above.
fn next(stiffness: f64) -> f64 {
    let next = (stiffness * STIFFER).max(1.0).log10().round();
    10.0_f64.powf(next)
}

/// Joints that become ideal with stiffness: all except those with a clearance.
fn ideal_joints(scene: &Scene) -> Vec<&str> {
    let joints = scene.joints.iter().filter(|joint| {
        let mut groups = joint.groups.clone();
        let gives = groups.any(|row| scene.model.groups[row].clearance.row().is_some());
        !gives
    });
    joints.map(|joint| joint.name.as_str()).collect()
}
