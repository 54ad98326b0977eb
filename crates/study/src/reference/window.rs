//! The window before chaos takes over: how long two truths from nearly one state stay near.
//!
//! `(scene, longest, samples, factor) => window, growth`. The truth is run a second time from a
//! state perturbed by 1e-9 m and 1e-9 rad per body, along fixed directions. The growth is the
//! distance of the two at a sample over that at t = 0, each the root mean square over bodies. The
//! window ends with the last sample before the growth first exceeds the factor: beyond it an
//! error of the state, of a step or of rounding says more of the mechanism than of the scheme.

use dbd_scene::Scene;
use nalgebra::{UnitQuaternion, Vector3};

use crate::reference::mechanism::Mechanism;
use crate::reference::metric::distance;
use crate::reference::state::State;
use crate::reference::trajectory::sample_times;
use crate::reference::truth::{NoTruth, Opinion, integrate};

/// \[m\], \[rad\] by how much a body is perturbed.
pub const PERTURBATION: f64 = 1e-9;

/// The growth up to which a trajectory is worth comparing, where nothing else is said: an error
/// made early in the window weighs a thousand times one made late.
pub const GROWTH: f64 = 1e3;

/// A window and what ended it.
#[derive(Clone, Debug, PartialEq)]
pub struct Window {
    /// \[s\] its end.
    pub end: f64,
    /// \[s\] the samples' times up to the longest window.
    pub times: Vec<f64>,
    /// The growth at each.
    pub growth: Vec<f64>,
}

/// The window of a scene, `longest` \[s\] at most, looked at in `samples` equal intervals.
///
/// # Errors
/// Where an integrator gives up.
pub fn before_chaos(
    scene: &Scene,
    longest: f64,
    samples: u32,
    factor: f64,
) -> Result<Window, NoTruth> {
    let (mechanism, start) = Mechanism::of(scene);
    let times = sample_times(longest, samples);
    let truth = integrate(Opinion::Dop853, &mechanism, &start, &times)?;
    let other = integrate(Opinion::Dop853, &mechanism, &perturbed(&start), &times)?;
    let apart = |(a, b): (&State, &State)| distance(&a.positions(), &b.positions());
    let distances: Vec<f64> = truth.iter().zip(&other).map(apart).collect();
    let growth: Vec<f64> = distances.iter().map(|d| d / distances[0]).collect();
    let beyond = growth.iter().position(|growth| *growth > factor).unwrap_or(times.len());
    Ok(Window { end: times[beyond.saturating_sub(1)], times, growth })
}

/// The state with every body moved and turned by [`PERTURBATION`], each along its own direction:
/// points of a golden spiral on the sphere.
#[must_use]
pub fn perturbed(state: &State) -> State {
    let mut state = state.clone();
    let count = 2 * state.bodies.len();
    let direction = |i: usize| {
        let z = 1.0 - (2 * i + 1) as f64 / count as f64;
        let (sin, cos) = (i as f64 * 2.399_963_229_728_653).sin_cos();
        let radius = (1.0 - z * z).sqrt();
        Vector3::new(radius * cos, radius * sin, z) * PERTURBATION
    };
    for (row, body) in state.bodies.iter_mut().enumerate() {
        body.position += direction(2 * row);
        body.orientation *= UnitQuaternion::from_scaled_axis(direction(2 * row + 1));
    }
    state
}
