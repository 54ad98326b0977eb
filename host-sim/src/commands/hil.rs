//! `host-sim hil`: a plant on a microcontroller and its controller here, or the reverse.
//!
//! `(scene, port, controller) => trace, report`. A model of the scene steps here as the plant does there, and every
//! frame is compared bit for bit.

use std::fs::File;
use std::io::{BufWriter, Write as _};
use std::path::{Path, PathBuf};
use std::time::Duration;

use dbd_link::host::controller::{Format, Process};
use dbd_link::host::follower::Followed;
use dbd_link::host::{
    Connection, Controller, ControllerError, DriveError, DriveOptions, Follower, HostPlant,
    PortError, Report, Sample, ServeError, ServeOptions, Served, TooMany, drive, serve,
};
use dbd_link::message::{Identity, Mode, Statistics};
use dbd_plant::digits::significant;
use dbd_plant::instance::InstanceError;
use dbd_plant::{Method, PlantError, plant};
use dbd_scene::Scene;
use miette::Diagnostic;
use thiserror::Error;

use crate::terminal::Look;

/// Why a run did not start or ended early.
#[derive(Debug, Error, Diagnostic)]
pub enum HilError {
    /// The scene has no such method or step.
    #[error(transparent)]
    #[diagnostic(transparent)]
    Instance(#[from] InstanceError),
    /// The scene has no plant of this method.
    #[error(transparent)]
    #[diagnostic(transparent)]
    Plant(#[from] PlantError),
    /// Its inputs or sensors do not fit into a frame.
    #[error(transparent)]
    #[diagnostic(help("remove unused read-outs or inputs"))]
    TooMany(#[from] TooMany),
    /// The plant at the port is another one.
    #[error("{error}")]
    #[diagnostic(help("the plant has {plant}; the model here has {model}"))]
    Identity {
        /// The message.
        error: String,
        /// The plant's identity as text.
        plant: String,
        /// The model's.
        model: String,
    },
    /// The port does not open.
    #[error(transparent)]
    #[diagnostic(help(
        "check that the other program is running and listening; --patience sets a longer wait"
    ))]
    Port(#[from] PortError),
    /// The controller failed.
    #[error(transparent)]
    #[diagnostic(help(
        "the controller reads a line per frame from standard input and answers each with one \
         line of values on standard output, flushed; see docs/hil.md"
    ))]
    Controller(#[from] ControllerError),
    /// The run ended early.
    #[error("{0}")]
    Drive(DriveError),
    /// The plant was not served.
    #[error(transparent)]
    Serve(ServeError),
    /// The trace exists.
    #[error("{} exists", .0.display())]
    #[diagnostic(help("replace it with --overwrite, or choose another file with --trace"))]
    Taken(PathBuf),
    /// The trace cannot be written.
    #[error("cannot write {}: {reason}", file.display())]
    Trace {
        /// The file.
        file: PathBuf,
        /// The reason; part of the message and therefore not a source, which would repeat it.
        reason: std::io::Error,
    },
    /// Bits differ.
    #[error(
        "plant and model differ at step {}: {} is {} on the plant and {} in the model",
        .0.step, .0.what, .0.plant, .0.model
    )]
    Different(dbd_link::host::Difference),
    /// No frame was compared.
    #[error("no frame could be compared")]
    Nothing,
    /// The plant failed.
    #[error("the plant failed at step {0}")]
    #[diagnostic(help("`host-sim run` reports the reason; the trace contains the inputs"))]
    Failed(u64),
}

impl HilError {
    /// Whether the arguments are at fault, and nothing ran.
    #[must_use]
    pub fn is_refusal(&self) -> bool {
        matches!(
            self,
            Self::Instance(_)
                | Self::Plant(_)
                | Self::TooMany(_)
                | Self::Taken(_)
                | Self::Controller(ControllerError::Command(_) | ControllerError::Start { .. })
        )
    }
}

impl From<DriveError> for HilError {
    fn from(error: DriveError) -> Self {
        match error {
            DriveError::Port(error) => Self::Port(error),
            DriveError::Controller(error) => Self::Controller(error),
            DriveError::Identity { ref plant, ref model, .. } => Self::Identity {
                plant: words(plant),
                model: words(model),
                error: error.to_string(),
            },
            error => Self::Drive(error),
        }
    }
}

impl From<ServeError> for HilError {
    fn from(error: ServeError) -> Self {
        match error {
            ServeError::Port(error) => Self::Port(error),
            error => Self::Serve(error),
        }
    }
}

/// An identity as text.
fn words(identity: &Identity) -> String {
    let Identity { scene, scheme, precision, step, inputs, outputs, fingerprint } = identity;
    let fingerprint: String = fingerprint.iter().map(|byte| format!("{byte:02x}")).collect();
    format!(
        "{scene}, {scheme}, {precision}, step {}, {inputs} inputs, {outputs} sensor values, fingerprint {fingerprint}",
        dbd_plant::time::display(*step)
    )
}

/// A scene's plant for one end of the line.
///
/// # Errors
/// [`HilError`].
pub fn plant_of(scene: &Scene, method: &Method, step: f64) -> Result<HostPlant, HilError> {
    Ok(HostPlant::new(scene, plant(scene, method, step)?)?)
}

/// The source of the inputs, as given on the command line.
#[derive(Clone, Debug)]
pub struct ControllerChoice {
    /// `zero`, `noise[:AMPLITUDE[:SEED]]` or a command.
    pub name: String,
    /// Format of the lines to a command.
    pub format: Format,
    /// Time limit of a command's answer.
    pub limit: Duration,
}

impl ControllerChoice {
    /// The controller of a plant with these inputs and sensors.
    ///
    /// # Errors
    /// [`ControllerError`] where the command does not start.
    pub fn start(&self, plant: &HostPlant) -> Result<Controller, ControllerError> {
        let mut parts = self.name.split(':');
        match (parts.next(), parts.next(), parts.next(), parts.next()) {
            (Some("zero"), None, ..) => return Ok(Controller::Zero),
            (Some("noise"), amplitude, seed, None) => {
                let amplitude = amplitude.map_or(Some(1.0), |text| text.parse().ok());
                let seed = seed.map_or(Some(1), |text| text.parse().ok());
                if let (Some(amplitude), Some(seed)) = (amplitude, seed) {
                    return Ok(Controller::noise(amplitude, seed));
                }
            }
            _ => {}
        }
        let names = [plant.inputs(), plant.sensors()];
        Process::start(&self.name, self.format, self.limit, names).map(Controller::Process)
    }
}

/// Drives a plant at a port; returns the report, and the error if the run ended early.
///
/// # Errors
/// [`HilError`] before the run begins; the second of the pair after it.
pub fn run_controller(
    model: HostPlant,
    connection: &mut Connection,
    choice: &ControllerChoice,
    options: &DriveOptions,
    trace: Option<&Path>,
) -> Result<(Report, Option<HilError>), HilError> {
    let mut controller = choice.start(&model)?;
    let mut trace = trace.map(|file| Trace::create(file, &model)).transpose()?;
    let (mut follower, mut report) = (Follower::new(model), Report::default());
    let step = follower.model().step_size();
    let mut look = |sample: Sample<'_>| match &mut trace {
        Some(trace) => trace.row(step, &sample),
        None => Ok(()),
    };
    let driven = drive(connection, &mut follower, &mut controller, options, &mut report, &mut look);
    let ended = match (driven, &report.first_difference) {
        (_, Some(difference)) => Some(HilError::Different(difference.clone())),
        (Err(error), None) => Some(error.into()),
        (Ok(()), None) if !report.running => Some(HilError::Failed(report.steps)),
        (Ok(()), None) if report.compared == 0 => Some(HilError::Nothing),
        (Ok(()), None) => None,
    };
    match trace.map_or(Ok(()), Trace::finish) {
        Ok(()) => Ok((report, ended)),
        Err(error) => Ok((report, ended.or(Some(error)))),
    }
}

/// Serves a plant at a port until a controller disconnects.
///
/// # Errors
/// [`HilError`].
pub fn run_plant(
    plant: HostPlant,
    connection: &mut Connection,
    options: &ServeOptions,
) -> Result<Served, HilError> {
    Ok(serve(plant, connection, options)?)
}

/// A row per frame: step, time, inputs, sensors, and whether the frame was equal to the model's.
struct Trace {
    file: PathBuf,
    out: BufWriter<File>,
}

impl Trace {
    fn create(file: &Path, model: &HostPlant) -> Result<Self, HilError> {
        let failed = |reason| HilError::Trace { file: file.to_owned(), reason };
        let out = BufWriter::new(File::create(file).map_err(failed)?);
        let mut trace = Self { file: file.to_owned(), out };
        let names = ["step", "time"].into_iter();
        let names = names.chain(model.inputs().iter().chain(model.sensors()).map(String::as_str));
        let names: Vec<&str> = names.chain(["compared"]).collect();
        writeln!(trace.out, "{}", names.join(",")).map_err(failed)?;
        Ok(trace)
    }

    fn row(&mut self, step: f64, sample: &Sample<'_>) -> std::io::Result<()> {
        write!(self.out, "{},{}", sample.step, sample.step as f64 * step)?;
        for value in sample.inputs.iter().chain(sample.sensors) {
            write!(self.out, ",{value}")?;
        }
        let compared = match sample.followed {
            Followed::Equal => "equal",
            Followed::Different => "different",
            Followed::Unknown => "unknown",
        };
        writeln!(self.out, ",{compared}")
    }

    fn finish(mut self) -> Result<(), HilError> {
        let file = self.file;
        self.out.flush().map_err(|reason| HilError::Trace { file, reason })
    }
}

/// The report of a run for people.
#[must_use]
pub fn report_text(report: &Report, mode: Mode, look: Look) -> String {
    let ms = |seconds: f64| format!("{} ms", significant(seconds * 1e3, 3));
    let latency = &report.latency;
    let [corrupted, dropped, repeated, reordered] = report.disturbed;
    let mut rows = vec![
        ("mode", if mode == Mode::Lockstep { "lockstep" } else { "real time" }.to_owned()),
        ("steps", report.steps.to_string()),
        ("hash", report.hash.clone()),
        (
            "frames compared",
            format!(
                "{}: {} differ, {} not comparable",
                report.compared, report.different, report.unknown
            ),
        ),
        (
            "recovered",
            format!(
                "port reopened {}, state read from the plant {}, restored to it {}",
                report.reconnected, report.synchronised, report.restored
            ),
        ),
        (
            "latency",
            format!(
                "{} frames: minimum {}, 50 % {}, 90 % {}, 99 % {}, 99.9 % {}, maximum {}",
                latency.count,
                ms(latency.least),
                ms(latency.p50),
                ms(latency.p90),
                ms(latency.p99),
                ms(latency.p999),
                ms(latency.most)
            ),
        ),
        ("this end", counted(&report.own)),
    ];
    if let Some(plant) = &report.plant {
        rows.push(("plant's end", counted(plant)));
    }
    if report.disturbed != [0; 4] {
        let text = format!(
            "{corrupted} corrupted, {dropped} dropped, {repeated} repeated, {reordered} reordered"
        );
        rows.push(("disturbed", text));
    }
    rows.push(("took", format!("{} s", significant(report.seconds, 3))));
    look.table(&rows)
}

/// The report of a served plant for people.
#[must_use]
pub fn served_text(served: &Served, look: Look) -> String {
    look.table(&[
        ("steps", served.steps.to_string()),
        ("hash", served.hash.clone()),
        ("plant's end", counted(&served.plant)),
    ])
}

/// Statistics in a line.
fn counted(counts: &Statistics) -> String {
    let mut text = format!(
        "{} sent, {} good, {} damaged, {} late or repeated by the line, {} missing, {} refused, {} requested again",
        counts.sent,
        counts.good,
        counts.bad,
        counts.late,
        counts.dropped,
        counts.refused,
        counts.repeated
    );
    let more = [
        (counts.version, "of another version"),
        (counts.foreign, "of another session"),
        (counts.lost, "bytes lost"),
        (counts.ticks, "ticks"),
        (counts.overruns, "overruns"),
        (counts.timeouts, "timeouts"),
        (counts.slowest, "cycles for the slowest step"),
    ];
    for (count, what) in more.into_iter().filter(|(count, _)| *count > 0) {
        text += &format!(", {count} {what}");
    }
    text
}
