//! The same files, compared as a firmware does: no recording, no allocation, names as constants, the
//! file's text in the program.
#![allow(clippy::result_large_err, reason = "once a test")]

use dbd_golden::{Bands, Comparison, Golden, Head, Mismatch, Recorder, Subject as _, Tolerance};
use dbd_kernel::readouts::Reading;
use dbd_kernel::{F32, F64, Geometry, Leapfrog, Scheme};
use dbd_tests::scene;

use crate::trajectories::{Owned, balance, plant};

const FOUR_BAR: &str = include_str!("four-bar.golden");
const BALANCE: &[u8] = include_bytes!("balance.golden");

fn compared<P: Geometry, S: Scheme>(
    scheme: S,
    tolerance: Tolerance<'static>,
) -> Result<u64, Mismatch<&'static str>> {
    let mut plant: Owned<P, S> = plant("four-bar", scheme);
    let (identity, bodies) = (plant.identity(), &["crank", "coupler", "rocker"]);
    let head = Head { scene: "four-bar", identity, every: 100, bodies, values: &[] };
    let mut comparison = Comparison::new(Golden::read(FOUR_BAR)?, head, tolerance)?;
    while let Some(due) = comparison.due() {
        plant.advance(due - plant.state().step).unwrap();
        comparison.sample(&plant, &[])?;
    }
    comparison.finish().map(|summary| summary.samples)
}

#[test]
fn a_linkage_keeps_its_bits_without_std() {
    assert_eq!(compared::<F32, _>(Leapfrog, Tolerance::Bits), Ok(51));
    assert_eq!(compared::<F64, _>(Leapfrog, Tolerance::AnyMethod(Bands::all(0.2))), Ok(51));
    let refused = compared::<F64, _>(Leapfrog, Tolerance::Bits);
    assert!(matches!(refused, Err(Mismatch::Precision { .. })));
}

#[test]
fn a_controlled_plant_keeps_its_bits_without_std() {
    let mut plant: Owned<F32, _> = plant("cart-pendulum", Leapfrog);
    let cart = scene("cart-pendulum");
    // In a firmware these are constants of the exported scene.
    let angle = cart.readout("angle").unwrap().convert();
    let (identity, bodies, values) = (plant.identity(), &["cart", "pendulum"], &["angle", "drive"]);
    let head = Head { scene: "cart-pendulum", identity, every: 120, bodies, values };
    let golden = Golden::of_bytes(BALANCE).unwrap();
    let mut comparison = Comparison::new(golden, head, Tolerance::Bits).unwrap();
    let mut printed = Recorder::begin(String::new(), &head).unwrap();
    balance(&mut plant, |plant| {
        let seen = plant.read(&angle).and_then(Reading::scalar).unwrap();
        let values = [seen, plant.state().signals[0].value].map(f64::from);
        comparison.look(plant, &values).unwrap();
        printed.look(plant, &values).unwrap();
    });
    assert_eq!(comparison.finish().unwrap().samples, 51);
    assert_eq!(printed.finish().unwrap().as_bytes(), BALANCE);
}
