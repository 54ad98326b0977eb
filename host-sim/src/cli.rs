//! The command line: arguments in, exit code out.
//!
//! `arguments => command => text, files, exit code`. Callable in-process, so that tests and
//! further commands need no binary.

use std::ffi::OsString;
use std::io::Write;
use std::path::PathBuf;

use clap::{Args, CommandFactory as _, Parser, Subcommand, ValueHint};
use clap_complete::Shell;
use dbd_golden::{BandList, Blessing};
use dbd_import::omission;
use dbd_picture::Paper;
use dbd_plant::time::Time;
use dbd_plant::{DampingName, Method, Named as _, OrientationName, PrecisionName, SchemeName};
use dbd_study::{Phase, files};

use crate::arguments::{SceneArgument, names};
use crate::commands::check::check;
use crate::commands::completions::script;
use crate::commands::export::{self, ExportArguments};
use crate::commands::folder::Destination;
use crate::commands::golden::GoldenOptions;
use crate::commands::import::{self, ImportArguments};
use crate::commands::list::list;
use crate::commands::new::{FirmwareArguments, NewCommand, firmware};
use crate::commands::picture;
use crate::commands::picture::PictureError;
use crate::commands::run::{Outcome, RunOptions, run};
use crate::commands::stability::StabilityCheck;
use crate::commands::sweep::{SweepArguments, sweep};
use crate::commands::trade::{TradeRequest, json as survey_json, trade};
use crate::commands::warnings::of_scene;
use crate::commands::write::{self, WriteError};
use crate::error::Error;
use crate::simulate::EnergyLimit;
use crate::terminal::text::{json, table};
use crate::terminal::{Catalogue, Console, Exit, Found, Progress, SceneFile};

/// Discrete Body Dynamics: simulates mechanisms of rigid bodies and springs.
#[derive(Debug, Parser)]
#[command(name = "host-sim", version, disable_help_subcommand = true)]
struct Cli {
    #[command(subcommand)]
    command: Command,
}

#[derive(Debug, Subcommand)]
enum Command {
    /// Lists the scenes that have a name: those in scenes/ and those that are built in
    List {
        /// As JSON
        #[arg(long)]
        json: bool,
    },
    /// Runs a scene: writes OUT/SCENE/{trace.csv,summary.json,report.html}, prints the summary
    Run(RunArguments),
    /// Reads and assembles a scene without running it: counts, joints, frequencies, warnings
    Check(CheckArguments),
    /// Surveys speed against accuracy: writes OUT/SCENE/trade.{csv,svg,html,json}, trade-cortex-m4f.svg
    /// where steps were counted, and trade-*.cache; prints what to choose
    Trade(TradeArguments),
    /// Runs a scene with many values: writes OUT/SPEC/sweep.{csv,html,json}, a row per case; finished cases
    /// never run again
    Sweep(SweepArguments),
    /// Prints Rust source of a scene's const model and of its plant, for a firmware
    Export(ExportArguments),
    /// Makes a scene of MuJoCo's MJCF: each part with the line it comes from; what has no counterpart is
    /// listed with its size and refused, unless its kind is ignored
    Import(ImportArguments),
    /// Writes a new project that builds and runs as it is
    #[command(subcommand, disable_help_subcommand = true)]
    New(NewCommand),
    /// Prints a script that completes commands, options and scenes for a shell
    Completions {
        /// The shell
        shell: Shell,
    },
}

#[derive(Debug, Args)]
struct ResultsArguments {
    /// Folder below which results are written, each scene's in one of its file's name
    #[arg(long, value_name = "DIR", default_value = "out", value_hint = ValueHint::DirPath)]
    out: PathBuf,
    /// Replace the results of another scene whose file has the same name
    #[arg(long)]
    overwrite: bool,
}

impl ResultsArguments {
    fn destination(&self, file: &SceneFile) -> Destination {
        let Self { out, overwrite } = self;
        Destination { out: out.clone(), file: file.clone(), overwrite: *overwrite }
    }
}

#[derive(Debug, Args)]
struct CheckArguments {
    #[command(flatten)]
    scene: SceneArgument,
    /// As JSON
    #[arg(long)]
    json: bool,
    /// Write a picture of the mechanism at its initial pose, an SVG; - for standard output, in place
    /// of the table
    #[arg(long, value_name = "FILE", value_hint = ValueHint::FilePath)]
    svg: Option<PathBuf>,
    /// Write the scene in its long form: poses at which the joints are closed, all numbers in SI; - for
    /// standard output, in place of the table
    #[arg(long, value_name = "FILE", value_hint = ValueHint::FilePath)]
    write: Option<PathBuf>,
    /// Replace the file where there is one
    #[arg(long, requires = "write")]
    overwrite: bool,
    /// Look for the largest stable step about the pose at t = 0; takes seconds
    #[arg(long)]
    stability: bool,
    /// Its time-stepping scheme
    #[arg(long, value_parser = names::<SchemeName>(), default_value = SchemeName::default().name(), requires = "stability")]
    scheme: SchemeName,
    /// Its Newton iterations per step, at most 8 [default: 0]
    #[arg(long, value_name = "N", requires = "stability")]
    newton: Option<u32>,
    /// How its dampers act [default: the scheme's own]
    #[arg(long, value_parser = names::<DampingName>(), requires = "stability")]
    damping: Option<DampingName>,
    /// Its precision
    #[arg(long, value_parser = names::<PrecisionName>(), default_value = PrecisionName::default().name(), requires = "stability")]
    precision: PrecisionName,
}

#[derive(Debug, Args)]
struct RunArguments {
    #[command(flatten)]
    scene: SceneArgument,
    /// Time-stepping scheme
    #[arg(long, value_parser = names::<SchemeName>(), default_value = SchemeName::default().name())]
    scheme: SchemeName,
    /// Newton iterations per step of the dbd schemes, at most 8 [default: 0]
    #[arg(long, value_name = "N")]
    newton: Option<u32>,
    /// How dampers act [default: the scheme's own]
    #[arg(long, value_parser = names::<DampingName>())]
    damping: Option<DampingName>,
    /// Step, e.g. 20us [default: the scene's, else the advised one, shortened to fit]
    #[arg(long, value_name = "TIME", allow_hyphen_values = true)]
    step: Option<Time>,
    /// Simulated time, e.g. 0.5s [default: the scene's]
    #[arg(long, value_name = "TIME", allow_hyphen_values = true)]
    duration: Option<Time>,
    /// Precision of all arithmetic in a step
    #[arg(long, value_parser = names::<PrecisionName>(), default_value = PrecisionName::default().name())]
    precision: PrecisionName,
    /// How orientations are stored
    #[arg(long, value_parser = names::<OrientationName>(), default_value = OrientationName::default().name())]
    orientation: OrientationName,
    /// Sampling interval, e.g. 1ms [default: the scene's, else about 500 samples]
    #[arg(long, value_name = "TIME", allow_hyphen_values = true)]
    every: Option<Time>,
    /// End the run at the first sample whose total energy has changed by more than so many joules,
    /// or risen where only dampers change it
    #[arg(long, value_name = "LIMIT", allow_hyphen_values = true)]
    watch_energy: Option<EnergyLimit>,
    /// Compare with the golden run in a file, bit for bit; DBD_BLESS=golden in the environment writes it
    #[arg(long, value_name = "FILE", value_hint = ValueHint::FilePath)]
    golden: Option<PathBuf>,
    /// Compare within bands instead, by whatever scheme and precision: 1e-6 for all in SI units, or
    /// position=1e-6,orientation=1e-6,velocity=1e-3,angular-velocity=1e-3,READOUT=1e-3
    #[arg(long, value_name = "BANDS", requires = "golden", allow_hyphen_values = true)]
    golden_band: Option<BandList>,
    /// Write no report.html
    #[arg(long)]
    no_report: bool,
    #[command(flatten)]
    results: ResultsArguments,
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
    /// Time that every step divides, e.g. a controller's 1ms [default: the scene's sampling interval,
    /// else a power of ten of ten steps or more]
    #[arg(long, value_name = "TIME", allow_hyphen_values = true)]
    period: Option<Time>,
    #[command(flatten)]
    results: ResultsArguments,
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
    let catalogue = Catalogue::default();
    let done = match cli.command {
        Command::List { json } => list(&catalogue, json, console).map_err(Error::from),
        Command::Run(arguments) => run_scene(&catalogue, &arguments, console),
        Command::Check(arguments) => check_scene(&catalogue, &arguments, console),
        Command::Trade(arguments) => trade_scene(&catalogue, &arguments, console),
        Command::Sweep(arguments) => sweep_scene(&catalogue, &arguments, console),
        Command::Export(arguments) => export_scene(&catalogue, &arguments, console),
        Command::Import(arguments) => import_file(&arguments, console),
        Command::New(NewCommand::Firmware(arguments)) => {
            new_firmware(&catalogue, &arguments, console)
        }
        Command::Completions { shell } => complete(&catalogue, shell, console),
    };
    finish(done, console)
}

fn finish(done: Result<Exit, Error>, console: &mut Console<'_>) -> Exit {
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
        let printed = console.print(&text).map_err(Error::from);
        finish(printed.map(|()| Exit::Done), console)
    }
}

fn complete(catalogue: &Catalogue, shell: Shell, console: &mut Console<'_>) -> Result<Exit, Error> {
    console.print(&script(Cli::command(), &catalogue.names(), shell))?;
    Ok(Exit::Done)
}

fn load(catalogue: &Catalogue, argument: &SceneArgument) -> Result<Found, Error> {
    Ok(catalogue.load_with(&argument.scene, &argument.set)?)
}

fn run_scene(
    catalogue: &Catalogue,
    arguments: &RunArguments,
    console: &mut Console<'_>,
) -> Result<Exit, Error> {
    let method = Method::new(arguments.scheme, arguments.newton, arguments.precision)?;
    let method = damped(method, arguments.damping)?.with_orientation(arguments.orientation);
    method.check_built()?;
    let Found { scene, file, .. } = load(catalogue, &arguments.scene)?;
    let options = RunOptions {
        method,
        step: arguments.step.map(Time::seconds),
        duration: arguments.duration.map(Time::seconds),
        every: arguments.every.map(Time::seconds),
        watch_energy: arguments.watch_energy,
        golden: arguments.golden.as_ref().map(|file| GoldenOptions {
            file: file.clone(),
            bands: arguments.golden_band.clone(),
            blessing: Blessing::from_environment(),
        }),
        out: Some(arguments.results.destination(&file)),
        report: !arguments.no_report,
        called: Some(arguments.scene.scene.clone()),
    };
    let mut progress = Progress::new(console.terminal && !arguments.quiet);
    let outcome = run(&scene, &options, &mut |steps, all| progress.update(steps, all));
    progress.finish();
    let outcome = outcome?;
    let printed = if arguments.json {
        console.print(&outcome.summary.json())
    } else if !arguments.quiet {
        console.print(&summary_table(&outcome, options.report))
    } else {
        Ok(())
    };
    if arguments.json {
        for warning in outcome.summary.warnings.iter().filter(|_| !arguments.quiet) {
            console.warn(warning);
        }
    }
    let golden = outcome.summary.golden.as_ref();
    if let Some(golden) = golden.filter(|golden| golden.verdict == "blessed") {
        // Never silently.
        console.note(&golden.words);
    }
    let ended_by = outcome.ended_by().or(outcome.differs());
    if let Some(ended_by) = ended_by {
        console.report(ended_by);
    }
    printed?;
    Ok(if ended_by.is_some() { Exit::Failed } else { Exit::Done })
}

fn summary_table(outcome: &Outcome, report: bool) -> String {
    let mut rows = outcome.summary.rows();
    if let Some(folder) = &outcome.folder {
        let page = if report { ",report.html" } else { "" };
        rows.push(("written", format!("{}/{{trace.csv,summary.json{page}}}", folder.display())));
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
    method.check_built()?;
    let picture_printed = arguments.svg.as_ref().is_some_and(|file| picture::is_output(file));
    if picture_printed && arguments.json {
        return Err(PictureError::Both.into());
    }
    let long_printed = arguments.write.as_ref().is_some_and(|file| write::is_output(file));
    if long_printed && (arguments.json || picture_printed) {
        return Err(WriteError::Both.into());
    }
    let Found { scene, file, text } = load(catalogue, &arguments.scene)?;
    if let Some(target) = &arguments.write {
        let long = write::long_form(&scene, &text, &file.place, &arguments.scene.set)?;
        if long_printed {
            console.print(&long)?;
        } else {
            write::write(target, &long, arguments.overwrite)?;
        }
    }
    match &arguments.svg {
        Some(_) if picture_printed => console.print(&picture::picture(&scene, Paper::File))?,
        Some(file) => picture::write(&scene, file)?,
        None => (),
    }
    if picture_printed || long_printed {
        return Ok(Exit::Done);
    }
    let mut check = check(&scene);
    if arguments.stability {
        check.stability = Some(StabilityCheck::of(&scene, &method)?);
    }
    let mut text = if arguments.json { json(&check) } else { check.text() };
    if !arguments.json {
        let written = arguments.svg.iter().chain(&arguments.write);
        written.for_each(|file| text += &format!("\nwritten  {}\n", file.display()));
    }
    console.print(&text)?;
    Ok(Exit::Done)
}

fn trade_scene(
    catalogue: &Catalogue,
    arguments: &TradeArguments,
    console: &mut Console<'_>,
) -> Result<Exit, Error> {
    let called = &arguments.scene.scene;
    let Found { scene, file, .. } = load(catalogue, &arguments.scene)?;
    of_scene(&scene).iter().filter(|_| !arguments.quiet).for_each(|w| console.warn(w));
    let destination = arguments.results.destination(&file);
    let request = TradeRequest {
        called,
        window: arguments.window.map(Time::seconds),
        period: arguments.period.map(Time::seconds),
        out: &destination,
        shipped: Catalogue::ships(&scene),
    };
    let mut silence = std::io::sink();
    let lines = if arguments.quiet { &mut silence as &mut dyn Write } else { &mut *console.err };
    let bars = console.terminal && !arguments.quiet;
    let mut progress = Progress::of(bars, "evaluations", lines);
    let done = trade(&scene, &request, &mut |phase| match phase {
        Phase::Window => progress.begin("how long before chaos"),
        Phase::Truth => progress.begin("the truth"),
        Phase::Opinion => progress.begin("the truth, a second opinion"),
        Phase::Limits => progress.begin("the largest stable steps"),
        Phase::Runs(done, all) => progress.update(done, all),
        Phase::Times(0, _) => progress.begin("measuring times"),
        Phase::Times(..) => {}
    });
    progress.finish();
    let (trade, folder) = done?;
    let report = files::Report { scene: &scene, called, trade: &trade };
    if arguments.json {
        console.print(&survey_json(&report, &file))?;
    } else if !arguments.quiet {
        let written = format!("{}/trade.{{csv,svg,html,json}}", folder.display());
        console.print(&format!("{}\nwritten  {written}\n", report.text()))?;
    }
    Ok(Exit::Done)
}

fn sweep_scene(
    catalogue: &Catalogue,
    arguments: &SweepArguments,
    console: &mut Console<'_>,
) -> Result<Exit, Error> {
    let mut silence = std::io::sink();
    let lines = if arguments.quiet { &mut silence as &mut dyn Write } else { &mut *console.err };
    let bars = console.terminal && !arguments.quiet;
    let mut progress = Progress::of_many(bars, "cases", lines);
    let done = sweep(catalogue, arguments, &mut |done, all| progress.update(done, all));
    progress.finish();
    let outcome = done?;
    outcome.damages.iter().filter(|_| !arguments.quiet).for_each(|damage| console.warn(damage));
    if arguments.json {
        console.print(&json(&outcome))?;
    } else if !arguments.quiet {
        console.print(&table(&outcome.rows()))?;
    }
    Ok(Exit::Done)
}

fn export_scene(
    catalogue: &Catalogue,
    arguments: &ExportArguments,
    console: &mut Console<'_>,
) -> Result<Exit, Error> {
    let text = export::export(&load(catalogue, &arguments.scene)?.scene, &arguments.options)?;
    match &arguments.out {
        Some(file) => export::write(file, &text)?,
        None => console.print(&text)?,
    }
    Ok(Exit::Done)
}

fn import_file(arguments: &ImportArguments, console: &mut Console<'_>) -> Result<Exit, Error> {
    if arguments.list {
        console.print(&import::list(arguments)?)?;
        return Ok(Exit::Done);
    }
    let imported = import::import(arguments)?;
    if !imported.omitted.is_empty() {
        console.note(&format!("left out:\n{}", omission::table(&imported.omitted).trim_end()));
    }
    imported.notes.iter().for_each(|note| console.note(note));
    match &arguments.out {
        Some(file) => import::write(file, &imported.scene)?,
        None => console.print(&imported.scene)?,
    }
    Ok(Exit::Done)
}

fn new_firmware(
    catalogue: &Catalogue,
    arguments: &FirmwareArguments,
    console: &mut Console<'_>,
) -> Result<Exit, Error> {
    let found = catalogue.load(&arguments.scene)?;
    console.print(&firmware(arguments, &found)?)?;
    Ok(Exit::Done)
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn the_command_line_is_consistent() {
        Cli::command().debug_assert();
    }

    /// With the feature, `run` takes Euler angles; without, it says what to do.
    #[test]
    fn what_is_for_comparison_is_refused_with_its_remedy_where_it_is_not_built() {
        let out = tempfile::tempdir().unwrap();
        let folder = out.path().to_str().unwrap();
        let words = ["run", "spring-ball", "--duration", "0.1s", "--out", folder];
        let options = [["--orientation", "euler-321"], ["--precision", "f32-micromath"]];
        for option in options {
            let (mut said, mut wrong) = (Vec::new(), Vec::new());
            let mut console = Console { out: &mut said, err: &mut wrong, terminal: false };
            let line = ["host-sim"].into_iter().chain(words).chain(option);
            let exit = main_with(line, &mut console);
            let wrong = String::from_utf8(wrong).unwrap();
            // Whoever builds this crate's library for more programs decides.
            if Method::default().with_orientation(OrientationName::Euler321).check_built().is_ok() {
                assert_eq!((exit, wrong.as_str()), (Exit::Done, ""));
            } else {
                assert_eq!(exit, Exit::Refused);
                assert!(wrong.contains("--features comparison"), "{wrong}");
            }
        }
    }
}
