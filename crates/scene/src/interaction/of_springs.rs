//! `limits` of raw TSDAs and of torsion springs: stops of their lengths and torsion angles.
//!
//! `(table of a spring, its limits) => bodies, geometry of the law`. Lengths are absolute, torsion angles are
//! relative to t = 0.

use dbd_kernel::Vec3;

use crate::assembly::Assembly;
use crate::between::Between;
use crate::error::SceneError;
use crate::interaction::field::{Of, TwoPlaces};
use crate::interaction::of_joints::{LIMITS, check_limits};
use crate::pair::Pair;
use crate::points::Heading;
use crate::text::Table;

/// The keys of limits of a length, which has no offset.
fn keys(kind: &str) -> Vec<&'static str> {
    LIMITS.iter().copied().filter(|key| kind != "tsda" || *key != "offset").collect()
}

/// The bodies of a stop, exchanged if the ground is the second one, and its points or axis.
pub(super) fn limits<'a>(
    owner: &Table<'_>,
    table: &Table<'_>,
    kind: &str,
    assembly: &Assembly,
) -> Result<(Pair, Of<'a>), SceneError> {
    table.only(&[&keys(kind)])?;
    check_limits(table)?;
    let pair = owner.required("between", Between(assembly))?;
    let (mut points, mut axis) = ([[0.0; 3]; 2], Vec3::ZERO);
    if kind == "tsda" {
        points = owner.required("points", TwoPlaces { assembly, pair: &pair })?;
    } else {
        let written = owner.required("axis", Heading(assembly))?;
        axis = assembly.carried_direction(pair.a, written);
    }
    if !pair.b.is_world() {
        return Ok((pair, Of::Spring(points, axis)));
    }
    let [first, second] = points;
    Ok((pair.reversed(), Of::Spring([second, first], -axis)))
}
