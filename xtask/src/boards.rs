//! `cargo xtask boards`: the programs of a chip with its community's HAL, in QEMU.
//!
//! `firmware/stm32f405, golden bits => hashes, overruns, verdict`. The folder is a workspace of its own and is built
//! into the directory and with the profile of the firmware, so that `core` and what else they share is built once.

use std::collections::BTreeMap;
use std::path::PathBuf;
use std::process::Command;
use std::slice;
use std::time::Duration;

use anyhow::{Context as _, Result, bail};

use crate::bits::hashes::{self, Hashes};
use crate::chip::{Toolchain, firmware, serial, setup};
use crate::command::{cargo, root, run as run_command};

/// The workspace. Its own configuration says how cargo runs an image.
const FOLDER: &str = "firmware/stm32f405";
/// Its programs; each but the first has a feature of its name.
pub const PROGRAMS: [&str; 3] = [PLAIN, "rtic", "embassy"];
/// The program that needs the HAL alone.
pub const PLAIN: &str = "plain";
/// What changes the clock to that of a board with a crystal. It is built only: QEMU has no such clock.
const OTHER_CLOCK: &str = "pll";
/// Real time for a program: many times what it takes.
const TIME_LIMIT: Duration = Duration::from_secs(120);

/// What a program must step: scene, scheme and precision, number of steps.
const STEPPED: [(&str, u64); 2] =
    [("four-bar leapfrog f32", 10_000), ("cart-pendulum leapfrog f32", 1_000)];

/// `cargo xtask boards [NAME…]`: programs of these names, all of them and the other clock where none is named.
///
/// # Errors
/// Where there is no such program, it does not build, or it does not do what it must.
pub fn run(names: &[String]) -> Result<()> {
    let toolchain = setup::complete()?;
    if names.is_empty() {
        check_format()?;
        let features: Vec<&str> = features(&PROGRAMS).chain([OTHER_CLOCK]).collect();
        run_command(&mut build(&toolchain, &PROGRAMS, &features)?)?;
        return execute(&toolchain, &PROGRAMS);
    }
    let names: Vec<&str> = names.iter().map(String::as_str).collect();
    execute(&toolchain, &names)
}

/// Checks the formatting of the sources, whose workspace the main check does not include.
///
/// # Errors
/// Where they are not.
pub fn check_format() -> Result<()> {
    run_command(cargo().args(["fmt", "--check"]).current_dir(root().join(FOLDER)))
}

/// Builds programs together and runs them one after the other.
///
/// # Errors
/// Where there is no such program, or one does not build or not do what it must.
pub fn execute(toolchain: &Toolchain, programs: &[&str]) -> Result<()> {
    let features: Vec<&str> = features(programs).collect();
    run_command(&mut build(toolchain, programs, &features)?)?;
    let golden = hashes::golden()?;
    for program in programs {
        println!("{program}:");
        // The features of all, lest it be built anew.
        let mut command = cargo_in(toolchain, "run", &[program], &features);
        let lines = serial::run(command.arg("--quiet"), TIME_LIMIT);
        let lines = lines.with_context(|| format!("{FOLDER}, {program}"))?;
        check(&lines, &golden).with_context(|| format!("{FOLDER}, {program}"))?;
    }
    Ok(())
}

/// The image of a program that others run, built.
///
/// # Errors
/// Where it does not build.
pub fn image(toolchain: &Toolchain, name: &str) -> Result<PathBuf> {
    run_command(&mut cargo_in(toolchain, "build", &[name], &[]))?;
    Ok(toolchain.images(firmware::PROFILE).join(name))
}

/// What builds these programs together.
fn features<'p>(programs: &[&'p str]) -> impl Iterator<Item = &'p str> {
    programs.iter().copied().filter(|name| *name != PLAIN)
}

fn build(toolchain: &Toolchain, programs: &[&str], features: &[&str]) -> Result<Command> {
    if let Some(name) = programs.iter().find(|name| !PROGRAMS.contains(name)) {
        bail!("unknown program `{name}` in {FOLDER}; known programs: {}", PROGRAMS.join(", "));
    }
    Ok(cargo_in(toolchain, "build", programs, features))
}

/// A cargo command for these programs, in their workspace.
fn cargo_in(
    toolchain: &Toolchain,
    subcommand: &str,
    programs: &[&str],
    features: &[&str],
) -> Command {
    let mut command = toolchain.cargo(subcommand, firmware::LIBRARIES);
    command.current_dir(root().join(FOLDER)).env("CARGO_TARGET_DIR", toolchain.target_dir());
    command.args(["--locked", "--profile", firmware::PROFILE]);
    for program in programs {
        command.args(["--bin", program]);
    }
    if !features.is_empty() {
        command.args(["--features", &features.join(",")]);
    }
    command
}

/// How a run kept its pace.
#[derive(Clone, Copy)]
struct Pace {
    steps_per_tick: u64,
    overruns: u64,
}

/// Whether a program's hashes are the golden ones and its overruns those that must be: none but in the last run, which
/// asks for more than the chip can do.
fn check(lines: &[String], golden: &Hashes) -> Result<()> {
    // Every line, for the last run steps the same scene as the one before.
    let found: Vec<Hashes> =
        lines.iter().map(|line| hashes::parse(slice::from_ref(line))).collect();
    for (key, hash) in found.iter().flatten() {
        match golden.get(key) {
            Some(expected) if expected == hash => {}
            Some(expected) => {
                bail!("{} after {} steps: {hash}, but {} has {expected}", key.0, key.1, {
                    hashes::GOLDEN
                })
            }
            None => bail!("{} has no hash of {} after {} steps", hashes::GOLDEN, key.0, key.1),
        }
    }
    let found: BTreeMap<_, _> = found.into_iter().flatten().collect();
    for (combination, steps) in STEPPED {
        if !found.contains_key(&(combination.to_owned(), steps)) {
            bail!("it printed no hash of {combination} after {steps} steps");
        }
    }
    let paces: Vec<Pace> = lines.iter().filter_map(|line| pace(line)).collect();
    let Some((forced, kept)) = paces.split_last().filter(|(_, kept)| kept.len() >= STEPPED.len())
    else {
        bail!("it printed {} pace lines", paces.len());
    };
    if let Some(pace) = kept.iter().find(|pace| pace.overruns > 0) {
        bail!("{} overruns with {} steps per tick", pace.overruns, pace.steps_per_tick);
    }
    if forced.overruns == 0 {
        bail!("no overrun was counted with {} steps per tick", forced.steps_per_tick);
    }
    Ok(())
}

/// Reads `pace SCENE RATE ticks/s, STEPS steps each, OVERRUNS overruns`.
fn pace(line: &str) -> Option<Pace> {
    match line.split_whitespace().collect::<Vec<_>>()[..] {
        ["pace", _, _, "ticks/s,", steps, "steps", "each,", overruns, "overruns"] => {
            Some(Pace { steps_per_tick: steps.parse().ok()?, overruns: overruns.parse().ok()? })
        }
        _ => None,
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    const WELL: [&str; 6] = [
        "hash four-bar leapfrog f32 10000 0a",
        "pace four-bar 400 ticks/s, 5 steps each, 0 overruns",
        "hash cart-pendulum leapfrog f32 1000 0b",
        "pace cart-pendulum 400 ticks/s, 1 steps each, 0 overruns",
        "hash cart-pendulum leapfrog f32 1000 0b",
        "pace cart-pendulum 400 ticks/s, 16 steps each, 62 overruns",
    ];

    fn judged(change: impl FnOnce(&mut Vec<String>)) -> String {
        let mut lines = WELL.map(str::to_owned).to_vec();
        let golden = hashes::parse(&lines);
        change(&mut lines);
        check(&lines, &golden).err().map(|error| error.to_string()).unwrap_or_default()
    }

    #[test]
    fn a_program_that_does_what_it_must_is_accepted() {
        assert_eq!(judged(|_| {}), "");
    }

    #[test]
    fn another_hash_is_not() {
        // Of either run of the scene.
        for line in [2, 4] {
            let found = judged(|lines| lines[line] = WELL[2].replace("0b", "0c"));
            assert!(found.contains("1000 steps: 0c, but") && found.ends_with("has 0b"), "{found}");
        }
        let found = judged(|lines| lines[0] = WELL[0].replace("10000", "9999"));
        assert!(found.contains("no hash of four-bar"), "{found}");
    }

    #[test]
    fn a_missing_line_is_not() {
        let found = judged(|lines| drop(lines.remove(0)));
        assert!(found.contains("no hash of four-bar leapfrog f32 after 10000"), "{found}");
        let found = judged(|lines| drop(lines.pop()));
        assert_eq!(found, "it printed 2 pace lines");
    }

    #[test]
    fn an_overrun_is_not_where_there_must_be_none_nor_none_where_there_must_be() {
        let found = judged(|lines| lines[1] = WELL[1].replace(" 0 ", " 3 "));
        assert_eq!(found, "3 overruns with 5 steps per tick");
        let found = judged(|lines| lines[5] = WELL[5].replace("62", "0"));
        assert_eq!(found, "no overrun was counted with 16 steps per tick");
    }
}
