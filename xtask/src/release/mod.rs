//! `cargo xtask release`: every artefact that users get, each used in an empty folder as a stranger would.
//!
//! `sources => target/artefacts/*, a table of sizes`. Nothing is published. The modules:
//!
//! - `place`: where artefacts lie.
//! - `stranger`: an empty folder and an environment without the repository.
//! - `registry`: the crates, and a folder of packages in place of the public registry.
//! - `archive`: the command line with its libraries, completions and manual pages.
//! - `wheel`: the Python package, from a local folder of wheels.

mod archive;
mod place;
mod registry;
mod stranger;
mod wheel;

use std::fs;
use std::path::Path;

use anyhow::Result;
use clap::ValueEnum;

use crate::libraries;
use crate::playground::{self, Speed};
use crate::release::place::{emptied, folder};
use crate::release::stranger::Stranger;
use crate::steps::Steps;

/// A part of a release.
#[derive(Clone, Copy, Debug, PartialEq, Eq, ValueEnum)]
pub enum Part {
    /// The crates of the registry, with `cargo install host-sim` and a new firmware project.
    Crates,
    /// The archive of host-sim with the libraries of FMUs and live views, and the playground's page.
    Archive,
    /// The wheel of Python.
    Wheel,
}

/// Makes the parts, or all, and uses each.
///
/// # Errors
/// Where an artefact is not made, or does not work away from the repository.
pub fn run(parts: &[Part]) -> Result<()> {
    let wanted = |part| parts.is_empty() || parts.contains(&part);
    let artefacts = folder("")?;
    let stranger = Stranger::new()?;
    let mut steps = Steps::default();
    if wanted(Part::Crates) {
        steps.step("crates: packages", || registry::make(&emptied("crates")?));
        steps.step("crates: cargo install host-sim", || registry::install(&stranger));
        steps.step("crates: a new firmware project", || registry::firmware(&stranger));
    }
    if wanted(Part::Archive) {
        steps.step("archive: libraries of FMUs", libraries::build);
        steps.step("archive: module of live views", || playground::module(Speed::Full).map(drop));
        steps.step("archive: host-sim", || archive::make(&emptied("archive")?));
        steps.step("archive: used", || {
            archive::try_out(&folder("archive")?, &emptied("playground")?, &stranger)
        });
    }
    if wanted(Part::Wheel) {
        steps.step("wheel: built", || wheel::make(&emptied("python")?));
        steps.step("wheel: used", || wheel::try_out(&folder("python")?, &stranger));
    }
    println!("\n{}", table(&artefacts)?);
    steps.finish()
}

/// Sizes of all artefacts, a line each.
fn table(artefacts: &Path) -> Result<String> {
    let mut lines = Vec::new();
    for part in ["crates", "archive", "playground", "python"] {
        let Ok(files) = fs::read_dir(artefacts.join(part)) else { continue };
        for file in files.filter_map(Result::ok).filter(|entry| entry.path().is_file()) {
            let size = file.metadata()?.len();
            lines.push(format!("{size:>10} bytes  {part}/{}", file.file_name().to_string_lossy()));
        }
    }
    lines.sort();
    Ok(lines.join("\n"))
}
