//! The command line: arguments in, exit code out.
//!
//! `arguments => command => text, files, exit code`. Callable in-process, so that tests and
//! further commands need no binary.

mod check;
mod named;
mod run;
mod trade;

use std::ffi::OsString;
use std::io::Write;

use clap::{CommandFactory as _, Parser, Subcommand};
use clap_complete::Shell;
use dbd_import::omission;

use crate::cli::check::{CheckArguments, check_scene};
use crate::cli::named::load;
use crate::cli::run::{RunArguments, run_scene};
use crate::cli::trade::{TradeArguments, trade_scene};
use crate::commands::completions::script;
use crate::commands::export::{self, ExportArguments};
use crate::commands::import::{self, ImportArguments};
use crate::commands::list::list;
use crate::commands::new::{FirmwareArguments, NewCommand, SceneArguments, firmware, scene};
use crate::commands::schema;
use crate::commands::sweep::{SweepArguments, sweep};
use crate::error::Error;
use crate::terminal::text::{json, table};
use crate::terminal::{Catalogue, Console, Exit, Progress};

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
    /// Writes a new project or a new scene that runs as it is
    #[command(subcommand, disable_help_subcommand = true)]
    New(NewCommand),
    /// Prints the JSON Schema of scene files, from which editors complete keys
    Schema,
    /// Prints a script that completes commands, options and scenes for a shell
    Completions {
        /// The shell
        shell: Shell,
    },
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
        Command::New(NewCommand::Scene(arguments)) => new_scene(&catalogue, &arguments, console),
        Command::Schema => console.print(&schema::text()).map(|()| Exit::Done).map_err(Error::from),
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

fn new_scene(
    catalogue: &Catalogue,
    arguments: &SceneArguments,
    console: &mut Console<'_>,
) -> Result<Exit, Error> {
    let from = arguments.from.as_ref().map(|scene| catalogue.load(scene)).transpose()?;
    console.print(&scene(&arguments.name, from.as_ref().map(|found| found.text.as_str()))?)?;
    Ok(Exit::Done)
}

#[cfg(test)]
mod tests {
    use dbd_plant::{Method, OrientationName};

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
