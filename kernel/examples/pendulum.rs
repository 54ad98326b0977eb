//! A model written by hand, const and in flash, is stepped and read: `cargo run --example pendulum`.

use std::error::Error;

use dbd_kernel::model_spec::{ModelSpec, Spring, Start};
use dbd_kernel::readouts::Readout;
use dbd_kernel::{BodyIndex, F64, Leapfrog, Plant, Vec3, model};

/// A rod of 1 m and 1 kg hangs on a revolute joint about z and swings off with 0.1 rad/s.
const ROD: Start = Start {
    velocity: [0.05, 0.0, 0.0],
    angular_velocity: [0.0, 0.0, 0.1],
    ..Start::at([0.0, -0.5, 0.0])
};

/// Two points on the axis, each held by springs to three on a ring of the rod's: a revolute joint.
const AXIS: [[f64; 3]; 2] = [[0.0, 0.0, -0.1], [0.0, 0.0, 0.1]];
const RING: [[f64; 3]; 3] =
    [[0.1, 0.5, 0.0], [-0.05, 0.586_602_54, 0.0], [-0.05, 0.413_397_46, 0.0]];
const SPRING: Spring = Spring { stiffness: 1e5, damping: 0.0, free_length: 0.141_421_356 };

const PENDULUM: ModelSpec = ModelSpec::new()
    .gravity([0.0, -9.81, 0.0])
    .body(1.0, [1.0 / 12.0, 1e-3, 1.0 / 12.0], ROD)
    .triples([BodyIndex::WORLD, BodyIndex(0)], &AXIS, &RING, SPRING);

model!(static MODEL: F64 = PENDULUM);

/// The period \[s\] of its small swings, from the times at which its lower end passes the middle.
pub fn period() -> Result<f64, Box<dyn Error>> {
    let mut plant = Plant::new(&MODEL, Leapfrog, 1e-4)?;
    let endpoint: Readout<F64> =
        Readout::Point { body: BodyIndex(0), point: Vec3::new(0.0, -0.5, 0.0) };
    let (mut before, mut passed) = (0.0, Vec::new());
    while passed.len() < 11 {
        plant.step()?;
        let x =
            plant.read(&endpoint).and_then(|reading| reading.vector()).ok_or("no such point")?.x;
        if before < 0.0 && x >= 0.0 {
            // Between two steps it moves evenly.
            passed.push(plant.time() - plant.step_size() * x / (x - before));
        }
        before = x;
    }
    Ok((passed[10] - passed[0]) / 10.0)
}

/// The same of a rigid rod on an ideal joint: 2π·√(2L/3g).
pub fn theory() -> f64 {
    std::f64::consts::TAU * (2.0_f64 / (3.0 * 9.81)).sqrt()
}

fn main() -> Result<(), Box<dyn Error>> {
    println!("period {:.5} s, of a rigid rod {:.5} s", period()?, theory());
    Ok(())
}
