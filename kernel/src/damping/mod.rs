//! Dampers as pairwise impulses: stable at any coefficient.
//!
//! `(pose, velocities, kick, h) => velocities`. For each damper along a direction u with rate `r = u·v_rel` and
//! effective mass μ, `1/μ = Σ_bodies (1/m + (r×u)ᵀ·I⁻¹·(r×u))`, an impulse removes the fraction `1 − exp(−x)` of the
//! rate, `x = h·c/μ` (compare Shardlow 2003). One damper pass (sweep) visits all dampers in ascending order in the
//! first half of a step, one in descending order in the second half: second order. `exp(−x)` is replaced by
//! `1/(1 + x + x²/2)`: in (0, 1], second order, plain arithmetic.
//!
//! A damper pass includes the kick before it, because the force acts at the same time as the damper, not before it. The
//! rate then follows the flow of `ṙ = a − (c/μ)·r`, `a` the kick's acceleration along u, and a strong damper leaves
//! `a·μ/c`, at which it balances the force; a pass without the kick would leave almost 0 ([`Share`]: several dampers on
//! one force). At rest under balanced forces a pass does nothing.
//!
//! A TSDA damps along its line, a torsion spring along its gradient, a point bushing along the world's axes, a point on
//! a line along the line's two normals, a revolute of bushings along and about its axis and the normals, a universal
//! joint as a bushing and about the normal of its axes, one after the other. Velocities are rounded once per pair, not
//! once per damper; in single precision once per pass. Linear momentum is always conserved. Angular momentum is
//! conserved by dampers of TSDAs with a free length and of torsion springs; a damped bushing or point on a line has the
//! law `c·v_rel`, whose torque vanishes only with its deflection.

mod far;
mod joints;
mod kick;
mod laws;
mod mode;
mod modes;
mod motion;
mod moving;
mod near;
mod pair;
mod pass;
mod prepare;
mod shares;
mod strength;

pub use crate::elements::share::Share;
pub use crate::force_pair::Direction;
pub(crate) use far::{Far, Held as FarHeld};
pub(crate) use joints::sweep_joints;
pub(crate) use kick::{HalfKick, KeptKick, NoKick};
pub(crate) use laws::LawsKnown;
use laws::sweep_laws;
pub use mode::DampingMode;
pub(crate) use modes::{find, weigh};
pub(crate) use motion::Pose;
pub(crate) use near::Held;
pub(crate) use pass::Sweep;
pub(crate) use prepare::{include_inputs, prepare};
pub(crate) use shares::share;
pub use strength::{DampersOf, Strength, strengths, strengths_of_joints};

use core::marker::PhantomData;

use crate::body::BodyState;
use crate::damping::kick::Kick;
use crate::damping::moving::Moving;
use crate::damping::pair::{Damper, Pair};
use crate::elements::clearance;
use crate::elements::torsion_spring::TorsionSpring;
use crate::geometry::Geometry;
use crate::index::BodyIndex;
use crate::model::{Group, Law, ModelRef, Terms};
use crate::pose::{
    CountOf, End, MAX_ARMS, Placed, Places, Spot, held_turns, placed, torsion_angle_of,
};
use crate::real::{Mask as _, Real};
use crate::space::{Linear as _, Space, Vector as _};

/// How a scheme treats dampers.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
#[cfg_attr(all(feature = "defmt", target_os = "none"), derive(defmt::Format))]
pub enum Damping {
    /// A damper pass of half a step after each half kick, or around a composition: this module.
    Sweeps,
    /// As `Sweeps`, with all dampers of a joint at once, constant in the axes of one of its bodies.
    JointWise,
    /// Forces at the velocities of each evaluation: limits the step to about 2·m/c.
    Explicit,
    /// Part of the linear solve of a step, at any coefficient.
    Implicit,
}

impl Damping {
    /// The name users give: `sweeps`, `joint-wise`, `explicit`, `implicit`.
    #[must_use]
    pub const fn name(self) -> &'static str {
        match self {
            Damping::Sweeps => "sweeps",
            Damping::JointWise => "joint-wise",
            Damping::Explicit => "explicit",
            Damping::Implicit => "implicit",
        }
    }
}

/// One pass over all dampers, ascending, or descending with `REVERSE`: groups, then torsion springs, then laws.
#[inline(always)]
pub(crate) fn sweep<P: Geometry, T: Terms<P>, K: Kick<P>, const REVERSE: bool>(
    model: &ModelRef<'_, P, T>,
    sweep: &Sweep<'_, P, K>,
    laws: LawsKnown<'_, P, T>,
    bodies: &mut [BodyState<P>],
    sums: &mut [P::PassSum],
) {
    if P::Real::ONE_LANE {
        sweep_apart::<P, T, K, REVERSE>(model, sweep, laws, bodies, sums);
    } else {
        sweep_here::<P, T, K, REVERSE>(model, sweep, laws, bodies, sums);
    }
}

// Compiled once for all schemes.
fn sweep_apart<P: Geometry, T: Terms<P>, K: Kick<P>, const REVERSE: bool>(
    model: &ModelRef<'_, P, T>,
    sweep: &Sweep<'_, P, K>,
    laws: LawsKnown<'_, P, T>,
    bodies: &mut [BodyState<P>],
    sums: &mut [P::PassSum],
) {
    sweep_here::<P, T, K, REVERSE>(model, sweep, laws, bodies, sums);
}

// Inlined for lanes: they are stepped by a function with more target features than its callees.
#[inline(always)]
fn sweep_here<P: Geometry, T: Terms<P>, K: Kick<P>, const REVERSE: bool>(
    model: &ModelRef<'_, P, T>,
    sweep: &Sweep<'_, P, K>,
    laws: LawsKnown<'_, P, T>,
    bodies: &mut [BodyState<P>],
    sums: &mut [P::PassSum],
) {
    let mut moving = Moving::begin(bodies, sums, &sweep.kick);
    let torsions = model.torsions.iter().zip(P::Real::counts(sweep.turns));
    if REVERSE {
        sweep_laws::<P, T, K, REVERSE>(model, sweep, laws, &mut moving);
        if T::TORSIONS {
            for (spring, &turns) in torsions.rev() {
                torsion::<P, T, K, REVERSE>(model, sweep, spring, turns, &mut moving);
            }
        }
        for group in model.groups.iter().rev() {
            sweep_group::<P, T, K, true>(model, sweep, group, &mut moving);
        }
    } else {
        for group in model.groups {
            sweep_group::<P, T, K, false>(model, sweep, group, &mut moving);
        }
        if T::TORSIONS {
            for (spring, &turns) in torsions {
                torsion::<P, T, K, REVERSE>(model, sweep, spring, turns, &mut moving);
            }
        }
        sweep_laws::<P, T, K, REVERSE>(model, sweep, laws, &mut moving);
    }
    moving.end();
}

#[inline(always)]
fn sweep_group<P: Geometry, T: Terms<P>, K: Kick<P>, const REVERSE: bool>(
    model: &ModelRef<'_, P, T>,
    sweep: &Sweep<'_, P, K>,
    group: &Group,
    moving: &mut Moving<'_, P>,
) {
    let Some(first) = group.damper.row() else { return };
    if T::TSDAS && group.law == Law::Tsda && group.clearance.row().is_none() {
        return sweep_triples::<P, T, K, REVERSE>(model, sweep, group, first, moving);
    }
    let places = sweep.places;
    let elements = group.elements();
    let mut pair = new_pair(model, sweep, [group.a, group.b], moving);
    for i in 0..elements {
        let i = if REVERSE { elements - 1 - i } else { i };
        let row = first + i;
        let (Some(element), Some(&whole), Some(share)) =
            (placed(model, places, (0, group), i), model.dampers.get(row), sweep.shares.get(row))
        else {
            continue;
        };
        let coefficient = engaged(model, &element, whole);
        let idle = P::Real::mask(T::CLEARANCES) & coefficient.equals(P::Real::ZERO);
        if idle.all() {
            continue;
        }
        let damper = sweep.damper::<REVERSE>(coefficient, share);
        let mut pulse = Pulse::<P, K> { pair: &mut pair, damper, idle, kick: PhantomData };
        each_direction::<P, T, REVERSE>(model, places, &element, &mut pulse);
    }
    pair.store::<P>(moving);
}

/// The pair of two ends; moved ground has a rate.
#[inline(always)]
fn new_pair<P: Geometry, T: Terms<P>, K: Kick<P>>(
    model: &ModelRef<'_, P, T>,
    sweep: &Sweep<'_, P, K>,
    ends: [BodyIndex; 2],
    moving: &Moving<'_, P>,
) -> Pair<P::Space> {
    let [a, b] = ends;
    let a = End::new(model, sweep.places, a, None);
    let b = End::new(model, sweep.places, b, None);
    let rate = b.velocity - a.velocity;
    Pair::new(model, ends.map(BodyIndex::row), moving, rate, &sweep.kick)
}

/// Visits directions. Not every visitor is a closure: a closure is not inlined at will, and a step in lanes is compiled for
/// more target features than a closure of its own would be.
trait DirectionVisitor<S: Space> {
    fn visit(&mut self, direction: &Direction<S>);
}

impl<S: Space, F: FnMut(&Direction<S>)> DirectionVisitor<S> for F {
    #[inline(always)]
    fn visit(&mut self, direction: &Direction<S>) {
        self(direction);
    }
}

/// The damper of one element on its pair.
struct Pulse<'s, P: Geometry, K> {
    pair: &'s mut Pair<P::Space>,
    damper: Damper<P::Real>,
    idle: <P::Real as Real>::Mask,
    kick: PhantomData<K>,
}

impl<P: Geometry, K: Kick<P>> DirectionVisitor<P::Space> for Pulse<'_, P, K> {
    #[inline(always)]
    fn visit(&mut self, direction: &Direction<P::Space>) {
        if P::Real::ONE_LANE { self.act_apart(direction) } else { self.act_here(direction) }
    }
}

impl<P: Geometry, K: Kick<P>> Pulse<'_, P, K> {
    #[inline]
    fn act_apart(&mut self, direction: &Direction<P::Space>) {
        self.act_here(direction);
    }

    #[inline(always)]
    fn act_here(&mut self, direction: &Direction<P::Space>) {
        self.pair.damp::<P, K>(direction, self.damper, self.idle);
    }
}

/// The directions in which an element's damper acts, one after the other.
#[inline(always)]
fn each_direction<P: Geometry, T: Terms<P>, const REVERSE: bool>(
    model: &ModelRef<'_, P, T>,
    places: Places<'_, P>,
    element: &Placed<'_, P::Vector>,
    visitor: &mut impl DirectionVisitor<P::Space>,
) {
    let group = element.group;
    let Some((mut directions, count)) = model.damped(group.law, &element.deformation) else {
        return;
    };
    if (T::REVOLUTES || T::UNIVERSALS) && REVERSE {
        each_turn::<P, T, REVERSE>(model, places, element, visitor);
    }
    if REVERSE && count > 1 {
        directions.swap(0, count - 1);
    }
    for along in directions.into_iter().take(count) {
        let moments = [
            moment(places, group.a, element.arm_a.cross(along)),
            moment(places, group.b, element.arm_b.cross(along)),
        ];
        visitor.visit(&Direction { along, moments });
    }
    if (T::REVOLUTES || T::UNIVERSALS) && !REVERSE {
        each_turn::<P, T, REVERSE>(model, places, element, visitor);
    }
}

/// The directions of the dampers that align the axes of a joint: moments only.
#[inline(always)]
fn each_turn<P: Geometry, T: Terms<P>, const REVERSE: bool>(
    model: &ModelRef<'_, P, T>,
    places: Places<'_, P>,
    element: &Placed<'_, P::Vector>,
    visitor: &mut impl DirectionVisitor<P::Space>,
) {
    let group = element.group;
    let (mut turns, count) = held_turns(model, places, group, element.index);
    if REVERSE && count > 1 {
        turns.swap(0, 1);
    }
    for turn in turns.into_iter().take(count) {
        let moments = [moment(places, group.a, turn), moment(places, group.b, turn)];
        visitor.visit(&Direction { along: P::Vector::ZERO, moments });
    }
}

/// A moment in world axes in the axes of a body; 0 for the ground.
#[inline(always)]
fn moment<P: Geometry>(places: Places<'_, P>, body: BodyIndex, world: P::Moment) -> P::Moment {
    match places.frames.get(body.row()) {
        Some(frame) => P::moment_to_body(frame, world),
        None => P::Moment::ZERO,
    }
}

/// A point of a triple's second end, with its damper's coefficient and weight.
type Damped<'s, P, R> = (&'s Spot<P>, (&'s R, &'s Share<R>));

/// The spring triples of a group without clearance: the two bodies' velocities stay in registers until the last
/// element.
#[inline(always)]
fn sweep_triples<P: Geometry, T: Terms<P>, K: Kick<P>, const REVERSE: bool>(
    model: &ModelRef<'_, P, T>,
    sweep: &Sweep<'_, P, K>,
    group: &Group,
    damper: usize,
    moving: &mut Moving<'_, P>,
) {
    let places = sweep.places;
    // A run-time count and a single loop body: unrolled it takes more flash and is no faster.
    let arms = (group.arms as usize).clamp(1, MAX_ARMS);
    let end_a = End::new(model, places, group.a, None);
    let end_b = End::new(model, places, group.b, None);
    let mut pair = new_pair(model, sweep, [group.a, group.b], moving);
    let triples = group.triples as usize;
    let (blocks, per_block) = if group.shared { (1, triples) } else { (triples, 1) };
    for i in 0..blocks {
        let block = per_block * if REVERSE { blocks - 1 - i } else { i };
        let first = group.endpoints(block);
        let Some(points @ [first, ..]) = model.points.get(first..first + arms) else { break };
        let mut endpoints = [end_b.place(first); MAX_ARMS];
        for (endpoint, point) in endpoints.iter_mut().zip(points).skip(1) {
            *endpoint = end_b.place(point);
        }
        for i in 0..per_block {
            let triple = block + if REVERSE { per_block - 1 - i } else { i };
            let damper = damper + triple * arms;
            let (Some(centre), Some(dampers), Some(shares)) = (
                model.points.get(group.centre(triple)),
                model.dampers.get(damper..damper + arms),
                sweep.shares.get(damper..damper + arms),
            ) else {
                break;
            };
            let (centre, arm_a) = end_a.place(centre);
            let mut element =
                |((endpoint, arm_b), (&coefficient, share)): Damped<'_, P, P::Real>| {
                    let d = P::displacement(&centre, endpoint);
                    let u = d * d.dot(d).sqrt().reciprocal_or_zero();
                    let mut moments = [P::Moment::ZERO; 2];
                    if pair.has(0) {
                        moments[0] = end_a.moment_to_axes(arm_a.cross(u));
                    }
                    if pair.has(1) {
                        moments[1] = end_b.moment_to_axes(arm_b.cross(u));
                    }
                    let damper = sweep.damper::<REVERSE>(coefficient, share);
                    let idle = P::Real::mask(false);
                    pair.damp::<P, K>(&Direction { along: u, moments }, damper, idle);
                };
            let dampers = dampers.iter().zip(shares);
            let elements = endpoints.get(..arms).unwrap_or_default().iter().zip(dampers);
            if REVERSE {
                elements.rev().for_each(&mut element);
            } else {
                elements.for_each(&mut element);
            }
        }
    }
    pair.store::<P>(moving);
}

/// The active part of an element's damper beyond its clearance; without a clearance all of it.
#[inline(always)]
fn engaged<P: Geometry, T: Terms<P>>(
    model: &ModelRef<'_, P, T>,
    element: &Placed<'_, P::Vector>,
    damping: P::Real,
) -> P::Real {
    let clearance = model.clearance(element.group);
    if clearance.is_none() {
        return damping;
    }
    let Some(law) = model.element(element.group.law, element.index) else { return damping };
    let extension = law.extension(&element.deformation);
    clearance::engaged(damping, extension, clearance)
}

/// A torsion spring's damper, along the gradient of its torsion angle.
#[inline(always)]
fn torsion<P: Geometry, T: Terms<P>, K: Kick<P>, const REVERSE: bool>(
    model: &ModelRef<'_, P, T>,
    sweep: &Sweep<'_, P, K>,
    spring: &TorsionSpring<P::Space>,
    turns: CountOf<P>,
    moving: &mut Moving<'_, P>,
) {
    let Some(row) = spring.damper.row() else { return };
    let direction = torsion_direction(model, sweep.places, spring, turns, moving.states);
    let known = (direction, model.dampers.get(row), sweep.shares.get(row));
    let (Some(direction), Some(&coefficient), Some(share)) = known else { return };
    let mut pair = new_pair(model, sweep, [spring.a, spring.b], moving);
    let idle = P::Real::mask(false);
    pair.damp::<P, K>(&direction, sweep.damper::<REVERSE>(coefficient, share), idle);
    pair.store::<P>(moving);
}

/// The direction of a torsion spring's damper: moments only. An undefined torsion angle has none; the next evaluation
/// reports it.
#[inline(always)]
fn torsion_direction<P: Geometry, T: Terms<P>>(
    model: &ModelRef<'_, P, T>,
    places: Places<'_, P>,
    spring: &TorsionSpring<P::Space>,
    turns: CountOf<P>,
    bodies: &[BodyState<P>],
) -> Option<Direction<P::Space>> {
    let torsion_angle = torsion_angle_of::<P>(spring, bodies, turns)?;
    let world = End::new(model, places, spring.a, None).moment_to_world(torsion_angle.gradient);
    let moments = [moment(places, spring.a, world), moment(places, spring.b, world)];
    Some(Direction { along: P::Vector::ZERO, moments })
}
