//! The geometry of a mechanism, independent of its renderer.
//!
//! `scene => bodies, joints, springs, guides, forces`. A point is given in the axes of its body or of the ground, so
//! that it follows other poses. Sizes of symbols (the width of a bar, a hinge's circle) are excluded.

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
    Along, BodyShape, ForceKind, ForceMark, GuideMark, InteractionMark, JointKind, JointMark,
    JointSpring, Mechanism, Outline, Place, SpringMark, TorsionMark,
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
            interactions: Vec::new(),
            forces: Vec::new(),
            gravity: model.gravity.first().map(|gravity| gravity.to_f64()),
        };
        let (joints, pivots) = attached::joints(scene, &mechanism);
        mechanism.joints = joints;
        (mechanism.springs, mechanism.guides) = elements::raw(scene, &mechanism);
        mechanism.torsions = elements::torsions(scene, &mechanism, &pivots);
        mechanism.interactions = elements::interactions(scene, &pivots);
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
        // A body with a shape for its inertia is drawn as that shape, unless it has a geometry or attachments outside
        // of the shape, which only an outline connects.
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

#[cfg(test)]
mod tests {
    use super::*;

    /// A door on its hinge: as long as its link and as high as its section.
    #[test]
    fn a_link_has_the_size_of_its_shape() {
        let text = r#"
            name = "door"
            duration = 1.0
            [[body]]
            name = "door"
            link = { from = [0, 0, 0], to = [1.2, 0, 0], shape = "box", section = ["40 mm", "1 m"], mass = 25 }
            [[joint]]
            name = "hinge"
            type = "revolute"
            between = ["world", "door"]
            at = [0, 0, 0]
            axis = [0, 0, 1]
            span = 0.8
            stiffness = 2e6
        "#;
        let mechanism = Mechanism::of(&Scene::parse(text, "door.toml").unwrap());
        let [solid] = &mechanism.bodies[0].shapes[..] else { panic!("{:?}", mechanism.bodies) };
        let corners = solid.corners();
        for (axis, half) in [0.6, 0.02, 0.5].into_iter().enumerate() {
            for end in [-half, half] {
                let is_there = corners.iter().any(|corner| (corner[axis] - end).abs() < 1e-12);
                assert!(is_there, "axis {axis}, {end}: {corners:?}");
            }
        }
    }
}
