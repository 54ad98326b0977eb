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
use crate::space::{Linear as _, Space, Vector as _};

/// A group of TSDA stars.
#[inline(always)]
pub(super) fn stars<P: Geometry, T: Terms, D: Dampers>(
    model: &ModelRef<'_, P, T>,
    group: &Group,
    end_a: &End<'_, P>,
    end_b: &End<'_, P>,
) -> Option<Record<P::Space>> {
    match (group.stars, group.arms, end_b.body()) {
        (2, 3, Some(b)) if group.shared && !P::Space::PLANAR => {
            straight::<P, T, D, 2, 3>(model, group, end_a, &b)
        }
        (1, 2, Some(b)) if P::Space::PLANAR => straight::<P, T, D, 1, 2>(model, group, end_a, &b),
        (1, 3, _) if !P::Space::PLANAR => block::<P, T, D, 1, 3>(model, group, end_a, end_b),
        (1, 1, _) => block::<P, T, D, 1, 1>(model, group, end_a, end_b),
        _ => many::<P, T, D>(model, group, end_a, end_b),
    }
}

/// A revolute's stars. Twice the same: where an end is known to be a body or the ground, none of its
/// points asks. The ground is nearly always the first.
#[inline(always)]
fn straight<P: Geometry, T: Terms, D: Dampers, const STARS: usize, const ARMS: usize>(
    model: &ModelRef<'_, P, T>,
    group: &Group,
    end_a: &End<'_, P>,
    end_b: &End<'_, P>,
) -> Option<Record<P::Space>> {
    match end_a.body() {
        Some(a) => block::<P, T, D, STARS, ARMS>(model, group, &a, end_b),
        None => block::<P, T, D, STARS, ARMS>(model, group, &end_a.ground(), end_b),
    }
}

/// `STARS` stars that share `ARMS` points of B: written out, each sum from its first term. `None`
/// where the model lacks them.
#[inline(always)]
fn block<P: Geometry, T: Terms, D: Dampers, const STARS: usize, const ARMS: usize>(
    model: &ModelRef<'_, P, T>,
    group: &Group,
    end_a: &End<'_, P>,
    end_b: &End<'_, P>,
) -> Option<Record<P::Space>> {
    let centres: &[_; STARS] = rows(model.points, group.centre(0))?;
    let tips: &[_; ARMS] = rows(model.points, group.tips(0))?;
    let springs: &[[_; ARMS]; STARS] = grid(model.tsdas, group.element as usize)?;
    let dampers: Option<&[[_; ARMS]; STARS]> = match group.damper.row() {
        Some(row) if D::ACT && T::DAMPERS => Some(grid(model.dampers, row)?),
        _ => None,
    };
    let clearance = model.clearance(group);
    let mut spots = [(P::Location::default(), P::Vector::ZERO); STARS];
    for (spot, centre) in spots.iter_mut().zip(centres) {
        *spot = end_a.place(centre);
    }
    let mut pulls_a = [P::Vector::ZERO; STARS];
    let mut torque_b = P::Moment::ZERO;
    for arm in 0..ARMS {
        let (tip, tip_arm) = end_b.place(&tips[arm]);
        let mut stretches = [P::Vector::ZERO; STARS];
        let mut column = [Tsda::default(); STARS];
        for star in 0..STARS {
            stretches[star] = P::displacement(&spots[star].0, &tip);
            column[star] = springs[star][arm];
        }
        let mut pulls = [P::Vector::ZERO; STARS];
        match (dampers, clearance) {
            (None, None) => pulls = Tsda::forces(&column, &stretches),
            _ => {
                for star in 0..STARS {
                    let d = stretches[star];
                    pulls[star] = match dampers {
                        Some(dampers) => {
                            let v_rel =
                                end_b.point_velocity(tip_arm) - end_a.point_velocity(spots[star].1);
                            column[star].damped_force(dampers[star][arm], d, v_rel, clearance)
                        }
                        None => column[star].force(d, clearance),
                    };
                }
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
    let mut record =
        Record { force: pulls_a[0], torque_a: end_a.moment(spots[0].1, pulls_a[0]), torque_b };
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

/// Any number of stars, which share their points of B or have their own.
#[inline(always)]
fn many<P: Geometry, T: Terms, D: Dampers>(
    model: &ModelRef<'_, P, T>,
    group: &Group,
    end_a: &End<'_, P>,
    end_b: &End<'_, P>,
) -> Option<Record<P::Space>> {
    let (stars, arms) = (group.stars as usize, group.arms as usize);
    let springs = model.tsdas.get(group.element as usize..)?;
    let dampers = match group.damper.row() {
        Some(row) if D::ACT && T::DAMPERS => model.dampers.get(row..),
        _ => None,
    };
    let clearance = model.clearance(group);
    let mut record = Record::ZERO;
    let mut pulls = [P::Vector::ZERO; MOST_ARMS];
    for star in 0..stars {
        let (centre, arm_a) = end_a.place(model.points.get(group.centre(star))?);
        let mut pull_a = P::Vector::ZERO;
        for (arm, pull_b) in pulls.iter_mut().take(arms).enumerate() {
            let element = star * arms + arm;
            let spring = springs.get(element)?;
            let (tip, arm_b) = end_b.place(model.points.get(group.tips(star) + arm)?);
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
            if !group.shared || star + 1 == stars {
                record.torque_b = record.torque_b - arm_b.cross(*pull_b);
                *pull_b = P::Vector::ZERO;
            }
        }
        record.force = record.force + pull_a;
        record.torque_a = record.torque_a + arm_a.cross(pull_a);
    }
    Some(record)
}
