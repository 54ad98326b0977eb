//! A plant that goes on by steps, and all that a live view of it keeps.

use dbd_kernel::Status;
use dbd_plant::failure::Remedy;
use dbd_plant::instance::Instance;
use dbd_plant::judge::{Judge, Trouble};
use dbd_plant::plan::{Request, StepRequest, plan};
use dbd_plant::{FailedRun, Plan};
use dbd_report::loading::Loading;
use dbd_report::picture::Mechanism;
use dbd_scene::Scene;

use crate::refused::Refused;
use crate::session::asked::{Change, Grab};
use crate::session::kept::Marks;

/// More bytes of text than this are refused.
pub const MOST_TEXT: usize = 10_000_000;

/// A scene's plant and all that a live view of it keeps.
pub struct Session {
    pub(super) instance: Instance,
    /// The scene's text, its file's name, what was chosen and changed.
    pub(super) asked: Change,
    pub(super) plan: Plan,
    pub(super) judge: Judge,
    pub(super) loading: Loading,
    pub(super) mechanism: Mechanism,
    /// Whether anything acted on the plant that the scene does not know: its energy then proves nothing.
    pub(super) disturbed: bool,
    pub(super) trouble: Option<Trouble>,
    pub(super) grab: Option<Grab>,
    /// \[J\] what the hand put in.
    pub(super) work: f64,
    /// \[J\] at the start.
    pub(super) energy_at_start: f64,
    pub(super) marks: Marks,
    /// What inputs were set to: \[s\] when, which, to what.
    pub(super) inputs_set: Vec<(f64, usize, f64)>,
    pub(super) watched: Vec<usize>,
    pub(super) frame: Vec<f64>,
}

impl Session {
    /// A session of a scene at t = 0.
    ///
    /// # Errors
    /// Where the scene or the settings are refused, in the words of the command line.
    pub fn open(asked: Change) -> Result<Self, Refused> {
        if asked.text.len() > MOST_TEXT {
            return Err(Refused::new(
                format!("a text of {} bytes is more than the page takes", asked.text.len()),
                format!("at most {MOST_TEXT} bytes; host-sim run takes more"),
            ));
        }
        let instance = asked.instance()?;
        Ok(Self::of(asked, instance))
    }

    pub(super) fn of(asked: Change, instance: Instance) -> Self {
        let (scene, plant) = (instance.scene(), instance.plant());
        let mechanism = Mechanism::of(scene);
        let (judge, plan) = (Judge::new(scene, plant), planned(&instance));
        let loading = Loading::new(scene, &mechanism, plant.model().clone(), plant.step_size());
        let energy_at_start = plant.energy().total();
        let watched = (readouts(scene)..instance.outputs().len()).collect();
        Self {
            instance,
            asked,
            plan,
            judge,
            loading,
            mechanism,
            disturbed: false,
            trouble: None,
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

    /// Whether a step failed; nothing moves then before [`Self::reset`], [`Self::rewind`] or a change.
    #[must_use]
    pub fn has_failed(&self) -> bool {
        self.trouble.is_some()
    }

    /// Goes on by so many steps, or to the one that fails; how many were done.
    pub fn advance(&mut self, steps: u64) -> u64 {
        let start = self.instance.plant().steps();
        let end = start + steps;
        while self.trouble.is_none() {
            let done = self.instance.plant().steps();
            if done == end {
                break;
            }
            // Where `run` looks at its plant.
            let stride = self.plan.unseen();
            let mut next = end.min((done / stride + 1) * stride);
            if self.grab.is_some() {
                next = next.min(done + self.pull(end - done));
            }
            if let Status::Failed(failure) = self.instance.plant_mut().advance(next - done) {
                self.trouble = Some(Trouble::Step(failure.cause));
            } else if next.is_multiple_of(stride) {
                self.look();
            }
        }
        self.instance.plant().steps() - start
    }

    /// Looks at the state as `run` does.
    fn look(&mut self) {
        let state = self.instance.plant().state();
        self.trouble = match self.judge.judge(&state) {
            Err(Trouble::Growth { .. } | Trouble::Torn { .. }) if self.disturbed => None,
            Err(trouble) => Some(trouble),
            Ok(_) => None,
        };
    }

    /// Holds an input, one of [`Instance::inputs`], until it is set again.
    ///
    /// # Errors
    /// Where there is no such input or it does not take the value.
    pub fn set_input(&mut self, row: usize, value: f64) -> Result<(), Refused> {
        self.instance.set_input(row, value)?;
        self.disturbed = true;
        self.inputs_set.push((self.instance.time(), row, value));
        Ok(())
    }

    /// Goes back to t = 0; inputs have their first values.
    pub fn reset(&mut self) {
        self.instance.reset();
        self.begin();
    }

    /// From here on the run is one of its own.
    fn begin(&mut self) {
        let (scene, plant) = (self.instance.scene(), self.instance.plant());
        self.judge = Judge::new(scene, plant);
        (self.disturbed, self.trouble, self.grab, self.work) = (false, None, None, 0.0);
        self.energy_at_start = plant.energy().total();
        self.marks = Marks::default();
        self.inputs_set.clear();
    }

    /// Outputs whose values every frame ends with, by their places in [`Instance::outputs`].
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

    /// Why it failed and what helps, in the words of `run`; `None` where it has not failed. What helps is looked for,
    /// which may take seconds, where nothing but the scene acted on the plant.
    #[must_use]
    pub fn diagnose(&self) -> Option<(String, String)> {
        let trouble = self.trouble?;
        let (scene, plant) = (self.instance.scene(), self.instance.plant());
        let failed = plant.steps();
        let plan = Plan { steps: self.plan.steps.max(failed), ..self.plan };
        let run = match self.disturbed {
            false => {
                FailedRun::new(scene, plant.method(), &plan, None, failed, trouble, &mut |_, _| ())
            }
            true => FailedRun::untried(scene, &plan, failed, trouble),
        };
        let advice = match run.remedy {
            Remedy::Unsought => {
                "a shorter step or softer changes; reset, or go back to a moment before".to_owned()
            }
            _ => run.advice(),
        };
        Some((run.to_string(), advice))
    }

    /// The scene's text, and the options of `host-sim run` that give what was changed on the page.
    #[must_use]
    pub fn scene_text(&self) -> (&str, String) {
        let set = self.asked.set.iter().map(|(path, value)| format!(" --set '{path}={value:?}'"));
        (&self.asked.text, set.collect())
    }

    /// What was asked for.
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
    // A step of the user's own need not divide the duration.
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

/// The first output of a scene that is a read-out.
pub(super) fn readouts(scene: &Scene) -> usize {
    scene.body_names.len() * dbd_scene::BODY_COLUMNS.len() + dbd_scene::ENERGY_COLUMNS.len()
}
