//! `host-sim modes` on the command line.

use std::path::PathBuf;

use clap::{Args, ValueHint};

use crate::arguments::SceneArgument;
use crate::cli::named::load;
use crate::commands::folder::Destination;
use crate::commands::mode_table::{ModeOptions, find};
use crate::error::Error;
use crate::terminal::text::json;
use crate::terminal::{Catalogue, Console, Exit};

#[derive(Debug, Args)]
pub(super) struct ModesArguments {
    #[command(flatten)]
    pub(super) scene: SceneArgument,
    /// Number of modes, lowest first
    #[arg(long, value_name = "N", default_value_t = 10, value_parser = clap::value_parser!(u16).range(1..))]
    count: u16,
    /// Linearise about the static equilibrium under the loads, not the pose at t = 0
    #[arg(long)]
    relax: bool,
    /// Also find a frequency by the paper's procedure: lengthen springs of a joint, run, transform
    /// [default joint: that of the fastest mode]
    #[arg(long, value_name = "JOINT", num_args = 0..=1, require_equals = true, default_missing_value = "")]
    kick: Option<String>,
    /// Print JSON
    #[arg(long)]
    json: bool,
    /// Write DIR/SCENE/modes.{csv,json,html} and the matrices as mass.mtx, stiffness.mtx, damping.mtx
    #[arg(long, value_name = "DIR", value_hint = ValueHint::DirPath)]
    out: Option<PathBuf>,
    /// Overwrite results of another scene whose file has the same name
    #[arg(long, requires = "out")]
    overwrite: bool,
}

pub(super) fn modes_of_scene(
    catalogue: &Catalogue,
    arguments: &ModesArguments,
    console: &mut Console<'_>,
) -> Result<Exit, Error> {
    let found = load(catalogue, &arguments.scene)?;
    let options = ModeOptions {
        count: usize::from(arguments.count),
        relax: arguments.relax,
        kick: arguments.kick.clone(),
    };
    let modes = find(&found.scene, &options)?;
    let mut text = if arguments.json { json(&modes.table) } else { modes.table.text(console.look) };
    if let Some(out) = &arguments.out {
        let (out, overwrite) = (out.clone(), arguments.overwrite);
        let folder = modes.write(&Destination { out, file: found.file, overwrite })?;
        if !arguments.json {
            text += &format!("\nwritten  {}\n", folder.display());
        }
    }
    console.print(&text)?;
    Ok(Exit::Done)
}
