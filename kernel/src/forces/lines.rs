//! Points on lines.
//!
//! `(group, ends) => force_pair`. The reaction acts at the foot of the point on its line.

use crate::elements::point_on_line::Projection;
use crate::forces::force_pair::{Dampers, ForcePair};
use crate::geometry::Geometry;
use crate::model::{Group, ModelRef, Terms};
use crate::pose::End;
use crate::space::{Linear as _, Vector as _};

/// A group of points on lines. Duplicated, as for a revolute: with lines on the ground and points on a body, as on a
/// rail, no point is tested for its owner; not in models of every kind, few of which have any.
#[inline(always)]
pub(super) fn lines<P: Geometry, T: Terms<P>, D: Dampers>(
    model: &ModelRef<'_, P, T>,
    group: &Group,
    end_a: &End<'_, P>,
    end_b: &End<'_, P>,
) -> ForcePair<P::Space> {
    match (end_a.still(), end_b.body()) {
        (Some(a), Some(b)) if !T::ALL => walk::<P, T, D>(model, group, &a, &b),
        _ => walk::<P, T, D>(model, group, end_a, end_b),
    }
}

/// Triple by triple. The force on A acts at the foot: its torque is that of the triple's total force at the line's
/// point and of each force along its slide.
#[inline(always)]
fn walk<P: Geometry, T: Terms<P>, D: Dampers>(
    model: &ModelRef<'_, P, T>,
    group: &Group,
    end_a: &End<'_, P>,
    end_b: &End<'_, P>,
) -> ForcePair<P::Space> {
    let mut force_pair = ForcePair::ZERO;
    let (triples, arms) = (group.triples as usize, group.arms.max(1) as usize);
    let (Some(points), Some(mut springs)) =
        (model.points.get(group.point as usize..), model.lines.get(group.element as usize..))
    else {
        return force_pair;
    };
    let Some((centres, mut endpoints)) = points.split_at_checked(triples) else {
        return force_pair;
    };
    let mut dampers = match group.damper.row() {
        Some(row) if D::ACT && T::DAMPERS => model.dampers.get(row..).unwrap_or(&[]),
        _ => &[],
    };
    let clearance = model.clearance(group);
    for centre in centres {
        // Slices of the list instead of element counts, which would need a division per group.
        let Some((own, others)) = endpoints.split_at_checked(arms) else { break };
        endpoints = others;
        let (centre, arm) = end_a.place(centre);
        let (mut pull_a, mut slid) = (P::Vector::ZERO, P::Vector::ZERO);
        let mut line = P::Vector::ZERO;
        for endpoint in own {
            let Some(spring) = springs.split_off_first() else { break };
            line = end_a.to_world(spring.direction);
            let (endpoint, endpoint_arm) = end_b.place(endpoint);
            let Projection { slide, deflection } =
                Projection::new(P::displacement(&centre, &endpoint), line);
            let damping = if D::ACT { dampers.split_off_first() } else { None };
            let pull = match damping {
                Some(&damping) => {
                    let foot = end_a.arm_at(arm, line * slide);
                    let v_rel = end_b.point_velocity(endpoint_arm) - end_a.point_velocity(foot);
                    let rate = Projection::new(v_rel, line).deflection;
                    spring.damped_force(damping, deflection, rate, clearance)
                }
                None => spring.force(deflection, clearance),
            };
            pull_a = pull_a + pull;
            slid = slid + pull * slide;
            force_pair.torque_b = force_pair.torque_b + endpoint_arm.cross(pull);
        }
        force_pair.force = force_pair.force + pull_a;
        let torque = end_a.moment(arm, pull_a) + end_a.moment(line, slid);
        force_pair.torque_a = force_pair.torque_a + torque;
    }
    force_pair
}
