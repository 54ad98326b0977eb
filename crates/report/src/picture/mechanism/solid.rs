//! Solids of a scene's `[[geometry]]`.
//!
//! `solid => enclosing points`, in the axes of its owner.

use dbd_kernel::{Quaternion, Vec3};
use serde::Serialize;

/// A solid in the axes of its body from its centre of mass, or in the world. A colour is `#rrggbb`; without one it has
/// that of its body.
#[derive(Clone, Debug, PartialEq, Serialize)]
#[serde(tag = "kind", rename_all = "snake_case")]
pub enum Solid {
    /// A block.
    Box {
        /// \[m\] its middle.
        at: [f64; 3],
        /// Unit quaternion, scalar first: from the block's axes to those of its owner.
        turn: [f64; 4],
        /// \[m\] half of each side.
        half: [f64; 3],
        /// Its own.
        colour: Option<String>,
    },
    /// A cylinder with flat ends.
    Cylinder {
        /// \[m\] the middles of its ends.
        ends: [[f64; 3]; 2],
        /// \[m\].
        radius: f64,
        /// Its own.
        colour: Option<String>,
    },
    /// A rod with round ends.
    Link {
        /// \[m\] the centres of its ends.
        ends: [[f64; 3]; 2],
        /// \[m\].
        radius: f64,
        /// Its own.
        colour: Option<String>,
    },
    /// A ball.
    Sphere {
        /// \[m\] its centre.
        at: [f64; 3],
        /// \[m\].
        radius: f64,
        /// Its own.
        colour: Option<String>,
    },
}

/// Points of a circle.
const AROUND: usize = 60;

impl Solid {
    /// A solid of a scene, with its own colour where it has one.
    pub(super) fn of(solid: &dbd_scene::Solid, colour: Option<String>) -> Self {
        match *solid {
            dbd_scene::Solid::Box { at, turn, half } => Self::Box { at, turn, half, colour },
            dbd_scene::Solid::Cylinder { ends, radius } => Self::Cylinder { ends, radius, colour },
            dbd_scene::Solid::Link { ends, radius } => Self::Link { ends, radius, colour },
            dbd_scene::Solid::Sphere { at, radius } => Self::Sphere { at, radius, colour },
        }
    }

    /// Its own colour, `#rrggbb`.
    #[must_use]
    pub fn colour(&self) -> Option<&str> {
        match self {
            Self::Box { colour, .. }
            | Self::Cylinder { colour, .. }
            | Self::Link { colour, .. }
            | Self::Sphere { colour, .. } => colour.as_deref(),
        }
    }

    /// Points \[m\] whose hull approximates it: corners of a box, rims of a cylinder, extreme points along the axes of
    /// round solids.
    #[must_use]
    pub fn corners(&self) -> Vec<[f64; 3]> {
        match self {
            Self::Box { at, turn, half, .. } => block(at, turn, half).to_vec(),
            Self::Cylinder { ends, radius, .. } => rims(ends, *radius).concat(),
            Self::Link { ends, radius, .. } => {
                ends.iter().flat_map(|end| ball(end, *radius)).collect()
            }
            Self::Sphere { at, radius, .. } => ball(at, *radius).into(),
        }
    }
}

/// The corners of a block; two that differ in one bit of their numbers have an edge in common.
pub(crate) fn block(at: &[f64; 3], turn: &[f64; 4], half: &[f64; 3]) -> [[f64; 3]; 8] {
    let rotation = Quaternion::<f64>::from_f64(*turn).rotation();
    std::array::from_fn(|corner| {
        let side = |bit: usize| if corner >> bit & 1 == 1 { half[bit] } else { -half[bit] };
        let arm = Vec3::new(side(0), side(1), side(2));
        (Vec3::from_f64(*at) + rotation.to_world(arm)).to_f64()
    })
}

/// The circles at the ends of a cylinder.
pub(crate) fn rims(ends: &[[f64; 3]; 2], radius: f64) -> [Vec<[f64; 3]>; 2] {
    let [from, to] = ends.map(Vec3::from_f64);
    // The square of distant ends would overflow.
    let largest = (to - from).to_f64().into_iter().fold(0.0_f64, |a, b| a.max(b.abs()));
    let along = (to - from) * (1.0 / largest.max(f64::MIN_POSITIVE));
    let along = along * (1.0 / libm::sqrt(along.dot(along)).max(f64::MIN_POSITIVE));
    let [x, y, z] = along.to_f64().map(f64::abs);
    let [e1, e2, e3] = Vec3::axes();
    let off = if x <= y && x <= z {
        e1
    } else if y <= z {
        e2
    } else {
        e3
    };
    let across = along.cross(off);
    let across = across * (1.0 / libm::sqrt(across.dot(across)).max(f64::MIN_POSITIVE));
    let up = along.cross(across);
    let rim = |middle: Vec3<f64>| {
        let point = |n: usize| {
            let (sine, cosine) = libm::sincos(core::f64::consts::TAU * n as f64 / AROUND as f64);
            (middle + across * (radius * cosine) + up * (radius * sine)).to_f64()
        };
        (0..AROUND).map(point).collect()
    };
    [rim(from), rim(to)]
}

/// Extreme points of a ball along each axis.
fn ball(at: &[f64; 3], radius: f64) -> [[f64; 3]; 6] {
    std::array::from_fn(|n| {
        let mut point = *at;
        point[n / 2] += if n % 2 == 0 { radius } else { -radius };
        point
    })
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn corners_lie_on_their_solids() {
        let half = [0.1, 0.2, 0.3];
        let quarter = core::f64::consts::FRAC_1_SQRT_2;
        // A rotation by 90° about z: x and y are exchanged.
        let turn = [quarter, 0.0, 0.0, quarter];
        let solid = Solid::Box { at: [1.0, 0.0, 0.0], turn, half, colour: None };
        let corners = solid.corners();
        let largest =
            |axis: usize| corners.iter().map(|corner| corner[axis]).fold(f64::MIN, f64::max);
        for (axis, expected) in [1.2, 0.1, 0.3].into_iter().enumerate() {
            assert!((largest(axis) - expected).abs() < 1e-15, "{axis}");
        }
        let ends = [[0.0, 0.0, 1.0], [0.0, 3.0, 1.0]];
        let solid = Solid::Cylinder { ends, radius: 0.5, colour: Some("#123456".into()) };
        assert_eq!((solid.corners().len(), solid.colour()), (2 * AROUND, Some("#123456")));
        for [x, y, z] in solid.corners() {
            assert!((libm::hypot(x, z - 1.0) - 0.5).abs() < 1e-15 && (y == 0.0 || y == 3.0));
        }
        let link = Solid::Link { ends, radius: 0.5, colour: None };
        assert!(link.corners().contains(&[0.0, 3.5, 1.0]));
        let sphere = Solid::Sphere { at: [0.0; 3], radius: 2.0, colour: None };
        assert!(sphere.corners().iter().all(|[x, y, z]| (x + y + z).abs() == 2.0));
    }
}
