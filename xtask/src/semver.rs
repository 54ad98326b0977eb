//! Whether the crates' interfaces are compatible with those of another revision.
//!
//! `revision => what would break users`, by cargo-semver-checks, which is not part of the tests: it has
//! to be installed, and builds the documentation of both revisions.

use anyhow::{Result, bail};

use crate::command::{cargo, run, succeeds};
use crate::packages::published;

const TOOL: &str = "semver-checks";

/// Compares all libraries that are published with a revision of this repository.
///
/// # Errors
/// Where the tool is missing, or an interface has changed incompatibly for the crates' versions.
pub fn run_against(revision: &str) -> Result<()> {
    if !succeeds(cargo().args([TOOL, "--version"])) {
        bail!("`cargo {TOOL}` is missing: cargo install cargo-semver-checks --locked");
    }
    let mut command = cargo();
    command.args([TOOL, "--baseline-rev", revision, "--all-features"]);
    for (name, _) in published()? {
        command.args(["--package", &name]);
    }
    run(&mut command)
}
