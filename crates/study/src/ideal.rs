//! Joints that are meant to be ideal: how stiff, by which scheme and in which step.
//!
//! `(scene, tolerance, duration) => changes, scheme, step, how far off`. A third of the tolerance each for the step,
//! for what the joints give way and for another model of the mechanism; each is measured by running:
//!
//! - the step is halved until two runs agree, by [`SchemeName::GeneralizedAlpha3`], whose step no stiffness bounds;
//! - joints are made ten times as stiff until that changes the motion no more: what they give way falls as 1/k, so
//!   that ten ninths of the change is all of it;
//! - `generalized-alpha`, whose steps cost about a quarter, and the cheapest model of the mechanism are taken where they
//!   lead to the same.
//!
//! Distances are root mean squares over bodies and samples ([`Metric`](crate::reference::metric::Metric)), as
//! `advise` has them.

use dbd_plant::digits::significant;
use dbd_plant::{Frequencies, Method, PrecisionName, SchemeName, plant};
use dbd_scene::Scene;
use miette::Diagnostic;
use thiserror::Error;

use crate::reference::State;
use crate::variants::{AS_IT_IS, SPATIAL, distance, variants};

/// About how many samples are compared.
const SAMPLES: u64 = 50;
/// \[s\] a step longer than this is not looked at.
const LONGEST: f64 = 5e-3;
/// Steps of one run, times bodies, beyond which the search ends.
const MOST: f64 = 4e6;
/// \[m\] what is asked for at least.
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
    /// The changes, as `--set` takes them.
    pub set: Vec<String>,
    /// \[N/m\] the stiffest joint's stiffness.
    pub stiffness: f64,
    /// What the model of the mechanism is called: `as it is`, `planar-bushing`.
    pub model: &'static str,
    /// Scheme and precision.
    pub method: Method,
    /// \[s\] the step.
    pub step: f64,
    /// \[m\] how far the step leads off.
    pub by_step: f64,
    /// \[m\] how far the joints give way leads off.
    pub by_joints: f64,
    /// \[m\] how far the other model leads off; 0 of the scene as it is.
    pub by_model: f64,
}

impl Ideal {
    /// \[m\] how far all of it leads off.
    #[must_use]
    pub fn off(&self) -> f64 {
        self.by_step + self.by_joints + self.by_model
    }
}

/// Why joints cannot be ideal.
#[derive(Clone, Debug, Error, Diagnostic, PartialEq)]
pub enum IdealError {
    /// The scene has no joint whose stiffness may be chosen.
    #[error("the scene `{scene}` has no joint that could be ideal")]
    #[diagnostic(help(
        "a joint with a clearance is meant to give way, and a scene of springs alone has no joints"
    ))]
    NoJoint {
        /// Its name.
        scene: String,
    },
    /// No stiffness and step that were tried are good enough.
    #[error(
        "joints that lead off by at most {} m are not reached over {} s: {what}",
        significant(*.asked, 2),
        significant(*.duration, 3)
    )]
    #[diagnostic(help(
        "take a shorter --duration, for errors grow along sensitive motion, or a larger length than {} m",
        significant(*.asked, 2)
    ))]
    NotReached {
        /// \[m\].
        asked: f64,
        /// \[s\].
        duration: f64,
        /// What the last try came to.
        what: String,
    },
}

/// A run in so many steps per unit, and how far its step leads off.
struct Run {
    steps: u64,
    off: f64,
    /// Of twice as many steps.
    states: Vec<State>,
}

/// What is run.
struct Frame {
    /// \[s\] what steps are whole parts of.
    unit: f64,
    /// Units between samples.
    between: u64,
    samples: u64,
    third: f64,
}

impl Frame {
    /// Whole parts of the sampling interval, where there is one.
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
        if self.work(scene, steps) > MOST {
            return None;
        }
        let method = Method::new(scheme, None, PrecisionName::F64).ok()?;
        let mut plant = plant(scene, &method, self.step(steps)).ok()?;
        let mut states = vec![State::of(&plant.state())];
        for _ in 0..self.samples {
            if !plant.advance(self.between * steps).is_running() {
                return None;
            }
            states.push(State::of(&plant.state()));
        }
        Some(states)
    }

    /// The fewest steps per unit, from `least` on, whose errors are a third of the tolerance.
    fn resolved(&self, scene: &Scene, least: u64) -> Result<Run, String> {
        let scheme = SchemeName::GeneralizedAlpha3;
        let (mut steps, mut best) = (least, f64::INFINITY);
        let mut coarse = self.motion(scene, scheme, steps);
        loop {
            if self.work(scene, 2 * steps) > MOST {
                return Err(match best.is_finite() {
                    true => format!("halving the step still changes the motion by {best:.1e} m"),
                    false => "no run comes to its end".into(),
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

/// How to run a scene whose joints are to lead off by at most `tolerance` \[m\] over `duration` \[s\], in steps that
/// are whole parts of `every` \[s\].
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
        return Err(refuse("rounding moves bodies by as much".into()));
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
        // Soft joints that vibrate visibly take steps that resolve it; stiff ones hardly move.
        let from = run.as_ref().map_or(least, |run| run.steps.div_ceil(2));
        let other = frame.resolved(&stiffer, from);
        if let (Ok(run), Ok(other)) = (&run, &other) {
            let change = distance((&stiffer, &other.states), (&present.0, &run.states));
            // Of what falls as 1/k this is all but what the stiffer joints give way.
            let off = change / (1.0 - present.2 / stiffness);
            if off <= frame.third {
                break off;
            }
        }
        (present, run) = ((stiffer, set, stiffness), other);
    };
    let run = run.map_err(refuse)?;
    let (stiff, mut set, stiffness) = present;
    let truth = (&stiff, &run.states[..]);
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
                Some(states) => distance(truth, (&model, &states)),
                None => continue,
            },
        };
        if by_model > frame.third {
            continue;
        }
        let mut found = (SchemeName::GeneralizedAlpha3, run.steps, run.off);
        for steps in [run.steps, 2 * run.steps] {
            let states = frame.motion(&stiff, SchemeName::GeneralizedAlpha, steps);
            let off = states.map_or(f64::INFINITY, |states| distance(truth, (&stiff, &states)));
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
    Err(refuse("no model of the mechanism comes to its end".into()))
}

/// \[N/m\] the next power of ten that is at least half a ladder's step above.
fn next(stiffness: f64) -> f64 {
    let next = (stiffness * STIFFER).max(1.0).log10().round();
    10.0_f64.powf(next)
}

/// Joints that hold ideally where they are stiff: all but those with a clearance.
fn ideal_joints(scene: &Scene) -> Vec<&str> {
    let joints = scene.joints.iter().filter(|joint| {
        let mut groups = joint.groups.clone();
        let gives = groups.any(|row| scene.model.groups[row].clearance.row().is_some());
        !gives
    });
    joints.map(|joint| joint.name.as_str()).collect()
}
