//! A scene beside its variants as a table.
//!
//! `compared => lines of text, rows of a page`.

use dbd_plant::digits::significant;

use crate::variants::Compared;
use crate::words::{shown, times};

/// The columns, each with its unit.
pub const HEADINGS: [(&str, &str); 8] = [
    ("joints", ""),
    ("bodies", ""),
    ("elements", ""),
    ("differs by", "m"),
    ("step", ""),
    ("PC", "ns/step"),
    ("PC", "core s/s"),
    ("Cortex-M4F", "instr/step"),
];

/// What the table says, in words.
pub const MEANING: &str = "joints of bushings in place of TSDAs: as stiff at t = 0, no universal joint has a \
     spider; run them with --set realisation=bushing. The difference is root mean square over the bodies \
     that both have and all samples; the step is the largest advised one of leapfrog, which takes the times";

/// The rows, a cell per column.
#[must_use]
pub fn rows(compared: &[Compared]) -> Vec<[String; 8]> {
    let dash = || "–".to_owned();
    let first = compared.first().map_or(0.0, |own| own.host_seconds / own.step);
    let row = |one: &Compared| {
        let cost = one.host_seconds / one.step;
        let faster = first / cost;
        let cost = match (cost.is_finite(), one.difference == Some(0.0)) {
            (false, _) => dash(),
            (true, true) => significant(cost, 3),
            (true, false) => format!("{}: {} × as fast", significant(cost, 3), times(faster)),
        };
        [
            one.name.clone(),
            one.bodies.to_string(),
            one.elements.to_string(),
            match one.difference {
                Some(0.0) => dash(),
                Some(difference) => format!("{difference:.1e}"),
                None => "does not run".into(),
            },
            shown(one.step),
            significant(1e9 * one.host_seconds, 3),
            cost,
            one.target_instructions.map_or_else(dash, |count| significant(count, 5)),
        ]
    };
    compared.iter().map(row).collect()
}

/// The table for a terminal; nothing where there are no variants.
#[must_use]
pub fn text(compared: &[Compared]) -> String {
    if compared.is_empty() {
        return String::new();
    }
    let heads = HEADINGS.map(|(name, unit)| match unit {
        "" => name.to_owned(),
        unit => format!("{name} [{unit}]"),
    });
    let all: Vec<[String; 8]> = std::iter::once(heads).chain(rows(compared)).collect();
    let widths: [usize; 8] = std::array::from_fn(|column| {
        all.iter().map(|row| row[column].chars().count()).max().unwrap_or(0)
    });
    let mut text = String::from("\njoints of another make\n");
    for row in &all {
        let cells = row.iter().zip(widths).map(|(cell, width)| format!("{cell:<width$}"));
        text += &format!("{}\n", cells.collect::<Vec<_>>().join("  ").trim_end());
    }
    text + &format!("{MEANING}\n")
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_variant_stands_beside_the_scene_with_what_it_saves() {
        let own = Compared {
            name: "as it is".into(),
            bodies: 3,
            elements: 12,
            difference: Some(0.0),
            step: 1e-5,
            host_seconds: 1e-6,
            target_instructions: None,
        };
        let bushing = Compared {
            name: "bushing".into(),
            bodies: 2,
            elements: 1,
            difference: Some(2e-5),
            step: 4e-5,
            host_seconds: 5e-7,
            target_instructions: Some(2345.0),
        };
        let text = text(&[own.clone(), bushing]);
        for part in
            ["as it is", "2.0e-5", "40us", "8 × as fast", "2345", "--set realisation=bushing"]
        {
            assert!(text.contains(part), "{part}: {text}");
        }
        let stopped = rows(&[own.clone(), Compared { difference: None, ..own }]);
        assert_eq!(stopped[1][3], "does not run");
        assert_eq!(super::text(&[]), "");
    }
}
