//! Inertia driven by a hinge or a slide at the file's pose, with the rest of the mechanism free.
//!
//! `tree, poses => joint-space inertia M => 1/(M⁻¹)ᵢᵢ`, as MuJoCo uses for damping ratios.

use std::collections::BTreeMap;

use nalgebra::{DMatrix, Isometry3, Vector3};

use crate::body::Freedom;
use crate::tree::{Tree, moved};

/// A free velocity of a joint: its body, the axis, the fixed point; none: a translation.
struct Motion {
    body: usize,
    axis: Vector3<f64>,
    about: Option<Vector3<f64>>,
    armature: f64,
}

fn motions(tree: &Tree, poses: &[Isometry3<f64>]) -> Vec<Motion> {
    let mut found = Vec::new();
    for (body, one) in tree.bodies.iter().enumerate() {
        let Some(joint) = one.joint.as_ref().filter(|joint| !joint.locked) else { continue };
        let (turn, armature) = (poses[body].rotation, joint.armature);
        let at = moved(&poses[body], joint.anchor);
        let every = [Vector3::x(), Vector3::y(), Vector3::z()].map(|axis| turn * axis);
        let mut add = |axis, about| found.push(Motion { body, axis, about, armature });
        match joint.freedom {
            Freedom::Hinge => add(turn * joint.axis.into_inner(), Some(at)),
            Freedom::Slide => add(turn * joint.axis.into_inner(), None),
            Freedom::Ball => every.into_iter().for_each(|axis| add(axis, Some(at))),
            Freedom::Free => {
                every.into_iter().for_each(|axis| add(axis, None));
                every.into_iter().for_each(|axis| add(axis, Some(at)));
            }
        }
    }
    found
}

/// \[kg·m², kg\] inertia driven by the hinges and slides by body, including armatures; none for a mechanism with a
/// massless moving body.
pub(crate) fn driven(tree: &Tree, poses: &[Isometry3<f64>]) -> BTreeMap<usize, f64> {
    let motions = motions(tree, poses);
    let mut inertia = DMatrix::zeros(motions.len(), motions.len());
    for (i, motion) in motions.iter().enumerate() {
        inertia[(i, i)] = motion.armature;
    }
    let mut above: Vec<Vec<usize>> = vec![Vec::new(); tree.bodies.len()];
    for (number, one) in tree.bodies.iter().enumerate().skip(1) {
        above[number] = above[one.parent].clone();
        above[number].extend((0..motions.len()).filter(|i| motions[*i].body == number));
        let centre = moved(&poses[number], one.mass.centre);
        let turn = poses[number].rotation;
        let rate = |motion: &Motion| match motion.about {
            Some(at) => (motion.axis.cross(&(centre - at)), motion.axis),
            None => (motion.axis, Vector3::zeros()),
        };
        for i in &above[number] {
            let (v, w) = rate(&motions[*i]);
            let (p, l) = (v * one.mass.mass, turn * one.mass.momentum(&(turn.inverse() * w)));
            for j in &above[number] {
                let (v, w) = rate(&motions[*j]);
                inertia[(*i, *j)] += p.dot(&v) + l.dot(&w);
            }
        }
    }
    let Some(factors) = inertia.cholesky() else { return BTreeMap::new() };
    let inverse = factors.inverse();
    let own = |(i, motion): (usize, &Motion)| (motion.body, 1.0 / inverse[(i, i)]);
    let single = |motion: &Motion| {
        let joint = tree.bodies[motion.body].joint.as_ref();
        joint.is_some_and(|joint| matches!(joint.freedom, Freedom::Hinge | Freedom::Slide))
    };
    motions.iter().enumerate().filter(|(_, motion)| single(motion)).map(own).collect()
}
