//! Directions in space: unit vectors and axes normal to them.
//!
//! Every sum is `(x + y) + z`; the root is libm's, the same on every host.

use dbd_kernel::Vec3;

/// The vector at unit length; `None` if it is 0 or its square underflows or overflows.
pub(crate) fn unit(v: Vec3<f64>) -> Option<Vec3<f64>> {
    let square = v.dot(v);
    // Between these bounds the square neither underflows nor overflows.
    if !(1e-280..=1e280).contains(&square) {
        return None;
    }
    let length = libm::sqrt(square);
    Some(Vec3::new(v.x / length, v.y / length, v.z / length))
}

/// The vector at unit length, such that normalising it again keeps its bits.
pub(crate) fn settled(v: Vec3<f64>) -> Option<Vec3<f64>> {
    // The second pass rarely changes anything.
    const MAX: usize = 8;
    let mut found = unit(v)?;
    for _ in 0..MAX {
        let next = unit(found)?;
        if next == found {
            break;
        }
        found = next;
    }
    Some(found)
}

/// Unit vectors (e1, e2) normal to the unit vector `axis` with `e1 × e2 = axis`; e1 lies in the
/// half plane of `reference`. `None` where reference and axis are parallel within 1e-6.
pub(crate) fn normals(axis: Vec3<f64>, reference: Vec3<f64>) -> Option<[Vec3<f64>; 2]> {
    let across = reference - axis * reference.dot(axis);
    if across.dot(across) < 1e-12 * reference.dot(reference) {
        return None;
    }
    let e1 = unit(across)?;
    Some([e1, axis.cross(e1)])
}

/// The world axis least aligned with a direction, the first of equal ones.
pub(crate) fn least_aligned(direction: Vec3<f64>) -> Vec3<f64> {
    let [x, y, z] = direction.to_f64().map(f64::abs);
    if x <= y && x <= z {
        Vec3::new(1.0, 0.0, 0.0)
    } else if y <= z {
        Vec3::new(0.0, 1.0, 0.0)
    } else {
        Vec3::new(0.0, 0.0, 1.0)
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn normals_are_a_right_handed_triad_through_the_reference() {
        let axis = unit(Vec3::new(1.0, 2.0, -2.0)).unwrap();
        let reference = Vec3::new(0.3, -1.0, 0.5);
        let [e1, e2] = normals(axis, reference).unwrap();
        for (a, b, product) in
            [(e1, e1, 1.0), (e2, e2, 1.0), (e1, e2, 0.0), (e1, axis, 0.0), (e2, axis, 0.0)]
        {
            assert!((a.dot(b) - product).abs() < 1e-15);
        }
        assert!((e1.cross(e2).dot(axis) - 1.0).abs() < 1e-15);
        assert!(e1.dot(reference) > 0.0 && e2.dot(reference).abs() < 1e-15);
    }

    #[test]
    fn what_has_no_direction_is_told() {
        assert_eq!(unit(Vec3::ZERO), None);
        assert_eq!(unit(Vec3::new(1e-160, 0.0, 0.0)), None);
        assert_eq!(unit(Vec3::new(1e160, 0.0, 0.0)), None);
        let x = Vec3::new(1.0, 0.0, 0.0);
        assert_eq!(normals(x, x * -3.0), None);
        assert_eq!(normals(x, Vec3::new(1.0, 1e-7, 0.0)), None);
        assert!(normals(x, Vec3::new(1.0, 1e-5, 0.0)).is_some());
    }

    #[test]
    fn ties_go_to_x_then_y_then_z() {
        let least = |v: [f64; 3]| least_aligned(Vec3::from_f64(v)).to_f64();
        assert_eq!(least([0.0, 0.0, 1.0]), [1.0, 0.0, 0.0]);
        assert_eq!(least([1.0, 0.0, 0.0]), [0.0, 1.0, 0.0]);
        assert_eq!(least([1.0, 1.0, -0.5]), [0.0, 0.0, 1.0]);
        assert_eq!(least([1.0, -1.0, 1.0]), [1.0, 0.0, 0.0]);
    }
}
