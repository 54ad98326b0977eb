//! A controller balances the scene `balance-robot` while it is pushed: `cargo run --release --example balance_robot`.

#[path = "../../docs/examples/balance-robot/controller.rs"]
pub mod controller;

use std::error::Error;

use controller::{MOTORS, STATES, voltages};
use dbd_plant::instance::{Blueprint, Instance, Settings};

/// The scene's text.
const SCENE: &str = include_str!("../../docs/examples/balance-robot/balance-robot.toml");

/// Balances for so many milliseconds, by the method of a project that `host-sim new firmware` writes; `look` sees each.
pub fn balance(
    precision: &str,
    milliseconds: u64,
    mut look: impl FnMut(&Instance),
) -> Result<(), Box<dyn Error>> {
    let settings = Settings {
        precision: Some(precision.to_owned()),
        damping: Some("joint-wise".to_owned()),
        ..Settings::default()
    };
    let mut robot = Instance::new(Blueprint::new("balance-robot.toml", SCENE), settings)?;
    let (mut outputs, mut inputs) = ([0; STATES.len()], [0; MOTORS.len()]);
    for (output, name) in outputs.iter_mut().zip(STATES) {
        *output = robot.output(name)?;
    }
    for (input, name) in inputs.iter_mut().zip(MOTORS) {
        *input = robot.input(name)?;
    }
    for _ in 0..milliseconds {
        let voltages = voltages(outputs.map(|output| robot.value(output) as f32));
        for (input, voltage) in inputs.into_iter().zip(voltages) {
            robot.set_input(input, f64::from(voltage))?;
        }
        robot.advance(1)?;
        look(&robot);
    }
    Ok(())
}

fn main() -> Result<(), Box<dyn Error>> {
    let mut furthest = 0.0_f64;
    balance("f32", 10_000, |robot| {
        let value = |name| robot.output(name).map_or(f64::NAN, |output| robot.value(output));
        furthest = furthest.max(value("pitch").abs());
        if (robot.time() + 1e-6) % 1.0 < 1e-3 {
            let [pitch, x, y] = [furthest.to_degrees(), value("axle.x"), value("axle.y")];
            println!(
                "{:>2.0} s  pitch within {pitch:.2}°, at x {x:.3} m, y {y:.3} m",
                robot.time()
            );
            furthest = 0.0;
        }
    })
}
