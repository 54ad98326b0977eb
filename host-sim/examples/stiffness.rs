//! A parameter is swept by a program: `cargo run --release --example stiffness`.
//!
//! `host-sim sweep` does the same from a file, keeps what is done and draws it.

use std::error::Error;

use dbd_plant::{Frequencies, Method, plant};
use dbd_scene::Scene;

const SCENE: &str = include_str!("../scenes/four-bar.toml");

/// Of four-bars with joints of a stiffness \[N/m\]: the advised step \[s\], and how far the coupler is \[m\] after
/// 50 ms from where the stiffest of them has it.
pub fn sweep(stiffnesses: &[f64]) -> Result<Vec<[f64; 2]>, Box<dyn Error>> {
    let mut ends = Vec::new();
    for stiffness in stiffnesses {
        // As on the command line: --set joint.*.stiffness=1e6.
        let change = format!("joint.*.stiffness={stiffness}");
        let scene = Scene::parse_with(SCENE, "four-bar.toml", &[change])?;
        let advised = Frequencies::of(&scene).advised_step().ok_or("nothing vibrates")?;
        let steps = (0.05 / advised).ceil();
        let mut plant = plant(&scene, &Method::default(), 0.05 / steps)?;
        plant.advance(steps as u64)?;
        ends.push((advised, plant.state().bodies[1].position));
    }
    let (_, stiffest) = *ends.last().ok_or("no stiffness")?;
    let off = |end| {
        let gap = stiffest - end;
        gap.dot(gap).sqrt()
    };
    Ok(ends.into_iter().map(|(step, end)| [step, off(end)]).collect())
}

fn main() -> Result<(), Box<dyn Error>> {
    let stiffnesses = [1e6, 1e7, 1e8, 1e9];
    for (stiffness, [step, off]) in stiffnesses.iter().zip(sweep(&stiffnesses)?) {
        println!(
            "{stiffness:.0e} N/m: a step of {:.1} µs, {:.2} mm from the stiffest",
            1e6 * step,
            1e3 * off
        );
    }
    Ok(())
}
