//! One force evaluation: every element once, every body's wrench.
//!
//! `(model, pose, velocities, turn counts, step) => wrenches`. The order of sums, which is part
//! of the bits: a body starts from its weight, then adds its loads in ascending order, then the
//! inputs and the records of its groups likewise, then its torsion springs'.
//! Within a TSDA group each distinct point is placed once; the pulls on a point are added in
//! the order of its elements; the record's force and torque on A add star by star, the torque
//! on B arm by arm. Forces and torques are in world axes; a body's torque is turned into body
//! axes once, at the end.

use crate::elements::gravity;
use crate::elements::load::{LoadFrame, LoadWindow};
use crate::elements::point_on_line::Projection;
use crate::geometry::{FrameOf, Geometry, RealOf};
use crate::groups::{End, Places, place_bodies};
use crate::inputs::{self, Signal};
use crate::model::{Group, Law, ModelOwner, ModelRef, Terms};
use crate::real::Real;
use crate::state::{BodyState, State};
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
        torsions::<P, T, EXPLICIT>(model, places, bodies, turns, settle, wrenches)?;
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
            stars::<P, T, EXPLICIT, 3>(model, group, &end_a, &end_b)
        }
        Law::Tsda if T::TSDAS => stars::<P, T, EXPLICIT, 1>(model, group, &end_a, &end_b),
        Law::PointBushing if T::BUSHINGS => bushing::<P, T, EXPLICIT>(model, group, &end_a, &end_b),
        Law::PointOnLine if T::LINES => lines::<P, T, EXPLICIT>(model, group, &end_a, &end_b),
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

/// A group of TSDA stars with `ARMS` arms each.
#[inline(always)]
fn stars<P: Geometry, T: Terms, const EXPLICIT: bool, const ARMS: usize>(
    model: &ModelRef<'_, P, T>,
    group: &Group,
    end_a: &End<'_, P>,
    end_b: &End<'_, P>,
) -> Record<P::Real> {
    let mut record = Record::ZERO;
    let stars = group.stars as usize;
    let (Some(points), Some(tsdas)) =
        (model.points.get(group.point as usize..), model.tsdas.get(group.element as usize..))
    else {
        return record;
    };
    let Some((centres, arm_points)) = points.split_at_checked(stars) else {
        return record;
    };
    let (arm_points, _) = arm_points.as_chunks::<ARMS>();
    let (tsdas, _) = tsdas.as_chunks::<ARMS>();
    let dampers = match group.damper.row() {
        Some(row) if EXPLICIT && T::DAMPERS => model.dampers.get(row..),
        _ => None,
    }
    .map(|dampers| dampers.as_chunks::<ARMS>().0);
    let clearance = model.clearance(group);
    let stars_per_block = if group.shared { stars } else { 1 };

    let mut tsdas = tsdas.iter();
    let mut dampers = dampers.map(<[_]>::iter);
    for (centres, arm_points) in centres.chunks(stars_per_block.max(1)).zip(arm_points) {
        let tips: [_; ARMS] = core::array::from_fn(|j| end_b.place(&arm_points[j]));
        let mut pulls = [Vec3::ZERO; ARMS];
        for (centre, springs) in centres.iter().zip(&mut tsdas) {
            let (centre, arm) = end_a.place(centre);
            let coefficients = dampers.as_mut().and_then(Iterator::next);
            let mut pull_a = Vec3::ZERO;
            for j in 0..ARMS {
                let (tip, tip_arm) = &tips[j];
                let d = P::displacement(&centre, tip);
                let pull = match coefficients {
                    Some(coefficients) => {
                        let v_rel = end_b.point_velocity(*tip_arm) - end_a.point_velocity(arm);
                        springs[j].damped_force(coefficients[j], d, v_rel, clearance)
                    }
                    None => springs[j].force(d, clearance),
                };
                pull_a = pull_a + pull;
                pulls[j] = pulls[j] + pull;
            }
            record.force = record.force + pull_a;
            record.torque_a = record.torque_a + arm.cross(pull_a);
        }
        for j in 0..ARMS {
            record.torque_b = record.torque_b - tips[j].1.cross(pulls[j]);
        }
    }
    record
}

/// A point bushing.
#[inline(always)]
fn bushing<P: Geometry, T: Terms, const EXPLICIT: bool>(
    model: &ModelRef<'_, P, T>,
    group: &Group,
    end_a: &End<'_, P>,
    end_b: &End<'_, P>,
) -> Record<P::Real> {
    let first = group.point as usize;
    let (Some(a), Some(b), Some(bushing)) = (
        model.points.get(first),
        model.points.get(first + 1),
        model.bushings.get(group.element as usize),
    ) else {
        return Record::ZERO;
    };
    let ((a, arm_a), (b, arm_b)) = (end_a.place(a), end_b.place(b));
    let d = P::displacement(&a, &b);
    let damper = match group.damper.row() {
        Some(row) if EXPLICIT && T::DAMPERS => model.dampers.get(row),
        _ => None,
    };
    let force = match damper {
        Some(&damping) => {
            let v_rel = end_b.point_velocity(arm_b) - end_a.point_velocity(arm_a);
            bushing.damped_force(damping, d, v_rel)
        }
        None => bushing.force(d),
    };
    Record { force, torque_a: arm_a.cross(force), torque_b: -arm_b.cross(force) }
}

/// A group of points on lines. The force on A acts at the foot: its torque is that of the star's
/// whole pull at the line's point and of each pull along its slide.
#[inline(always)]
fn lines<P: Geometry, T: Terms, const EXPLICIT: bool>(
    model: &ModelRef<'_, P, T>,
    group: &Group,
    end_a: &End<'_, P>,
    end_b: &End<'_, P>,
) -> Record<P::Real> {
    let mut record = Record::ZERO;
    let (stars, arms) = (group.stars as usize, group.arms.max(1) as usize);
    let (Some(points), Some(springs)) =
        (model.points.get(group.point as usize..), model.lines.get(group.element as usize..))
    else {
        return record;
    };
    let Some((centres, tips)) = points.split_at_checked(stars) else {
        return record;
    };
    let dampers = match group.damper.row() {
        Some(row) if EXPLICIT && T::DAMPERS => model.dampers.get(row..).unwrap_or(&[]),
        _ => &[],
    };
    let clearance = model.clearance(group);
    let mut elements = tips.iter().zip(springs);
    let mut dampers = dampers.iter();
    for centre in centres {
        let (centre, arm) = end_a.place(centre);
        let (mut pull_a, mut slid) = (Vec3::ZERO, Vec3::ZERO);
        let mut line = Vec3::ZERO;
        for (tip, spring) in elements.by_ref().take(arms) {
            line = end_a.to_world(spring.direction);
            let (tip, tip_arm) = end_b.place(tip);
            let Projection { slide, deflection } =
                Projection::new(P::displacement(&centre, &tip), line);
            let pull = match dampers.next() {
                Some(&damping) => {
                    let foot = end_a.arm_at(arm, line * slide);
                    let v_rel = end_b.point_velocity(tip_arm) - end_a.point_velocity(foot);
                    let rate = Projection::new(v_rel, line).deflection;
                    spring.damped_force(damping, deflection, rate, clearance)
                }
                None => spring.force(deflection, clearance),
            };
            pull_a = pull_a + pull;
            slid = slid + pull * slide;
            record.torque_b = record.torque_b - tip_arm.cross(pull);
        }
        record.force = record.force + pull_a;
        record.torque_a = record.torque_a + (arm.cross(pull_a) + line.cross(slid));
    }
    record
}

/// The torsion springs.
#[inline(always)]
fn torsions<P: Geometry, T: Terms, const EXPLICIT: bool>(
    model: &ModelRef<'_, P, T>,
    places: Places<'_, P>,
    bodies: &[BodyState<P>],
    turns: &mut [i32],
    settle: bool,
    wrenches: &mut [Wrench<P::Real>],
) -> Result<(), u16> {
    for (i, (spring, turns)) in model.torsions.iter().zip(turns).enumerate() {
        let (a, b) = (bodies.get(spring.a.row()), bodies.get(spring.b.row()));
        let relative = P::relative(a.map(|s| &s.orientation), b.map(|s| &s.orientation));
        let Some(twist) = spring.twist(relative, turns, settle) else {
            return Err(i as u16);
        };
        let end_a = End::new(model, places, spring.a, Some(bodies));
        let damper = match spring.damper.row() {
            Some(row) if EXPLICIT && T::DAMPERS => model.dampers.get(row),
            _ => None,
        };
        let torque = match damper {
            Some(&damping) => {
                let end_b = End::new(model, places, spring.b, Some(bodies));
                let rate = end_a.to_axes(end_b.spin - end_a.spin);
                spring.damped_torque(damping, &twist, rate)
            }
            None => spring.torque(&twist),
        };
        let torque = end_a.to_world(torque);
        let record = Record { force: Vec3::ZERO, torque_a: -torque, torque_b: torque };
        apply(wrenches, spring.a.row(), spring.b.row(), &record);
    }
    Ok(())
}
