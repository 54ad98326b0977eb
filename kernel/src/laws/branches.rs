//! The branches of a law during an evaluation.

use crate::force_pair::{Wrench, apply};
use crate::geometry::Geometry;
use crate::index::BodyIndex;
use crate::laws::branch::{Branch, MAX_BRANCHES};
use crate::laws::end::Seen;
use crate::laws::interaction::Interaction;
use crate::real::Real as _;

/// The branches of a law at a pose.
pub struct Branches<P: Geometry>([Option<Branch<P>>; MAX_BRANCHES]);

impl<P: Geometry> Branches<P> {
    /// Those of a law.
    #[inline(always)]
    pub(super) fn of<T: Interaction<P>>(law: &T, seen: &Seen<'_, P>, state: &T::State) -> Self {
        let mut all = [None; MAX_BRANCHES];
        if T::BRANCHES > 0 {
            let mut places = all.iter_mut();
            law.branches(seen, state, &mut |branch| {
                if let Some(place) = places.next() {
                    *place = Some(branch);
                }
            });
        }
        Self(all)
    }

    /// In order, the present ones first.
    #[inline(always)]
    pub(super) fn all(&self) -> &[Option<Branch<P>>] {
        &self.0
    }

    /// In order.
    #[inline(always)]
    pub fn iter(&self) -> impl Iterator<Item = &Branch<P>> {
        self.0.iter().flatten()
    }

    /// \[m/s, rad/s\] the rate along all of them.
    #[inline(always)]
    pub(super) fn rate(&self, seen: &Seen<'_, P>) -> P::Real {
        let mut rate = P::Real::ZERO;
        for branch in self.iter() {
            if let Some(seen) = seen.between(branch.bodies) {
                rate = rate + seen.rate(&branch.direction);
            }
        }
        rate
    }

    /// Adds to the tension.
    #[inline(always)]
    pub(super) fn pull(&mut self, tension: P::Real) {
        for branch in self.0.iter_mut().flatten() {
            branch.tension = branch.tension + tension;
        }
    }

    /// Adds their forces to their bodies.
    #[inline(always)]
    pub(super) fn apply(&self, seen: &Seen<'_, P>, wrenches: &mut [Wrench<P::Space>]) {
        for branch in self.iter() {
            if let Some(seen) = seen.between(branch.bodies) {
                let [a, b] = branch.bodies.map(BodyIndex::row);
                apply(wrenches, a, b, &seen.pull(&branch.direction, branch.tension));
            }
        }
    }
}
