//! Arguments of a C caller: texts, arrays, result buffers, a logger.
//!
//! `pointers => slices, texts`. All dereferencing of a caller's pointers is here; null pointers are detected.

#![allow(unsafe_code, reason = "a caller in C hands over pointers")]

use std::borrow::Cow;
use std::ffi::{CStr, CString, c_char, c_int, c_void};

use crate::component::Refusal;

/// `fmi2CallbackLogger`.
pub type Logger2 = unsafe extern "C" fn(
    environment: *mut c_void,
    instance_name: *const c_char,
    status: c_int,
    category: *const c_char,
    message: *const c_char,
    ...
);
/// `fmi3LogMessageCallback`.
pub type Logger3 = unsafe extern "C" fn(
    environment: *mut c_void,
    status: c_int,
    category: *const c_char,
    message: *const c_char,
);

/// The destination of messages.
#[derive(Clone, Debug)]
pub enum Log {
    /// To an importer of FMI 2; the environment is the caller's own address.
    Two(Option<Logger2>, usize, CString),
    /// To an importer of FMI 3.
    Three(Option<Logger3>, usize),
}

impl Log {
    /// Sends a message to the importer.
    pub fn write(&self, status: c_int, category: &str, message: &str) {
        match self {
            Self::Two(Some(logger), environment, name) => {
                // The message is a printf format, in which `#` starts a reference to a variable.
                let message = c_text(&message.replace('%', "%%").replace('#', "##"));
                let (category, environment) = (c_text(category), *environment);
                let environment = std::ptr::with_exposed_provenance_mut(environment);
                // SAFETY: the importer's logger, with zero-terminated texts and no further argument, which the format
                // does not require.
                unsafe {
                    logger(environment, name.as_ptr(), status, category.as_ptr(), message.as_ptr());
                }
            }
            Self::Three(Some(logger), environment) => {
                let (category, message) = (c_text(category), c_text(message));
                let environment = std::ptr::with_exposed_provenance_mut(*environment);
                // SAFETY: the importer's logger, with zero-terminated texts.
                unsafe { logger(environment, status, category.as_ptr(), message.as_ptr()) }
            }
            Self::Two(None, ..) | Self::Three(None, _) => {}
        }
    }
}

/// A zero-terminated text, cut at an inner zero.
#[must_use]
pub fn c_text(text: &str) -> CString {
    let text = text.split('\0').next().unwrap_or_default();
    CString::new(text).unwrap_or_default()
}

/// A caller's text; `None` if the pointer is null.
///
/// # Safety
/// Null, or a zero-terminated text valid for the returned lifetime.
#[must_use]
pub unsafe fn text<'c>(pointer: *const c_char) -> Option<Cow<'c, str>> {
    // SAFETY: as the caller promises.
    (!pointer.is_null()).then(|| unsafe { CStr::from_ptr(pointer) }.to_string_lossy())
}

/// A caller's array.
///
/// # Errors
/// A null pointer, unless the array is empty.
///
/// # Safety
/// Null, or the given number of values, unchanged for the returned lifetime.
pub unsafe fn slice<'c, T>(pointer: *const T, count: usize) -> Result<&'c [T], Refusal> {
    if count == 0 {
        return Ok(&[]);
    }
    check(pointer, count)?;
    // SAFETY: not null, aligned, not too long, and the rest as the caller promises.
    Ok(unsafe { std::slice::from_raw_parts(pointer, count) })
}

/// Writes values to a caller's array.
///
/// # Errors
/// A null pointer, unless there is nothing to write.
///
/// # Safety
/// Null, or space for the given number of values.
pub unsafe fn write<T: Copy>(pointer: *mut T, values: &[T]) -> Result<(), Refusal> {
    if values.is_empty() {
        return Ok(());
    }
    check(pointer, values.len())?;
    // SAFETY: not null, aligned, and the rest as the caller promises; the values do not overlap.
    unsafe { std::ptr::copy_nonoverlapping(values.as_ptr(), pointer, values.len()) };
    Ok(())
}

/// The value of a caller's pointer.
///
/// # Errors
/// A null pointer.
///
/// # Safety
/// Null, or a value.
pub unsafe fn read<T: Copy>(pointer: *const T) -> Result<T, Refusal> {
    check(pointer, 1)?;
    // SAFETY: not null, aligned, and the rest as the caller promises.
    Ok(unsafe { pointer.read() })
}

fn check<T>(pointer: *const T, count: usize) -> Result<(), Refusal> {
    if pointer.is_null() {
        return Err(Refusal::error("null pointer instead of values"));
    }
    if !pointer.is_aligned() || count > isize::MAX as usize / size_of::<T>().max(1) {
        return Err(Refusal::error("invalid pointer"));
    }
    Ok(())
}
