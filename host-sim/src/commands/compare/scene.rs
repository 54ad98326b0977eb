//! The scenes of recorded runs, loaded again if they are unchanged.
//!
//! `head, catalogue => scene; or why there is none`. Without its scene a run has curves, but no animation.

use std::ffi::OsStr;

use dbd_kernel::fingerprint::model_hash;
use dbd_scene::Scene;

use crate::recorded::{Head, Kind};
use crate::terminal::catalogue::BUILT_IN;
use crate::terminal::{Catalogue, LoadError};

/// The origin of a scene from standard input, as a summary records it.
const STANDARD_INPUT: &str = "standard input";

/// The scenes of two runs, or for each the reason why it is missing.
pub fn scenes(catalogue: &Catalogue, heads: &[Head; 2]) -> [Result<Scene, String>; 2] {
    let of_run = |head: &Head| match head.kind {
        Kind::Run => of_run(catalogue, head),
        Kind::Golden => Err(String::new()),
    };
    let mut scenes = heads.each_ref().map(of_run);
    // The scene found for the second may also be that of the first.
    for (own, other) in [(0, 1), (1, 0), (0, 1)] {
        if heads[own].kind == Kind::Golden && scenes[own].is_err() {
            scenes[own] = of_golden(catalogue, &heads[own], &scenes[other]);
        }
    }
    scenes
}

/// The scene of one run, or the reason why it is missing.
///
/// # Errors
/// The reason, for people.
pub fn scene(catalogue: &Catalogue, head: &Head) -> Result<Scene, String> {
    match head.kind {
        Kind::Run => of_run(catalogue, head),
        Kind::Golden => of_golden(catalogue, head, &Err(String::new())),
    }
}

fn of_run(catalogue: &Catalogue, head: &Head) -> Result<Scene, String> {
    let called = match head.scene_file.as_deref() {
        None => return Err("its summary does not name the scene's file".into()),
        Some(STANDARD_INPUT) => return Err("its scene came from standard input".into()),
        Some(BUILT_IN) => &head.scene,
        Some(file) => file,
    };
    let changes: Vec<String> =
        head.set.iter().map(|value| format!("{}={}", value.path, value.now)).collect();
    let why = |error: LoadError| format!("its scene cannot be loaded: {error}");
    let found = catalogue.load_with(called, &changes).map_err(why)?;
    if head.scene_hash.as_ref().is_some_and(|hash| *hash != found.file.hash) {
        return Err(format!("its scene, {called}, has changed since the run"));
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
    let beside = [Some(head.scene.as_ref()), head.file.file_stem()].into_iter().flatten();
    let beside = beside.map(|name: &OsStr| {
        let mut name = name.to_owned();
        name.push(".toml");
        head.file.with_file_name(name)
    });
    let places = beside.map(|file| file.display().to_string()).chain([head.scene.clone()]);
    let mut found = places.filter_map(|place| catalogue.load(&place).ok());
    match found.find(|found| own(&found.scene)) {
        Some(found) => fits(found.scene, head),
        None => Err(format!(
            "no scene `{0}` with its model is built in or next to the file: put {0}.toml there",
            head.scene
        )),
    }
}

/// The scene, if its bodies are those of the run.
///
/// # Errors
/// The reason, for people.
pub fn fits(scene: Scene, head: &Head) -> Result<Scene, String> {
    if scene.body_names == head.bodies {
        Ok(scene)
    } else {
        Err("its scene and its recording have different bodies".into())
    }
}
