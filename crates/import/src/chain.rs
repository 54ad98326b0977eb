//! Several joints of one body, and which joints of a scene say them.
//!
//! `tree => stages, each from a body to a body`. A body with joints J1 … Jn hangs on n − 1 carriers without
//! mass, see [`crate::tree`]. What one joint of a scene holds exactly is one stage; a carrier between two
//! stages becomes a body, see [`crate::carrier`].

use std::collections::BTreeSet;

use nalgebra::{Matrix3, Vector3};

use crate::body::{Freedom, Joint};
use crate::tree::{Tree, WORLD};

/// \[1\] directions count as parallel or normal to each other within this sine or cosine, as the scene's
/// own universal joint has it.
pub(crate) const ALIKE: f64 = 1e-6;
/// \[m\] axes meet that pass each other this closely.
const MEETING: f64 = 1e-9;

/// How a scene says the joints of a stage.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(crate) enum Way {
    /// By the one joint that it is.
    Single,
    /// A hinge and a slide along its axis: a cylindrical joint.
    Cylindrical,
    /// Two hinges whose axes meet at right angles: a universal joint.
    Universal,
    /// Three hinges whose axes meet, on which nothing acts: a spherical joint.
    Spherical,
    /// Slides and turns in every direction from the world, on which nothing acts: no joint.
    Free,
    /// Two slides and a hinge across them from the world, in a planar scene: no joint.
    Plane,
}

/// What joins a body to the one before it.
#[derive(Clone, Debug, PartialEq, Eq)]
pub(crate) struct Stage {
    /// The body before it.
    pub(crate) base: usize,
    /// The body.
    pub(crate) body: usize,
    /// The bodies whose joints the stage has, in their order; the last is `body`.
    pub(crate) joints: Vec<usize>,
    /// How a scene says them.
    pub(crate) way: Way,
}

/// What the stages depend on beside the joints.
pub(crate) struct Circumstances {
    /// Names of joints on which an actuator acts.
    pub(crate) driven: BTreeSet<String>,
    /// Whether the scene is to be planar.
    pub(crate) planar: bool,
}

impl Circumstances {
    fn acts(&self, joint: &Joint) -> bool {
        let driven = joint.name.as_ref().is_some_and(|name| self.driven.contains(name));
        joint.stiffness > 0.0 || joint.damping > 0.0 || driven
    }
}

/// The stages of all bodies in their order.
pub(crate) fn stages(tree: &Tree, around: &Circumstances) -> Vec<Stage> {
    let mut found = Vec::new();
    for (number, body) in tree.bodies.iter().enumerate() {
        if tree.carries(number) || body.joint.is_none() {
            continue;
        }
        let base = tree.bodies[body.chain].parent;
        let free = |body: &usize| tree.bodies[*body].joint.as_ref().is_some_and(|one| !one.locked);
        let joints: Vec<usize> = (body.chain..=number).filter(free).collect();
        of_body(tree, around, base, &joints, &mut found);
    }
    found
}

/// The stages of one body.
fn of_body(
    tree: &Tree,
    around: &Circumstances,
    mut base: usize,
    mut rest: &[usize],
    found: &mut Vec<Stage>,
) {
    let joints: Vec<&Joint> =
        rest.iter().filter_map(|body| tree.bodies[*body].joint.as_ref()).collect();
    let whole = if base != WORLD {
        None
    } else if is_free(&joints, around) {
        Some(Way::Free)
    } else if around.planar && is_plane(&joints, around) {
        Some(Way::Plane)
    } else {
        None
    };
    if let (Some(way), Some(body)) = (whole, rest.last()) {
        found.push(Stage { base, body: *body, joints: rest.to_vec(), way });
        return;
    }
    let mut joints = &joints[..];
    while !rest.is_empty() {
        let (count, way) = match joints {
            [a, b, c, ..] if is_spherical([a, b, c], around) => (3, Way::Spherical),
            [a, b, ..] if is_cylindrical(a, b) => (2, Way::Cylindrical),
            [a, b, ..] if is_universal(a, b) => (2, Way::Universal),
            _ => (1, Way::Single),
        };
        let (own, others) = rest.split_at(count);
        found.push(Stage { base, body: own[count - 1], joints: own.to_vec(), way });
        (base, rest, joints) = (own[count - 1], others, &joints[count..]);
    }
}

fn axes_are_independent(axes: [Vector3<f64>; 3]) -> bool {
    Matrix3::from_columns(&axes).determinant().abs() > ALIKE
}

fn of_kind(joints: &[&Joint], freedom: Freedom) -> Vec<Vector3<f64>> {
    let of = joints.iter().filter(|joint| joint.freedom == freedom);
    of.map(|joint| joint.axis.into_inner()).collect()
}

/// Whether joints leave every motion free, with none of their coordinates preferred.
fn is_free(joints: &[&Joint], around: &Circumstances) -> bool {
    let turns = of_kind(joints, Freedom::Hinge);
    let slides = of_kind(joints, Freedom::Slide);
    let ball = joints.iter().any(|joint| joint.freedom == Freedom::Ball);
    let turned = match turns[..] {
        [] => ball,
        [a, b, c] => !ball && axes_are_independent([a, b, c]),
        _ => false,
    };
    let moved = matches!(slides[..], [a, b, c] if axes_are_independent([a, b, c]));
    turned && moved && !joints.iter().any(|joint| around.acts(joint))
}

/// Whether joints leave free what a planar scene does. What acts on slides needs a frame that does not turn
/// and slides at right angles.
fn is_plane(joints: &[&Joint], around: &Circumstances) -> bool {
    let (turns, slides) = (of_kind(joints, Freedom::Hinge), of_kind(joints, Freedom::Slide));
    let ([normal], [a, b]) = (&turns[..], &slides[..]) else { return false };
    let across = [a, b].into_iter().all(|slide| slide.dot(normal).abs() < ALIKE);
    let square = a.dot(b).abs() < ALIKE && joints[2].freedom == Freedom::Hinge;
    let pushed = |joint: &&&Joint| joint.freedom == Freedom::Slide && around.acts(joint);
    let calm = !joints.iter().any(|joint| pushed(&joint));
    joints.len() == 3 && across && a.cross(b).norm() > ALIKE && (square || calm)
}

/// Where the axes of two hinges pass each other closest, if they meet.
fn meeting(a: &Joint, b: &Joint) -> Option<Vector3<f64>> {
    let (u, v) = (a.axis.into_inner(), b.axis.into_inner());
    let (normal, apart) = (u.cross(&v), b.anchor - a.anchor);
    if normal.norm() < ALIKE {
        return None;
    }
    let along = apart.cross(&v).dot(&normal) / normal.norm_squared();
    let gap = apart.dot(&normal).abs() / normal.norm();
    (gap < MEETING).then(|| a.anchor + u * along)
}

/// Where the axes of the hinges of a stage meet.
pub(crate) fn centre(joints: &[&Joint]) -> Vector3<f64> {
    match joints {
        [a, b, ..] => meeting(a, b).unwrap_or(a.anchor),
        [one] => one.anchor,
        [] => Vector3::zeros(),
    }
}

fn is_cylindrical(a: &Joint, b: &Joint) -> bool {
    let kinds = [a.freedom, b.freedom];
    let alike = a.axis.cross(&b.axis).norm() < ALIKE;
    alike
        && (kinds == [Freedom::Slide, Freedom::Hinge] || kinds == [Freedom::Hinge, Freedom::Slide])
}

fn is_universal(a: &Joint, b: &Joint) -> bool {
    let hinges = a.freedom == Freedom::Hinge && b.freedom == Freedom::Hinge;
    hinges && a.axis.dot(&b.axis).abs() < ALIKE && meeting(a, b).is_some()
}

fn is_spherical(joints: [&&Joint; 3], around: &Circumstances) -> bool {
    let [a, b, c] = joints.map(|joint| *joint);
    let hinges =
        [a, b, c].into_iter().all(|one| one.freedom == Freedom::Hinge && !around.acts(one));
    let (Some(first), Some(second)) = (meeting(a, b), meeting(b, c)) else { return false };
    let axes = [a, b, c].map(|joint| joint.axis.into_inner());
    hinges && (first - second).norm() < MEETING && axes_are_independent(axes)
}
