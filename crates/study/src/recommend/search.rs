//! Search over the methods of a scene, cheapest first, each run only if it may be the best.

mod outcome;

use std::collections::BTreeMap;

use dbd_plant::monitor::Monitor;
use dbd_plant::{Frequencies, Method, PlantError, plant};
use dbd_scene::Scene;

use crate::cache::Head;
use crate::costs::Costs;
use crate::estimate;
use crate::limits::{Limit as Bounds, Limits};
use crate::recommend::request::{Request, ceiling};
use crate::recommend::verify::{Ends, FURTHER, Followed, ends, follow};
use crate::reference::Mechanism;
use crate::reference::State;
use crate::reference::metric::Metric;
use crate::variants::{AS_IT_IS, Variant, counted_as, distance, variants};
use crate::ways::{Way as Stepped, ways};

pub(super) use outcome::load;

/// Maximum number of steps tried per method.
const TRIES: usize = 6;

/// Safety factor on a step from the convergence order.
const SAFER: f64 = 1.1;

/// An error that falls by less is no longer that of the step.
const FALLS: f64 = 0.9;

/// Maximum load of a step, in multiples of the microcontroller's usual clock.
const HOPELESS: f64 = 20.0;

/// Maximum steps × bodies of a run for accuracy: more exceed the capacity of a microcontroller.
const AFFORDABLE: f64 = 1e8;

/// A step that failed later is followed by one that is shorter by this factor.
const SHORTER: f64 = 0.7;

/// A method whose step would be shorter than the largest advised one by more than this factor is abandoned.
const LEAST: f64 = 1.0 / 64.0;

/// A model of the mechanism and what bounds its steps.
pub(super) struct Model {
    pub(super) name: &'static str,
    pub(super) scene: Scene,
    /// Its name in the table of costs.
    counted: Option<String>,
    limits: Limits,
    frequencies: Frequencies,
    /// Failure with short steps, if checked.
    ends: Option<Option<Ends>>,
}

/// Failures beyond the window of comparison.
#[derive(Clone, Copy, Debug)]
struct Failed {
    /// \[s\] no step of it is longer.
    most: f64,
    /// \[s\] when a longer one failed.
    at: f64,
}

/// A method for a model.
#[derive(Clone, Copy, Debug)]
pub(super) struct Candidate {
    pub(super) model: usize,
    pub(super) method: Method,
    /// Instructions of a step on the microcontroller.
    instructions: f64,
    counted: bool,
    /// \[s\] no step of it is longer.
    ceiling: f64,
}

/// A candidate at a step.
#[derive(Clone, Copy, Debug)]
pub(super) struct Trial {
    pub(super) candidate: usize,
    pub(super) method: Method,
    pub(super) step: f64,
    pub(super) error: f64,
    pub(super) instructions: f64,
    /// Whether it is the longest step that its stability allows.
    longest: bool,
}

impl Trial {
    /// Instructions per simulated second.
    pub(super) fn cost(&self) -> f64 {
        self.instructions / self.step
    }
}

/// All candidates and their known data.
pub(super) struct Search<'s> {
    pub(super) scene: &'s Scene,
    request: &'s Request,
    pub(super) head: Head,
    reference_solution: Vec<State>,
    travel: f64,
    models: Vec<Model>,
    pub(super) candidates: Vec<Candidate>,
    bounds: BTreeMap<(usize, String), Bounds>,
    errors: BTreeMap<(usize, u64), Option<f64>>,
    /// By candidates.
    failed: BTreeMap<usize, Failed>,
}

impl<'s> Search<'s> {
    pub(super) fn new(
        scene: &'s Scene,
        request: &'s Request,
        head: Head,
        reference_solution: Vec<State>,
    ) -> Self {
        let own = Variant { name: AS_IT_IS, scene: scene.clone() };
        let model = |Variant { name, scene }: Variant| Model {
            name,
            counted: request.shipped.as_ref().and_then(|shipped| counted_as(shipped, &scene)),
            limits: Limits::of(&scene),
            frequencies: Frequencies::of(&scene),
            scene,
            ends: None,
        };
        let models: Vec<Model> = [own].into_iter().chain(variants(scene)).map(model).collect();
        let metric = Metric::of(&Mechanism::of(scene).0);
        let ways =
            reference_solution.iter().map(|state| metric.distance(&reference_solution[0], state));
        let travel = ways.fold(0.0, f64::max);
        let mut search = Self {
            scene,
            request,
            head,
            reference_solution,
            travel,
            models,
            candidates: Vec::new(),
            bounds: BTreeMap::new(),
            errors: BTreeMap::new(),
            failed: BTreeMap::new(),
        };
        search.candidates = search.all();
        search
    }

    /// All methods of all models with known cost, in ascending order of their lower cost bound.
    fn all(&self) -> Vec<Candidate> {
        let costs = Costs::shipped();
        let mut all = Vec::new();
        for (row, model) in self.models.iter().enumerate() {
            let methods = ways(&model.scene, false).into_iter().filter_map(|way| way.method());
            for method in methods {
                let Some((instructions, counted)) = self.instructions(model, &method, &costs)
                else {
                    continue;
                };
                let ceiling = ceiling(&model.frequencies, &method).min(self.head.grid.unit());
                all.push(Candidate { model: row, method, instructions, counted, ceiling });
            }
        }
        let least = |candidate: &Candidate| candidate.instructions / candidate.ceiling;
        all.sort_by(|a, b| least(a).total_cmp(&least(b)));
        all
    }

    /// Instructions of a step on the microcontroller, and whether they were counted.
    fn instructions(&self, model: &Model, method: &Method, costs: &Costs) -> Option<(f64, bool)> {
        let counted = model.counted.as_ref().and_then(|called| {
            costs.instructions_per_step(
                called,
                method.scheme_name(),
                method.newton(),
                method.foreign_damping().map(|damping| damping.name()),
                method.precision_name(),
                method.orientation_name(),
            )
        });
        let on_m4f = match counted {
            Some(counted) => counted,
            None => estimate::instructions(&model.scene, method, costs)?,
        };
        let here = self.request.mcu.instructions(method.precision(), on_m4f)?;
        Some((here, counted.is_some()))
    }

    /// \[m\] displacement of the bodies from their start.
    pub(super) fn travel(&self) -> f64 {
        self.travel
    }

    pub(super) fn model(&self, trial: &Trial) -> &Scene {
        &self.models[self.candidates[trial.candidate].model].scene
    }

    /// How long a step of a candidate may be.
    fn bounds(&mut self, candidate: Candidate) -> Bounds {
        let way = Stepped::Kernel(candidate.method);
        let limits = &self.models[candidate.model].limits;
        let decisive = limits.decisive(&way);
        let label =
            decisive.map_or_else(String::new, |method| Stepped::Kernel(method).stepper().label());
        let key = (candidate.model, format!("{label} of {}", way.stability_limit()));
        *self
            .bounds
            .entry(key)
            .or_insert_with(|| limits.limit(&way, decisive.map(|method| limits.found(&method))))
    }

    /// \[m\] error of a candidate with the given steps per interval; `None` if it fails.
    fn error(&mut self, candidate: usize, steps: u64) -> Option<f64> {
        if let Some(known) = self.errors.get(&(candidate, steps)) {
            return *known;
        }
        let Candidate { model, method, .. } = self.candidates[candidate];
        let error = self.measured(&self.models[model].scene, &method, steps);
        self.errors.insert((candidate, steps), error);
        error
    }

    /// \[m\] error of a run of a model by a method; `None` if it fails.
    pub(super) fn measured(&self, model: &Scene, method: &Method, steps: u64) -> Option<f64> {
        let states = self.run(model, method, steps)?;
        let error = distance((self.scene, &self.reference_solution), (model, &states));
        Some(error).filter(|error| error.is_finite())
    }

    /// The states of a model at the samples, t = 0 first.
    pub(super) fn run(&self, model: &Scene, method: &Method, steps: u64) -> Option<Vec<State>> {
        let mut plant = plant(model, method, self.head.grid.step(steps)).ok()?;
        let mut monitor = Monitor::new(model, plant.as_ref());
        let mut states = vec![State::of(&plant.state())];
        while states.len() < self.reference_solution.len() {
            let state = plant.advance(steps).is_ok().then(|| plant.state())?;
            monitor.check(&state).ok()?;
            states.push(State::of(&state));
        }
        Some(states)
    }

    /// The cheapest method with at most the given error \[m\] whose run was verified, and its steps.
    pub(super) fn verified(&mut self, accuracy: f64) -> Result<Option<(Trial, u64)>, PlantError> {
        while let Some(trial) = self.cheapest(accuracy) {
            if let Some(steps) = self.carried(&trial)? {
                return Ok(Some((trial, steps)));
            }
        }
        Ok(None)
    }

    /// Runs a trial over [`FURTHER`] times the scene's duration, or over the duration if the scene itself fails beyond
    /// it; returns the steps. `None` if it fails: later steps of it are shorter.
    pub(super) fn carried(&mut self, trial: &Trial) -> Result<Option<u64>, PlantError> {
        let (duration, row) = (self.scene.duration, self.candidates[trial.candidate].model);
        let until = if self.ends().is_some() { duration } else { FURTHER * duration };
        let Followed { steps, fails } =
            follow(self.model(trial), &trial.method, trial.step, until)?;
        let Some(at) = fails else { return Ok(Some(steps)) };
        for row in [0, row] {
            let Model { scene, ends: known, .. } = &mut self.models[row];
            known.get_or_insert_with(|| ends(scene, FURTHER * duration));
        }
        if self.ends().is_some() && at > duration {
            // The scene's duration suffices.
            return self.carried(trial);
        }
        let own = self.models[row].ends.as_ref().and_then(Option::as_ref);
        let hopeless = own.is_some_and(|ends| ends.joint.is_none() && ends.time <= until);
        let shorter = SHORTER * trial.step;
        let least = LEAST * self.bounds(self.candidates[trial.candidate]).advised;
        let most = if hopeless || shorter < least { 0.0 } else { shorter };
        self.failed.insert(trial.candidate, Failed { most, at });
        Ok(None)
    }

    /// Failure of the scene with any step, if found.
    pub(super) fn ends(&self) -> Option<&Ends> {
        self.models[0].ends.as_ref()?.as_ref()
    }

    /// The cheapest method with at most the given error \[m\].
    fn cheapest(&mut self, accuracy: f64) -> Option<Trial> {
        let mut best: Option<Trial> = None;
        for row in 0..self.candidates.len() {
            let candidate = self.candidates[row];
            let cost = best.map_or(f64::INFINITY, |best| best.cost());
            if candidate.instructions / candidate.ceiling >= cost {
                break;
            }
            if let Some(trial) = self.longest(row, accuracy, cost) {
                best = Some(trial);
            }
        }
        best
    }

    /// A candidate's longest step with at most the given error \[m\], if it costs less than `cost`.
    pub(super) fn longest(&mut self, row: usize, accuracy: f64, cost: f64) -> Option<Trial> {
        let candidate = self.candidates[row];
        let Candidate { method, instructions, .. } = candidate;
        let most = self.failed.get(&row).map_or(f64::INFINITY, |failed| failed.most);
        let longest = self.bounds(candidate).advised.min(self.head.grid.unit()).min(most);
        if longest <= 0.0 {
            return None;
        }
        let grid = self.head.grid;
        let (mut steps, mut last) = (grid.steps(longest), f64::INFINITY);
        for attempt in 0..TRIES {
            let step = grid.step(steps);
            let work = steps as f64 * f64::from(grid.samples) * self.scene.body_names.len() as f64;
            let clocks = instructions / step * self.request.mcu.cycles / self.request.mcu.clock;
            let hopeless = attempt > 0 && clocks > HOPELESS;
            if instructions / step >= cost || work > AFFORDABLE || hopeless {
                return None;
            }
            let shorter = match self.error(row, steps) {
                Some(error) if error <= accuracy => {
                    let longest = attempt == 0;
                    return Some(Trial {
                        candidate: row,
                        method,
                        step,
                        error,
                        instructions,
                        longest,
                    });
                }
                // Rounding, or another model, not the step.
                Some(error) if error > FALLS * last => return None,
                Some(error) => {
                    let [_, order] = method.orders().map(|order| f64::from(order.max(1)));
                    let by = SAFER * (error / accuracy).powf(1.0 / order);
                    last = error;
                    by.clamp(1.2, 8.0)
                }
                None => 2.0,
            };
            steps = grid.steps(step / shorter);
        }
        None
    }
}
