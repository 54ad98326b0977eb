//! Uniform gravity.
//!
//! `(mass, g) => force = m·g`, world axes, at the centre of mass. Energy `−m·(g·x)`.

use crate::space::Linear;

/// The weight \[N\] of a body of `mass` \[kg\] under `gravity` \[m/s²\].
#[inline(always)]
pub fn weight<V: Linear>(mass: V::Real, gravity: V) -> V {
    gravity * mass
}

/// Potential energy \[J\] of a body of `mass` \[kg\] at `position` \[m\], 0 at the origin.
#[inline]
pub fn energy<V: Linear>(mass: V::Real, gravity: V, position: V) -> V::Real {
    -(mass * gravity.dot(position))
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::vector::Vec3;

    #[test]
    fn energy_grows_against_the_field() {
        let g = Vec3::new(0.0, -9.81, 0.0);
        assert_eq!(weight(2.0, g), Vec3::new(0.0, -19.62, 0.0));
        assert_eq!(energy(2.0, g, Vec3::new(5.0, 3.0, 1.0)), 2.0 * 9.81 * 3.0);
    }
}
