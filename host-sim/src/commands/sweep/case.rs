//! One case of a sweep: a scene with changes, run by a method, becomes a row.
//!
//! `(scene's text, changes, method) => samples => row`. A case that is refused or fails is a row, too; no step
//! that works is looked for, which would take further runs.

use std::io;

use dbd_plant::plant::{check_inputs, check_step};
use dbd_plant::{Frequencies, Method, Plan};
use dbd_scene::{BODY_COLUMNS, ENERGY_COLUMNS, Scene, SceneError};
use dbd_sweep::check::{Misfit, Trial};
use dbd_sweep::columns::Column;
use dbd_sweep::row::{OK, Row};
use miette::Diagnostic;

use crate::commands::run::{RunOptions, plan_within};
use crate::report::{Figures, Statistics};
use crate::simulate::{FailedRun, Observer, Sample, simulate};

/// What the cases of a sweep have in common.
#[derive(Clone, Copy, Debug)]
pub struct Bench<'b> {
    /// The scene's text.
    pub text: &'b str,
    /// What messages call it.
    pub file: &'b str,
}

impl Trial for Bench<'_> {
    fn scene(&self, changes: &[String]) -> Result<Scene, SceneError> {
        Scene::parse_with(self.text, self.file, changes)
    }

    fn plan(&self, scene: &Scene, method: &Method) -> Result<(), Misfit> {
        planned(scene, method).map(drop)
    }
}

impl Bench<'_> {
    /// The row of a case.
    ///
    /// # Errors
    /// Never for what the case does; where samples cannot be taken in.
    pub fn run(&self, changes: &[String], method: &Method, columns: &[Column]) -> Row {
        let refused = |message: String| Row::refused(format!("refused: {message}"), columns.len());
        let scene = match self.scene(changes) {
            Ok(scene) => scene,
            Err(error) => return refused(error.message()),
        };
        let plan = match planned(&scene, method) {
            Ok(plan) => plan,
            Err(misfit) => return refused(misfit.message),
        };
        let mut recorder = Recorder {
            places: places(&scene, columns),
            figures: vec![Figures::default(); columns.len()],
            statistics: Statistics::default(),
        };
        let ending = match simulate(&scene, method, &plan, &mut recorder) {
            Ok(ending) => ending,
            Err(error) => return refused(error.to_string()),
        };
        let Recorder { figures, statistics, .. } = recorder;
        let failure =
            ending.trouble.map(|trouble| FailedRun::untried(&scene, &plan, &ending, trouble));
        let time = match &failure {
            Some(failure) => failure.time,
            None => plan.duration,
        };
        Row {
            status: failure.map_or(OK.to_owned(), |failure| failure.to_string()),
            state_hash: statistics.hash().map(|hash| format!("{hash:016x}")),
            step: Some(plan.step),
            steps: Some(ending.steps),
            simulated: Some(time),
            force_evaluations: Some(ending.evaluations),
            energy_drift_rate: Some(statistics.energy_drift_rate()),
            max_joint_extension: Some(statistics.max_joint_extension()),
            figures: figures.iter().map(Figures::all).collect(),
        }
    }
}

/// The plan of a case, as `run` would make it.
fn planned(scene: &Scene, method: &Method) -> Result<Plan, Misfit> {
    let misfit = |error: &dyn Diagnostic| Misfit {
        message: error.to_string(),
        help: error.help().map(|help| help.to_string()).unwrap_or_default(),
    };
    let longest = |duration| Frequencies::of(scene).default_limit(duration);
    let plan = plan_within(scene, &RunOptions::new(*method), longest);
    let plan = plan.map_err(|error| misfit(&error))?;
    check_step(method, plan.step).map_err(|error| misfit(&error))?;
    check_inputs(scene, method).map_err(|error| misfit(&error))?;
    Ok(plan)
}

/// Where a sample has the value of a column.
#[derive(Clone, Copy, Debug)]
enum Place {
    Body(usize, usize),
    Energy(usize),
    Reading(usize),
}

/// The places of columns; `None` for one that the changed scene does not have.
fn places(scene: &Scene, columns: &[Column]) -> Vec<Option<Place>> {
    let all = scene.columns();
    let of_bodies = scene.body_names.len() * BODY_COLUMNS.len();
    let place = |column: &Column| {
        // After the time.
        let row = all.iter().skip(1).position(|name| *name == column.name)?;
        Some(match row.checked_sub(of_bodies) {
            None => Place::Body(row / BODY_COLUMNS.len(), row % BODY_COLUMNS.len()),
            Some(row) if row < ENERGY_COLUMNS.len() => Place::Energy(row),
            Some(row) => Place::Reading(row - ENERGY_COLUMNS.len()),
        })
    };
    columns.iter().map(place).collect()
}

/// Takes in the figures of the columns.
struct Recorder {
    places: Vec<Option<Place>>,
    figures: Vec<Figures>,
    statistics: Statistics,
}

impl Observer for Recorder {
    fn sample(&mut self, sample: &Sample<'_>) -> io::Result<()> {
        self.statistics.push(sample);
        for (figures, place) in self.figures.iter_mut().zip(&self.places) {
            let Some(place) = place else { continue };
            figures.push(sample.time, value(sample, *place));
        }
        Ok(())
    }
}

fn value(sample: &Sample<'_>, place: Place) -> f64 {
    match place {
        Place::Body(row, component) => {
            let Some(body) = sample.state.bodies.get(row) else { return f64::NAN };
            match component {
                0..3 => body.position.to_f64()[component],
                3..7 => body.orientation.to_f64()[component - 3],
                7..10 => body.velocity.to_f64()[component - 7],
                _ => body.angular_velocity.to_f64()[component - 10],
            }
        }
        Place::Energy(row) => {
            let energy = &sample.energy;
            [energy.kinetic, energy.potential(), energy.total()][row]
        }
        Place::Reading(row) => sample.readings.get(row).copied().unwrap_or(f64::NAN),
    }
}
