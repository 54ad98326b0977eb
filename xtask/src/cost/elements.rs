//! `cargo xtask cost --elements`: what a step costs more with an element, as docs/results/elements.csv.
//!
//! `program elements in QEMU => rows`. The plain scene comes first; the other rows state what they have more than it.
//! Scenes: `firmware/qemu/elements`.

use anyhow::{Context as _, Result};

use crate::chip::{firmware, setup};
use crate::command::root;

use super::row::{self, Cost};

const FILE: &str = "docs/results/elements.csv";
const PLAIN: &str = "plain";

/// Counts and writes the file.
///
/// # Errors
/// Where building, running or writing fails, or the program does not count the plain scene.
pub fn run() -> Result<()> {
    let toolchain = setup::complete()?;
    let costs = row::parse(&firmware::execute(&toolchain, "elements", false, &[])?)?;
    let text = format!(
        "# A Cortex-M4F, leapfrog, f32; written by `cargo xtask cost --elements`, {}.\n{}",
        toolchain.describe_compiler()?,
        table(&costs)?
    );
    std::fs::write(root().join(FILE), text).with_context(|| format!("cannot write {FILE}"))?;
    println!("written: {FILE}");
    crate::provenance::note(&[FILE])
}

fn table(costs: &[Cost]) -> Result<String> {
    let plain = costs.iter().find(|cost| cost.scene == PLAIN);
    let plain = plain.context("the program did not count the plain scene")?;
    let mut text =
        "element,instructions_mean,instructions_max,rodata_bytes,plant_ram_bytes\n".to_owned();
    let mut line = |cost: &Cost, less: [u64; 4]| {
        let counts = [cost.mean, cost.max, cost.model, cost.plant];
        let more =
            counts.iter().zip(less).map(|(count, less)| (*count as i64 - less as i64).to_string());
        let columns: Vec<String> = std::iter::once(cost.scene.clone()).chain(more).collect();
        text += &(columns.join(",") + "\n");
    };
    line(plain, [0; 4]);
    for cost in costs.iter().filter(|cost| cost.scene != PLAIN) {
        line(cost, [plain.mean, plain.max, plain.model, plain.plant]);
    }
    Ok(text)
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn an_element_is_the_difference_to_the_plain_scene() {
        let costs = [
            "cost servo leapfrog f32 100000 1200 1300 260 320 90",
            "cost plain leapfrog f32 100000 1000 1010 250 300 90",
        ];
        let costs: Vec<Cost> = costs.iter().map(|line| Cost::parse(line).unwrap()).collect();
        let text = table(&costs).unwrap();
        let lines: Vec<&str> = text.lines().skip(1).collect();
        assert_eq!(lines, ["plain,1000,1010,300,250", "servo,200,290,20,10"]);
        assert!(table(&costs[..1]).is_err());
    }
}
