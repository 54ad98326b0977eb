//! What a survey is asked for, and whether it can be done: its longest window, and what its steps divide.
//!
//! `(scene, options) => longest window, unit of steps | why not`.

use std::path::PathBuf;

use dbd_plant::Frequencies;
use dbd_plant::time::display;
use dbd_scene::Scene;

use crate::grid::unit;

/// \[s\] The longest window where none is given: a mechanism has moved, and a scene of a dozen
/// bodies takes minutes.
const LONGEST: f64 = 0.5;

/// The shortest window, as a share of the scene's duration.
const SHORTEST: f64 = 1e-6;

/// \[rad\] A window in which the highest frequency turns further has no truth within an hour.
const FURTHEST: f64 = 1e7;

/// What a survey is asked for.
#[derive(Clone, Debug, Default)]
pub struct TradeOptions {
    /// \[s\] the longest window; 0.5 s or the scene's duration where `None`.
    pub window: Option<f64>,
    /// \[s\] every step divides it: the period of a controller; see [`unit()`] where `None`.
    pub period: Option<f64>,
    /// The folder that results are kept in; nothing is kept where `None`.
    pub cache: Option<PathBuf>,
    /// The scene that ships under the scene's name: its steps were counted on the target, and those of some of its
    /// variants.
    pub shipped: Option<Scene>,
}

/// Why a survey cannot look at a window.
#[derive(Clone, Debug, PartialEq, thiserror::Error, miette::Diagnostic)]
pub enum WindowError {
    /// Longer than the scene.
    #[error("a window of {} is beyond the scene's duration of {}", display(*window), display(*duration))]
    #[diagnostic(help("a window up to that, or a longer `duration` in the scene"))]
    Long {
        /// \[s\] as asked for.
        window: f64,
        /// \[s\] the scene's.
        duration: f64,
    },
    /// Shorter than anything that can be compared.
    #[error("a window of {} is too short to compare steps in", display(*window))]
    #[diagnostic(help("at least {}, a millionth of the scene's duration", display(SHORTEST * duration)))]
    Short {
        /// \[s\] as asked for.
        window: f64,
        /// \[s\] the scene's duration.
        duration: f64,
    },
    /// No step divides what it has to.
    #[error(
        "no step divides both a period of {} and what a run of the scene divides, {}",
        display(*period), display(*accepted)
    )]
    #[diagnostic(help(
        "a period of which the scene's `every`, or its duration, is a simple multiple or part"
    ))]
    Period {
        /// \[s\] as asked for.
        period: f64,
        /// \[s\] the longest step that a run accepts.
        accepted: f64,
    },
    /// No truth in reasonable time.
    #[error(
        "the scene vibrates at up to {frequency:.1e} Hz: a truth over {} would take hours",
        display(*window)
    )]
    #[diagnostic(help("--window {} or shorter", display(*possible)))]
    Stiff {
        /// \[Hz\] the highest frequency at t = 0.
        frequency: f64,
        /// \[s\] the window.
        window: f64,
        /// \[s\] one that can be done.
        possible: f64,
    },
}

/// What a survey looks at: the longest window, and what its steps divide.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Frame {
    /// \[s\] the longest window.
    pub longest: f64,
    /// \[s\] the time of which every step is a whole part.
    pub unit: f64,
}

/// What a survey of a scene looks at.
///
/// # Errors
/// [`WindowError`] where what was asked for exceeds the scene's duration or is too short to compare
/// steps in, no truth can be had over it, or no step divides the period.
pub fn frame(scene: &Scene, options: &TradeOptions) -> Result<Frame, WindowError> {
    let (asked, duration) = (options.window, scene.duration);
    if let Some(window) = asked {
        if window > duration * (1.0 + 1e-9) {
            return Err(WindowError::Long { window, duration });
        }
        if window < SHORTEST * duration {
            return Err(WindowError::Short { window, duration });
        }
    }
    let window = asked.unwrap_or(LONGEST).min(duration);
    let frequencies = Frequencies::of(scene);
    let highest = frequencies.estimate;
    if highest * window > FURTHEST {
        let possible = dbd_plant::time::rounded(0.5 * FURTHEST / highest, 1);
        let frequency = frequencies.estimate_hz();
        return Err(WindowError::Stiff { frequency, window, possible });
    }
    match unit(scene, options.period, highest) {
        Some(unit) => Ok(Frame { longest: window, unit }),
        None => Err(WindowError::Period {
            period: options.period.unwrap_or(duration),
            accepted: unit(scene, None, 0.0).unwrap_or(duration),
        }),
    }
}
