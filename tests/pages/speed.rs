//! `docs/speed.md`: instructions as counted, goals beside figures, what did not help.

use dbd_tests::page::{block, figure, grouped, table};
use dbd_tests::results::{Row, rows};

const PAGE: &str = "docs/speed.md";

fn counted() -> Vec<Row> {
    rows("docs/results/instructions.csv")
}

#[test]
fn instructions_are_as_counted() {
    let line = |row: &Row| {
        let per = |column: &str, of: &str| figure(row.number(column) / row.number(of), 3);
        let columns = ["flops", "f64", "f32", "plain"].map(|column| grouped(row.text(column)));
        let name = format!("`{}`", row.text("model"));
        [vec![name], columns.to_vec(), vec![per("f64", "flops"), per("plain", "f64")]].concat()
    };
    let head = ["per step", "flops", "f64", "f32", "plain", "f64 per flop", "plain over f64"];
    block(PAGE, "instructions", &table(&head, &counted().iter().map(line).collect::<Vec<_>>()));
}

/// The exponent of instructions over links, by least squares of the logarithms.
fn growth() -> f64 {
    let counted = counted();
    let chains = counted.iter().filter(|row| !row.text("links").is_empty());
    let points: Vec<(f64, f64)> =
        chains.map(|row| (row.number("links").ln(), row.number("f64").ln())).collect();
    let mean =
        |of: fn(&(f64, f64)) -> f64| points.iter().map(of).sum::<f64>() / points.len() as f64;
    let (x, y) = (mean(|point| point.0), mean(|point| point.1));
    let products: f64 = points.iter().map(|point| (point.0 - x) * (point.1 - y)).sum();
    products / points.iter().map(|point| (point.0 - x).powi(2)).sum::<f64>()
}

/// Scenes whose steps on a Cortex-M4F, leapfrog in f32, ought to take no more than so many instructions.
const TARGET: [(&str, f64); 4] = [
    ("hexagon", 4_500.0),
    ("double-wishbone", 12_000.0),
    ("cart-pendulum", 6_000.0),
    ("gripper", 24_000.0),
];

#[test]
fn goals_stand_beside_what_is() {
    let line = |what: String, goal: &str, is: String, met: bool| {
        vec![what, goal.to_owned(), is, if met { "met" } else { "not met" }.to_owned()]
    };
    let growth = growth();
    let mut lines = vec![line(
        "PC, exponent of instructions with a chain's bodies, 10 to 10,000".to_owned(),
        "1.00 ± 0.03",
        format!("{growth:.3}"),
        (growth - 1.0).abs() <= 0.03,
    )];
    for row in counted().iter().filter(|row| row.text("links").is_empty()) {
        let over = row.number("f64") / (2.0 * row.number("flops"));
        let what = format!("PC, `{}`, f64: instructions over two per flop", row.text("model"));
        lines.push(line(what, "≤ 1.2", format!("{over:.2}"), over <= 1.2));
    }
    let costs = rows("docs/costs.csv");
    for (scene, goal) in TARGET {
        let wanted = [("scene", scene), ("scheme", "leapfrog"), ("precision", "f32")];
        let is = costs.iter().find(|row| row.is(&wanted)).unwrap().number("instructions_mean");
        let what = format!("Cortex-M4F, `{scene}`, leapfrog f32: instructions");
        let goal_text = format!("≤ {}", grouped(&goal.to_string()));
        lines.push(line(what, &goal_text, grouped(&is.to_string()), is <= goal));
    }
    block(PAGE, "goals", &table(&["what", "goal", "is", ""], &lines));
}

#[test]
fn what_did_not_help_is_told() {
    let line = |row: &Row| {
        ["tried", "where", "ratio", "of", "why"].map(|column| row.text(column).to_owned()).to_vec()
    };
    let tried = rows("docs/results/tried.csv");
    let head = ["tried", "where", "ratio", "of", "why"];
    block(PAGE, "tried", &table(&head, &tried.iter().map(line).collect::<Vec<_>>()));
}
