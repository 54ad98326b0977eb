//! `host-sim linearise` on the command line.

use crate::cli::named::load;
use crate::commands::linearise::{LineariseArguments, linearise};
use crate::error::Error;
use crate::terminal::{Catalogue, Console, Exit};

pub(super) fn linearise_scene(
    catalogue: &Catalogue,
    arguments: &LineariseArguments,
    console: &mut Console<'_>,
) -> Result<Exit, Error> {
    let report = linearise(&load(catalogue, &arguments.scene)?, arguments)?;
    let text = match &arguments.out {
        Some(file) => format!("written  {}\n", file.display()),
        None => report.text(console.look),
    };
    console.print(&text)?;
    Ok(Exit::Done)
}
