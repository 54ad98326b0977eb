//! The pose of a body in fixed point, used to compute its points.
//!
//! `(position, orientation) => matrix in integers and in single precision; (pose, point) => displacement`.

use crate::fixed::place::FixedPlace;
use crate::fixed::turn::{FixedTurn, UNIT};
use crate::vector::Rotation;

/// The pose of a body in fixed point.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
#[cfg_attr(all(feature = "defmt", target_os = "none"), derive(defmt::Format))]
pub struct FixedPose {
    pub(super) position: [i64; 3],
    /// \[2^-30\] rows in world axes.
    pub(super) rotation: [[i32; 3]; 3],
    /// The same in single precision.
    pub(super) single: Rotation<f32>,
}

impl FixedPose {
    /// Sets the present pose of a body.
    #[inline(always)]
    pub(super) fn set(&mut self, place: &FixedPlace, orientation: &FixedTurn) {
        self.set_matrix(place, orientation.matrix());
    }

    /// Sets the pose that a body has reached in a step.
    #[inline(always)]
    pub(super) fn set_next(&mut self, place: &FixedPlace, orientation: &mut FixedTurn) {
        if orientation.is_about_z() {
            self.set_matrix(place, orientation.next_matrix_about_z());
        } else {
            self.set_matrix(place, orientation.next_matrix());
        }
    }

    // Element by element: a matrix built elsewhere would be copied.
    #[cfg_attr(not(target_pointer_width = "64"), inline(always))]
    fn set_matrix(&mut self, place: &FixedPlace, [p, q, r]: [[i32; 3]; 3]) {
        let Self { position, rotation: [x, y, z], single } = self;
        for (to, from) in position.iter_mut().zip(place.at) {
            *to = from;
        }
        for (row, from) in [(x, p), (y, q), (z, r)] {
            for (to, from) in row.iter_mut().zip(from) {
                *to = from;
            }
        }
        for (row, [x, y, z]) in [(&mut single.x, p), (&mut single.y, q), (&mut single.z, r)] {
            row.x = x as f32 * UNIT;
            row.y = y as f32 * UNIT;
            row.z = z as f32 * UNIT;
        }
    }

    /// A point of the body, 27 fraction bits, in world axes, added to a displacement: exact.
    #[cfg_attr(not(target_pointer_width = "64"), inline(always))]
    pub(super) fn turned(&self, point: [i32; 3], [x, y, z]: [i64; 3]) -> [i64; 3] {
        let point = point.map(i64::from);
        let beyond = |way: i64, row: [i32; 3]| {
            let [x, y, z] = row.map(i64::from);
            let [px, py, pz] = point;
            way.wrapping_add(x * px).wrapping_add(y * py).wrapping_add(z * pz)
        };
        let [p, q, r] = self.rotation;
        [beyond(x, p), beyond(y, q), beyond(z, r)]
    }
}
