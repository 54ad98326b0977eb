//! The scenes of recorded runs, loaded again where they are what they were.
//!
//! `head, catalogue => scene; or why there is none`. Without its scene a run has curves, and no mechanism to be seen.

use dbd_kernel::fingerprint::model_hash;
use dbd_scene::Scene;

use crate::recorded::{Head, Kind};
use crate::terminal::catalogue::BUILT_IN;
use crate::terminal::{Catalogue, LoadError};

/// What a summary says of a scene that came from nowhere.
const STANDARD_INPUT: &str = "standard input";

/// The scenes of two runs, or a sentence each that says why there is none.
pub fn scenes(catalogue: &Catalogue, heads: &[Head; 2]) -> [Result<Scene, String>; 2] {
    let of_run = |head: &Head| match head.kind {
        Kind::Run => of_run(catalogue, head),
        Kind::Golden => Err(String::new()),
    };
    let [mut a, mut b] = heads.each_ref().map(of_run);
    let golden = |head: &Head, other: &Result<Scene, String>| match head.kind {
        Kind::Run => None,
        Kind::Golden => Some(of_golden(catalogue, head, other)),
    };
    let (of_a, of_b) = (golden(&heads[0], &b), golden(&heads[1], &a));
    if let Some(scene) = of_a {
        a = scene;
    }
    if let Some(scene) = of_b {
        b = scene;
    }
    [a, b]
}

fn of_run(catalogue: &Catalogue, head: &Head) -> Result<Scene, String> {
    let called = match head.scene_file.as_deref() {
        None => return Err("its summary does not say which file its scene comes from".into()),
        Some(STANDARD_INPUT) => return Err("its scene came from standard input".into()),
        Some(BUILT_IN) => &head.scene,
        Some(file) => file,
    };
    let changes: Vec<String> =
        head.set.iter().map(|value| format!("{}={}", value.path, value.now)).collect();
    let why = |error: LoadError| format!("its scene cannot be loaded: {error}");
    let found = catalogue.load_with(called, &changes).map_err(why)?;
    if head.scene_hash.as_ref().is_some_and(|hash| *hash != found.file.hash) {
        return Err(format!("its scene, {called}, has changed since"));
    }
    fits(found.scene, head)
}

fn of_golden(
    catalogue: &Catalogue,
    head: &Head,
    other: &Result<Scene, String>,
) -> Result<Scene, String> {
    let own = |scene: &Scene| head.model == Some(model_hash(&*scene.in_world()));
    if let Some(scene) = other.as_ref().ok().filter(|scene| own(scene)) {
        return fits(scene.clone(), head);
    }
    match catalogue.load(&head.scene) {
        Ok(found) if own(&found.scene) => fits(found.scene, head),
        _ => Err(format!("no scene `{}` with its model is at hand", head.scene)),
    }
}

/// The scene, where the run's bodies are its bodies.
fn fits(scene: Scene, head: &Head) -> Result<Scene, String> {
    if scene.body_names == head.bodies {
        Ok(scene)
    } else {
        Err("its scene has other bodies than it recorded".into())
    }
}
