//! `host-sim run`: a scene becomes a trace, a summary and a report.
//!
//! `(scene, options) => plan => samples => OUT/SCENE/{trace.csv,SCENE.glb,report.html,summary.json}`. The
//! folder is made once the input is known to be good; the files appear together when they are complete,
//! the summary last. A run that fails keeps its trace up to there. The report may be left
//! out, and the animation is there where it is asked for.

use std::io;
use std::path::PathBuf;

use dbd_kernel::damping::Damping;
use dbd_plant::monitor::{Opening, conserves_energy};
use dbd_plant::plan::{Request, StepRequest, plan};
use dbd_plant::plant::check;
use dbd_plant::{FailedRun, Frequencies, Method, Plan, PlanError, PlantError};
use dbd_report::Recording;
use dbd_report::output::file::PendingFile;
use dbd_report::output::set::FileSet;
use dbd_scene::{Scene, Setting};
use dbd_study::command::with_changes;
use dbd_study::modes::ModesError;
use miette::Diagnostic;
use thiserror::Error;

use crate::commands::assembled::{AssembledCheck, SettledCheck};
use crate::commands::folder::{Destination, FolderError};
use crate::commands::golden::{GoldenOptions, GoldenRefusal, GoldenWatch};
use crate::commands::modes::lowest;
use crate::commands::rounding::{of_losses, of_noise};
use crate::commands::surveyed::surveyed;
use crate::commands::warnings::{of_run, of_scene, of_springs, of_step, of_turns};
use crate::report::{
    JointOpening, ReadoutFigures, SetValue, Shown, Statistics, Summary, TraceWriter, show, text,
    trace,
};
use crate::simulate::{
    Balance, Ending, EnergyLimit, EnergyStop, EnergyWatch, Observer, Sample, SimulationError,
    simulate,
};
use crate::terminal::LoadError;

/// The request for a run. `None` means the scene's value or the default.
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
    /// The limit of the energy watch; no watch if `None`.
    pub watch_energy: Option<EnergyLimit>,
    /// The reference of the comparison.
    pub golden: Option<GoldenOptions>,
    /// How many of the lowest modes at t = 0 are found; none where `None`.
    pub modes: Option<usize>,
    /// Where results go; `None` writes nothing.
    pub out: Option<Destination>,
    /// Whether a report is among them.
    pub report: bool,
    /// Whether the animation is among them as glTF.
    pub gltf: bool,
    /// The scene's name on the command line; its own name if `None`.
    pub called: Option<String>,
}

impl RunOptions {
    /// A method with the scene's step, duration and sampling interval; writes nothing.
    #[must_use]
    pub fn new(method: Method) -> Self {
        Self {
            method,
            step: None,
            duration: None,
            every: None,
            watch_energy: None,
            golden: None,
            modes: None,
            out: None,
            report: true,
            gltf: false,
            called: None,
        }
    }
}

/// The outcome of a run.
#[derive(Clone, Debug, PartialEq)]
pub struct Outcome {
    /// The summary.
    pub summary: Summary,
    /// The folder of the results, where they were written.
    pub folder: Option<PathBuf>,
    /// The failure, where it failed.
    pub failure: Option<FailedRun>,
    /// The energy watch's reason, if it ended the run.
    pub stop: Option<EnergyStop>,
}

impl Outcome {
    /// The reason for an early end.
    #[must_use]
    pub fn ended_by(&self) -> Option<&dyn Diagnostic> {
        let stop = self.stop.as_ref().map(|stop| stop as &dyn Diagnostic);
        self.failure.as_ref().map(|failure| failure as &dyn Diagnostic).or(stop)
    }

    /// How it differs from its golden run, where it does; one that ended early is not compared.
    #[must_use]
    pub fn differs(&self) -> Option<&dyn Diagnostic> {
        let failure = self.summary.golden.as_ref()?.failure.as_ref()?;
        Some(failure)
    }
}

/// Why a run could not be carried out, or its results not be written.
#[derive(Debug, Error, Diagnostic)]
pub enum RunError {
    /// A requested step or interval does not fit.
    #[error(transparent)]
    #[diagnostic(transparent)]
    Plan(PlanError),
    /// One of the scene's does not.
    #[error(transparent)]
    #[diagnostic(transparent)]
    Setting(LoadError),
    /// The precision cannot represent the step or an input, or the method is not part of this build.
    #[error(transparent)]
    #[diagnostic(transparent)]
    Plant(#[from] PlantError),
    /// The folder for the results cannot be made.
    #[error(transparent)]
    #[diagnostic(transparent)]
    Folder(#[from] FolderError),
    /// The run cannot be compared.
    #[error(transparent)]
    #[diagnostic(transparent)]
    Golden(#[from] GoldenRefusal),
    /// There are no modes.
    #[error(transparent)]
    #[diagnostic(transparent)]
    Modes(#[from] ModesError),
    /// Results cannot be written.
    #[error("cannot write the results: {0}")]
    Write(io::Error),
}

impl From<SimulationError> for RunError {
    fn from(error: SimulationError) -> Self {
        match error {
            SimulationError::Plant(error) => Self::Plant(error),
            SimulationError::Observer(error) => Self::Write(error),
        }
    }
}

/// The plan of a run: options take precedence over the scene, the scene over defaults.
///
/// # Errors
/// Where the step does not fit, or steps or samples are too many.
pub fn plan_of(
    scene: &Scene,
    options: &RunOptions,
    frequencies: &Frequencies,
) -> Result<Plan, PlanError> {
    plan_within(scene, options, |duration| frequencies.default_limit(&options.method, duration))
}

/// The same with the longest step \[s\] of our own for a duration, which is asked for where none is given.
///
/// # Errors
/// As [`plan_of`].
pub fn plan_within(
    scene: &Scene,
    options: &RunOptions,
    longest: impl FnOnce(f64) -> f64,
) -> Result<Plan, PlanError> {
    let duration = options.duration.unwrap_or(scene.duration);
    let step = match options.step.or(scene.step) {
        Some(step) => StepRequest::Given(step),
        None => StepRequest::AtMost(longest(duration)),
    };
    plan(&Request { step, duration, every: options.every.or(scene.every) })
}

/// A plan's error, with its position in the scene file if the value comes from there.
fn refused(scene: &Scene, options: &RunOptions, error: PlanError) -> RunError {
    let step = options.step.is_none().then_some(Setting::Step);
    let every = options.every.is_none().then_some(Setting::Every);
    let duration = options.duration.is_none().then_some(Setting::Duration);
    let settings = match &error {
        // A requested step is itself the cause.
        PlanError::Multiple { .. } if options.step.is_some() => [None, None],
        PlanError::Multiple { .. } => [step, every],
        PlanError::Steps { .. } => [step, duration],
        PlanError::Incommensurate { .. } | PlanError::Every { .. } | PlanError::Samples { .. } => {
            [every, None]
        }
    };
    let help = error.help().map(|help| help.to_string()).unwrap_or_default();
    let message = error.to_string();
    let place = |setting: &Setting| scene.refuse(*setting, &message, &help);
    let placed = settings.iter().flatten().find_map(place);
    placed.map_or(RunError::Plan(error), |error| RunError::Setting(error.into()))
}

/// The phase of a run.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Stage {
    /// It steps; steps are counted.
    Stepping,
    /// It has failed and searches for a stable step; evaluations of elements and bodies are counted.
    Searching,
}

/// Runs a scene. `progress` is called occasionally with the finished and the largest total work of a phase.
///
/// # Errors
/// Bad input before anything is written; or results that cannot be written. A run that fails is
/// an outcome, not an error.
pub fn run(
    scene: &Scene,
    options: &RunOptions,
    progress: &mut dyn FnMut(Stage, u64, u64),
) -> Result<Outcome, RunError> {
    let frequencies = Frequencies::of(scene);
    let plan =
        plan_of(scene, options, &frequencies).map_err(|error| refused(scene, options, error))?;
    check(scene, &options.method, plan.step)?;
    let golden = options.golden.as_ref();
    let golden = golden.map(|golden| golden.begin(scene, &options.method, &plan)).transpose()?;
    let modes = options.modes.map(|count| lowest(scene, count)).transpose()?;
    let folder = match &options.out {
        Some(out) => Some(out.folder(&scene.name)?),
        None => None,
    };
    let mut files = folder.as_deref().map(FileSet::new);
    let trace = match &files {
        Some(files) => {
            let file = files.begin("trace.csv").map_err(RunError::Write)?;
            Some(TraceWriter::new(file, scene).map_err(RunError::Write)?)
        }
        None => None,
    };
    let recorded = folder.is_some() && (options.report || options.gltf);
    let recording = recorded.then(|| Recording::new(scene, &options.method, &plan)).transpose()?;
    let mut recorder = Recorder {
        trace,
        recording,
        statistics: Statistics::default(),
        balance: Balance::new(scene, &options.method, &plan).map_err(SimulationError::from)?,
        watch: options.watch_energy.map(|limit| EnergyWatch::new(scene, limit)),
        golden,
        progress: &mut |steps| progress(Stage::Stepping, steps, plan.steps),
    };
    let ending = simulate(scene, &options.method, &plan, &mut recorder)?;
    let Recorder { trace, recording, statistics, balance, watch, golden, .. } = recorder;
    let mut trace_hash = None;
    if let (Some(files), Some(trace)) = (&mut files, trace) {
        let (file, hash) = trace.finish().map_err(RunError::Write)?;
        trace_hash = Some(hash.text());
        files.add(file);
    }
    let every = options.every.or(scene.every);
    let failure = ending.run_failure.map(|run_failure| {
        let mut searched = |done, all| progress(Stage::Searching, done, all);
        FailedRun::new(
            scene,
            &options.method,
            &plan,
            every,
            ending.steps,
            run_failure,
            &mut searched,
        )
    });
    let mut summary =
        summarise(scene, &options.method, &plan, &frequencies, &ending, &statistics, &failure);
    summary.trace_hash = trace_hash;
    summary.energy_balance = balance.filter(|_| failure.is_none()).map(|balance| balance.balance());
    let stop = watch.and_then(|watch| watch.stop());
    summary.of_watch(watch, stop);
    summary.of_file(options.out.as_ref().map(|out| &out.file));
    if let Some(modes) = &modes {
        summary.modes = Some(modes.frequencies.clone());
        summary.warnings.extend(modes.remarks.iter().cloned());
    }
    let called = options.called.as_deref().unwrap_or(&scene.name);
    // An incomplete run is neither compared nor blessed.
    let golden = golden.filter(|_| failure.is_none() && stop.is_none());
    summary.golden = golden.map(|golden| golden.finish(&plan, &with_changes(scene, called)));
    if let (Some(mut files), Some(out)) = (files, &options.out) {
        let mut words = text(scene, &plan, &summary, called);
        words.survey = surveyed(files.folder(), scene, &out.file);
        let modes = modes.map(|modes| modes.of_page()).unwrap_or_default();
        let animation = out.animation();
        let shown = Shown { report: options.report, gltf: options.gltf, animation: &animation };
        let written = show(&mut files, &shown, scene, recording, (words, modes));
        let written = written.and_then(|()| files.write("summary.json", &summary.json()));
        let place = files.folder().to_owned();
        let whole = written.and_then(|()| files.finish()).map_err(RunError::Write)?;
        // Another scene's results may have been written there meanwhile.
        out.claim(&place, &scene.name)?;
        whole.publish().map_err(RunError::Write)?;
    }
    Ok(Outcome { summary, folder, failure, stop })
}

/// Passes samples on to trace, recording and statistics.
struct Recorder<'o, 'p> {
    trace: Option<TraceWriter<PendingFile>>,
    recording: Option<Recording>,
    statistics: Statistics,
    balance: Option<Balance>,
    watch: Option<EnergyWatch>,
    golden: Option<GoldenWatch<'o>>,
    progress: &'p mut dyn FnMut(u64),
}

impl Observer for Recorder<'_, '_> {
    fn sample(&mut self, sample: &Sample<'_>) -> io::Result<()> {
        self.statistics.push(sample);
        if let Some(balance) = &mut self.balance {
            balance.advance(sample.state.step);
        }
        if let Some(watch) = &mut self.watch {
            let remains = self.balance.as_ref().map(|balance| balance.balance().remains);
            watch.look(sample.time, sample.energy.total(), remains);
        }
        if let Some(golden) = &mut self.golden {
            golden.sample(sample).map_err(io::Error::other)?;
        }
        if let Some(recording) = &mut self.recording {
            let Sample { time, state, readings, energy, extensions, .. } = *sample;
            let sample =
                dbd_report::Sample { time, state, readings, energy, extensions, others: &[] };
            recording.push(&sample);
        }
        match &mut self.trace {
            Some(trace) => trace.row(sample),
            None => Ok(()),
        }
    }

    fn goes_on(&self) -> bool {
        self.watch.is_none_or(|watch| watch.stopped_at.is_none())
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
        None if ending.steps < plan.steps => plan.time(ending.steps),
        None => plan.duration,
    };
    let wall_seconds = ending.wall.as_secs_f64();
    let status = match failure {
        Some(failure) => format!("{failure}; {}", failure.advice()),
        None => "ok".into(),
    };
    let mut warnings = of_step(scene, frequencies, method, plan.step, "the step");
    warnings.extend(of_run(scene, &ending.openings));
    warnings.extend(of_springs(&ending.reversals));
    warnings.extend(of_turns(scene, frequencies, method, plan.step, &ending.turning));
    warnings.extend(of_losses(scene, method, &ending.losses));
    let readouts = ReadoutFigures::of(scene, statistics.readings());
    warnings.extend(of_noise(scene, method, Some(&readouts)));
    warnings.extend(of_scene(scene));
    Summary {
        scene: scene.name.clone(),
        scheme: method.scheme_name(),
        newton: method.newton(),
        rho: method.rho(),
        damping: method.foreign_damping().map(Damping::name),
        precision: method.precision_name(),
        orientation: method.orientation_name(),
        plane: scene.planar.as_ref().map(|planar| planar.plane.name()),
        step: plan.step,
        steps: ending.steps,
        duration,
        samples: statistics.samples(),
        force_evaluations: ending.evaluations,
        evaluations_per_step: method.evaluations(),
        wall_seconds,
        srt: wall_seconds / duration,
        energy_initial: statistics.energy_initial(),
        energy_final: statistics.energy_final(),
        energy_drift_rate: statistics.energy_drift_rate(),
        energy_rms_error: conserves_energy(scene).then(|| statistics.energy_rms_error()),
        max_joint_extension: statistics.max_joint_extension(),
        max_joint_extension_at: statistics
            .widest()
            .joint
            .map(|joint| (scene.joints[joint].name.clone(), statistics.widest().time)),
        frequency_bound_hz: frequencies.bound_hz(),
        frequency_estimate_hz: frequencies.estimate_hz(),
        advised_step: frequencies.advised_step(),
        state_hash: statistics.hash().map(|hash| format!("{hash:016x}")),
        turns: statistics.turns().to_vec(),
        trace_hash: None,
        status,
        version: env!("CARGO_PKG_VERSION"),
        trace_format: trace::FORMAT,
        scene_file: None,
        scene_hash: None,
        set: SetValue::of(scene),
        assembled: AssembledCheck::of(scene).map(|assembled| assembled.sentence()),
        settled: SettledCheck::of(scene).map(|settled| settled.sentence()),
        energy_balance: None,
        watch_energy: None,
        golden: None,
        modes: None,
        widest_joint: widest(scene, &ending.openings),
        engagements: ending.engagements.clone(),
        warnings,
        readouts,
    }
}

/// The joint with the largest opening relative to its free length.
fn widest(scene: &Scene, openings: &[Opening]) -> Option<JointOpening> {
    let sized = openings.iter().filter(|opening| opening.free_length > 0.0);
    let widest = sized.max_by(|a, b| a.share().total_cmp(&b.share()))?;
    Some(JointOpening {
        name: scene.joints[widest.joint].name.clone(),
        extension: widest.extension,
        free_length: widest.free_length,
        time: widest.time,
    })
}
