//! A delta robot leads its tool along a circle: `cargo run --release --example follow`.
use std::{error::Error, f64::consts::TAU};

use dbd_kernel::{Leapfrog, Plant, Vec3};
use dbd_scene::Scene;

/// Where the tool should be: on a circle of 0.1 m, once a second after a smooth start, at the height
/// of the scene's start.
fn path(t: f64) -> Vec3<f64> {
    let (radius, (sine, cosine)) = (0.1 * (1.0 - (-4.0 * t * t).exp()), (TAU * t).sin_cos());
    Vec3::new(radius * sine, radius * cosine, -1.0116125740618291)
}

/// The angle at which the arm at `azimuth` holds the tool at `p`, joints and links rigid: by the law of
/// cosines for an arm of 0.524 m whose elbow lies 1.244 m from the tool's joint; the arm's own joint
/// stands 0.2 m further out than the tool's.
fn arm(p: Vec3<f64>, azimuth: f64) -> f64 {
    let (sine, cosine) = azimuth.sin_cos();
    let (x, y) = (0.2 - p.x * cosine - p.y * sine, p.y * cosine - p.x * sine);
    // 1.244² - 0.524² and 2·0.524.
    p.z.atan2(x) + ((1.27296 - x * x - y * y - p.z * p.z) / (1.048 * x.hypot(p.z))).acos()
}

/// The scene's text.
const SCENE: &str = include_str!("../scenes/delta-pick-and-place.toml");

/// Follows the path for `looks` of 1/4 ms; the largest distance from it [m] after the first second.
pub fn follow(looks: u32) -> Result<f64, Box<dyn Error>> {
    const H: f64 = 2.5e-4;
    let mut scene = Scene::parse(SCENE, "delta-pick-and-place.toml")?;
    scene.inputs.iter().for_each(|drive| scene.model.release(drive.index));
    let (tool, mut last, mut furthest) = (scene.readout("tool_point")?, [0.0; 3], 0.0_f64);
    let mut plant = Plant::new(&scene.model, Leapfrog, 5e-5)?;
    for t in (0..looks).map(|look| H * f64::from(look)) {
        for (i, drive) in scene.inputs.iter().enumerate() {
            let [past, now, next] = [t - H, t, t + H].map(|t| arm(path(t), TAU / 3.0 * i as f64));
            let angle = scene.readout(&format!("angle{}", i + 1))?;
            let off = now - plant.read(&angle).and_then(|r| r.scalar()).ok_or("blind")?;
            let (rate, bend) = ((next - past) / (2.0 * H), (next - 2.0 * now + past) / (H * H));
            // The scene's spring [N·m/rad] and friction [N·m·s/rad], about the inertia [kg·m²] of an
            // arm; then what is off, 25 times as stiff and with two thirds more friction.
            let known = 400.0 * now + 60.0 * rate + 11.0 * bend;
            plant.set_input(drive.index, known + 1e4 * off + 100.0 * (off - last[i]) / H)?;
            last[i] = off;
        }
        let gap = plant.read(&tool).and_then(|r| r.vector()).ok_or("blind")? - path(t);
        furthest = if t > 1.0 { furthest.max(gap.dot(gap).sqrt()) } else { 0.0 };
        plant.advance(5)?;
    }
    Ok(furthest)
}

fn main() -> Result<(), String> {
    let show = |gap: f64| println!("the tool keeps within {:.2} mm of its path", 1e3 * gap);
    follow(16_000).map(show).map_err(|error| error.to_string())
}
