//! Prepares damping modes for a pose and a kick.
//!
//! `(pose, wrenches, revolution counts) => moments on the other body, impulse per rate, impulse correction`. Done
//! once per pose, for the pass before a step's end and the one at the start of the next. Modes of joints to the ground
//! need only the kick.

use crate::attitude::Attitude as _;
use crate::body::BodyState;
use crate::damping::joints::anew;
use crate::damping::kick::Kick;
use crate::damping::mode::{DampingMode, Kind, Stop};
use crate::damping::modes::{LARGEST, counts};
use crate::damping::{Share, Sweep, engaged};
use crate::forces;
use crate::geometry::Geometry;
use crate::index::BodyIndex;
use crate::model::{Group, ModelRef, Terms};
use crate::pose::{End, placed};
use crate::real::Real;
use crate::space::{Linear as _, Moment as _, Space as _, Vector as _};

/// Prepares all modes for this pose and for the kick of `sweep`. In descending order the pass itself includes the kick
/// in those of joints to the ground.
pub(crate) fn prepare<P: Geometry, T: Terms<P>, K: Kick<P>>(
    model: &ModelRef<'_, P, T>,
    sweep: &Sweep<'_, P, K>,
    bodies: &[BodyState<P>],
    (modes, stops): (&mut [DampingMode<P>], u16),
    reverse: bool,
) {
    if !sweep.is_of(model, bodies) {
        return;
    }
    for number in 0..usize::from(stops) {
        let Some(&DampingMode { stop, .. }) = modes.get(number) else { break };
        let row = usize::from(stop.row);
        let (Some(own), Some(shares)) = (modes.get_mut(row..), sweep.shares.get(row..)) else {
            break;
        };
        // Not filtered before: the match's jump table would have entries for impossible cases.
        match stop.kind {
            Kind::Ground => {
                if !reverse {
                    include_kick(sweep, &stop, own);
                }
            }
            Kind::Joint => {
                let [few, more, _] = counts::<P>();
                let count = usize::from(stop.count);
                let own = (own, shares);
                if P::Space::PLANAR {
                    if count == few {
                        hold::<P, T, K, 2>(model, sweep, &stop, bodies, own);
                    } else {
                        hold::<P, T, K, 3>(model, sweep, &stop, bodies, own);
                    }
                } else if count == few {
                    hold::<P, T, K, 3>(model, sweep, &stop, bodies, own);
                } else if count == more {
                    hold::<P, T, K, 5>(model, sweep, &stop, bodies, own);
                } else {
                    hold::<P, T, K, 6>(model, sweep, &stop, bodies, own);
                }
            }
            Kind::Raw => {
                if let (Some(mode), Some(share)) = (own.first_mut(), shares.first()) {
                    line(model, sweep, &stop, (mode, share));
                }
            }
            Kind::Torsion if T::TORSIONS => {
                if let (Some(mode), Some(share)) = (own.first_mut(), shares.first()) {
                    torsion_angle(model, sweep, &stop, bodies, (mode, share));
                }
            }
            Kind::Torsion => {}
            Kind::Dampers => {
                if let Some(group) = model.groups.get(usize::from(stop.of))
                    && T::CLEARANCES
                    && group.clearance.row().is_some()
                    && let Some(mode) = modes.get_mut(number)
                {
                    mode.stop.count = u8::from(touches(model, sweep, group));
                }
            }
        }
    }
}

/// Includes the kicks of the bodies of inputs, which have changed, in modes prepared for this pose.
pub(crate) fn include_inputs<P: Geometry, T: Terms<P>, K: Kick<P>>(
    model: &ModelRef<'_, P, T>,
    sweep: &Sweep<'_, P, K>,
    (modes, stops): (&mut [DampingMode<P>], u16),
) {
    for number in 0..usize::from(stops) {
        let Some(&DampingMode { stop, .. }) = modes.get(number) else { break };
        if !stop.ends.iter().any(|&row| forces::acts_on(model, row.into())) {
            continue;
        }
        let row = usize::from(stop.row);
        let (Some(own), Some(shares)) = (modes.get_mut(row..), sweep.shares.get(row..)) else {
            break;
        };
        match (stop.kind, &mut *own, shares) {
            (Kind::Ground, ..) => include_kick(sweep, &stop, own),
            (Kind::Joint, ..) => include_kick_between(model, sweep, &stop, (own, shares)),
            (Kind::Raw, [mode, ..], [share, ..]) => {
                include_kick_in_line(model, sweep, &stop, (mode, share));
            }
            (Kind::Torsion, [mode, ..], [share, ..]) if T::TORSIONS => {
                include_kick_in_torsion(model, sweep, &stop, (mode, share));
            }
            _ => {}
        }
    }
}

/// Whether any damper of a group acts beyond its clearance.
#[inline(always)]
fn touches<P: Geometry, T: Terms<P>, K: Kick<P>>(
    model: &ModelRef<'_, P, T>,
    sweep: &Sweep<'_, P, K>,
    group: &Group,
) -> bool {
    (0..group.elements()).any(|i| {
        placed(model, sweep.places, (0, group), i)
            .is_some_and(|element| engaged(model, &element, P::Real::ONE) > P::Real::ZERO)
    })
}

/// Includes the kick in the modes of a joint to the ground.
#[inline(always)]
fn include_kick<P: Geometry, K: Kick<P>>(
    sweep: &Sweep<'_, P, K>,
    stop: &Stop,
    modes: &mut [DampingMode<P>],
) {
    let row = usize::from(stop.ends[0]);
    let (Some(frame), Some(kick)) = (sweep.places.frames.get(row), sweep.kick.of(row)) else {
        return;
    };
    let pushed = P::to_body(frame, kick.linear);
    for mode in modes.iter_mut().take(stop.count.into()) {
        mode.linked[0] = mode.along.dot(pushed) + mode.moment.dot(kick.angular);
    }
}

/// The same in those of a joint between two bodies, prepared for this pose.
fn include_kick_between<P: Geometry, T: Terms<P>, K: Kick<P>>(
    model: &ModelRef<'_, P, T>,
    sweep: &Sweep<'_, P, K>,
    stop: &Stop,
    (modes, shares): (&mut [DampingMode<P>], &[Share<P::Real>]),
) {
    let [row, other_row] = stop.ends.map(usize::from);
    let (Some(frame), Some(partner)) = (sweep.places.frames.get(row), model.bodies.get(other_row))
    else {
        return;
    };
    let (Some(kick), Some(partner_kick)) = (sweep.kick.of(row), sweep.kick.of(other_row)) else {
        return;
    };
    let pushed = P::to_body(frame, kick.linear - partner_kick.linear);
    for (mode, share) in modes.iter_mut().zip(shares).take(stop.count.into()) {
        let rate = mode.rate + mode.other.dot(mode.other.scale(partner.inverse_inertia));
        let kicked = mode.kicked(pushed, [kick.angular, partner_kick.angular]);
        mode.weigh(share, sweep.h, rate, kicked);
    }
}

/// The `N` modes of a joint between two bodies.
#[inline(always)]
fn hold<P: Geometry, T: Terms<P>, K: Kick<P>, const N: usize>(
    model: &ModelRef<'_, P, T>,
    sweep: &Sweep<'_, P, K>,
    stop: &Stop,
    bodies: &[BodyState<P>],
    (modes, shares): (&mut [DampingMode<P>], &[Share<P::Real>]),
) {
    let [row, other_row] = stop.ends.map(usize::from);
    let frames = sweep.places.frames;
    let (Some(frame), Some(state), Some(partner), Some(partner_state), Some(partner_frame)) = (
        frames.get(row),
        bodies.get(row),
        model.bodies.get(other_row),
        bodies.get(other_row),
        frames.get(other_row),
    ) else {
        return;
    };
    let (Some(modes), Some(shares)) = (modes.first_chunk_mut::<N>(), shares.first_chunk::<N>())
    else {
        return;
    };
    let (Some(kick), Some(partner_kick)) = (sweep.kick.of(row), sweep.kick.of(other_row)) else {
        return;
    };
    let pushed = P::to_body(frame, kick.linear - partner_kick.linear);
    let apart = P::position(&state.position) - P::position(&partner_state.position);
    let apart = P::to_body(frame, apart);
    // The body's axes in its partner's axes.
    let mut axes = P::moment_axes(frame);
    for axis in &mut axes {
        *axis = P::moment_to_body(partner_frame, *axis);
    }
    // Unrolled: in a loop the moments would be in memory.
    macro_rules! see {
        ($($i:literal)*) => {$(
            if $i < N {
                let mode = &mut modes[$i];
                mode.other = (mode.moment + apart.cross(mode.along)).of_columns(axes);
                anew();
            }
        )*};
    }
    see!(0 1 2 3 4 5);
    macro_rules! ready {
        ($i:literal: $($j:literal)*) => {
            if $i < N {
                let other = modes[$i].other;
                let turn = other.scale(partner.inverse_inertia);
                let rate = modes[$i].rate + other.dot(turn);
                $(modes[$i].linked[$j] = modes[$i].still[$j] + modes[$j].other.dot(turn);)*
                let mode = &mut modes[$i];
                let kicked = mode.kicked(pushed, [kick.angular, partner_kick.angular]);
                mode.weigh(&shares[$i], sweep.h, rate, kicked);
                anew();
            }
        };
    }
    ready!(0:);
    ready!(1: 0);
    ready!(2: 0 1);
    ready!(3: 0 1 2);
    ready!(4: 0 1 2 3);
    ready!(5: 0 1 2 3 4);
}

/// The mode of a raw spring, world axes.
#[inline(never)]
fn line<P: Geometry, T: Terms<P>, K: Kick<P>>(
    model: &ModelRef<'_, P, T>,
    sweep: &Sweep<'_, P, K>,
    stop: &Stop,
    (mode, share): (&mut DampingMode<P>, &Share<P::Real>),
) {
    let ends = stop.ends.map(BodyIndex);
    let Some(group) = model.groups.get(usize::from(stop.of)) else { return };
    let first = group.point as usize;
    let [a, b] = if ends[0] == group.a { [first, first + 1] } else { [first + 1, first] };
    let (Some(a), Some(b), Some(frame)) =
        (model.points.get(a), model.points.get(b), sweep.places.frames.get(ends[0].row()))
    else {
        return;
    };
    let own = End::<P>::at(frame);
    let other = End::new(model, sweep.places, ends[1], None);
    let ((a, arm), (b, other_arm)) = (own.place(a), other.place(b));
    let d = P::displacement(&a, &b);
    let along = d * d.dot(d).sqrt().reciprocal_or_zero();
    mode.along = along;
    mode.moment = own.moment_to_axes(arm.cross(along));
    if ends[1].row() < model.bodies.len() {
        mode.other = other.moment_to_axes(other_arm.cross(along));
    }
    include_kick_in_line(model, sweep, stop, (mode, share));
}

/// Includes the kick in the mode of a raw spring, prepared for this pose.
#[inline(always)]
fn include_kick_in_line<P: Geometry, T: Terms<P>, K: Kick<P>>(
    model: &ModelRef<'_, P, T>,
    sweep: &Sweep<'_, P, K>,
    stop: &Stop,
    (mode, share): (&mut DampingMode<P>, &Share<P::Real>),
) {
    let ends = stop.ends.map(BodyIndex);
    let (Some(&coefficient), Some(body), Some(kick)) = (
        model.dampers.get(usize::from(stop.row)),
        model.bodies.get(ends[0].row()),
        sweep.kick.of(ends[0].row()),
    ) else {
        return;
    };
    let along = mode.along;
    let mut inverse_mass = body.inverse_mass;
    let mut rate = mode.moment.dot(mode.moment.scale(body.inverse_inertia));
    let mut kicked = mode.moment.dot(kick.angular);
    let mut pushed = kick.linear;
    if let Some(partner) = model.bodies.get(ends[1].row())
        && let Some(kick) = sweep.kick.of(ends[1].row())
    {
        inverse_mass = inverse_mass + partner.inverse_mass;
        rate = rate + mode.other.dot(mode.other.scale(partner.inverse_inertia));
        kicked = kicked - mode.other.dot(kick.angular);
        pushed = pushed - kick.linear;
    }
    rate = rate + along.dot(along) * inverse_mass;
    weigh(sweep, (mode, share), coefficient, rate, kicked + along.dot(pushed));
    if T::INPUTS {
        let ground = End::new(model, sweep.places, ends[1], None).velocity;
        let ground = mode.impulse * along.dot(ground);
        mode.less = mode.less.map(|less| less + ground);
    }
}

/// The mode of a torsion spring: moments along the gradient of its torsion angle.
#[inline(always)]
fn torsion_angle<P: Geometry, T: Terms<P>, K: Kick<P>>(
    model: &ModelRef<'_, P, T>,
    sweep: &Sweep<'_, P, K>,
    stop: &Stop,
    bodies: &[BodyState<P>],
    (mode, share): (&mut DampingMode<P>, &Share<P::Real>),
) {
    let Some(spring) = model.torsions.get(usize::from(stop.of)) else { return };
    let orientation = |row: usize| bodies.get(row).map(|state| &state.orientation);
    let relative =
        P::Orientation::relative(orientation(spring.a.row()), orientation(spring.b.row()));
    let gradient = match spring.since_start(relative) {
        Some(since) => since.gradient(spring.axis),
        // The next evaluation reports it.
        None => P::Moment::ZERO,
    };
    let world = match sweep.places.frames.get(spring.a.row()) {
        Some(frame) => P::moment_to_world(frame, gradient),
        None => gradient,
    };
    [mode.moment, mode.other] = stop.ends.map(|end| {
        let end = BodyIndex(end);
        match sweep.places.frames.get(end.row()) {
            Some(_) if end == spring.a => gradient,
            Some(frame) => P::moment_to_body(frame, world),
            None => P::Moment::ZERO,
        }
    });
    include_kick_in_torsion(model, sweep, stop, (mode, share));
}

/// Includes the kick in the mode of a torsion spring, prepared for this pose.
#[inline(always)]
fn include_kick_in_torsion<P: Geometry, T: Terms<P>, K: Kick<P>>(
    model: &ModelRef<'_, P, T>,
    sweep: &Sweep<'_, P, K>,
    stop: &Stop,
    (mode, share): (&mut DampingMode<P>, &Share<P::Real>),
) {
    let Some(&coefficient) = model.dampers.get(usize::from(stop.row)) else { return };
    let [own, other] =
        [(stop.ends[0], mode.moment), (stop.ends[1], mode.other)].map(|(end, moment)| {
            let row = BodyIndex(end).row();
            let inverse = model.bodies.get(row).map(|body| body.inverse_inertia);
            let turn = moment.scale(inverse.unwrap_or(P::Moment::ZERO));
            let kicked = sweep.kick.of(row).map(|kick| kick.angular);
            (moment.dot(turn), moment.dot(kicked.unwrap_or(P::Moment::ZERO)))
        });
    weigh(sweep, (mode, share), coefficient, own.0 + other.0, own.1 - other.1);
}

/// Weights the single mode of a spring with its coefficient. Without a direction, 1/μ = 0, it does nothing.
#[inline(always)]
fn weigh<P: Geometry, K: Kick<P>>(
    sweep: &Sweep<'_, P, K>,
    (mode, share): (&mut DampingMode<P>, &Share<P::Real>),
    coefficient: P::Real,
    rate: P::Real,
    kicked: P::Real,
) {
    let (strength, largest) = (sweep.h * coefficient, P::Real::from_f64(LARGEST));
    let h = if strength * rate < largest { strength } else { largest / rate };
    mode.weigh(share, h, rate, kicked);
}
