//! How large a mechanism and its joints are.
//!
//! `mechanism at t = 0 => lengths \[m\]`.

use crate::picture::Mechanism;
use dbd_kernel::Vec3;

/// \[m\] the longest side of the box about all centres of mass and outlines.
#[must_use]
pub fn size(mechanism: &Mechanism) -> f64 {
    let (mut low, mut high) = ([f64::INFINITY; 3], [f64::NEG_INFINITY; 3]);
    let corners = (0..mechanism.bodies.len()).flat_map(|row| mechanism.corners(row));
    let centres = mechanism.bodies.iter().map(|body| body.position);
    for point in corners.map(Vec3::to_f64).chain(centres) {
        for axis in 0..3 {
            low[axis] = low[axis].min(point[axis]);
            high[axis] = high[axis].max(point[axis]);
        }
    }
    low.iter().zip(high).map(|(low, high)| high - low).fold(0.0, f64::max)
}

/// \[m\] of each joint the length of the longest of its springs.
#[must_use]
pub fn joint_sizes(mechanism: &Mechanism) -> Vec<f64> {
    let mut sizes = vec![0.0_f64; mechanism.joints.len()];
    for spring in &mechanism.joint_springs {
        let [a, b] = spring.ends.map(|end| mechanism.place(&end));
        if let Some(size) = sizes.get_mut(spring.joint) {
            *size = size.max((b - a).dot(b - a).sqrt());
        }
    }
    sizes
}
