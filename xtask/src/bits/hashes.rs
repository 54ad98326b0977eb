//! The same bits on the target as on the host.
//!
//! `program hash on host (as tested; in the long tests as released, too) and target, golden table => equal hashes`. The golden
//! table holds hashes of the run-time-sized models of the same scenes at the scenes' steps.

use std::collections::BTreeMap;

use anyhow::{Context as _, Result, bail};

use crate::bits::host::Host;
use crate::chip::{Toolchain, firmware};
use crate::command::root;

/// Steps per combination.
const STEPS: &str = "10000";
/// Steps of those in fixed point that are stepped at length.
const LONG_STEPS: &str = "1000000";
/// Million instructions of the whole program on the target without `--long`.
const INSTRUCTIONS: &str = "3000";
/// Million instructions that no run reaches.
const UNLIMITED: &str = "1000000000";

/// Rows `scene,scheme,precision,step,steps,hash`.
pub const GOLDEN: &str = "tests/bits/hashes.csv";
/// The same of damping joint by joint.
const JOINT_WISE: &str = "tests/bits/joint-wise.csv";
/// The same of fixed point.
pub const FIXED: &str = "tests/bits/fixed.csv";
/// The same of scenes with laws.
const LAWS: &str = "tests/bits/laws.csv";

/// Runs the program everywhere and compares; at length also many more steps in fixed point.
///
/// # Errors
/// Where a hash differs, a combination is missing, or a program fails.
pub fn compare(toolchain: &Toolchain, host: &Host, long: bool) -> Result<()> {
    let budget = if long { UNLIMITED } else { INSTRUCTIONS };
    compare_of(toolchain, host, long, &[STEPS, budget])?;
    if long { compare_of(toolchain, host, long, &[LONG_STEPS, UNLIMITED, "fixed"]) } else { Ok(()) }
}

fn compare_of(toolchain: &Toolchain, host: &Host, long: bool, limits: &[&str]) -> Result<()> {
    let arguments = [&["hash"], limits].concat();
    let checked = parse(&host.checked(&arguments)?);
    let released = host.released(&arguments)?.map(|lines| parse(&lines));
    let arguments: Vec<String> = limits.iter().map(|&limit| limit.to_owned()).collect();
    let target = parse(&firmware::execute(toolchain, "hash", long, &arguments)?);
    if let Some(released) = released.as_ref().filter(|released| **released != checked) {
        let difference = first_difference(&checked, released);
        bail!("the host's programs as tested and as released differ: {difference}");
    }
    // The target may do fewer steps, so it is the one that is looked up.
    if target.iter().any(|(key, hash)| checked.get(key) != Some(hash)) {
        bail!("the target differs: {}", first_difference(&checked, &target));
    }
    let last: BTreeMap<_, _> =
        target.iter().map(|((combination, steps), hash)| (combination, (steps, hash))).collect();
    if let Some((combination, _)) = checked.keys().find(|(name, _)| !last.contains_key(name)) {
        bail!("the target did not step {combination}");
    }
    let golden = golden()?;
    let mut blessed = 0;
    for (key, hash) in &golden {
        match checked.get(key) {
            Some(found) if found != hash => {
                bail!(
                    "{} after {} steps: {found}, but {GOLDEN} or {FIXED} has {hash}",
                    key.0,
                    key.1
                )
            }
            Some(_) => blessed += 1,
            None => {}
        }
    }
    if blessed == 0 {
        bail!("{GOLDEN} has no hash of a shipped scene at a printed number of steps");
    }
    let release = if released.is_some() { ", host as released" } else { "" };
    println!("\nequal on host{release} and target; {blessed} of them in {GOLDEN}:");
    for (combination, (steps, hash)) in last {
        println!("{combination:<32} {steps:>8} steps  {hash}");
    }
    Ok(())
}

/// Steps scenes that have every law together on the target: the same bits as in the table of the host's tests.
///
/// # Errors
/// Where a hash differs or is missing, or the program fails.
pub fn compare_laws(toolchain: &Toolchain) -> Result<()> {
    let target = parse(&firmware::execute(toolchain, firmware::LAWS, false, &[])?);
    let combinations = ended_as(&target, &read(&[LAWS])?)?;
    println!("\n{combinations} combinations have on the target the hashes of {LAWS}");
    Ok(())
}

/// Compares the last hash of each combination, at least one, with the golden one; returns their number.
fn ended_as(target: &Hashes, golden: &Hashes) -> Result<usize> {
    let last: BTreeMap<_, _> =
        target.iter().map(|((name, steps), hash)| (name, (*steps, hash))).collect();
    for (name, (steps, found)) in &last {
        match golden.get(&((*name).clone(), *steps)) {
            Some(hash) if hash == *found => {}
            Some(hash) => bail!("{name} after {steps} steps: {found}, but {LAWS} has {hash}"),
            None => bail!("{LAWS} has no hash of {name} after {steps} steps"),
        }
    }
    if last.is_empty() {
        bail!("the target stepped no scene with laws");
    }
    Ok(last.len())
}

/// The golden tables.
///
/// # Errors
/// Where it cannot be read.
pub fn golden() -> Result<Hashes> {
    read(&[GOLDEN, JOINT_WISE, FIXED])
}

fn read(tables: &[&str]) -> Result<Hashes> {
    let mut golden = Hashes::new();
    for file in tables {
        let text = std::fs::read_to_string(root().join(file));
        for line in text.with_context(|| format!("cannot read {file}"))?.lines().skip(1) {
            let columns: Vec<&str> = line.split(',').collect();
            if let [scene, scheme, precision, _step, steps, hash] = columns[..]
                && let Ok(steps) = steps.parse()
            {
                golden.insert((format!("{scene} {scheme} {precision}"), steps), hash.to_owned());
            }
        }
    }
    Ok(golden)
}

/// Hashes by combination and number of steps.
pub type Hashes = BTreeMap<(String, u64), String>;

/// Reads lines `hash SCENE SCHEME PRECISION STEPS HASH`.
pub fn parse(lines: &[String]) -> Hashes {
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
    #[test]
    fn a_run_must_end_as_the_golden_table_says() {
        let golden = hashes(&["hash a leapfrog f32 100 00", "hash b leapfrog f32 100 01"]);
        let one = ["hash a leapfrog f32 50 07", "hash a leapfrog f32 100 00"];
        assert_eq!(ended_as(&hashes(&one), &golden).unwrap(), 1);
        for (wrong, says) in [
            (&["hash b leapfrog f32 100 02"][..], "b leapfrog f32 after 100 steps: 02, but"),
            (&one[..1], "no hash of a leapfrog f32 after 50 steps"),
            (&[], "no scene with laws"),
        ] {
            let why = ended_as(&hashes(wrong), &golden).unwrap_err().to_string();
            assert!(why.contains(says), "{why}");
        }
    }
}
