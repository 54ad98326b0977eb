//! Joints: positions on their bodies, and axes of rotation.
//!
//! `groups of a joint => points, axes`. A joint's point is the mean of the points that its type defines (`dbd-scene`,
//! joints), on the first body; on the second the same point.

use std::collections::{BTreeMap, BTreeSet};

use dbd_kernel::model::{Group, Law};
use dbd_kernel::{BodyIndex, Vec3};
use dbd_scene::{JointInfo, Scene};

use super::parts::{Along, JointKind, JointMark, JointSpring, Mechanism, Place};

/// A body's row, `None` for the ground, moved by an input or not.
pub(super) fn row(body: BodyIndex) -> Option<usize> {
    (!body.is_world()).then(|| body.row())
}

/// The rows of the spiders of universal joints.
pub(super) fn spiders(scene: &Scene) -> BTreeSet<usize> {
    let universal = scene.joints.iter().filter(|joint| joint.spider.is_some());
    universal
        .filter_map(|joint| scene.model.groups.get(joint.groups.start))
        .filter_map(|group| row(group.b))
        .collect()
}

/// The joints of a scene, and where they are.
pub(super) fn joints(scene: &Scene, mechanism: &Mechanism) -> (Vec<JointMark>, Pivots) {
    let (mut marks, mut pivots) = (Vec::new(), Pivots::default());
    for info in &scene.joints {
        let Some(mark) = joint(scene, mechanism, info) else { continue };
        let place = mark.places[0];
        let [a, b] = mark.places.map(|place| place.body);
        pivots.of_pair.entry(pair(a, b)).or_insert(place);
        for number in info.groups.clone() {
            pivots.of_group.insert(number, mechanism.place(&place));
            if let Some(group) = scene.model.groups.get(number) {
                pivots.of_pair.entry(pair(row(group.a), row(group.b))).or_insert(place);
            }
        }
        marks.push(mark);
    }
    (marks, pivots)
}

/// The TSDAs of all joints.
pub(super) fn joint_springs(scene: &Scene) -> Vec<JointSpring> {
    let mut springs = Vec::new();
    for (joint, info) in scene.joints.iter().enumerate() {
        for group in scene.model.groups.get(info.groups.clone()).unwrap_or_default() {
            if group.law != Law::Tsda {
                continue;
            }
            let (triples, arms) = (centres(scene, group), usize::from(group.arms));
            let end = |body, point: &Vec3<f64>| Place { body: row(body), point: point.to_f64() };
            for (triple, centre) in triples.iter().enumerate() {
                let block = if group.shared { 0 } else { triple };
                let tips = tips(scene, group).iter().skip(block * arms).take(arms);
                let ends = tips.map(|tip| [end(group.a, centre), end(group.b, tip)]);
                springs.extend(ends.map(|ends| JointSpring { joint, ends }));
            }
        }
    }
    springs
}

/// Points of joints, by their bodies and by their groups.
#[derive(Default)]
pub(super) struct Pivots {
    of_pair: BTreeMap<[Option<usize>; 2], Place>,
    of_group: BTreeMap<usize, Vec3<f64>>,
}

impl Pivots {
    /// The point of the first joint between two bodies, including spiders.
    pub(super) fn between(&self, a: Option<usize>, b: Option<usize>) -> Option<Place> {
        self.of_pair.get(&pair(a, b)).copied()
    }

    /// The point \[m, world\] of the joint of a group.
    pub(super) fn of_group(&self, number: usize) -> Option<Vec3<f64>> {
        self.of_group.get(&number).copied()
    }
}

fn pair(a: Option<usize>, b: Option<usize>) -> [Option<usize>; 2] {
    [a.min(b), a.max(b)]
}

fn joint(scene: &Scene, mechanism: &Mechanism, info: &JointInfo) -> Option<JointMark> {
    let groups = scene.model.groups.get(info.groups.clone())?;
    let (first, last) = (groups.first()?, groups.last()?);
    let kind = kind(info.kind);
    let centres = centres(scene, first);
    // A fixed joint's third centre is off its axis.
    let about = if kind == JointKind::Fixed { centres.get(..2)? } else { centres };
    let place = Place { body: row(first.a), point: middle(about) };
    let place_w = mechanism.place(&place);
    let axes = match kind {
        JointKind::Translational => {
            let line = scene.model.lines.get(usize::from(first.element))?;
            vec![Along { body: row(first.a), vector: line.direction.to_f64() }]
        }
        _ => info
            .hinges
            .iter()
            .map(|hinge| Along { body: row(hinge.a), vector: hinge.axis.to_f64() })
            .collect(),
    };
    Some(JointMark {
        name: info.name.clone(),
        kind,
        places: [place, mechanism.local(row(last.b), place_w)],
        axes,
    })
}

fn kind(name: &str) -> JointKind {
    match name {
        "fixed" => JointKind::Fixed,
        "translational" => JointKind::Translational,
        "cylindrical" => JointKind::Cylindrical,
        "revolute" => JointKind::Revolute,
        "universal" => JointKind::Universal,
        "spherical" => JointKind::Spherical,
        _ => JointKind::Other,
    }
}

/// The first body's points of a group.
pub(super) fn centres<'s>(scene: &'s Scene, group: &Group) -> &'s [Vec3<f64>] {
    let first = usize::from(group.point);
    scene.model.points.get(first..first + usize::from(group.triples)).unwrap_or(&[])
}

/// The second body's points of a group.
pub(super) fn tips<'s>(scene: &'s Scene, group: &Group) -> &'s [Vec3<f64>] {
    let first = usize::from(group.point);
    scene
        .model
        .points
        .get(first + usize::from(group.triples)..first + group.points())
        .unwrap_or(&[])
}

/// The mean of points, halved first so that sums of far points stay finite.
fn middle(points: &[Vec3<f64>]) -> [f64; 3] {
    let share = 1.0 / points.len().max(1) as f64;
    points.iter().fold(Vec3::ZERO, |sum, point| sum + *point * share).to_f64()
}
