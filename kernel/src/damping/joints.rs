//! Dampers joint by joint: the impulses of a joint's levers.
//!
//! `(pose, wrenches, velocities, levers) => velocities`. As the sweeps of [`crate::damping`], with a
//! joint's levers in place of its dampers; a raw spring's damper is one lever that turns. What a pose
//! makes of a lever, and what the lever is told of the kick, serves the sweep before a step's end and
//! the one at the start of the next. Bushings, clearances and torsion springs are swept damper by
//! damper.

use crate::body::BodyState;
use crate::damping::lever::{Kind, Lever};
use crate::damping::levers::LARGEST;
use crate::damping::pair::Kick;
use crate::damping::{Share, Sweep, sweep_group, torsion};
use crate::geometry::Geometry;
use crate::index::BodyIndex;
use crate::model::{Group, ModelRef, Terms};
use crate::pose::End;
use crate::real::Real;
use crate::space::{Linear as _, Moment as _, Vector as _};

/// One pass over all levers and dampers, ascending, or descending with `REVERSE`; the levers are
/// ready.
pub(crate) fn sweep_joints<P: Geometry, T: Terms, K: Kick<P>, const REVERSE: bool>(
    model: &ModelRef<'_, P, T>,
    sweep: &Sweep<'_, P, K>,
    levers: &[Lever<P>],
    bodies: &mut [BodyState<P>],
) {
    let torsions = model.torsions.iter().zip(P::Real::counts(sweep.turns));
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
    let levers = group.damper.row().and_then(|row| levers.get(row..)).unwrap_or_default();
    let Some(&Lever { seat, .. }) = levers.first() else { return };
    if seat.kind == Kind::Dampers {
        return sweep_group::<P, T, K, REVERSE>(model, sweep, group, bodies);
    }
    let Some(levers) = levers.get(..seat.count.into()).filter(|_| seat.count > 0) else { return };
    let ends = seat.ends.map(BodyIndex);
    if ends[1].is_world() {
        grounded::<P, T, REVERSE>(model, sweep.places.frames, ends[0], levers, bodies);
    } else {
        between::<P, T, REVERSE>(model, sweep.places.frames, ends, levers, bodies);
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
    for i in 0..levers.len() {
        let Some(lever) = levers.get(if REVERSE { levers.len() - 1 - i } else { i }) else { break };
        let rate = lever.along.dot(velocity + push * inverse_mass) + lever.moment.dot(spin + turn)
            - lever.other.dot(partner_spin - partner_turn);
        let impulse = lever.less[usize::from(REVERSE)] - lever.impulse * rate;
        push = push + lever.along * impulse;
        turn = turn + lever.moment.scale(body.inverse_inertia) * impulse;
        partner_turn = partner_turn + lever.other.scale(partner.inverse_inertia) * impulse;
    }
    let push = P::to_world(frame, push);
    P::accelerate(&mut state.velocity, push * body.inverse_mass);
    P::spin_up(&mut state.angular_velocity, turn);
    P::accelerate(&mut partner_state.velocity, push * -partner.inverse_mass);
    P::spin_up(&mut partner_state.angular_velocity, -partner_turn);
}

/// Makes all levers ready: for this pose and for the kick of `sweep`.
pub(crate) fn prepare<P: Geometry, T: Terms, K: Kick<P>>(
    model: &ModelRef<'_, P, T>,
    sweep: &Sweep<'_, P, K>,
    bodies: &[BodyState<P>],
    levers: &mut [Lever<P>],
) {
    for group in model.groups {
        let row = group.damper.row().unwrap_or(usize::MAX);
        let (Some(levers), Some(shares)) = (levers.get_mut(row..), sweep.shares.get(row..)) else {
            continue;
        };
        let Some(&Lever { seat, .. }) = levers.first() else { continue };
        let ends = seat.ends.map(BodyIndex);
        match seat.kind {
            Kind::Dampers => {}
            Kind::Joint => {
                if let Some(levers) = levers.get_mut(..seat.count.into())
                    && seat.count > 0
                {
                    hold(model, sweep, ends, bodies, (levers, shares));
                }
            }
            Kind::Turning => {
                if let (Some(lever), Some(share)) = (levers.first_mut(), shares.first()) {
                    turn(model, sweep, (group, ends), (lever, share));
                }
            }
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
        for lever in levers {
            lever.tell(lever.along.dot(pushed) + lever.moment.dot(kick.angular));
        }
        return;
    };
    let partner_kick = sweep.kick.of(other_row);
    let pushed = P::to_body(frame, kick.linear - partner_kick.linear);
    let apart = P::position(&state.position) - P::position(&partner_state.position);
    let apart = P::to_body(frame, apart);
    for (lever, share) in levers.iter_mut().zip(shares) {
        let moment = P::moment_to_world(frame, lever.moment + apart.cross(lever.along));
        lever.other = P::moment_to_body(partner_frame, moment);
        let rate = lever.rate + lever.other.dot(lever.other.scale(partner.inverse_inertia));
        let kicked = lever.along.dot(pushed) + lever.moment.dot(kick.angular)
            - lever.other.dot(partner_kick.angular);
        lever.weigh(share, sweep.h, rate);
        lever.tell(kicked);
    }
}

/// The lever of a raw spring.
#[inline(always)]
fn turn<P: Geometry, T: Terms, K: Kick<P>>(
    model: &ModelRef<'_, P, T>,
    sweep: &Sweep<'_, P, K>,
    (group, ends): (&Group, [BodyIndex; 2]),
    (lever, share): (&mut Lever<P>, &Share<P::Real>),
) {
    lever.seat.count = 0;
    let first = group.point as usize;
    let swapped = ends[0] == group.a;
    let [a, b] = if swapped { [first, first + 1] } else { [first + 1, first] };
    let (Some(a), Some(b), Some(&coefficient), Some(body)) = (
        model.points.get(a),
        model.points.get(b),
        group.damper.row().and_then(|row| model.dampers.get(row)),
        model.bodies.get(ends[0].row()),
    ) else {
        return;
    };
    let [own, other] = ends.map(|end| End::new(model, sweep.places, end, None));
    let ((a, arm), (b, other_arm)) = (own.place(a), other.place(b));
    let d = P::displacement(&a, &b);
    let along = d * d.dot(d).sqrt().reciprocal_or_zero();
    let kick = sweep.kick.of(ends[0].row());
    lever.along = own.to_axes(along);
    lever.moment = own.moment_to_axes(arm.cross(along));
    let mut inverse_mass = body.inverse_mass;
    let mut rate = lever.moment.dot(lever.moment.scale(body.inverse_inertia));
    let mut kicked = lever.moment.dot(kick.angular);
    let mut pushed = kick.linear;
    if let Some(partner) = model.bodies.get(ends[1].row()) {
        let kick = sweep.kick.of(ends[1].row());
        lever.other = other.moment_to_axes(other_arm.cross(along));
        inverse_mass = inverse_mass + partner.inverse_mass;
        rate = rate + lever.other.dot(lever.other.scale(partner.inverse_inertia));
        kicked = kicked - lever.other.dot(kick.angular);
        pushed = pushed - kick.linear;
    }
    rate = rate + along.dot(along) * inverse_mass;
    // Without a direction (coincident points) nothing can be pushed.
    lever.seat.count = u8::from(rate > P::Real::ZERO);
    let (strength, largest) = (sweep.h * coefficient, P::Real::from_f64(LARGEST));
    let h = if strength * rate < largest { strength } else { largest / rate };
    lever.weigh(share, h, rate);
    lever.tell(kicked + along.dot(pushed));
    if T::INPUTS {
        let ground = lever.impulse * along.dot(other.velocity);
        lever.less = lever.less.map(|less| less + ground);
    }
}
