//! Conversions to and from nalgebra's vectors and quaternions (feature `nalgebra`).

use crate::real::Real;
use crate::vector::{Quaternion, Vec3};

impl<R: Real + nalgebra::Scalar> From<Vec3<R>> for nalgebra::Vector3<R> {
    fn from(v: Vec3<R>) -> Self {
        nalgebra::Vector3::new(v.x, v.y, v.z)
    }
}

impl<R: Real + nalgebra::Scalar> From<nalgebra::Vector3<R>> for Vec3<R> {
    fn from(v: nalgebra::Vector3<R>) -> Self {
        Vec3::new(v.x, v.y, v.z)
    }
}

impl<R: Real + nalgebra::Scalar> From<Quaternion<R>> for nalgebra::Quaternion<R> {
    fn from(q: Quaternion<R>) -> Self {
        nalgebra::Quaternion { coords: nalgebra::Vector4::new(q.v.x, q.v.y, q.v.z, q.w) }
    }
}

impl<R: Real + nalgebra::Scalar> From<nalgebra::Quaternion<R>> for Quaternion<R> {
    fn from(q: nalgebra::Quaternion<R>) -> Self {
        Quaternion::new(q.coords.w, q.coords.x, q.coords.y, q.coords.z)
    }
}

/// The quaternion is not normalised: it is a unit quaternion where it is an orientation.
impl<R: Real + nalgebra::RealField> From<Quaternion<R>> for nalgebra::UnitQuaternion<R> {
    fn from(q: Quaternion<R>) -> Self {
        nalgebra::Unit::new_unchecked(q.into())
    }
}

impl<R: Real + nalgebra::Scalar> From<nalgebra::UnitQuaternion<R>> for Quaternion<R> {
    fn from(q: nalgebra::UnitQuaternion<R>) -> Self {
        q.into_inner().into()
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn both_ways_keep_every_component_and_the_rotation() {
        let v = Vec3::new(1.0_f32, -2.0, 3.5);
        let n: nalgebra::Vector3<f32> = v.into();
        assert_eq!((n.x, n.y, n.z), (1.0, -2.0, 3.5));
        assert_eq!(Vec3::from(n), v);
        let q = Quaternion::new(0.6, 0.0, 0.8, 0.0);
        let unit: nalgebra::UnitQuaternion<f64> = q.into();
        assert_eq!(Quaternion::from(unit), q);
        let p = Vec3::new(0.1, 0.2, 0.3);
        let turned = unit * nalgebra::Vector3::from(p);
        let difference = nalgebra::Vector3::from(q.rotation().to_world(p)) - turned;
        assert!(difference.abs().max() < 1e-15);
    }
}
