//! Joint-wise dampers: the impulses of a joint's damping modes.
//!
//! `(pose, wrenches, velocities, modes) => velocities`. Like the damper passes of [`crate::damping`], with a joint's
//! damping modes (levers) in place of its dampers; the damper of a raw spring and of a torsion spring is a single mode
//! that rotates with the pose. The pose-dependent quantities of a mode and its part of the kick are used twice: in the
//! pass before a step's end and in the one at the start of the next. Universal joints of bushings and elements with a
//! clearance are processed damper by damper.

use core::sync::atomic::{Ordering, compiler_fence};

use crate::body::BodyState;
use crate::damping::kick::Kick;
use crate::damping::mode::{DampingMode, Kind, Stop};
use crate::damping::modes::counts;
use crate::damping::moving::Moving;
use crate::damping::{LawsKnown, Sweep, sweep_group, sweep_laws};
use crate::geometry::Geometry;
use crate::index::BodyIndex;
use crate::model::{Group, ModelRef, Terms};
use crate::real::Real;
use crate::space::{Linear as _, Moment as _, Space as _};

/// One pass over all damping modes and dampers in the order of their `stops`, ascending, or descending with `REVERSE`;
/// the modes are prepared.
pub(crate) fn sweep_joints<P: Geometry, T: Terms<P>, K: Kick<P>, const REVERSE: bool>(
    model: &ModelRef<'_, P, T>,
    sweep: &Sweep<'_, P, K>,
    (modes, stops): (&mut [DampingMode<P>], u16),
    (states, of_laws): LawsKnown<'_, P, T>,
    bodies: &mut [BodyState<P>],
    sums: &mut [P::PassSum],
) {
    if !sweep.is_of(model, bodies) || sums.len() != bodies.len() {
        return;
    }
    let mut moving = Moving::begin(bodies, sums, &sweep.kick);
    if REVERSE {
        sweep_laws::<P, T, K, REVERSE>(model, sweep, (&mut *states, of_laws), &mut moving);
    }
    let stops = usize::from(stops);
    for number in 0..stops {
        let number = if REVERSE { stops - 1 - number } else { number };
        let Some(&DampingMode { stop, .. }) = modes.get(number) else { break };
        act::<P, T, K, REVERSE>(model, sweep, &stop, modes, &mut moving);
    }
    if !REVERSE {
        sweep_laws::<P, T, K, REVERSE>(model, sweep, (states, of_laws), &mut moving);
    }
    moving.end();
}

/// Applies the entry of one stop.
#[inline(always)]
fn act<P: Geometry, T: Terms<P>, K: Kick<P>, const REVERSE: bool>(
    model: &ModelRef<'_, P, T>,
    sweep: &Sweep<'_, P, K>,
    stop: &Stop,
    modes: &mut [DampingMode<P>],
    moving: &mut Moving<'_, P>,
) {
    let Some(modes) = modes.get_mut(stop.row.into()..) else { return };
    match stop.kind {
        Kind::Ground => {
            if let Some(modes) = modes.get_mut(..stop.count.into()) {
                ground::<P, T, K, REVERSE>(model, sweep, stop, modes, moving);
            }
        }
        Kind::Joint => {
            let [few, more, _] = counts::<P>();
            let frames = sweep.places.frames;
            if P::Space::PLANAR {
                if usize::from(stop.count) == few {
                    joint::<P, T, REVERSE, 2>(model, frames, stop, modes, moving);
                } else {
                    joint::<P, T, REVERSE, 3>(model, frames, stop, modes, moving);
                }
            } else if usize::from(stop.count) == few {
                joint::<P, T, REVERSE, 3>(model, frames, stop, modes, moving);
            } else if usize::from(stop.count) == more {
                joint::<P, T, REVERSE, 5>(model, frames, stop, modes, moving);
            } else {
                joint::<P, T, REVERSE, 6>(model, frames, stop, modes, moving);
            }
        }
        Kind::Raw => {
            if let Some(mode) = modes.first() {
                single::<P, T, REVERSE, true>(model, stop, mode, moving);
            }
        }
        Kind::Torsion => {
            if let Some(mode) = modes.first() {
                single::<P, T, REVERSE, false>(model, stop, mode, moving);
            }
        }
        Kind::Dampers => {
            if let Some(group) = model.groups.get(usize::from(stop.of))
                && stop.count > 0
            {
                dampers::<P, T, K, REVERSE>(model, sweep, group, moving);
            }
        }
    }
}

/// A group's dampers one by one. Not inlined: inlined here it would leave too few registers for the modes.
#[inline(never)]
fn dampers<P: Geometry, T: Terms<P>, K: Kick<P>, const REVERSE: bool>(
    model: &ModelRef<'_, P, T>,
    sweep: &Sweep<'_, P, K>,
    group: &Group,
    moving: &mut Moving<'_, P>,
) {
    sweep_group::<P, T, K, REVERSE>(model, sweep, group, moving);
}

/// The modes of a joint to the ground, all at once: they are mutually independent. In descending order they include the
/// kick and store its rate for the next pass.
#[inline(always)]
fn ground<P: Geometry, T: Terms<P>, K: Kick<P>, const REVERSE: bool>(
    model: &ModelRef<'_, P, T>,
    sweep: &Sweep<'_, P, K>,
    stop: &Stop,
    modes: &mut [DampingMode<P>],
    moving: &mut Moving<'_, P>,
) {
    let row = BodyIndex(stop.ends[0]).row();
    let (Some(body), Some((velocity, spin)), Some(frame), Some(kick)) = (
        model.bodies.get(row),
        moving.velocities(row),
        sweep.places.frames.get(row),
        sweep.kick.of(row),
    ) else {
        return;
    };
    let pushed = P::to_body(frame, kick.linear);
    let velocity = P::to_body(frame, velocity);
    let mut push = P::Vector::ZERO;
    let mut turn = P::Moment::ZERO;
    // Unrolled: the loop's own instructions would be a fifth of the total.
    macro_rules! act {
        ($from:expr, $to:expr; $($n:literal)*) => {$(
            if $n >= $from && $n < $to && let Some(mode) = modes.get_mut($n) {
                if REVERSE {
                    mode.linked[0] = mode.along.dot(pushed) + mode.moment.dot(kick.angular);
                }
                let kicked = mode.linked[0];
                let rate = mode.along.dot(velocity) + mode.moment.dot(spin);
                let impulse = mode.less[usize::from(REVERSE)] * kicked - mode.impulse * rate;
                let (along, moment) = (mode.along * impulse, mode.moment * impulse);
                push = if $n == 0 { along } else { push + along };
                turn = if $n == 0 { moment } else { turn + moment };
                anew();
            }
        )*};
    }
    let [few, more, all] = counts::<P>();
    if modes.len() < few {
        return;
    }
    act!(0, few; 0 1 2);
    if modes.len() >= more {
        act!(few, more; 2 3 4);
        if modes.len() >= all {
            act!(more, all; 2 3 4 5);
        }
    }
    moving.accelerate(row, P::to_world(frame, push * body.inverse_mass));
    moving.spin_up(row, turn.scale(body.inverse_inertia));
}

/// Forces values read before to be read again after this: the compiler would otherwise keep them and, short of
/// registers, spill them to the stack.
#[inline(always)]
pub(super) fn anew() {
    compiler_fence(Ordering::SeqCst);
}

/// The `N` modes of a joint between two bodies, one after the other.
// No mode reads the last one's impulse.
#[allow(unused_assignments)]
#[inline(always)]
fn joint<P: Geometry, T: Terms<P>, const REVERSE: bool, const N: usize>(
    model: &ModelRef<'_, P, T>,
    frames: &[P::Frame],
    stop: &Stop,
    modes: &[DampingMode<P>],
    moving: &mut Moving<'_, P>,
) {
    let [row, other_row] = stop.ends.map(usize::from);
    let (Some(body), Some(frame), Some(partner), Some(modes)) = (
        model.bodies.get(row),
        frames.get(row),
        model.bodies.get(other_row),
        modes.first_chunk::<N>(),
    ) else {
        return;
    };
    let (Some((velocity, spin)), Some((partner_velocity, partner_spin))) =
        (moving.velocities(row), moving.velocities(other_row))
    else {
        return;
    };
    let velocity = P::to_body(frame, velocity - partner_velocity);
    let rate = |mode: &DampingMode<P>| {
        mode.along.dot(velocity) + mode.moment.dot(spin) - mode.other.dot(partner_spin)
    };
    let mut impulses = [P::Real::ZERO; N];
    let mut push = P::Vector::ZERO;
    let mut turn = P::Moment::ZERO;
    let mut partner_turn = P::Moment::ZERO;
    // Unrolled: in a loop the impulses would be in memory.
    macro_rules! act {
        ($n:literal: $($j:literal)*) => {
            if $n < N {
                let i = if REVERSE { N - 1 - $n } else { $n };
                let mode = &modes[i];
                let rate = rate(mode);
                $(let rate = if REVERSE {
                    rate + modes[N - 1 - $j].linked[i] * impulses[N - 1 - $j]
                } else {
                    rate + mode.linked[$j] * impulses[$j]
                };)*
                let impulse = mode.less[usize::from(REVERSE)] - mode.impulse * rate;
                impulses[i] = impulse;
                let (along, moment) = (mode.along * impulse, mode.moment * impulse);
                let other = mode.other * impulse;
                push = if $n == 0 { along } else { push + along };
                turn = if $n == 0 { moment } else { turn + moment };
                partner_turn = if $n == 0 { other } else { partner_turn + other };
                anew();
            }
        };
    }
    act!(0:);
    act!(1: 0);
    act!(2: 0 1);
    act!(3: 0 1 2);
    act!(4: 0 1 2 3);
    act!(5: 0 1 2 3 4);
    anew();
    let push = P::to_world(frame, push);
    moving.accelerate(row, push * body.inverse_mass);
    moving.spin_up(row, turn.scale(body.inverse_inertia));
    moving.accelerate(other_row, push * -partner.inverse_mass);
    moving.spin_up(other_row, -partner_turn.scale(partner.inverse_inertia));
}

/// The single mode of a raw spring, along a line, or of a torsion spring.
#[inline(always)]
fn single<P: Geometry, T: Terms<P>, const REVERSE: bool, const LINE: bool>(
    model: &ModelRef<'_, P, T>,
    stop: &Stop,
    mode: &DampingMode<P>,
    moving: &mut Moving<'_, P>,
) {
    let [row, other_row] = stop.ends.map(usize::from);
    let less = mode.less[usize::from(REVERSE)];
    let (Some(body), Some((velocity, spin))) = (model.bodies.get(row), moving.velocities(row))
    else {
        return;
    };
    let mut rate = mode.moment.dot(spin);
    if let (Some(partner), Some((other_velocity, other_spin))) =
        (model.bodies.get(other_row), moving.velocities(other_row))
    {
        rate = rate - mode.other.dot(other_spin);
        if LINE {
            rate = rate + mode.along.dot(velocity - other_velocity);
        }
        let impulse = less - mode.impulse * rate;
        if LINE {
            moving.accelerate(row, mode.along * (impulse * body.inverse_mass));
            moving.accelerate(other_row, mode.along * -(impulse * partner.inverse_mass));
        }
        moving.spin_up(row, mode.moment.scale(body.inverse_inertia) * impulse);
        moving.spin_up(other_row, mode.other.scale(partner.inverse_inertia) * -impulse);
    } else {
        if LINE {
            rate = rate + mode.along.dot(velocity);
        }
        let impulse = less - mode.impulse * rate;
        if LINE {
            moving.accelerate(row, mode.along * (impulse * body.inverse_mass));
        }
        moving.spin_up(row, mode.moment.scale(body.inverse_inertia) * impulse);
    }
}
