//! `cargo xtask bench`: times of steps and of ensembles on this machine, kept for the pages.
//!
//! `host-sim bench, examples of dbd-ensemble => docs/results/{bench.json,ensembles.csv,large.csv}`. Times are of a machine
//! and a minute; what is judged are ratios of times that were taken in turn. Run it while nothing else runs. Beside the
//! times of a large model stand its instructions, counted by callgrind, where that knows the instruction set.

use anyhow::{Context as _, Result};
use serde_json::{Value, json};

use crate::built::build;
use crate::callgrind;
use crate::command::{cargo, output, program, root, shown};
use crate::target::setup;

/// What `host-sim bench` said, and of which machine.
const BENCH: &str = "docs/results/bench.json";
const ENSEMBLES: &str = "docs/results/ensembles.csv";
const LARGE: &str = "docs/results/large.csv";

/// Steps of a large model that are counted: a block of those that lanes make between two looks.
const COUNTED: &str = "64";
/// The function that is counted, and the one instruction set that callgrind does not know.
const FUNCTION: &str = "*counted_steps*";
const UNKNOWN: &str = "avx512";

/// Measures both and writes the files.
///
/// # Errors
/// Where building, measuring or writing fails.
pub fn run() -> Result<()> {
    let of = machine()?;
    let said = measured(&["--package", "host-sim", "--", "bench", "--json"])?;
    let bench: Value = serde_json::from_str(&said).context("`host-sim bench` said no JSON")?;
    let text = serde_json::to_string_pretty(&json!({ "of": of, "bench": bench }))?;
    write(BENCH, &(text + "\n"))?;
    let said = measured(&["--package", "dbd-ensemble", "--example", "measure"])?;
    write(ENSEMBLES, &ensembles(&of, &said))?;
    large()
}

/// Measures and counts large models alone and writes their file.
///
/// # Errors
/// As [`run`], and where valgrind is missing.
pub fn large() -> Result<()> {
    setup::counter()?;
    let machine = machine()?;
    let arguments = ["--package", "dbd-ensemble", "--example", "measure_large"];
    let built = build(cargo().args(["build", "--release"]).args(arguments))?;
    let program = built.iter().find(|program| program.name == "ensemble::measure_large");
    let program = &program.context("`measure_large` was not built")?.path;
    let said = measured(&arguments)?;
    let mut lines = said.lines();
    let mut rows = format!("{},counted_ratio\n", lines.next().unwrap_or_default());
    let mut plant = (String::new(), 0);
    for line in lines {
        let [bodies, precision, set, _, threads] = parts(line)?;
        let count = |way: &str| {
            callgrind::count(program, FUNCTION, &["count", bodies, precision, way, COUNTED])
        };
        let of = format!("{bodies} {precision}");
        if plant.0 != of {
            plant = (of, count("plant")?);
        }
        let counted = if set == UNKNOWN || threads != "1" {
            String::new()
        } else {
            format!("{:.2}", plant.1 as f64 / count(set)? as f64)
        };
        rows += &format!("{line},{counted}\n");
    }
    write(LARGE, &of_large(&machine, &rows))
}

/// The first columns of a row.
fn parts(line: &str) -> Result<[&str; 5]> {
    let parts: Vec<_> = line.split(',').take(5).collect();
    parts.try_into().ok().with_context(|| format!("`{line}` is no row"))
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

fn of_large(of: &str, rows: &str) -> String {
    format!(
        "# Steps per second of one chain of revolutes in lanes, leapfrog, over those of its plant on one thread, taken in turn in\n\
         # one process: the median of the rounds' ratios, half the range of their middle half over it, the ratio of the fastest\n\
         # rounds, and of two threads that over one; the plant's instructions over the lanes', counted by callgrind, which does\n\
         # not know AVX-512; written by `cargo xtask bench`, {of}.\n{rows}"
    )
}

fn write(file: &str, text: &str) -> Result<()> {
    std::fs::write(root().join(file), text).with_context(|| format!("cannot write {file}"))?;
    println!("written: {file}");
    Ok(())
}
