//! What an accuracy costs beside other programs where ideal joints are meant.
//!
//! `docs/results/peers.csv => tables of docs/validation/peers.md`.

use dbd_tests::page::{block, figure, table};
use dbd_tests::results::{Row, rows};

const PAGE: &str = "docs/validation/peers.md";
const OURS: &str = "this kernel";
const ACCURACIES: [&str; 4] = ["1e-03", "1e-04", "1e-05", "1e-06"];

/// \[ms\] wanted per simulated second for a mechanism and an accuracy.
const GOALS: [(&str, &str, f64); 6] = [
    ("four-bar", "1e-05", 3.5),
    ("four-bar", "1e-06", 7.0),
    ("six-bar", "1e-05", 5.0),
    ("3ruu", "1e-06", 9.0),
    ("chain of 10", "1e-06", 2.5),
    ("chain of 100", "1e-06", 30.0),
];

/// Most that a cell may cost over another program's.
const OTHERS: [(&str, f64); 3] = [("MuJoCo", 1.0), ("Pinocchio", 1.0), ("CasADi", 2.0)];

/// \[ms\] per simulated second, `None` where no setting holds the accuracy.
fn cost(row: &Row) -> Option<f64> {
    (!row.text("cpu_s_per_s").is_empty()).then(|| 1e3 * row.number("cpu_s_per_s"))
}

#[test]
fn peers_are_as_measured() {
    let all = rows("docs/results/peers.csv");
    let mut lines: Vec<Vec<String>> = Vec::new();
    for row in &all {
        let title = [row.text("mechanism"), row.text("window_s"), row.text("tool")];
        if lines.last().is_none_or(|line| line[0] != title[0] || line[2] != title[2]) {
            lines.push(title.map(str::to_owned).to_vec());
        }
        let here = [("mechanism", title[0]), ("accuracy_m", row.text("accuracy_m"))];
        let costs = all.iter().filter(|other| other.is(&here)).filter_map(cost);
        let least = costs.fold(f64::INFINITY, f64::min);
        lines.last_mut().unwrap().push(match cost(row) {
            Some(cost) if cost <= least => format!("**{}**", figure(cost, 2)),
            Some(cost) => figure(cost, 2),
            None => "–".to_owned(),
        });
    }
    let accuracies = ACCURACIES.map(|accuracy| format!("{} m", accuracy.replace("-0", "-")));
    let titles = ["mechanism", "window \\[s\\]", "program"].map(str::to_owned);
    let head: Vec<&str> = titles.iter().chain(&accuracies).map(String::as_str).collect();
    assert!(lines.iter().all(|line| line.len() == head.len()), "{lines:?}");
    block(PAGE, "peers", &table(&head, &lines));
}

#[test]
fn goals_stand_beside_what_is() {
    let all = rows("docs/results/peers.csv");
    let cost_of = |tool: &str, mechanism: &str, accuracy: &str| {
        let wanted = [("mechanism", mechanism), ("accuracy_m", accuracy)];
        let mut found = all.iter().filter(|row| row.is(&wanted));
        found.find(|row| row.text("tool").starts_with(tool)).and_then(cost)
    };
    let line = |what: String, goal: f64, is: Option<f64>| {
        let verdict = if is.is_some_and(|is| is <= goal) { "met" } else { "not met" };
        let is = is.map_or_else(|| "–".to_owned(), |is| figure(is, 2));
        vec![what, format!("≤ {goal}"), is, verdict.to_owned()]
    };
    let mut lines: Vec<Vec<String>> = Vec::new();
    for (mechanism, accuracy, goal) in GOALS {
        let what = format!("{mechanism} to {} m \\[ms/s\\]", accuracy.replace("-0", "-"));
        lines.push(line(what, goal, cost_of(OURS, mechanism, accuracy)));
    }
    for (tool, goal) in OTHERS {
        let others = all.iter().filter(|row| row.text("tool").starts_with(tool));
        let ratios = others.filter_map(|row| {
            Some(cost_of(OURS, row.text("mechanism"), row.text("accuracy_m"))? / cost(row)?)
        });
        let what = format!("largest ratio to {tool} in a cell");
        lines.push(line(what, goal, ratios.reduce(f64::max)));
    }
    block(PAGE, "peers goals", &table(&["what", "goal", "is", ""], &lines));
}
