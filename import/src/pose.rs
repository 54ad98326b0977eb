//! Joint coordinates become poses.
//!
//! `tree, coordinates => pose of each body in the world`. The file's pose has every joint at its `ref`; a
//! keyframe gives other coordinates, in the order of the bodies.

use nalgebra::{Isometry3, UnitQuaternion, Vector3};

use crate::body::Freedom;
use crate::defaults::Attributes;
use crate::element::Element;
use crate::error::Fault;
use crate::settings::quaternion;
use crate::tree::{Tree, WORLD, moved};

/// The poses of all bodies.
#[derive(Clone, Debug)]
pub(crate) struct Pose {
    /// At the file's pose.
    pub(crate) first: Vec<Isometry3<f64>>,
    /// Where the scene begins.
    pub(crate) start: Vec<Isometry3<f64>>,
    /// \[rad, m\] the coordinate of each body's hinge or slide there; 0 of what has neither.
    pub(crate) coordinates: Vec<f64>,
}

/// One body's coordinates in a keyframe.
type Given<'g> = Option<&'g [f64]>;

impl Pose {
    /// The poses at the file's pose and at a keyframe.
    pub(crate) fn of(tree: &Tree, root: &Element, keyframe: Option<&str>) -> Result<Self, Fault> {
        let none = vec![None; tree.bodies.len()];
        let (first, coordinates) = place(tree, &none);
        let Some(keyframe) = keyframe else {
            return Ok(Self { start: first.clone(), first, coordinates });
        };
        let keys: Vec<&Element> =
            root.sections("keyframe").flat_map(|section| &section.children).collect();
        let Some(key) = keys.iter().find(|key| key.text("name") == Some(keyframe)) else {
            let names: Vec<&str> = keys.iter().filter_map(|key| key.text("name")).collect();
            let help = if names.is_empty() {
                "the file has no keyframe with a name".to_owned()
            } else {
                format!("its keyframes: {}", names.join(", "))
            };
            return Err(Fault::at(root.place, format!("has no keyframe `{keyframe}`"), help));
        };
        let count: usize = tree.bodies.iter().map(|body| body.coordinates).sum();
        let given = Attributes::own(key);
        let Some(values) = given.numbers("qpos", count, count)? else {
            return Ok(Self { start: first.clone(), first, coordinates });
        };
        if given.numbers("qvel", 0, usize::MAX)?.unwrap_or_default().iter().any(|v| *v != 0.0) {
            let help = "a keyframe at rest: velocities of joints are not taken";
            return Err(Fault::at(given.place("qvel"), "`qvel` is not 0", help));
        }
        let mut rest = values.as_slice();
        let mut own = Vec::with_capacity(tree.bodies.len());
        for body in &tree.bodies {
            let (mine, others) = rest.split_at(body.coordinates);
            rest = others;
            own.push((!mine.is_empty()).then_some(mine));
        }
        let (start, coordinates) = place(tree, &own);
        Ok(Self { first, start, coordinates })
    }
}

/// Places each body in its parent, which is placed before it.
fn place(tree: &Tree, given: &[Given<'_>]) -> (Vec<Isometry3<f64>>, Vec<f64>) {
    let mut poses: Vec<Isometry3<f64>> = Vec::with_capacity(tree.bodies.len());
    let mut coordinates = Vec::with_capacity(tree.bodies.len());
    for (number, body) in tree.bodies.iter().enumerate() {
        let parent = if number == WORLD { Isometry3::identity() } else { poses[body.parent] };
        let mut pose = parent * body.pose;
        let mut coordinate = 0.0;
        if let Some(joint) = body.joints.first() {
            let own = given[number];
            let value = own.map_or(joint.reference, |own| own[0]);
            let change = value - joint.reference;
            let turned_by = |turn: UnitQuaternion<f64>, pose: &Isometry3<f64>| {
                let anchor = moved(pose, joint.anchor);
                let rotation = pose.rotation * turn;
                Isometry3::from_parts((anchor - rotation * joint.anchor).into(), rotation)
            };
            let turn = |from: usize, own: &[f64]| {
                let part = |i: usize| own.get(from + i).copied().unwrap_or(0.0);
                quaternion([part(0), part(1), part(2), part(3)])
                    .unwrap_or_else(UnitQuaternion::identity)
            };
            match (joint.freedom, own) {
                (Freedom::Hinge, _) => {
                    pose = turned_by(UnitQuaternion::from_axis_angle(&joint.axis, change), &pose);
                    coordinate = value;
                }
                (Freedom::Slide, _) => {
                    let shift = pose.rotation * joint.axis.into_inner() * change;
                    pose.translation.vector += shift;
                    coordinate = value;
                }
                (Freedom::Ball, Some(own)) => pose = turned_by(turn(0, own), &pose),
                (Freedom::Free, Some(own)) => {
                    let place = Vector3::new(own[0], own[1], own[2]);
                    pose = Isometry3::from_parts(place.into(), turn(3, own));
                }
                (Freedom::Ball | Freedom::Free, None) => {}
            }
        }
        poses.push(pose);
        coordinates.push(coordinate);
    }
    (poses, coordinates)
}
