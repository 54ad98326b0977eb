//! Orientation of a body from the direction of one axis.
//!
//! `(direction, axis) => unit quaternion`, body → world: the shortest rotation, or the one that puts the next axis on
//! the side of a reference. The shortest rotation is computed from its axis and angle, each rounded once, so that it
//! has the bits of `{ axis, angle }` written with all digits.

use dbd_kernel::Vec3;

use crate::direction::unit;
use crate::orientation::{about, of_axes};
use crate::precise::{Precise, PreciseVector, arctangent};

/// Sines below this are rounding.
const PARALLEL: f64 = 1e-28;

/// The shortest rotation that aligns body axis `along` with a unit direction.
pub(super) fn nearest(direction: PreciseVector, along: usize) -> [f64; 4] {
    let axis = PreciseVector::axes()[along];
    let across = axis.cross(direction);
    let angle = arctangent(across.length(), axis.dot(direction));
    let turned = Some(across).filter(|across| across.length().nearest() > PARALLEL);
    let Some(turn) = turned.and_then(PreciseVector::unit).map(|turn| turn.unsigned().nearest())
    else {
        // Parallel or antiparallel: half a revolution about z, for the axis z about x.
        let about_w = if along == 2 { [1.0, 0.0, 0.0] } else { [0.0, 0.0, 1.0] };
        let half = core::f64::consts::PI;
        let angle = if axis.dot(direction).nearest() < 0.0 { half } else { 0.0 };
        return about(about_w, angle).to_f64();
    };
    // Prefer an axis along +x, +y or +z; the angle carries the sign.
    let [x, y, z] = turn.to_f64();
    let largest = [x, y, z].into_iter().fold(0.0_f64, |a, b| if b.abs() > a.abs() { b } else { a });
    let (turn, angle) =
        if largest < 0.0 { (turn * -1.0 + Vec3::ZERO, -angle) } else { (turn, angle) };
    about(unit(turn).unwrap_or(turn).to_f64(), angle).to_f64()
}

/// The rotation that aligns body axis `along` with a unit direction and puts the next one (y after x, z after y, x
/// after z) on the side of a reference. `None` where both are parallel.
pub(super) fn with_reference(
    direction: PreciseVector,
    along: usize,
    reference: PreciseVector,
) -> Option<[f64; 4]> {
    let [next, last] = direction.normals(reference)?;
    let mut axes = [PreciseVector::ZERO; 3];
    for (i, axis) in [direction, next, last].into_iter().enumerate() {
        axes[(along + i) % 3] = axis;
    }
    Some(of_axes(axes.map(PreciseVector::nearest)))
}

/// The axes of a frame rotated by a unit quaternion, scalar first, with all digits.
pub(crate) fn axes_of(orientation: [f64; 4]) -> [PreciseVector; 3] {
    let [w, x, y, z] = orientation.map(Precise::from);
    let scale = (Precise::ONE + Precise::ONE) / (w * w + x * x + y * y + z * z);
    let one = Precise::ONE;
    [
        PreciseVector {
            x: one - scale * (y * y + z * z),
            y: scale * (x * y + w * z),
            z: scale * (x * z - w * y),
        },
        PreciseVector {
            x: scale * (x * y - w * z),
            y: one - scale * (x * x + z * z),
            z: scale * (y * z + w * x),
        },
        PreciseVector {
            x: scale * (x * z + w * y),
            y: scale * (y * z - w * x),
            z: one - scale * (x * x + y * y),
        },
    ]
}
