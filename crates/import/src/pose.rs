//! Joint coordinates to poses.
//!
//! `tree, coordinates => world pose of each body`. The file's pose has every joint at its `ref`; a keyframe gives other
//! coordinates in the order of the bodies.

use nalgebra::{Isometry3, UnitQuaternion, Vector3};

use crate::body::Freedom;
use crate::defaults::Attributes;
use crate::element::Element;
use crate::error::Fault;
use crate::settings::quaternion;
use crate::tree::{Body, Tree, WORLD, moved};

/// The poses of all bodies.
#[derive(Clone, Debug)]
pub(crate) struct Pose {
    /// At the file's pose.
    pub(crate) first: Vec<Isometry3<f64>>,
    /// At the start of the scene.
    pub(crate) start: Vec<Isometry3<f64>>,
    /// \[rad, m\] initial coordinate of each body's hinge or slide; 0 without either.
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
        let key = key(root, keyframe)?;
        let own = |body: &Body| body.joint.as_ref().map_or(0, |one| one.freedom.coordinates());
        let count: usize = tree.bodies.iter().map(own).sum();
        let given = Attributes::own(key);
        let Some(values) = given.numbers("qpos", count, count)? else {
            return Ok(Self { start: first.clone(), first, coordinates });
        };
        if given.numbers("qvel", 0, usize::MAX)?.unwrap_or_default().iter().any(|v| *v != 0.0) {
            let help = "use a keyframe at rest: joint velocities are not imported";
            return Err(Fault::at(given.place("qvel"), "`qvel` is not 0", help));
        }
        let mut rest = values.as_slice();
        let mut given = Vec::with_capacity(tree.bodies.len());
        for body in &tree.bodies {
            let (mine, others) = rest.split_at(own(body));
            rest = others;
            given.push((!mine.is_empty()).then_some(mine));
        }
        let (start, coordinates) = place(tree, &given);
        Ok(Self { first, start, coordinates })
    }

    /// The poses at which every spring of a hinge or slide is at rest: MuJoCo measures the free lengths of tendons
    /// there.
    pub(crate) fn at_rest(tree: &Tree) -> Vec<Isometry3<f64>> {
        let rest: Vec<Option<[f64; 1]>> = tree
            .bodies
            .iter()
            .map(|body| {
                let joint = body.joint.as_ref()?;
                let coordinate = matches!(joint.freedom, Freedom::Hinge | Freedom::Slide);
                coordinate.then_some([joint.spring_reference])
            })
            .collect();
        let given: Vec<Given<'_>> = rest.iter().map(|one| one.as_ref().map(|q| &q[..])).collect();
        place(tree, &given).0
    }
}

/// The keyframe with a name.
pub(crate) fn key<'e>(root: &'e Element, name: &str) -> Result<&'e Element, Fault> {
    let keys: Vec<&Element> =
        root.sections("keyframe").flat_map(|section| &section.children).collect();
    keys.iter().copied().find(|key| key.text("name") == Some(name)).ok_or_else(|| {
        let names: Vec<&str> = keys.iter().filter_map(|key| key.text("name")).collect();
        let help = if names.is_empty() {
            "the file has no named keyframe".to_owned()
        } else {
            format!("known keyframes: {}", names.join(", "))
        };
        Fault::at(root.place, format!("unknown keyframe `{name}`"), help)
    })
}

/// Computes the pose of each body from that of its parent, which precedes it.
fn place(tree: &Tree, given: &[Given<'_>]) -> (Vec<Isometry3<f64>>, Vec<f64>) {
    let mut poses: Vec<Isometry3<f64>> = Vec::with_capacity(tree.bodies.len());
    let mut coordinates = Vec::with_capacity(tree.bodies.len());
    for (number, body) in tree.bodies.iter().enumerate() {
        let parent = if number == WORLD { Isometry3::identity() } else { poses[body.parent] };
        let mut pose = parent * body.pose;
        let mut coordinate = 0.0;
        if let Some(joint) = &body.joint {
            let own = given[number].filter(|_| !joint.locked);
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
