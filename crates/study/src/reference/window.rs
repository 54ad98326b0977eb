//! The window before chaos: how long two reference solutions from nearly equal states stay close.
//!
//! `(scene, longest, samples, factor) => window, growth`. The reference solution is computed a second time from a state
//! [perturbed](crate::reference::perturbed) by 1e-9 m and 1e-9 rad per body. The growth is the distance of the two at a
//! sample over that at t = 0, each the root mean square over bodies. The window ends with the last sample before the
//! growth first exceeds the factor: beyond it errors depend more on the mechanism than on the scheme. If an integrator
//! fails, it ends with the last sample before that.

use dbd_scene::Scene;

use crate::reference::fine::states;
use crate::reference::metric::distance;
use crate::reference::reference_solution::{Integrator, NoReferenceSolution};
use crate::reference::state::State;
use crate::reference::trajectory::sample_times;

/// Default growth up to which a trajectory is compared: an error at the start of the window weighs a thousand times one
/// at its end.
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

/// The window of a scene, `longest` \[s\] at most, sampled in `samples` equal intervals.
///
/// # Errors
/// If an integrator fails within the first interval.
pub fn before_chaos(
    scene: &Scene,
    longest: f64,
    samples: u32,
    factor: f64,
) -> Result<Window, NoReferenceSolution> {
    let mut times = sample_times(longest, samples);
    let both = |times: &[f64]| -> Result<_, NoReferenceSolution> {
        let of = |perturbed| states(Integrator::Dop853, scene, perturbed, times);
        Ok((of(false)?, of(true)?))
    };
    let (reference_solution, other) = loop {
        match both(&times) {
            Ok(both) => break both,
            Err(why) => {
                let reached = times.iter().filter(|time| **time < why.time).count();
                // At least one interval, and fewer than there were.
                if reached < 2 || reached == times.len() {
                    return Err(why);
                }
                times.truncate(reached);
            }
        }
    };
    let apart = |(a, b): (&State, &State)| distance(&a.positions(), &b.positions());
    let distances: Vec<f64> = reference_solution.iter().zip(&other).map(apart).collect();
    let growth: Vec<f64> = distances.iter().map(|d| d / distances[0]).collect();
    let beyond = growth.iter().position(|growth| *growth > factor).unwrap_or(times.len());
    Ok(Window { end: times[beyond.saturating_sub(1)], times, growth })
}
