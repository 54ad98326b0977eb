//! `host-sim relax` on the command line.

use std::path::PathBuf;

use clap::{Args, ValueHint};

use crate::arguments::SceneArgument;
use crate::cli::named::load;
use crate::commands::relax::{RelaxError, relax, text_at_rest};
use crate::commands::write;
use crate::error::Error;
use crate::terminal::text::json;
use crate::terminal::{Catalogue, Console, Exit};

#[derive(Debug, Args)]
pub(super) struct RelaxArguments {
    #[command(flatten)]
    pub(super) scene: SceneArgument,
    /// Print JSON
    #[arg(long)]
    json: bool,
    /// Write the scene at equilibrium in its long form; - for standard output,
    /// instead of the table
    #[arg(long, value_name = "FILE", value_hint = ValueHint::FilePath)]
    out: Option<PathBuf>,
    /// Overwrite an existing file
    #[arg(long, requires = "out")]
    overwrite: bool,
}

pub(super) fn relax_scene(
    catalogue: &Catalogue,
    arguments: &RelaxArguments,
    console: &mut Console<'_>,
) -> Result<Exit, Error> {
    let is_printed = arguments.out.as_ref().is_some_and(|file| write::is_output(file));
    if is_printed && arguments.json {
        return Err(RelaxError::Both.into());
    }
    let found = load(catalogue, &arguments.scene.unsettled())?;
    let (rest, relaxed) = relax(&found.scene).map_err(RelaxError::from)?;
    if let Some(file) = &arguments.out {
        let text = text_at_rest(&rest, &found.file.place).map_err(RelaxError::from)?;
        if is_printed {
            console.print(&text)?;
            return Ok(Exit::Done);
        }
        write::write(file, &text, arguments.overwrite).map_err(RelaxError::from)?;
    }
    let mut text = if arguments.json { json(&relaxed) } else { relaxed.text(console.look) };
    if let Some(file) = arguments.out.as_ref().filter(|_| !arguments.json) {
        text += &format!("\nwritten  {}\n", file.display());
    }
    console.print(&text)?;
    Ok(Exit::Done)
}
