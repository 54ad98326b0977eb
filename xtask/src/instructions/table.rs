//! Instructions of a step as a table, and what they ought to be.
//!
//! `rows => table, goals met or not, docs/results/instructions.csv`.

use anyhow::{Context as _, Result};

use crate::baseline::Key;
use crate::command::root;

pub const FILE: &str = "docs/results/instructions.csv";
/// How far the exponent of growth may be from 1.
const BAND: f64 = 0.03;
/// Instructions that a step needs for each of its flops: a core takes four instructions in a cycle and two of
/// them may be flops, so that the others must not be more.
const EQUIVALENT: f64 = 2.0;
/// How much more a step may take than that.
const MARGIN: f64 = 1.2;

/// Counts per step of a subject.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct Row {
    /// Its name.
    pub name: String,
    /// The links of a chain.
    pub links: Option<u64>,
    /// Flops in double precision.
    pub flops: f64,
    /// Instructions of the kernel in double precision.
    pub f64: u64,
    /// Instructions of the kernel in single precision.
    pub f32: u64,
    /// Instructions of the plain loop; 0 where it was not counted.
    pub plain: u64,
}

/// What a figure ought to be.
#[derive(Clone, Debug, PartialEq)]
pub struct Goal {
    what: String,
    figure: f64,
    from: f64,
    to: f64,
}

impl Goal {
    /// Whether the figure is what it ought to be.
    pub fn is_met(&self) -> bool {
        (self.from..=self.to).contains(&self.figure)
    }

    /// As people read it.
    pub fn line(&self) -> String {
        let goal = match self.from > 0.0 {
            true => format!("{} to {}", self.from, self.to),
            false => format!("at most {}", self.to),
        };
        let verdict = if self.is_met() { "met" } else { "not met" };
        format!("{}: {:.3}, goal {goal}: {verdict}", self.what, self.figure)
    }
}

/// How instructions grow with the bodies of a chain.
pub fn growth(rows: &[Row]) -> Goal {
    let points = rows.iter().filter_map(|row| Some((row.links? as f64, row.f64 as f64)));
    let what = "exponent of growth with a chain's bodies".to_owned();
    Goal { what, figure: exponent(points), from: 1.0 - BAND, to: 1.0 + BAND }
}

/// The growth, and instructions over those that the flops are worth, scene by scene.
pub fn goals(rows: &[Row]) -> Vec<Goal> {
    let bound = |row: &Row| Goal {
        what: format!("{}, instructions over {EQUIVALENT} per flop", row.name),
        figure: row.f64 as f64 / (EQUIVALENT * row.flops),
        from: 0.0,
        to: MARGIN,
    };
    let scenes = rows.iter().filter(|row| row.links.is_none());
    [growth(rows)].into_iter().chain(scenes.map(bound)).collect()
}

/// The exponent b of a power law y = a·x^b, by least squares of the logarithms.
fn exponent(points: impl Iterator<Item = (f64, f64)>) -> f64 {
    let points: Vec<(f64, f64)> = points.map(|(x, y)| (x.ln(), y.ln())).collect();
    let count = points.len() as f64;
    let mean = |of: fn(&(f64, f64)) -> f64| points.iter().map(of).sum::<f64>() / count;
    let (x, y) = (mean(|point| point.0), mean(|point| point.1));
    let products: f64 = points.iter().map(|point| (point.0 - x) * (point.1 - y)).sum();
    let squares: f64 = points.iter().map(|point| (point.0 - x) * (point.0 - x)).sum();
    products / squares
}

/// The rows for people.
pub fn shown(rows: &[Row]) -> String {
    let mut text = format!(
        "{:<12} {:>10} {:>12} {:>12} {:>12} {:>10} {:>12}\n",
        "model", "flops", "kernel f64", "kernel f32", "plain f64", "per flop", "plain/kernel"
    );
    for row in rows {
        text += &format!(
            "{:<12} {:>10} {:>12} {:>12} {:>12} {:>10.2} {:>12.2}\n",
            row.name,
            row.flops,
            row.f64,
            row.f32,
            row.plain,
            row.f64 as f64 / row.flops,
            row.plain as f64 / row.f64 as f64
        );
    }
    text
}

/// Writes the file that the pages' tables are rendered from.
///
/// # Errors
/// Where it cannot be written.
pub fn write(key: &Key, rows: &[Row]) -> Result<()> {
    let Key { compiler, target } = key;
    let mut text = format!(
        "# Instructions per step, leapfrog, run-time-sized model; written by `cargo xtask instructions --baseline`, {compiler} \
         for {target}.\nmodel,links,flops,f64,f32,plain\n"
    );
    for Row { name, links, flops, f64, f32, plain } in rows {
        let links = links.map(|links| links.to_string()).unwrap_or_default();
        text += &format!("{name},{links},{flops},{f64},{f32},{plain}\n");
    }
    std::fs::write(root().join(FILE), text).with_context(|| format!("cannot write {FILE}"))?;
    println!("written: {FILE}");
    Ok(())
}

#[cfg(test)]
mod tests {
    use super::*;

    fn chain(links: u64, f64: u64) -> Row {
        Row {
            name: format!("chain-{links}"),
            links: Some(links),
            flops: 1.0,
            f64,
            ..Row::default()
        }
    }

    #[test]
    fn growth_is_judged_by_its_exponent() {
        let rows = |power: f64| {
            [10_u64, 100, 1_000].map(|n| chain(n, (7.0 * (n as f64).powf(power)).round() as u64))
        };
        assert!((growth(&rows(2.0)).figure - 2.0).abs() < 1e-3);
        assert!(growth(&rows(1.0)).is_met() && growth(&rows(1.02)).is_met());
        assert!(!growth(&rows(1.05)).is_met() && !growth(&rows(0.95)).is_met());
    }

    #[test]
    fn a_scene_is_judged_by_its_flops_and_a_chain_is_not() {
        let scene = |f64| Row { name: "a".to_owned(), flops: 1_000.0, f64, ..Row::default() };
        let met = |f64| goals(&[scene(f64), chain(10, 100), chain(100, 1_000)])[1].is_met();
        assert!(met(2_400) && !met(2_401));
        assert_eq!(goals(&[scene(1), chain(10, 100)]).len(), 2);
    }
}
