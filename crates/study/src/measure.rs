//! Error of a method.
//!
//! `(scene, reference solution, method, steps per interval) => error, energy`, a pure function of its inputs. All start
//! from the reference solution, so t = 0 is not a sample: it would dilute the means.

use crate::reference::implicit::Implicit;
use crate::reference::metric::Metric;
use crate::reference::naive::Naive;
use crate::reference::{Mechanism, State};
use dbd_plant::monitor::{Monitor, conserves_energy};
use dbd_plant::{Method, plant};
use dbd_scene::Scene;

use crate::grid::Grid;
use crate::ways::Way;

/// Result of a run over the window.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Accuracy {
    /// Whether it came to its end without growth beyond all measure.
    pub stable: bool,
    /// Whether its error exceeds the displacement of the reference solution.
    pub lost: bool,
    /// \[m\] root mean square over bodies and samples of the distance from the reference solution.
    pub error: Option<f64>,
    /// \[J\] root mean square over samples of the energy's error, where energy should stay.
    pub energy_rms: Option<f64>,
    /// \[J\] the largest likewise.
    pub energy_peak: Option<f64>,
}

/// A run that did not complete.
pub const UNSTABLE: Accuracy =
    Accuracy { stable: false, lost: false, error: None, energy_rms: None, energy_peak: None };

/// \[m\] A run with an error below this is never lost, however little the scene moves. It is the
/// coarsest accuracy that is spoken of.
const LEAST_TRAVEL: f64 = 1e-3;

/// Data of the comparison.
pub struct Comparison<'c> {
    /// The scene.
    pub scene: &'c Scene,
    /// The times that are compared.
    pub grid: Grid,
    /// Its true state at each, t = 0 first.
    pub reference_solution: &'c [State],
    /// Whether nothing changes its energy.
    pub conservative: bool,
    metric: Metric,
    /// \[m\] the largest displacement of the reference solution from its start.
    travel: f64,
}

impl<'c> Comparison<'c> {
    /// Comparisons of a scene with its reference solution.
    #[must_use]
    pub fn new(scene: &'c Scene, grid: Grid, reference_solution: &'c [State]) -> Self {
        let metric = Metric::of(&Mechanism::of(scene).0);
        let ways =
            reference_solution.iter().map(|state| metric.distance(&reference_solution[0], state));
        let travel = ways.fold(LEAST_TRAVEL, f64::max);
        Self {
            scene,
            grid,
            reference_solution,
            conservative: conserves_energy(scene),
            metric,
            travel,
        }
    }

    /// Error of a method with the given number of steps per interval of the reference solution.
    #[must_use]
    pub fn accuracy(&self, way: &Way, steps: u64) -> Accuracy {
        let step = self.grid.step(steps);
        match way {
            Way::Kernel(method) => self.kernel(method, step, steps),
            Way::NaiveSemiImplicitEuler => {
                self.naive(step, steps, |naive| naive.semi_implicit_euler())
            }
            Way::NaiveLeapfrog => self.naive(step, steps, |naive| naive.leapfrog()),
            Way::LinearlyImplicitEuler => {
                let (mechanism, start) = Mechanism::of(self.scene);
                let mut implicit = Implicit::new(&mechanism, start, step);
                self.accuracy_of(|samples| {
                    for sample in 0..self.reference_solution.len() {
                        if sample > 0 && !(0..steps).all(|_| implicit_step(&mut implicit)) {
                            return;
                        }
                        samples.push(implicit.state.clone());
                    }
                })
            }
        }
    }

    fn kernel(&self, method: &Method, step: f64, steps: u64) -> Accuracy {
        let Ok(mut plant) = plant(self.scene, method, step) else { return UNSTABLE };
        let mut monitor = Monitor::new(self.scene, plant.as_ref());
        let (mut samples, mut squares, mut peak, mut initial) = (Vec::new(), 0.0, 0.0_f64, None);
        for sample in 0..self.reference_solution.len() {
            if sample > 0 && plant.advance(steps).is_err() {
                return UNSTABLE;
            }
            let state = plant.state();
            let Ok(verdict) = monitor.check(&state) else { return UNSTABLE };
            let total = verdict.energy.total();
            let error: f64 = total - *initial.get_or_insert(total);
            squares += error * error;
            peak = peak.max(error.abs());
            samples.push(State::of(&state));
        }
        self.judged(&samples, Some((squares, peak)))
    }

    fn naive(&self, step: f64, steps: u64, advance: impl Fn(&mut Naive<'_>)) -> Accuracy {
        let (mechanism, start) = Mechanism::of(self.scene);
        let mut naive = Naive::new(&mechanism, start, step);
        self.accuracy_of(|samples| {
            for sample in 0..self.reference_solution.len() {
                if sample > 0 {
                    (0..steps).for_each(|_| advance(&mut naive));
                }
                let bodies = &naive.state.bodies;
                if !bodies.iter().all(|body| body.position.iter().all(|x| x.is_finite())) {
                    return;
                }
                samples.push(naive.state.clone());
            }
        })
    }

    fn accuracy_of(&self, run: impl FnOnce(&mut Vec<State>)) -> Accuracy {
        let mut samples = Vec::with_capacity(self.reference_solution.len());
        run(&mut samples);
        self.judged(&samples, None)
    }

    /// The verdict on a run's samples, t = 0 first, with the energy error's square sum and peak if meaningful.
    fn judged(&self, samples: &[State], energy: Option<(f64, f64)>) -> Accuracy {
        let after = samples.get(1..).unwrap_or_default();
        let error = self.metric.error(&self.reference_solution[1..], after);
        if !error.is_finite() {
            return UNSTABLE;
        }
        let energy = energy.filter(|_| self.conservative);
        Accuracy {
            stable: true,
            lost: error > self.travel,
            error: Some(error),
            energy_rms: energy.map(|(squares, _)| (squares / after.len() as f64).sqrt()),
            energy_peak: energy.map(|(_, peak)| peak),
        }
    }
}

/// A step of the implicit reference, while its state is finite; whether it is.
pub fn implicit_step(implicit: &mut Implicit<'_>) -> bool {
    // Without a finite state there is no factor.
    let state = &implicit.state;
    let finite = state.bodies.iter().all(|body| {
        let vectors = [body.position, body.velocity, body.rate];
        vectors.iter().all(|v| v.iter().all(|x| x.is_finite()))
    });
    if finite {
        implicit.step();
    }
    finite
}

#[cfg(test)]
mod tests {
    use dbd_plant::Method;

    use super::*;

    #[test]
    fn the_start_is_no_sample() {
        let text = "name = \"a\"\nduration = 0.05\nevery = 1e-3\n[[body]]\nname = \"b\"\n\
                    mass = 1.0\nposition = [0.0, 0.0, 0.0]\ninertia = [1.0, 1.0, 1.0]\n";
        let scene = Scene::parse(text, "a.toml").unwrap();
        let grid = Grid::new(1e-3, 0.05);
        // The body rests; the reference solution differs by a millimetre from the first sample on.
        let start = Mechanism::of(&scene).1;
        let mut reference_solution = vec![start; grid.times().len()];
        reference_solution[1..].iter_mut().for_each(|state| state.bodies[0].position.x = 1e-3);
        let comparison = Comparison::new(&scene, grid, &reference_solution);
        for way in [Way::Kernel(Method::default()), Way::NaiveLeapfrog] {
            let accuracy = comparison.accuracy(&way, 2);
            assert!((accuracy.error.unwrap() / 1e-3 - 1.0).abs() < 1e-12, "{accuracy:?}");
        }
    }
}
