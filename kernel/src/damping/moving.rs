//! The bodies of a damper pass.
//!
//! `(velocities, kick, impulses) => velocities`. A velocity in single precision has no digits for what one
//! joint's dampers take from it, and rounds them off the same way step after step: there the kick and the
//! impulses of a pass are summed apart, and each velocity is rounded once per pass.

use crate::body::BodyState;
use crate::damping::kick::Kick;
use crate::geometry::Geometry;
use crate::pass_sum::PassSum;

/// The bodies' states, and what the pass has given to them.
pub(super) struct Moving<'s, P: Geometry> {
    pub(super) states: &'s mut [BodyState<P>],
    sums: &'s mut [P::PassSum],
}

impl<'s, P: Geometry> Moving<'s, P> {
    /// Begins a pass. Sums begin with the kick, which no velocity has taken then.
    #[inline(always)]
    pub(super) fn begin<K: Kick<P>>(
        states: &'s mut [BodyState<P>],
        sums: &'s mut [P::PassSum],
        kick: &K,
    ) -> Self {
        for (row, sum) in sums.iter_mut().enumerate() {
            if let Some(sum) = sum.sum_mut()
                && let Some(kick) = kick.of(row)
            {
                (sum.linear, sum.angular) = (kick.linear, kick.angular);
            }
        }
        Self { states, sums }
    }

    /// \[m/s\] (world) and \[rad/s\] (body axes) of the body in a row; `None` of the ground.
    #[inline(always)]
    pub(super) fn velocities(&self, row: usize) -> Option<(P::Vector, P::Moment)> {
        let state = self.states.get(row)?;
        let (velocity, spin) = (P::velocity(&state.velocity), P::spin(&state.angular_velocity));
        if !P::PassSum::APART {
            return Some((velocity, spin));
        }
        let sum = self.sums.get(row)?.sum()?;
        Some((velocity + sum.linear, spin + sum.angular))
    }

    /// Adds to the velocity \[m/s\] of a body, world axes.
    #[inline(always)]
    pub(super) fn accelerate(&mut self, row: usize, by: P::Vector) {
        if P::PassSum::APART {
            if let Some(sum) = self.sums.get_mut(row).and_then(PassSum::sum_mut) {
                sum.linear = sum.linear + by;
            }
        } else if let Some(state) = self.states.get_mut(row) {
            P::accelerate(&mut state.velocity, by);
        }
    }

    /// Adds to the angular velocity \[rad/s\] of a body, body axes.
    #[inline(always)]
    pub(super) fn spin_up(&mut self, row: usize, by: P::Moment) {
        if P::PassSum::APART {
            if let Some(sum) = self.sums.get_mut(row).and_then(PassSum::sum_mut) {
                sum.angular = sum.angular + by;
            }
        } else if let Some(state) = self.states.get_mut(row) {
            P::spin_up(&mut state.angular_velocity, by);
        }
    }

    /// Ends a pass: velocities take the sums.
    #[inline(always)]
    pub(super) fn end(self) {
        for (state, sum) in self.states.iter_mut().zip(self.sums) {
            if let Some(sum) = sum.sum() {
                P::accelerate(&mut state.velocity, sum.linear);
                P::spin_up(&mut state.angular_velocity, sum.angular);
            }
        }
    }
}
