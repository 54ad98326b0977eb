//! Rotation of a body since t = 0, without jumps.
//!
//! `(orientation at t = 0, orientations) => rotation \[rad\]`: a vector along the rotation axis in world axes with the
//! angle as length. From half a revolution on, where that axis is not meaningful, the rotations between samples are
//! summed instead, as for a crank.

/// \[rad\] beyond this angle rotations are summed.
const LARGEST: f64 = 0.9 * std::f64::consts::PI;

/// The rotation of a body.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Turn {
    /// Unit quaternions, scalar first, body → world.
    start: [f64; 4],
    last: [f64; 4],
    /// \[rad\].
    so_far: [f64; 3],
    added_up: bool,
}

impl Turn {
    /// None yet, from an orientation on: a unit quaternion, scalar first, body → world.
    #[must_use]
    pub fn new(start: [f64; 4]) -> Self {
        Self { start, last: start, so_far: [0.0; 3], added_up: false }
    }

    /// The rotation \[rad\], world axes, to the next orientation.
    pub fn to(&mut self, orientation: [f64; 4]) -> [f64; 3] {
        if self.added_up {
            let step = rotation(self.last, orientation);
            self.so_far = [0, 1, 2].map(|axis| self.so_far[axis] + step[axis]);
        } else {
            self.so_far = rotation(self.start, orientation);
            self.added_up = dot(&self.so_far, &self.so_far).sqrt() > LARGEST;
        }
        self.last = orientation;
        self.so_far
    }
}

/// The shortest rotation \[rad\] from one orientation to another, world axes.
fn rotation(from: [f64; 4], to: [f64; 4]) -> [f64; 3] {
    let [a, b, c, d] = from;
    // The nearer of a quaternion and its opposite.
    let way = if dot(&from, &to) < 0.0 { -1.0 } else { 1.0 };
    let [w, x, y, z] = to.map(|component| way * component);
    // to · conjugate(from)
    let scalar = w * a + x * b + y * c + z * d;
    let vector = [
        -w * b + x * a - y * d + z * c,
        -w * c + x * d + y * a - z * b,
        -w * d - x * c + y * b + z * a,
    ];
    let sine = dot(&vector, &vector).sqrt();
    // Of a small angle the sine is half of it.
    let factor = if sine < 1e-9 { 2.0 } else { 2.0 * sine.atan2(scalar) / sine };
    vector.map(|component| factor * component)
}

fn dot(a: &[f64], b: &[f64]) -> f64 {
    a.iter().zip(b).map(|(a, b)| a * b).sum()
}

#[cfg(test)]
mod tests {
    use std::f64::consts::TAU;

    use super::*;

    fn about_z(angle: f64) -> [f64; 4] {
        let half = 0.5 * angle;
        [half.cos(), 0.0, 0.0, half.sin()]
    }

    #[test]
    fn a_crank_counts_on_either_way() {
        for way in [1.0, -1.0] {
            let mut turn = Turn::new(about_z(0.3));
            // Including exact full revolutions.
            for part in 0..=400 {
                let angle = way * f64::from(part) * TAU / 40.0;
                let found = turn.to(about_z(0.3 + angle));
                assert!((found[2] - angle).abs() < 1e-9, "{angle} {found:?}");
                assert!(found[0].abs() < 1e-9 && found[1].abs() < 1e-9);
            }
        }
    }

    /// A crank whose axis wobbles by a milliradian shows no rotation about other axes.
    #[test]
    fn a_wobble_is_not_multiplied_by_the_turns() {
        let mut turn = Turn::new([1.0, 0.0, 0.0, 0.0]);
        for part in 0..4000 {
            let angle = f64::from(part) * 0.1;
            let [w, _, _, z] = about_z(angle);
            let tilt = 5e-4 * (1.3 * angle).sin();
            // The rotation about z, then a tilt about x.
            let found = turn.to([w, tilt * w, -tilt * z, z]);
            assert!((found[2] - angle).abs() < 0.01, "{angle} {found:?}");
            assert!(found[0].abs() < 0.01 && found[1].abs() < 0.01, "{angle} {found:?}");
        }
    }

    #[test]
    fn it_is_about_the_axes_of_the_world() {
        // A body on its side rotates about the vertical.
        let side = [0.5_f64.sqrt(), 0.5_f64.sqrt(), 0.0, 0.0];
        let half = 0.1_f64;
        let [w, x] = [side[0] * half.cos(), side[1] * half.cos()];
        let [y, z] = [side[1] * half.sin(), side[0] * half.sin()];
        let found = Turn::new(side).to([w, x, y, z]);
        assert!((found[2] - 0.2).abs() < 1e-12, "{found:?}");
        assert!(found[0].abs() < 1e-12 && found[1].abs() < 1e-12);
        // The opposite quaternion is the same orientation.
        let found = Turn::new(side).to([-w, -x, -y, -z]);
        assert!((found[2] - 0.2).abs() < 1e-12, "{found:?}");
    }
}
