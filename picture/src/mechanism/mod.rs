//! The geometry of a mechanism: what there is to see of a scene, whatever draws it.
//!
//! `scene => bodies, joints, springs, guides, forces`. A point belongs to a body and lies in its
//! axes, or to the ground; so other poses of the bodies move the whole. Sizes that only a drawing
//! on paper has (the width of a bar, a hinge's circle) are not in it.

mod attached;
mod elements;
mod forces;
mod outline;
mod parts;
mod solid;

use std::collections::BTreeMap;

use dbd_scene::Scene;

pub(crate) use parts::Bounds;
pub use parts::{
    Along, BodyShape, ForceKind, ForceMark, GuideMark, JointKind, JointMark, JointSpring,
    Mechanism, Outline, Place, SpringMark, TorsionMark,
};
pub use solid::Solid;
pub(crate) use solid::{block, rims};

impl Mechanism {
    /// The mechanism of a scene at its initial pose.
    #[must_use]
    pub fn of(scene: &Scene) -> Self {
        let spiders = attached::spiders(scene);
        let model = &scene.model;
        let bodies = model.bodies.iter().zip(&model.initial).zip(&scene.body_names);
        let mut mechanism = Self {
            name: scene.name.clone(),
            bodies: bodies
                .map(|((body, state), name)| BodyShape {
                    name: name.clone(),
                    mass: body.mass,
                    position: state.position.to_f64(),
                    orientation: state.orientation.to_f64(),
                    outline: Outline::Spider,
                    shapes: Vec::new(),
                })
                .collect(),
            ground: Vec::new(),
            joints: Vec::new(),
            joint_springs: attached::joint_springs(scene),
            springs: Vec::new(),
            guides: Vec::new(),
            torsions: Vec::new(),
            forces: Vec::new(),
            gravity: model.gravity.first().map(|gravity| gravity.to_f64()),
        };
        let (joints, pivots) = attached::joints(scene, &mechanism);
        mechanism.joints = joints;
        (mechanism.springs, mechanism.guides) = elements::raw(scene, &mechanism);
        mechanism.torsions = elements::torsions(scene, &mechanism, &pivots);
        mechanism.forces = forces::forces(scene, &pivots);
        let outlines = outline::outlines(scene, &mechanism, &spiders);
        for (body, outline) in mechanism.bodies.iter_mut().zip(outlines) {
            body.outline = outline;
        }
        for geometry in &scene.geometry {
            let owner = match geometry.body {
                Some(row) => mechanism.bodies.get_mut(row).map(|body| &mut body.shapes),
                None => Some(&mut mechanism.ground),
            };
            let solid = || Solid::of(&geometry.solid, geometry.colour.clone());
            owner.into_iter().for_each(|solids| solids.push(solid()));
        }
        // What has a shape for its inertia looks like it, unless its geometry says otherwise or it is held
        // outside of it, where only its outline shows what belongs together.
        let solids =
            scene.derived.iter().filter_map(|body| Some((&*body.name, body.solid.as_ref()?)));
        let solids: BTreeMap<&str, _> = solids.collect();
        for body in mechanism.bodies.iter_mut().filter(|body| body.shapes.is_empty()) {
            let solid = solids.get(&*body.name).map(|solid| Solid::of(solid, None));
            body.shapes.extend(solid.filter(|solid| outline::is_within(&body.outline, solid)));
        }
        mechanism
    }
}
