//! Mass and inertia derived from a link, a shape or a tensor with products of inertia.

use crate::solid::Solid;

/// Mass and principal inertia of a body that the scene file gives by other means.
#[derive(Clone, Debug, PartialEq)]
pub struct DerivedBody {
    /// Its name.
    pub name: String,
    /// The shape that determines its inertia, e.g. `rod`; `None` if the inertia is given.
    pub shape: Option<&'static str>,
    /// The solid of its `shape`; `None` for a rod without thickness or a given inertia.
    pub solid: Option<Solid>,
    /// \[m\] between the ends of a link.
    pub length: Option<f64>,
    /// \[kg\].
    pub mass: f64,
    /// \[kg·m²\] principal inertia.
    pub inertia: [f64; 3],
    /// \[rad\] rotation of its principal axes from its given axes.
    pub turned: f64,
}
