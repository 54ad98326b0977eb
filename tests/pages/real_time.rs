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
