//! The figures of `docs/real-time.md`: what a step is made of, what it costs, and what that reaches.

use dbd_tests::page::{block, figure, grouped, table};
use dbd_tests::results::{cost, rows};
use dbd_tests::scene;

/// From one body to closed loops, then suspensions.
const SHOWN: [&str; 8] = [
    "gyroscope",
    "four-bar",
    "six-bar",
    "3rrr",
    "3ruu",
    "hanging-chain",
    "cart-pendulum",
    "double-wishbone",
];

#[test]
fn what_a_step_needs_is_as_counted() {
    let lines = SHOWN.map(|name| {
        let scene = scene(name);
        let (facts, cost) = (dbd_scene::facts(&scene), cost(name, "leapfrog", "f32"));
        let (instructions, tsdas) = (cost.number("instructions_mean"), scene.model.tsda_count());
        let (rate, step) = (cost.number("estimated_rate_168mhz_hz"), cost.number("step_s"));
        vec![
            format!("`{name}`"),
            format!("{} / {tsdas}", scene.model.bodies.len()),
            format!("{} / {}", facts.equations, facts.constraint_equations),
            grouped(cost.text("instructions_mean")),
            figure(instructions / tsdas as f64, 2),
            figure(1e-3 / step, 2),
            figure(1e-3 * rate, 2),
            figure(rate * step, 2),
        ]
    });
    let head = [
        "leapfrog, f32",
        "bodies / TSDAs",
        "equations here / with constraints",
        "instructions per step",
        "per TSDA",
        "its step at [kHz]",
        "reaches [kHz]",
        "of real time",
    ];
    block("docs/real-time.md", "steps", &table(&head, &lines));
}

#[test]
fn what_a_solved_system_costs_is_as_measured() {
    let all = rows("docs/results/timing.csv");
    let lines = ["four-bar", "six-bar", "3rrr", "crank-slider", "3ruu"].map(|name| {
        let time = |scheme: &str| {
            let wanted = [("scene", name), ("scheme", scheme), ("precision", "f64")];
            all.iter().find(|row| row.is(&wanted)).unwrap().number("ns_per_step")
        };
        let explicit = time("std leapfrog");
        let implicit = time("std linearly implicit Euler");
        let shown = |time: f64| grouped(&format!("{time:.0}"));
        let ratio = format!("{} ×", figure(implicit / explicit, 2));
        vec![format!("`{name}`"), shown(explicit), shown(implicit), ratio]
    });
    let head = ["ns per step, std, f64", "leapfrog", "linearly implicit Euler", "ratio"];
    block("docs/real-time.md", "jacobian", &table(&head, &lines));
}

/// Microcontrollers and rates of the table of configurations.
const MCUS: [(&str, &str); 2] =
    [("cortex-m4f", "M4F, 168 MHz"), ("cortex-m7-double", "M7, 480 MHz")];
const RATES: [&str; 3] = ["1000", "4000", "10000"];

#[test]
fn what_keeps_up_is_as_advised() {
    let all = rows("docs/results/real-time.csv");
    let mut scenes: Vec<&str> = all.iter().map(|row| row.text("scene")).collect();
    scenes.dedup();
    let cell = |scene: &str, mcu: &str, rate: &str| {
        let wanted = [("scene", scene), ("mcu", mcu), ("rate_hz", rate)];
        let row = all.iter().find(|row| row.is(&wanted)).unwrap();
        let of = |column: &str| row.text(column).to_owned();
        let model = Some(of("model")).filter(|model| model != "as it is");
        let damping = Some(of("damping")).filter(|damping| !damping.is_empty());
        let names = [model, Some(of("scheme")), damping, Some(of("precision"))];
        let names = names.into_iter().flatten().collect::<Vec<_>>().join(", ");
        let (step, load) = (1e6 * row.number("step_s"), 100.0 * row.number("load"));
        let load = format!("{} %", figure(load, 2));
        let load = if row.number("load") > 1.0 { format!("**{load}**") } else { load };
        format!("{names}, {} µs: {load}", figure(step, 3))
    };
    let lines: Vec<Vec<String>> = scenes
        .iter()
        .flat_map(|scene| {
            MCUS.map(|(mcu, called)| {
                let cells = RATES.map(|rate| cell(scene, mcu, rate));
                [vec![format!("`{scene}`"), called.to_owned()], cells.to_vec()].concat()
            })
        })
        .collect();
    let head = ["scene", "core", "1 kHz", "4 kHz", "10 kHz"];
    block("docs/real-time.md", "configurations", &table(&head, &lines));
}

/// What each core has in hardware.
const CORES: [(&str, &str, &str); 5] = [
    ("cortex-m4f", "f32", "M4F, f32"),
    ("cortex-m33", "f32", "M33, f32"),
    ("rv32imafc", "f32", "RV32IMAFC, f32"),
    ("cortex-m7", "f32", "M7, f32"),
    ("cortex-m7", "f64", "M7, f64"),
];

#[test]
fn steps_on_other_cores_are_as_counted() {
    let all = rows("docs/results/cores.csv");
    let mut scenes: Vec<&str> = all.iter().map(|row| row.text("scene")).collect();
    scenes.sort_unstable();
    scenes.dedup();
    let lines: Vec<Vec<String>> = scenes
        .into_iter()
        .map(|scene| {
            let count = |(core, precision, _): (&str, &str, &str)| {
                let wanted = [("scene", scene), ("core", core), ("precision", precision)];
                grouped(all.iter().find(|row| row.is(&wanted)).unwrap().text("instructions_mean"))
            };
            [vec![format!("`{scene}`")], CORES.map(count).to_vec()].concat()
        })
        .collect();
    let head = [&["leapfrog"], &CORES.map(|(.., called)| called)[..]].concat();
    block("docs/target.md", "cores", &table(&head, &lines));
}
