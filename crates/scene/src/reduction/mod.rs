//! Scenes that move in a plane: recognised, and reduced to three freedoms per body.
//!
//! `scene => model in the plane z = 0 and the conversion back to the world, or the items that leave the plane`. A scene
//! is planar where bodies, joints and everything else lie in one plane, a principal axis of each body is normal to it,
//! and no force or velocity leaves it. A pin becomes two TSDAs of equal stiffness at rest; elements in the plane stay
//! unchanged. Groups, torsion springs, loads, inputs and read-outs keep their numbers.

mod bodies;
mod departure;
mod driven;
mod elements;
mod groups;
mod laws;
mod reduced;

pub use departure::{Departure, Part, Unplanar};

use std::collections::BTreeMap;

use dbd_kernel::Vec3;

use crate::direction::unit;
use crate::planar::{ALIKE, Axes, Planar, Plane};
use crate::reduction::bodies::{height, size};
use crate::runtime::SceneModel;
use crate::scene::Scene;

/// \[1\] Points closer than this fraction of the scene's size coincide.
const NEAR: f64 = 1e-9;

/// Number of the most common joint axes tried as the normal, besides those of the world.
const MAX_AXES: usize = 3;

/// Reduces a scene to its plane, with or without `planar = true`.
///
/// # Errors
/// [`Unplanar`] with the items that leave the best candidate plane.
pub fn reduced(scene: &Scene) -> Result<Planar, Unplanar> {
    let mut least: Option<Unplanar> = None;
    for normal in normals(scene) {
        match in_plane(scene, normal) {
            Ok(planar) => return Ok(planar),
            Err(found) => {
                let fewer = |least: &Unplanar| found.departures.len() < least.departures.len();
                if least.as_ref().is_none_or(fewer) {
                    least = Some(found);
                }
            }
        }
    }
    Err(least.unwrap_or(Unplanar { plane: "z = 0".into(), departures: Vec::new() }))
}

/// Normals to try: z, the most common axes of joints, y, x.
fn normals(scene: &Scene) -> Vec<Vec3<f64>> {
    let [x, y, z] = Vec3::axes();
    let model = &scene.model;
    let mut counted: BTreeMap<[i64; 3], (usize, Vec3<f64>)> = BTreeMap::new();
    let hinges = scene.joints.iter().flat_map(|joint| &joint.hinges);
    for hinge in hinges {
        let axis = match model.initial.get(hinge.a.row()) {
            Some(state) => state.orientation.rotation().to_world(hinge.axis),
            None => hinge.axis,
        };
        let Some(axis) = unit(axis) else { continue };
        let leads = axis.to_f64().into_iter().find(|c| c.abs() > ALIKE).unwrap_or(1.0);
        let axis = if leads < 0.0 { -axis } else { axis };
        // Nearly equal axes share a row or fall into two adjacent ones, which costs one more try.
        let key = axis.to_f64().map(|c| (c / NEAR.sqrt()).round() as i64);
        counted.entry(key).or_insert((0, axis)).0 += 1;
    }
    let mut counted: Vec<_> = counted.into_values().collect();
    counted.sort_by_key(|row| std::cmp::Reverse(row.0));
    let common = counted.into_iter().take(MAX_AXES).map(|(_, axis)| axis);
    let mut all: Vec<Vec3<f64>> = Vec::new();
    for axis in std::iter::once(z).chain(common).chain([y, x]) {
        if all.iter().all(|known| 1.0 - known.dot(axis).abs() > NEAR) {
            all.push(axis);
        }
    }
    all
}

/// The scene in a plane with this normal.
fn in_plane(scene: &Scene, normal: Vec3<f64>) -> Result<Planar, Unplanar> {
    let axes = Axes::of(normal);
    let size = size(&scene.model);
    let near = NEAR * size;
    let mut plane = Plane::new(axes, height(&scene.model, &axes, near), size);
    let name = plane.name();
    let mut departures = Vec::new();
    let mut leaves = |part, key, by: &str| {
        let problem = format!("leaves the plane {name}{by}");
        departures.push(Departure { part, key, problem });
    };
    let mut model = SceneModel::default();
    bodies::read(scene, &mut plane, near, &mut model, &mut leaves);
    let at_rest = groups::read(scene, &plane, near, &mut model, &mut leaves);
    driven::read(scene, &plane, near, &mut model, &mut leaves);
    laws::read(scene, &plane, near, &mut model, &mut leaves);
    if departures.is_empty() {
        let mut planar = Planar { model, plane, at_rest };
        let sources = scene.model.sources.iter();
        planar.model.sources = sources.map(|source| planar.source(source)).collect();
        Ok(planar)
    } else {
        Err(Unplanar { plane: name, departures })
    }
}
