//! A scene and its variants as a table.
//!
//! `compared => lines of text, rows of a page`.

use dbd_plant::digits::significant;

use crate::variants::{AS_IT_IS, Compared};
use crate::words::{shown, times};

/// The columns with their units.
pub const HEADINGS: [(&str, &str); 9] = [
    ("model", ""),
    ("bodies", ""),
    ("elements", ""),
    ("differs", "m"),
    ("stable", "step"),
    ("advised", "step"),
    ("PC", "ns/step"),
    ("PC", "times as fast"),
    ("Cortex-M4F", "instr/step"),
];

/// Title of the table.
pub const TITLE: &str = "other models of the mechanism";

/// Explanation of the figures.
const FIGURES: &str = "the difference is the root mean square over common bodies and all samples; \
                       steps are for leapfrog: the largest stable one about the pose at t = 0 of the \
                       model in that row, and the advised one, which gives the speed-up";

/// Explanation of a variant and its option, by a part of its name.
const MAKES: [(&str, &str); 4] = [
    (
        "bushing",
        "bushing: joints built from bushings instead of TSDAs, equally stiff at t = 0, universal \
         joints without a spider; run it with --set realisation=bushing",
    ),
    (
        "planar",
        "planar: three degrees of freedom per body, in the plane; a step that is stable there may be \
         unstable out of the plane in space, where the stable step is that of the spatial model; run \
         it with --planar",
    ),
    (
        "spatial",
        "spatial: six degrees of freedom per body, three of them in the plane; run it with --set planar=false",
    ),
    (
        "stiff",
        "twice-as-stiff: every joint has twice its stiffness, in space; the difference shows how much \
         the motion depends on the stiffness that approximates a rigid joint",
    ),
];

/// Explanations of the table, one sentence each.
#[must_use]
pub fn meaning(compared: &[Compared]) -> Vec<&'static str> {
    let made = |make: &str| compared.iter().any(|one| one.name.split('-').any(|part| part == make));
    let makes = MAKES.iter().filter(|(make, _)| made(make)).map(|(_, text)| *text);
    makes.chain([FIGURES]).collect()
}

/// The rows, a cell per column.
#[must_use]
pub fn rows(compared: &[Compared]) -> Vec<[String; 9]> {
    let dash = || "–".to_owned();
    let first = compared.first().map_or(0.0, |own| own.host_seconds / own.step);
    let row = |one: &Compared| {
        let faster = first * one.step / one.host_seconds;
        let own = one.name == AS_IT_IS;
        let faster =
            if own || !(faster.is_finite() && faster > 0.0) { dash() } else { times(faster) };
        [
            match (own, one.planar) {
                (true, true) => format!("{AS_IT_IS}, planar"),
                (true, false) => format!("{AS_IT_IS}, spatial"),
                (false, _) => one.name.clone(),
            },
            one.bodies.to_string(),
            one.elements.to_string(),
            match one.difference {
                Some(_) if own => dash(),
                Some(difference) => format!("{difference:.1e}"),
                None => "does not run".into(),
            },
            one.stable_step.map_or_else(dash, shown),
            shown(one.step),
            significant(1e9 * one.host_seconds, 3),
            faster,
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
    let heads = [HEADINGS.map(|(name, _)| name), HEADINGS.map(|(_, unit)| unit)];
    let heads = heads.map(|line| line.map(str::to_owned));
    let all: Vec<[String; 9]> = heads.into_iter().chain(rows(compared)).collect();
    let widths: [usize; 9] = std::array::from_fn(|column| {
        all.iter().map(|row| row[column].chars().count()).max().unwrap_or(0)
    });
    let mut text = String::new();
    for row in &all {
        let cells =
            row.iter().zip(widths).enumerate().map(|(column, (cell, width))| match column {
                0 => format!("{cell:<width$}"),
                _ => format!("{cell:>width$}"),
            });
        text += &format!("{}\n", cells.collect::<Vec<_>>().join("  ").trim_end());
    }
    text
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_variant_stands_beside_the_scene_with_what_it_saves() {
        let own = Compared {
            name: AS_IT_IS.into(),
            planar: false,
            bodies: 3,
            elements: 12,
            difference: Some(0.0),
            stable_step: Some(1.25e-5),
            step: 1e-5,
            host_seconds: 1e-6,
            target_instructions: None,
        };
        let bushing = Compared {
            name: "bushing".into(),
            planar: false,
            bodies: 2,
            elements: 1,
            difference: Some(2e-5),
            stable_step: None,
            step: 4e-5,
            host_seconds: 5e-7,
            target_instructions: Some(2345.0),
        };
        let said = text(&[own.clone(), bushing.clone()]);
        for part in ["as it is, spatial", "2.0e-5", "12.5us", "40us", " 8  ", "2345"] {
            assert!(said.contains(part), "{part}: {said}");
        }
        let meant =
            |name: &str| meaning(&[own.clone(), Compared { name: name.into(), ..own.clone() }]);
        assert!(meant("bushing")[0].contains("--set realisation=bushing"));
        assert_eq!((meant("bushing").len(), meant("planar-bushing").len()), (2, 3));
        assert!(meant("planar")[0].contains("--planar"));
        let stopped = rows(&[own.clone(), Compared { difference: None, ..own }]);
        assert_eq!(stopped[1][3], "does not run");
        assert_eq!(super::text(&[]), "");
    }
}
