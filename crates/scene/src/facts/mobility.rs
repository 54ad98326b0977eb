//! Freedoms that the joints leave at the initial pose.
//!
//! `scene => freedoms, bodies that cannot move`. Each joint counts as the constraints of its type, independent of its
//! realisation; raw elements are springs and constrain nothing. A driven body counts as the ground. Redundant constraints of loops count once, and
//! singular poses are examined beyond first order (`closure::mobility`).

use std::collections::BTreeMap;

use dbd_kernel::model::{Group, Law};
use dbd_kernel::{Body, BodyIndex, F64, Geometry, Quaternion, Vec3};

use crate::closure::{self, Closure, Mobility, Place, Pose, Turn};
use crate::direction::normals;
use crate::facts::lengths::{End, points};
use crate::facts::pose::{axis_w, frames};
use crate::facts::stiffness::law;
use crate::joints::JointInfo;
use crate::orientation::of_axes;
use crate::parts::Parts;
use crate::scene::Scene;

/// Larger sets of connected bodies are not examined: the time grows with the third power.
pub(super) const MAX_BODIES: usize = 60;

/// A joint that is ten times softer than the stiffest is a mount: it is meant to deflect, like the rubber bushing of
/// a suspension arm, and locks nothing.
const MOUNT: f64 = 0.1;

/// Constraints of the joints.
pub(super) struct Held {
    pub(super) mobility: Mobility,
    /// Indices of bodies that cannot move.
    pub(super) locked: Vec<usize>,
    /// Indices of joints between two bodies that each let these move, but together do not.
    pub(super) jammed: Vec<Vec<usize>>,
}

/// Constraints of the joints; `None` if too many bodies are connected.
pub(super) fn held(scene: &Scene) -> Option<Held> {
    let mut holds = holds(scene);
    let initial = scene.model.initial.iter();
    let poses: Vec<Pose> =
        initial.map(|state| Pose::new(state.position, state.orientation)).collect();
    let closures =
        |holds: &[Hold]| holds.iter().map(|hold| hold.closure.clone()).collect::<Vec<_>>();
    let all = closures(&holds);
    let movable = vec![true; poses.len()];
    if closure::largest_island(&all, &movable) > MAX_BODIES {
        return None;
    }
    let scale = closure::arm(&all, &movable);
    let jammed = jammed(scene, &holds, &poses, scale);
    let mut mobility = closure::mobility(&all, &poses, scale);
    // No joint holds a driven body here; inputs do.
    let driven = 6 * scene.model.bodies.iter().filter(|body| body.is_driven()).count();
    mobility.freedoms -= driven;
    mobility.first_order -= driven;
    let stiffest = holds.iter().map(|hold| hold.stiffness).fold(0.0, f64::max);
    holds.retain(|hold| hold.stiffness > MOUNT * stiffest);
    let locked = locked(&closures(&holds), &poses, movable, scale);
    Some(Held { mobility, locked, jammed })
}

/// Types of joints with one or two freedoms. Several others between two bodies may be a mount.
const MOVING: [&str; 3] = ["revolute", "cylindrical", "translational"];

/// Joints between two bodies that each let these move, but together do not.
fn jammed(scene: &Scene, holds: &[Hold], poses: &[Pose], scale: f64) -> Vec<Vec<usize>> {
    let mut between: BTreeMap<[usize; 2], Vec<&Hold>> = BTreeMap::new();
    for hold in holds.iter().filter(|hold| MOVING.contains(&scene.joints[hold.joint].kind)) {
        between.entry(pair(&hold.closure, poses.len())).or_default().push(hold);
    }
    between.retain(|[body, _], own| {
        let closures: Vec<_> = own.iter().map(|hold| hold.closure.clone()).collect();
        own.len() > 1 && is_rigid(&closures, *body, poses, scale)
    });
    between.into_values().map(|own| own.iter().map(|hold| hold.joint).collect()).collect()
}

/// Indices of the bodies of a joint, the lower first; the world counts as last.
fn pair(closure: &Closure, bodies: usize) -> [usize; 2] {
    let [a, b] = closure.ends.map(|body: BodyIndex| body.row().min(bodies));
    [a.min(b), a.max(b)]
}

/// Whether joints between two bodies leave no motion of first order.
fn is_rigid(closures: &[Closure], body: usize, poses: &[Pose], scale: f64) -> bool {
    let mut movable = vec![false; poses.len()];
    movable[body] = true;
    closure::still(closures, poses, &movable, scale) == [body]
}

/// Bodies that cannot move although no joints to a single other body fix them to one that is at rest.
fn locked(closures: &[Closure], poses: &[Pose], mut movable: Vec<bool>, scale: f64) -> Vec<usize> {
    let bodies = poses.len();
    let mut joined = Parts::apart(bodies + 1);
    for [a, b] in closures.iter().map(|closure| pair(closure, bodies)) {
        joined.join(a, b);
    }
    // The motion of bodies without a connection to the world is relative to the first of them.
    let mut seen_from: Vec<usize> = (0..=bodies).map(|body| joined.first(body)).collect();
    let grounded = seen_from[bodies];
    for from in &mut seen_from {
        if *from == grounded {
            *from = bodies;
        } else {
            movable[*from] = false;
        }
    }
    let mut still = closure::still(closures, poses, &movable, scale);
    if still.is_empty() {
        return still;
    }
    let mut rigid = rigid(closures, poses, scale);
    still.retain(|body| rigid.first(*body) != rigid.first(seen_from[*body]));
    let moving = closure::moving(closures, poses, &movable, scale);
    still.retain(|body| !moving[*body]);
    still.sort_unstable();
    still
}

/// Bodies that joints between them connect rigidly; the world counts as last.
fn rigid(closures: &[Closure], poses: &[Pose], scale: f64) -> Parts {
    let mut between: BTreeMap<[usize; 2], Vec<Closure>> = BTreeMap::new();
    for closure in closures {
        between.entry(pair(closure, poses.len())).or_default().push(closure.clone());
    }
    let mut rigid = Parts::apart(poses.len() + 1);
    for ([a, b], own) in between {
        if is_rigid(&own, a, poses, scale) {
            rigid.join(a, b);
        }
    }
    rigid
}

/// A joint, or one of the two revolute joints of a universal joint of TSDAs.
struct Hold {
    /// Its index.
    joint: usize,
    closure: Closure,
    /// \[N/m\] stiffness of its elements.
    stiffness: f64,
}

fn holds(scene: &Scene) -> Vec<Hold> {
    let frames = frames(scene);
    let mut holds = Vec::new();
    for (joint, info) in scene.joints.iter().enumerate() {
        let revolutes = if info.spider.is_some() { info.groups.len() } else { 1 };
        for number in info.groups.clone().take(revolutes) {
            let stiffness = law(scene, &scene.model.groups[number], 0).0;
            let closure = closure(scene, &frames, info, number);
            if closure.ends.iter().any(|end| !end.is_world()) {
                holds.push(Hold { joint, closure, stiffness });
            }
        }
    }
    holds
}

/// Constraints at the initial pose of the joint to which a group belongs.
fn closure(
    scene: &Scene,
    frames: &[<F64 as Geometry>::Frame],
    joint: &JointInfo,
    number: usize,
) -> Closure {
    let group: &Group = &scene.model.groups[number];
    let ends = [group.a, group.b].map(|body| End { scene, frames, body });
    let count = group.elements() as f64;
    let centres = (0..group.elements()).map(|i| points(scene, group, i)[0]);
    let at_w = ends[0].place(centres.fold(Vec3::ZERO, |sum, centre| sum + centre) * (1.0 / count));
    let axis = axis_w(scene, number).unwrap_or(Vec3::new(0.0, 0.0, 1.0));
    let (place, turn) = match joint.spider {
        Some(_) => (Place::Point, Turn::Axis),
        None => crate::joints::holds(joint.kind),
    };
    let axes = if group.law == Law::Universal {
        let universal = &scene.model.universals[usize::from(group.element)];
        [ends[0].to_world(universal.lever), ends[1].to_world(universal.axis)]
    } else {
        [axis; 2]
    };
    let axes = axes.map(|axis| crate::direction::unit(axis).unwrap_or(Vec3::new(0.0, 0.0, 1.0)));
    let is_driven =
        |body: BodyIndex| scene.model.bodies.get(body.row()).is_some_and(Body::is_driven);
    let ends = ends.map(|end| match is_driven(end.body) {
        true => End { body: BodyIndex::WORLD, ..end },
        false => end,
    });
    Closure {
        ends: ends.each_ref().map(|end| end.body),
        place,
        turn,
        points: [0, 1].map(|end| ends[end].to_local(at_w)),
        triads: [0, 1].map(|end| {
            Quaternion::from_f64(of_axes(triad(axes[end]).map(|e| ends[end].to_body(e))))
        }),
    }
}

/// A right-handed triad about an axis. Its reference is one of two axes and switches far from both, so that rounding
/// does not decide.
fn triad(axis: Vec3<f64>) -> [Vec3<f64>; 3] {
    let reference =
        if axis.x.abs() > 0.59 { Vec3::new(0.0, 1.0, 0.0) } else { Vec3::new(1.0, 0.0, 0.0) };
    let [e1, e2] = normals(axis, reference).unwrap_or([axis; 2]);
    [e1, e2, axis]
}
