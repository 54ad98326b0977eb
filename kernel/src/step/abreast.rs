//! Bodies that tumble, two at a time: a processor computes the rotation of one while that of the other waits for the
//! rotation before it.
//!
//! `(kick, time) => velocities, poses, frames`, with the bits of one body after the other.

use crate::body::Body;
use crate::geometry::Geometry;
use crate::model::Terms;
use crate::real::Real as _;
use crate::rotation;
use crate::space::Space as _;
use crate::step::Workspace;
use crate::step::body::{drift_body, kick_body};

/// The bodies that move together.
const ABREAST: usize = 2;

impl<P: Geometry, T: Terms<P>> Workspace<'_, '_, P, T> {
    /// Whether bodies move two at a time: where the first or the last of several takes five rotations, and the model is
    /// sized at run time, in space, in floating point and alone. Processors of 32 bits compute in order and would gain
    /// nothing.
    #[inline(always)]
    pub(super) fn moves_abreast(&self) -> bool {
        let may = cfg!(target_pointer_width = "64")
            && (T::ALL && P::Real::ONE_LANE && !P::Space::PLANAR && !P::RESTS);
        let [first, .., last] = &*self.bodies else { return false };
        let tumbles = |rate| !rotation::turns_in_plane::<P>(rate);
        may && [first, last].iter().any(|state| tumbles(&state.angular_velocity))
    }

    /// Kicks every body by `scale`, if any, moves it freely for `time` \[s\], and updates its frame where `place`. Not
    /// inlined: one copy for all schemes.
    #[inline(never)]
    pub(super) fn move_abreast(&mut self, scale: Option<P::Real>, time: P::Real, place: bool) {
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
