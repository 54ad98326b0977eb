//! The reference solution of a scene with interactions or driven bodies: the kernel at fine steps.
//!
//! `(scene, integrator, times) => states`. The references do not implement laws of interactions, which may be user-defined
//! and have internal states, and do not move driven bodies. So these scenes are compared with leapfrog in double precision with short steps; twice the
//! step is the second integrator, and the distance between the two is the uncertainty: of order 2 for smooth forces, of
//! order 1 if a stop is hit within a step.

use dbd_plant::{Frequencies, Method, plant};
use dbd_scene::Scene;

use crate::reference::mechanism::Mechanism;
use crate::reference::perturbed::{perturbation, perturbed as nearby};
use crate::reference::reference_solution::{Integrator, NoReferenceSolution, integrate};
use crate::reference::state::State;

/// Steps of the reference solution per default step of leapfrog.
const FINER: f64 = 32.0;

/// Whether the references implement everything that a scene has.
#[must_use]
pub fn is_implemented(scene: &Scene) -> bool {
    scene.model.laws.is_empty() && !scene.model.bodies.iter().any(dbd_kernel::Body::is_driven)
}

/// The states of a scene at ascending times \[s\] from t = 0, equally spaced; `perturbed` from a state nearby, see
/// [`perturbation`].
///
/// # Errors
/// If the integrator or a step of the kernel fails.
pub fn states(
    integrator: Integrator,
    scene: &Scene,
    perturbed: bool,
    times: &[f64],
) -> Result<Vec<State>, NoReferenceSolution> {
    if !is_implemented(scene) {
        return of_kernel(integrator, scene, perturbed, times);
    }
    let (mechanism, start) = Mechanism::of(scene);
    let start = if perturbed { nearby(&start) } else { start };
    integrate(integrator, &mechanism, &start, times)
}

fn of_kernel(
    integrator: Integrator,
    scene: &Scene,
    perturbed: bool,
    times: &[f64],
) -> Result<Vec<State>, NoReferenceSolution> {
    let mut scene = scene.clone();
    if perturbed {
        // A perturbation leads out of a plane.
        scene.planar = None;
    }
    let method = Method::default();
    let finer = match integrator {
        Integrator::Dop853 => FINER,
        Integrator::Verner98 => FINER / 2.0,
    };
    let limit = Frequencies::of(&scene).default_limit(&method, scene.duration) / finer;
    let interval = times.get(1).copied().unwrap_or(limit);
    let steps = (interval / limit).ceil().max(1.0) as u64;
    let refuse = |time: f64, reason: String| NoReferenceSolution { time, reason };
    let mut plant = plant(&scene, &method, interval / steps as f64)
        .map_err(|error| refuse(0.0, error.to_string()))?;
    if perturbed {
        let mut state = plant.state();
        perturbation(&mut state);
        plant.set_state(&state).map_err(|error| refuse(0.0, error.to_string()))?;
    }
    let mut states = vec![State::of(&plant.state())];
    while states.len() < times.len() {
        if plant.advance(steps).is_err() {
            return Err(refuse(plant.time(), "a step of the kernel failed".into()));
        }
        states.push(State::of(&plant.state()));
    }
    Ok(states)
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::reference::metric::Metric;

    /// A ball of 1 kg, with or without a floor.
    fn ball(floor: &str) -> Scene {
        let text = format!(
            "name = \"ball\"\nduration = 0.5\ngravity = [0, 0, -9.81]\n[[body]]\nname = \"ball\"\nmass = 1\n\
             inertia = [0.01, 0.01, 0.01]\nposition = [0, 0, 0.1]\n{floor}"
        );
        Scene::parse(&text, "ball.toml").unwrap()
    }

    /// A half swing on a floor of k = 1e4 N/m under gravity in closed form: free fall, a harmonic
    /// contact about -g/ω², free flight.
    #[test]
    fn a_ball_on_its_floor_rebounds_as_in_closed_form() {
        let scene = ball(
            "[[interaction]]\nlaw = \"end-stop\"\nbetween = [\"world\", \"ball\"]\npoints = [[0, 0, 0], [0, 0, 0]]\n\
             normal = [0, 0, 1]\nstiffness = 1e4\ndissipation = 0\n",
        );
        let times: Vec<f64> = (0..=50).map(|row| 0.005 * f64::from(row)).collect();
        let reference_solution = states(Integrator::Dop853, &scene, false, &times).unwrap();
        let second = states(Integrator::Verner98, &scene, false, &times).unwrap();
        let (g, omega) = (9.81, 100.0_f64);
        let fall = (2.0_f64 * 0.1 / g).sqrt();
        let (rest, speed) = (g / omega.powi(2), g * fall);
        // z = -rest + rest·cos(ωt) - v/ω·sin(ωt) is 0 again at:
        let contact = 2.0 * (std::f64::consts::PI - (speed / omega / rest).atan()) / omega;
        let height = |time: f64| match time {
            time if time < fall => 0.1 - 0.5 * g * time * time,
            time if time < fall + contact => {
                let turn = omega * (time - fall);
                -rest + rest * turn.cos() - speed / omega * turn.sin()
            }
            time => {
                let time = time - fall - contact;
                speed * time - 0.5 * g * time * time
            }
        };
        let metric = Metric::of(&Mechanism::of(&scene).0);
        for ((time, state), other) in times.iter().zip(&reference_solution).zip(&second) {
            let off = (state.bodies[0].position.z - height(*time)).abs();
            let apart = metric.distance(state, other);
            assert!(off < 1e-5 && apart < 4e-5, "{time}: off by {off:e}, opinions by {apart:e}");
        }
        assert!(reference_solution.last().unwrap().bodies[0].position.z > 0.05);
    }

    #[test]
    fn without_interactions_it_is_the_reference() {
        let times = [0.0, 0.05, 0.1];
        let scene = ball("");
        let states = states(Integrator::Dop853, &scene, false, &times).unwrap();
        assert!((states[2].bodies[0].position.z - (0.1 - 0.5 * 9.81 * 0.01)).abs() < 1e-12);
    }
}
