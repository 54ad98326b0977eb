//! Points on lines.
//!
//! `(group, ends) => record`. The reaction acts at the foot of the point on its line.

use crate::elements::point_on_line::Projection;
use crate::forces::record::{Dampers, Record};
use crate::geometry::Geometry;
use crate::model::{Group, ModelRef, Terms};
use crate::pose::End;
use crate::space::{Linear as _, Vector as _};

/// A group of points on lines. The force on A acts at the foot: its torque is that of the star's
/// whole pull at the line's point and of each pull along its slide.
#[inline(always)]
pub(super) fn lines<P: Geometry, T: Terms, D: Dampers>(
    model: &ModelRef<'_, P, T>,
    group: &Group,
    end_a: &End<'_, P>,
    end_b: &End<'_, P>,
) -> Record<P::Space> {
    let mut record = Record::ZERO;
    let (stars, arms) = (group.stars as usize, group.arms.max(1) as usize);
    let (Some(points), Some(springs)) =
        (model.points.get(group.point as usize..), model.lines.get(group.element as usize..))
    else {
        return record;
    };
    let Some((centres, tips)) = points.split_at_checked(stars) else {
        return record;
    };
    let dampers = match group.damper.row() {
        Some(row) if D::ACT && T::DAMPERS => model.dampers.get(row..).unwrap_or(&[]),
        _ => &[],
    };
    let clearance = model.clearance(group);
    let mut elements = tips.iter().zip(springs);
    let mut dampers = dampers.iter();
    for centre in centres {
        let (centre, arm) = end_a.place(centre);
        let (mut pull_a, mut slid) = (P::Vector::ZERO, P::Vector::ZERO);
        let mut line = P::Vector::ZERO;
        for (tip, spring) in elements.by_ref().take(arms) {
            line = end_a.to_world(spring.direction);
            let (tip, tip_arm) = end_b.place(tip);
            let Projection { slide, deflection } =
                Projection::new(P::displacement(&centre, &tip), line);
            let pull = match dampers.next() {
                Some(&damping) => {
                    let foot = end_a.arm_at(arm, line * slide);
                    let v_rel = end_b.point_velocity(tip_arm) - end_a.point_velocity(foot);
                    let rate = Projection::new(v_rel, line).deflection;
                    spring.damped_force(damping, deflection, rate, clearance)
                }
                None => spring.force(deflection, clearance),
            };
            pull_a = pull_a + pull;
            slid = slid + pull * slide;
            record.torque_b = record.torque_b + tip_arm.cross(pull);
        }
        record.force = record.force + pull_a;
        record.torque_a = record.torque_a + (arm.cross(pull_a) + line.cross(slid));
    }
    record
}
