//! The cheapest method for a scene on a microcontroller that meets a request.
//!
//! `(scene, microcontroller, rate, accuracy) => model, method, step; its limit; useful changes`. Methods are tried in
//! ascending order of their lower cost bound, each with its longest step first, and compared with the reference
//! solution; methods that cannot be cheaper than the best are not run. The best is run over ten times the scene before
//! it is recommended; if that fails, shorter steps and other methods are tried.

mod changes;
mod mcu;
mod request;
mod search;
mod verify;

use dbd_plant::{Frequencies, PlantError};
use dbd_scene::Scene;
use miette::Diagnostic;
use serde::Serialize;
use thiserror::Error;

use crate::frame::{TradeOptions, WindowError, frame};
use crate::grid::unit;
use crate::reference::reference_solution::NoReferenceSolution;
use crate::survey::{Phase, look};
use crate::words::shown;

pub use changes::Change;
pub use mcu::{MCUS, Mcu};
pub use request::{Limit, Request, Way};
use search::{Search, Trial};
pub use verify::{Ends, FURTHER};

/// \[1\] The default accuracy, as a fraction of the bodies' displacement.
const SHARE: f64 = 0.01;

/// Models of a mechanism have steps that are longer by at most about this factor.
const SLOWER: f64 = 10.0;

/// A recommendation.
#[derive(Clone, Debug, Serialize)]
pub struct Recommendation {
    /// The scene's name.
    pub scene: String,
    /// The microcontroller's name.
    pub mcu: &'static str,
    /// \[Hz\].
    pub clock: f64,
    /// Cycles per instruction: an estimate.
    pub cycles_per_instruction: f64,
    /// \[Hz\] as requested.
    pub rate: Option<f64>,
    /// \[m\] as requested, or the default.
    pub accuracy: f64,
    /// Whether it was requested.
    pub accuracy_asked: bool,
    /// \[s\] the window of comparison.
    pub window: f64,
    /// \[m\] uncertainty of the reference solution.
    pub uncertainty: f64,
    /// The recommended method.
    pub way: Way,
    /// Whether it meets the request: accurate enough, and a load below 1.
    pub meets: bool,
    /// Reason and alternative, if it does not.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub shortfall: Option<String>,
    /// Limit of its step.
    pub limit: Limit,
    /// \[s\] the largest stable step of the recommended model and method; `None` where all are.
    pub stable_step: Option<f64>,
    /// \[m\] error of the same method in double precision: the difference is due to rounding.
    pub error_in_f64: Option<f64>,
    /// Extent of the verifying run: steps and \[s\]; [`FURTHER`] times the scene if that is affordable.
    pub verified: (u64, f64),
    /// Failure of the scene with any step: it is verified over its duration only.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub ends: Option<Ends>,
    /// Number of methods run, and of all.
    pub tried: (usize, usize),
    /// Changes of the scene that would help most.
    pub changes: Vec<Change>,
    /// The changes of values that make the recommended model of the scene.
    pub set: Vec<String>,
    /// Choice without a required accuracy, if that is not reached in real time.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub fastest: Option<Way>,
}

/// Why there is no recommendation.
#[derive(Debug, Error, Diagnostic)]
pub enum AdviseError {
    /// The window cannot be looked at.
    #[error(transparent)]
    #[diagnostic(transparent)]
    Window(#[from] WindowError),
    /// There is no reference solution to compare with.
    #[error(transparent)]
    #[diagnostic(transparent)]
    NoReferenceSolution(#[from] NoReferenceSolution),
    /// No step is stable, or no precision represents the scene.
    #[error("no method completes {} of the scene", shown(*window))]
    #[diagnostic(help(
        "run `host-sim check` to find problems of the scene, or shorten the comparison with `--window`"
    ))]
    None {
        /// \[s\].
        window: f64,
    },
    /// The requested accuracy is below the uncertainty of the reference solution.
    #[error(
        "an accuracy of {asked:.1e} m cannot be verified: the reference solution is accurate to {known:.1e} m"
    )]
    #[diagnostic(help(
        "ask for at least {known:.1e} m, or use a shorter --window, over which the \
         reference is more accurate"
    ))]
    Accuracy {
        /// \[m\] as requested.
        asked: f64,
        /// \[m\].
        known: f64,
    },
    /// The scene has laws whose cost is not known.
    #[error("the cost of a step of this scene on a microcontroller is unknown: {why}")]
    #[diagnostic(help(
        "run `host-sim new firmware SCENE` and count the instructions there with `cargo cost`"
    ))]
    Uncounted {
        /// Why.
        why: String,
    },
    /// The scene cannot be run.
    #[error(transparent)]
    #[diagnostic(transparent)]
    Plant(#[from] PlantError),
}

/// Recommends a method for a scene. `progress` receives the current phase.
///
/// # Errors
/// [`AdviseError`].
pub fn recommend(
    scene: &Scene,
    request: &Request,
    progress: &mut dyn FnMut(Phase),
) -> Result<Recommendation, AdviseError> {
    let period = request.rate.map(|rate| 1.0 / rate);
    let options = TradeOptions {
        window: request.window,
        period,
        cache: None,
        shipped: request.shipped.clone(),
    };
    let mut frame = frame(scene, &options)?;
    if period.is_none() {
        // Other models of the mechanism allow longer steps.
        let highest = Frequencies::of(scene).estimate / SLOWER;
        frame.unit = unit(scene, None, highest).unwrap_or(frame.unit);
    }
    let (head, reference_solution) = look(scene, 0, frame, progress)?;
    let known = head.uncertainty;
    if let Some(asked) = request.accuracy.filter(|asked| *asked < known) {
        return Err(AdviseError::Accuracy { asked, known });
    }
    progress(Phase::Limits);
    let mut search = Search::new(scene, request, head, reference_solution);
    if search.candidates.is_empty() {
        let why =
            "it uses custom laws, or no method with counted instructions can run it".to_owned();
        return Err(AdviseError::Uncounted { why });
    }
    let accuracy = request.accuracy.unwrap_or_else(|| (SHARE * search.travel()).max(known));
    let found = search.verified(accuracy)?;
    let real_time = |trial: &Trial| search::load(request, trial) <= 1.0;
    let mut shortfall = None;
    let mut fastest = None;
    let (trial, steps) = match found {
        Some((trial, steps)) if real_time(&trial) => (trial, steps),
        found => {
            let travel = search.travel();
            let quick = search.verified(travel)?;
            let best = search.most_accurate();
            let window = head.grid.window();
            shortfall = Some(match (&found, &best, &quick) {
                (Some((trial, _)), ..) => {
                    search.too_slow(trial, quick.as_ref().map(|(quick, _)| quick))
                }
                (None, Some(best), _) => format!(
                    "no tested method reaches an accuracy of {accuracy:.1e} m; the best has an error of {:.1e} m",
                    best.error
                ),
                (None, None, _) => return Err(AdviseError::None { window }),
            });
            fastest = quick.as_ref().map(|(quick, _)| search.way(quick));
            let taken = match found {
                Some(found) => Some(found),
                None => match best {
                    Some(best) => search.carried(&best)?.map(|steps| (best, steps)),
                    None => None,
                },
            };
            taken.or(quick).ok_or(AdviseError::None { window })?
        }
    };
    let limit = search.limit(&trial);
    progress(Phase::Variants);
    let changes = match limit {
        Limit::Vibration { .. } => changes::of(&search, &trial),
        _ => Vec::new(),
    };
    Ok(Recommendation {
        scene: scene.name.clone(),
        mcu: request.mcu.name,
        clock: request.clock,
        cycles_per_instruction: request.mcu.cycles,
        rate: request.rate,
        accuracy,
        accuracy_asked: request.accuracy.is_some(),
        window: head.grid.window(),
        uncertainty: known,
        meets: shortfall.is_none(),
        shortfall,
        limit,
        stable_step: search.stable(&trial),
        error_in_f64: search.in_double(&trial),
        verified: (steps, steps as f64 * trial.step),
        ends: search.ends().cloned(),
        tried: search.counts(),
        changes,
        set: search.set(&trial),
        fastest,
        way: search.way(&trial),
    })
}

#[cfg(test)]
mod tests;
