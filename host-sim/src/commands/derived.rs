//! Derived values of bodies given by links, shapes or tensors with products of inertia, for `check`.
//!
//! `scene => mass, principal inertia, by how much the principal axes are turned`.

use dbd_plant::digits::significant;
use dbd_scene::{DerivedBody, Scene};
use serde::Serialize;

use crate::terminal::Look;

/// The derived values of a body given by a link, a shape or a tensor with products of inertia.
#[derive(Clone, Debug, PartialEq, Serialize)]
pub struct DerivedCheck {
    /// Its name.
    pub body: String,
    /// The shape that its inertia is of; `None` where the inertia is given.
    pub shape: Option<&'static str>,
    /// \[m\] between the ends of a link.
    pub length: Option<f64>,
    /// \[kg\].
    pub mass: f64,
    /// \[kg·m²\] principal inertia.
    pub inertia: [f64; 3],
    /// \[°\] rotation from the given axes to the principal axes.
    pub turned_degrees: f64,
}

/// Those of a scene, in its order.
#[must_use]
pub fn derived(scene: &Scene) -> Vec<DerivedCheck> {
    let of = |body: &DerivedBody| DerivedCheck {
        body: body.name.clone(),
        shape: body.shape,
        length: body.length,
        mass: body.mass,
        inertia: body.inertia,
        turned_degrees: body.turned.to_degrees(),
    };
    scene.derived.iter().map(of).collect()
}

/// A table of them.
pub(crate) fn lines(bodies: &[DerivedCheck], look: Look) -> String {
    let head = ["body", "shape", "length [m]", "mass [kg]", "inertia [kg·m²]", "axes turned [°]"];
    let line = |body: &DerivedCheck| {
        [
            body.body.clone(),
            body.shape.unwrap_or("–").into(),
            body.length.map_or_else(|| "–".into(), |length| significant(length, 5)),
            significant(body.mass, 5),
            body.inertia.map(|moment| significant(moment, 4)).join(", "),
            significant(body.turned_degrees, 4),
        ]
    };
    look.columns(Some(head), &bodies.iter().map(line).collect::<Vec<_>>())
}
