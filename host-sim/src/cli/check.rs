//! `host-sim check` on the command line.

use std::io::IsTerminal as _;
use std::path::PathBuf;

use clap::{Args, ValueHint};
use dbd_plant::{DampingName, Method, Named as _, PrecisionName, SchemeName};
use dbd_report::picture::Paper;

use crate::arguments::{SceneArgument, names};
use crate::cli::named::{damped, leaving, load};
use crate::commands::check::check;
use crate::commands::picture::{self, PictureError};
use crate::commands::stability::StabilityCheck;
use crate::commands::watch::{WatchError, Watched};
use crate::commands::write::{self, WriteError};
use crate::error::Error;
use crate::terminal::text::json;
use crate::terminal::{Catalogue, Console, Exit, Found};

/// Clears the terminal and moves the cursor to its top.
const CLEAR: &str = "\u{1b}[2J\u{1b}[H";

#[derive(Debug, Args)]
pub(super) struct CheckArguments {
    #[command(flatten)]
    pub(super) scene: SceneArgument,
    /// Print JSON
    #[arg(long)]
    json: bool,
    /// Write an SVG picture of the mechanism at its initial pose; - for standard output, instead
    /// of the table
    #[arg(long, value_name = "FILE", value_hint = ValueHint::FilePath)]
    svg: Option<PathBuf>,
    /// Write the scene in its long form: poses with closed joints, all numbers in SI; - for
    /// standard output, instead of the table
    #[arg(long, value_name = "FILE", value_hint = ValueHint::FilePath)]
    write: Option<PathBuf>,
    /// Overwrite an existing file
    #[arg(long, requires = "write")]
    overwrite: bool,
    /// Check again at each save of the file, --svg and --write included, until Ctrl-C
    #[arg(long)]
    watch: bool,
    /// Find the largest stable step about the pose at t = 0; takes seconds
    #[arg(long)]
    stability: bool,
    /// Time-stepping scheme for --stability
    #[arg(long, value_parser = names::<SchemeName>(), default_value = SchemeName::default().name(), requires = "stability")]
    scheme: SchemeName,
    /// Newton iterations per step for --stability, at most 8 [default: 0]
    #[arg(long, value_name = "N", requires = "stability")]
    newton: Option<u32>,
    /// Spectral radius of generalized-alpha at infinite frequency, 0 to 0.8: the fraction of an unresolved
    /// vibration that remains per step [default: 0.5]
    #[arg(long, value_name = "RHO", allow_hyphen_values = true, requires = "stability")]
    rho: Option<f64>,
    /// Damping method for --stability [default: the scheme's own]
    #[arg(long, value_parser = names::<DampingName>(), requires = "stability")]
    damping: Option<DampingName>,
    /// Precision for --stability
    #[arg(long, value_parser = names::<PrecisionName>(), default_value = PrecisionName::default().name(), requires = "stability")]
    precision: PrecisionName,
}

pub(super) fn check_scene(
    catalogue: &Catalogue,
    arguments: &CheckArguments,
    console: &mut Console<'_>,
) -> Result<Exit, Error> {
    let method = Method::new(arguments.scheme, arguments.newton, arguments.precision)?;
    let method = damped(leaving(method, arguments.rho)?, arguments.damping)?;
    method.check_built()?;
    let picture_printed = arguments.svg.as_ref().is_some_and(|file| picture::is_output(file));
    if picture_printed && arguments.json {
        return Err(PictureError::Both.into());
    }
    let long_printed = arguments.write.as_ref().is_some_and(|file| write::is_output(file));
    if long_printed && (arguments.json || picture_printed) {
        return Err(WriteError::Both.into());
    }
    if arguments.watch {
        if picture_printed || long_printed {
            return Err(WatchError::Output.into());
        }
        return watch_scene(catalogue, arguments, &method, console);
    }
    once(catalogue, arguments, &method, arguments.overwrite, console).map(|_| Exit::Done)
}

/// Checks once; returns whether the output still has a reader.
fn once(
    catalogue: &Catalogue,
    arguments: &CheckArguments,
    method: &Method,
    overwrite: bool,
    console: &mut Console<'_>,
) -> Result<bool, Error> {
    let Found { scene, file, text } = load(catalogue, &arguments.scene)?;
    if let Some(target) = &arguments.write {
        let long = write::long_form(&scene, &text, &file.place, &arguments.scene.changes())?;
        if write::is_output(target) {
            return Ok(console.print_to_reader(&long)?);
        }
        write::write(target, &long, overwrite)?;
    }
    if let Some(file) = &arguments.svg {
        if picture::is_output(file) {
            return Ok(console.print_to_reader(&picture::picture(&scene, Paper::File))?);
        }
        picture::write(&scene, file)?;
    }
    let mut check = check(&scene);
    if arguments.stability {
        check.stability = Some(StabilityCheck::of(&scene, method)?);
    }
    let mut text = if arguments.json { json(&check) } else { check.text(console.look) };
    if !arguments.json {
        let written = arguments.svg.iter().chain(&arguments.write);
        written.for_each(|file| text += &format!("\nwritten  {}\n", file.display()));
    }
    Ok(console.print_to_reader(&text)?)
}

/// Checks now and at each change, until the output has no reader or the program is interrupted.
fn watch_scene(
    catalogue: &Catalogue,
    arguments: &CheckArguments,
    method: &Method,
    console: &mut Console<'_>,
) -> Result<Exit, Error> {
    let called = &arguments.scene.scene;
    let Some(file) = catalogue.file(called) else {
        // An unknown name is reported as in every command.
        if called != "-" {
            load(catalogue, &arguments.scene)?;
        }
        return Err(WatchError::NoFile { scene: called.clone() }.into());
    };
    if !file.exists() {
        load(catalogue, &arguments.scene)?;
    }
    let same = |target: &PathBuf| {
        let places = [target, &file].map(|path| path.canonicalize());
        matches!(places, [Ok(a), Ok(b)] if a == b)
    };
    if let Some(file) = arguments.write.as_ref().filter(|target| same(target)) {
        return Err(WatchError::Itself { file: file.clone() }.into());
    }
    let on_screen = console.terminal && std::io::stdout().is_terminal();
    let mut watched = Watched::new(&file);
    // The command may replace its own earlier output.
    let mut overwrite = arguments.overwrite;
    for number in 1_u64.. {
        watched.wait();
        if on_screen {
            console.print(CLEAR)?;
        }
        let said = match once(catalogue, arguments, method, overwrite, console) {
            Ok(true) => {
                overwrite = true;
                "OK"
            }
            Ok(false) => break,
            Err(error @ Error::Output(_)) => return Err(error),
            Err(error) => {
                console.report(&error);
                "refused"
            }
        };
        let _ = writeln!(console.err, "\ncheck {number} of {called}: {said}; waiting, Ctrl-C ends");
    }
    Ok(Exit::Done)
}
