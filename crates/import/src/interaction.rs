//! Keys of interactions: stops and bushings.
//!
//! `sides, axes, stiffnesses => keys`.

use nalgebra::Vector3;

use crate::mechanism::{Mechanism, rounded};
use crate::notation::{number, vector};
use crate::part::Side;

/// Rebound speed of an impact on a limit, as a fraction of [`LIMIT_SPEED`]; MuJoCo's is almost 0.
pub(crate) const RESTITUTION: f64 = 0.1;

/// \[rad/s, m/s\]
pub(crate) const LIMIT_SPEED: f64 = 1.0;

/// A point on each of two parts.
#[derive(Clone, Copy, Debug)]
pub(crate) struct Sides {
    /// The parts.
    pub(crate) between: [Side; 2],
    /// \[m\] the points, world, at the start of the scene.
    pub(crate) at: [Vector3<f64>; 2],
}

impl Sides {
    /// The key of its points.
    pub(crate) fn points(&self, mechanism: &Mechanism<'_>) -> String {
        let size = mechanism.size();
        let [first, second] =
            [0, 1].map(|i| vector(mechanism.within(self.between[i], self.at[i]), size));
        format!("points = [{first}, {second}]")
    }
}

/// The keys of a bushing with axes x and y, from stiffnesses \[N/m\] and dampings \[N·s/m\] along x, y, z and about them
/// \[N·m/rad, N·m·s/rad\].
pub(crate) fn bushing(
    mechanism: &Mechanism<'_>,
    sides: &Sides,
    [x, y]: [Vector3<f64>; 2],
    along: [[f64; 3]; 2],
    about: [[f64; 3]; 2],
) -> Vec<String> {
    let mut keys = vec![
        sides.points(mechanism),
        format!("x = {}\nz = {}", vector(x, 1.0), vector(x.cross(&y), 1.0)),
    ];
    for (prefix, [stiffness, damping]) in [("", along), ("turn_", about)] {
        for (kind, sizes) in [("stiffness", stiffness), ("damping", damping)] {
            for (axis, size) in ["x", "y", "z"].into_iter().zip(sizes) {
                if kind == "stiffness" || size != 0.0 {
                    keys.push(format!("{prefix}{kind}_{axis} = {}", number(size)));
                }
            }
        }
    }
    keys
}

impl Mechanism<'_> {
    /// Stiffness and dissipation of a stop along a line or, for a joint of this span \[m\], about an axis.
    pub(crate) fn stop(&self, hinge: Option<f64>) -> Vec<String> {
        let stiffness =
            self.options.stiffness_of_limits(hinge.is_some(), hinge.unwrap_or_default());
        let dissipation = dbd_scene::laws::dissipation(RESTITUTION, LIMIT_SPEED);
        let keys = [("stiffness", stiffness), ("dissipation", dissipation)];
        keys.map(|(key, value)| format!("{key} = {}", number(rounded(value)))).to_vec()
    }
}
