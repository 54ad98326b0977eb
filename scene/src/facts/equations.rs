//! How many loops of joints move in a plane.
//!
//! A solver with constraints has 6 equations per body and one per freedom held, and must leave
//! out what is held twice. A loop of revolutes with parallel axes, and of translational joints
//! across them, holds three freedoms twice: the shift along the axes and both tilts. The paper
//! drops them by putting one spherical and one cylindrical joint in place of two revolutes per
//! loop (Franco & Degani 2026, section 3.3); the count is the same. Loops in space hold nothing
//! twice in general, and special ones are not searched for.

use dbd_kernel::Vec3;

use crate::Scene;
use crate::facts::axis_w;
use crate::parts::Parts;

/// Cosine between directions that are across, sine between those that are parallel: the axes of
/// a mechanism are written with some digits.
const ALIGNED: f64 = 1e-6;

/// A joint between two bodies as a loop sees it.
enum Link {
    /// A turn about an axis, world.
    Turn(Vec3<f64>),
    /// A slide along an axis, world.
    Slide(Vec3<f64>),
    /// No motion.
    Rigid,
}

/// The independent planar loops, over all directions of axes.
pub(super) fn planar_loops(scene: &Scene) -> usize {
    let links = links(scene);
    let mut directions: Vec<Vec3<f64>> = Vec::new();
    for (_, link) in &links {
        if let Link::Turn(axis) = link
            && !directions.iter().any(|known| parallel(*known, *axis))
        {
            directions.push(*axis);
        }
    }
    let bodies = scene.model.bodies.len();
    let loops = |direction: &Vec3<f64>| {
        let mut parts = Parts::apart(bodies + 1);
        // First what turns nothing: a loop of it alone is not one about this direction.
        for (ends, link) in &links {
            let joined = match link {
                Link::Turn(_) => false,
                Link::Slide(axis) => axis.dot(*direction).abs() < ALIGNED,
                Link::Rigid => true,
            };
            if joined {
                parts.join(ends[0], ends[1]);
            }
        }
        let turns = links
            .iter()
            .filter(|(_, link)| matches!(link, Link::Turn(axis) if parallel(*axis, *direction)));
        turns.filter(|(ends, _)| !parts.join(ends[0], ends[1])).count()
    };
    directions.iter().map(loops).sum()
}

fn parallel(a: Vec3<f64>, b: Vec3<f64>) -> bool {
    let cross = a.cross(b);
    cross.dot(cross) < ALIGNED * ALIGNED
}

/// The joints that may be part of a planar loop, a universal joint as its two revolutes. The
/// world comes after all bodies.
fn links(scene: &Scene) -> Vec<([usize; 2], Link)> {
    let mut links = Vec::new();
    for joint in &scene.joints {
        for number in joint.groups.clone() {
            let group = &scene.model.groups[number];
            let ends = [group.a, group.b].map(|body| body.row().min(scene.model.bodies.len()));
            let link = match (joint.kind, axis_w(scene, number)) {
                ("revolute" | "universal", Some(axis)) => Link::Turn(axis),
                ("translational", Some(axis)) => Link::Slide(axis),
                ("fixed", _) => Link::Rigid,
                _ => continue,
            };
            links.push((ends, link));
        }
    }
    links
}
