//! Realisation of a joint: TSDAs, or bushings of zero length.
//!
//! `table => realisation`. The joint's own key takes precedence over `[defaults]`, and these over the scene's
//! `realisation`, which applies to every joint that supports it.

use crate::assembly::Assembly;
use crate::error::SceneError;
use crate::joints::kind::{JointType, Realisation};
use crate::spring::Spring;
use crate::text::{Choice, Table};

pub(super) const KEY: &str = "realisation";

/// The realisation that a table gives.
fn given(table: &Table<'_>) -> Result<Option<Realisation>, SceneError> {
    let names = Realisation::ALL.map(Realisation::name);
    Ok(table.optional(KEY, Choice(&names))?.map(|index| Realisation::ALL[index]))
}

/// The realisation of all joints of a scene that support it.
pub(super) fn of_all(root: &Table<'_>) -> Result<Realisation, SceneError> {
    Ok(given(root)?.unwrap_or_default())
}

/// Rejects the key for a joint type with a single realisation.
pub(super) fn check(table: &Table<'_>, kind: &JointType) -> Result<(), SceneError> {
    if kind.keys.contains(&KEY) || !table.gives(KEY) {
        return Ok(());
    }
    let problem = format!("cannot be set: a {} joint has a single realisation", kind.name);
    let help = "remove it: its points slide along lines, which a bushing would prevent; `revolute`, \
                `spherical`, `universal` and `fixed` joints have several realisations";
    Err(table.refuse_value(KEY, &problem, help))
}

/// The realisation of a joint, `of_all` by default.
pub(super) fn read(
    table: &Table<'_>,
    kind: &JointType,
    spring: Spring,
    of_all: Realisation,
) -> Result<Realisation, SceneError> {
    if !kind.keys.contains(&KEY) {
        return Ok(Realisation::Tsda);
    }
    let own = given(table)?;
    if spring.clearance > 0.0 {
        if own == Some(Realisation::Bushing) {
            let help = "use `clearance = 0`, or `realisation = \"tsda\"` for this joint: the points of a \
                        bushing coincide and have no clearance";
            return Err(table.refuse_value(KEY, "is not compatible with a clearance", help));
        }
        return Ok(Realisation::Tsda);
    }
    Ok(own.unwrap_or(of_all))
}

/// The points of the bushings of a joint on both bodies, coincident at the assembled pose.
pub(super) fn ends<const N: usize>(
    joint: &super::Joint,
    places: [dbd_kernel::Vec3<f64>; N],
    assembly: &Assembly,
) -> [[dbd_kernel::Vec3<f64>; N]; 2] {
    [joint.pair.a, joint.pair.b].map(|body| places.map(|place| assembly.point_in(body, place)))
}
