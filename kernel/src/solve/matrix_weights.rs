//! The weights of masses, dampers and springs in a matrix.
//!
//! `(stiffness, damping) => κ·k + χ·c`. The three weights follow from a scheme's constants and its step.

use crate::geometry::Geometry;
use crate::model::{Group, ModelRef, Terms};
use crate::real::Real;

/// The weights of mass, damping and stiffness in a matrix.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub struct MatrixWeights<R> {
    /// \[1\] of masses.
    pub mass: R,
    /// \[s\] of damping coefficients.
    pub damping: R,
    /// \[s²\] of stiffnesses.
    pub stiffness: R,
}

impl<R: Real> MatrixWeights<R> {
    /// The weight of a spring and its damper.
    #[inline(always)]
    pub(super) fn weight(&self, stiffness: R, damping: R) -> R {
        self.stiffness * stiffness + self.damping * damping
    }
}

/// The weight of element `i` of a group, `None` where the model lacks it.
#[inline(always)]
pub(super) fn weight_of<P: Geometry, T: Terms<P>>(
    model: &ModelRef<'_, P, T>,
    group: &Group,
    (i, index): (usize, usize),
    matrix_weights: MatrixWeights<P::Real>,
) -> Option<P::Real> {
    let stiffness = model.element(group.law, index)?.stiffness();
    Some(matrix_weights.weight(stiffness, damping_of(model, group, i)))
}

/// The damping coefficient of element `i` of a group, 0 without one.
#[inline(always)]
pub(super) fn damping_of<P: Geometry, T: Terms<P>>(
    model: &ModelRef<'_, P, T>,
    group: &Group,
    i: usize,
) -> P::Real {
    let damper = group.damper.row().and_then(|row| model.dampers.get(row + i));
    damper.copied().unwrap_or(P::Real::ZERO)
}
