//! Dampers in a scheme: half a step of impulses, with the forces' kick or alone.
//!
//! `(velocities, wrenches, frames) => velocities`.

use crate::damping::{self, HalfKick, KeptKick, NoKick, Sweep};
use crate::forces::{self, Dampers, Wrench};
use crate::geometry::Geometry;
use crate::model::Terms;
use crate::pass_sum::PassSum as _;
use crate::pose::{Places, place_bodies};
use crate::real::Real;
use crate::step::Workspace;

impl<P: Geometry, T: Terms<P>> Workspace<'_, '_, P, T> {
    /// Updates the frames to the present pose where a damper pass needs them and no evaluation has done so.
    #[inline(always)]
    pub fn place_for_sweep(&mut self) {
        if self.has_dampers() {
            place_bodies(self.bodies, self.frames);
        }
    }

    /// Kick and dampers of half a step combined: a half kick, then the dampers in ascending order, which include it. A
    /// strong damper leaves the rate at which it balances the force. Frames and wrenches are those of the present pose,
    /// without dampers.
    #[inline(always)]
    pub fn damped_kick_forward(&mut self) {
        self.kick_and_sweep::<false>();
    }

    /// [`Self::damped_kick_forward`] with the dampers in descending order.
    #[inline(always)]
    pub fn damped_kick_reverse(&mut self) {
        self.kick_and_sweep::<true>();
    }

    #[inline(always)]
    fn kick_and_sweep<const REVERSE: bool>(&mut self) {
        if !(P::PassSum::APART && self.has_dampers()) {
            self.kick(P::Real::HALF);
        }
        let fall = self.fall(P::Real::HALF);
        let (wrenches, diagonals) = (&*self.wrenches, self.diagonals);
        if self.has_dampers() {
            let sweep = Sweep {
                h: P::Real::HALF * self.h,
                places: Places { frames: self.frames, signals: self.signals },
                turns: self.turns,
                shares: self.shares,
                kick: HalfKick { wrenches, diagonals, fall },
                evaluated: self.cache.fresh,
            };
            damping::sweep::<P, T, _, REVERSE>(
                &self.model,
                &sweep,
                (&mut *self.law_states, self.law_shares),
                self.bodies,
                self.sums,
            );
        }
    }

    /// [`Self::damped_kick_forward`] or its reverse, with dampers according to `D`. Joint by joint the kick of a pose
    /// is stored in place of its wrenches, because it is used twice.
    #[inline(always)]
    pub(crate) fn damped_kick<D: Dampers, const REVERSE: bool>(&mut self) {
        if !(D::JOINT_WISE && self.has_dampers()) {
            return self.kick_and_sweep::<REVERSE>();
        }
        let fresh = !self.cache.ready;
        self.keep_kick(fresh);
        let h = P::Real::HALF * self.h;
        let places = Places { frames: &*self.frames, signals: &*self.signals };
        let kick = KeptKick { kicks: &*self.wrenches };
        let evaluated = self.cache.fresh;
        let sweep = Sweep { h, places, turns: &*self.turns, shares: self.shares, kick, evaluated };
        if fresh {
            let modes = (&mut *self.modes, self.cache.stops);
            damping::prepare::<P, T, _>(&self.model, &sweep, self.bodies, modes, REVERSE);
            self.cache.ready = true;
        }
        let modes = (&mut *self.modes, self.cache.stops);
        damping::sweep_joints::<P, T, _, REVERSE>(
            &self.model,
            &sweep,
            modes,
            (&mut *self.law_states, self.law_shares),
            self.bodies,
            self.sums,
        );
    }

    /// A half kick, left to the damper pass where that has separate sums. When `fresh` it is computed from the wrenches
    /// and replaces them.
    #[inline(always)]
    fn keep_kick(&mut self, fresh: bool) {
        let fall = self.fall(P::Real::HALF);
        let rows = self.bodies.iter_mut().zip(self.wrenches.iter_mut());
        if fresh {
            for ((state, wrench), diagonal) in rows.zip(self.diagonals) {
                let kick = diagonal.kick((wrench.force, wrench.torque), P::Real::HALF, fall);
                *wrench = Wrench::new(kick.linear, kick.angular);
                if !P::PassSum::APART {
                    P::accelerate(&mut state.velocity, kick.linear);
                    P::spin_up(&mut state.angular_velocity, kick.angular);
                }
            }
        } else if !P::PassSum::APART {
            for (state, kick) in rows {
                P::accelerate(&mut state.velocity, kick.force);
                P::spin_up(&mut state.angular_velocity, kick.torque);
            }
        }
    }

    /// Replaces the stored kicks of the bodies of inputs, whose wrenches have changed, also in the damping modes.
    #[inline(never)]
    pub(super) fn renew_kicks(&mut self) {
        let fall = self.fall(P::Real::HALF);
        for (row, (wrench, diagonal)) in self.wrenches.iter_mut().zip(self.diagonals).enumerate() {
            if forces::acts_on(&self.model, row) {
                let kick = diagonal.kick((wrench.force, wrench.torque), P::Real::HALF, fall);
                *wrench = Wrench::new(kick.linear, kick.angular);
            }
        }
        let sweep = Sweep {
            h: P::Real::HALF * self.h,
            places: Places { frames: &*self.frames, signals: &*self.signals },
            turns: &*self.turns,
            shares: self.shares,
            kick: KeptKick { kicks: &*self.wrenches },
            evaluated: self.cache.fresh,
        };
        let modes = (&mut *self.modes, self.cache.stops);
        damping::include_inputs::<P, T, _>(&self.model, &sweep, modes);
    }

    /// Half a step of the dampers alone in ascending order; frames are those of the present pose. Where forces act
    /// within the same step, [`Self::damped_kick_forward`] is accurate for a strong damper; this one stops its motion,
    /// and the forces have to start it again.
    #[inline(always)]
    pub fn sweep_forward(&mut self) {
        self.sweep_alone::<false>();
    }

    /// [`Self::sweep_forward`] in descending order.
    #[inline(always)]
    pub fn sweep_reverse(&mut self) {
        self.sweep_alone::<true>();
    }

    #[inline(always)]
    fn sweep_alone<const REVERSE: bool>(&mut self) {
        if self.has_dampers() {
            let sweep = Sweep {
                h: P::Real::HALF * self.h,
                places: Places { frames: self.frames, signals: self.signals },
                turns: self.turns,
                shares: self.shares,
                kick: NoKick,
                evaluated: self.cache.fresh,
            };
            damping::sweep::<P, T, _, REVERSE>(
                &self.model,
                &sweep,
                (&mut *self.law_states, self.law_shares),
                self.bodies,
                self.sums,
            );
        }
    }
}
