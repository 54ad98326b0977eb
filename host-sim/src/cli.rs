//! The command line: arguments in, exit code out.
//!
//! `arguments => command => text, files, exit code`. Callable in-process, so that tests and
//! further commands need no binary.

use std::ffi::OsString;
use std::path::PathBuf;

use clap::{Args, Parser, Subcommand, ValueEnum};
use dbd_kernel::F32;
use dbd_scene::export;

use crate::catalogue::Catalogue;
use crate::check::check;
use crate::console::Console;
use crate::error::{Error, Exit};
use crate::frequencies::Frequencies;
use crate::list::list;
use crate::method::{DampingName, Method, OrientationName, PrecisionName, SchemeName};
use crate::output;
use crate::progress::Progress;
use crate::run::{Outcome, RunOptions, run};
use crate::stability_check::StabilityCheck;
use crate::summary::{json, table};
use crate::time::Time;
use crate::trade::survey::longest_window;
use crate::trade::{Phase, TradeOptions, files, survey};

/// Discrete Body Dynamics: simulates mechanisms of rigid bodies and springs.
#[derive(Debug, Parser)]
#[command(name = "host-sim", version, disable_help_subcommand = true)]
struct Cli {
    #[command(subcommand)]
    command: Command,
}

#[derive(Debug, Subcommand)]
enum Command {
    /// Lists the scenes that ship
    List {
        /// As JSON
        #[arg(long)]
        json: bool,
    },
    /// Runs a scene: writes OUT/SCENE/{trace.csv,summary.json,report.html}, prints the summary
    Run(RunArguments),
    /// Reads and assembles a scene without running it: counts, joints, frequencies, warnings
    Check(CheckArguments),
    /// Surveys speed against accuracy: writes OUT/SCENE/trade.{csv,svg,html}, trade-cortex-m4f.svg
    /// where steps were counted, and trade-*.cache; prints what to choose
    Trade(TradeArguments),
    /// Prints Rust source of a scene's const model, for a firmware
    Export {
        #[command(flatten)]
        scene: SceneArgument,
        /// The model's precision [default: all]
        #[arg(long, value_enum)]
        precision: Option<ExportPrecision>,
    },
}

/// Precisions that const models are written in.
#[derive(Clone, Copy, Debug, ValueEnum)]
enum ExportPrecision {
    F64,
    F32,
}

#[derive(Debug, Args)]
struct SceneArgument {
    /// A scene in scenes/ by name, or a path to a .toml file
    scene: String,
}

#[derive(Debug, Args)]
struct CheckArguments {
    #[command(flatten)]
    scene: SceneArgument,
    /// As JSON
    #[arg(long)]
    json: bool,
    /// Look for the largest stable step about the pose at t = 0; takes seconds
    #[arg(long)]
    stability: bool,
    /// Its time-stepping scheme
    #[arg(long, value_enum, default_value_t, requires = "stability")]
    scheme: SchemeName,
    /// Its Newton iterations per step, at most 8 [default: 0]
    #[arg(long, value_name = "N", requires = "stability")]
    newton: Option<u32>,
    /// How its dampers act [default: the scheme's own]
    #[arg(long, value_enum, requires = "stability")]
    damping: Option<DampingName>,
    /// Its precision
    #[arg(long, value_enum, default_value_t, requires = "stability")]
    precision: PrecisionName,
}

#[derive(Debug, Args)]
struct RunArguments {
    #[command(flatten)]
    scene: SceneArgument,
    /// Time-stepping scheme
    #[arg(long, value_enum, default_value_t)]
    scheme: SchemeName,
    /// Newton iterations per step of the dbd schemes, at most 8 [default: 0]
    #[arg(long, value_name = "N")]
    newton: Option<u32>,
    /// How dampers act [default: the scheme's own]
    #[arg(long, value_enum)]
    damping: Option<DampingName>,
    /// Step, e.g. 20us [default: the scene's, else the advised one, shortened to fit]
    #[arg(long, value_name = "TIME", allow_hyphen_values = true)]
    step: Option<Time>,
    /// Simulated time, e.g. 0.5s [default: the scene's]
    #[arg(long, value_name = "TIME", allow_hyphen_values = true)]
    duration: Option<Time>,
    /// Precision of all arithmetic in a step
    #[arg(long, value_enum, default_value_t)]
    precision: PrecisionName,
    /// How orientations are stored
    #[arg(long, value_enum, default_value_t)]
    orientation: OrientationName,
    /// Sampling interval, e.g. 1ms [default: the scene's, else about 500 samples]
    #[arg(long, value_name = "TIME", allow_hyphen_values = true)]
    every: Option<Time>,
    /// Folder below which results are written
    #[arg(long, value_name = "DIR", default_value = "out")]
    out: PathBuf,
    /// Print nothing but errors
    #[arg(long)]
    quiet: bool,
    /// Print the summary as JSON
    #[arg(long)]
    json: bool,
}

#[derive(Debug, Args)]
struct TradeArguments {
    #[command(flatten)]
    scene: SceneArgument,
    /// Longest window of comparison, e.g. 0.2s; it ends before chaos takes over [default: 0.5s or
    /// the scene's duration]
    #[arg(long, value_name = "TIME", allow_hyphen_values = true)]
    window: Option<Time>,
    /// Folder below which results are written, and kept for the next call
    #[arg(long, value_name = "DIR", default_value = "out")]
    out: PathBuf,
    /// Print nothing but errors
    #[arg(long)]
    quiet: bool,
    /// Print window and all points as JSON
    #[arg(long)]
    json: bool,
}

/// Runs a command line, the program's name first.
pub fn main_with<I>(arguments: I, console: &mut Console<'_>) -> Exit
where
    I: IntoIterator,
    I::Item: Into<OsString> + Clone,
{
    let cli = match Cli::try_parse_from(arguments) {
        Ok(cli) => cli,
        Err(error) => return usage(&error, console),
    };
    let catalogue = Catalogue::find();
    let done = match cli.command {
        Command::List { json } => Ok(list(&catalogue, json, console)),
        Command::Run(arguments) => run_scene(&catalogue, &arguments, console),
        Command::Check(arguments) => check_scene(&catalogue, &arguments, console),
        Command::Trade(arguments) => trade_scene(&catalogue, &arguments, console),
        Command::Export { scene, precision } => {
            export_scene(&catalogue, &scene.scene, precision, console)
        }
    };
    done.unwrap_or_else(|error| {
        console.report(&error);
        error.exit()
    })
}

/// Prints help, version or what is wrong with the arguments.
fn usage(error: &clap::Error, console: &mut Console<'_>) -> Exit {
    let text = match console.terminal {
        true => error.render().ansi().to_string(),
        false => error.render().to_string(),
    };
    if error.use_stderr() {
        let _ = console.err.write_all(text.as_bytes());
        Exit::Refused
    } else {
        console.print(&text);
        Exit::Done
    }
}

fn run_scene(
    catalogue: &Catalogue,
    arguments: &RunArguments,
    console: &mut Console<'_>,
) -> Result<Exit, Error> {
    let method = Method::new(arguments.scheme, arguments.newton, arguments.precision)?;
    let method = damped(method, arguments.damping)?.with_orientation(arguments.orientation);
    let scene = catalogue.load(&arguments.scene.scene)?;
    let options = RunOptions {
        method,
        step: arguments.step.map(Time::seconds),
        duration: arguments.duration.map(Time::seconds),
        every: arguments.every.map(Time::seconds),
        out: Some(arguments.out.clone()),
        called: Some(arguments.scene.scene.clone()),
    };
    let mut progress = Progress::new(console.terminal && !arguments.quiet);
    let outcome = run(&scene, &options, &mut |steps, all| progress.update(steps, all));
    progress.finish();
    let outcome = outcome?;
    if arguments.json {
        console.print(&outcome.summary.json());
        for warning in outcome.summary.warnings.iter().filter(|_| !arguments.quiet) {
            console.warn(warning);
        }
    } else if !arguments.quiet {
        console.print(&summary_table(&outcome));
    }
    Ok(match outcome.failure {
        Some(failure) => {
            console.report(&failure);
            Exit::Failed
        }
        None => Exit::Done,
    })
}

fn summary_table(outcome: &Outcome) -> String {
    let mut rows = outcome.summary.rows();
    if let Some(folder) = &outcome.folder {
        rows.push((
            "written",
            format!("{}/{{trace.csv,summary.json,report.html}}", folder.display()),
        ));
    }
    table(&rows)
}

fn damped(method: Method, damping: Option<DampingName>) -> Result<Method, Error> {
    Ok(match damping {
        Some(damping) => method.with_damping(damping)?,
        None => method,
    })
}

fn check_scene(
    catalogue: &Catalogue,
    arguments: &CheckArguments,
    console: &mut Console<'_>,
) -> Result<Exit, Error> {
    let method = Method::new(arguments.scheme, arguments.newton, arguments.precision)?;
    let method = damped(method, arguments.damping)?;
    let scene = catalogue.load(&arguments.scene.scene)?;
    let mut check = check(&scene);
    if arguments.stability {
        check.stability = Some(StabilityCheck::of(&scene, &method)?);
    }
    console.print(&if arguments.json { json(&check) } else { check.text() });
    Ok(Exit::Done)
}

fn trade_scene(
    catalogue: &Catalogue,
    arguments: &TradeArguments,
    console: &mut Console<'_>,
) -> Result<Exit, Error> {
    let called = &arguments.scene.scene;
    let scene = catalogue.load(called)?;
    let window = arguments.window.map(Time::seconds);
    // Bad input leaves no folder behind.
    longest_window(&scene, window)?;
    let folder = output::folder(&arguments.out, &scene.name)
        .map_err(|reason| Error::Folder { folder: arguments.out.join(&scene.name), reason })?;
    let shipped = catalogue.ships(&scene);
    let options = TradeOptions { window, cache: Some(folder.clone()), shipped };
    let mut progress = Progress::of(console.terminal && !arguments.quiet, "evaluations");
    let trade = survey(&scene, &options, &mut |phase| match phase {
        Phase::Window => progress.begin("how long before chaos"),
        Phase::Truth => progress.begin("the truth"),
        Phase::Opinion => progress.begin("the truth, a second opinion"),
        Phase::Runs(done, all) => progress.update(done, all),
        Phase::Times(0, _) => progress.begin("measuring times"),
        Phase::Times(..) => {}
    });
    progress.finish();
    let trade = trade?;
    let report = files::Report { scene: &scene, called, trade: &trade };
    report.write(&folder).map_err(Error::Write)?;
    if arguments.json {
        console.print(&json(&report.json()));
    } else if !arguments.quiet {
        let written = format!("{}/trade.{{csv,svg,html}}", folder.display());
        console.print(&format!("{}\nwritten  {written}\n", report.text()));
    }
    Ok(Exit::Done)
}

/// The constant of the step is the scene's, else the default one before it is shortened to fit.
fn export_scene(
    catalogue: &Catalogue,
    scene: &str,
    precision: Option<ExportPrecision>,
    console: &mut Console<'_>,
) -> Result<Exit, Error> {
    let scene = catalogue.load(scene)?;
    let step = Frequencies::of(&scene).default_limit(scene.duration);
    let mut source = export::preamble(&scene, step);
    for precision in precision.map_or(ExportPrecision::value_variants().to_vec(), |one| vec![one]) {
        source += &match precision {
            ExportPrecision::F64 => export::model::<f64>(&scene),
            ExportPrecision::F32 => {
                scene.check_inputs::<F32>()?;
                export::model::<f32>(&scene)
            }
        };
    }
    console.print(&source);
    Ok(Exit::Done)
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn the_command_line_is_consistent() {
        use clap::CommandFactory as _;
        Cli::command().debug_assert();
    }
}
