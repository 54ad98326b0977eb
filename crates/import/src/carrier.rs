//! Bodies between the joints of a chain, whose mass is taken from their neighbours.
//!
//! `stages, masses of parts => masses of carriers`. A thin rod on the axis of a hinge moves identically on either of
//! the hinge's bodies: its rotation about itself has no energy. The same holds for a point mass at the centre of a ball
//! joint, and for any moment of inertia across a slide, whose bodies rotate identically. Moving such mass from one body
//! to the carrier beyond the joint leaves the motion exactly unchanged. In terms of pseudo-inertias, ∫(p, 1)(p, 1)ᵀ dm,
//! such a piece is t·v·vᵀ, and a mass M can give less than t = 1/(vᵀM⁻¹v) of it (Wensing, Kim & Slotine 2018, "Linear
//! matrix inequalities for physically consistent inertial parameter identification").

use nalgebra::{Isometry3, Matrix4, Vector3, Vector4};

use crate::body::Freedom;
use crate::chain::{Stage, Way, centre};
use crate::mass::Mass;
use crate::tree::Tree;

/// A body gives at most this fraction of the possible mass, so that both bodies remain well conditioned.
const GIVEN: f64 = 0.5;
/// Each principal moment of a carrier is at least this fraction of its largest: a thinner one would have by far the
/// highest natural frequency of the scene.
const ROUND: f64 = 1e-2;

/// Mass that moves identically on both sides of a stage, in the carrier's frame.
struct Shared {
    /// Point mass at a point, which may lie anywhere along the axis.
    at: Option<(Vector3<f64>, Option<Vector3<f64>>)>,
    /// Moments along these directions.
    along: Vec<Vector3<f64>>,
}

impl Shared {
    fn of(tree: &Tree, stage: &Stage) -> Self {
        let joints: Vec<_> =
            stage.joints.iter().filter_map(|body| tree.bodies[*body].joint.as_ref()).collect();
        let (at, axis) = (centre(&joints), joints[0].axis.into_inner());
        let all = vec![Vector3::x(), Vector3::y(), Vector3::z()];
        match (stage.way, joints[0].freedom) {
            (Way::Single, Freedom::Hinge) => Self { at: Some((at, Some(axis))), along: vec![axis] },
            (Way::Single, Freedom::Slide) => Self { at: None, along: all },
            (Way::Cylindrical, _) => Self { at: None, along: vec![axis] },
            _ => Self { at: Some((at, None)), along: Vec::new() },
        }
    }

    /// Moves the mass that `from` can give to `to`; the world gives as if it were `like`.
    fn take(&self, from: Option<&mut Matrix4<f64>>, to: &mut Matrix4<f64>, like: &Matrix4<f64>) {
        let mut endless = *like;
        let from = match from {
            Some(from) => from,
            None => &mut endless,
        };
        let point = |p: Vector3<f64>| Vector4::new(p.x, p.y, p.z, 1.0);
        let direction = |d: Vector3<f64>| Vector4::new(d.x, d.y, d.z, 0.0);
        if let Some((at, axis)) = self.at {
            let mut v = point(at);
            if let (Some(axis), Some(inverse)) = (axis, from.try_inverse()) {
                let u = direction(axis);
                v -= u * (u.dot(&(inverse * v)) / u.dot(&(inverse * u)));
            }
            give(from, to, v);
        }
        for axis in &self.along {
            give(from, to, direction(*axis));
        }
    }
}

/// Moves as much of v·vᵀ as a mass can spare.
fn give(from: &mut Matrix4<f64>, to: &mut Matrix4<f64>, v: Vector4<f64>) {
    let Some(inverse) = from.try_inverse() else { return };
    let most = 1.0 / v.dot(&(inverse * v));
    if most.is_finite() && most > 0.0 {
        let piece = v * v.transpose() * (GIVEN * most);
        *from -= piece;
        *to += piece;
    }
}

/// The carriers of a body.
#[derive(Clone, Debug)]
pub(crate) struct Shares {
    /// The body.
    pub(crate) body: usize,
    /// The carriers, each with whether the motion is exactly unchanged.
    pub(crate) carriers: Vec<(usize, bool)>,
}

/// Gives each carrier its mass. `share`: fraction of the body's mass for a carrier without an exact mass.
///
/// # Errors
/// The body whose carriers have no exact mass, if no fraction is given.
pub(crate) fn share(
    tree: &Tree,
    stages: &[Stage],
    masses: &mut [Mass],
    side: impl Fn(usize) -> (Option<usize>, Isometry3<f64>),
    share: Option<f64>,
) -> Result<Vec<Shares>, usize> {
    let mut all = Vec::new();
    let part_of = |body: usize| side(body).0;
    for (last, stage) in stages.iter().enumerate().filter(|(_, one)| !tree.carries(one.body)) {
        let chain = tree.bodies[stage.body].chain;
        let first = stages.iter().position(|one| one.body >= chain).unwrap_or(last);
        let (Some(own), true) = (part_of(stage.body), first < last) else { continue };
        let carriers: Vec<usize> =
            stages[first..last].iter().filter_map(|one| part_of(one.body)).collect();
        let mut body = masses[own].pseudo();
        let mut given = vec![Matrix4::zeros(); carriers.len()];
        let like = body;
        if let Some(one) = given.last_mut() {
            Shared::of(tree, stage).take(Some(&mut body), one, &like);
        }
        if let Some(one) = given.first_mut() {
            let base = stages[first].base;
            let (part, pose) = side(base);
            let pose = pose * tree.bodies[chain].pose;
            let shared = Shared::of(tree, &stages[first]);
            match part {
                None => shared.take(None, one, &like),
                Some(part) => {
                    let mut before = masses[part].seen_from(&pose.inverse()).pseudo();
                    shared.take(Some(&mut before), one, &like);
                    masses[part] = Mass::of_pseudo(&before).seen_from(&pose);
                }
            }
        }
        let mut exact = vec![true; carriers.len()];
        for (one, exact) in given.iter_mut().zip(&mut exact) {
            let (_, moments) = Mass::of_pseudo(one).principal_axes();
            let [least, most] = [
                moments.iter().copied().fold(f64::INFINITY, f64::min),
                moments.iter().copied().fold(0.0, f64::max),
            ];
            if one[(3, 3)] > 0.0 && least > ROUND * most {
                continue;
            }
            *exact = false;
            let Some(share) = share else { return Err(stage.body) };
            let piece = body * share;
            *one += piece;
            body -= piece;
        }
        masses[own] = Mass::of_pseudo(&body);
        for (part, one) in carriers.iter().zip(&given) {
            masses[*part] = Mass::of_pseudo(one);
        }
        let numbers = stages[first..last].iter().map(|one| one.body);
        all.push(Shares { body: stage.body, carriers: numbers.zip(exact).collect() });
    }
    Ok(all)
}
