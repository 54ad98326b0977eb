//! Bodies between the joints of a chain, whose mass its neighbours give.
//!
//! `stages, masses of parts => masses of carriers`. A thin rod on the axis of a hinge moves alike on either
//! of the hinge's bodies: its turn about itself takes no energy. So does a point mass at the centre of a
//! ball, and about the centre of mass any moment of inertia across a slide, whose bodies turn alike. Taken
//! off one body and given to the carrier beyond the joint, they leave the motion exactly what it was. In
//! the algebra of pseudo-inertias, ∫(p, 1)(p, 1)ᵀ dm, such a piece is t·v·vᵀ, and a mass M can give less
//! than t = 1/(vᵀM⁻¹v) of it (Wensing, Kim & Slotine 2018, "Linear matrix inequalities for physically
//! consistent inertial parameter identification").

use nalgebra::{Isometry3, Matrix4, Vector3, Vector4};

use crate::body::Freedom;
use crate::chain::{Stage, Way, centre};
use crate::mass::Mass;
use crate::tree::Tree;

/// A body gives at most this fraction of what it can, so that it stays as round as the carrier becomes.
const GIVEN: f64 = 0.5;
/// A carrier turns about each axis with at least this fraction of its largest moment: a thinner one would
/// be by far the fastest thing of the scene.
const ROUND: f64 = 1e-2;

/// What moves alike on both sides of a stage, in the carrier's frame.
struct Shared {
    /// A point at which mass does, and the axis along which that point may lie.
    at: Option<(Vector3<f64>, Option<Vector3<f64>>)>,
    /// Directions along which moments do.
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

    /// Moves what `from` can give to `to`; the world gives as if it were `like`.
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

/// What became of the carriers of a body.
#[derive(Clone, Debug)]
pub(crate) struct Shares {
    /// The body.
    pub(crate) body: usize,
    /// The carriers, each with whether the motion is exactly what it was.
    pub(crate) carriers: Vec<(usize, bool)>,
}

/// Gives each carrier its mass. `share`: the fraction of its body's mass that one takes for which there is no
/// exact one.
///
/// # Errors
/// The body whose carriers have no exact mass, where no share is stated.
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
