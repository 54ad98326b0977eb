//! Tables of the pages that are rendered from results in files: times, choices and counts, which
//! no test can repeat in a moment.

mod advice;
mod bench;
mod book;
mod chip;
mod collect;
mod pictures;
mod proof;
mod real_time;
mod speed;
mod words;

use dbd_tests::page::{block, figure, grouped, table};
use dbd_tests::results::{Row, cost, rows};
use dbd_tests::{scene, scene_names};

/// The README's first command names no program: there is one to choose from.
#[test]
fn cargo_run_has_one_program() {
    let root = concat!(env!("CARGO_MANIFEST_DIR"), "/../Cargo.toml");
    let metadata = ["metadata", "--no-deps", "--offline", "--format-version", "1"];
    let mut cargo = std::process::Command::new(env!("CARGO"));
    let done = cargo.args(metadata).args(["--manifest-path", root]).output().unwrap();
    let metadata: serde_json::Value = serde_json::from_slice(&done.stdout).unwrap();
    let default = metadata["workspace_default_members"].as_array().unwrap();
    let packages = metadata["packages"].as_array().unwrap().iter();
    let packages = packages.filter(|package| default.contains(&package["id"]));
    let targets = packages.flat_map(|package| package["targets"].as_array().unwrap());
    let programs = targets.filter(|target| target["kind"][0] == "bin");
    assert_eq!(programs.map(|target| &target["name"]).collect::<Vec<_>>(), ["host-sim"]);
}

/// The mechanisms of the tables in docs/measured.md.
const SHOWN: [&str; 5] = ["four-bar", "six-bar", "3rrr", "crank-slider", "3ruu"];

const ACCURACIES: [&str; 4] = ["1e-4", "1e-5", "1e-6", "1e-7"];

/// A choice in words, and by how much more the paper's scheme costs.
fn choice(row: &Row) -> String {
    let (scheme, precision) = (row.text("scheme"), row.text("precision"));
    let ratio = || grouped(row.text("ratio"));
    let far = match row.text("known") {
        "measured" => format!("{} ×", ratio()),
        "extrapolated" => format!("{} × *", ratio()),
        "beyond" => format!("> {} ×", ratio()),
        "at-largest-step" => format!("≤ {} ×", ratio()),
        "itself" => "itself".into(),
        "never" => return "–".into(),
        other => panic!("{other}: {row:?}"),
    };
    // On the target the paper's scheme is meant in f32 unless it is said not to be.
    let soft = row.text("machine") != "pc" && row.text("paper") == "f64";
    format!("{scheme} {precision}, {far}{}", if soft { " (f64)" } else { "" })
}

/// The choices of all scenes on a machine.
fn choices(machine: &str) -> String {
    let all = rows("docs/results/trade.csv");
    let of = |row: &&Row| row.text("machine") == machine;
    let mut lines: Vec<Vec<String>> = Vec::new();
    for row in all.iter().filter(of) {
        let name = row.text("scene");
        if lines.last().is_none_or(|line| line[0] != name) {
            lines.push(vec![name.to_owned(), format!("{} s", row.text("window_s"))]);
        }
        let line = lines.last_mut().unwrap();
        let place = line.len() - 2;
        assert_eq!(row.text("accuracy_m"), ACCURACIES[place], "{row:?}");
        line.push(choice(row));
    }
    assert!(!lines.is_empty());
    let accuracies = ACCURACIES.map(|accuracy| format!("{accuracy} m"));
    let mut head = vec!["`host-sim trade`", "window"];
    head.extend(accuracies.iter().map(String::as_str));
    table(&head, &lines)
}

#[test]
fn what_to_choose_is_as_surveyed() {
    collect::collect();
    block("docs/trade.md", "pc", &choices("pc"));
    block("docs/trade.md", "cortex-m4f", &choices("cortex-m4f"));
}

fn line(title: &str, cell: impl Fn(&str) -> String) -> Vec<String> {
    [title.to_owned()].into_iter().chain(SHOWN.map(cell)).collect()
}

#[test]
fn times_are_as_measured() {
    collect::collect();
    let mut lines = vec![line("bodies / TSDAs", |name| {
        let model = scene(name).model;
        format!("{} / {}", model.bodies.len(), model.tsda_count())
    })];
    let all = rows("docs/results/timing.csv");
    for (scheme, precision, note) in [
        ("leapfrog", "f64", ""),
        ("leapfrog", "f32", ""),
        ("pefrl", "f64", " (four evaluations)"),
        ("dbd", "f64", " (three evaluations)"),
        ("std leapfrog", "f64", ""),
        ("std linearly implicit Euler", "f64", ""),
    ] {
        lines.push(line(&format!("{scheme}, {precision}{note}"), |name| {
            let wanted = [("scene", name), ("scheme", scheme), ("precision", precision)];
            let row = all.iter().find(|row| row.is(&wanted)).unwrap();
            grouped(row.text("ns_per_step"))
        }));
    }
    block("docs/measured.md", "times", &table(&[&["ns per step"], &SHOWN[..]].concat(), &lines));
}

#[test]
fn counts_are_those_of_the_costs() {
    let of = |name: &str| cost(name, "leapfrog", "f32");
    let bytes = |name: &str| {
        let columns = ["text_bytes", "rodata_bytes", "plant_ram_bytes", "stack_bytes"];
        columns.map(|column| grouped(of(name).text(column))).join(" / ")
    };
    let rate = |name: &str| format!("{:.0} kHz", of(name).number("estimated_rate_168mhz_hz") / 1e3);
    let own = |name: &str| format!("{} kHz", figure(1e-3 / of(name).number("step_s"), 2));
    let lines = [
        line("instructions per step", |name| grouped(of(name).text("instructions_mean"))),
        line("code / model / plant / stack, bytes", bytes),
        line("highest rate at 168 MHz, an estimate", rate),
        line("at the scene's own step", own),
    ];
    block("docs/measured.md", "counts", &table(&[&["leapfrog, f32"], &SHOWN[..]].concat(), &lines));

    let counted = rows("docs/costs.csv");
    let all = scene_names().into_iter().filter_map(|name| {
        let wanted = [("scene", name.as_str()), ("scheme", "leapfrog"), ("precision", "f32")];
        let row = counted.iter().find(|row| row.is(&wanted))?;
        let (rate, own) = (row.number("estimated_rate_168mhz_hz"), 1.0 / row.number("step_s"));
        let khz = |rate: f64| figure(rate / 1e3, 2);
        Some(vec![format!("`{name}`"), khz(own), khz(rate)])
    });
    let head = ["leapfrog, f32", "its step at [kHz]", "reaches [kHz]"];
    block("docs/trade.md", "real time", &table(&head, &all.collect::<Vec<_>>()));
}

/// How much dearer double precision is, over all methods of each scene that was counted with all; but for
/// generalized-alpha-3, of which a few models of each precision were counted.
#[test]
fn soft_floating_point_is_as_dear_as_counted() {
    let counted = rows("docs/costs.csv");
    let mut lines: Vec<Vec<String>> = Vec::new();
    for name in scene_names() {
        let of = |precision: &str| {
            let wanted = [("scene", name.as_str()), ("precision", precision)];
            let of_all = |row: &&Row| row.text("scheme") != "generalized-alpha-3";
            counted.iter().filter(move |row| row.is(&wanted)).filter(of_all).collect::<Vec<_>>()
        };
        let (single, double) = (of("f32"), of("f64"));
        if double.is_empty() {
            continue;
        }
        let count = |row: &Row| row.number("instructions_mean");
        let ratios: Vec<f64> = double
            .iter()
            .filter_map(|row| {
                let same =
                    single.iter().find(|other| other.text("scheme") == row.text("scheme"))?;
                Some(count(row) / count(same))
            })
            .collect();
        let least = ratios.iter().copied().fold(f64::INFINITY, f64::min);
        let most = ratios.iter().copied().fold(0.0, f64::max);
        assert!(least > 1.0 && ratios.len() == double.len(), "{name}: {ratios:?}");
        let methods = single.len() + double.len();
        lines.push(vec![name, format!("{methods}"), format!("{least:.0} to {most:.0}")]);
    }
    let head = ["scene", "methods counted", "instructions in f64 over those in f32"];
    block("docs/trade.md", "soft", &table(&head, &lines));
}

/// What the dampers of a step cost on the target, by the two ways of stepping one scheme.
#[test]
fn the_cost_of_sweeps_is_that_of_the_costs() {
    let scene_name = "double-wishbone";
    let count = |scheme: &str| cost(scene_name, scheme, "f32").number("instructions_mean");
    let dampers = scene(scene_name).model.dampers.len() as f64;
    let euler = count("semi-implicit-euler-explicit");
    let sweeps = count("leapfrog") - euler;
    let rows = [
        ("leapfrog, sweeps: one evaluation, two sweeps", count("leapfrog")),
        ("leapfrog, explicit: two evaluations", count("leapfrog-explicit")),
        ("semi-implicit-euler, explicit: one evaluation", euler),
        ("dbd, explicit: three evaluations", count("dbd")),
        ("two sweeps: the first less the third", sweeps),
        ("one damper in one sweep", sweeps / (2.0 * dampers)),
    ];
    let rows = rows.map(|(what, count)| vec![what.to_owned(), figure(count, 3)]);
    block(
        "docs/schemes-measured.md",
        "sweeps",
        &table(&["double-wishbone, f32", "instructions"], &rows),
    );
}
