//! Plants and records that the tests share.

use std::path::Path;

use dbd_golden::Recording;
use dbd_kernel::{F32, Geometry, Leapfrog, Plant};
use dbd_scene::{Scene, SceneModel};

/// A scene that ships.
pub fn scene(name: &str) -> Scene {
    let scenes = Path::new(env!("CARGO_MANIFEST_DIR")).join("../../scenes");
    Scene::load(scenes.join(name).with_extension("toml")).unwrap()
}

/// A scene's plant of leapfrog at the scene's step.
pub fn plant<P: Geometry>(scene: &Scene) -> Plant<Box<SceneModel<P>>, Leapfrog> {
    Plant::new(Box::new(scene.model.convert()), Leapfrog, scene.step.unwrap()).unwrap()
}

/// Samples of the four-bar in single precision every 50 steps up to step 200.
pub fn four_bar() -> Recording {
    record(&mut plant::<F32>(&scene("four-bar")))
}

/// The same of a plant that the caller made.
pub fn record<P: Geometry>(plant: &mut Plant<Box<SceneModel<P>>, Leapfrog>) -> Recording {
    let mut recording = Recording::of_scene(&scene("four-bar"), plant, 50, &[]).unwrap();
    for _ in 0..=4 {
        recording.look(plant).unwrap();
        plant.advance(50).unwrap();
    }
    recording
}
