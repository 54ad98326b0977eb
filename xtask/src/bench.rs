//! `cargo xtask bench`: times of steps and of ensembles on this machine, kept for the pages.
//!
//! `the program of dbd-bench, an example of dbd-ensemble => docs/results/{bench.json,ensembles.csv}`. Times are of a machine and a
//! minute; what is judged are ratios of times that were taken in turn. Run it while nothing else runs.

use anyhow::{Context as _, Result};
use serde_json::{Value, json};

use crate::command::{cargo, output, program, root, run as run_command, shown};

/// What the program said, and of which machine.
const BENCH: &str = "docs/results/bench.json";
const ENSEMBLES: &str = "docs/results/ensembles.csv";

/// The program.
const BENCH_PROGRAM: [&str; 4] = ["--package", "dbd-bench", "--features", "command"];

/// Measures both and writes the files; measures what the arguments name and writes nothing.
///
/// # Errors
/// Where building, measuring or writing fails.
pub fn run(arguments: &[String]) -> Result<()> {
    if !arguments.is_empty() {
        let mut command = cargo();
        command.args(["run", "--release", "--quiet"]).args(BENCH_PROGRAM).arg("--").args(arguments);
        return run_command(&mut command);
    }
    let of = machine()?;
    let said = measured(&[&BENCH_PROGRAM[..], &["--", "--json"]].concat())?;
    let bench: Value = serde_json::from_str(&said).context("the program printed no JSON")?;
    let text = serde_json::to_string_pretty(&json!({ "of": of, "bench": bench }))?;
    write(BENCH, &(text + "\n"))?;
    let said = measured(&["--package", "dbd-ensemble", "--example", "measure"])?;
    write(ENSEMBLES, &ensembles(&of, &said))?;
    crate::provenance::note(&[BENCH, ENSEMBLES])
}

/// What the release build of a program prints.
fn measured(arguments: &[&str]) -> Result<String> {
    let mut command = cargo();
    command.args(["run", "--release", "--quiet"]).args(arguments);
    println!("$ {}", shown(&command));
    output(&mut command)
}

/// Processor, cores and compiler.
fn machine() -> Result<String> {
    let known = std::fs::read_to_string("/proc/cpuinfo").unwrap_or_default();
    let model = known.lines().find_map(|line| line.strip_prefix("model name")?.split_once(": "));
    let model = model.map_or(std::env::consts::ARCH, |(_, model)| model);
    let cores = std::thread::available_parallelism().map_or(1, usize::from);
    let rustc = std::env::var_os("RUSTC").unwrap_or_else(|| "rustc".into());
    let compiler = output(program(rustc).arg("--version"))?;
    let compiler = compiler.split(" (").next().unwrap_or_default().trim();
    Ok(format!("{model}, {cores} cores, {compiler}"))
}

fn ensembles(of: &str, rows: &str) -> String {
    format!(
        "# Steps per second of an ensemble over those of its instances one after the other on one thread, taken in turn in one\n\
         # process: the median of the rounds' ratios, half the range of their middle half over it, the ratio of the fastest\n\
         # rounds, what two threads bring over one, and what they bring the instances by themselves; written by\n\
         # `cargo xtask bench`, {of}.\n{}\n",
        rows.trim_end()
    )
}

fn write(file: &str, text: &str) -> Result<()> {
    std::fs::write(root().join(file), text).with_context(|| format!("cannot write {file}"))?;
    println!("written: {file}");
    Ok(())
}
