//! The state of the bodies during a damper pass.
//!
//! `(velocities, kick, impulses) => velocities`. A velocity in single precision cannot resolve the impulse of one
//! joint's dampers and rounds it in the same direction step after step: there the kick and the impulses of a pass are
//! summed separately, and each velocity is rounded once per pass.

use crate::body::BodyState;
use crate::damping::kick::Kick;
use crate::geometry::Geometry;
use crate::laws::Body;
use crate::pass_sum::PassSum;

/// The bodies' states and the sums of the pass.
pub(super) struct Moving<'s, P: Geometry> {
    pub(super) states: &'s mut [BodyState<P>],
    sums: &'s mut [P::PassSum],
}

impl<'s, P: Geometry> Moving<'s, P> {
    /// Begins a pass. The sums begin with the kick, which the velocities do not include yet.
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

    /// The body in a row for a law, with its frame; `None` for the ground.
    #[inline(always)]
    pub(super) fn body<'b>(&'b self, row: usize, frame: &'b P::Frame) -> Option<Body<'b, P>> {
        let state = self.states.get(row)?;
        let sum = if P::PassSum::APART { self.sums.get(row)?.sum() } else { None };
        Some(Body { frame, state, sum })
    }

    /// \[m/s\] (world) and \[rad/s\] (body axes) of the body in a row; `None` for the ground.
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

    /// Ends a pass: adds the sums to the velocities.
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
