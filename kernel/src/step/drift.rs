//! Drifts of all bodies, with their kicks before and their frames after.
//!
//! `(scale, time) => velocities, poses, frames`. Bodies that tumble move two at a time on a PC, with the bits of one
//! after the other: a processor computes the rotation of one while that of the other waits for the rotation before it.

use crate::body::Body;
use crate::geometry::Geometry;
use crate::model::Terms;
use crate::real::Real as _;
use crate::rotation;
use crate::space::{Linear as _, Space as _};
use crate::step::Workspace;
use crate::step::body::{drift_body, drift_to_frame, kick_body, move_apart};

/// The bodies that move together.
const ABREAST: usize = 2;

impl<P: Geometry, T: Terms<P>> Workspace<'_, '_, P, T> {
    /// Kicks every body by `scale`, if any, moves it freely for `time` \[s\], and updates its frame where `place`. A
    /// model of all kinds has one copy of it for all schemes.
    #[inline(always)]
    pub(super) fn move_all(&mut self, scale: Option<P::Real>, time: P::Real, place: bool) {
        self.cache.fresh = false;
        self.cache.ready = false;
        self.cache.moved |= place;
        if P::Real::ONE_LANE && T::ALL {
            self.move_out_of_line(scale, time, place);
        } else {
            self.move_here(scale, time, place);
        }
    }

    #[inline(never)]
    fn move_out_of_line(&mut self, scale: Option<P::Real>, time: P::Real, place: bool) {
        if self.moves_abreast() {
            self.move_abreast(scale, time, place);
        } else {
            self.move_here(scale, time, place);
        }
    }

    #[inline(always)]
    fn move_here(&mut self, scale: Option<P::Real>, time: P::Real, place: bool) {
        let bodies = self.model.bodies;
        let Some(scale) = scale else {
            let rows = self.bodies.iter_mut().zip(bodies);
            if place {
                for ((state, body), frame) in rows.zip(self.frames.iter_mut()) {
                    drift_to_frame::<P, T>(state, body, frame, time);
                }
            } else {
                for (state, body) in rows {
                    drift_body::<P, T>(state, body, time);
                }
            }
            return;
        };
        let fall = self.fall(scale);
        let rows = self.bodies.iter_mut().zip(bodies);
        let forces = self.wrenches.iter().zip(self.diagonals);
        if place {
            let rows = rows.zip(self.frames.iter_mut()).zip(forces);
            for (((state, body), frame), (wrench, diagonal)) in rows {
                if P::RESTS && scale == P::Real::HALF {
                    let change = fall.change.unwrap_or(P::Vector::ZERO);
                    move_apart::<P, T>(state, body, frame, (wrench, diagonal), change, time);
                } else {
                    kick_body(state, wrench, diagonal, (scale, fall));
                    drift_to_frame::<P, T>(state, body, frame, time);
                }
            }
        } else {
            for ((state, body), (wrench, diagonal)) in rows.zip(forces) {
                kick_body(state, wrench, diagonal, (scale, fall));
                drift_body::<P, T>(state, body, time);
            }
        }
    }

    /// Whether bodies move two at a time: where the first or the last of several takes five rotations, in space and in
    /// floating point. Processors of 32 bits compute in order and would gain nothing.
    #[inline(always)]
    fn moves_abreast(&self) -> bool {
        let may = cfg!(target_pointer_width = "64") && !P::Space::PLANAR && !P::RESTS;
        let [first, .., last] = &*self.bodies else { return false };
        let tumbles = |rate| !rotation::turns_in_plane::<P>(rate);
        may && [first, last].iter().any(|state| tumbles(&state.angular_velocity))
    }

    /// [`Self::move_here`], two bodies at a time.
    fn move_abreast(&mut self, scale: Option<P::Real>, time: P::Real, place: bool) {
        let kick = scale.map(|scale| (scale, self.fall(scale)));
        let (states, last_states) = self.bodies.as_chunks_mut::<ABREAST>();
        let (frames, last_frames) = self.frames.as_chunks_mut::<ABREAST>();
        let (bodies, last_bodies) = self.model.bodies.as_chunks::<ABREAST>();
        let (wrenches, last_wrenches) = self.wrenches.as_chunks::<ABREAST>();
        let (diagonals, last_diagonals) = self.diagonals.as_chunks::<ABREAST>();
        let rows = states.iter_mut().zip(frames).zip(bodies).zip(wrenches.iter().zip(diagonals));
        for (((states, frames), bodies), (wrenches, diagonals)) in rows {
            if let Some(kick) = kick {
                for ((state, wrench), diagonal) in states.iter_mut().zip(wrenches).zip(diagonals) {
                    kick_body(state, wrench, diagonal, kick);
                }
            }
            let driven = T::DRIVEN && bodies.iter().any(Body::is_driven);
            let turned = !driven && rotation::free_rotors(bodies, states, time);
            for (state, body) in states.iter_mut().zip(bodies) {
                if turned {
                    P::advance_position(&mut state.position, &state.velocity, time);
                } else {
                    drift_body::<P, T>(state, body, time);
                }
            }
            if place {
                for (state, frame) in states.iter().zip(frames) {
                    P::set_frame(frame, &state.position, &state.orientation);
                }
            }
        }
        let last = last_states.iter_mut().zip(last_frames).zip(last_bodies);
        for (((state, frame), body), (wrench, diagonal)) in
            last.zip(last_wrenches.iter().zip(last_diagonals))
        {
            if let Some(kick) = kick {
                kick_body(state, wrench, diagonal, kick);
            }
            drift_body::<P, T>(state, body, time);
            if place {
                P::set_frame(frame, &state.position, &state.orientation);
            }
        }
    }
}
