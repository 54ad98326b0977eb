//! Natural frequency of each element alone with its two bodies, and the highest one.
//!
//! `scene => per element a frequency`. `ω² = k·(1/m_a + 1/m_b)` along the element, m the effective mass of a body at
//! the point: `1/m = n·n/m + (r × n)·I⁻¹·(r × n)`; about an axis likewise. The highest value over the directions of
//! an element counts. It compares elements and is not a bound.

use dbd_kernel::Vec3;
use dbd_kernel::model::{Group, Law};

use crate::facts::lengths::{End, along, held_turns, is_bushing, points};
use crate::facts::pose::frames;
use crate::scene::Scene;

/// Natural frequency of a joint, a raw element or a torsion spring alone.
#[derive(Clone, Debug, PartialEq)]
pub struct ElementFrequency {
    /// Its label in messages: ``joint `wrist` ``.
    pub name: String,
    /// Its index in the order joints, raw elements, torsion springs.
    pub row: usize,
    /// \[rad/s\].
    pub frequency: f64,
}

/// An element of a joint at the initial pose, or one direction of a bushing.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct JointElement {
    /// The index of its joint.
    pub joint: usize,
    /// Indices of its two bodies, `None` for the world.
    pub bodies: [Option<usize>; 2],
    /// \[m\] its moment per newton about the centre of mass of each body, body axes.
    pub moments: [Vec3<f64>; 2],
    /// \[1\] the unit direction of its force, world; 0 for a pure moment.
    pub direction_w: Vec3<f64>,
    /// \[N/m\].
    pub stiffness: f64,
    /// \[m\].
    pub free_length: f64,
}

/// The elements of all joints in order, at the initial pose.
#[must_use]
pub fn joint_elements(scene: &Scene) -> Vec<JointElement> {
    let frames = frames(scene);
    let mut elements = Vec::new();
    let groups = scene.joints.iter().enumerate();
    for (joint, number) in
        groups.flat_map(|(row, joint)| joint.groups.clone().map(move |n| (row, n)))
    {
        let group = &scene.model.groups[number];
        let [a, b] = [group.a, group.b].map(|body| End { scene, frames: &frames, body });
        for i in 0..group.elements() {
            let [centre, tip] = points(scene, group, i);
            let tip_w = b.place(tip);
            let d = along(scene, group, i, &a, tip_w - a.place(centre));
            let (stiffness, free_length) = law(scene, group, i);
            let mut add = |stiffness: f64, moments: [Vec3<f64>; 2], direction_w| {
                elements.push(JointElement {
                    joint,
                    bodies: [group.a, group.b]
                        .map(|body| Some(body.row()).filter(|row| *row < scene.model.bodies.len())),
                    moments,
                    direction_w,
                    stiffness,
                    free_length,
                });
            };
            // The force on a line acts at the foot of the perpendicular.
            let foot = if group.law == Law::PointOnLine { a.to_local(tip_w - d) } else { centre };
            let at = |n: Vec3<f64>| [foot.cross(a.to_body(n)), tip.cross(b.to_body(n))];
            if is_bushing(group) {
                for (weight, n) in directions(scene, group, i, &a) {
                    add(weight * stiffness, at(n), n);
                }
            } else if let Some(n) = crate::direction::unit(d) {
                add(stiffness, at(n), n);
            }
            for turn in held_turns(scene, group, &a, &b) {
                add(stiffness, [a.to_body(turn), b.to_body(turn)], Vec3::ZERO);
            }
        }
    }
    elements
}

/// The directions of element `i` of a group of bushings, world, with the fraction of its stiffness in each.
fn directions(scene: &Scene, group: &Group, i: usize, a: &End<'_>) -> [(f64, Vec3<f64>); 3] {
    let row = usize::from(group.element) + i;
    match scene.model.revolutes.get(row).filter(|_| group.law == Law::Revolute) {
        Some(revolute) => {
            let lever = a.to_world(revolute.levers[0]);
            let axis = lever * (1.0 / libm::sqrt(lever.dot(lever)));
            let [n, m] = axis.normals();
            [(1.0, n), (1.0, m), (1.0 + revolute.along * lever.dot(lever), axis)]
        }
        None => Vec3::axes().map(|axis| (1.0, axis)),
    }
}

/// \[N/m\] stiffness and \[m\] free length of element `i` of a group.
pub(super) fn law(scene: &Scene, group: &Group, i: usize) -> (f64, f64) {
    let element = usize::from(group.element);
    match group.law {
        Law::Tsda => {
            let tsda = &scene.model.tsdas[element + i];
            (tsda.stiffness, tsda.free_length)
        }
        Law::PointBushing => (scene.model.bushings[element + i].stiffness, 0.0),
        Law::Revolute => (scene.model.revolutes[element + i].stiffness, 0.0),
        Law::Universal => (scene.model.universals[element + i].stiffness, 0.0),
        Law::PointOnLine => {
            let line = &scene.model.lines[element + i];
            (line.stiffness, line.free_length)
        }
    }
}

/// The spatial scene with the stiffness of all joints times `factor`; dampers and other springs are unchanged.
#[must_use]
pub fn with_stiffer_joints(scene: &Scene, factor: f64) -> Scene {
    let mut made = Scene { planar: None, ..scene.clone() };
    let model = &mut made.model;
    let groups = scene.joints.iter().flat_map(|joint| joint.groups.clone());
    for group in groups.map(|number| &scene.model.groups[number]) {
        for row in (usize::from(group.element)..).take(group.elements()) {
            *match group.law {
                Law::Tsda => &mut model.tsdas[row].stiffness,
                Law::PointBushing => &mut model.bushings[row].stiffness,
                Law::Revolute => &mut model.revolutes[row].stiffness,
                Law::Universal => &mut model.universals[row].stiffness,
                Law::PointOnLine => &mut model.lines[row].stiffness,
            } *= factor;
        }
    }
    made
}

/// Natural frequency of each joint, raw element and torsion spring alone, in scene order.
#[must_use]
pub fn element_frequencies(scene: &Scene) -> Vec<ElementFrequency> {
    let frames = frames(scene);
    let of_group = |number: usize| {
        let group = &scene.model.groups[number];
        let [a, b] = [group.a, group.b].map(|body| End { scene, frames: &frames, body });
        let squares = (0..group.elements()).map(|i| of_element(scene, group, i, &a, &b));
        squares.fold(0.0, f64::max)
    };
    let joints = scene.joints.iter().map(|joint| ElementFrequency {
        name: format!("joint `{}`", joint.name),
        row: 0,
        frequency: libm::sqrt(joint.groups.clone().map(of_group).fold(0.0, f64::max)),
    });
    let raw = scene.joints.last().map_or(0, |joint| joint.groups.end);
    let alone = |name: &String, square: f64| ElementFrequency {
        name: name.clone(),
        row: 0,
        frequency: libm::sqrt(square),
    };
    let raws =
        scene.raw_names.iter().zip(raw..).map(|(name, number)| alone(name, of_group(number)));
    let springs = scene.model.torsions.iter().zip(&scene.torsion_names);
    let springs = springs.map(|(spring, name)| {
        let axis = End { scene, frames: &frames, body: spring.a }.to_world(spring.axis);
        let ends = [spring.a, spring.b].map(|body| End { scene, frames: &frames, body });
        alone(name, spring.stiffness * ends.iter().map(|end| turning(end, axis)).sum::<f64>())
    });
    let all = joints.chain(raws).chain(springs).enumerate();
    all.map(|(row, element)| ElementFrequency { row, ..element }).collect()
}

fn of_element(scene: &Scene, group: &Group, i: usize, a: &End<'_>, b: &End<'_>) -> f64 {
    let (stiffness, _) = law(scene, group, i);
    let [centre, tip] = points(scene, group, i);
    let (centre, tip) = (a.place(centre), b.place(tip));
    let d = along(scene, group, i, a, tip - centre);
    let directions = match crate::direction::unit(d) {
        Some(n) if !is_bushing(group) => vec![(1.0, n)],
        // At zero length every direction counts.
        _ => directions(scene, group, i, a).to_vec(),
    };
    // The force on a line acts at the foot of the perpendicular.
    let foot = if group.law == Law::PointOnLine { tip - d } else { centre };
    let square = |(weight, n): &(f64, Vec3<f64>)| {
        weight * stiffness * (moving(a, foot, *n) + moving(b, tip, *n))
    };
    let turns = held_turns(scene, group, a, b);
    let turns = turns.into_iter().map(|turn| stiffness * (turning(a, turn) + turning(b, turn)));
    directions.iter().map(square).chain(turns).fold(0.0, f64::max)
}

/// \[1/kg\] inverse effective mass of a body at a point along a direction, world; 0 for the world.
fn moving(end: &End<'_>, at: Vec3<f64>, n: Vec3<f64>) -> f64 {
    let row = end.body.row();
    let (Some(body), Some(state)) =
        (end.scene.model.bodies.get(row), end.scene.model.initial.get(row))
    else {
        return 0.0;
    };
    if body.is_driven() {
        return 0.0;
    }
    1.0 / body.mass + turning(end, (at - state.position).cross(n))
}

/// \[1/(kg·m²)\] inverse effective inertia of a body about an axis, world: `a·I⁻¹·a`; 0 for the world.
fn turning(end: &End<'_>, axis: Vec3<f64>) -> f64 {
    let Some(body) = end.scene.model.bodies.get(end.body.row()) else { return 0.0 };
    if body.is_driven() {
        return 0.0;
    }
    let Vec3 { x, y, z } = end.to_body(axis);
    let inertia = body.inertia;
    x * x / inertia.x + y * y / inertia.y + z * z / inertia.z
}
