//! Rollouts of a pendulum on a cart under 64 candidate pushes, all in lockstep: which leaves it upright
//! for longest? `cargo run --release -p dbd-ensemble --example rollouts`.

use std::num::NonZeroUsize;
use std::path::Path;
use std::thread::available_parallelism;

use dbd_ensemble::Ensemble;
use dbd_kernel::{F32, InputIndex, Leapfrog};
use dbd_scene::{Scene, SceneModel};

const CANDIDATES: usize = 64;

fn main() -> miette::Result<()> {
    let path = Path::new(env!("CARGO_MANIFEST_DIR")).join("../../scenes/cart-pendulum.toml");
    let text = std::fs::read_to_string(&path).unwrap();
    let scene = Scene::parse(&text, "cart-pendulum")?;
    let model: SceneModel<F32> = scene.model.convert();

    // Instances may differ in every number of the model, too.
    let mut rollouts = Ensemble::new(vec![model; CANDIDATES], Leapfrog, 5e-4)?;
    let push = |candidate: usize| 8.0 * (candidate as f64 / (CANDIDATES - 1) as f64 - 0.5);
    for candidate in 0..rollouts.len() {
        rollouts.set_input(candidate, InputIndex(0), push(candidate)).unwrap();
    }

    let threads = available_parallelism().unwrap_or(NonZeroUsize::MIN);
    let mut upright = [0_u32; CANDIDATES];
    for _ in 0..200 {
        rollouts.advance_on(threads, 10);
        for (candidate, upright) in upright.iter_mut().enumerate() {
            // The pendulum's y axis against the world's; an instance that failed stays as it failed.
            let tilt = rollouts.state(candidate).bodies[1].orientation.rotation().y.y;
            *upright += u32::from(rollouts.status(candidate).is_ok() && tilt > 0.98);
        }
    }
    let best = (0..CANDIDATES).max_by_key(|&candidate| upright[candidate]).unwrap_or(0);
    println!(
        "{} instances, {} in lockstep ({}): a push of {:.2} N holds it upright for {:.3} s",
        rollouts.len(),
        rollouts.lanes(),
        rollouts.instructions().name(),
        push(best),
        f64::from(upright[best]) * 5e-3,
    );
    Ok(())
}
