//! Mass, centre of mass and inertia; those of shapes.
//!
//! `shape, sizes, density or mass => mass, principal moments`. Masses are combined by the parallel axis theorem.

use std::f64::consts::PI;

use nalgebra::{Isometry3, Matrix3, Matrix4, Rotation3, SymmetricEigen, UnitQuaternion, Vector3};

/// Products of inertia below this fraction of the trace are rounding errors.
const NEGLIGIBLE: f64 = 1e-12;

/// Mass of a rigid body in some frame.
#[derive(Clone, Debug, Default, PartialEq)]
pub(crate) struct Mass {
    /// \[kg\]
    pub(crate) mass: f64,
    /// \[m\] centre of mass.
    pub(crate) centre: Vector3<f64>,
    /// \[kg·m²\] about the centre of mass, in the frame's axes.
    inertia: Matrix3<f64>,
    /// Principal axes and moments, if given explicitly.
    written: Option<(UnitQuaternion<f64>, [f64; 3])>,
}

impl Mass {
    /// A mass with its principal moments, in the frame that `frame` gives.
    pub(crate) fn principal(mass: f64, moments: [f64; 3], frame: &Isometry3<f64>) -> Self {
        let turn = frame.rotation.to_rotation_matrix();
        let diagonal = Matrix3::from_diagonal(&Vector3::from(moments));
        Self {
            mass,
            centre: frame.translation.vector,
            inertia: turn.matrix() * diagonal * turn.matrix().transpose(),
            written: Some((frame.rotation, moments)),
        }
    }

    /// A mass with its tensor, in the frame that `frame` gives.
    pub(crate) fn tensor(mass: f64, tensor: &Matrix3<f64>, frame: &Isometry3<f64>) -> Self {
        let turn = frame.rotation.to_rotation_matrix();
        let inertia = turn.matrix() * tensor * turn.matrix().transpose();
        Self { mass, centre: frame.translation.vector, inertia, written: None }
    }

    /// The same in the frame in which its own frame has pose `pose`.
    pub(crate) fn seen_from(&self, pose: &Isometry3<f64>) -> Self {
        let turn = pose.rotation.to_rotation_matrix();
        Self {
            mass: self.mass,
            centre: pose.translation.vector + pose.rotation * self.centre,
            inertia: turn.matrix() * self.inertia * turn.matrix().transpose(),
            written: self.written.map(|(axes, moments)| (pose.rotation * axes, moments)),
        }
    }

    /// The combined mass.
    pub(crate) fn and(&self, other: &Self) -> Self {
        if other.mass == 0.0 {
            return self.clone();
        }
        if self.mass == 0.0 {
            return other.clone();
        }
        let mass = self.mass + other.mass;
        let centre = (self.centre * self.mass + other.centre * other.mass) / mass;
        let about = |one: &Self| {
            let arm = one.centre - centre;
            let square = Matrix3::identity() * arm.norm_squared() - arm * arm.transpose();
            one.inertia + square * one.mass
        };
        Self { mass, centre, inertia: about(self) + about(other), written: None }
    }

    /// Scaled by a factor.
    pub(crate) fn scaled(&self, factor: f64) -> Self {
        let moments = |(axes, moments): (_, [f64; 3])| (axes, moments.map(|m| m * factor));
        Self {
            mass: self.mass * factor,
            centre: self.centre,
            inertia: self.inertia * factor,
            written: self.written.map(moments),
        }
    }

    /// With other principal moments.
    pub(crate) fn with_moments(&self, change: impl Fn([f64; 3]) -> [f64; 3]) -> Self {
        let (frame, moments) = self.principal_axes();
        let changed = change(moments);
        if changed == moments { self.clone() } else { Self::principal(self.mass, changed, &frame) }
    }

    /// The frame of the principal axes in the centre of mass, and the moments about them.
    pub(crate) fn principal_axes(&self) -> (Isometry3<f64>, [f64; 3]) {
        let (axes, moments) = self.written.unwrap_or_else(|| self.axes());
        (Isometry3::from_parts(self.centre.into(), axes), possible(moments))
    }

    fn axes(&self) -> (UnitQuaternion<f64>, [f64; 3]) {
        let inertia = (self.inertia + self.inertia.transpose()) * 0.5;
        let products = [inertia[(0, 1)], inertia[(0, 2)], inertia[(1, 2)]];
        if products.iter().all(|product| product.abs() <= NEGLIGIBLE * inertia.trace()) {
            let diagonal = [inertia[(0, 0)], inertia[(1, 1)], inertia[(2, 2)]];
            return (UnitQuaternion::identity(), diagonal);
        }
        let eigen = SymmetricEigen::new(inertia);
        // Largest moment first, as in MuJoCo; each axis with its largest entry positive.
        let mut order = [0, 1, 2];
        order.sort_by(|a, b| eigen.eigenvalues[*b].total_cmp(&eigen.eigenvalues[*a]));
        let column = |which: usize| {
            let axis: Vector3<f64> = eigen.eigenvectors.column(order[which]).into();
            let largest = axis[axis.iamax()];
            axis.normalize() * largest.signum()
        };
        let (x, y) = (column(0), column(1));
        let basis = Matrix3::from_columns(&[x, y, x.cross(&y)]);
        let turn = UnitQuaternion::from_rotation_matrix(&Rotation3::from_matrix_unchecked(basis));
        (turn, order.map(|which| eigen.eigenvalues[which]))
    }

    /// \[N·m·s\] angular momentum about the centre of mass at an angular velocity, in its frame.
    pub(crate) fn momentum(&self, rate: &Vector3<f64>) -> Vector3<f64> {
        self.inertia * rate
    }

    /// \[kg·m², kg·m, kg\] the pseudo-inertia ∫(p, 1)(p, 1)ᵀ dm in its frame.
    pub(crate) fn pseudo(&self) -> Matrix4<f64> {
        let second = Matrix3::identity() * (0.5 * self.inertia.trace()) - self.inertia;
        let (m, c) = (self.mass, self.centre);
        let mut pseudo = (second + c * c.transpose() * m).to_homogeneous();
        pseudo.fixed_view_mut::<3, 1>(0, 3).copy_from(&(c * m));
        pseudo.fixed_view_mut::<1, 3>(3, 0).copy_from(&(c * m).transpose());
        pseudo[(3, 3)] = m;
        pseudo
    }

    /// The mass of a pseudo-inertia; `None` without mass.
    pub(crate) fn of_pseudo(pseudo: &Matrix4<f64>) -> Self {
        let m = pseudo[(3, 3)];
        if m <= 0.0 {
            return Self::default();
        }
        let c: Vector3<f64> = pseudo.fixed_view::<3, 1>(0, 3) / m;
        let second: Matrix3<f64> = pseudo.fixed_view::<3, 3>(0, 0) - c * c.transpose() * m;
        let inertia = Matrix3::identity() * second.trace() - second;
        Self::tensor(m, &inertia, &Isometry3::translation(c.x, c.y, c.z))
    }

    /// \[m\] root mean square distance of the mass from its centre.
    pub(crate) fn gyration(&self) -> f64 {
        if self.mass > 0.0 {
            (self.inertia.trace() / (2.0 * self.mass)).max(0.0).sqrt()
        } else {
            0.0
        }
    }
}

/// Corrects moments of which one exceeds the sum of the others by rounding only.
fn possible(mut moments: [f64; 3]) -> [f64; 3] {
    for i in 0..3 {
        let others = moments[(i + 1) % 3] + moments[(i + 2) % 3];
        if moments[i] > others && moments[i] <= others * (1.0 + 1e-9) {
            moments[i] = others;
        }
    }
    moments
}

/// A solid shape; its axis is z.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(crate) enum Solid {
    /// Radius.
    Sphere(f64),
    /// Radius and half the length of its straight part.
    Capsule(f64, f64),
    /// Radius and half the length.
    Cylinder(f64, f64),
    /// Half axes.
    Ellipsoid([f64; 3]),
    /// Half edges.
    Box([f64; 3]),
}

impl Solid {
    /// \[m³\]
    pub(crate) fn volume(&self) -> f64 {
        match *self {
            Self::Sphere(r) => 4.0 / 3.0 * PI * r * r * r,
            Self::Capsule(r, h) => PI * r * r * (2.0 * h + 4.0 / 3.0 * r),
            Self::Cylinder(r, h) => PI * r * r * 2.0 * h,
            Self::Ellipsoid([a, b, c]) => 4.0 / 3.0 * PI * a * b * c,
            Self::Box([a, b, c]) => 8.0 * a * b * c,
        }
    }

    /// \[kg·m²\] principal moments at uniform density.
    pub(crate) fn moments(&self, mass: f64) -> [f64; 3] {
        let of_axes = |[a, b, c]: [f64; 3], share: f64| {
            [b * b + c * c, a * a + c * c, a * a + b * b].map(|sum| mass * share * sum)
        };
        match *self {
            Self::Sphere(r) => [0.4 * mass * r * r; 3],
            Self::Ellipsoid(axes) => of_axes(axes, 0.2),
            Self::Box(edges) => of_axes(edges, 1.0 / 3.0),
            Self::Cylinder(r, h) => {
                let across = mass * (3.0 * r * r + 4.0 * h * h) / 12.0;
                [across, across, 0.5 * mass * r * r]
            }
            Self::Capsule(r, h) => {
                // Two hemispheres, whose centroids are 3r/8 beyond the ends of the cylinder.
                let ends = mass * 4.0 * r / (4.0 * r + 6.0 * h);
                let middle = mass - ends;
                let across = middle * (3.0 * r * r + 4.0 * h * h) / 12.0
                    + ends * (0.4 * r * r + h * h + 0.75 * h * r);
                [across, across, 0.5 * middle * r * r + 0.4 * ends * r * r]
            }
        }
    }

    /// A one-line description.
    pub(crate) fn words(&self) -> String {
        match self {
            Self::Sphere(r) => format!("sphere, radius {r} m"),
            Self::Capsule(r, h) => format!("capsule, radius {r} m, length {} m", 2.0 * h),
            Self::Cylinder(r, h) => format!("cylinder, radius {r} m, length {} m", 2.0 * h),
            Self::Ellipsoid([a, b, c]) => format!("ellipsoid, {a} × {b} × {c} m"),
            Self::Box([a, b, c]) => format!("box, {} × {} × {} m", 2.0 * a, 2.0 * b, 2.0 * c),
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    /// Comparison with sums over a grid of points.
    #[test]
    fn moments_of_shapes_are_those_of_their_points() {
        let solids = [
            Solid::Sphere(0.9),
            Solid::Capsule(0.4, 0.6),
            Solid::Cylinder(0.5, 0.8),
            Solid::Ellipsoid([0.3, 0.6, 0.9]),
            Solid::Box([0.3, 0.5, 0.9]),
        ];
        let inside = |solid: &Solid, p: Vector3<f64>| match *solid {
            Solid::Sphere(r) => p.norm() < r,
            Solid::Capsule(r, h) => (p - Vector3::z() * p.z.clamp(-h, h)).norm() < r,
            Solid::Cylinder(r, h) => p.xy().norm() < r && p.z.abs() < h,
            Solid::Ellipsoid(a) => (0..3).map(|i| (p[i] / a[i]).powi(2)).sum::<f64>() < 1.0,
            Solid::Box(a) => (0..3).all(|i| p[i].abs() < a[i]),
        };
        let (cells, half) = (80, 1.0);
        let edge = 2.0 * half / f64::from(cells);
        for solid in solids {
            let (mut volume, mut moments) = (0.0, Vector3::zeros());
            for cell in 0..cells * cells * cells {
                let index = [cell % cells, cell / cells % cells, cell / cells / cells];
                let p = Vector3::from(index.map(|i| (f64::from(i) + 0.5) * edge - half));
                if inside(&solid, p) {
                    volume += edge.powi(3);
                    moments +=
                        (Vector3::repeat(p.norm_squared()) - p.component_mul(&p)) * edge.powi(3);
                }
            }
            assert!((solid.volume() / volume - 1.0).abs() < 0.02, "{solid:?} {volume}");
            let expected = solid.moments(solid.volume());
            for (i, expected) in expected.iter().enumerate() {
                assert!((expected / moments[i] - 1.0).abs() < 0.03, "{solid:?} {moments:?}");
            }
        }
    }

    /// Two halves of a box combine to the box at any pose.
    #[test]
    fn halves_together_are_the_whole() {
        let turn = UnitQuaternion::from_euler_angles(0.3, -0.8, 1.9);
        let pose = Isometry3::from_parts(Vector3::new(0.1, 2.0, -0.4).into(), turn);
        let (whole, half) = (Solid::Box([0.4, 0.3, 0.1]), Solid::Box([0.2, 0.3, 0.1]));
        let at = |x: f64| {
            Mass::principal(1.5, half.moments(1.5), &Isometry3::translation(x, 0.0, 0.0))
                .seen_from(&pose)
        };
        let both = at(-0.2).and(&at(0.2));
        let (frame, mut moments) = both.principal_axes();
        assert!((frame.translation.vector - pose.translation.vector).norm() < 1e-15);
        let mut expected = whole.moments(3.0);
        expected.sort_by(f64::total_cmp);
        moments.sort_by(f64::total_cmp);
        for (a, b) in moments.iter().zip(expected) {
            assert!((a - b).abs() < 1e-14, "{moments:?} {expected:?}");
        }
        let turned = frame.rotation.to_rotation_matrix();
        let (_, moments) = both.principal_axes();
        let diagonal = Matrix3::from_diagonal(&Vector3::from(moments));
        let back = turned.matrix() * diagonal * turned.matrix().transpose();
        assert!((back - both.inertia).norm() < 1e-14);
    }
}
