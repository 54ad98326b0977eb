//! Vectors, matrices and quaternions as arrays: what a plain loop is written with.

/// Three numbers.
pub type Vector = [f64; 3];
/// Rows.
pub type Matrix = [Vector; 3];
/// Scalar first.
pub type Quaternion = [f64; 4];

/// `a + b`.
#[must_use]
pub fn sum(a: Vector, b: Vector) -> Vector {
    [a[0] + b[0], a[1] + b[1], a[2] + b[2]]
}

/// `a − b`.
#[must_use]
pub fn difference(a: Vector, b: Vector) -> Vector {
    [a[0] - b[0], a[1] - b[1], a[2] - b[2]]
}

/// `a·s`.
#[must_use]
pub fn scaled(a: Vector, s: f64) -> Vector {
    [a[0] * s, a[1] * s, a[2] * s]
}

/// The dot product.
#[must_use]
pub fn dot(a: Vector, b: Vector) -> f64 {
    a[0] * b[0] + a[1] * b[1] + a[2] * b[2]
}

/// The cross product.
#[must_use]
pub fn cross(a: Vector, b: Vector) -> Vector {
    [a[1] * b[2] - a[2] * b[1], a[2] * b[0] - a[0] * b[2], a[0] * b[1] - a[1] * b[0]]
}

/// `m·v`.
#[must_use]
pub fn turned(m: &Matrix, v: Vector) -> Vector {
    [dot(m[0], v), dot(m[1], v), dot(m[2], v)]
}

/// `mᵀ·v`.
#[must_use]
pub fn turned_back(m: &Matrix, v: Vector) -> Vector {
    let column = |i: usize| m[0][i] * v[0] + m[1][i] * v[1] + m[2][i] * v[2];
    [column(0), column(1), column(2)]
}

/// The product of two quaternions.
#[must_use]
pub fn product(p: Quaternion, q: Quaternion) -> Quaternion {
    [
        p[0] * q[0] - p[1] * q[1] - p[2] * q[2] - p[3] * q[3],
        p[0] * q[1] + p[1] * q[0] + p[2] * q[3] - p[3] * q[2],
        p[0] * q[2] - p[1] * q[3] + p[2] * q[0] + p[3] * q[1],
        p[0] * q[3] + p[1] * q[2] - p[2] * q[1] + p[3] * q[0],
    ]
}

/// The inverse of a unit quaternion.
#[must_use]
pub fn inverse(q: Quaternion) -> Quaternion {
    [q[0], -q[1], -q[2], -q[3]]
}

/// The quaternion of a turn by a rotation vector.
#[must_use]
pub fn turn(by: Vector) -> Quaternion {
    let angle = dot(by, by).sqrt();
    let (sine, cosine) = (0.5 * angle).sin_cos();
    let share = if angle > 0.0 { sine / angle } else { 0.5 };
    [cosine, by[0] * share, by[1] * share, by[2] * share]
}

/// The unit quaternion along `q`.
#[must_use]
pub fn normalised(q: Quaternion) -> Quaternion {
    let length = (q[0] * q[0] + q[1] * q[1] + q[2] * q[2] + q[3] * q[3]).sqrt();
    q.map(|component| component / length)
}

/// The rotation matrix of a unit quaternion.
#[must_use]
pub fn matrix([w, x, y, z]: Quaternion) -> Matrix {
    [
        [1.0 - 2.0 * (y * y + z * z), 2.0 * (x * y - w * z), 2.0 * (x * z + w * y)],
        [2.0 * (x * y + w * z), 1.0 - 2.0 * (x * x + z * z), 2.0 * (y * z - w * x)],
        [2.0 * (x * z - w * y), 2.0 * (y * z + w * x), 1.0 - 2.0 * (x * x + y * y)],
    ]
}
