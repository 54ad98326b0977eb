//! What came of a body whose numbers are not written: of a link, a shape, a tensor with products.

use crate::solid::Solid;

/// Mass and principal inertia of a body that the scene file gives by other means.
#[derive(Clone, Debug, PartialEq)]
pub struct DerivedBody {
    /// Its name.
    pub name: String,
    /// The shape that its inertia is of, e.g. `rod`; `None` where that is given.
    pub shape: Option<&'static str>,
    /// The solid that its `shape` is; `None` of a rod without thickness, and where the inertia is given.
    pub solid: Option<Solid>,
    /// \[m\] between the ends of a link.
    pub length: Option<f64>,
    /// \[kg\].
    pub mass: f64,
    /// \[kg·m²\] principal inertia.
    pub inertia: [f64; 3],
    /// \[rad\] by how much its principal axes are turned against those that it is written in.
    pub turned: f64,
}
