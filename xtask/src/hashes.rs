//! The same bits on the target as on the host.
//!
//! `program hash on host (debug, release) and target => equal lines`.

use std::collections::BTreeMap;

use anyhow::{Result, bail};

use crate::command::{cargo, output};
use crate::firmware;
use crate::toolchain::Toolchain;

/// Steps per combination.
const STEPS: &str = "10000";
/// Million instructions of the whole program on the target without `--long`.
const INSTRUCTIONS: &str = "3000";
/// Million instructions that no run reaches.
const UNLIMITED: &str = "1000000000";

/// Runs the program everywhere and compares.
///
/// # Errors
/// Where a hash differs, a combination is missing, or a program fails.
pub fn compare(toolchain: &Toolchain, long: bool) -> Result<()> {
    let debug = on_host(&[])?;
    let release = on_host(&["--release"])?;
    let budget = if long { UNLIMITED } else { INSTRUCTIONS };
    let arguments = [STEPS.to_owned(), budget.to_owned()];
    let target = parse(&firmware::execute(toolchain, "hash", long, &arguments)?);
    if debug != release {
        bail!("the host's debug and release builds differ: {}", first_difference(&debug, &release));
    }
    let mut last = BTreeMap::new();
    for ((combination, steps), hash) in &target {
        if release.get(&(combination.clone(), *steps)) != Some(hash) {
            bail!("the target differs: {}", first_difference(&release, &target));
        }
        last.insert(combination, (*steps, hash));
    }
    for (combination, _) in release.keys() {
        if !last.contains_key(combination) {
            bail!("the target did not step {combination}");
        }
    }
    println!("\nequal on host debug, host release and target:");
    for (combination, (steps, hash)) in last {
        println!("{combination:<32} {steps:>8} steps  {hash}");
    }
    Ok(())
}

/// Hashes by combination and number of steps.
type Hashes = BTreeMap<(String, u64), String>;

fn on_host(arguments: &[&str]) -> Result<Hashes> {
    let text = output(
        cargo()
            .args(["run", "--quiet", "--package", "firmware", "--bin", "hash"])
            .args(arguments)
            .args(["--", STEPS]),
    )?;
    let lines: Vec<String> = text.lines().map(str::to_owned).collect();
    Ok(parse(&lines))
}

/// Reads lines `hash SCENE SCHEME PRECISION STEPS HASH`.
fn parse(lines: &[String]) -> Hashes {
    let mut hashes = Hashes::new();
    for line in lines {
        let words: Vec<&str> = line.split_whitespace().collect();
        if let ["hash", scene, scheme, precision, steps, hash] = words[..]
            && let Ok(steps) = steps.parse()
        {
            let combination = format!("{scene} {scheme} {precision}");
            hashes.insert((combination, steps), hash.to_owned());
        }
    }
    hashes
}

fn first_difference(expected: &Hashes, found: &Hashes) -> String {
    for (key, hash) in found {
        if expected.get(key) != Some(hash) {
            let expected = expected.get(key).map_or("nothing", String::as_str);
            return format!("{} after {} steps: {hash} for {expected}", key.0, key.1);
        }
    }
    "a line is missing".to_owned()
}

#[cfg(test)]
mod tests {
    use super::*;

    fn hashes(lines: &[&str]) -> Hashes {
        parse(&lines.iter().map(|&line| line.to_owned()).collect::<Vec<_>>())
    }

    #[test]
    fn the_first_difference_is_named() {
        let host = hashes(&["hash a dbd f32 1 00", "hash a dbd f32 2 01", "other line"]);
        let target = hashes(&["hash a dbd f32 1 00", "hash a dbd f32 2 02"]);
        assert_eq!(host.len(), 2);
        assert_eq!(first_difference(&host, &target), "a dbd f32 after 2 steps: 02 for 01");
    }
}
