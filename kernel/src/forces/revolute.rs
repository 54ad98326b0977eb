//! Revolute joints of bushings.
//!
//! `(points, ends) => force_pair`. The force at the point of the second body, then the torque of the axes.

use crate::elements::revolute::Revolute;
use crate::forces::force_pair::ForcePair;
use crate::forces::two_points::TwoPoints;
use crate::geometry::Geometry;
use crate::pose::End;

impl<P: Geometry> TwoPoints<P> for Revolute<P::Space> {
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
        let arm_a = end_a.arm_at(arm_a, d);
        let [lever_a, lever_b] = self.levers;
        let levers = [end_a.to_world(lever_a), end_b.to_world(lever_b)];
        let torque = self.torque(levers);
        let (force, torque) = match damping {
            Some(&damping) => {
                let v_rel = end_b.point_velocity(arm_b) - end_a.point_velocity(arm_a);
                let damped = self.damping_torque(damping, end_b.spin - end_a.spin, levers[0]);
                (self.damped_force(damping, d, v_rel, levers[0]), torque + damped)
            }
            None => (self.force(d, levers[0]), torque),
        };
        let (torque_a, torque_b) = (end_a.moment(arm_a, force), end_b.moment(arm_b, force));
        ForcePair { force, torque_a: torque_a + torque, torque_b: torque_b + torque }
    }
}
