//! The archive of `host-sim`: program, libraries, completions, manual pages.
//!
//! `program for an older Linux, libraries, module => host-sim-VERSION-x86_64-linux.tar.gz`; unpacked by a stranger it
//! runs a scene, writes an FMU, a scene and the page with all scenes for a web host.

use std::fs;
use std::path::Path;

use anyhow::{Context as _, Result, bail};

use crate::command::{output, program, root, run, target_dir};
use crate::libraries;
use crate::release::place::only;
use crate::release::stranger::{Stranger, hash_of};

const ENDING: &str = "-x86_64-linux.tar.gz";
const SHELLS: [(&str, &str); 3] =
    [("bash", "host-sim.bash"), ("zsh", "_host-sim"), ("fish", "host-sim.fish")];
const LICENSES: [&str; 2] = ["LICENSE-MIT", "LICENSE-APACHE"];
/// Beside the program, where it looks for them.
const LIBRARIES: [&str; 2] = ["libdbd_fmu.so", "dbd_fmu.dll"];
const MODULE: &str = "dbd_play.wasm";

/// Makes the archive from the libraries and the module that the steps before have built.
///
/// # Errors
/// Where the program does not build or a part is missing.
pub fn make(folder: &Path) -> Result<()> {
    let built = libraries::host_sim()?;
    let version = output(program(&built).arg("--version"))?;
    let version = version.split_whitespace().nth(1).context("host-sim has no version")?;
    let name = format!("host-sim-{version}");
    let content = folder.join(&name);
    fs::create_dir_all(content.join("completions"))?;
    let host_sim = content.join("host-sim");
    fs::copy(&built, &host_sim)?;
    let own = root().join("target/libraries");
    for library in LIBRARIES {
        fs::copy(own.join(library), content.join(library))
            .with_context(|| format!("target/libraries has no {library}"))?;
    }
    fs::copy(target_dir().join("play").join(MODULE), content.join(MODULE))
        .context("no module of live views")?;
    for license in LICENSES {
        fs::copy(root().join(license), content.join(license))?;
    }
    for (shell, file) in SHELLS {
        let script = output(program(&host_sim).args(["completions", shell]))?;
        fs::write(content.join("completions").join(file), script)?;
    }
    run(program(&host_sim).arg("manual").arg(content.join("man/man1")))?;
    let archive = folder.join(format!("{name}{ENDING}"));
    // The same contents give the same bytes.
    let same = ["--sort=name", "--owner=0", "--group=0", "--numeric-owner", "--mtime=@0"];
    run(program("tar").args(same).arg("-czf").arg(&archive).arg("-C").arg(folder).arg(&name))?;
    fs::remove_dir_all(&content).context("cannot remove what was packed")
}

/// Unpacks the archive in an empty folder and uses what it holds; the page of all scenes goes to `playground`.
///
/// # Errors
/// Where a command fails or writes nothing.
pub fn try_out(folder: &Path, playground: &Path, stranger: &Stranger) -> Result<()> {
    let archive = only(folder, ENDING)?;
    let place = stranger.work().join("archive");
    fs::create_dir_all(&place)?;
    run(stranger
        .command("tar")
        .arg("-xzf")
        .arg(&archive)
        .args(["--strip-components=1", "-C"])
        .arg(&place))?;
    let host_sim = |arguments: &[&str]| {
        let mut command = stranger.command(place.join("host-sim"));
        run(command.args(arguments).current_dir(&place))
    };
    host_sim(&["run", "four-bar", "--duration", "20ms", "--quiet"])?;
    host_sim(&["report", "out/four-bar", "--out", "four-bar.mcap"])?;
    host_sim(&["fmu", "cart-pendulum"])?;
    let page = playground.join("index.html");
    let page = page.to_str().context("the repository's path is not text")?;
    host_sim(&["play", "--all", "--no-open", "--out", page])?;
    host_sim(&["new", "scene", "my-crank"])?;
    host_sim(&["check", "my-crank.toml"])?;
    let written = ["out/four-bar/report.html", "four-bar.mcap", "cart-pendulum.fmu", page];
    for file in written.into_iter().chain(["man/man1/host-sim-run.1"]) {
        let size = fs::metadata(place.join(file)).map_or(0, |metadata| metadata.len());
        if size == 0 {
            bail!("{file} is missing");
        }
        println!("{file}: {size} bytes");
    }
    run(stranger.command("bash").arg("-n").arg(place.join("completions/host-sim.bash")))?;
    stranger.compare("the archive", &hash_of(&place.join("out/four-bar/summary.json"))?)
}
