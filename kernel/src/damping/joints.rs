//! Dampers joint by joint: the impulses of a joint's levers.
//!
//! `(pose, velocities, kick, levers) => velocities`. As the sweeps of [`crate::damping`], with a
//! joint's levers in place of its dampers: levers to the ground act at once, for they do not act on
//! one another, levers between two bodies one after the other. What is no joint's (raw elements,
//! clearances, torsion springs) is swept damper by damper.

use crate::body::BodyState;
use crate::damping::levers::{Lever, fixed, rows};
use crate::damping::pair::Kick;
use crate::damping::{Share, Sweep, sweep_group, torsion};
use crate::geometry::Geometry;
use crate::index::BodyIndex;
use crate::model::{ModelRef, Terms};
use crate::real::Real;
use crate::vector::Vec3;

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
    if REVERSE && T::TORSIONS {
        for (spring, &turns) in torsions.clone().rev() {
            torsion::<P, T, K, REVERSE>(model, sweep, spring, turns, bodies);
        }
    }
    let count = model.groups.len();
    for i in 0..count {
        let Some(group) = model.groups.get(if REVERSE { count - 1 - i } else { i }) else { return };
        let Some(ends) = fixed(model, group) else {
            sweep_group::<P, T, K, REVERSE>(model, sweep, group, bodies);
            continue;
        };
        let rows = rows(group);
        if let (Some(levers), Some(shares)) = (levers.get(rows.clone()), sweep.shares.get(rows))
            && levers.first().is_some_and(Lever::acts)
        {
            let count = levers.iter().take_while(|lever| lever.acts()).count();
            let levers = (levers.get(..count).unwrap_or_default(), shares);
            joint::<P, T, K, REVERSE>(model, sweep, ends, levers, bodies);
        }
    }
    if !REVERSE && T::TORSIONS {
        for (spring, &turns) in torsions {
            torsion::<P, T, K, REVERSE>(model, sweep, spring, turns, bodies);
        }
    }
}

/// The part of the kick's rate that is left to those after: all but its own share, which
/// [`Lever::prepare`] has weighed.
#[inline(always)]
fn later<R: Real, const REVERSE: bool>(share: &Share<R>) -> R {
    if REVERSE { R::ONE - (share.own + share.later) } else { share.later }
}

/// The levers of one joint.
#[inline(always)]
fn joint<P: Geometry, T: Terms, K: Kick<P>, const REVERSE: bool>(
    model: &ModelRef<'_, P, T>,
    sweep: &Sweep<'_, P, K>,
    [own, other]: [BodyIndex; 2],
    (levers, shares): (&[Lever<P>], &[Share<P::Real>]),
    bodies: &mut [BodyState<P>],
) {
    let (row, other_row) = (own.row(), other.row());
    let (Some(body), Some(state), Some(frame)) =
        (model.bodies.get(row), bodies.get(row), sweep.places.frames.get(row))
    else {
        return;
    };
    let kick = sweep.kick.of(row);
    let spin = P::velocity(&state.angular_velocity);
    let velocity = P::velocity(&state.velocity);
    let mut push = Vec3::ZERO;
    let mut turn = Vec3::ZERO;
    let partner = model.bodies.get(other_row).zip(bodies.get(other_row));
    let Some((partner, partner_state)) = partner else {
        let velocity = P::to_body(frame, velocity);
        let pushed = P::to_body(frame, kick.linear);
        for (lever, share) in levers.iter().zip(shares) {
            let mut rate = lever.along.dot(velocity) + lever.moment.dot(spin);
            if K::KNOWN {
                let kicked = lever.along.dot(pushed) + lever.moment.dot(kick.angular);
                rate = rate - kicked * later::<_, REVERSE>(share);
                rate = lever.impulse * rate - lever.told * kicked;
            } else {
                rate = lever.impulse * rate;
            }
            push = push + lever.along * rate;
            turn = turn + lever.moment * rate;
        }
        if let Some(state) = bodies.get_mut(row) {
            P::accelerate(&mut state.velocity, P::to_world(frame, push * -body.inverse_mass));
            P::accelerate(&mut state.angular_velocity, -turn.scale(body.inverse_inertia));
        }
        return;
    };
    let partner_kick = sweep.kick.of(other_row);
    let partner_spin = P::velocity(&partner_state.angular_velocity);
    let velocity = P::to_body(frame, velocity - P::velocity(&partner_state.velocity));
    let pushed = P::to_body(frame, kick.linear - partner_kick.linear);
    let inverse_mass = body.inverse_mass + partner.inverse_mass;
    let mut partner_turn = Vec3::ZERO;
    let act = |(lever, share): (&Lever<P>, &Share<P::Real>)| {
        let mut rate = lever.along.dot(velocity - push * inverse_mass)
            + lever.moment.dot(spin - turn)
            - lever.other.dot(partner_spin + partner_turn);
        if K::KNOWN {
            let kicked = lever.along.dot(pushed) + lever.moment.dot(kick.angular)
                - lever.other.dot(partner_kick.angular);
            rate = rate - kicked * later::<_, REVERSE>(share);
            rate = lever.impulse * rate - lever.told * kicked;
        } else {
            rate = lever.impulse * rate;
        }
        push = push + lever.along * rate;
        turn = turn + lever.moment.scale(body.inverse_inertia) * rate;
        partner_turn = partner_turn + lever.other.scale(partner.inverse_inertia) * rate;
    };
    if REVERSE { levers.iter().zip(shares).rev().for_each(act) } else { levers.iter().zip(shares).for_each(act) }
    let push = P::to_world(frame, push);
    if let Some(state) = bodies.get_mut(row) {
        P::accelerate(&mut state.velocity, push * -body.inverse_mass);
        P::accelerate(&mut state.angular_velocity, -turn);
    }
    if let Some(state) = bodies.get_mut(other_row) {
        P::accelerate(&mut state.velocity, push * partner.inverse_mass);
        P::accelerate(&mut state.angular_velocity, partner_turn);
    }
}
