//! `host-sim manual`: the manual pages, one per command.
//!
//! `(command line, folder) => host-sim.1, host-sim-run.1, …` for `man`.

use std::io;
use std::path::{Path, PathBuf};

use clap::Command;
use clap_mangen::generate_to;
use miette::Diagnostic;
use thiserror::Error;

/// The manual pages could not be written.
#[derive(Debug, Error, Diagnostic)]
#[error("cannot write manual pages to {}: {reason}", folder.display())]
#[diagnostic(help("choose a folder that can be written, with `host-sim manual FOLDER`"))]
pub struct ManualError {
    /// The folder.
    folder: PathBuf,
    /// The reason; part of the message and therefore not a source, which would repeat it.
    reason: io::Error,
}

/// Writes the pages of a command line and all its commands into a folder, which is created.
///
/// # Errors
/// [`ManualError`] if the folder or a page cannot be written.
pub fn write(command: &Command, folder: &Path) -> Result<(), ManualError> {
    let written =
        std::fs::create_dir_all(folder).and_then(|()| generate_to(plain(command), folder));
    written.map_err(|reason| ManualError { folder: folder.to_owned(), reason })
}

/// The commands with examples that have no colours, line by line.
fn plain(command: &Command) -> Command {
    let mut plain = command.clone();
    if let Some(examples) = command.get_after_help() {
        // An empty line is a new paragraph; `man` would fill others.
        plain = plain.after_help(examples.to_string().trim_end().replace('\n', "\n\n"));
    }
    for below in command.get_subcommands() {
        plain = plain.mut_subcommand(below.get_name(), |_| self::plain(below));
    }
    plain
}
