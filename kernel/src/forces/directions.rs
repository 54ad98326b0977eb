//! An element at a pose as springs and dampers of one direction each.
//!
//! `(law, deformation, damping, clearance) => directions, each with its stiffness and damping`.

use crate::elements::clearance::{beyond, engaged};
use crate::elements::element::Element;
use crate::elements::point_law::Deformation;
use crate::geometry::Geometry;
use crate::model::{Law, ModelRef, Terms};
use crate::real::{Real, choose};
use crate::space::{Linear as _, Space, Vector as _};

/// The springs of an element without load: the geometric stiffness of its tension is left out.
pub(crate) struct Springs<S: Space> {
    /// \[1\] world axes; for revolute joints with the root of the stiffness ratio as length.
    pub(crate) directions: [S::Vector; 3],
    /// \[N/m, N·s/m\] stiffness and damping along each.
    pub(crate) constants: [[S::Real; 2]; 3],
    /// Their number.
    pub(crate) count: usize,
}

/// The springs of an element, `None` where the model has no such law.
#[inline(always)]
pub(crate) fn springs<P: Geometry, T: Terms<P>>(
    model: &ModelRef<'_, P, T>,
    law: &Element<'_, P::Space>,
    deformation: &Deformation<P::Vector>,
    (damping, clearance): (P::Real, Option<P::Real>),
) -> Option<Springs<P::Space>> {
    let kind = match law {
        Element::Tsda(_) => Law::Tsda,
        Element::PointBushing(_) => Law::PointBushing,
        Element::PointOnLine(_) => Law::PointOnLine,
        Element::Revolute(_) => Law::Revolute,
        Element::Universal(_) => Law::Universal,
    };
    let (directions, count) = model.damped(kind, deformation)?;
    let stiffness = law.stiffness();
    let mut springs = Springs { directions, constants: [[stiffness, damping]; 3], count };
    if clearance.is_some() {
        let extension = law.extension(deformation);
        let out = beyond(extension, clearance).equals(P::Real::ZERO);
        let stiffness = choose!(P::Real, out, P::Real::ZERO, stiffness);
        springs.constants = [[stiffness, engaged(damping, extension, clearance)]; 3];
    }
    if let Element::PointOnLine(law) = law
        && !(clearance.is_none() && law.free_length == P::Real::ZERO)
    {
        // Its force is along the deflection; its damper acts across it, too.
        let e = deformation.displacement;
        let along = e * e.dot(e).sqrt().reciprocal_or_zero();
        springs.directions = [along, deformation.direction.across(along), P::Vector::ZERO];
        springs.constants[1][0] = P::Real::ZERO;
    }
    Some(springs)
}
