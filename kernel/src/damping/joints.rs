//! Dampers joint by joint: the impulses of a joint's levers.
//!
//! `(pose, wrenches, velocities, levers) => velocities`. As the sweeps of [`crate::damping`], with a
//! joint's levers in place of its dampers; the damper of a raw spring and of a torsion spring is one
//! lever that turns. What a pose makes of a lever, and what the lever is told of the kick, serves the
//! sweep before a step's end and the one at the start of the next. Bushings and what has a clearance
//! are swept damper by damper.

use core::sync::atomic::{Ordering, compiler_fence};

use crate::body::BodyState;
use crate::damping::lever::{Kind, Lever, Stop};
use crate::damping::levers::counts;
use crate::damping::pair::Kick;
use crate::damping::{Sweep, sweep_group};
use crate::geometry::Geometry;
use crate::index::BodyIndex;
use crate::model::{Group, ModelRef, Terms};
use crate::real::Real;
use crate::space::{Linear as _, Moment as _, Space as _};

/// One pass over all levers and dampers in the order of their `stops`, ascending, or descending with
/// `REVERSE`; the levers are ready.
pub(crate) fn sweep_joints<P: Geometry, T: Terms, K: Kick<P>, const REVERSE: bool>(
    model: &ModelRef<'_, P, T>,
    sweep: &Sweep<'_, P, K>,
    (levers, stops): (&mut [Lever<P>], u16),
    bodies: &mut [BodyState<P>],
) {
    if !sweep.is_of(model, bodies) {
        return;
    }
    let stops = usize::from(stops);
    for number in 0..stops {
        let number = if REVERSE { stops - 1 - number } else { number };
        let Some(&Lever { stop, .. }) = levers.get(number) else { break };
        act::<P, T, K, REVERSE>(model, sweep, &stop, levers, bodies);
    }
}

/// What acts at one stop.
#[inline(always)]
fn act<P: Geometry, T: Terms, K: Kick<P>, const REVERSE: bool>(
    model: &ModelRef<'_, P, T>,
    sweep: &Sweep<'_, P, K>,
    stop: &Stop,
    levers: &mut [Lever<P>],
    bodies: &mut [BodyState<P>],
) {
    let Some(levers) = levers.get_mut(stop.row.into()..) else { return };
    match stop.kind {
        Kind::Ground => {
            if let Some(levers) = levers.get_mut(..stop.count.into()) {
                ground::<P, T, K, REVERSE>(model, sweep, stop, levers, bodies);
            }
        }
        Kind::Joint => {
            let [few, more, _] = counts::<P>();
            let frames = sweep.places.frames;
            if P::Space::PLANAR {
                if usize::from(stop.count) == few {
                    joint::<P, T, REVERSE, 2>(model, frames, stop, levers, bodies);
                } else {
                    joint::<P, T, REVERSE, 3>(model, frames, stop, levers, bodies);
                }
            } else if usize::from(stop.count) == few {
                joint::<P, T, REVERSE, 3>(model, frames, stop, levers, bodies);
            } else if usize::from(stop.count) == more {
                joint::<P, T, REVERSE, 5>(model, frames, stop, levers, bodies);
            } else {
                joint::<P, T, REVERSE, 6>(model, frames, stop, levers, bodies);
            }
        }
        Kind::Raw => {
            if let Some(lever) = levers.first() {
                single::<P, T, REVERSE, true>(model, stop, lever, bodies);
            }
        }
        Kind::Torsion => {
            if let Some(lever) = levers.first() {
                single::<P, T, REVERSE, false>(model, stop, lever, bodies);
            }
        }
        Kind::Dampers => {
            if let Some(group) = model.groups.get(usize::from(stop.of))
                && stop.count > 0
            {
                dampers::<P, T, K, REVERSE>(model, sweep, group, bodies);
            }
        }
    }
}

/// A group's dampers one by one. Apart: beside it there would not be enough registers for levers.
#[inline(never)]
fn dampers<P: Geometry, T: Terms, K: Kick<P>, const REVERSE: bool>(
    model: &ModelRef<'_, P, T>,
    sweep: &Sweep<'_, P, K>,
    group: &Group,
    bodies: &mut [BodyState<P>],
) {
    sweep_group::<P, T, K, REVERSE>(model, sweep, group, bodies);
}

/// The levers of a joint to the ground, all at once: they do not act on one another. In descending order
/// they are told of the kick, and keep what it gave for the sweep that follows.
#[inline(always)]
fn ground<P: Geometry, T: Terms, K: Kick<P>, const REVERSE: bool>(
    model: &ModelRef<'_, P, T>,
    sweep: &Sweep<'_, P, K>,
    stop: &Stop,
    levers: &mut [Lever<P>],
    bodies: &mut [BodyState<P>],
) {
    let row = BodyIndex(stop.ends[0]).row();
    let (Some(body), Some(state), Some(frame), Some(kick)) = (
        model.bodies.get(row),
        bodies.get_mut(row),
        sweep.places.frames.get(row),
        sweep.kick.of(row),
    ) else {
        return;
    };
    let pushed = P::to_body(frame, kick.linear);
    let velocity = P::to_body(frame, P::velocity(&state.velocity));
    let spin = P::spin(&state.angular_velocity);
    let mut push = P::Vector::ZERO;
    let mut turn = P::Moment::ZERO;
    // Written out: in a loop its own instructions would be a fifth.
    macro_rules! act {
        ($from:expr, $to:expr; $($n:literal)*) => {$(
            if $n >= $from && $n < $to && let Some(lever) = levers.get_mut($n) {
                if REVERSE {
                    lever.linked[0] = lever.along.dot(pushed) + lever.moment.dot(kick.angular);
                }
                let kicked = lever.linked[0];
                let rate = lever.along.dot(velocity) + lever.moment.dot(spin);
                let impulse = lever.less[usize::from(REVERSE)] * kicked - lever.impulse * rate;
                let (along, moment) = (lever.along * impulse, lever.moment * impulse);
                push = if $n == 0 { along } else { push + along };
                turn = if $n == 0 { moment } else { turn + moment };
                anew();
            }
        )*};
    }
    let [few, more, all] = counts::<P>();
    if levers.len() < few {
        return;
    }
    act!(0, few; 0 1 2);
    if levers.len() >= more {
        act!(few, more; 2 3 4);
        if levers.len() >= all {
            act!(more, all; 2 3 4 5);
        }
    }
    P::accelerate(&mut state.velocity, P::to_world(frame, push * body.inverse_mass));
    P::spin_up(&mut state.angular_velocity, turn.scale(body.inverse_inertia));
}

/// What was read before is read again after this: a compiler would keep it, and as there are not enough
/// registers, write it to the stack.
#[inline(always)]
pub(super) fn anew() {
    compiler_fence(Ordering::SeqCst);
}

/// The `N` levers of a joint between two bodies, one after the other.
// No lever reads the last one's impulse.
#[allow(unused_assignments)]
#[inline(always)]
fn joint<P: Geometry, T: Terms, const REVERSE: bool, const N: usize>(
    model: &ModelRef<'_, P, T>,
    frames: &[P::Frame],
    stop: &Stop,
    levers: &[Lever<P>],
    bodies: &mut [BodyState<P>],
) {
    let [row, other_row] = stop.ends.map(usize::from);
    let (Some(body), Some(frame), Some(partner), Some(levers)) = (
        model.bodies.get(row),
        frames.get(row),
        model.bodies.get(other_row),
        levers.first_chunk::<N>(),
    ) else {
        return;
    };
    let Ok([state, partner_state]) = bodies.get_disjoint_mut([row, other_row]) else { return };
    let velocity = P::velocity(&state.velocity) - P::velocity(&partner_state.velocity);
    let velocity = P::to_body(frame, velocity);
    let spin = P::spin(&state.angular_velocity);
    let partner_spin = P::spin(&partner_state.angular_velocity);
    let rate = |lever: &Lever<P>| {
        lever.along.dot(velocity) + lever.moment.dot(spin) - lever.other.dot(partner_spin)
    };
    let mut impulses = [P::Real::ZERO; N];
    let mut push = P::Vector::ZERO;
    let mut turn = P::Moment::ZERO;
    let mut partner_turn = P::Moment::ZERO;
    // Written out: of a loop the impulses would be in memory.
    macro_rules! act {
        ($n:literal: $($j:literal)*) => {
            if $n < N {
                let i = if REVERSE { N - 1 - $n } else { $n };
                let lever = &levers[i];
                let rate = rate(lever);
                $(let rate = if REVERSE {
                    rate + levers[N - 1 - $j].linked[i] * impulses[N - 1 - $j]
                } else {
                    rate + lever.linked[$j] * impulses[$j]
                };)*
                let impulse = lever.less[usize::from(REVERSE)] - lever.impulse * rate;
                impulses[i] = impulse;
                let (along, moment) = (lever.along * impulse, lever.moment * impulse);
                let other = lever.other * impulse;
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
    P::accelerate(&mut state.velocity, push * body.inverse_mass);
    P::spin_up(&mut state.angular_velocity, turn.scale(body.inverse_inertia));
    P::accelerate(&mut partner_state.velocity, push * -partner.inverse_mass);
    let partner_turn = -partner_turn.scale(partner.inverse_inertia);
    P::spin_up(&mut partner_state.angular_velocity, partner_turn);
}

/// The one lever of a raw spring, along a line, or of a torsion spring.
#[inline(always)]
fn single<P: Geometry, T: Terms, const REVERSE: bool, const LINE: bool>(
    model: &ModelRef<'_, P, T>,
    stop: &Stop,
    lever: &Lever<P>,
    bodies: &mut [BodyState<P>],
) {
    let [row, other_row] = stop.ends.map(usize::from);
    let less = lever.less[usize::from(REVERSE)];
    if let Some(partner) = model.bodies.get(other_row) {
        let (Some(body), Ok([state, other])) =
            (model.bodies.get(row), bodies.get_disjoint_mut([row, other_row]))
        else {
            return;
        };
        let mut rate = lever.moment.dot(P::spin(&state.angular_velocity))
            - lever.other.dot(P::spin(&other.angular_velocity));
        if LINE {
            let velocity = P::velocity(&state.velocity) - P::velocity(&other.velocity);
            rate = rate + lever.along.dot(velocity);
        }
        let impulse = less - lever.impulse * rate;
        if LINE {
            P::accelerate(&mut state.velocity, lever.along * (impulse * body.inverse_mass));
            P::accelerate(&mut other.velocity, lever.along * -(impulse * partner.inverse_mass));
        }
        let turn = lever.moment.scale(body.inverse_inertia);
        P::spin_up(&mut state.angular_velocity, turn * impulse);
        let turn = lever.other.scale(partner.inverse_inertia);
        P::spin_up(&mut other.angular_velocity, turn * -impulse);
    } else if let (Some(body), Some(state)) = (model.bodies.get(row), bodies.get_mut(row)) {
        let mut rate = lever.moment.dot(P::spin(&state.angular_velocity));
        if LINE {
            rate = rate + lever.along.dot(P::velocity(&state.velocity));
        }
        let impulse = less - lever.impulse * rate;
        if LINE {
            P::accelerate(&mut state.velocity, lever.along * (impulse * body.inverse_mass));
        }
        let turn = lever.moment.scale(body.inverse_inertia);
        P::spin_up(&mut state.angular_velocity, turn * impulse);
    }
}
