//! A model is built at run time, without an allocator, and a controller drives it:
//! `cargo run --example lift --features heapless`.

use std::error::Error;

use dbd_kernel::builder::ModelBuilder;
use dbd_kernel::elements::input::InputKind;
use dbd_kernel::readouts::Readout;
use dbd_kernel::{BodyIndex, BodyState, F32, Leapfrog, LoadFrame, Plant, Vec3};

/// Room for one body, one spring with its two points, and one input.
type Lift = ModelBuilder<F32, 1, 1, 2, 1, 0, 0, 0, 0, 0, 1>;

const MASS: f64 = 2.0;
const TARGET: f64 = 0.3;

/// A weight on a soft spring, and a force that can lift it.
fn lift() -> Result<Lift, Box<dyn Error>> {
    let mut model = Lift::new();
    model.set_gravity([0.0, -9.81, 0.0])?;
    let start = BodyState::from_f64([0.0; 3], [1.0, 0.0, 0.0, 0.0], [0.0; 3], [0.0; 3]);
    let body = model.add_body(MASS, [0.01; 3], start)?;
    let points = [[0.0, -0.2, 0.0], [0.0; 3]];
    model.add_tsda([BodyIndex::WORLD, body], points, 20.0, 0.0, 0.2)?;
    let direction = Vec3::from_f64([0.0, 1.0, 0.0]);
    let force = InputKind::Force { body, point: Vec3::ZERO, direction, frame: LoadFrame::World };
    model.add_input(force, 0.0)?;
    Ok(model)
}

/// How far \[m\] the weight is from where it should be, after 3 s.
pub fn off_target() -> Result<f64, Box<dyn Error>> {
    let model = lift()?;
    let mut plant = Plant::new(&model, Leapfrog, 1e-4)?;
    let point = Readout::Point { body: BodyIndex(0), point: Vec3::ZERO };
    let speed = Readout::PointVelocity { body: BodyIndex(0), point: Vec3::ZERO };
    let y = |plant: &Plant<&Lift, Leapfrog>, readout| {
        plant
            .read(readout)
            .and_then(|reading| reading.vector())
            .map(|v| f64::from(v.y))
            .ok_or("blind")
    };
    for _ in 0..3_000 {
        let (gap, rate) = (TARGET - y(&plant, &point)?, y(&plant, &speed)?);
        // The spring and the weight are known; what is off pulls with 200 N/m, damped.
        let force = MASS * 9.81 + 20.0 * TARGET + 200.0 * gap - 40.0 * rate;
        plant.set_input(dbd_kernel::InputIndex(0), force)?;
        plant.advance(10)?;
    }
    Ok((y(&plant, &point)? - TARGET).abs())
}

fn main() -> Result<(), Box<dyn Error>> {
    println!("{:.1e} m from its target of {TARGET} m", off_target()?);
    Ok(())
}
