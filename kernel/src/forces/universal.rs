//! Universal joints without a spider.
//!
//! `(points, ends) => force_pair`. The force at the points, then the torque of the axis error.

use crate::elements::universal::{AxisError, Universal};
use crate::forces::force_pair::ForcePair;
use crate::forces::two_points::TwoPoints;
use crate::geometry::Geometry;
use crate::pose::End;
use crate::space::Linear as _;

impl<P: Geometry> TwoPoints<P> for Universal<P::Space> {
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
        let axis_error: AxisError<P::Space> =
            AxisError::new(end_a.to_world(self.lever), end_b.to_world(self.axis));
        let (mut force, mut size) = (d * self.stiffness, axis_error.by * self.stiffness);
        if let Some(&damping) = damping {
            let v_rel = end_b.point_velocity(arm_b) - end_a.point_velocity(arm_a);
            force = force + v_rel * damping;
            size = size + axis_error.gradient.dot(end_b.spin - end_a.spin) * damping;
        }
        let torque = axis_error.gradient * size;
        let (torque_a, torque_b) = (end_a.moment(arm_a, force), end_b.moment(arm_b, force));
        ForcePair { force, torque_a: torque_a + torque, torque_b: torque_b + torque }
    }
}
