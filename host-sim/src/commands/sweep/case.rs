//! Cases of a sweep: a scene with changes, run by a method, becomes a row.
//!
//! `(scene's text, changes, method) => samples => row`. An invalid or failed case is a row, too; no stable step
//! is searched for, which would take further runs. Similar cases run in lockstep, with the same rows
//! as alone.

use std::{io, iter};

use dbd_plant::plant::{check_extents, check_inputs, check_step, check_stiffness};
use dbd_plant::{FailedRun, Frequencies, Method, Plan};
use dbd_scene::{BODY_COLUMNS, ENERGY_COLUMNS, Scene, SceneError, SceneText};
use dbd_study::sweep::check::{Misfit, Trial};
use dbd_study::sweep::columns::Column;
use dbd_study::sweep::row::{OK, Row};
use miette::Diagnostic;

use crate::commands::run::{RunOptions, plan_within};
use crate::report::{Figures, Statistics};
use crate::simulate::{Ending, Member, Observer, Sample, lanes, simulate, simulate_together};

/// The common part of the cases of a sweep.
#[derive(Clone, Copy, Debug)]
pub struct Bench<'b> {
    /// The scene's text.
    pub text: &'b SceneText<'b>,
}

impl Trial for Bench<'_> {
    fn scene(&self, changes: &[String]) -> Result<Scene, SceneError> {
        self.text.scene(changes)
    }

    fn plan(&self, scene: &Scene, method: &Method) -> Result<(), Misfit> {
        planned(scene, method).map(drop)
    }
}

impl Bench<'_> {
    /// The rows of cases, each with its method: similar cases with one plan run in lockstep, with the same rows as
    /// alone.
    pub fn run(&self, cases: &[(Vec<String>, Method)], columns: &[Column]) -> Vec<Row> {
        let prepared =
            |(changes, method): &(Vec<String>, Method)| Case::new(self, changes, *method);
        let cases: Vec<Result<Case, String>> = cases.iter().map(prepared).collect();
        let mut rows: Vec<Option<Row>> = vec![None; cases.len()];
        // Cases without a row after lockstep run alone.
        let mut tried = vec![false; cases.len()];
        for first in 0..cases.len() {
            let Ok(case) = &cases[first] else { continue };
            let with = |row: &usize| {
                let other = cases[*row].as_ref().ok();
                !tried[*row] && other.is_some_and(|other| other.goes_with(case))
            };
            let group: Vec<usize> = (first..cases.len()).filter(with).collect();
            group.iter().for_each(|row| tried[*row] = true);
            let together: Vec<&Case> =
                group.iter().filter_map(|row| cases[*row].as_ref().ok()).collect();
            if together.len() > 1 {
                for (row, made) in group.iter().zip(Case::run_together(&together, columns)) {
                    rows[*row] = made;
                }
            }
        }
        let alone = |(case, row): (Result<Case, String>, Option<Row>)| match (case, row) {
            (Ok(case), row) => row.unwrap_or_else(|| case.run(columns)),
            (Err(why), _) => Row::refused(why, columns.len()),
        };
        cases.into_iter().zip(rows).map(alone).collect()
    }
}

/// A valid case.
struct Case {
    scene: Scene,
    method: Method,
    plan: Plan,
}

impl Case {
    /// A case.
    ///
    /// # Errors
    /// Why it is refused.
    fn new(bench: &Bench<'_>, changes: &[String], method: Method) -> Result<Self, String> {
        let scene = bench.scene(changes).map_err(|error| refused(error.message()))?;
        let plan = planned(&scene, &method).map_err(|misfit| refused(misfit.message))?;
        Ok(Self { scene, method, plan })
    }

    /// Whether both can run in lanes.
    fn goes_with(&self, other: &Self) -> bool {
        (self.method, self.plan) == (other.method, other.plan) && lanes(&self.method) > 1
    }

    /// Its row.
    fn run(&self, columns: &[Column]) -> Row {
        let mut recorder = Recorder::new(&self.scene, columns);
        match simulate(&self.scene, &self.method, &self.plan, &mut recorder) {
            Ok(ending) => self.row(&ending, recorder),
            Err(error) => Row::refused(refused(error.to_string()), columns.len()),
        }
    }

    /// The rows of cases of one method and plan; `None` for one that has to run alone.
    fn run_together(cases: &[&Self], columns: &[Column]) -> Vec<Option<Row>> {
        let recorder = |case: &&Self| Recorder::new(&case.scene, columns);
        let mut recorders: Vec<Recorder> = cases.iter().map(recorder).collect();
        let members = cases.iter().zip(&mut recorders);
        let mut members: Vec<Member<'_>> =
            members.map(|(case, observer)| Member { scene: &case.scene, observer }).collect();
        let endings = simulate_together(&cases[0].method, &cases[0].plan, &mut members);
        // Without a common plan, each case reports its own error.
        let endings = endings.unwrap_or_default().into_iter().chain(iter::repeat(None));
        let rows = cases.iter().zip(recorders).zip(endings);
        rows.map(|((case, recorder), ending)| Some(case.row(&ending?, recorder))).collect()
    }

    /// Its outcome.
    fn row(&self, ending: &Ending, recorder: Recorder) -> Row {
        let Self { scene, plan, .. } = self;
        let Recorder { figures, statistics, .. } = recorder;
        let failure = ending
            .run_failure
            .map(|run_failure| FailedRun::untried(scene, plan, ending.steps, run_failure));
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

/// The status of an invalid case.
fn refused(why: String) -> String {
    format!("refused: {why}")
}

/// The plan of a case, as `run` would make it.
fn planned(scene: &Scene, method: &Method) -> Result<Plan, Misfit> {
    let misfit = |error: &dyn Diagnostic| Misfit {
        message: error.to_string(),
        help: error.help().map(|help| help.to_string()).unwrap_or_default(),
    };
    let longest = |duration| Frequencies::of(scene).default_limit(method, duration);
    let plan = plan_within(scene, &RunOptions::new(*method), longest);
    let plan = plan.map_err(|error| misfit(&error))?;
    check_step(method, plan.step).map_err(|error| misfit(&error))?;
    check_inputs(scene, method).map_err(|error| misfit(&error))?;
    check_extents(scene, method, plan.step).map_err(|error| misfit(&error))?;
    check_stiffness(scene, method, plan.step).map_err(|error| misfit(&error))?;
    Ok(plan)
}

/// The position of a column's value in a sample.
#[derive(Clone, Copy, Debug)]
enum Place {
    Body(usize, usize),
    Energy(usize),
    Reading(usize),
}

/// The positions of columns; `None` for one that the changed scene does not have.
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

/// Accumulates the figures of the columns.
struct Recorder {
    places: Vec<Option<Place>>,
    figures: Vec<Figures>,
    statistics: Statistics,
}

impl Recorder {
    fn new(scene: &Scene, columns: &[Column]) -> Self {
        Self {
            places: places(scene, columns),
            figures: vec![Figures::default(); columns.len()],
            statistics: Statistics::default(),
        }
    }
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
