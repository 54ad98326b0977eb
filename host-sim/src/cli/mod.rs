//! The command line: arguments in, exit code out.
//!
//! `arguments => command => text, files, exit code`. Callable in-process, so that tests and
//! further commands need no binary.

mod advise;
mod check;
mod compare;
mod first_steps;
mod hil;
mod linearise;
mod modes;
mod named;
mod play;
mod relax;
mod reproduce;
mod run;
mod trade;

use std::ffi::OsString;
use std::io::Write;
use std::path::PathBuf;

use clap::{ColorChoice, CommandFactory as _, Parser, Subcommand, ValueHint};
use clap_complete::Shell;
use dbd_import::export::{Exported, table};
use dbd_import::omission;

use crate::cli::advise::{AdviseArguments, advise_scene};
use crate::cli::check::{CheckArguments, check_scene};
use crate::cli::compare::compare;
use crate::cli::first_steps::first_steps;
use crate::cli::hil::{HilArguments, hil_of_scene};
use crate::cli::linearise::linearise_scene;
use crate::cli::modes::{ModesArguments, modes_of_scene};
use crate::cli::named::load;
use crate::cli::play::{PlayArguments, play_scenes};
use crate::cli::relax::{RelaxArguments, relax_scene};
use crate::cli::reproduce::{ReproduceArguments, reproduce_items};
use crate::cli::run::{RunArguments, run_scene};
use crate::cli::trade::{TradeArguments, trade_scene};
use crate::commands::compare::CompareArguments;
use crate::commands::completions::script;
use crate::commands::export::{self, ExportArguments};
use crate::commands::fmu::{FmuArguments, fmu};
use crate::commands::import::{self, Import, ImportArguments};
use crate::commands::linearise::LineariseArguments;
use crate::commands::list::list;
use crate::commands::manual;
use crate::commands::new::{
    NewCommand, NewError, PlantArguments, SceneArguments, c, firmware, laws, scene,
};
use crate::commands::report::{ReportArguments, report};
use crate::commands::schema;
use crate::commands::sweep::{SweepArguments, sweep};
use crate::error::Error;
use crate::help;
use crate::terminal::text::json;
use crate::terminal::{Catalogue, Console, Exit, Found, Progress};

/// Discrete Body Dynamics: simulates mechanisms of rigid bodies and springs.
#[derive(Debug, Parser)]
#[command(name = "host-sim", version, disable_help_subcommand = true, max_term_width = 100)]
#[command(
    after_help = "Without a command, the first steps are shown. The help of each command ends with examples."
)]
struct Cli {
    #[command(subcommand)]
    command: Option<Command>,
    /// Use colours: on a terminal only, always or never
    #[arg(
        long,
        alias = "colour",
        global = true,
        value_name = "WHEN",
        default_value = "auto",
        display_order = 900
    )]
    color: ColorChoice,
}

#[derive(Debug, Subcommand)]
enum Command {
    /// Lists the named scenes: those in scenes/ and the built-in ones
    #[command(after_help = help::LIST)]
    List {
        /// Print JSON
        #[arg(long)]
        json: bool,
    },
    /// Runs a scene: writes OUT/SCENE/{trace.csv,summary.json,report.html}, prints the summary
    #[command(after_help = help::RUN)]
    Run(RunArguments),
    /// Reads and assembles a scene without running it: counts, joints, frequencies, warnings
    #[command(after_help = help::CHECK)]
    Check(CheckArguments),
    /// Finds the modes of a scene: frequencies, damping ratios, effective masses and the joints involved; with --out
    /// writes DIR/SCENE/modes.{csv,json,html} and the matrices
    #[command(after_help = help::MODES)]
    Modes(ModesArguments),
    /// Moves a scene's bodies to static equilibrium under their loads; prints the displacements and residual forces
    #[command(after_help = help::RELAX)]
    Relax(RelaxArguments),
    /// Compares speed and accuracy of the methods: writes OUT/SCENE/trade.{csv,svg,html,json}, trade-cortex-m4f.svg
    /// where steps were counted, and trade-*.cache; prints a recommendation
    #[command(after_help = help::TRADE)]
    Trade(TradeArguments),
    /// Recommends a method and step for a scene on a microcontroller, verified by running it; exit code 1 if
    /// no method meets the requirements
    #[command(after_help = help::ADVISE)]
    Advise(AdviseArguments),
    /// Reproduces the results of the method's paper: writes OUT/reproduce/reproduce.{html,md,json} and files of
    /// each item, prints the paper's value, the measured one and a verdict
    #[command(after_help = help::REPRODUCE)]
    Reproduce(ReproduceArguments),
    /// Runs a scene with many values: writes OUT/SPEC/sweep.{csv,html,json}, one row per case; finished cases
    /// are not run again
    #[command(after_help = help::SWEEP)]
    Sweep(SweepArguments),
    /// Compares two recorded runs, e.g. two schemes or a PC and a chip: bits, first difference, distances; writes
    /// OUT/compare/NAME/{report.html,compare.json}; exit code 0 if they are equal, 1 if not
    #[command(after_help = help::COMPARE)]
    Compare(CompareArguments),
    /// Shows a recorded run, also of your own loop or of firmware: writes a page with animation and curves
    #[command(after_help = help::REPORT)]
    Report(ReportArguments),
    /// Prints Rust source of a scene's const model and of its plant, for firmware
    #[command(after_help = help::EXPORT)]
    Export(ExportArguments),
    /// Writes an FMU of a scene for other simulation tools: FMI 2.0 or 3.0, co-simulation
    #[command(after_help = help::FMU)]
    Fmu(FmuArguments),
    /// Linearises a scene: prints poles, drift and names, with --out writes A, B, C and D
    #[command(after_help = help::LINEARISE)]
    Linearise(LineariseArguments),
    /// Hardware in the loop: drives a plant on a microcontroller over a serial line and compares every frame bit for
    /// bit with its own model, or serves the plant (--serve); exit code 1 if a bit differs
    #[command(after_help = help::HIL)]
    Hil(HilArguments),
    /// Writes a page in which scenes run live, bit-identical to run: sliders, curves, an editor, dragging of bodies;
    /// opens it in a browser, or serves it (--serve)
    #[command(after_help = help::PLAY)]
    Play(PlayArguments),
    /// Converts MuJoCo's MJCF or a URDF to a scene, each part with its source line; elements without a counterpart are
    /// listed with their size and are an error, unless their kind is ignored
    #[command(after_help = help::IMPORT)]
    Import(ImportArguments),
    /// Writes a new project or a new scene, ready to run
    #[command(subcommand, disable_help_subcommand = true)]
    New(NewCommand),
    /// Prints the JSON Schema of scene files, for completion in editors
    #[command(after_help = help::SCHEMA)]
    Schema,
    /// Prints a shell's completion script for commands, options and scenes
    #[command(after_help = help::COMPLETIONS)]
    Completions {
        /// The shell
        shell: Shell,
    },
    /// Writes manual pages for `man` into a folder, one per command
    #[command(after_help = help::MANUAL)]
    Manual {
        /// The folder, which is created
        #[arg(value_hint = ValueHint::DirPath)]
        folder: PathBuf,
    },
}

/// Runs a command line that begins with the program's name.
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
    console.choose(cli.color);
    let Some(command) = cli.command else {
        let text = first_steps(&Cli::command(), &catalogue, console.err_look);
        let _ = console.err.write_all(text.as_bytes());
        return Exit::Refused;
    };
    let done = match command {
        Command::List { json } => list(&catalogue, json, console).map_err(Error::from),
        Command::Run(arguments) => run_scene(&catalogue, &arguments, console),
        Command::Check(arguments) => check_scene(&catalogue, &arguments, console),
        Command::Modes(arguments) => modes_of_scene(&catalogue, &arguments, console),
        Command::Relax(arguments) => relax_scene(&catalogue, &arguments, console),
        Command::Trade(arguments) => trade_scene(&catalogue, &arguments, console),
        Command::Advise(arguments) => advise_scene(&catalogue, &arguments, console),
        Command::Reproduce(arguments) => reproduce_items(&arguments, console),
        Command::Sweep(arguments) => sweep_scene(&catalogue, &arguments, console),
        Command::Compare(arguments) => compare(&catalogue, &arguments, console),
        Command::Report(arguments) => report_run(&catalogue, &arguments, console),
        Command::Export(arguments) => export_scene(&catalogue, &arguments, console),
        Command::Fmu(arguments) => write_fmu(&catalogue, &arguments, console),
        Command::Linearise(arguments) => linearise_scene(&catalogue, &arguments, console),
        Command::Hil(arguments) => hil_of_scene(&catalogue, &arguments, console),
        Command::Play(arguments) => play_scenes(&catalogue, &arguments, console),
        Command::Import(arguments) => import_file(&arguments, console),
        Command::New(NewCommand::Firmware(arguments)) => {
            let write = |found: &Found| firmware(&arguments, found);
            new_plant(&catalogue, &arguments.plant.scene, write, console)
        }
        Command::New(NewCommand::C(arguments)) => {
            new_plant(&catalogue, &arguments.scene, |found| c(&arguments, found), console)
        }
        Command::New(NewCommand::Laws(arguments)) => laws(&arguments)
            .map_err(Error::from)
            .and_then(|said| console.print(&said).map_err(Error::from))
            .map(|()| Exit::Done),
        Command::New(NewCommand::Scene(arguments)) => new_scene(&catalogue, &arguments, console),
        Command::Schema => console.print(&schema::text()).map(|()| Exit::Done).map_err(Error::from),
        Command::Completions { shell } => complete(&catalogue, shell, console),
        Command::Manual { folder } => {
            manual::write(&Cli::command(), &folder).map(|()| Exit::Done).map_err(Error::from)
        }
    };
    finish(done, console)
}

fn finish(done: Result<Exit, Error>, console: &mut Console<'_>) -> Exit {
    done.unwrap_or_else(|error| {
        console.report(&error);
        error.exit()
    })
}

/// Prints help, version or an error in the arguments.
fn usage(error: &clap::Error, console: &mut Console<'_>) -> Exit {
    let look = if error.use_stderr() { console.err_look } else { console.look };
    let text = match look.colours {
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
        console.print(&console.look.table(&outcome.rows()))?;
    }
    Ok(Exit::Done)
}

fn report_run(
    catalogue: &Catalogue,
    arguments: &ReportArguments,
    console: &mut Console<'_>,
) -> Result<Exit, Error> {
    let written = report(catalogue, arguments)?;
    written.warnings.iter().for_each(|warning| console.note(warning));
    console.print(&format!("written  {}\n", written.file.display()))?;
    Ok(Exit::Done)
}

fn export_scene(
    catalogue: &Catalogue,
    arguments: &ExportArguments,
    console: &mut Console<'_>,
) -> Result<Exit, Error> {
    let ExportArguments { scene, format, options, out } = arguments;
    if let (true, Some(folder)) = (format.c, out) {
        let plant = PlantArguments::of(folder, &scene.scene, options);
        return new_plant(catalogue, &scene.scene, |found| c(&plant, found), console);
    }
    let scene = load(catalogue, scene)?.scene;
    let text = if format.urdf {
        let Exported { text, left_out, notes } = export::urdf(&scene, format)?;
        if !left_out.is_empty() {
            console.note(&format!("left out:\n{}", table(&left_out).trim_end()));
        }
        notes.iter().for_each(|note| console.note(note));
        text
    } else {
        export::export(&scene, options)?
    };
    match out {
        Some(file) => export::write(file, &text, format)?,
        None => console.print(&text)?,
    }
    Ok(Exit::Done)
}

fn write_fmu(
    catalogue: &Catalogue,
    arguments: &FmuArguments,
    console: &mut Console<'_>,
) -> Result<Exit, Error> {
    let written = fmu(&load(catalogue, &arguments.scene)?, arguments)?;
    console.print(&written)?;
    Ok(Exit::Done)
}

fn import_file(arguments: &ImportArguments, console: &mut Console<'_>) -> Result<Exit, Error> {
    if arguments.list {
        console.print(&import::list(arguments)?)?;
        return Ok(Exit::Done);
    }
    let Import { imported, closed, open } = import::import(arguments)?;
    if !imported.omitted.is_empty() {
        console.note(&format!("left out:\n{}", omission::table(&imported.omitted).trim_end()));
    }
    imported.notes.iter().chain(&closed).for_each(|note| console.note(note));
    match &arguments.out {
        Some(file) => import::write(file, &imported.scene)?,
        None => console.print(&imported.scene)?,
    }
    open.map_or(Ok(Exit::Done), |open| Err(open.into()))
}

fn new_plant(
    catalogue: &Catalogue,
    scene: &str,
    write: impl FnOnce(&Found) -> Result<String, NewError>,
    console: &mut Console<'_>,
) -> Result<Exit, Error> {
    let found = catalogue.load(scene)?;
    console.print(&write(&found)?)?;
    Ok(Exit::Done)
}

fn new_scene(
    catalogue: &Catalogue,
    arguments: &SceneArguments,
    console: &mut Console<'_>,
) -> Result<Exit, Error> {
    let from = arguments.from.as_ref().map(|scene| catalogue.load(scene)).transpose()?;
    let copied = from.as_ref().map(|found| found.text.as_str());
    console.print(&scene(&arguments.name, copied, arguments.template)?)?;
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

    /// The commands that do something, each with the words that call it.
    fn leaves(command: &clap::Command, words: &str) -> Vec<(String, clap::Command)> {
        let below: Vec<_> = command.get_subcommands().collect();
        if below.is_empty() {
            return vec![(words.to_owned(), command.clone())];
        }
        let leaf = |sub: &&clap::Command| leaves(sub, &format!("{words} {}", sub.get_name()));
        below.iter().flat_map(leaf).collect()
    }

    /// What ends a command in a shell.
    const SHELL: [&str; 2] = [" | ", " > "];

    /// Every command has examples; each calls the command, has a comment before it, and is taken; the scenes that
    /// it names are there.
    #[test]
    fn the_examples_of_the_help_are_command_lines() {
        let names = Catalogue::default().names();
        for (words, command) in leaves(&Cli::command(), "host-sim") {
            let help = command.get_after_help().map(ToString::to_string).unwrap_or_default();
            let mut lines = help.lines();
            assert_eq!(lines.next(), Some("Examples:"), "{words} has no examples");
            let lines: Vec<&str> = lines.collect();
            assert!(lines.len() >= 2, "{words}: {help}");
            for pair in lines.chunks(2) {
                let [comment, line] = pair else { panic!("{words}: {pair:?}") };
                assert!(comment.starts_with("  # ") && line.starts_with("  "), "{words}: {pair:?}");
                let line = SHELL.iter().fold(line.trim(), |line, end| {
                    line.split_once(end).map_or(line, |(before, _)| before)
                });
                assert!(line == words || line.starts_with(&format!("{words} ")), "{line}");
                let cli = Cli::try_parse_from(shlex::split(line).unwrap());
                let cli = cli.unwrap_or_else(|error| panic!("{error}"));
                let scene = match cli.command.unwrap() {
                    Command::Run(RunArguments { scene, .. })
                    | Command::Check(CheckArguments { scene, .. })
                    | Command::Modes(ModesArguments { scene, .. })
                    | Command::Relax(RelaxArguments { scene, .. })
                    | Command::Trade(TradeArguments { scene, .. })
                    | Command::Linearise(LineariseArguments { scene, .. })
                    | Command::Hil(HilArguments { scene, .. })
                    | Command::Advise(AdviseArguments { scene, .. })
                    | Command::Export(ExportArguments { scene, .. }) => scene.scene,
                    _ => continue,
                };
                assert!(scene == "my.toml" || names.contains(&scene), "{line}: no such scene");
            }
        }
    }

    /// Without a command nothing is done; what is shown are command lines, too.
    #[test]
    fn without_a_command_the_first_steps_are_shown() {
        let (mut said, mut wrong) = (Vec::new(), Vec::new());
        let exit = main_with(["host-sim"], &mut Console::plain(&mut said, &mut wrong));
        assert_eq!((exit, said.len()), (Exit::Refused, 0));
        let text = String::from_utf8(wrong).unwrap();
        let steps: Vec<&str> = text.lines().filter(|line| line.starts_with("  host-sim")).collect();
        assert_eq!(steps.len(), 5, "{text}");
        for step in steps {
            let (line, _) = step.trim().split_once("  ").unwrap();
            assert!(Cli::try_parse_from(shlex::split(line).unwrap()).is_ok(), "{line}");
        }
        for sub in Cli::command().get_subcommands() {
            assert!(text.contains(sub.get_name()), "{text}");
        }
        assert!(text.contains("four-bar, gripper"), "{text}");
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
            let mut console = Console::plain(&mut said, &mut wrong);
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
