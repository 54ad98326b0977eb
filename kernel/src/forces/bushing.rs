//! Point bushings.
//!
//! `(group, ends) => record`, star by star: a point of A and its own of B each.

use crate::elements::point_bushing::PointBushing;
use crate::forces::record::{Dampers, Record};
use crate::geometry::Geometry;
use crate::model::{Group, ModelRef, Terms};
use crate::pose::{End, Spot};

/// A group of point bushings. Two stars, a revolute's, go a straight line as TSDAs do (see the
/// file beside this one): their points are looked up at once, and none asks whose it is.
#[inline(always)]
pub(super) fn bushings<P: Geometry, T: Terms, D: Dampers>(
    model: &ModelRef<'_, P, T>,
    group: &Group,
    end_a: &End<'_, P>,
    end_b: &End<'_, P>,
) -> Option<Record<P::Space>> {
    let stars = group.stars as usize;
    let (points, first) = (group.point as usize, group.element as usize);
    let dampers = match group.damper.row() {
        Some(row) if D::ACT && T::DAMPERS => model.dampers.get(row..row + stars),
        _ => None,
    };
    match end_b.body() {
        Some(b) if stars == 2 && !group.shared => {
            let springs = model.bushings.get(first..first + 2)?.first_chunk()?;
            let points = model.points.get(points..points + 4)?.first_chunk()?;
            match end_a.body() {
                Some(a) => Some(two(points, springs, dampers, &a, &b)),
                None => Some(two(points, springs, dampers, &end_a.ground(), &b)),
            }
        }
        _ => {
            let mut sum = Record::ZERO;
            for i in 0..stars {
                let a = end_a.place(model.points.get(group.centre(i))?);
                let b = end_b.place(model.points.get(group.tips(i))?);
                let damping = dampers.and_then(|dampers| dampers.get(i));
                let record = star(&a, &b, model.bushings.get(first + i)?, damping, end_a, end_b);
                sum = if i == 0 { record } else { sum.with(&record) };
            }
            Some(sum)
        }
    }
}

/// Two stars.
#[inline(always)]
fn two<P: Geometry>(
    [a, c, b, d]: &[P::Local; 4],
    [first, second]: &[PointBushing<P::Real>; 2],
    dampers: Option<&[P::Real]>,
    end_a: &End<'_, P>,
    end_b: &End<'_, P>,
) -> Record<P::Space> {
    let damping = |i: usize| dampers.and_then(|dampers| dampers.get(i));
    let (b, d) = (end_b.place(b), end_b.place(d));
    let (a, c) = (end_a.place(a), end_a.place(c));
    star(&a, &b, first, damping(0), end_a, end_b).with(&star(
        &c,
        &d,
        second,
        damping(1),
        end_a,
        end_b,
    ))
}

/// One star.
#[inline(always)]
fn star<P: Geometry>(
    (a, arm_a): &Spot<P>,
    (b, arm_b): &Spot<P>,
    bushing: &PointBushing<P::Real>,
    damping: Option<&P::Real>,
    end_a: &End<'_, P>,
    end_b: &End<'_, P>,
) -> Record<P::Space> {
    let d = P::displacement(a, b);
    let force = match damping {
        Some(&damping) => {
            let v_rel = end_b.point_velocity(*arm_b) - end_a.point_velocity(*arm_a);
            bushing.damped_force(damping, d, v_rel)
        }
        None => bushing.force(d),
    };
    let (torque_a, torque_b) = (end_a.moment(*arm_a, force), -end_b.moment(*arm_b, force));
    Record { force, torque_a, torque_b }
}
