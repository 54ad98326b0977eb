//! `docs/speed.md` and `docs/ensembles.md`: times as `cargo xtask bench` kept them, growth as counted.

use dbd_tests::page::{block, figure, grouped, table};
use dbd_tests::results::{Row, data, rows};
use serde_json::Value;

const SPEED: &str = "docs/speed.md";

fn kept() -> Value {
    serde_json::from_str(&data("docs/results/bench.json")).unwrap()
}

fn text<'v>(value: &'v Value, key: &str) -> &'v str {
    value[key].as_str().unwrap_or_else(|| panic!("no text {key} in {value}"))
}

fn list<'v>(value: &'v Value, key: &str) -> &'v [Value] {
    value[key].as_array().unwrap_or_else(|| panic!("no list {key} in {value}"))
}

/// A number; "–" where there is none.
fn cell(value: &Value, show: impl Fn(f64) -> String) -> String {
    value.as_f64().map_or("–".into(), show)
}

#[test]
fn times_of_steps_are_as_kept() {
    let kept = kept();
    let line = |system: &Value| {
        let time = &system["f64_s"];
        let over =
            |way: &str| cell(&system[way]["over_kernel"]["median"], |ratio| format!("{ratio:.2}"));
        vec![
            format!("`{}`", text(system, "name")),
            grouped(&system["bodies"].to_string()),
            grouped(&system["tsdas"].to_string()),
            cell(&time["least"], |seconds| figure(seconds * 1e6, 3)),
            cell(&time["spread"], |part| figure(100.0 * part, 2)),
            over("f32"),
            over("std"),
            over("plain"),
            cell(&system["over_flop_bound"]["median"], |ratio| format!("{ratio:.2}")),
        ]
    };
    let bench = &kept["bench"];
    assert_eq!(bench["checked"], false, "not of a release");
    let lines: Vec<_> = list(bench, "systems").iter().map(line).collect();
    let head = ["system", "bodies", "TSDAs", "µs", "±%", "f32", "std", "plain", "bound"];
    let of = format!("{}:\n\n", text(&kept, "of"));
    block(SPEED, "times", &(of + &table(&head, &lines)));
}

#[test]
fn goals_of_times_stand_beside_what_is() {
    let line = |goal: &Value| {
        let wanted = match (goal["at_least"].as_f64(), goal["at_most"].as_f64()) {
            (Some(low), Some(high)) => format!("{low} to {high}"),
            (Some(low), None) => format!("≥ {low}"),
            (None, Some(high)) => format!("≤ {high}"),
            (None, None) => panic!("{goal} is none"),
        };
        let number = |key: &str| cell(&goal[key], |number| format!("{number:.2}"));
        let verdict = match text(goal, "verdict") {
            "met" => "met",
            "not-met" => "not met",
            "too-noisy" => "times scatter too much to tell",
            "cores-busy" => "not met, the cores had other work",
            other => panic!("{goal} is {other}"),
        };
        let is = format!("{} ± {}", number("figure"), number("scatter"));
        vec![text(goal, "what").to_owned(), wanted, is, verdict.to_owned()]
    };
    let kept = kept();
    let lines: Vec<_> = list(&kept["bench"], "goals").iter().map(line).collect();
    block(SPEED, "aims", &table(&["what", "goal", "is", ""], &lines));
}

#[test]
fn looking_at_a_scene_grows_as_counted() {
    let counted = rows("docs/results/growth.csv");
    let mut lines: Vec<Vec<String>> = Vec::new();
    let mut before: Option<(f64, f64)> = None;
    for row in &counted {
        let way = format!("`{}`", row.text("way"));
        let point = (row.number("bodies"), row.number("instructions"));
        if lines.last().is_none_or(|line| line[0] != way) {
            lines.push(vec![way]);
            before = None;
        }
        let line = lines.last_mut().unwrap();
        if before.is_some() {
            line.pop();
        }
        line.push(format!("{} M", figure(point.1 / 1e6, 3)));
        let exponent =
            |(bodies, count): (f64, f64)| (point.1 / count).ln() / (point.0 / bodies).ln();
        line.push(before.map_or("–".into(), |before| format!("{:.3}", exponent(before))));
        before = Some(point);
    }
    let bodies = |row: &Row| format!("{} bodies", grouped(row.text("bodies")));
    let first = counted[0].text("way");
    let sizes: Vec<String> =
        counted.iter().filter(|row| row.text("way") == first).map(bodies).collect();
    let head = [
        &["instructions"],
        &sizes.iter().map(String::as_str).collect::<Vec<_>>()[..],
        &["last exponent"],
    ];
    block(SPEED, "growth", &table(&head.concat(), &lines));
}

/// Scene by scene, precision by precision: one thread on each instruction set, then two on AVX2, with what
/// was aimed at.
#[test]
fn ensembles_are_as_measured() {
    let all = rows("docs/results/ensembles.csv");
    let mut lines: Vec<Vec<String>> = Vec::new();
    let mut seen: Vec<(&str, &str)> = Vec::new();
    for row in &all {
        let of = (row.text("scene"), row.text("precision"));
        if seen.contains(&of) {
            continue;
        }
        seen.push(of);
        let found = |set: &str, threads: &str| {
            let wanted =
                [("scene", of.0), ("precision", of.1), ("instructions", set), ("threads", threads)];
            all.iter().find(|row| row.is(&wanted))
        };
        let ratio = |set: &str, column: &str, threads: &str| {
            let row = found(set, threads);
            row.map_or("–".into(), |row| format!("{:.1}", row.number(column)))
        };
        let least = if of.1 == "f32" { 5.0 } else { 3.2 };
        let verdict = match found("avx2", "1").map(|row| row.number("median_ratio")) {
            Some(ratio) if ratio >= least => "met",
            Some(_) => "not met",
            None => "–",
        };
        let scatter =
            found("avx2", "1").map_or("–".into(), |row| figure(100.0 * row.number("spread"), 2));
        let threads = |column: &str| found("avx2", "2").map(|row| row.number(column));
        let (two, cores) = (threads("over_one_thread"), threads("alone_over_one_thread"));
        // Two threads of plants that share nothing gain this and more where both cores are free.
        let judged = match two.zip(cores) {
            Some((two, _)) if two >= 1.8 => "met",
            Some((_, cores)) if cores < 1.9 => "cores busy",
            Some(_) => "not met",
            None => "–",
        };
        let cell =
            |number: Option<f64>| number.map_or("–".into(), |number| format!("{number:.2}"));
        lines.push(vec![
            format!("`{}`", of.0),
            of.1.to_owned(),
            ratio("baseline", "median_ratio", "1"),
            ratio("avx2", "median_ratio", "1"),
            scatter,
            format!("≥ {least}: {verdict}"),
            ratio("avx512", "median_ratio", "1"),
            cell(two),
            cell(cores),
            format!("≥ 1.8: {judged}"),
        ]);
    }
    let head = [
        "scene",
        "numbers",
        "baseline",
        "AVX2",
        "±%",
        "goal",
        "AVX-512",
        "two threads over one",
        "of plants alone",
        "goal",
    ];
    block("docs/ensembles.md", "ratios", &table(&head, &lines));
}
