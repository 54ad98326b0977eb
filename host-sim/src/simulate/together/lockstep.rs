//! [`simulate_together`] on the lanes of the best instruction set of this machine.

use std::time::{Duration, Instant};

use dbd_ensemble::{
    AnyEnsemble, EnsembleError, InstructionSet, ensemble_in_f32, ensemble_in_f64, lanes_in_f64,
};
use dbd_plant::{Method, Plan, PrecisionName};
use dbd_scene::Scene;

use super::Member;
use crate::simulate::run::{Course, Ending, SimulationError};

/// Number of runs of a method in lockstep on this machine; 1 if lanes do not support it.
#[must_use]
pub fn lanes(method: &Method) -> usize {
    match method.precision() {
        _ if !method.in_lanes() => 1,
        PrecisionName::F32 => 2 * lanes_in_f64(),
        _ => lanes_in_f64(),
    }
}

/// Runs one plan with all members. `None` for a member that has to run alone: its structure differs from the
/// first one's, or it fails.
///
/// # Errors
/// Where there is no plant of the method with the plan's step, or an observer fails.
pub fn simulate_together(
    method: &Method,
    plan: &Plan,
    members: &mut [Member<'_>],
) -> Result<Vec<Option<Ending>>, SimulationError> {
    let mut endings: Vec<Option<Ending>> = members.iter().map(|_| None).collect();
    let mut rows = alike(method, members);
    let Some(mut ensemble) = ensemble(method, plan, members, &mut rows) else {
        return Ok(endings);
    };
    let courses: Result<Vec<_>, _> =
        rows.iter().map(|row| Course::new(members[*row].scene, method, plan)).collect();
    let mut courses: Vec<Option<Course<'_>>> = courses?.into_iter().map(Some).collect();
    let mut wall = Duration::ZERO;
    loop {
        // All have the same plan, so the remaining ones have the same number of steps left.
        let mut next = 0;
        for (instance, row) in rows.iter().enumerate() {
            let Some(course) = &mut courses[instance] else { continue };
            match course.look(members[*row].observer)? {
                Ok(0) => {
                    let evaluations = ensemble.evaluations(instance);
                    if let Some((course, evaluations)) = courses[instance].take().zip(evaluations) {
                        endings[*row] = Some(course.ending(evaluations, wall, None));
                    }
                }
                Ok(steps) => next = steps,
                Err(_) => courses[instance] = None,
            }
        }
        if next == 0 {
            return Ok(endings);
        }
        let start = Instant::now();
        ensemble.advance(next);
        wall += start.elapsed();
        for (instance, course) in courses.iter_mut().enumerate() {
            let Some(going) = course else { continue };
            let arrived = ensemble.status(instance).is_ok()
                && going.plant.set_state(&ensemble.state(instance)).is_ok();
            if !arrived {
                *course = None;
            }
        }
    }
}

/// The members that may run with the first one: lanes support the method, and tables have the same values at the
/// same times, so that all evaluate forces equally often.
fn alike(method: &Method, members: &[Member<'_>]) -> Vec<usize> {
    let Some(first) = members.first().filter(|_| lanes(method) > 1) else { return Vec::new() };
    let tables = &first.scene.model;
    let goes = |scene: &Scene| {
        let model = &scene.model;
        scene.planar.is_none() && model.knots == tables.knots && model.sources == tables.sources
    };
    (0..members.len()).filter(|row| goes(members[*row].scene)).collect()
}

/// An ensemble of these members, without those of another structure, which are removed from `rows`; `None` for fewer
/// than two.
fn ensemble(
    method: &Method,
    plan: &Plan,
    members: &[Member<'_>],
    rows: &mut Vec<usize>,
) -> Option<Box<dyn AnyEnsemble>> {
    let new = match method.precision() {
        PrecisionName::F32 => ensemble_in_f32,
        _ => ensemble_in_f64,
    };
    while rows.len() > 1 {
        let models = rows.iter().map(|row| members[*row].scene.model.clone()).collect();
        match new(models, plan.step, InstructionSet::best()) {
            Ok(ensemble) => return Some(ensemble),
            Err(EnsembleError::Structure { instance, .. }) => drop(rows.remove(instance)),
            Err(_) => return None,
        }
    }
    None
}

#[cfg(test)]
mod tests {
    use std::io;

    use dbd_plant::SchemeName;
    use dbd_plant::plan::{Request, StepRequest, plan};

    use super::*;
    use crate::simulate::{Observer, Sample, simulate};

    /// Keeps all hashes and read-outs.
    #[derive(Debug, Default, PartialEq)]
    struct Seen(Vec<(u64, Vec<f64>, f64)>);

    impl Observer for Seen {
        fn sample(&mut self, sample: &Sample<'_>) -> io::Result<()> {
            self.0.push((sample.hash, sample.readings.to_vec(), sample.energy.total()));
            Ok(())
        }
    }

    /// Three copies of a scene, one that fails during the run and one of another structure.
    fn scenes(name: &str, other: &str) -> Vec<Scene> {
        let path = format!("{}/../scenes/{name}.toml", env!("CARGO_MANIFEST_DIR"));
        let text = std::fs::read_to_string(path).unwrap();
        let scene = |changes: &[&str]| {
            let changes: Vec<String> = changes.iter().map(|change| (*change).to_owned()).collect();
            Scene::parse_with(&text, "scene.toml", &changes).unwrap()
        };
        vec![
            scene(&[]),
            scene(&["gravity[1]=-9"]),
            scene(&["joint.*.stiffness=1e14"]),
            scene(&["gravity[1]=-8"]),
            scene(&[other]),
        ]
    }

    #[test]
    fn a_run_in_lockstep_is_the_run_alone() {
        let (undamped, table) = (
            "joint.*.damping=0",
            "input.close.table=[[0, 0], [0.1, 1], [0.15, 60], [0.7, 60], [0.75, 0]]",
        );
        for (name, other, precision) in [
            ("cart-pendulum", undamped, PrecisionName::F64),
            ("cart-pendulum", undamped, PrecisionName::F32),
            ("gripper", table, PrecisionName::F64),
        ] {
            let scenes = scenes(name, other);
            let method = Method::default().with_precision(precision);
            let step = StepRequest::Given(scenes[0].step.unwrap());
            let duration = 300.0 * scenes[0].step.unwrap();
            let every = Some(7.0 * scenes[0].step.unwrap());
            let plan = plan(&Request { step, duration, every }).unwrap();
            let mut seen: Vec<Seen> = scenes.iter().map(|_| Seen::default()).collect();
            let members = scenes.iter().zip(&mut seen);
            let mut members: Vec<_> =
                members.map(|(scene, observer)| Member { scene, observer }).collect();
            let together = simulate_together(&method, &plan, &mut members).unwrap();
            let came_to_the_end: Vec<bool> = together.iter().map(Option::is_some).collect();
            assert_eq!(came_to_the_end, [true, true, false, true, false], "{precision:?}");
            for (row, ending) in together.into_iter().enumerate() {
                let mut alone = Seen::default();
                let own = simulate(&scenes[row], &method, &plan, &mut alone).unwrap();
                if let Some(ending) = ending {
                    // Rounding is watched of a run alone.
                    let losses = own.losses.clone();
                    assert_eq!(Ending { wall: own.wall, losses, ..ending }, own);
                    assert_eq!(seen[row], alone);
                }
                assert_eq!(own.run_failure.is_some(), row == 2, "{own:?}");
            }
        }
    }

    #[test]
    fn lanes_step_leapfrog_alone() {
        let other = Method::new(SchemeName::Rk4, None, PrecisionName::F64).unwrap();
        assert_eq!(lanes(&other), 1);
        assert!(lanes(&Method::default()) > 1);
    }
}
