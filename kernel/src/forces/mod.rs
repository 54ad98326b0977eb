//! One force evaluation: every element once, every body's wrench.
//!
//! `(model, pose, velocities, turn counts, step) => wrenches`. The order of sums, which is part
//! of the bits: a body starts from its weight, then adds its loads in ascending order, then the
//! inputs and the records of its groups likewise, then its torsion springs'.
//! Within a TSDA group each distinct point is placed once; the pulls on a point are added in
//! the order of its elements; the record's force and torque on A add star by star, the torque
//! on B arm by arm. Forces and torques are in world axes; a body's torque is turned into body
//! axes once, at the end.

mod bushing;
mod inputs;
mod lines;
mod stars;
mod torsions;

use crate::body::BodyState;
use crate::elements::gravity;
use crate::elements::load::LoadFrame;
use crate::geometry::Geometry;
use crate::model::{FrameOf, Group, Law, ModelOwner, ModelRef, RealOf, Terms};
use crate::pose::{End, Places, place_bodies};
use crate::real::Real;
use crate::schedule::{LoadWindow, Signal};
use crate::state::State;
use crate::vector::Vec3;

/// The force on a body and its torque.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
#[cfg_attr(feature = "defmt", derive(defmt::Format))]
pub struct Wrench<R> {
    /// \[N\] force, world axes.
    pub force: Vec3<R>,
    /// \[N·m\] torque about the centre of mass, body axes once the evaluation is complete.
    pub torque: Vec3<R>,
}

/// What a group does to its two bodies, world axes; the force on B is the opposite of A's.
#[derive(Clone, Copy)]
pub(crate) struct Record<R> {
    pub(crate) force: Vec3<R>,
    pub(crate) torque_a: Vec3<R>,
    pub(crate) torque_b: Vec3<R>,
}

impl<R: Real> Record<R> {
    const ZERO: Self = Self { force: Vec3::ZERO, torque_a: Vec3::ZERO, torque_b: Vec3::ZERO };
}

/// The wrenches on all bodies in a state, dampers and loads included, for steps of `step_size`
/// \[s\] (loads act in whole steps).
///
/// # Errors
/// The index of the first torsion spring whose twist is undefined.
pub fn wrenches<M: ModelOwner>(
    model: &M,
    state: &State<M>,
    step_size: f64,
) -> Result<M::PerBody<Wrench<RealOf<M>>>, u16> {
    let view = model.view();
    let mut windows = model.per_load();
    for (window, load) in windows.as_mut().iter_mut().zip(view.loads) {
        *window = LoadWindow::new(load.from, load.until, step_size);
    }
    let mut frames = model.per_body(FrameOf::<M>::default());
    let mut wrenches = model.per_body(Wrench::default());
    let mut turns = state.turns.clone();
    evaluate::<M::Precision, M::Terms, true>(
        &view,
        windows.as_ref(),
        state.signals.as_ref(),
        state.bodies.as_ref(),
        turns.as_mut(),
        state.step,
        false,
        frames.as_mut(),
        wrenches.as_mut(),
    )?;
    Ok(wrenches)
}

/// One force evaluation; `frames` are those of the pose. `EXPLICIT` includes the dampers' forces
/// at the velocities of `bodies`; `settle` brings turn counts up to date (a step's boundary).
///
/// # Errors
/// The index of the first torsion spring whose twist is undefined.
// Slices of one plant's memory, each read or written as a whole; a struct would only rename them.
#[allow(clippy::too_many_arguments)]
#[inline]
pub(crate) fn evaluate<P: Geometry, T: Terms, const EXPLICIT: bool>(
    model: &ModelRef<'_, P, T>,
    windows: &[LoadWindow],
    signals: &[Signal<P::Real>],
    bodies: &[BodyState<P>],
    turns: &mut [i32],
    step: u64,
    settle: bool,
    frames: &mut [P::Frame],
    wrenches: &mut [Wrench<P::Real>],
) -> Result<(), u16> {
    place_bodies(bodies, frames);
    start(model, windows, step, frames, wrenches);
    let places = Places { frames, signals };
    if T::INPUTS {
        inputs::push(model, places, wrenches);
    }
    if T::TSDAS || T::BUSHINGS || T::LINES {
        for group in model.groups {
            let record = record::<P, T, EXPLICIT>(model, places, bodies, group);
            apply(wrenches, group.a.row(), group.b.row(), &record);
        }
    }
    if T::TORSIONS {
        torsions::torsions::<P, T, EXPLICIT>(model, places, bodies, turns, settle, wrenches)?;
    }
    for (wrench, frame) in wrenches.iter_mut().zip(frames.iter()) {
        wrench.torque = P::to_body(frame, wrench.torque);
    }
    Ok(())
}

/// The record of one group.
#[inline(always)]
pub(crate) fn record<P: Geometry, T: Terms, const EXPLICIT: bool>(
    model: &ModelRef<'_, P, T>,
    places: Places<'_, P>,
    bodies: &[BodyState<P>],
    group: &Group,
) -> Record<P::Real> {
    let moving = EXPLICIT && T::DAMPERS && group.damper.row().is_some();
    let moving = if moving { Some(bodies) } else { None };
    let end_a = End::new(model, places, group.a, moving);
    let end_b = End::new(model, places, group.b, moving);
    match group.law {
        Law::Tsda if T::TSDAS && group.arms == 3 => {
            stars::stars::<P, T, EXPLICIT, 3>(model, group, &end_a, &end_b)
        }
        Law::Tsda if T::TSDAS => stars::stars::<P, T, EXPLICIT, 1>(model, group, &end_a, &end_b),
        Law::PointBushing if T::BUSHINGS => {
            bushing::bushing::<P, T, EXPLICIT>(model, group, &end_a, &end_b)
        }
        Law::PointOnLine if T::LINES => {
            lines::lines::<P, T, EXPLICIT>(model, group, &end_a, &end_b)
        }
        _ => Record::ZERO,
    }
}

/// Weight and loads.
#[inline(always)]
fn start<P: Geometry, T: Terms>(
    model: &ModelRef<'_, P, T>,
    windows: &[LoadWindow],
    step: u64,
    frames: &[P::Frame],
    wrenches: &mut [Wrench<P::Real>],
) {
    let field = if T::GRAVITY { model.gravity.first() } else { None };
    for (body, wrench) in model.bodies.iter().zip(wrenches.iter_mut()) {
        let force = match field {
            Some(gravity) => gravity::weight(body.mass, *gravity),
            None => Vec3::ZERO,
        };
        *wrench = Wrench { force, torque: Vec3::ZERO };
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
                        (P::to_world(frame, load.force), P::to_world(frame, load.torque))
                    }
                };
                wrench.force = wrench.force + force;
                wrench.torque = wrench.torque + torque;
            }
        }
    }
}

/// Adds a record to its two bodies; the world takes none.
#[inline(always)]
pub(crate) fn apply<R: Real>(wrenches: &mut [Wrench<R>], a: usize, b: usize, record: &Record<R>) {
    if let Some(wrench) = wrenches.get_mut(a) {
        wrench.force = wrench.force + record.force;
        wrench.torque = wrench.torque + record.torque_a;
    }
    if let Some(wrench) = wrenches.get_mut(b) {
        wrench.force = wrench.force - record.force;
        wrench.torque = wrench.torque + record.torque_b;
    }
}
