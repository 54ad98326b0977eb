//! Stars of TSDAs: a point of A joined to one or three points of B.
//!
//! `(group, ends) => record`. Each distinct point is placed once; the pulls on a point of B are
//! added in the order of its elements; force and torque on A add star by star, the torque on B arm
//! by arm.
//!
//! What nearly every group is, two stars that share three points or stars that share none, goes the
//! straight line of [`block`]: its counts are known to the compiler, so that nothing is left of
//! loops, bounds and lists. [`many`] takes the rest.

use crate::elements::tsda::Tsda;
use crate::forces::record::{Dampers, Record};
use crate::geometry::Geometry;
use crate::model::{Group, ModelRef, Terms};
use crate::pose::{End, MOST_ARMS};
use crate::vector::Vec3;

/// A group of TSDA stars.
#[inline(always)]
pub(super) fn stars<P: Geometry, T: Terms, D: Dampers>(
    model: &ModelRef<'_, P, T>,
    group: &Group,
    end_a: &End<'_, P>,
    end_b: &End<'_, P>,
) -> Option<Record<P::Real>> {
    let shared = group.shared && group.stars != 1;
    match group.arms {
        3 if shared && group.stars == 2 => match (end_a.body(), end_b.body()) {
            // Thrice the same: where an end is known to be a body or the ground, none of its
            // points asks.
            (Some(a), Some(b)) => block::<P, T, D, 2, 3>(model, group, 0, &a, &b),
            (None, Some(b)) => block::<P, T, D, 2, 3>(model, group, 0, &end_a.ground(), &b),
            (Some(a), None) => block::<P, T, D, 2, 3>(model, group, 0, &a, &end_b.ground()),
            (None, None) => None,
        },
        _ if shared => many::<P, T, D>(model, group, end_a, end_b),
        3 => own::<P, T, D, 3>(model, group, end_a, end_b),
        _ => own::<P, T, D, 1>(model, group, end_a, end_b),
    }
}

/// Stars with their own points of B.
#[inline(always)]
fn own<P: Geometry, T: Terms, D: Dampers, const ARMS: usize>(
    model: &ModelRef<'_, P, T>,
    group: &Group,
    end_a: &End<'_, P>,
    end_b: &End<'_, P>,
) -> Option<Record<P::Real>> {
    let mut star = 0;
    let mut sum = Record::ZERO;
    loop {
        let record = block::<P, T, D, 1, ARMS>(model, group, star, end_a, end_b)?;
        sum = if star == 0 { record } else { sum.with(&record) };
        star += 1;
        if star >= group.stars as usize {
            return Some(sum);
        }
    }
}

/// `STARS` stars from `first` on, which share their points of B: written out, each sum from its
/// first term. `None` where the model lacks them.
#[inline(always)]
fn block<P: Geometry, T: Terms, D: Dampers, const STARS: usize, const ARMS: usize>(
    model: &ModelRef<'_, P, T>,
    group: &Group,
    first: usize,
    end_a: &End<'_, P>,
    end_b: &End<'_, P>,
) -> Option<Record<P::Real>> {
    let centres: &[_; STARS] = rows(model.points, group.centre(first))?;
    let tips: &[_; ARMS] = rows(model.points, group.tips(first))?;
    let element = first * ARMS;
    let springs: &[[_; ARMS]; STARS] = grid(model.tsdas, group.element as usize + element)?;
    let dampers: Option<&[[_; ARMS]; STARS]> = match group.damper.row() {
        Some(row) if D::ACT && T::DAMPERS => Some(grid(model.dampers, row + element)?),
        _ => None,
    };
    let clearance = model.clearance(group);
    let mut spots = [(P::Location::default(), Vec3::ZERO); STARS];
    for (spot, centre) in spots.iter_mut().zip(centres) {
        *spot = end_a.place(centre);
    }
    let mut pulls_a = [Vec3::ZERO; STARS];
    let mut torque_b = Vec3::ZERO;
    for arm in 0..ARMS {
        let (tip, tip_arm) = end_b.place(&tips[arm]);
        let mut stretches = [Vec3::ZERO; STARS];
        let mut column = [Tsda::default(); STARS];
        for star in 0..STARS {
            stretches[star] = P::displacement(&spots[star].0, &tip);
            column[star] = springs[star][arm];
        }
        let mut pulls = [Vec3::ZERO; STARS];
        match (dampers, clearance) {
            (None, None) => pulls = Tsda::forces(&column, &stretches),
            _ => for star in 0..STARS {
                let d = stretches[star];
                pulls[star] = match dampers {
                    Some(dampers) => {
                        let v_rel = end_b.point_velocity(tip_arm) - end_a.point_velocity(spots[star].1);
                        column[star].damped_force(dampers[star][arm], d, v_rel, clearance)
                    }
                    None => column[star].force(d, clearance),
                };
            }
        }
        let mut pull_b = pulls[0];
        for star in 0..STARS {
            if star > 0 {
                pull_b = pull_b + pulls[star];
            }
            pulls_a[star] = if arm == 0 { pulls[star] } else { pulls_a[star] + pulls[star] };
        }
        let torque = end_b.moment(tip_arm, pull_b);
        torque_b = if arm == 0 { -torque } else { torque_b - torque };
    }
    let mut record = Record { force: pulls_a[0], torque_a: end_a.moment(spots[0].1, pulls_a[0]), torque_b };
    for star in 1..STARS {
        record.force = record.force + pulls_a[star];
        record.torque_a = record.torque_a + end_a.moment(spots[star].1, pulls_a[star]);
    }
    Some(record)
}

/// `N` rows from `first` on.
#[inline(always)]
fn rows<V, const N: usize>(all: &[V], first: usize) -> Option<&[V; N]> {
    all.get(first..first + N)?.first_chunk()
}

/// The same of `M` rows of `N`.
#[inline(always)]
fn grid<V, const N: usize, const M: usize>(all: &[V], first: usize) -> Option<&[[V; N]; M]> {
    all.get(first..first + N * M)?.as_chunks().0.first_chunk()
}

/// Any number of stars that share any number of points.
fn many<P: Geometry, T: Terms, D: Dampers>(
    model: &ModelRef<'_, P, T>,
    group: &Group,
    end_a: &End<'_, P>,
    end_b: &End<'_, P>,
) -> Option<Record<P::Real>> {
    let mut record = Record::ZERO;
    let arms = group.arms as usize;
    let dampers = match group.damper.row() {
        Some(row) if D::ACT && T::DAMPERS => model.dampers.get(row..),
        _ => None,
    };
    let clearance = model.clearance(group);
    let springs = model.tsdas.get(group.element as usize..)?;
    let tips = model.points.get(group.tips(0)..)?;
    let mut pulls = [Vec3::ZERO; MOST_ARMS];
    for star in 0..group.stars as usize {
        let (centre, arm_a) = end_a.place(model.points.get(group.centre(star))?);
        let mut pull_a = Vec3::ZERO;
        for (arm, (tip, pull_b)) in tips.iter().zip(&mut pulls).take(arms).enumerate() {
            let element = star * arms + arm;
            let spring = springs.get(element)?;
            let (tip, arm_b) = end_b.place(tip);
            let d = P::displacement(&centre, &tip);
            let pull = match dampers.and_then(|dampers| dampers.get(element)) {
                Some(&damping) => {
                    let v_rel = end_b.point_velocity(arm_b) - end_a.point_velocity(arm_a);
                    spring.damped_force(damping, d, v_rel, clearance)
                }
                None => spring.force(d, clearance),
            };
            pull_a = pull_a + pull;
            *pull_b = *pull_b + pull;
        }
        record.force = record.force + pull_a;
        record.torque_a = record.torque_a + arm_a.cross(pull_a);
    }
    for (tip, pull) in tips.iter().zip(&pulls).take(arms) {
        record.torque_b = record.torque_b - end_b.place(tip).1.cross(*pull);
    }
    Some(record)
}
