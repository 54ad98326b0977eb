//! One force evaluation: visits every element once and sums every body's wrench.
//!
//! `(model, pose, velocities, revolution counts, step) => wrenches`. The order of sums, on which the bits depend: a
//! body starts from its weight, or from zero where a precision applies gravity to velocities ([`Geometry::HAS_GRAVITY_STEP`]),
//! then adds its loads in ascending order, then the records of its groups likewise, then its torsion springs', then
//! those of its laws, table by table, and last, in body axes, its inputs in ascending order. Within a TSDA group each
//! distinct point is computed once; the forces on a point are added in the order of its elements; the record's force
//! and torque on A add triple by triple, the torque on B leg by leg. Where a precision stores reference TSDAs, the
//! forces of two triples add in the axes of B, and the torque is τ = r1 × (f1 + f2) + (r2 − r1) × f2. Forces and
//! torques are in world axes; a body's torque is transformed to body axes once, at the end.

mod abreast;
mod bushing;
mod directions;
mod driven;
mod force_pair;
mod in_line;
mod inputs;
mod lines;
mod revolute;
mod springs;
mod torsions;
mod triples;
mod two_points;
mod universal;

use crate::body::BodyState;
use abreast::Abreast;
pub(crate) use directions::springs;
pub use force_pair::{
    At, Dampers, DampersLeft, DampersOfJoints, ExplicitDampers, ForcePair, Wrench,
};
pub(crate) use force_pair::{Memories, apply};
use in_line::MayBe;
pub(crate) use in_line::are_in_line;
pub(crate) use inputs::{Unpushed, acts_on, field, push, take_back, with_actuators};
pub(crate) use triples::find_rests;

use crate::elements::gravity;
use crate::elements::load::LoadFrame;
use crate::forces::two_points::two_points;
use crate::geometry::Geometry;
use crate::index::{GroupIndex, LawIndex};
use crate::laws::{self, Laws};
use crate::model::{FrameOf, Group, Law, LawsIn, ModelOwner, ModelRef, SpaceOf, Terms};
use crate::pose::{End, Places, place_bodies};
use crate::schedule::{LoadWindow, Signal};
use crate::space::Linear as _;
use crate::state::State;
use crate::status::Cause;

/// The inputs of an evaluation: what acts in a step, and the states.
pub(crate) struct Instant<'s, P: Geometry> {
    /// The number of the step.
    pub(crate) step: u64,
    /// One per load.
    pub(crate) windows: &'s [LoadWindow],
    /// One per input.
    pub(crate) signals: &'s [Signal<P::Real>],
    /// One per body.
    pub(crate) bodies: &'s [BodyState<P>],
    /// One per TSDA where the precision stores any; groups without it take the general path.
    pub(crate) rests: &'s [P::Rest],
    /// Whether the groups [`are_in_line`].
    pub(crate) in_line: bool,
    /// Whether the frames are up to date with the pose.
    pub(crate) placed: bool,
}

/// The results of an evaluation, one of each per body.
pub(crate) struct Evaluation<'s, P: Geometry> {
    /// The frames of the pose.
    pub(crate) frames: &'s mut [P::Frame],
    /// The wrenches.
    pub(crate) wrenches: &'s mut [Wrench<P::Space>],
    /// The wrenches without inputs, one per input, or empty.
    pub(crate) unpushed: &'s mut [Unpushed<P::Space>],
}

/// The wrenches on all bodies in a state, dampers and loads included, for steps of `step_size` \[s\] (loads act in
/// whole steps).
///
/// # Errors
/// [`Cause::UndefinedTorsionAngle`] names the first torsion spring whose torsion angle is undefined, [`Cause::Undefined`] the
/// first such law.
pub fn wrenches<M: ModelOwner>(
    model: &M,
    state: &State<M>,
    step_size: f64,
) -> Result<M::PerBody<Wrench<SpaceOf<M>>>, Cause> {
    let view = model.view();
    let mut windows = model.per_load();
    for (window, load) in windows.as_mut().iter_mut().zip(view.loads) {
        *window = LoadWindow::new(load.from, load.until, step_size);
    }
    let mut frames = model.per_body(FrameOf::<M>::default());
    let mut wrenches = model.per_body(Wrench::default());
    let (mut turns, mut laws) = (state.turns.clone(), state.laws.clone());
    evaluate_out_of_line::<M::Precision, M::Terms, ExplicitDampers>(
        &view,
        Instant {
            step: state.step,
            windows: windows.as_ref(),
            signals: state.signals.as_ref(),
            bodies: state.bodies.as_ref(),
            in_line: false,
            rests: &[],
            placed: false,
        },
        Memories { turns: turns.as_mut(), laws: &mut laws, at: At::Stage, advance: None },
        Evaluation { frames: frames.as_mut(), wrenches: wrenches.as_mut(), unpushed: &mut [] },
    )?;
    if M::Precision::HAS_GRAVITY_STEP
        && let Some(&gravity) = view.gravity.first()
    {
        for (body, wrench) in view.bodies.iter().zip(wrenches.as_mut()) {
            wrench.force = wrench.force + gravity::weight(body.mass, gravity);
        }
    }
    Ok(wrenches)
}

/// One force evaluation: `(model, instant, memories) => frames, wrenches, updated memories`. Without weights where
/// [`Geometry::HAS_GRAVITY_STEP`].
///
/// # Errors
/// [`Cause::UndefinedTorsionAngle`] names the first torsion spring whose torsion angle is undefined, [`Cause::Undefined`] the
/// first such law.
// One caller per scheme, which gets only the stepper: arguments in structs cost no stack.
#[inline(always)]
pub(crate) fn evaluate<P: Geometry, T: Terms<P>, D: Dampers>(
    model: &ModelRef<'_, P, T>,
    instant: Instant<'_, P>,
    memories: Memories<'_, P, T>,
    out: Evaluation<'_, P>,
) -> Result<(), Cause> {
    let Instant { step, windows, signals, bodies, rests, in_line, placed } = instant;
    let Evaluation { frames, wrenches, unpushed } = out;
    let Memories { turns, laws: known, at, advance } = memories;
    if !placed {
        place_bodies(bodies, frames);
    }
    let places = Places { frames: &*frames, signals };
    let weight =
        if T::GRAVITY && !P::HAS_GRAVITY_STEP { model.gravity.first().copied() } else { None };
    start(model, weight, (windows, step), places, wrenches);
    if MayBe::<P, T>::UNIFORM && in_line {
        in_line::add::<P, T, D>(model, places, (bodies, rests), wrenches);
    } else if T::TSDAS || T::BUSHINGS || T::LINES || T::REVOLUTES || T::UNIVERSALS {
        let mut groups = model.groups.iter();
        loop {
            if Abreast::<P, T>::MAY_BE {
                abreast::add(model, places.frames, D::ACT, &mut groups, wrenches);
            }
            let Some(group) = groups.next() else { break };
            if let Some(force_pair) = force_pair::<P, T, D>(model, places, (bodies, rests), group) {
                apply(wrenches, group.a.row(), group.b.row(), &force_pair);
            }
        }
    }
    if T::TORSIONS {
        torsions::torsions::<P, T, D>(model, places, bodies, (turns, at), wrenches)?;
    }
    if !<LawsIn<P, T> as Laws<P>>::EMPTY {
        let here = laws::Instant { frames: &*frames, bodies, signals };
        let groups = &Groups { model, places, rests };
        let act = laws::Act { settle: at == At::Boundary, advance, damped: D::ACT, groups };
        let done = model.laws.act(here, known, act, wrenches);
        done.map_err(|row| Cause::Undefined { law: LawIndex(row as u16) })?;
    }
    for (wrench, frame) in wrenches.iter_mut().zip(frames.iter()) {
        wrench.torque = P::moment_to_body(frame, wrench.torque);
    }
    if T::INPUTS {
        inputs::keep(model, wrenches, unpushed);
        inputs::push(model, places, wrenches);
    }
    Ok(())
}

/// [`evaluate`] for callers outside a step, which do not need its speed: compiled once for all of them, not inlined
/// into each.
///
/// # Errors
/// As [`evaluate`].
#[inline(never)]
pub(crate) fn evaluate_out_of_line<P: Geometry, T: Terms<P>, D: Dampers>(
    model: &ModelRef<'_, P, T>,
    instant: Instant<'_, P>,
    memories: Memories<'_, P, T>,
    out: Evaluation<'_, P>,
) -> Result<(), Cause> {
    evaluate::<P, T, D>(model, instant, memories, out)
}

/// The record of one group, `None` where the model lacks a part that it refers to.
#[inline(always)]
pub(crate) fn force_pair<P: Geometry, T: Terms<P>, D: Dampers>(
    model: &ModelRef<'_, P, T>,
    places: Places<'_, P>,
    (bodies, rests): (&[BodyState<P>], &[P::Rest]),
    group: &Group,
) -> Option<ForcePair<P::Space>> {
    let moving = D::ACT && T::DAMPERS && group.damper.row().is_some();
    let moving = if moving { Some(bodies) } else { None };
    let end_a = End::new(model, places, group.a, moving);
    let end_b = End::new(model, places, group.b, moving);
    match group.law {
        Law::Tsda if T::TSDAS => triples::triples::<P, T, D>(model, rests, group, &end_a, &end_b),
        Law::PointBushing if T::BUSHINGS => {
            bushing::bushings::<P, T, D>(model, group, &end_a, &end_b)
        }
        Law::PointOnLine if T::LINES => Some(lines::lines::<P, T, D>(model, group, &end_a, &end_b)),
        Law::Revolute if T::REVOLUTES => {
            two_points::<P, T, D, _>(model, model.revolutes, group, &end_a, &end_b)
        }
        Law::Universal if T::UNIVERSALS => {
            two_points::<P, T, D, _>(model, model.universals, group, &end_a, &end_b)
        }
        _ => None,
    }
}

/// [`force_pair`] for callers outside a step and for laws: compiled once for all of them.
#[inline(never)]
pub(crate) fn force_pair_out_of_line<P: Geometry, T: Terms<P>, D: Dampers>(
    model: &ModelRef<'_, P, T>,
    places: Places<'_, P>,
    known: (&[BodyState<P>], &[P::Rest]),
    group: &Group,
) -> Option<ForcePair<P::Space>> {
    force_pair::<P, T, D>(model, places, known, group)
}

/// The forces of the groups of a model at a pose, for laws that bear one.
struct Groups<'s, 'm, P: Geometry, T: Terms<P>> {
    model: &'s ModelRef<'m, P, T>,
    places: Places<'s, P>,
    rests: &'s [P::Rest],
}

impl<P: Geometry, T: Terms<P>> laws::GroupForces<P> for Groups<'_, '_, P, T> {
    fn force(&self, group: GroupIndex) -> P::Vector {
        let Some(group) = self.model.groups.get(group.row()) else { return P::Vector::ZERO };
        let (places, known) = (self.places, (&[][..], self.rests));
        let force_pair =
            force_pair_out_of_line::<P, T, DampersLeft>(self.model, places, known, group);
        force_pair.map_or(P::Vector::ZERO, |force_pair| -force_pair.force)
    }
}

/// The external forces of loads and inputs, including the rates of moved ground; torques in body axes.
#[inline(always)]
pub(crate) fn pushed<P: Geometry, T: Terms<P>>(
    model: &ModelRef<'_, P, T>,
    windows: &[LoadWindow],
    step: u64,
    places: Places<'_, P>,
    wrenches: &mut [Wrench<P::Space>],
) {
    start(model, None, (windows, step), places, wrenches);
    if T::INPUTS && T::DAMPERS {
        driven::push(model, places, wrenches);
    }
    for (wrench, frame) in wrenches.iter_mut().zip(places.frames) {
        wrench.torque = P::moment_to_body(frame, wrench.torque);
    }
    if T::INPUTS {
        inputs::push(model, places, wrenches);
    }
}

/// The forces of loads and inputs only; torques in body axes.
pub(crate) fn push_loads_and_inputs<P: Geometry, T: Terms<P>>(
    model: &ModelRef<'_, P, T>,
    windows: &[LoadWindow],
    step: u64,
    places: Places<'_, P>,
    wrenches: &mut [Wrench<P::Space>],
) {
    start(model, None, (windows, step), places, wrenches);
    for (wrench, frame) in wrenches.iter_mut().zip(places.frames) {
        wrench.torque = P::moment_to_body(frame, wrench.torque);
    }
    if T::INPUTS {
        inputs::push(model, places, wrenches);
    }
}

/// Weight and loads.
#[inline(always)]
fn start<P: Geometry, T: Terms<P>>(
    model: &ModelRef<'_, P, T>,
    field: Option<P::Vector>,
    (windows, step): (&[LoadWindow], u64),
    places: Places<'_, P>,
    wrenches: &mut [Wrench<P::Space>],
) {
    let frames = places.frames;
    for (body, wrench) in model.bodies.iter().zip(wrenches.iter_mut()) {
        let force = match field {
            Some(gravity) => gravity::weight(body.mass, gravity),
            // Negative zero changes nothing when it is added, and avoids a call that clears memory.
            None if P::HAS_GRAVITY_STEP => -P::Vector::ZERO,
            None => P::Vector::ZERO,
        };
        *wrench = Wrench::new(force, P::Moment::ZERO);
    }
    if T::LOADS {
        for (load, window) in model.loads.iter().zip(windows) {
            let row = load.body.row();
            if !window.contains(step) {
                continue;
            }
            if let (Some(wrench), Some(frame)) = (wrenches.get_mut(row), frames.get(row)) {
                let (force, torque) = match load.frame {
                    LoadFrame::World => (load.force, load.torque),
                    LoadFrame::Body => {
                        (P::to_world(frame, load.force), P::moment_to_world(frame, load.torque))
                    }
                };
                wrench.force = wrench.force + force;
                wrench.torque = wrench.torque + torque;
            }
        }
    }
}
