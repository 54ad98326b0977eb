//! `host-sim run`: a scene becomes a trace, a summary and a report.
//!
//! `(scene, options) => plan => samples => OUT/SCENE/{trace.csv,report.html,summary.json}`. The
//! folder is made once the input is known to be good; each file appears when it is complete, the
//! summary last. A run that fails keeps its trace up to there.

use std::io;
use std::path::PathBuf;

use dbd_kernel::damping::Damping;
use dbd_kernel::plant::PlantError;
use dbd_kernel::{Geometry, Scheme};
use dbd_scene::{Scene, UnfitInput};

use crate::curves::Curves;
use crate::error::Error;
use crate::failure::FailedRun;
use crate::frequencies::Frequencies;
use crate::method::{Method, MethodVisitor};
use crate::output::{self, PendingFile};
use crate::plan::{Plan, Request, StepRequest, plan};
use crate::report::{self, Report};
use crate::simulate::{Ending, Observer, Sample, SimulationError, simulate};
use crate::statistics::Statistics;
use crate::summary::Summary;
use crate::trace::TraceWriter;

/// What a run is asked for. What is `None` is the scene's, or ours.
#[derive(Clone, Debug, PartialEq)]
pub struct RunOptions {
    /// Scheme and precision.
    pub method: Method,
    /// \[s\] the step.
    pub step: Option<f64>,
    /// \[s\] simulated time.
    pub duration: Option<f64>,
    /// \[s\] the sampling interval.
    pub every: Option<f64>,
    /// The folder below which results go; `None` writes nothing.
    pub out: Option<PathBuf>,
    /// What a command line calls the scene; its name where `None`.
    pub called: Option<String>,
}

impl RunOptions {
    /// A method with the scene's step, duration and sampling interval; writes nothing.
    #[must_use]
    pub fn new(method: Method) -> Self {
        Self { method, step: None, duration: None, every: None, out: None, called: None }
    }
}

/// What a run came to.
#[derive(Clone, Debug, PartialEq)]
pub struct Outcome {
    /// The summary.
    pub summary: Summary,
    /// The folder of the results, where they were written.
    pub folder: Option<PathBuf>,
    /// The failure, where it failed.
    pub failure: Option<FailedRun>,
}

/// The plan of a run: the options' values before the scene's, the scene's before ours.
///
/// # Errors
/// Where the step does not fit, or steps or samples are too many.
pub fn plan_of(
    scene: &Scene,
    options: &RunOptions,
    frequencies: &Frequencies,
) -> Result<Plan, Error> {
    let duration = options.duration.unwrap_or(scene.duration);
    let step = match options.step.or(scene.step) {
        Some(step) => StepRequest::Given(step),
        None => StepRequest::AtMost(frequencies.default_limit(duration)),
    };
    Ok(plan(&Request { step, duration, every: options.every.or(scene.every) })?)
}

/// Runs a scene. `progress` hears of steps done and steps to do, now and then.
///
/// # Errors
/// Bad input before anything is written; or results that cannot be written. A run that fails is
/// an outcome, not an error.
pub fn run(
    scene: &Scene,
    options: &RunOptions,
    progress: &mut dyn FnMut(u64, u64),
) -> Result<Outcome, Error> {
    let frequencies = Frequencies::of(scene);
    let plan = plan_of(scene, options, &frequencies)?;
    check_step(&options.method, plan.step)?;
    options.method.visit(InputCheck(scene))?;
    let folder = match &options.out {
        Some(out) => Some(
            output::folder(out, &scene.name)
                .map_err(|reason| Error::Folder { folder: out.join(&scene.name), reason })?,
        ),
        None => None,
    };
    let trace = match &folder {
        Some(folder) => {
            let file = PendingFile::create(folder, "trace.csv").map_err(Error::Write)?;
            Some(TraceWriter::new(file, scene).map_err(Error::Write)?)
        }
        None => None,
    };
    let columns = scene.readouts.iter().map(|readout| readout.columns.len()).sum();
    let curves =
        folder.as_ref().map(|_| Curves::new(scene.body_names.len(), columns, plan.samples()));
    let mut recorder = Recorder {
        trace,
        curves,
        statistics: Statistics::default(),
        progress: &mut |steps| progress(steps, plan.steps),
    };
    let ending =
        simulate(scene, &options.method, &plan, &mut recorder).map_err(|error| match error {
            SimulationError::Plant(PlantError::Step(step)) => refused_step(&options.method, step),
            SimulationError::Observer(error) => Error::Write(error),
        })?;
    let Recorder { trace, curves, statistics, .. } = recorder;
    if let Some(trace) = trace {
        trace.finish().and_then(PendingFile::complete).map_err(Error::Write)?;
    }
    let every = options.every.or(scene.every);
    let failure = ending
        .trouble
        .map(|trouble| FailedRun::new(scene, &options.method, &plan, every, &ending, trouble));
    let summary =
        summarise(scene, &options.method, &plan, &frequencies, &ending, &statistics, &failure);
    if let (Some(folder), Some(mut curves)) = (&folder, curves) {
        curves.close();
        let called = options.called.as_deref().unwrap_or(&scene.name);
        let report = Report { scene, plan: &plan, summary: &summary, curves: &curves, called };
        output::write(folder, "report.html", &report::html(&report)).map_err(Error::Write)?;
        output::write(folder, "summary.json", &summary.json()).map_err(Error::Write)?;
    }
    Ok(Outcome { summary, folder, failure })
}

/// Whether the method's precision holds what inputs are given.
struct InputCheck<'s>(&'s Scene);

impl MethodVisitor for InputCheck<'_> {
    type Output = Result<(), UnfitInput>;

    fn visit<P: Geometry, S: Scheme>(self, _: S) -> Self::Output {
        self.0.check_inputs::<P>()
    }
}

fn check_step(method: &Method, step: f64) -> Result<(), Error> {
    let rounded = method.rounded(step);
    if rounded > 0.0 && rounded.is_finite() { Ok(()) } else { Err(refused_step(method, step)) }
}

fn refused_step(method: &Method, step: f64) -> Error {
    let precision = method.precision_name();
    Error::Step { step, rounded: method.rounded(step), precision }
}

/// Passes samples on to trace, curves and statistics.
struct Recorder<'p> {
    trace: Option<TraceWriter<PendingFile>>,
    curves: Option<Curves>,
    statistics: Statistics,
    progress: &'p mut dyn FnMut(u64),
}

impl Observer for Recorder<'_> {
    fn sample(&mut self, sample: &Sample<'_>) -> io::Result<()> {
        self.statistics.push(sample);
        if let Some(curves) = &mut self.curves {
            curves.push(sample);
        }
        match &mut self.trace {
            Some(trace) => trace.row(sample),
            None => Ok(()),
        }
    }

    fn progress(&mut self, steps: u64) {
        (self.progress)(steps);
    }
}

fn summarise(
    scene: &Scene,
    method: &Method,
    plan: &Plan,
    frequencies: &Frequencies,
    ending: &Ending,
    statistics: &Statistics,
    failure: &Option<FailedRun>,
) -> Summary {
    let duration = match failure {
        Some(failure) => failure.time,
        None => plan.duration,
    };
    let wall_seconds = ending.wall.as_secs_f64();
    let status = match failure {
        Some(failure) => format!("{failure}; {}", failure.advice()),
        None => "ok".into(),
    };
    Summary {
        scene: scene.name.clone(),
        scheme: method.scheme_name(),
        newton: method.newton(),
        damping: method.foreign_damping().map(Damping::name),
        precision: method.precision_name(),
        orientation: method.orientation_name(),
        step: plan.step,
        steps: ending.steps,
        duration,
        force_evaluations: ending.evaluations,
        wall_seconds,
        srt: wall_seconds / duration,
        energy_initial: statistics.energy_initial(),
        energy_final: statistics.energy_final(),
        energy_drift_rate: statistics.energy_drift_rate(),
        energy_rms_error: conserves_energy(scene).then(|| statistics.energy_rms_error()),
        max_joint_extension: statistics.max_joint_extension(),
        frequency_bound_hz: frequencies.bound_hz(),
        frequency_estimate_hz: frequencies.estimate_hz(),
        advised_step: frequencies.advised_step(),
        state_hash: format!("{:016x}", statistics.hash()),
        status,
        warnings: frequencies.warning(scene, plan.step).into_iter().collect(),
    }
}

/// Whether the scene's total energy is meant to stay as it is.
pub(crate) fn conserves_energy(scene: &Scene) -> bool {
    let undriven = scene.model.loads.is_empty() && scene.model.inputs.is_empty();
    undriven && scene.model.dampers.iter().all(|c| c.abs() == 0.0)
}
