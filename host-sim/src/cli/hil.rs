//! `host-sim hil` on the command line.

use std::path::PathBuf;
use std::str::FromStr;
use std::time::{Duration, SystemTime, UNIX_EPOCH};

use clap::{Args, ValueEnum, ValueHint};
use dbd_link::host::controller::Format;
use dbd_link::host::{Address, Connection, Disturbance, DriveOptions, ServeOptions};
use dbd_link::message::{Mode, Policy, Settings};
use dbd_plant::instance::Settings as Choices;
use dbd_plant::time::Time;
use dbd_plant::{DampingName, Named as _, PrecisionName, SchemeName};

use crate::arguments::{SceneArgument, names};
use crate::cli::named::load;
use crate::commands::hil::{
    ControllerChoice, HilError, plant_of, report_text, run_controller, run_plant, served_text,
};
use crate::error::Error;
use crate::terminal::text::json;
use crate::terminal::{Catalogue, Console, Exit};

#[derive(Debug, Args)]
pub(super) struct HilArguments {
    #[command(flatten)]
    pub(super) scene: SceneArgument,
    /// Connection to the peer: unix:PATH, unix-listen:PATH, tcp:HOST:PORT, tcp-listen:HOST:PORT,
    /// /dev/tty…[@BAUD] or COM3[@BAUD]
    #[arg(long, value_name = "PORT")]
    port: Address,
    /// Simulate the plant for a controller at the other end
    #[arg(long)]
    serve: bool,
    /// Source of the inputs: zero, noise[:AMPLITUDE[:SEED]], or a command that answers each line of sensor values on
    /// its standard input with a line of input values
    #[arg(long, value_name = "COMMAND", default_value = "zero", conflicts_with = "serve")]
    controller: String,
    /// Format of the lines to and from the controller
    #[arg(long, value_enum, default_value_t = Lines::Csv, conflicts_with = "serve")]
    lines: Lines,
    /// Time-stepping scheme, the same as at the other end
    #[arg(long, value_parser = names::<SchemeName>(), default_value = SchemeName::default().name())]
    scheme: SchemeName,
    /// Damping method [default: the scheme's own]
    #[arg(long, value_parser = names::<DampingName>())]
    damping: Option<DampingName>,
    /// Precision of all arithmetic in a step, the same as at the other end
    #[arg(long, value_parser = names::<PrecisionName>(), default_value = PrecisionName::F32.name())]
    precision: PrecisionName,
    /// Step, the same as at the other end, e.g. 50us [default: that of `new firmware`]
    #[arg(long, value_name = "TIME", allow_hyphen_values = true)]
    step: Option<Time>,
    /// Drive inputs with tables over the line instead
    #[arg(long)]
    without_tables: bool,
    /// Simulated time [default: the scene's]
    #[arg(long, value_name = "TIME", allow_hyphen_values = true, conflicts_with = "serve")]
    duration: Option<Time>,
    /// Steps per frame of inputs, or per tick
    #[arg(long, value_name = "N", default_value_t = 1, value_parser = clap::value_parser!(u32).range(1..), conflicts_with = "serve")]
    steps: u32,
    /// Step the plant by its timer, not at each frame of inputs
    #[arg(long, conflicts_with = "serve")]
    real_time: bool,
    /// Reaction of the plant in real time when no inputs arrive for --timeout ticks
    #[arg(long, value_enum, default_value_t = Late::Hold, conflicts_with = "serve")]
    when_late: Late,
    /// Ticks without inputs after which they are late
    #[arg(long, value_name = "TICKS", default_value_t = 20, value_parser = clap::value_parser!(u32).range(1..), conflicts_with = "serve")]
    timeout: u32,
    /// With --serve: tick period in real time, e.g. 1ms [default: lockstep only]
    #[arg(long, value_name = "TIME", requires = "serve")]
    period: Option<Time>,
    /// With --serve: continue after a controller has disconnected
    #[arg(long, requires = "serve")]
    forever: bool,
    /// Time to wait for an answer before the request is repeated
    #[arg(long, value_name = "TIME", default_value = "200ms")]
    answer: Time,
    /// Time to wait for a port that does not open, or for a plant or controller that does not answer [default: 10s,
    /// with
    /// --serve unlimited]
    #[arg(long, value_name = "TIME")]
    patience: Option<Time>,
    /// Damage frames in both directions, e.g. corrupt=1%,drop=1%,duplicate=1%,reorder=1%,seed=7
    #[arg(long, value_name = "FRACTIONS")]
    disturb: Option<Disturbance>,
    /// Close the port at a step and reopen it after a time, e.g. 5000:60s
    #[arg(long, value_name = "STEP:TIME", conflicts_with = "serve")]
    silence: Option<Silence>,
    /// Write a row per frame to this file, as CSV
    #[arg(long, value_name = "FILE", value_hint = ValueHint::FilePath, conflicts_with = "serve")]
    trace: Option<PathBuf>,
    /// Overwrite an existing trace
    #[arg(long, requires = "trace")]
    overwrite: bool,
    /// Print JSON
    #[arg(long)]
    json: bool,
}

/// Format of the lines to and from a controller.
#[derive(Clone, Copy, Debug, PartialEq, Eq, ValueEnum)]
enum Lines {
    /// Comma-separated numbers; the first line contains the names
    Csv,
    /// One object per line
    Json,
}

/// Reaction of a plant to late inputs.
#[derive(Clone, Copy, Debug, PartialEq, Eq, ValueEnum)]
enum Late {
    /// The inputs keep their values
    Hold,
    /// The inputs are set to 0
    Zero,
    /// The plant stops until inputs arrive
    Stop,
}

/// Time and duration of a disconnection.
#[derive(Clone, Copy, Debug)]
struct Silence(u64, Duration);

impl FromStr for Silence {
    type Err = String;

    fn from_str(text: &str) -> Result<Self, String> {
        let (step, time) = text.split_once(':').ok_or("expected STEP:TIME, e.g. 5000:60s")?;
        let step = step.parse().map_err(|_| format!("`{step}` is not a number of steps"))?;
        let time: Time = time.parse().map_err(|error| format!("`{time}`: {error}"))?;
        Ok(Self(step, duration(time)))
    }
}

/// How long to wait for a plant or a controller that does not answer.
const PATIENCE: Duration = Duration::from_secs(10);
/// Longer ones end no sooner for a user.
const MAX_SECONDS: f64 = 1e9;

fn duration(time: Time) -> Duration {
    Duration::from_secs_f64(time.seconds().clamp(0.0, MAX_SECONDS))
}

pub(super) fn hil_of_scene(
    catalogue: &Catalogue,
    arguments: &HilArguments,
    console: &mut Console<'_>,
) -> Result<Exit, Error> {
    let mut scene = load(catalogue, &arguments.scene)?.scene;
    if arguments.without_tables {
        scene.release_all();
        scene.inputs.iter_mut().for_each(|input| input.table = false);
    }
    let choices = Choices {
        scheme: Some(arguments.scheme.name().to_owned()),
        damping: arguments.damping.map(|damping| damping.name().to_owned()),
        precision: Some(arguments.precision.name().to_owned()),
        step: arguments.step.map(Time::seconds),
        ..Choices::default()
    };
    let method = choices.method().map_err(HilError::from)?;
    let step =
        choices.step_of(&scene, &method).map_err(|error| HilError::Instance(error.into()))?;
    let plant = plant_of(&scene, &method, step)?;
    let (answer, patience) = (duration(arguments.answer), arguments.patience.map(duration));
    let port = arguments.port.clone();
    let mut connection = Connection::new(port, answer, arguments.disturb.clone());
    if arguments.serve {
        let options = ServeOptions {
            period: arguments.period.map(duration).filter(|period| !period.is_zero()),
            patience,
            forever: arguments.forever,
        };
        let served = run_plant(plant, &mut connection, &options)?;
        console.print(&match arguments.json {
            true => json(&served),
            false => served_text(&served, console.look),
        })?;
        return Ok(Exit::Done);
    }
    let patience = patience.unwrap_or(PATIENCE);
    if let Some(file) =
        arguments.trace.as_ref().filter(|file| file.exists() && !arguments.overwrite)
    {
        return Err(HilError::Taken(file.clone()).into());
    }
    let seconds = arguments.duration.map_or(scene.duration, Time::seconds);
    let mode = if arguments.real_time { Mode::RealTime } else { Mode::Lockstep };
    let options = DriveOptions {
        settings: Settings {
            mode,
            steps: arguments.steps,
            policy: match arguments.when_late {
                Late::Hold => Policy::Hold,
                Late::Zero => Policy::Zero,
                Late::Stop => Policy::Stop,
            },
            timeout: arguments.timeout,
        },
        // The conversion saturates; half a step less, for a duration of whole steps is one.
        until: (seconds / step - 0.5).ceil() as u64,
        patience,
        silence: arguments.silence.map(|Silence(step, time)| (step, time)),
        session: session(),
    };
    let choice = ControllerChoice {
        name: arguments.controller.clone(),
        format: match arguments.lines {
            Lines::Csv => Format::Csv,
            Lines::Json => Format::Json,
        },
        limit: patience,
    };
    let trace = arguments.trace.as_deref();
    let (report, ended) = run_controller(plant, &mut connection, &choice, &options, trace)?;
    let printed = console.print(&match arguments.json {
        true => json(&report),
        false => report_text(&report, mode, console.look),
    });
    if let Some(ended) = &ended {
        console.report(ended);
    }
    printed?;
    Ok(if ended.is_some() { Exit::Failed } else { Exit::Done })
}

/// A number that the session before hardly had.
fn session() -> u16 {
    let now = SystemTime::now().duration_since(UNIX_EPOCH).unwrap_or_default();
    now.subsec_nanos() as u16 ^ std::process::id() as u16
}
