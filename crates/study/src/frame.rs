//! Options of a study and their checks: its longest window, and the unit of its steps.
//!
//! `(scene, options) => longest window, unit of steps | error`.

use std::path::PathBuf;

use dbd_plant::Frequencies;
use dbd_plant::time::display;
use dbd_scene::Scene;

use crate::grid::unit;

/// \[s\] Default of the longest window: a mechanism has moved, and a scene of a dozen bodies takes minutes.
const LONGEST: f64 = 0.5;

/// The shortest window, as a fraction of the scene's duration.
const SHORTEST: f64 = 1e-6;

/// \[rad\] Largest phase of the highest frequency within a window; beyond it the reference solution takes over an hour.
const FURTHEST: f64 = 1e7;

/// Options of a study.
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

/// Invalid window of a study.
#[derive(Clone, Debug, PartialEq, thiserror::Error, miette::Diagnostic)]
pub enum WindowError {
    /// Longer than the scene.
    #[error("the window of {} exceeds the scene's duration of {}", display(*window), display(*duration))]
    #[diagnostic(help("use a window up to the duration, or a longer `duration` in the scene"))]
    Long {
        /// \[s\] as requested.
        window: f64,
        /// \[s\] the scene's.
        duration: f64,
    },
    /// Shorter than anything that can be compared.
    #[error("the window of {} is too short to compare steps", display(*window))]
    #[diagnostic(help("use at least {}, a millionth of the scene's duration", display(SHORTEST * duration)))]
    Short {
        /// \[s\] as requested.
        window: f64,
        /// \[s\] the scene's duration.
        duration: f64,
    },
    /// No step divides both intervals.
    #[error(
        "no step divides both the period {} and the scene's time unit of {}",
        display(*period), display(*accepted)
    )]
    #[diagnostic(help(
        "use a period that is a simple multiple or fraction of the scene's `every` or duration"
    ))]
    Period {
        /// \[s\] as requested.
        period: f64,
        /// \[s\] the longest step that a run accepts.
        accepted: f64,
    },
    /// No reference solution in reasonable time.
    #[error(
        "the scene vibrates at up to {frequency:.1e} Hz: a reference solution over {} would take hours",
        display(*window)
    )]
    #[diagnostic(help("use --window {} or shorter", display(*possible)))]
    Stiff {
        /// \[Hz\] the highest frequency at t = 0.
        frequency: f64,
        /// \[s\] the window.
        window: f64,
        /// \[s\] one that can be done.
        possible: f64,
    },
}

/// Frame of a study: the longest window, and the unit of its steps.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Frame {
    /// \[s\] the longest window.
    pub longest: f64,
    /// \[s\] the time that every step divides.
    pub unit: f64,
}

/// The frame of a study of a scene.
///
/// # Errors
/// [`WindowError`] if the requested window exceeds the scene's duration or is too short, its reference solution would
/// take too long, or no step divides the period.
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
