//! A request, a measured method, and the limit of its step.

use dbd_plant::{Frequencies, Method};
use dbd_scene::Scene;
use serde::Serialize;

use crate::recommend::mcu::Mcu;
use crate::stability::MARGIN;

/// A request.
#[derive(Clone, Debug)]
pub struct Request {
    /// The microcontroller.
    pub mcu: &'static Mcu,
    /// \[Hz\] its clock.
    pub clock: f64,
    /// \[Hz\] a controller's rate: a whole number of steps makes its period.
    pub rate: Option<f64>,
    /// \[m\] root mean square of bodies and time; a hundredth of the bodies' displacement if `None`.
    pub accuracy: Option<f64>,
    /// \[s\] the longest window of comparison, as of a survey.
    pub window: Option<f64>,
    /// The scene that ships under the scene's name: its steps were counted.
    pub shipped: Option<Scene>,
}

/// Limit of a step.
#[derive(Clone, Debug, PartialEq, Serialize)]
#[serde(tag = "kind", rename_all = "kebab-case")]
pub enum Limit {
    /// The stability of vibrations.
    Vibration {
        /// \[Hz\] the highest frequency at t = 0.
        frequency_hz: f64,
        /// The part with the highest frequency: ``joint `wrist` ``.
        element: Option<String>,
    },
    /// The rotation of the fastest body.
    Spin {
        /// Its name.
        body: String,
    },
    /// The requested accuracy.
    Accuracy,
    /// Frequencies and speeds rise along the motion: a longer step, stable at t = 0, fails later.
    Motion {
        /// \[s\] when it failed.
        fails: f64,
    },
    /// The step divides the controller's period, or the time unit of duration and sampling interval.
    Period,
}

/// A measured method.
#[derive(Clone, Debug, PartialEq, Serialize)]
pub struct Way {
    /// Which model of the mechanism: `as it is`, `bushing`, `planar` ….
    pub model: String,
    /// The scheme's name.
    pub scheme: &'static str,
    /// Newton iterations, for the schemes that have them.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub newton: Option<u32>,
    /// The damping mode, if it is not the scheme's default.
    pub damping: Option<&'static str>,
    /// The precision's name.
    pub precision: &'static str,
    /// \[s\] the step.
    pub step: f64,
    /// \[m\] root mean square over bodies and samples of the distance from the reference solution.
    pub error: f64,
    /// Instructions of a step on the microcontroller.
    pub instructions: f64,
    /// Whether these were counted of exactly this model and method; else they are an estimate.
    pub counted: bool,
    /// \[1\] the CPU load.
    pub load: f64,
}

/// \[s\] The longest step of a method that is [`MARGIN`] below a stable one and rotates no body too far.
pub(super) fn ceiling(frequencies: &Frequencies, method: &Method) -> f64 {
    let limit = |frequency: f64| {
        if frequency > 0.0 { method.stability_limit() / frequency } else { f64::INFINITY }
    };
    ((1.0 - MARGIN) * limit(frequencies.estimate)).min(frequencies.longest_turn())
}
