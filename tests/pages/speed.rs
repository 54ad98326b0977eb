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

/// Models whose step on a Cortex-M4F ought to take no more than so many instructions: scene, scheme, precision.
const STEPS: [([&str; 3], f64); 12] = [
    (["hexagon", "leapfrog", "f32"], 3_400.0),
    (["four-bar", "leapfrog", "f32"], 2_600.0),
    (["hexagon-bushing", "leapfrog", "f32"], 2_140.0),
    (["hexagon-planar", "leapfrog", "f32"], 1_080.0),
    (["3ruu", "leapfrog", "f32"], 13_000.0),
    (["double-wishbone", "leapfrog-joint-wise", "f32"], 11_500.0),
    (["cart-pendulum", "leapfrog-joint-wise", "f32"], 6_000.0),
    (["gripper", "leapfrog-joint-wise", "f32"], 24_000.0),
    (["hexagon", "leapfrog", "fixed"], 7_625.0),
    (["3ruu", "generalized-alpha", "f32"], 45_000.0),
    (["six-bar", "generalized-alpha", "f32"], 16_000.0),
    (["six-bar-planar", "generalized-alpha", "f32"], 5_000.0),
];

/// Sizes of a plain plant on a Cortex-M4F: what, the most bytes, the columns that make it.
const SIZES: [(&str, f64, [&str; 2]); 2] = [
    ("code and model", 32_768.0, ["text_bytes", "rodata_bytes"]),
    ("plant and stack", 4_096.0, ["plant_ram_bytes", "stack_bytes"]),
];

/// The exponent between the last two sizes of a way of looking at a scene.
fn last_exponent(way: &str) -> f64 {
    let counted = rows("docs/results/growth.csv");
    let mut points = counted.iter().filter(|row| row.text("way") == way);
    let [Some(last), Some(before)] = [points.next_back(), points.next_back()] else {
        panic!("{way} has not two sizes");
    };
    let ratio = |column: &str| (last.number(column) / before.number(column)).ln();
    ratio("instructions") / ratio("bodies")
}

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
        lines.push(line(what, "≤ 1.2", format!("{over:.3}"), over <= 1.2));
    }
    for way in ["load", "check", "run"] {
        let is = last_exponent(way);
        let what = format!("PC, `{way}`, exponent of instructions, 1,000 to 10,000 bodies");
        lines.push(line(what, "≤ 1.1", format!("{is:.3}"), is <= 1.1));
    }
    let costs = rows("docs/costs.csv");
    let counted = |[scene, scheme, precision]: [&str; 3]| {
        let wanted = [("scene", scene), ("scheme", scheme), ("precision", precision)];
        costs.iter().find(|row| row.is(&wanted)).unwrap()
    };
    let most = |what: String, goal: f64, is: f64| {
        let [goal_text, is_text] = [goal, is].map(|number| grouped(&number.to_string()));
        line(what, &format!("≤ {goal_text}"), is_text, is <= goal)
    };
    for (model, goal) in STEPS {
        let [scene, scheme, precision] = model;
        let what = format!("Cortex-M4F, `{scene}`, {scheme} {precision}: instructions");
        lines.push(most(what, goal, counted(model).number("instructions_mean")));
    }
    for (part, goal, columns) in SIZES {
        let row = counted(["3ruu", "leapfrog", "f32"]);
        let is = columns.map(|column| row.number(column)).iter().sum();
        lines.push(most(format!("Cortex-M4F, `3ruu`, leapfrog f32: {part}, bytes"), goal, is));
    }
    block(PAGE, "goals", &table(&["what", "goal", "is", ""], &lines));
}
