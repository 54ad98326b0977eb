//! The strength of dampers relative to the masses they act on.
//!
//! `(model, state) => c/μ per group and torsion spring` \[1/s\], the rate at which a damper alone would stop its two
//! bodies. For choosing a step; a step does not use it.

use crate::damping::mode::DampingMode;
use crate::damping::modes::find;
use crate::damping::motion::{Motion, Mount, Pose};
use crate::damping::near::Held;
use crate::model::{FrameOf, ModelOwner, RealOf};
use crate::pose::{Places, place_bodies};
use crate::real::Real;
use crate::state::State;

/// The owner of dampers.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum DampersOf {
    /// The group in this row.
    Group(usize),
    /// The torsion spring in this row.
    Torsion(usize),
    /// The law in this row.
    Law(usize),
}

/// The strength of the dampers of a group or of a torsion spring.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Strength {
    /// Their owner.
    pub of: DampersOf,
    /// \[1/s\] c/μ of the strongest.
    pub rate: f64,
    /// \[1/s\] the largest `Σ_j c_j·K_ij²/K_ii` of a damper i: what all dampers of its group and of those that share a
    /// body, itself included, take along its motion, but at most twice that of the dampers that cross it,
    /// `Σ_j min(c_i·K_ii, c_j·K_jj)`. 0 where no dampers cross: collinear and orthogonal dampers do not.
    pub crossed: f64,
}

/// Dampers cross where `4·k²·(1 − k²)` is larger, `k² = K_ij²/(K_ii·K_jj)`: 0 for collinear and for orthogonal dampers,
/// 1 halfway.
const CROSSING: f64 = 0.02;

/// Visits all elements with dampers at the pose of `state`, groups first.
pub fn strengths<M: ModelOwner>(model: &M, state: &State<M>, visit: impl FnMut(Strength)) {
    look(model, state, false, visit);
}

/// [`strengths`] for [`Damping::JointWise`](crate::damping::Damping::JointWise): a joint's dampers are modes that do
/// not cross one another, and those of joints between the same two bodies belong to the first joint.
pub fn strengths_of_joints<M: ModelOwner>(
    model: &M,
    state: &State<M>,
    visit: impl FnMut(Strength),
) {
    look(model, state, true, visit);
}

fn look<M: ModelOwner>(
    model: &M,
    state: &State<M>,
    joint_wise: bool,
    mut visit: impl FnMut(Strength),
) {
    let view = model.view();
    let bodies = state.bodies.as_ref();
    let mut frames = model.per_body(FrameOf::<M>::default());
    place_bodies::<M::Precision>(bodies, frames.as_mut());
    let places = Places { frames: frames.as_ref(), signals: state.signals.as_ref() };
    let mut modes = model.per_damper(DampingMode::default());
    if joint_wise {
        find(&view, places, RealOf::<M>::ZERO, modes.as_mut());
    }
    let modes = if joint_wise { modes.as_ref() } else { &[] };
    let memories = (state.turns.as_ref(), &state.laws);
    let pose = Pose { model: &view, places, bodies, memories, modes };
    let one = RealOf::<M>::ONE;
    let crossing = RealOf::<M>::from_f64(0.25 * CROSSING);
    let mut held = model.per_body(Held::default());
    pose.hold(held.as_mut());
    for mount in pose.mounts() {
        let Some(ends) = pose.ends(mount) else { continue };
        let [mut strongest, mut crossed] = [RealOf::<M>::ZERO; 2];
        pose.each_damper(mount, |_, _, coefficient, direction| {
            let Some(motion) = Motion::new(&view, ends, coefficient, direction) else { return };
            let rate = coefficient * motion.rate;
            let [mut along, mut across] = [RealOf::<M>::ZERO; 2];
            for (_, other, others) in pose.meeting(held.as_ref(), ends) {
                pose.each_damper(other, |_, _, coefficient, direction| {
                    let its = Motion::new(&view, others, coefficient, direction);
                    let Some(its) = its else { return };
                    let here = motion.rate(others, direction);
                    along = along + coefficient * here * (here / motion.rate);
                    let square = here / motion.rate * (here / its.rate);
                    if square * (one - square) > crossing {
                        let its_rate = coefficient * its.rate;
                        across = across + smaller(rate, its_rate);
                    }
                });
            }
            strongest = larger(strongest, rate);
            crossed = larger(crossed, smaller(along, across + across));
        });
        let of = match mount {
            Mount::Group(row) => DampersOf::Group(row),
            Mount::Torsion(row) => DampersOf::Torsion(row),
            Mount::Law(row) => DampersOf::Law(row),
        };
        let [rate, crossed] = [strongest, crossed].map(Real::to_f64);
        visit(Strength { of, rate, crossed });
    }
}

fn larger<R: Real>(a: R, b: R) -> R {
    if b > a { b } else { a }
}

fn smaller<R: Real>(a: R, b: R) -> R {
    if b < a { b } else { a }
}
