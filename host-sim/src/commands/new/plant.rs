//! The parts of a plant project that come from its scene, for any firmware language.
//!
//! `(scene, options) => method and step, values of templates, golden bits`. The golden bits are those of a run of the scene
//! here.

use std::path::PathBuf;

use dbd_plant::plant;
use dbd_scene::Scene;
use dbd_scene::export::type_name;
use dbd_scene::laws::{KnownLaw, known_law};

use super::choice::{Choice, ChoiceError};
use super::dependencies::Dependencies;
use super::{NewError, Place, PlantArguments};
use crate::terminal::Found;

/// Most steps of the golden run: a second or two in QEMU.
const MAX_STEPS: u64 = 10_000;

/// The package of the kernel's own laws.
const KERNEL: &str = "dbd-kernel";

/// A scene as a plant of a new project.
pub(super) struct Planted<'f> {
    /// The scene.
    pub(super) scene: &'f Scene,
    /// How it steps.
    pub(super) choice: Choice,
    /// The source of its crates.
    pub(super) dependencies: Dependencies,
    /// Lines `STEPS HASH` of the golden run.
    pub(super) golden: String,
    /// The values for templates.
    pub(super) values: Vec<(&'static str, String)>,
    /// The scene's file in the project, and its text.
    pub(super) file: (PathBuf, String),
}

impl<'f> Planted<'f> {
    /// The plant of a project at a place.
    ///
    /// # Errors
    /// [`NewError`] if no method represents the scene, it fails within the golden run, or its crates cannot be found.
    pub(super) fn of(
        place: &Place<'_>,
        found: &'f Found,
        arguments: &PlantArguments,
    ) -> Result<Self, NewError> {
        let dependencies = Dependencies::of(&arguments.dependencies)?;
        let scene = &found.scene;
        let choice = Choice::of(scene, &arguments.choice)?;
        let steps = ((scene.duration / choice.step).round() as u64).clamp(1, MAX_STEPS);
        let golden = golden(scene, &choice, steps)?;
        let stem = plain(&found.file.stem);
        let file = format!("scenes/{stem}.toml");
        let reasons = choice.reasons.iter().map(|reason| format!("- {reason}\n")).collect();
        let values = vec![
            ("name", place.name.to_owned()),
            ("crate", place.name.replace('-', "_")),
            ("rust_version", env!("CARGO_PKG_RUST_VERSION").to_owned()),
            ("kernel", dependencies.kernel.clone()),
            ("scene_crate", dependencies.scene.clone()),
            ("origin", dependencies.origin.clone()),
            ("build", choice.call(&file, &own_laws(scene))),
            ("law_crates", law_crates(scene)),
            ("scene", scene.name.clone()),
            ("type", type_name(&scene.name)),
            ("steps", steps.to_string()),
            ("method", choice.words()),
            ("reasons", reasons),
            ("stem", stem),
        ];
        let file = (PathBuf::from(file), found.text.clone());
        Ok(Self { scene, choice, dependencies, golden, values, file })
    }
}

/// The laws of a scene that are not the kernel's.
fn own_laws(scene: &Scene) -> Vec<KnownLaw> {
    let known = scene.model.laws.names().filter_map(known_law);
    known.filter(|law| law.package[0] != KERNEL).collect()
}

/// The packages that declare them, as dependencies.
fn law_crates(scene: &Scene) -> String {
    let mut packages: Vec<_> = own_laws(scene).into_iter().map(|law| law.package).collect();
    packages.sort_unstable();
    packages.dedup();
    let line = |[name, folder]: [&str; 2]| format!("{name} = {{ path = {folder:?} }}\n");
    packages.into_iter().map(line).collect()
}

/// A file name that needs no quoting in source and paths.
fn plain(stem: &str) -> String {
    let plain = |c: char| if c.is_ascii_alphanumeric() || "._-".contains(c) { c } else { '-' };
    let name: String = stem.chars().map(plain).collect();
    if name.starts_with(|c: char| c.is_ascii_alphanumeric()) {
        name
    } else {
        format!("scene{name}")
    }
}

/// Lines `STEPS HASH` after 1, 10, 100, … steps and at the end, as the project's own run shows them.
fn golden(scene: &Scene, choice: &Choice, steps: u64) -> Result<String, NewError> {
    let plant = plant(scene, &choice.method, choice.step);
    let mut plant = plant.map_err(ChoiceError::from)?;
    let (mut lines, mut next, mut done) = (String::new(), 1, 0);
    while done < steps {
        let count = next.min(steps) - done;
        if let Err(failure) = plant.advance(count) {
            let scene = scene.name.clone();
            let method = choice.words();
            return Err(NewError::Fails { scene, method, failure: failure.to_string() });
        }
        done += count;
        lines += &format!("{done} {:016x}\n", plant.hash());
        next = next.saturating_mul(10);
    }
    Ok(lines)
}
