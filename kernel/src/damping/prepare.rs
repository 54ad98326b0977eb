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
                let kicked = mode.along.dot(pushed) + mode.moment.dot(kick.angular)
                    - other.dot(partner_kick.angular);
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
    let (Some(a), Some(b), Some(&coefficient), Some(body), Some(frame), Some(kick)) = (
        model.points.get(a),
        model.points.get(b),
        model.dampers.get(usize::from(stop.row)),
        model.bodies.get(ends[0].row()),
        sweep.places.frames.get(ends[0].row()),
        sweep.kick.of(ends[0].row()),
    ) else {
        return;
    };
    let own = End::<P>::at(frame);
    let other = End::new(model, sweep.places, ends[1], None);
    let ((a, arm), (b, other_arm)) = (own.place(a), other.place(b));
    let d = P::displacement(&a, &b);
    let along = d * d.dot(d).sqrt().reciprocal_or_zero();
    mode.along = along;
    mode.moment = own.moment_to_axes(arm.cross(along));
    let mut inverse_mass = body.inverse_mass;
    let mut rate = mode.moment.dot(mode.moment.scale(body.inverse_inertia));
    let mut kicked = mode.moment.dot(kick.angular);
    let mut pushed = kick.linear;
    if let Some(partner) = model.bodies.get(ends[1].row())
        && let Some(kick) = sweep.kick.of(ends[1].row())
    {
        mode.other = other.moment_to_axes(other_arm.cross(along));
        inverse_mass = inverse_mass + partner.inverse_mass;
        rate = rate + mode.other.dot(mode.other.scale(partner.inverse_inertia));
        kicked = kicked - mode.other.dot(kick.angular);
        pushed = pushed - kick.linear;
    }
    rate = rate + along.dot(along) * inverse_mass;
    weigh(sweep, (mode, share), coefficient, rate, kicked + along.dot(pushed));
    if T::INPUTS {
        let ground = mode.impulse * along.dot(other.velocity);
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
    let row = usize::from(stop.row);
    let (Some(spring), Some(&coefficient)) =
        (model.torsions.get(usize::from(stop.of)), model.dampers.get(row))
    else {
        return;
    };
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
    let [own, other] = stop.ends.map(|end| {
        let end = BodyIndex(end);
        let moment = match sweep.places.frames.get(end.row()) {
            Some(_) if end == spring.a => gradient,
            Some(frame) => P::moment_to_body(frame, world),
            None => P::Moment::ZERO,
        };
        let inverse = model.bodies.get(end.row()).map(|body| body.inverse_inertia);
        let turn = moment.scale(inverse.unwrap_or(P::Moment::ZERO));
        let kicked = sweep.kick.of(end.row()).map(|kick| kick.angular);
        (moment, moment.dot(turn), moment.dot(kicked.unwrap_or(P::Moment::ZERO)))
    });
    mode.moment = own.0;
    mode.other = other.0;
    weigh(sweep, (mode, share), coefficient, own.1 + other.1, own.2 - other.2);
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
