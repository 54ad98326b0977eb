//! A read-out that the scene does not have: the curve of a point of the coupler, and the largest force in a joint:
//! `cargo run --release --example coupler_curve`.

use std::error::Error;

use dbd_kernel::readouts::Readout;
use dbd_kernel::{BodyIndex, GroupIndex, Vec3};
use dbd_plant::{Method, plant};
use dbd_scene::Scene;

const SCENE: &str = include_str!("../scenes/four-bar.toml");

/// Width and height \[m\] of the curve of a point 1 m beside the middle of the coupler, and the largest force \[N\]
/// in the joint between crank and coupler, over 0.25 s.
pub fn curve() -> Result<[f64; 3], Box<dyn Error>> {
    let scene = Scene::parse(SCENE, "four-bar.toml")?;
    let body = scene.body_names.iter().position(|name| name == "coupler").ok_or("no coupler")?;
    let joint = scene.joints.iter().find(|joint| joint.name == "A").ok_or("no joint A")?;
    let point = Readout::Point { body: BodyIndex(body as u16), point: Vec3::new(1.0, 0.0, 0.0) };
    let force = Readout::JointForce { group: GroupIndex(joint.groups.start as u16) };
    let mut plant = plant(&scene, &Method::default(), 2e-5)?;
    let (mut low, mut high, mut largest) = ([f64::INFINITY; 2], [f64::NEG_INFINITY; 2], 0.0_f64);
    while plant.steps() < 12_500 {
        plant.advance(25)?;
        let vector = |readout| plant.read(readout).and_then(|reading| reading.vector());
        let (Some(p), Some(f)) = (vector(&point), vector(&force)) else {
            return Err("blind".into());
        };
        for (axis, at) in [p.x, p.y].into_iter().enumerate() {
            (low[axis], high[axis]) = (low[axis].min(at), high[axis].max(at));
        }
        largest = largest.max(f.dot(f).sqrt());
    }
    Ok([high[0] - low[0], high[1] - low[1], largest])
}

fn main() -> Result<(), Box<dyn Error>> {
    let [width, height, force] = curve()?;
    println!(
        "the curve is {width:.3} m by {height:.3} m; joint A bears up to {:.1} kN",
        1e-3 * force
    );
    Ok(())
}
