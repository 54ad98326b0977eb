//! `host-sim play` on the command line.

use std::path::PathBuf;

use clap::{Args, ValueHint};
use dbd_plant::instance::Settings;
use dbd_plant::time::Time;
use dbd_plant::{DampingName, Named as _, PrecisionName, SchemeName};

use crate::arguments::names;
use crate::commands::play::{Asked, PlayError, made, module, page, serve, written};
use crate::error::Error;
use crate::terminal::{Catalogue, Console, Exit};

#[derive(Debug, Args)]
pub(super) struct PlayArguments {
    /// Scenes by name (see list), paths to .toml files, or - for standard input; several are offered in a menu
    #[arg(value_hint = ValueHint::FilePath, required_unless_present = "all")]
    pub(super) scenes: Vec<String>,
    /// Include all named scenes
    #[arg(long, conflicts_with = "scenes")]
    all: bool,
    /// Set one number of the first scene by its path, in SI units; may be repeated: body.cart.mass=1.2
    #[arg(long = "set", value_name = "PATH=VALUE")]
    set: Vec<String>,
    /// Time-stepping scheme
    #[arg(long, value_parser = names::<SchemeName>(), default_value = SchemeName::default().name())]
    scheme: SchemeName,
    /// Newton iterations, for dbd, dbd-p1 and dbd-p2
    #[arg(long, value_name = "N")]
    newton: Option<u32>,
    /// Spectral radius of generalized-alpha at infinite frequency
    #[arg(long, value_name = "FRACTION")]
    rho: Option<f64>,
    /// Damping method [default: the scheme's own]
    #[arg(long, value_parser = names::<DampingName>())]
    damping: Option<DampingName>,
    /// Precision of all arithmetic in a step
    #[arg(long, value_parser = names::<PrecisionName>(), default_value = PrecisionName::default().name())]
    precision: PrecisionName,
    /// Step, e.g. 50us [default: that of run]
    #[arg(long, value_name = "TIME", allow_hyphen_values = true)]
    step: Option<Time>,
    /// Ratio of simulated to real time, e.g. 0.1 [default: the scene's duration takes 7 s]
    #[arg(long, value_name = "FACTOR", allow_hyphen_values = true)]
    speed: Option<f64>,
    /// Write the page to this file [default: out/SCENE/play.html, out/play.html for several scenes]
    #[arg(long, value_name = "FILE", value_hint = ValueHint::FilePath)]
    out: Option<PathBuf>,
    /// Serve the page on 127.0.0.1 and reload the scene when its file changes; stop with Ctrl-C
    #[arg(long, conflicts_with_all = ["out", "all"])]
    serve: bool,
    /// Port for --serve [default: a free one]
    #[arg(long, value_name = "PORT", requires = "serve")]
    port: Option<u16>,
    /// Do not open the page in a browser
    #[arg(long)]
    no_open: bool,
    /// The kernel in WebAssembly [default: dbd_play.wasm beside this program]
    #[arg(long, value_name = "FILE", value_hint = ValueHint::FilePath)]
    module: Option<PathBuf>,
}

impl PlayArguments {
    fn settings(&self) -> Settings {
        Settings {
            scheme: Some(self.scheme.name().into()),
            newton: self.newton,
            rho: self.rho,
            damping: self.damping.map(|damping| damping.name().into()),
            precision: Some(self.precision.name().into()),
            step: self.step.map(Time::seconds),
        }
    }
}

pub(super) fn play_scenes(
    catalogue: &Catalogue,
    arguments: &PlayArguments,
    console: &mut Console<'_>,
) -> Result<Exit, Error> {
    if let Some(speed) = arguments.speed.filter(|speed| !(speed.is_finite() && *speed > 0.0)) {
        return Err(PlayError::Speed(speed).into());
    }
    let called = match arguments.all {
        true => catalogue.names(),
        false => arguments.scenes.clone(),
    };
    let mut scenes = Vec::new();
    for (row, name) in called.iter().enumerate() {
        let changes = if row == 0 { arguments.set.as_slice() } else { &[] };
        scenes.push(catalogue.load_with(name, changes)?);
    }
    let asked = Asked {
        scenes,
        changes: &arguments.set,
        settings: arguments.settings(),
        speed: arguments.speed,
    };
    // Errors in the scene are reported before errors of the environment.
    let begun = page(asked)?;
    let module = module(arguments.module.as_deref())?;
    let opens = console.terminal && !arguments.no_open;
    if arguments.serve {
        let file =
            catalogue.file(&called[0]).ok_or_else(|| PlayError::NoFile(called[0].clone()))?;
        serve(begun, &module, &file, arguments.port, &mut |url| {
            // The page is written even if nobody reads the output.
            let _ = console.print(&format!("{url}\n"));
            open(opens, url, console);
        })?;
        return Ok(Exit::Done);
    }
    let html = made(&begun, &module)?;
    let file = written(&html, arguments.out.as_deref(), &begun)?;
    console.print(&format!("{}\n", file.display()))?;
    open(opens, &file.display().to_string(), console);
    Ok(Exit::Done)
}

/// Opens a page in the user's browser; without a browser, prints the location of the page.
fn open(wanted: bool, page: &str, console: &mut Console<'_>) {
    if wanted && open::that_detached(page).is_err() {
        console.note("no browser found: open the page manually");
    }
}
