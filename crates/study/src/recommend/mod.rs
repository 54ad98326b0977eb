//! One way of stepping a scene on a microcontroller that meets a request at the least cost.
//!
//! `(scene, microcontroller, rate, accuracy) => model, method, step; what limits it; what would help`. Ways are tried from
//! the least cost that they can have upwards, each with its longest step first, and held against the truth;
//! what cannot be cheaper than the best is never run. The best is run over ten times the scene before it is
//! recommended; where that fails, shorter steps and other ways are.

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
use crate::reference::truth::NoTruth;
use crate::survey::{Phase, look};
use crate::words::shown;

pub use changes::Change;
pub use mcu::{MCUS, Mcu};
pub use request::{Limit, Request, Way};
use search::{Search, Trial};
pub use verify::{Ends, FURTHER};

/// \[1\] The accuracy where none is asked for: a share of how far the bodies go.
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
    /// \[Hz\] as asked.
    pub rate: Option<f64>,
    /// \[m\] as asked, or the default.
    pub accuracy: f64,
    /// Whether it was asked for.
    pub accuracy_asked: bool,
    /// \[s\] the window of comparison.
    pub window: f64,
    /// \[m\] what the truth is known to.
    pub uncertainty: f64,
    /// What is recommended.
    pub way: Way,
    /// Whether it meets the request: accurate enough, and less than the whole clock.
    pub meets: bool,
    /// Why not, and what would.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub shortfall: Option<String>,
    /// What keeps its step from being longer.
    pub limit: Limit,
    /// \[s\] the largest stable step of the recommended model and method; `None` where all are.
    pub stable_step: Option<f64>,
    /// \[m\] the same way in double precision: what rounding costs is the difference.
    pub error_in_f64: Option<f64>,
    /// How far the run that verified it went: steps and \[s\]; [`FURTHER`] times the scene where that is affordable.
    pub verified: (u64, f64),
    /// How the scene as it is comes to an end in any step: it is verified over its duration alone.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub ends: Option<Ends>,
    /// Ways that were run, and all that there are.
    pub tried: (usize, usize),
    /// Changes of the scene that would help most.
    pub changes: Vec<Change>,
    /// The changes of values that make the recommended model of the scene.
    pub set: Vec<String>,
    /// What would be taken without a request for accuracy, where that is not reached in real time.
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
    /// There is no truth to compare with.
    #[error(transparent)]
    #[diagnostic(transparent)]
    NoTruth(#[from] NoTruth),
    /// No step is stable, or no precision holds the scene.
    #[error("no way of stepping the scene comes to the end of {}", shown(*window))]
    #[diagnostic(help(
        "`host-sim check` says what is unusual about the scene, `--window` takes a shorter comparison"
    ))]
    None {
        /// \[s\].
        window: f64,
    },
    /// Asked for more than the truth is known to.
    #[error(
        "an accuracy of {asked:.1e} m cannot be verified: the truth itself is known to {known:.1e} m"
    )]
    #[diagnostic(help("at least {known:.1e} m; over a shorter --window it is known better"))]
    Accuracy {
        /// \[m\] as asked.
        asked: f64,
        /// \[m\].
        known: f64,
    },
    /// The scene has laws whose cost is not known.
    #[error("what a step of this scene costs on a microcontroller is not known: {why}")]
    #[diagnostic(help(
        "`host-sim new firmware SCENE` makes a project that counts it: `cargo cost`"
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

/// What to take for a scene. `progress` hears what it is at.
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
        // Other models of the mechanism take longer steps.
        let highest = Frequencies::of(scene).estimate / SLOWER;
        frame.unit = unit(scene, None, highest).unwrap_or(frame.unit);
    }
    let (head, truth) = look(scene, 0, frame, progress)?;
    let known = head.uncertainty;
    if let Some(asked) = request.accuracy.filter(|asked| *asked < known) {
        return Err(AdviseError::Accuracy { asked, known });
    }
    progress(Phase::Limits);
    let mut search = Search::new(scene, request, head, truth);
    if search.candidates.is_empty() {
        let why =
            "it has laws that are not the project's, or no counted method steps it".to_owned();
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
                    "nothing that was tried is as accurate as {accuracy:.1e} m; the best is off by {:.1e} m",
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
