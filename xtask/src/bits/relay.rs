//! Runs that start on the host and end on the target, and vice versa.
//!
//! `program relay: whole on the host, halves on both => equal hashes`. The snapshots travel as
//! files in `out`, written by one machine and read by the other.

use anyhow::{Context as _, Result, bail};

use crate::bits::host::Host;
use crate::chip::{Toolchain, firmware};
use crate::command::root;

/// The program's parts, see there.
const WHOLE: &str = "0";
const BEGIN: &str = "1";
const END: &str = "2";

/// Splits all runs in both directions and compares.
///
/// # Errors
/// Where a hash differs or a program fails.
pub fn compare(toolchain: &Toolchain, host: &Host) -> Result<()> {
    let on_host = |arguments: &[&str]| host.checked(arguments);
    let on_target = |arguments: &[&str]| {
        let [program, parts @ ..] = arguments else { bail!("no program given") };
        let parts: Vec<String> = parts.iter().map(|part| (*part).to_owned()).collect();
        firmware::execute(toolchain, program, false, &parts)
    };
    compare_machines(("host", on_host), ("target", on_target)).map(drop)
}

/// The same for any two machines, each a name and what prints a program's lines; the number of runs.
///
/// # Errors
/// Where a hash differs or a program fails.
pub fn compare_machines(
    (host, on_host): (&str, impl Fn(&[&str]) -> Result<Vec<String>>),
    (target, on_target): (&str, impl Fn(&[&str]) -> Result<Vec<String>>),
) -> Result<usize> {
    let on_host = |part| on_host(&["relay", part]).map(hashes);
    let on_target = |part| on_target(&["relay", part]).map(hashes);
    let folder = root().join("out");
    std::fs::create_dir_all(&folder).context("cannot make the folder out")?;
    let whole = on_host(WHOLE)?;
    if whole.is_empty() {
        bail!("the host printed no runs");
    }
    forget()?;
    on_host(BEGIN)?;
    let host_first = on_target(END)?;
    forget()?;
    on_target(BEGIN)?;
    let target_first = on_host(END)?;
    forget()?;
    for (first, then, halves) in [(host, target, &host_first), (target, host, &target_first)] {
        if halves != &whole {
            let missing = whole.iter().find(|line| !halves.contains(line));
            let line = missing.map_or("an extra line", String::as_str);
            bail!("{first}, then {then}: differs from a single run: {line}");
        }
    }
    println!("\nequal in one run on the {host} and in halves on {host} and {target}, both ways:");
    for line in &whole {
        println!("{line}");
    }
    Ok(whole.len())
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
fn hashes(lines: Vec<String>) -> Vec<String> {
    lines.into_iter().filter(|line| line.starts_with("relay ")).collect()
}
