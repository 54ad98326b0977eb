//! A running plant and the state of its live view.

use dbd_plant::failure::Remedy;
use dbd_plant::instance::Instance;
use dbd_plant::monitor::{Monitor, RunFailure};
use dbd_plant::plan::{Request, StepRequest, plan};
use dbd_plant::{FailedRun, Plan};
use dbd_report::loading::Loading;
use dbd_report::picture::Mechanism;
use dbd_scene::Scene;

use crate::refused::Refused;
use crate::session::asked::{Change, Grab};
use crate::session::kept::Marks;

/// Maximum length of a scene's text in bytes.
pub const MAX_TEXT: usize = 10_000_000;

/// A scene's plant and the state of its live view.
pub struct Session {
    pub(super) instance: Instance,
    /// The scene's text, its file's name, settings and changes.
    pub(super) asked: Change,
    pub(super) plan: Plan,
    pub(super) monitor: Monitor,
    pub(super) loading: Loading,
    pub(super) mechanism: Mechanism,
    /// Whether anything outside the scene acted on the plant: its energy balance is then not meaningful.
    pub(super) disturbed: bool,
    pub(super) run_failure: Option<RunFailure>,
    pub(super) grab: Option<Grab>,
    /// \[J\] work of the hand.
    pub(super) work: f64,
    /// \[J\] at the start.
    pub(super) energy_at_start: f64,
    pub(super) marks: Marks,
    /// Recorded inputs: time \[s\], input, value.
    pub(super) inputs_set: Vec<(f64, usize, f64)>,
    pub(super) watched: Vec<usize>,
    pub(super) frame: Vec<f64>,
}

impl Session {
    /// A session of a scene at t = 0.
    ///
    /// # Errors
    /// If the scene or the settings are invalid, with the messages of the command line.
    pub fn open(asked: Change) -> Result<Self, Refused> {
        if asked.text.len() > MAX_TEXT {
            return Err(Refused::new(
                format!("the text of {} bytes is too long for the page", asked.text.len()),
                format!("use at most {MAX_TEXT} bytes; host-sim run accepts more"),
            ));
        }
        let instance = asked.instance()?;
        Ok(Self::of(asked, instance))
    }

    pub(super) fn of(asked: Change, instance: Instance) -> Self {
        let (scene, plant) = (instance.scene(), instance.plant());
        let mechanism = Mechanism::of(scene);
        let (monitor, plan) = (Monitor::new(scene, plant), planned(&instance));
        let loading = Loading::new(scene, &mechanism, plant.model().clone(), plant.step_size());
        let energy_at_start = plant.energy().total();
        let watched = (readouts(scene)..instance.outputs().len()).collect();
        Self {
            instance,
            asked,
            plan,
            monitor,
            loading,
            mechanism,
            disturbed: false,
            run_failure: None,
            grab: None,
            work: 0.0,
            energy_at_start,
            marks: Marks::default(),
            inputs_set: Vec::new(),
            watched,
            frame: Vec::new(),
        }
    }

    /// The plant with its names.
    #[must_use]
    pub fn instance(&self) -> &Instance {
        &self.instance
    }

    /// Whether a step failed; the plant then stops until [`Self::reset`], [`Self::rewind`] or a change.
    #[must_use]
    pub fn has_failed(&self) -> bool {
        self.run_failure.is_some()
    }

    /// Advances by the given number of steps, or up to a failing one; returns the number done.
    pub fn advance(&mut self, steps: u64) -> u64 {
        let start = self.instance.plant().steps();
        let end = start + steps;
        while self.run_failure.is_none() {
            let done = self.instance.plant().steps();
            if done == end {
                break;
            }
            // Same checks as in `run`.
            let stride = self.plan.unseen();
            let mut next = end.min((done / stride + 1) * stride);
            if self.grab.is_some() {
                next = next.min(done + self.pull(end - done));
            }
            if let Err(failure) = self.instance.plant_mut().advance(next - done) {
                self.run_failure = Some(RunFailure::Step(failure.cause));
            } else if next.is_multiple_of(stride) {
                self.look();
            }
        }
        self.instance.plant().steps() - start
    }

    /// Checks the state as `run` does.
    fn look(&mut self) {
        let state = self.instance.plant().state();
        self.run_failure = match self.monitor.check(&state) {
            Err(RunFailure::Growth { .. } | RunFailure::Torn { .. }) if self.disturbed => None,
            Err(run_failure) => Some(run_failure),
            Ok(_) => None,
        };
    }

    /// Holds an input, one of [`Instance::inputs`], until it is set again.
    ///
    /// # Errors
    /// If there is no such input or the value is invalid.
    pub fn set_input(&mut self, row: usize, value: f64) -> Result<(), Refused> {
        self.instance.set_input(row, value)?;
        self.disturbed = true;
        self.inputs_set.push((self.instance.time(), row, value));
        Ok(())
    }

    /// Resets to t = 0 with the initial inputs.
    pub fn reset(&mut self) {
        self.instance.reset();
        self.begin();
    }

    /// Starts a new run from the present state.
    fn begin(&mut self) {
        let (scene, plant) = (self.instance.scene(), self.instance.plant());
        self.monitor = Monitor::new(scene, plant);
        (self.disturbed, self.run_failure, self.grab, self.work) = (false, None, None, 0.0);
        self.energy_at_start = plant.energy().total();
        self.marks = Marks::default();
        self.inputs_set.clear();
    }

    /// Sets the outputs at the end of every frame, by their indices in [`Instance::outputs`].
    ///
    /// # Errors
    /// Where there is no such output.
    pub fn watch(&mut self, rows: Vec<usize>) -> Result<(), Refused> {
        let count = self.instance.outputs().len();
        if let Some(row) = rows.iter().find(|row| **row >= count) {
            return Err(Refused::new(
                format!("there is no output {row}"),
                format!("the scene has {count}"),
            ));
        }
        self.watched = rows;
        Ok(())
    }

    /// Failure and remedy with the messages of `run`; `None` if it has not failed. The search for a remedy may take
    /// seconds; it is made only if nothing outside the scene acted on the plant.
    #[must_use]
    pub fn diagnose(&self) -> Option<(String, String)> {
        let run_failure = self.run_failure?;
        let (scene, plant) = (self.instance.scene(), self.instance.plant());
        let failed = plant.steps();
        let plan = Plan { steps: self.plan.steps.max(failed), ..self.plan };
        let run = match self.disturbed {
            false => FailedRun::new(
                scene,
                plant.method(),
                &plan,
                None,
                failed,
                run_failure,
                &mut |_, _| (),
            ),
            true => FailedRun::untried(scene, &plan, failed, run_failure),
        };
        let advice = match run.remedy {
            Remedy::Unsought => {
                "use a shorter step or smaller changes; reset, or go back to an earlier moment"
                    .to_owned()
            }
            _ => run.advice(),
        };
        Some((run.to_string(), advice))
    }

    /// The scene's text, and the options of `host-sim run` for the changes on the page.
    #[must_use]
    pub fn scene_text(&self) -> (&str, String) {
        let set = self.asked.set.iter().map(|(path, value)| format!(" --set '{path}={value:?}'"));
        (&self.asked.text, set.collect())
    }

    /// The request.
    #[must_use]
    pub fn asked(&self) -> &Change {
        &self.asked
    }
}

/// The run that `host-sim run` would make.
fn planned(instance: &Instance) -> Plan {
    let scene = instance.scene();
    let step = StepRequest::Given(instance.step_size());
    let request = |every| Request { step, duration: scene.duration, every };
    // A user-defined step need not divide the duration.
    let near = |_| {
        let steps = (scene.duration / instance.step_size()).ceil().max(1.0);
        Plan {
            step: instance.step_size(),
            duration: scene.duration,
            steps: steps as u64,
            stride: 1,
        }
    };
    plan(&request(scene.every)).unwrap_or_else(near)
}

/// The first output of a scene that is a sensor.
pub(super) fn readouts(scene: &Scene) -> usize {
    scene.body_names.len() * dbd_scene::BODY_COLUMNS.len() + dbd_scene::ENERGY_COLUMNS.len()
}
