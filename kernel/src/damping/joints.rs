//! Dampers joint by joint: the impulses of a joint's levers.
//!
//! `(pose, wrenches, velocities, levers) => velocities`. As the sweeps of [`crate::damping`], with a
//! joint's levers in place of its dampers; a raw spring's damper is one lever that turns. What a pose
//! makes of a lever, and what the lever is told of the kick, serves the sweep before a step's end and
//! the one at the start of the next. Bushings, clearances and torsion springs are swept damper by
//! damper.

use crate::body::BodyState;
use crate::damping::levers::{LARGEST, Lever, fixed, rows, turning};
use crate::damping::pair::Kick;
use crate::damping::{Share, Sweep, each_direction, sweep_group, torsion};
use crate::geometry::Geometry;
use crate::index::BodyIndex;
use crate::model::{Group, ModelRef, Terms};
use crate::pose::{End, placed};
use crate::real::Real;
use crate::space::{Linear as _, Moment as _, Vector as _};

/// One pass over all levers and dampers, ascending, or descending with `REVERSE`; the levers are
/// ready.
#[inline]
pub(crate) fn sweep_joints<P: Geometry, T: Terms, K: Kick<P>, const REVERSE: bool>(
    model: &ModelRef<'_, P, T>,
    sweep: &Sweep<'_, P, K>,
    levers: &[Lever<P>],
    bodies: &mut [BodyState<P>],
) {
    let torsions = model.torsions.iter().zip(sweep.turns);
    if REVERSE {
        if T::TORSIONS {
            for (spring, &turns) in torsions.rev() {
                torsion::<P, T, K, REVERSE>(model, sweep, spring, turns, bodies);
            }
        }
        for group in model.groups.iter().rev() {
            sweep_joint::<P, T, K, REVERSE>(model, sweep, group, levers, bodies);
        }
    } else {
        for group in model.groups {
            sweep_joint::<P, T, K, REVERSE>(model, sweep, group, levers, bodies);
        }
        if T::TORSIONS {
            for (spring, &turns) in torsions {
                torsion::<P, T, K, REVERSE>(model, sweep, spring, turns, bodies);
            }
        }
    }
}

#[inline(always)]
fn sweep_joint<P: Geometry, T: Terms, K: Kick<P>, const REVERSE: bool>(
    model: &ModelRef<'_, P, T>,
    sweep: &Sweep<'_, P, K>,
    group: &Group,
    levers: &[Lever<P>],
    bodies: &mut [BodyState<P>],
) {
    match fixed::<P, T>(group).or_else(|| turning::<T>(group)) {
        Some([own, other]) => {
            let levers = levers.get(rows(group)).unwrap_or_default();
            if !levers.first().is_some_and(Lever::acts) {
            } else if other.is_world() {
                grounded::<P, T, REVERSE>(model, sweep.places.frames, own, levers, bodies);
            } else {
                between::<P, T, REVERSE>(model, sweep.places.frames, [own, other], levers, bodies);
            }
        }
        None => sweep_group::<P, T, K, REVERSE>(model, sweep, group, bodies),
    }
}

/// The levers of a joint to the ground, all at once: they do not act on one another.
#[inline(always)]
fn grounded<P: Geometry, T: Terms, const REVERSE: bool>(
    model: &ModelRef<'_, P, T>,
    frames: &[P::Frame],
    own: BodyIndex,
    levers: &[Lever<P>],
    bodies: &mut [BodyState<P>],
) {
    let row = own.row();
    let (Some(body), Some(state), Some(frame)) =
        (model.bodies.get(row), bodies.get_mut(row), frames.get(row))
    else {
        return;
    };
    let velocity = P::to_body(frame, P::velocity(&state.velocity));
    let spin = P::spin(&state.angular_velocity);
    let mut push = P::Vector::ZERO;
    let mut turn = P::Moment::ZERO;
    for lever in levers {
        if !lever.acts() {
            break;
        }
        let rate = lever.along.dot(velocity) + lever.moment.dot(spin);
        let impulse = lever.less[usize::from(REVERSE)] - lever.impulse * rate;
        push = push + lever.along * impulse;
        turn = turn + lever.moment * impulse;
    }
    P::accelerate(&mut state.velocity, P::to_world(frame, push * body.inverse_mass));
    P::spin_up(&mut state.angular_velocity, turn.scale(body.inverse_inertia));
}

/// The levers of a joint between two bodies, one after the other.
#[inline(always)]
fn between<P: Geometry, T: Terms, const REVERSE: bool>(
    model: &ModelRef<'_, P, T>,
    frames: &[P::Frame],
    [own, other]: [BodyIndex; 2],
    levers: &[Lever<P>],
    bodies: &mut [BodyState<P>],
) {
    let (row, other_row) = (own.row(), other.row());
    let (Some(body), Some(frame), Some(partner)) =
        (model.bodies.get(row), frames.get(row), model.bodies.get(other_row))
    else {
        return;
    };
    let Ok([state, partner_state]) = bodies.get_disjoint_mut([row, other_row]) else { return };
    let velocity = P::velocity(&state.velocity) - P::velocity(&partner_state.velocity);
    let velocity = P::to_body(frame, velocity);
    let spin = P::spin(&state.angular_velocity);
    let partner_spin = P::spin(&partner_state.angular_velocity);
    let inverse_mass = body.inverse_mass + partner.inverse_mass;
    let mut push = P::Vector::ZERO;
    let mut turn = P::Moment::ZERO;
    let mut partner_turn = P::Moment::ZERO;
    let mut act = |lever: &Lever<P>| {
        let rate = lever.along.dot(velocity + push * inverse_mass)
            + lever.moment.dot(spin + turn)
            - lever.other.dot(partner_spin - partner_turn);
        let impulse = lever.less[usize::from(REVERSE)] - lever.impulse * rate;
        push = push + lever.along * impulse;
        turn = turn + lever.moment.scale(body.inverse_inertia) * impulse;
        partner_turn = partner_turn + lever.other.scale(partner.inverse_inertia) * impulse;
    };
    if REVERSE {
        for lever in levers.iter().rev() {
            if lever.acts() {
                act(lever);
            }
        }
    } else {
        for lever in levers {
            if !lever.acts() {
                break;
            }
            act(lever);
        }
    }
    let push = P::to_world(frame, push);
    P::accelerate(&mut state.velocity, push * body.inverse_mass);
    P::spin_up(&mut state.angular_velocity, turn);
    P::accelerate(&mut partner_state.velocity, push * -partner.inverse_mass);
    P::spin_up(&mut partner_state.angular_velocity, -partner_turn);
}

/// Makes all levers ready: for this pose and for the kick of `sweep`.
#[inline]
pub(crate) fn prepare<P: Geometry, T: Terms, K: Kick<P>>(
    model: &ModelRef<'_, P, T>,
    sweep: &Sweep<'_, P, K>,
    bodies: &[BodyState<P>],
    levers: &mut [Lever<P>],
) {
    for group in model.groups {
        let fixed = fixed::<P, T>(group);
        let Some(ends) = fixed.or_else(|| turning::<T>(group)) else { continue };
        let (Some(levers), Some(shares)) =
            (levers.get_mut(rows(group)), sweep.shares.get(rows(group)))
        else {
            continue;
        };
        if fixed.is_none()
            && let (Some(lever), Some(share)) = (levers.first_mut(), shares.first())
        {
            turn(model, sweep, (group, ends), (lever, share));
        } else if levers.first().is_some_and(Lever::acts) {
            hold(model, sweep, ends, bodies, (levers, shares));
        }
    }
}

/// The levers of a joint.
#[inline(always)]
fn hold<P: Geometry, T: Terms, K: Kick<P>>(
    model: &ModelRef<'_, P, T>,
    sweep: &Sweep<'_, P, K>,
    [own, other]: [BodyIndex; 2],
    bodies: &[BodyState<P>],
    (levers, shares): (&mut [Lever<P>], &[Share<P::Real>]),
) {
    let (row, other_row) = (own.row(), other.row());
    let frames = sweep.places.frames;
    let (Some(frame), Some(state)) = (frames.get(row), bodies.get(row)) else { return };
    let kick = sweep.kick.of(row);
    let partner = (model.bodies.get(other_row), bodies.get(other_row), frames.get(other_row));
    let (Some(partner), Some(partner_state), Some(partner_frame)) = partner else {
        let pushed = P::to_body(frame, kick.linear);
        for (lever, share) in levers.iter_mut().zip(shares) {
            if !lever.acts() {
                break;
            }
            let kicked = lever.along.dot(pushed) + lever.moment.dot(kick.angular);
            told(lever, share, (sweep.h, lever.rate), (kicked, P::Real::ZERO));
        }
        return;
    };
    let partner_kick = sweep.kick.of(other_row);
    let pushed = P::to_body(frame, kick.linear - partner_kick.linear);
    let apart = P::position(&state.position) - P::position(&partner_state.position);
    let apart = P::to_body(frame, apart);
    for (lever, share) in levers.iter_mut().zip(shares) {
        if !lever.acts() {
            break;
        }
        let moment = P::moment_to_world(frame, lever.moment + apart.cross(lever.along));
        lever.other = P::moment_to_body(partner_frame, moment);
        let rate = lever.rate + lever.other.dot(lever.other.scale(partner.inverse_inertia));
        let kicked = lever.along.dot(pushed) + lever.moment.dot(kick.angular)
            - lever.other.dot(partner_kick.angular);
        told(lever, share, (sweep.h, rate), (kicked, P::Real::ZERO));
    }
}

/// The lever of a raw spring.
#[inline(always)]
fn turn<P: Geometry, T: Terms, K: Kick<P>>(
    model: &ModelRef<'_, P, T>,
    sweep: &Sweep<'_, P, K>,
    (group, [own, other]): (&Group, [BodyIndex; 2]),
    (lever, share): (&mut Lever<P>, &Share<P::Real>),
) {
    let places = sweep.places;
    lever.rate = P::Real::ZERO;
    let (Some(element), Some(&coefficient), Some(frame), Some(body)) = (
        placed(model, places, (0, group), 0),
        group.damper.row().and_then(|row| model.dampers.get(row)),
        places.frames.get(own.row()),
        model.bodies.get(own.row()),
    ) else {
        return;
    };
    each_direction::<P, T, false>(model, places, &element, |direction| {
        let [a, b] = direction.moments;
        let (moment, partner) = if own == group.b { (b, a) } else { (a, b) };
        lever.along = P::to_body(frame, direction.along);
        lever.moment = moment;
        lever.other = partner;
        let kick = sweep.kick.of(own.row());
        let mut inverse_mass = body.inverse_mass;
        let mut rate = moment.dot(moment.scale(body.inverse_inertia));
        let mut kicked = moment.dot(kick.angular);
        let mut pushed = kick.linear;
        let mut ground = P::Real::ZERO;
        if let Some(body) = model.bodies.get(other.row()) {
            let kick = sweep.kick.of(other.row());
            inverse_mass = inverse_mass + body.inverse_mass;
            rate = rate + partner.dot(partner.scale(body.inverse_inertia));
            kicked = kicked - partner.dot(kick.angular);
            pushed = pushed - kick.linear;
        } else if T::INPUTS {
            ground = direction.along.dot(End::new(model, places, other, None).velocity);
        }
        kicked = kicked + direction.along.dot(pushed);
        lever.rate = direction.along.dot(direction.along) * inverse_mass + rate;
        let strongest = P::Real::from_f64(LARGEST) / lever.rate;
        let strength = sweep.h * coefficient;
        let h = if strength < strongest { strength } else { strongest };
        told(lever, share, (h, lever.rate), (kicked, ground));
    });
}

/// What a lever does in half a step `h` \[s\], times its coefficient, with 1/μ = `rate`: of the rate
/// it takes `1 − 1/(1 + x + x²/2)`, `x = h·rate`, and is told of a kick as any damper
/// (`damping::pair::Damper`).
#[inline(always)]
fn told<P: Geometry>(
    lever: &mut Lever<P>,
    share: &Share<P::Real>,
    (h, rate): (P::Real, P::Real),
    (kicked, ground): (P::Real, P::Real),
) {
    let (half, one) = (P::Real::HALF, P::Real::ONE);
    let x = h * rate;
    let y = one + half * x;
    let part = h / (one + x * y);
    let Share { own, later } = *share;
    lever.impulse = part * y;
    let given = own * half * part * kicked + lever.impulse * ground;
    let met = lever.impulse * kicked;
    lever.less = [given + later * met, given + (one - (own + later)) * met];
}
