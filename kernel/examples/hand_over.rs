//! A run goes on elsewhere, bit for bit: `cargo run --example hand_over`.
//!
//! The bytes of a snapshot are the same on a PC and on a Cortex-M4F, so that a run may begin on one and end on the
//! other: `cargo xtask test` does that in QEMU.

use std::error::Error;

use dbd_kernel::model_spec::{ModelSpec, Spring, Start};
use dbd_kernel::{BodyIndex, Leapfrog, Plant, model};

// Two balls on springs, single precision as on the chip.
const SPRING: Spring = Spring { stiffness: 300.0, damping: 0.1, free_length: 0.4 };
const FIRST: BodyIndex = BodyIndex(0);
const SECOND: BodyIndex = BodyIndex(1);
const MODEL_SPEC: ModelSpec = ModelSpec::new()
    .gravity([0.0, -9.81, 0.0])
    .body(0.5, [1e-3; 3], Start::at([0.5, 0.0, 0.0]))
    .body(0.2, [1e-3; 3], Start::at([0.5, -0.5, 0.1]))
    .tsda([BodyIndex::WORLD, FIRST], [[0.0; 3], [0.0, 0.05, 0.0]], SPRING)
    .tsda([FIRST, SECOND], [[0.0, -0.05, 0.0], [0.0; 3]], SPRING);
model!(static BALLS: F32 = MODEL_SPEC);

/// The state's hash after 4,000 steps in one go, and with a change of plants half way.
pub fn hashes() -> Result<[u64; 2], Box<dyn Error>> {
    let mut whole = Plant::new(&BALLS, Leapfrog, 5e-4)?;
    whole.advance(4_000)?;

    let mut here = Plant::new(&BALLS, Leapfrog, 5e-4)?;
    here.advance(2_000)?;
    let mut bytes = [0; 512];
    let length = here.snapshot(&mut bytes)?;

    // Elsewhere: the same model, scheme and step; anything else is refused.
    let mut there = Plant::new(&BALLS, Leapfrog, 5e-4)?;
    there.restore(&bytes[..length])?;
    there.advance(2_000)?;
    Ok([whole.hash(), there.hash()])
}

fn main() -> Result<(), Box<dyn Error>> {
    let [whole, handed] = hashes()?;
    println!("in one go {whole:016x}, handed over {handed:016x}");
    Ok(())
}
