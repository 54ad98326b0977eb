//! Point bushings.
//!
//! `(group, ends) => force_pair`, one after the other: a point of A and a point of B each.

use crate::elements::point_bushing::PointBushing;
use crate::forces::force_pair::{Dampers, ForcePair};
use crate::forces::two_points::TwoPoints;
use crate::geometry::Geometry;
use crate::model::{Group, ModelRef, Terms};
use crate::pose::End;

/// A group of point bushings. Two bushings, a revolute's, take the specialised path, as TSDAs do (see
/// [`crate::forces::triples`]).
#[inline(always)]
pub(super) fn bushings<P: Geometry, T: Terms<P>, D: Dampers>(
    model: &ModelRef<'_, P, T>,
    group: &Group,
    end_a: &End<'_, P>,
    end_b: &End<'_, P>,
) -> Option<ForcePair<P::Space>> {
    match (end_a.body(), end_b.body()) {
        (Some(a), Some(b)) if group.triples == 2 => two::<P, T, D>(model, group, &a, &b),
        (None, Some(b)) if group.triples == 2 => two::<P, T, D>(model, group, &end_a.ground(), &b),
        _ => {
            let mut sum = triple::<P, T, D>(model, group, 0, end_a, end_b)?;
            for i in 1..group.triples as usize {
                sum = sum.with(&triple::<P, T, D>(model, group, i, end_a, end_b)?);
            }
            Some(sum)
        }
    }
}

/// Two bushings.
#[inline(always)]
fn two<P: Geometry, T: Terms<P>, D: Dampers>(
    model: &ModelRef<'_, P, T>,
    group: &Group,
    end_a: &End<'_, P>,
    end_b: &End<'_, P>,
) -> Option<ForcePair<P::Space>> {
    let first = triple::<P, T, D>(model, group, 0, end_a, end_b)?;
    Some(first.with(&triple::<P, T, D>(model, group, 1, end_a, end_b)?))
}

/// One bushing.
#[inline(always)]
fn triple<P: Geometry, T: Terms<P>, D: Dampers>(
    model: &ModelRef<'_, P, T>,
    group: &Group,
    triple: usize,
    end_a: &End<'_, P>,
    end_b: &End<'_, P>,
) -> Option<ForcePair<P::Space>> {
    let a = model.points.get(group.centre(triple))?;
    let b = model.points.get(group.endpoints(triple))?;
    let bushing = model.bushings.get(group.element as usize + triple)?;
    let damper = match group.damper.row() {
        Some(row) if D::ACT && T::DAMPERS => model.dampers.get(row + triple),
        _ => None,
    };
    Some(bushing.force_pair(&[*a, *b], damper, end_a, end_b))
}

impl<P: Geometry> TwoPoints<P> for PointBushing<P::Real> {
    #[inline(always)]
    fn force_pair(
        &self,
        [a, b]: &[P::Local; 2],
        damping: Option<&P::Real>,
        end_a: &End<'_, P>,
        end_b: &End<'_, P>,
    ) -> ForcePair<P::Space> {
        let ((a, arm_a), (b, arm_b)) = (end_a.place(a), end_b.place(b));
        let d = P::displacement(&a, &b);
        let force = match damping {
            Some(&damping) => {
                let v_rel = end_b.point_velocity(arm_b) - end_a.point_velocity(arm_a);
                self.damped_force(damping, d, v_rel)
            }
            None => self.force(d),
        };
        let (torque_a, torque_b) = (end_a.moment(arm_a, force), end_b.moment(arm_b, force));
        ForcePair { force, torque_a, torque_b }
    }
}
