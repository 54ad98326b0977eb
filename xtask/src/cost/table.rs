//! Costs as a table for people.

use std::fmt::Write as _;

use super::mix::Mix;
use super::row::Cost;

/// The rows of the named scenes, or all where none is named.
pub fn table(costs: &[Cost], mixes: &[Mix], scenes: &[String]) -> String {
    let mut text = format!(
        "{:<16} {:<28} {:<5} {:>9} {:>9} {:>8} {:>8} {:>6} {:>6} {:>10} {:>5} {:>17}\n",
        "scene",
        "scheme",
        "real",
        "instr/step",
        "max",
        ".text",
        ".rodata",
        "RAM",
        "stack",
        "rate*",
        "fp",
        "cycles**"
    );
    let rows = costs.iter().zip(mixes);
    for (c, mix) in rows.filter(|(c, _)| scenes.is_empty() || scenes.contains(&c.scene)) {
        let [least, most] = mix.cycles();
        let _ = writeln!(
            text,
            "{:<16} {:<28} {:<5} {:>10} {:>9} {:>8} {:>8} {:>6} {:>6} {:>7} Hz {:>3.0} % {:>17}",
            c.scene,
            c.scheme,
            c.precision,
            c.mean,
            c.max,
            c.text.map_or("-".to_owned(), |bytes| bytes.to_string()),
            c.model,
            c.plant,
            c.stack,
            c.rate(),
            100.0 * mix.arithmetic(),
            format!("{least}-{most}")
        );
    }
    text + "* an estimate: 168 MHz, 1.5 cycles per instruction, memory without wait states\n\
            ** an estimate: by the manual's table of cycles, memory without wait states"
}
