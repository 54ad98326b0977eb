//! How the energy of a run drifts.
//!
//! `(scene, method, step, window) => rate, band`. The rate is the slope of a straight line through the
//! energy's samples: its oscillation within a step or a period, which a method of first order has, is
//! no drift and is in the band.

use std::f64::consts::TAU;

use crate::reference::Mechanism;
use crate::reference::implicit::Implicit;
use dbd_kernel::energy::energy;
use dbd_kernel::{BodyState, State};
use dbd_plant::{Method, plant};
use dbd_scene::Scene;

use crate::measure::implicit_step;
use crate::paper::context::PaperError;
use crate::paper::fit::least_squares;

/// Samples of a window.
const SAMPLES: u64 = 1000;

/// The drift of a run.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Drift {
    /// \[J/s\] slope of a straight line through the samples.
    pub rate: f64,
    /// \[J\] largest deviation from the energy at the window's begin.
    pub band: f64,
}

/// The drift of a run from `begin` to `end` \[s\]; `None` where it fails on the way.
///
/// # Errors
/// [`PaperError::Plant`] where the scene cannot be stepped so.
pub fn drift(
    scene: &Scene,
    method: &Method,
    step: f64,
    [begin, end]: [f64; 2],
) -> Result<Option<Drift>, PaperError> {
    let mut plant = plant(scene, method, step)?;
    let steps_to = |time: f64| (time / step).round() as u64;
    if plant.advance(steps_to(begin)).is_err() {
        return Ok(None);
    }
    let every = ((steps_to(end) - steps_to(begin)) / SAMPLES).max(1);
    let mut samples = vec![[plant.time(), plant.energy().total()]];
    while plant.steps() + every <= steps_to(end) {
        if plant.advance(every).is_err() {
            return Ok(None);
        }
        samples.push([plant.time(), plant.energy().total()]);
    }
    Ok(of(&samples))
}

/// The drift of the reference's linearly implicit Euler likewise.
#[must_use]
pub fn drift_of_implicit(scene: &Scene, step: f64, end: f64) -> Option<Drift> {
    let (mechanism, start) = Mechanism::of(scene);
    let mut implicit = Implicit::new(&mechanism, start, step);
    let model = &*scene.in_world();
    let mut state = State::initial(model);
    let steps = (end / step).round() as u64;
    let every = (steps / SAMPLES).max(1);
    let mut samples = Vec::new();
    for done in 0..=steps {
        if done % every == 0 {
            for (body, now) in state.bodies.iter_mut().zip(&implicit.state.bodies) {
                let q = now.orientation;
                *body = BodyState::from_f64(
                    now.position.into(),
                    [q.w, q.i, q.j, q.k],
                    now.velocity.into(),
                    now.rate.into(),
                );
            }
            for (turns, torsion_angle) in state.turns.iter_mut().zip(&implicit.state.torsion_angles)
            {
                *turns = (torsion_angle / TAU).round() as _;
            }
            samples.push([done as f64 * step, energy(model, &state, step).total()]);
        }
        if !implicit_step(&mut implicit) {
            return None;
        }
    }
    of(&samples)
}

/// The drift of samples of time \[s\] and energy \[J\]; `None` with fewer than two or where one is not finite.
#[must_use]
pub fn of(samples: &[[f64; 2]]) -> Option<Drift> {
    let [begin, first] = *samples.first()?;
    let rows: Vec<Vec<f64>> = samples.iter().map(|[time, _]| vec![1.0, time - begin]).collect();
    let energies: Vec<f64> = samples.iter().map(|[_, energy]| energy - first).collect();
    if samples.len() < 2 || !energies.iter().all(|energy| energy.is_finite()) {
        return None;
    }
    let (line, _) = least_squares(&rows, &energies)?;
    let band = energies.iter().fold(0.0, |band: f64, energy| band.max(energy.abs()));
    Some(Drift { rate: line[1], band })
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn an_oscillation_is_in_the_band_and_not_in_the_rate() {
        let samples: Vec<[f64; 2]> = (0..=1000)
            .map(|n| {
                let time = 1e-3 * f64::from(n);
                [time, 5.0 + 0.02 * time + 0.1 * (200.0 * std::f64::consts::PI * time).sin()]
            })
            .collect();
        let found = of(&samples).unwrap();
        assert!((found.rate - 0.02).abs() < 2e-3, "{found:?}");
        assert!((0.1..0.13).contains(&found.band), "{found:?}");
        assert_eq!(of(&samples[..1]), None);
        assert_eq!(of(&[[0.0, 1.0], [1.0, f64::NAN]]), None);
    }
}
