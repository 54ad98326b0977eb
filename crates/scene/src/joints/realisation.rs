//! What a joint is made of: TSDAs, or bushings without a length.
//!
//! `table => realisation`. The joint's own key goes before `[defaults]`, these before the scene's
//! `realisation`, which is that of every joint that can have it.

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

/// The realisation of all joints of a scene that can have it.
pub(super) fn of_all(root: &Table<'_>) -> Result<Realisation, SceneError> {
    Ok(given(root)?.unwrap_or_default())
}

/// Refuses the key in the table of a joint whose type has but one.
pub(super) fn check(table: &Table<'_>, kind: &JointType) -> Result<(), SceneError> {
    if kind.keys.contains(&KEY) || !table.gives(KEY) {
        return Ok(());
    }
    let problem = format!("is of a {} joint, which has but one", kind.name);
    let help = "leave it out: its points on lines slide, a bushing would hold them; `revolute`, \
                `spherical`, `universal` and `fixed` joints have realisations";
    Err(table.refuse_value(KEY, &problem, help))
}

/// The realisation of a joint, `of_all` where nothing else says which.
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
            let help = "`clearance = 0`, or `realisation = \"tsda\"` for this joint: the points of a \
                        bushing lie in each other, nothing is between them";
            return Err(table.refuse_value(KEY, "is that of a joint with a clearance", help));
        }
        return Ok(Realisation::Tsda);
    }
    Ok(own.unwrap_or(of_all))
}

/// The places of bushings of a joint: points of both bodies that are one at the pose of assembly.
pub(super) fn ends<const N: usize>(
    joint: &super::Joint,
    places: [dbd_kernel::Vec3<f64>; N],
    assembly: &Assembly,
) -> [[dbd_kernel::Vec3<f64>; N]; 2] {
    [joint.pair.a, joint.pair.b].map(|body| places.map(|place| assembly.point_in(body, place)))
}
