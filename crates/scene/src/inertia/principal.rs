//! Principal moments and axes of an inertia tensor.
//!
//! `symmetric tensor => moments, axes`. Jacobi's rotations in cyclic order (Golub & Van Loan, Matrix Computations,
//! 8.5), each by at most 45°; the only function used is libm's square root, so the bits are the same on every host.
//! Of the 24 orders and signs that make a right-handed triad the one nearest to the given axes is chosen; a product
//! below the rounding error of the moments counts as 0, so a diagonal tensor keeps its bits and axes.

use dbd_kernel::Vec3;

/// Maximum number of sweeps: 3 × 3 tensors converge after four or five.
const SWEEPS: usize = 30;

/// A symmetric 3 × 3 tensor.
pub(crate) type Tensor = [[f64; 3]; 3];

/// Principal moments and axes.
#[derive(Clone, Debug, PartialEq)]
pub(crate) struct Principal {
    /// About each axis.
    pub(crate) moments: [f64; 3],
    /// Right-handed unit vectors in the tensor's axes.
    pub(crate) axes: [Vec3<f64>; 3],
    /// Whether they differ from the axes of the tensor.
    pub(crate) is_turned: bool,
}

/// Diagonalises a tensor.
pub(crate) fn principal(tensor: Tensor) -> Principal {
    let mut t = tensor;
    // Columns are the axes.
    let mut axes = [[1.0, 0.0, 0.0], [0.0, 1.0, 0.0], [0.0, 0.0, 1.0]];
    let mut is_turned = false;
    for _ in 0..SWEEPS {
        let mut is_diagonal = true;
        for (p, q) in [(0, 1), (0, 2), (1, 2)] {
            let product = t[p][q];
            let scale = libm::sqrt(t[p][p].abs()) * libm::sqrt(t[q][q].abs());
            if product.abs() <= f64::EPSILON * scale {
                t[p][q] = 0.0;
                t[q][p] = 0.0;
                continue;
            }
            (is_diagonal, is_turned) = (false, true);
            rotate(&mut t, &mut axes, (p, q));
        }
        if is_diagonal {
            break;
        }
    }
    let moments = [t[0][0], t[1][1], t[2][2]];
    if !is_turned {
        return Principal { moments, axes: Vec3::axes(), is_turned };
    }
    nearest(moments, axes)
}

/// The rotation in the plane of two axes that eliminates their product of inertia.
fn rotate(t: &mut Tensor, axes: &mut [[f64; 3]; 3], (p, q): (usize, usize)) {
    let product = t[p][q];
    let cotangent = (t[q][q] - t[p][p]) / (2.0 * product);
    let root = libm::sqrt(1.0 + cotangent * cotangent);
    let tangent = if cotangent < 0.0 { -1.0 } else { 1.0 } / (cotangent.abs() + root);
    let cosine = 1.0 / libm::sqrt(1.0 + tangent * tangent);
    let sine = tangent * cosine;
    t[p][p] -= tangent * product;
    t[q][q] += tangent * product;
    t[p][q] = 0.0;
    t[q][p] = 0.0;
    let r = 3 - p - q;
    let (rp, rq) = (t[r][p], t[r][q]);
    t[r][p] = cosine * rp - sine * rq;
    t[r][q] = sine * rp + cosine * rq;
    (t[p][r], t[q][r]) = (t[r][p], t[r][q]);
    for row in axes {
        let (p_of, q_of) = (row[p], row[q]);
        row[p] = cosine * p_of - sine * q_of;
        row[q] = sine * p_of + cosine * q_of;
    }
}

/// Chooses order and signs so that the axes are nearest to those of the tensor.
fn nearest(moments: [f64; 3], columns: [[f64; 3]; 3]) -> Principal {
    const ORDERS: [[usize; 3]; 6] =
        [[0, 1, 2], [0, 2, 1], [1, 0, 2], [1, 2, 0], [2, 0, 1], [2, 1, 0]];
    let closeness =
        |order: &[usize; 3]| (0..3).map(|axis| columns[axis][order[axis]].abs()).sum::<f64>();
    let mut best = ORDERS[0];
    for order in &ORDERS[1..] {
        if closeness(order) > closeness(&best) {
            best = *order;
        }
    }
    let column = |axis: usize| {
        let c = best[axis];
        let v = Vec3::new(columns[0][c], columns[1][c], columns[2][c]);
        if columns[axis][c] < 0.0 { -v } else { v }
    };
    let mut axes = [column(0), column(1), column(2)];
    if axes[0].cross(axes[1]).dot(axes[2]) < 0.0 {
        // The axis with the least distinct direction.
        let along = |axis: &usize| axes[*axis].to_f64()[*axis];
        let least =
            (1..3).fold(0, |least, axis| if along(&axis) < along(&least) { axis } else { least });
        axes[least] = -axes[least];
    }
    Principal { moments: best.map(|c| moments[c]), axes, is_turned: true }
}

#[cfg(test)]
mod tests {
    use super::*;
    use dbd_kernel::Quaternion;
    use proptest::prelude::*;
    use proptest::test_runner::RngSeed;

    /// V·diag·Vᵀ.
    fn tensor(moments: [f64; 3], axes: [Vec3<f64>; 3]) -> Tensor {
        let axes = axes.map(Vec3::to_f64);
        let entry = |i: usize, j: usize| (0..3).map(|k| moments[k] * axes[k][i] * axes[k][j]).sum();
        [0, 1, 2].map(|i| [0, 1, 2].map(|j| entry(i, j)))
    }

    fn turned(q: [f64; 4]) -> [Vec3<f64>; 3] {
        let norm = q.iter().map(|c| c * c).sum::<f64>().sqrt();
        let rotation = Quaternion::from_f64(q.map(|c| c / norm)).rotation();
        Vec3::axes().map(|axis| rotation.to_world(axis))
    }

    /// The largest entry of a difference, over the largest moment.
    fn error(a: Tensor, b: Tensor) -> f64 {
        let gap = a.as_flattened().iter().zip(b.as_flattened()).map(|(a, b)| (a - b).abs());
        gap.fold(0.0, f64::max) / (a[0][0] + a[1][1] + a[2][2])
    }

    fn check(given: Tensor) -> Result<Principal, TestCaseError> {
        let found = principal(given);
        prop_assert!(error(given, tensor(found.moments, found.axes)) < 2e-15, "{found:?}");
        let [x, y, z] = found.axes;
        for (a, b, product) in
            [(x, x, 1.0), (y, y, 1.0), (z, z, 1.0), (x, y, 0.0), (y, z, 0.0), (z, x, 0.0)]
        {
            prop_assert!((a.dot(b) - product).abs() < 2e-15);
        }
        prop_assert!((x.cross(y).dot(z) - 1.0).abs() < 4e-15);
        // Each axis has a positive component along the given one, and no other order is nearer.
        let axes = found.axes.map(Vec3::to_f64);
        let closeness = |order: [usize; 3]| (0..3).map(|i| axes[order[i]][i].abs()).sum::<f64>();
        for order in [[0, 2, 1], [1, 0, 2], [1, 2, 0], [2, 0, 1], [2, 1, 0]] {
            prop_assert!(closeness([0, 1, 2]) >= closeness(order) - 1e-14, "{order:?}");
        }
        // Reversing two axes keeps it right-handed.
        for (i, j) in [(0, 1), (1, 2), (2, 0)] {
            prop_assert!(axes[i][i] + axes[j][j] >= -1e-14, "{found:?}");
        }
        Ok(found)
    }

    proptest! {
        #![proptest_config(ProptestConfig {
            cases: 2000,
            failure_persistence: None,
            rng_seed: RngSeed::Fixed(2297),
            ..ProptestConfig::default()
        })]

        #[test]
        fn a_random_tensor_is_its_moments_about_its_axes(
            moments in prop::array::uniform3(0.01..10.0_f64),
            q in prop::array::uniform4(-1.0..1.0_f64),
        ) {
            prop_assume!(q.iter().map(|c| c * c).sum::<f64>() > 1e-3);
            let mut given = tensor(moments, turned(q));
            for (i, j) in [(0, 1), (0, 2), (1, 2)] {
                given[j][i] = given[i][j];
            }
            let found = check(given)?;
            let mut sorted = [moments, found.moments];
            sorted.iter_mut().for_each(|moments| moments.sort_by(f64::total_cmp));
            for (a, b) in sorted[0].iter().zip(sorted[1]) {
                prop_assert!((a - b).abs() < 1e-14 * sorted[0][2], "{moments:?} {found:?}");
            }
        }

        /// Nearly or exactly equal moments: the axes are arbitrary, but right-handed.
        #[test]
        fn nearly_equal_moments_make_no_harm(
            small in prop::array::uniform3(-1.0..1.0_f64),
            exponent in 3..17_i32,
            q in prop::array::uniform4(-1.0..1.0_f64),
        ) {
            prop_assume!(q.iter().map(|c| c * c).sum::<f64>() > 1e-3);
            let moments = small.map(|s| 1.0 + s * 10.0_f64.powi(-exponent));
            let mut given = tensor(moments, turned(q));
            for (i, j) in [(0, 1), (0, 2), (1, 2)] {
                given[j][i] = given[i][j];
            }
            check(given)?;
        }

        #[test]
        fn a_diagonal_tensor_keeps_its_bits(moments in prop::array::uniform3(1e-12..1e12_f64)) {
            let [x, y, z] = moments;
            // Noise below the rounding error of the moments counts as 0.
            let noise = 1e-17 * x.min(y).min(z);
            let found = principal([[x, noise, 0.0], [noise, y, -noise], [0.0, -noise, z]]);
            prop_assert_eq!(found.moments, moments);
            prop_assert!(!found.is_turned && found.axes == Vec3::axes());
        }

        /// A rotation of less than 45° about an axis is found exactly.
        #[test]
        fn a_small_turn_is_found(angle in -0.7..0.7_f64, axis in 0..3_usize) {
            let (s, c) = (0.5 * angle).sin_cos();
            let mut q = [c, 0.0, 0.0, 0.0];
            q[axis + 1] = s;
            let expected = turned(q);
            let found = principal(tensor([1.0, 1.3, 1.9], expected));
            for (a, b) in found.axes.into_iter().zip(expected) {
                prop_assert!((a - b).dot(a - b) < 1e-28, "{:?}", found);
            }
        }
    }
}
