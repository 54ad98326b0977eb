//! The data of a damper pass.

use crate::body::BodyState;
use crate::damping::kick::Kick;
use crate::damping::pair::Damper;
use crate::elements::share::Share;
use crate::geometry::Geometry;
use crate::model::{ModelRef, Terms};
use crate::pose::Places;
use crate::real::Real as _;

/// One pass over all dampers.
pub(crate) struct Sweep<'s, P: Geometry, K> {
    /// \[s\] the duration of the dampers' action.
    pub(crate) h: P::Real,
    /// The present pose.
    pub(crate) places: Places<'s, P>,
    /// The torsion springs' revolution counts.
    pub(crate) turns: &'s [i32],
    /// The weight of each damper among those that act on a common force.
    pub(crate) shares: &'s [Share<P::Real>],
    /// The kick just before.
    pub(crate) kick: K,
    /// Whether this pose was evaluated.
    pub(crate) evaluated: bool,
}

impl<P: Geometry, K: Kick<P>> Sweep<'_, P, K> {
    /// Whether all arrays per body have the same length, so that the compiler can drop bounds checks after the first.
    #[inline(always)]
    pub(super) fn is_of<T: Terms<P>>(
        &self,
        model: &ModelRef<'_, P, T>,
        bodies: &[BodyState<P>],
    ) -> bool {
        let count = bodies.len();
        model.bodies.len() == count
            && self.places.frames.len() == count
            && self.kick.count().is_none_or(|kicks| kicks == count)
    }
}

impl<P: Geometry, K> Sweep<'_, P, K> {
    /// A damper with this coefficient and its weight; in descending order the dampers before it follow.
    #[inline(always)]
    pub(super) fn damper<const REVERSE: bool>(
        &self,
        coefficient: P::Real,
        share: &Share<P::Real>,
    ) -> Damper<P::Real> {
        let Share { own, later } = *share;
        let later = if REVERSE { P::Real::ONE - (own + later) } else { later };
        Damper { coefficient, own, later, h: self.h }
    }
}
