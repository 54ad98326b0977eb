//! Statements about a trial: limit of its step, load, reason why it does not meet the request.
//!
//! `(search, trial) => limit, method, text`.

use std::collections::BTreeSet;

use dbd_plant::PrecisionName;
use dbd_plant::digits::significant;
use dbd_plant::time::display;

use crate::recommend::request::{Limit, Request, Way};
use crate::recommend::search::{Candidate, Model, Search, Trial};
use crate::words::percent;

/// A step that could be longer by this factor, were it not a part of a period, is limited by that.
const FITS: f64 = 1.1;

impl Search<'_> {
    /// The most accurate of all that was run.
    pub(in crate::recommend) fn most_accurate(&self) -> Option<Trial> {
        let known = self.errors.iter().filter_map(|(key, error)| Some((*key, (*error)?)));
        let ((row, steps), error) = known.min_by(|a, b| a.1.total_cmp(&b.1))?;
        let Candidate { method, instructions, .. } = self.candidates[row];
        let step = self.head.grid.step(steps);
        Some(Trial { candidate: row, method, step, error, instructions, longest: false })
    }

    /// Limit of a trial's step.
    pub(in crate::recommend) fn limit(&mut self, trial: &Trial) -> Limit {
        let candidate = self.candidates[trial.candidate];
        let bounds = self.bounds(candidate);
        let Model { frequencies, scene, .. } = &self.models[candidate.model];
        if !trial.longest {
            return Limit::Accuracy;
        }
        if let Some(failed) = self.failed.get(&trial.candidate) {
            return Limit::Motion { fails: failed.at };
        }
        if bounds.advised >= FITS * trial.step {
            return Limit::Period;
        }
        if bounds.advised >= frequencies.longest_turn() {
            let body = scene.body_names.get(frequencies.fastest).cloned().unwrap_or_default();
            return Limit::Spin { body };
        }
        let element = dbd_scene::facts(scene).fastest().map(|element| element.name.clone());
        Limit::Vibration { frequency_hz: frequencies.estimate_hz(), element }
    }

    /// \[s\] the largest stable step of a trial's method; `None` if all are.
    pub(in crate::recommend) fn stable(&mut self, trial: &Trial) -> Option<f64> {
        let stable = self.bounds(self.candidates[trial.candidate]).stable;
        Some(stable).filter(|step| step.is_finite())
    }

    /// \[m\] error of the same method in double precision.
    pub(in crate::recommend) fn in_double(&self, trial: &Trial) -> Option<f64> {
        let method = trial.method.with_precision(PrecisionName::F64);
        let steps = self.steps(trial.step);
        self.measured(self.model(trial), &method, steps)
    }

    /// Steps per interval of a step.
    pub(in crate::recommend) fn steps(&self, step: f64) -> u64 {
        (self.head.grid.interval / step).round() as u64
    }

    /// Number of methods run, and of all.
    pub(in crate::recommend) fn counts(&self) -> (usize, usize) {
        let run: BTreeSet<usize> = self.errors.keys().map(|(row, _)| *row).collect();
        (run.len(), self.candidates.len())
    }

    /// The changes of values that make a trial's model of the scene.
    pub(in crate::recommend) fn set(&self, trial: &Trial) -> Vec<String> {
        let own = self.scene.changes.len();
        self.model(trial).changes.get(own..).unwrap_or_default().to_vec()
    }

    /// A trial with its names and its load.
    pub(in crate::recommend) fn way(&self, trial: &Trial) -> Way {
        let Candidate { model, counted, .. } = self.candidates[trial.candidate];
        Way {
            model: self.models[model].name.to_owned(),
            scheme: trial.method.scheme_name(),
            newton: trial.method.newton(),
            damping: trial.method.foreign_damping().map(|damping| damping.name()),
            precision: trial.method.precision_name(),
            step: trial.step,
            error: trial.error,
            instructions: trial.instructions,
            counted,
            load: load(self.request, trial),
        }
    }

    /// Reason why a trial does not meet a request, and the alternative.
    pub(in crate::recommend) fn too_slow(&self, trial: &Trial, quick: Option<&Trial>) -> String {
        let Request { mcu, clock, .. } = self.request;
        let load = load(self.request, trial);
        let needed = clock * load;
        let mut said = format!(
            "not in real time: {} load of a {} at {} MHz; it needs {} MHz",
            percent(load),
            mcu.name,
            significant(clock * 1e-6, 4),
            significant(needed * 1e-6, 3),
        );
        match quick.filter(|quick| self::load(self.request, quick) <= 1.0) {
            Some(quick) => {
                let Way { model, scheme, precision, step, error, .. } = self.way(quick);
                said += &format!(
                    "; the most accurate in real time is {scheme}, {precision}, step {} of the model \
                     `{model}`: error {error:.1e} m",
                    display(step),
                );
            }
            None => said += "; no method runs in real time here at any accuracy",
        }
        said
    }
}

/// \[1\] the CPU load of a trial.
pub(in crate::recommend) fn load(request: &Request, trial: &Trial) -> f64 {
    trial.cost() * request.mcu.cycles / request.clock
}
