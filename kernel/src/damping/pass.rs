//! What a pass over dampers knows.

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
    /// \[s\] for how long they act.
    pub(crate) h: P::Real,
    /// The present pose.
    pub(crate) places: Places<'s, P>,
    /// The torsion springs' turn counts.
    pub(crate) turns: &'s [i32],
    /// What each bears of what it bears together with others.
    pub(crate) shares: &'s [Share<P::Real>],
    /// The kick just before.
    pub(crate) kick: K,
}

impl<P: Geometry, K: Kick<P>> Sweep<'_, P, K> {
    /// Whether all that is kept per body is of as many: a row of one is then a row of the others, which
    /// a compiler does not look up again.
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
    /// A damper of this coefficient, with its share; in descending order those before it follow.
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
