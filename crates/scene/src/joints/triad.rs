//! The axes of a joint: `axis` and the normals defined by `reference`.
//!
//! `table => (e1, e2, axis)`, world, right-handed: e1 is the reference made normal to the axis,
//! e2 = axis × e1, the binormal. The reference defaults to the world axis least aligned with the
//! axis.

use dbd_kernel::Vec3;

use crate::direction::{least_aligned, normals};
use crate::error::SceneError;
use crate::text::Table;

/// Three unit vectors, world.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(super) struct Triad {
    /// The reference.
    pub(super) e1: Vec3<f64>,
    /// The binormal, axis × e1.
    pub(super) e2: Vec3<f64>,
    /// The axis.
    pub(super) axis: Vec3<f64>,
}

/// The triad of an axis and a reference, which belongs to the table if given.
pub(super) fn about(
    table: &Table<'_>,
    axis: Vec3<f64>,
    reference: Option<Vec3<f64>>,
) -> Result<Triad, SceneError> {
    let reference = reference.unwrap_or(least_aligned(axis));
    let [e1, e2] = normals(axis, reference).ok_or_else(|| {
        let help = "give a direction that is not parallel to the axis, such as one normal to it";
        table.refuse_value("reference", "is parallel to the axis", help)
    })?;
    Ok(Triad { e1, e2, axis })
}
