//! `cargo xtask cost`: instructions and memory of a step, as docs/costs.csv and a table.
//!
//! `program cost in QEMU, image of the audit => rows`. Instructions, plant, model and stack are
//! measured by the program; `.text` is the code that the step reaches, with its literals, known for
//! the steps that the audit links.

use std::fmt::Write as _;

use anyhow::{Context as _, Result, bail};

use crate::command::root;
use crate::image::Image;
use crate::toolchain::Toolchain;
use crate::{firmware, setup};

const FILE: &str = "docs/costs.csv";
const HEADER: &str = "scene,scheme,precision,step_s,instructions_mean,instructions_max,text_bytes,\
                      rodata_bytes,plant_ram_bytes,stack_bytes,estimated_rate_168mhz_hz";
/// \[Hz\] a common clock of Cortex-M4F parts.
const CLOCK: f64 = 168e6;
/// Cycles per instruction assumed for the estimated rate. Cortex-M4 takes one for most, two for
/// loads, 14 for a division or a square root in single precision (Technical Reference Manual,
/// DDI 0439, tables 3-1 and 7-1); memory without wait states.
const CYCLES_PER_INSTRUCTION: f64 = 1.5;

/// What a step of one combination costs.
#[derive(Clone, Debug, PartialEq)]
struct Cost {
    scene: String,
    scheme: String,
    precision: String,
    step: f64,
    mean: u64,
    max: u64,
    /// Where the audit's image holds the step.
    text: Option<u64>,
    model: u64,
    plant: u64,
    stack: u64,
}

/// `cargo xtask cost [SCENE…]`.
///
/// # Errors
/// Where a scene is unknown, or building, running or writing fails.
pub fn run(scenes: &[String]) -> Result<()> {
    let toolchain = setup::complete()?;
    let costs = measure(&toolchain)?;
    for scene in scenes {
        if !costs.iter().any(|cost| cost.scene == *scene) {
            let mut known: Vec<&str> = costs.iter().map(|cost| cost.scene.as_str()).collect();
            known.sort_unstable();
            known.dedup();
            bail!("there is no shipped scene `{scene}`; there are: {}", known.join(", "));
        }
    }
    let file = root().join(FILE);
    std::fs::create_dir_all(file.parent().unwrap_or(root()))?;
    std::fs::write(&file, csv(&costs)).with_context(|| format!("cannot write {FILE}"))?;
    println!("\n{}", table(&costs, scenes));
    println!("written: {FILE}");
    Ok(())
}

/// Measures and compares with the file, which is part of the sources.
///
/// # Errors
/// Where measuring fails or the program's rows are not those of the file.
pub fn check(toolchain: &Toolchain) -> Result<()> {
    let costs = measure(toolchain)?;
    println!("\n{}", table(&costs, &[]));
    let written = std::fs::read_to_string(root().join(FILE)).unwrap_or_default();
    // Counts differ a little from compiler to compiler; that a row is missing does not.
    if rows(&written) != rows(&csv(&costs)) {
        bail!("{FILE} has other rows than the shipped models: cargo xtask cost");
    }
    Ok(())
}

/// Scene, scheme and precision of each row, and whether its `.text` is known.
fn rows(text: &str) -> Vec<(Vec<&str>, bool)> {
    let row = |line| {
        let columns: Vec<&str> = str::split(line, ',').collect();
        let text = columns.get(6).is_some_and(|text| !text.is_empty());
        (columns.into_iter().take(3).collect(), text)
    };
    text.lines().skip(1).map(row).collect()
}

fn measure(toolchain: &Toolchain) -> Result<Vec<Cost>> {
    let image = Image::read(&firmware::build_audit(toolchain, None)?)?;
    let lines = firmware::execute(toolchain, "cost", false, &[])?;
    let mut costs = Vec::new();
    for line in lines.iter().filter(|line| line.starts_with("cost ")) {
        let mut cost = parse(line).with_context(|| format!("cannot read `{line}`"))?;
        // As the build script names a scene's module: an identifier begins with no digit.
        let mut module = cost.scene.replace('-', "_");
        if module.starts_with(|first: char| first.is_ascii_digit()) {
            module.insert(0, '_');
        }
        let root = format!("audit::roots::{module}::{}_{}", cost.scheme, cost.precision);
        cost.text = image.reach(&root).ok().map(|reach| reach.iter().map(|f| f.size).sum());
        costs.push(cost);
    }
    // Two scenes of one shape have one type of plant, and the compiler may fold their roots into
    // one: the text is then that of the other.
    let known = costs.clone();
    for cost in costs.iter_mut().filter(|cost| cost.text.is_none()) {
        let shape = |c: &Cost| (c.scheme.clone(), c.precision.clone(), c.plant, c.model);
        let twin = known.iter().find(|other| other.text.is_some() && shape(other) == shape(cost));
        cost.text = twin.and_then(|twin| twin.text);
    }
    if !costs.iter().any(|cost| cost.text.is_some()) {
        bail!("the program reported no step of the audit's");
    }
    Ok(costs)
}

/// Reads `cost SCENE SCHEME PRECISION STEP_NS MEAN MAX PLANT MODEL STACK`.
fn parse(line: &str) -> Option<Cost> {
    let words: Vec<&str> = line.split_whitespace().collect();
    let [_, scene, scheme, precision, step, mean, max, plant, model, stack] = words[..] else {
        return None;
    };
    Some(Cost {
        scene: scene.to_owned(),
        scheme: scheme.to_owned(),
        precision: precision.to_owned(),
        step: step.parse::<u64>().ok()? as f64 * 1e-9,
        mean: mean.parse().ok()?,
        max: max.parse().ok()?,
        text: None,
        model: model.parse().ok()?,
        plant: plant.parse().ok()?,
        stack: stack.parse().ok()?,
    })
}

impl Cost {
    fn rate(&self) -> u64 {
        (CLOCK / (CYCLES_PER_INSTRUCTION * self.max as f64)) as u64
    }
}

fn csv(costs: &[Cost]) -> String {
    let mut text = format!("{HEADER}\n");
    for c in costs {
        let _ = writeln!(
            text,
            "{},{},{},{:e},{},{},{},{},{},{},{}",
            c.scene,
            c.scheme,
            c.precision,
            c.step,
            c.mean,
            c.max,
            c.text.map(|bytes| bytes.to_string()).unwrap_or_default(),
            c.model,
            c.plant,
            c.stack,
            c.rate()
        );
    }
    text
}

fn table(costs: &[Cost], scenes: &[String]) -> String {
    let mut text = format!(
        "{:<16} {:<28} {:<5} {:>9} {:>9} {:>8} {:>8} {:>6} {:>6} {:>10}\n",
        "scene", "scheme", "real", "instr/step", "max", ".text", ".rodata", "RAM", "stack", "rate*"
    );
    for c in costs.iter().filter(|c| scenes.is_empty() || scenes.contains(&c.scene)) {
        let _ = writeln!(
            text,
            "{:<16} {:<28} {:<5} {:>10} {:>9} {:>8} {:>8} {:>6} {:>6} {:>7} Hz",
            c.scene,
            c.scheme,
            c.precision,
            c.mean,
            c.max,
            c.text.map_or("-".to_owned(), |bytes| bytes.to_string()),
            c.model,
            c.plant,
            c.stack,
            c.rate()
        );
    }
    text + "* an estimate: 168 MHz, 1.5 cycles per instruction, memory without wait states"
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_line_becomes_a_row() {
        let mut cost = parse("cost four-bar dbd f32 100000 9000 10000 600 800 400").unwrap();
        cost.text = Some(7000);
        let row = "four-bar,dbd,f32,1e-4,9000,10000,7000,800,600,400,11200";
        assert_eq!(csv(&[cost]).lines().last(), Some(row));
        assert_eq!(parse("cost four-bar dbd f32 refused"), None);
    }

    #[test]
    fn a_row_may_lack_the_text_and_is_then_another() {
        let mut cost = parse("cost four-bar dbd+1 f32 100000 9000 10000 600 800 400").unwrap();
        let without = csv(&[cost.clone()]);
        let row = "four-bar,dbd+1,f32,1e-4,9000,10000,,800,600,400,11200";
        assert_eq!(without.lines().last(), Some(row));
        assert_eq!(rows(&without), [(vec!["four-bar", "dbd+1", "f32"], false)]);
        cost.text = Some(7000);
        let with = csv(&[cost.clone()]);
        assert_ne!(rows(&without), rows(&with));
        // Counts may differ.
        cost.mean += 1;
        assert_eq!(rows(&with), rows(&csv(&[cost])));
    }
}
