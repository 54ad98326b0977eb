//! A run that the host begins and the target ends, and the other way round.
//!
//! `program relay: whole on the host, halves on both => equal hashes`. The snapshots travel as
//! files in `out`, written by one machine and read by the other.

use anyhow::{Context as _, Result, bail};

use crate::bits::host::Host;
use crate::command::root;
use crate::target::{Toolchain, firmware};

/// The program's parts, see there.
const WHOLE: &str = "0";
const BEGIN: &str = "1";
const END: &str = "2";

/// Takes all runs apart in both ways and compares.
///
/// # Errors
/// Where a hash differs or a program fails.
pub fn compare(toolchain: &Toolchain, host: &Host) -> Result<()> {
    let on_host = |part: &str| {
        let lines = host.released(&["relay", part])?;
        Ok::<_, anyhow::Error>(hashes(lines.iter().map(String::as_str)))
    };
    let on_target = |part: &str| {
        let lines = firmware::execute(toolchain, "relay", false, &[part.to_owned()])?;
        Ok::<_, anyhow::Error>(hashes(lines.iter().map(String::as_str)))
    };
    let folder = root().join("out");
    std::fs::create_dir_all(&folder).context("cannot make the folder out")?;
    let whole = on_host(WHOLE)?;
    if whole.is_empty() {
        bail!("the host ran nothing");
    }
    forget()?;
    on_host(BEGIN)?;
    let host_first = on_target(END)?;
    forget()?;
    on_target(BEGIN)?;
    let target_first = on_host(END)?;
    forget()?;
    for (way, halves) in [("host, then target", &host_first), ("target, then host", &target_first)]
    {
        if halves != &whole {
            let missing = whole.iter().find(|line| !halves.contains(line));
            let line = missing.map_or("a line too many", String::as_str);
            bail!("{way}: not the same as in one run: {line}");
        }
    }
    println!("\nequal in one run on the host and in halves on host and target, both ways:");
    for line in whole {
        println!("{line}");
    }
    Ok(())
}

/// Removes the snapshots, so that no machine takes its own for the other's.
fn forget() -> Result<()> {
    for entry in std::fs::read_dir(root().join("out"))? {
        let path = entry?.path();
        let name = path.file_name().and_then(|name| name.to_str());
        if name.is_some_and(|name| name.starts_with("relay-")) {
            std::fs::remove_file(&path)?;
        }
    }
    Ok(())
}

/// The lines `relay SCENE SCHEME PRECISION STEPS HASH`.
fn hashes<'l>(lines: impl Iterator<Item = &'l str>) -> Vec<String> {
    lines.filter(|line| line.starts_with("relay ")).map(str::to_owned).collect()
}
