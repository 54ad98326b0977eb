//! What is measured: scenes that are named, or the ten systems of the paper; chains.
//!
//! `names, numbers of links => models with their steps`.

use crate::chain::{self, Joints};
use dbd_kernel::F64;
use dbd_plant::Frequencies;
use dbd_scene::{Scene, SceneModel};
use dbd_study::paper::TEN;
use serde::Serialize;

use host_sim::terminal::Catalogue;

use super::arguments::BenchArguments;
use super::error::BenchError;

/// Links of the chains of revolutes.
const CHAINS: [usize; 4] = [10, 100, 1_000, 10_000];

/// Links of those of spherical joints: they tell a joint from its TSDAs.
const BALLS: [usize; 2] = [10, 100];

/// Steps of a scene that gives no step and where nothing vibrates.
const STEPS: f64 = 1_000.0;

/// How large a system is.
#[derive(Clone, Debug, PartialEq, Serialize)]
pub struct Size {
    /// Its name.
    pub name: String,
    /// Its number in Table 7 of the paper.
    pub table_7: Option<usize>,
    /// Links, where it is a chain of revolutes that was made here.
    pub links: Option<usize>,
    /// Bodies, spiders too.
    pub bodies: usize,
    /// Elements that count as a TSDA.
    pub tsdas: usize,
    /// Pairs of bodies that elements join: a universal joint is two, with its spider between them.
    pub joints: usize,
    /// Torsion springs.
    pub torsion_springs: usize,
    /// \[s\] its step.
    pub step_s: f64,
}

/// A system.
pub struct System {
    /// How large it is.
    pub size: Size,
    /// Its model; of a planar scene the elements that step, in the world's axes.
    pub model: SceneModel<F64>,
    /// The scene, where it runs in its plane.
    pub planar: Option<Scene>,
}

/// The systems that a command line asks for.
///
/// # Errors
/// Where a scene cannot be loaded or a chain is refused.
pub fn of(catalogue: &Catalogue, arguments: &BenchArguments) -> Result<Vec<System>, BenchError> {
    let mut systems = Vec::new();
    let by_default = arguments.by_default();
    if by_default {
        for (row, name) in TEN.into_iter().enumerate() {
            let scene = Scene::clone(&catalogue.load(name)?.scene);
            systems.push(scene_system(name.to_owned(), Some(row + 1), scene));
        }
    }
    for name in &arguments.scenes {
        let found = catalogue.load_with(name, &arguments.set)?;
        systems.push(scene_system(found.file.stem, None, found.scene));
    }
    let chains = match &arguments.chains {
        Some(chains) => &chains[..],
        None if by_default => &CHAINS,
        None => &[],
    };
    for links in chains {
        systems.push(chain_system(*links, Joints::Revolute)?);
    }
    if by_default {
        for links in BALLS {
            systems.push(chain_system(links, Joints::Spherical)?);
        }
    }
    Ok(systems)
}

fn scene_system(name: String, table_7: Option<usize>, scene: Scene) -> System {
    let step = scene.step.or_else(|| Frequencies::of(&scene).advised_step());
    let model = scene.in_world().into_owned();
    let size = Size {
        name,
        table_7,
        links: None,
        bodies: model.bodies.len(),
        tsdas: model.tsda_count(),
        joints: model.groups.len(),
        torsion_springs: model.torsions.len(),
        step_s: step.unwrap_or(scene.duration / STEPS),
    };
    System { size, model, planar: Some(scene).filter(|scene| scene.planar.is_some()) }
}

fn chain_system(links: usize, joints: Joints) -> Result<System, BenchError> {
    let model = chain::model(links, joints)?;
    let (name, revolutes) = match joints {
        Joints::Revolute => (format!("chain-{links}"), Some(links)),
        Joints::Spherical => (format!("balls-{links}"), None),
    };
    let size = Size {
        name,
        table_7: None,
        links: revolutes,
        bodies: links,
        tsdas: model.tsda_count(),
        joints: links,
        torsion_springs: 0,
        step_s: chain::STEP,
    };
    Ok(System { size, model, planar: None })
}
