//! Several joints of one body, and the equivalent joints of a scene.
//!
//! `tree => stages, each from a body to a body`. A body with joints J1 … Jn is connected through n − 1 massless
//! carriers, see [`crate::tree`]. Joints that one joint of a scene represents exactly form one stage; a carrier between
//! two stages becomes a body, see [`crate::carrier`].

use std::collections::BTreeSet;

use nalgebra::{Matrix3, Vector3};

use crate::body::{Freedom, Joint};
use crate::tree::{Tree, WORLD};

/// \[1\] directions are considered parallel or normal within this sine or cosine, as for the scene's universal joint.
pub(crate) const ALIKE: f64 = 1e-6;
/// \[m\] axes at this distance are considered to intersect.
const MEETING: f64 = 1e-9;

/// How a scene represents the joints of a stage.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(crate) enum Way {
    /// As a single joint.
    Single,
    /// A hinge and a slide along its axis: a cylindrical joint.
    Cylindrical,
    /// Two hinges whose axes intersect at right angles: a universal joint.
    Universal,
    /// Three hinges whose axes intersect, without forces: a spherical joint.
    Spherical,
    /// All six degrees of freedom relative to the world, without forces: no joint.
    Free,
    /// Two slides and a hinge across them from the world, in a planar scene: no joint.
    Plane,
    /// Two slides at right angles, alone or followed by a hinge across them: a bushing without stiffness along the
    /// slides and about the hinge. A motor may act on a slide from the world only.
    Level,
}

/// The connection of a body to the previous one.
#[derive(Clone, Debug, PartialEq, Eq)]
pub(crate) struct Stage {
    /// The previous body.
    pub(crate) base: usize,
    /// The body.
    pub(crate) body: usize,
    /// The bodies whose joints the stage contains, in order; the last is `body`.
    pub(crate) joints: Vec<usize>,
    /// How a scene represents them.
    pub(crate) way: Way,
}

/// Further conditions for the stages.
pub(crate) struct Circumstances {
    /// Names of actuated joints.
    pub(crate) driven: BTreeSet<String>,
    /// Whether the scene is to be planar.
    pub(crate) planar: bool,
}

impl Circumstances {
    fn drives(&self, joint: &Joint) -> bool {
        joint.name.as_ref().is_some_and(|name| self.driven.contains(name))
    }

    fn acts(&self, joint: &Joint) -> bool {
        joint.stiffness > 0.0 || joint.damping > 0.0 || self.drives(joint)
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
    let pushed = |joint: &&&Joint| joint.freedom == Freedom::Slide && around.drives(joint);
    let reached = base == WORLD || !joints.iter().any(|joint| pushed(&joint));
    let whole = whole.or((reached && is_level(&joints)).then_some(Way::Level));
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

/// Whether joints leave every motion free without forces on any coordinate.
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

/// Whether joints leave the planar degrees of freedom free. Forces on slides require a non-rotating frame and
/// perpendicular slides.
fn is_plane(joints: &[&Joint], around: &Circumstances) -> bool {
    let (turns, slides) = (of_kind(joints, Freedom::Hinge), of_kind(joints, Freedom::Slide));
    let ([normal], [a, b]) = (&turns[..], &slides[..]) else { return false };
    let across = [a, b].into_iter().all(|slide| slide.dot(normal).abs() < ALIKE);
    let square = a.dot(b).abs() < ALIKE && joints[2].freedom == Freedom::Hinge;
    let pushed = |joint: &&&Joint| joint.freedom == Freedom::Slide && around.acts(joint);
    let calm = !joints.iter().any(|joint| pushed(&joint));
    joints.len() == 3 && across && a.cross(b).norm() > ALIKE && (square || calm)
}

/// Whether joints leave two perpendicular translations free, in a frame that does not rotate, and at most the rotation
/// about their normal.
fn is_level(joints: &[&Joint]) -> bool {
    let kinds: Vec<Freedom> = joints.iter().map(|joint| joint.freedom).collect();
    let slides = [Freedom::Slide, Freedom::Slide];
    let known = kinds == slides || kinds == [slides[0], slides[1], Freedom::Hinge];
    let axes: Vec<Vector3<f64>> = joints.iter().map(|joint| joint.axis.into_inner()).collect();
    let square = |i: usize, j: usize| axes[i].dot(&axes[j]).abs() < ALIKE;
    known && (0..axes.len()).all(|j| (0..j).all(|i| square(i, j)))
}

/// The intersection of the axes of two hinges, if any.
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

/// The intersection of the hinge axes of a stage.
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
