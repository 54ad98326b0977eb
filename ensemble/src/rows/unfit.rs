//! Which models lanes step by themselves, and why not the others.
//!
//! `model => the first thing that does not fit`.

use dbd_kernel::geometry::{Float, Named};
use dbd_kernel::index::{ClearanceIndex, DamperIndex};
use dbd_kernel::model::{Group, Law};
use dbd_kernel::{Real, Vec3};
use dbd_scene::SceneModel;
use thiserror::Error;

use dbd_kernel::elements::gravity::weight;

/// The first thing of a model that lanes do not step. Groups and bodies are counted from 0.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Error)]
#[non_exhaustive]
pub enum Unfit {
    /// A group that is no revolute of six TSDAs between two points and three of a body.
    #[error("group {0} is no revolute joint of six springs, the only one that lanes step")]
    Joint(usize),
    /// A group of which a body is not in the model, or whose second is the ground.
    #[error("group {0} is not from a body or the ground to a body")]
    Ends(usize),
    /// A group with dampers: the sweeps that act on them go from joint to joint.
    #[error("group {0} has dampers, which act one after the other")]
    Damper(usize),
    /// A group with a clearance.
    #[error("group {0} has a clearance")]
    Clearance(usize),
    /// Torsion springs, whose turns are counted.
    #[error("it has torsion springs")]
    Torsion,
    /// Loads, which begin and end.
    #[error("it has loads")]
    Load,
    /// Inputs, which are set between steps.
    #[error("it has inputs")]
    Input,
    /// A weight along an axis that is a negative zero: the sign of a zero that is added to it would show.
    #[error("the weight of body {0} has a negative zero")]
    Weight(usize),
}

/// Whether lanes can step a model by itself: every joint is a revolute of six TSDAs without damping and clearance, and
/// there is nothing else but gravity.
///
/// # Errors
/// The first thing that does not fit.
pub fn fits<R: Real + Named>(model: &SceneModel<Float<R>>) -> Result<(), Unfit> {
    let others = [
        (model.torsions.is_empty(), Unfit::Torsion),
        (model.loads.is_empty(), Unfit::Load),
        (model.inputs.is_empty(), Unfit::Input),
    ];
    if let Some((_, unfit)) = others.into_iter().find(|(is_none, _)| !is_none) {
        return Err(unfit);
    }
    let bodies = model.bodies.len();
    for (number, group) in model.groups.iter().enumerate() {
        let Group { law, a, b, stars, arms, shared, damper, clearance, .. } = *group;
        if (law, stars, arms, shared) != (Law::Tsda, 2, 3, true) {
            return Err(Unfit::Joint(number));
        }
        if usize::from(b.0) >= bodies || (!a.is_world() && usize::from(a.0) >= bodies) {
            return Err(Unfit::Ends(number));
        }
        if damper != DamperIndex::NONE {
            return Err(Unfit::Damper(number));
        }
        if clearance != ClearanceIndex::NONE {
            return Err(Unfit::Clearance(number));
        }
    }
    let Some(&gravity) = model.gravity.first() else { return Ok(()) };
    let is_negative_zero = |x: R| x == R::ZERO && x.to_f64().is_sign_negative();
    let has_one = |v: Vec3<R>| [v.x, v.y, v.z].into_iter().any(is_negative_zero);
    let row = model.bodies.iter().position(|body| has_one(weight(body.mass, gravity)));
    row.map_or(Ok(()), |row| Err(Unfit::Weight(row)))
}
