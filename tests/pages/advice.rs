//! The table of docs/advise.md.

use dbd_study::recommend::MCUS;
use dbd_tests::page::{block, figure, table};

#[test]
fn microcontrollers_are_those_of_the_program() {
    let mcus: Vec<Vec<String>> = MCUS
        .iter()
        .map(|mcu| {
            let factor = |row: usize| figure(mcu.factors[row], 3);
            let clock = format!("{} MHz", mcu.clock * 1e-6);
            let name = format!("`{}`", mcu.name);
            let basis = mcu.basis.to_owned();
            vec![name, clock, mcu.cycles.to_string(), factor(0), factor(1), factor(2), basis]
        })
        .collect();
    let head = [
        "`--mcu`",
        "usual clock",
        "cycles per instruction (estimated)",
        "instructions over Cortex-M4F: f32",
        "fixed",
        "f64",
        "basis",
    ];
    block("docs/advise.md", "microcontrollers", &table(&head, &mcus));
}
