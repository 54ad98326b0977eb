//! A controller balances the scene `cart-pendulum` for a minute: `cargo run --release --example balance`.

use std::error::Error;

use dbd_kernel::{Leapfrog, Plant};
use dbd_scene::Scene;

/// The scene's text.
const SCENE: &str = include_str!("../scenes/cart-pendulum.toml");

/// State feedback on cart [N/m], angle [N/rad] and their rates: the linear regulator of the ideal cart
/// and pendulum for weights 20, 50, 1, 1 on these and 0.05 on the force. `host-sim linearise` gives A and B; a
/// test computes the gains from them.
pub const GAINS: [f64; 4] = [-20.0, 88.97, -18.33, 17.54];

/// The force [N] on the cart for its position, the angle from upright and their rates.
pub fn force(state: [f64; 4]) -> f64 {
    let force: f64 = state.iter().zip(GAINS).map(|(x, gain)| -gain * x).sum();
    force.clamp(-20.0, 20.0)
}

/// Balances for so many milliseconds; cart position and angle from upright, furthest in each second.
pub fn balance(milliseconds: u64) -> Result<Vec<[f64; 2]>, Box<dyn Error>> {
    let scene = Scene::parse(SCENE, "cart-pendulum.toml")?;
    let drive = scene.input("drive")?;
    let (cart, speed) = (scene.readout("cart_point")?, scene.readout("cart_velocity")?);
    let (angle, rate) = (scene.readout("angle")?, scene.readout("rate")?);
    let mut plant = Plant::new(&scene.model, Leapfrog, 5e-4)?;
    let mut furthest = vec![[0.0_f64; 2]; milliseconds.div_ceil(1000) as usize];
    for millisecond in 0..milliseconds {
        let along = |readout| plant.read(readout).and_then(|r| r.vector()).map(|v| v.x);
        let about = |readout| plant.read(readout).and_then(|r| r.scalar());
        let seen = (along(&cart), about(&angle), along(&speed), about(&rate));
        let (Some(x), Some(angle), Some(v), Some(w)) = seen else { return Err("blind".into()) };
        // The scene lets go five degrees off upright; the motor gives 20 N; two steps are 1 ms.
        let state = [x, angle + 5_f64.to_radians(), v, w];
        plant.set_input(drive, force(state))?;
        plant.advance(2)?;
        let second = &mut furthest[millisecond as usize / 1000];
        *second = [second[0].max(x.abs()), second[1].max(state[1].abs())];
    }
    Ok(furthest)
}

fn main() -> Result<(), String> {
    let seconds = balance(60_000).map_err(|error| error.to_string())?;
    for (second, [x, angle]) in seconds.iter().enumerate() {
        println!("{second:>2} s  cart within {x:.1e} m, pendulum within {angle:.1e} rad");
    }
    Ok(())
}
