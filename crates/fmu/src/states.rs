//! States by importer handle.
//!
//! `(component, handle) <=> bytes`: the common part of FMI 2 and 3.

#![allow(unsafe_code, reason = "a caller in C hands over pointers")]

use std::ffi::c_void;

use crate::calls::{Held, pointer};
use crate::component::Refusal;
use crate::foreign::{read, slice, write};

/// `…GetFMUState`.
///
/// # Safety
/// A null pointer, or a handle variable that contains a handle or null.
pub(crate) unsafe fn get_state(held: &mut Held, state: *mut *mut c_void) -> Result<(), Refusal> {
    // SAFETY: as the caller promises.
    let asked = unsafe { read(state) }?;
    let kept = held.keep(asked.addr())?;
    // SAFETY: likewise.
    unsafe { write(state, &[pointer(kept)]) }
}

/// `…FreeFMUState`; null is ignored.
///
/// # Safety
/// As [`get_state`].
pub(crate) unsafe fn free_state(held: &mut Held, state: *mut *mut c_void) -> Result<(), Refusal> {
    if state.is_null() {
        return Ok(());
    }
    // SAFETY: as the caller promises.
    let handle = unsafe { read(state) }?;
    if !handle.is_null() {
        held.state(handle.addr())?;
        held.states.remove(&handle.addr());
    }
    // SAFETY: likewise.
    unsafe { write(state, &[std::ptr::null_mut()]) }
}

/// `…SerializeFMUState`.
///
/// # Safety
/// The buffer is null or of the given size.
pub(crate) unsafe fn serialize(
    held: &mut Held,
    state: *mut c_void,
    bytes: *mut u8,
    size: usize,
) -> Result<(), Refusal> {
    let state = held.state(state.addr())?;
    if size < state.len() {
        return Err(Refusal::Error(format!(
            "{size} bytes given for a state of {} bytes",
            state.len()
        )));
    }
    // SAFETY: as the caller promises.
    unsafe { write(bytes, state) }
}

/// `…DeserializeFMUState`.
///
/// # Safety
/// The buffer is null or of the given size; the state as in [`get_state`].
pub(crate) unsafe fn deserialize(
    held: &mut Held,
    bytes: *const u8,
    size: usize,
    state: *mut *mut c_void,
) -> Result<(), Refusal> {
    // SAFETY: as the caller promises.
    let kept = held.take(unsafe { slice(bytes, size) }?)?;
    // SAFETY: likewise.
    unsafe { write(state, &[pointer(kept)]) }
}
