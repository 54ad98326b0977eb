//! `cargo xtask cost --elements`: what a step costs more with an element, as docs/results/elements.csv.
//!
//! `program elements in QEMU => rows`. The plain scene comes first; the other rows state what they have more than it, in
//! space and in the plane.
//! Scenes: `firmware/qemu/elements`.

use anyhow::{Context as _, Result};

use crate::chip::{firmware, setup};
use crate::command::root;

use super::row::{self, Cost};

const FILE: &str = "docs/results/elements.csv";
const PLAIN: &str = "plain";
/// Ends the name of a scene in the plane.
const PLANAR: &str = "-planar";

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
    let find = |name: &str| costs.iter().find(|cost| cost.scene == name);
    let counts =
        |cost: &Cost| [cost.mean, cost.max, cost.model, cost.plant].map(|count| count as i64);
    let planar_counts = |name: &str| find(&format!("{name}{PLANAR}")).map(counts);
    let plain = counts(find(PLAIN).context("the program did not count the plain scene")?);
    let planar =
        planar_counts(PLAIN).context("the program did not count the plain scene in the plane")?;
    let mut text = "element,instructions_mean,instructions_max,rodata_bytes,plant_ram_bytes,\
                    planar_instructions_mean,planar_instructions_max\n"
        .to_owned();
    let mut line = |cost: &Cost, less: i64| {
        let more = counts(cost).into_iter().zip(plain).map(|(count, plain)| count - less * plain);
        let more = more.map(|count| count.to_string());
        let flat = planar_counts(&cost.scene);
        let flat = [0, 1].map(|i| {
            flat.map_or(String::new(), |counts| (counts[i] - less * planar[i]).to_string())
        });
        let columns: Vec<String> =
            std::iter::once(cost.scene.clone()).chain(more).chain(flat).collect();
        text += &(columns.join(",") + "\n");
    };
    let spatial = || costs.iter().filter(|cost| !cost.scene.ends_with(PLANAR));
    spatial().filter(|cost| cost.scene == PLAIN).for_each(|cost| line(cost, 0));
    spatial().filter(|cost| cost.scene != PLAIN).for_each(|cost| line(cost, 1));
    Ok(text)
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn an_element_is_the_difference_to_the_plain_scene() {
        let costs = [
            "cost servo leapfrog f32 100000 1200 1300 1200 260 320 90",
            "cost plain leapfrog f32 100000 1000 1010 1000 250 300 90",
            "cost plain-planar leapfrog f32 100000 300 310 300 250 300 90",
            "cost rod-planar leapfrog f32 100000 350 361 350 250 300 90",
            "cost rod leapfrog f32 100000 1050 1060 1050 250 300 90",
        ];
        let costs: Vec<Cost> = costs.iter().map(|line| Cost::parse(line).unwrap()).collect();
        let text = table(&costs).unwrap();
        let lines: Vec<&str> = text.lines().skip(1).collect();
        assert_eq!(
            lines,
            ["plain,1000,1010,300,250,300,310", "servo,200,290,20,10,,", "rod,50,50,0,0,50,51",]
        );
        assert!(table(&costs[..1]).is_err());
    }
}
