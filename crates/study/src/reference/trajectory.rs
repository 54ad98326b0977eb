//! Trajectories: the reference solution at sample times with its uncertainty, and the error of a run.
//!
//! `(scene, window, samples) => times, states, uncertainty`; `(reference, run) => error \[m\]`. An error
//! is the root mean square over bodies of the distance between their centres of mass, per sample;
//! of a whole run the root mean square over the samples.

use dbd_plant::{Method, plant};
use dbd_scene::Scene;
use nalgebra::Vector3;

use crate::reference::fine::states;
use crate::reference::mechanism::Mechanism;
use crate::reference::metric::distance;
use crate::reference::reference_solution::{Integrator, NoReferenceSolution, integrate};
use crate::reference::state::State;

/// The positions of all bodies \[m\] at one time.
pub type Positions = Vec<Vector3<f64>>;

/// The reference solution of a scene.
#[derive(Clone, Debug, PartialEq)]
pub struct Trajectory {
    /// \[s\] equally spaced, the first 0, the last the window's end.
    pub times: Vec<f64>,
    /// The states at the times.
    pub states: Vec<State>,
    /// \[m\] distance of the second solution at each time.
    pub uncertainty: Vec<f64>,
}

/// Times of `samples` equal intervals \[s\], both ends included.
#[must_use]
pub fn sample_times(window: f64, samples: u32) -> Vec<f64> {
    (0..=samples).map(|i| window * f64::from(i) / f64::from(samples)).collect()
}

impl Trajectory {
    /// The reference solution of a scene over `window` \[s\] in `samples` equal intervals.
    ///
    /// # Errors
    /// If an integrator fails.
    pub fn reference_solution(
        scene: &Scene,
        window: f64,
        samples: u32,
    ) -> Result<Self, NoReferenceSolution> {
        let times = sample_times(window, samples);
        let [states, second] = [Integrator::Dop853, Integrator::Verner98]
            .map(|integrator| states(integrator, scene, false, &times));
        Ok(Self::of(times, states?, &second?))
    }

    /// The reference solution of a mechanism at ascending times \[s\] from a state at t = 0.
    ///
    /// # Errors
    /// If an integrator fails.
    pub fn reference_solution_of(
        mechanism: &Mechanism,
        start: &State,
        times: Vec<f64>,
    ) -> Result<Self, NoReferenceSolution> {
        let states = integrate(Integrator::Dop853, mechanism, start, &times)?;
        let second = integrate(Integrator::Verner98, mechanism, start, &times)?;
        Ok(Self::of(times, states, &second))
    }

    fn of(times: Vec<f64>, states: Vec<State>, second: &[State]) -> Self {
        let pairs = states.iter().zip(second);
        let uncertainty = pairs.map(|(a, b)| distance(&a.positions(), &b.positions())).collect();
        Self { times, states, uncertainty }
    }

    /// \[m\] the largest uncertainty of all samples.
    #[must_use]
    pub fn largest_uncertainty(&self) -> f64 {
        self.uncertainty.iter().fold(0.0, |most, u| most.max(*u))
    }

    /// \[m\] the error of a run at each of its samples.
    #[must_use]
    pub fn errors(&self, run: &[Positions]) -> Vec<f64> {
        let pairs = self.states.iter().zip(run);
        pairs.map(|(state, positions)| distance(&state.positions(), positions)).collect()
    }

    /// \[m\] the error of a whole run; infinite where it lacks samples or is not finite.
    #[must_use]
    pub fn error(&self, run: &[Positions]) -> f64 {
        let errors = self.errors(run);
        let mean = errors.iter().map(|e| e * e).sum::<f64>() / self.times.len() as f64;
        if errors.len() == self.times.len() && mean.is_finite() {
            mean.sqrt()
        } else {
            f64::INFINITY
        }
    }

    /// Runs a method of the kernel on the scene, `steps` steps from sample to sample. It ends
    /// early where a step fails.
    ///
    /// # Panics
    /// Where there is no plant of the method with the interval over `steps` as its step.
    #[must_use]
    pub fn run(&self, scene: &Scene, method: &Method, steps: u64) -> Vec<Positions> {
        let interval = self.times.get(1).copied().unwrap_or_default();
        let plant = plant(scene, method, interval / steps as f64);
        let mut plant = plant.unwrap_or_else(|error| panic!("{error}"));
        let mut run = Vec::with_capacity(self.times.len());
        while run.len() < self.times.len() {
            let state = plant.state();
            run.push(state.bodies.iter().map(|b| Vector3::from(b.position.to_f64())).collect());
            if plant.advance(steps).is_err() {
                break;
            }
        }
        run
    }
}
