//! A mechanism as other models: the table of docs/trade.md.

use dbd_plant::digits::{approximate, significant};
use dbd_study::costs::Costs;
use dbd_study::grid::Grid;
use dbd_study::variants::{STIFFER, compare};
use dbd_tests::{page, scene};

/// Planar linkages, one of links in space, and what has dampers.
const SCENES: [&str; 6] =
    ["hexagon", "four-bar", "six-bar", "3ruu", "double-wishbone", "cart-pendulum"];

/// \[s\] over which motions are compared.
const WINDOW: f64 = 0.2;

#[test]
fn the_page_says_what_other_models_of_a_mechanism_come_to() {
    let mut table = "| scene | model | bodies | elements | differs by \\[m\\] | stable step | over the scene's |\n\
                     |---|---|---|---|---|---|---|\n"
        .to_owned();
    for name in SCENES {
        let scene = scene(name);
        let all = compare(&scene, &Grid::new(1e-3, WINDOW), &Costs::none(), &|_| None);
        let own = all[0].stable_step.unwrap();
        for one in &all {
            let step = one.stable_step.unwrap();
            let difference = one.difference.unwrap();
            // What is faster is so without another motion; 3ruu's spiders weigh something.
            let alike = one.name != STIFFER && name != "3ruu";
            assert!(difference < 1e-3 || !alike, "{name}, {}: {difference:e}", one.name);
            table += &format!(
                "| {name} | {} | {} | {} | {} | {} | {} |\n",
                if one == &all[0] { "spatial, TSDAs" } else { &one.name },
                one.bodies,
                one.elements,
                if one == &all[0] { "–".into() } else { format!("{difference:.0e}") },
                approximate((step * 1e7).round() * 1e-7),
                significant(step / own, 2),
            );
        }
    }
    page::block("docs/trade.md", "models", &table);
}
