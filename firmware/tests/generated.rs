//! Generated models in a crate that uses one of them: the others cost no warning, whatever lint
//! level the crate has.
#![deny(warnings)]

// In a module of its own and not public, as in a program.
mod models {
    include!(concat!(env!("OUT_DIR"), "/models.rs"));
}

use dbd_kernel::{Leapfrog, Plant};
use models::four_bar::{FOUR_BAR_F32, FOUR_BAR_STEP};

#[test]
fn a_program_that_uses_one_model_compiles_without_a_warning() {
    let mut plant = Plant::new(&FOUR_BAR_F32, Leapfrog, FOUR_BAR_STEP).unwrap();
    assert!(plant.step().is_running());
}
