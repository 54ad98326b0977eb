//! A scene in its plane: the planar model and the conversion back to the world.
//!
//! `state or reading in the plane <=> in the world`.

mod embedding;
mod plane;

pub use plane::Plane;
pub(crate) use plane::{ALIKE, Axes, short};

use dbd_kernel::F64;

use crate::runtime::SceneModel;

/// A scene in its plane.
#[derive(Clone, Debug, PartialEq)]
pub struct Planar {
    /// The model in the plane z = 0 of its own axes.
    pub model: SceneModel<F64>,
    /// The position of that plane in the world.
    pub plane: Plane,
    /// Rows of the groups that are equally stiff at rest only, because their elements did not lie in the plane.
    pub at_rest: Vec<usize>,
}
