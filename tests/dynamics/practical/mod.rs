//! Scenes of machines that one meets do what such machines do; docs/measured.md shows how well.

mod driven;
mod machines;
mod suspension;

use std::sync::OnceLock;

use dbd_tests::page::{block, table};
use dbd_tests::scene;

/// Each scene's test: asserts and says what it has shown, computed once however many ask.
macro_rules! shown {
    ($($test:ident: $scene:literal, $shown:path;)*) => {
        const SCENES: &[(&str, fn() -> &'static str)] = &[$(($scene, $test::shown)),*];

        $(mod $test {
            use super::*;

            pub fn shown() -> &'static str {
                static SHOWN: OnceLock<String> = OnceLock::new();
                SHOWN.get_or_init($shown)
            }

            #[test]
            fn test() {
                assert!(!shown().is_empty());
            }
        })*
    };
}

shown! {
    the_macpherson_axle_vibrates_where_the_paper_says: "macpherson", suspension::macpherson;
    the_wheel_hops_after_the_step_as_its_mode_does: "double-wishbone", suspension::hop;
    the_delta_picks_and_places: "delta-pick-and-place", driven::delta;
    the_gripper_closes_on_the_block_and_lets_go: "gripper", driven::gripper;
    the_undriven_cart_and_pendulum_fall_as_ideal_ones: "cart-pendulum", machines::falling;
    the_gyroscope_precesses_as_theory_says: "gyroscope", machines::gyroscope;
    the_chain_swings_with_the_period_of_its_first_mode: "hanging-chain", machines::chain;
}

#[test]
fn the_page_shows_what_was_shown() {
    let rows = SCENES.iter().map(|(name, shown)| {
        let scene = scene(name);
        let (bodies, tsdas) = (scene.model.bodies.len(), scene.model.tsda_count());
        let step = scene.step.unwrap();
        let size = format!("{bodies} / {tsdas}, {} µs", (1e8 * step).round() / 100.0);
        vec![format!("`{name}`"), size, shown().to_owned()]
    });
    let rows: Vec<_> = rows.collect();
    block(
        "docs/measured.md",
        "practical",
        &table(&["scene", "bodies / TSDAs, step", "shown"], &rows),
    );
}
