//! Functions exported to a page: one desk and texts in shared memory.
//!
//! `dbd_reserve(length)` makes room for a request, `dbd_ask(length)` answers it; `dbd_advance(steps)` steps;
//! `dbd_frame()` returns the address of the present frame. Addresses are valid until the next call.

#![allow(unsafe_code, reason = "names that a page finds")]

use std::cell::RefCell;

use crate::ask::Desk;

/// State kept between calls.
#[derive(Default)]
struct Kept {
    desk: Desk,
    request: Vec<u8>,
    answer: String,
}

thread_local! {
    static KEPT: RefCell<Kept> = RefCell::default();
}

/// Address for a request of the given number of bytes.
#[unsafe(no_mangle)]
pub extern "C" fn dbd_reserve(length: usize) -> *mut u8 {
    KEPT.with_borrow_mut(|kept| {
        kept.request.clear();
        kept.request.resize(length, 0);
        kept.request.as_mut_ptr()
    })
}

/// Answers the request in the given number of bytes there; returns the length of the answer in bytes.
#[unsafe(no_mangle)]
pub extern "C" fn dbd_ask(length: usize) -> usize {
    KEPT.with_borrow_mut(|kept| {
        let request = kept.request.get(..length).unwrap_or_default();
        kept.answer = kept.desk.ask(&String::from_utf8_lossy(request));
        kept.answer.len()
    })
}

/// Where the answer lies.
#[unsafe(no_mangle)]
pub extern "C" fn dbd_answer() -> *const u8 {
    KEPT.with_borrow(|kept| kept.answer.as_ptr())
}

/// Advances by the given number of steps; returns the number done.
#[unsafe(no_mangle)]
pub extern "C" fn dbd_advance(steps: u32) -> u32 {
    KEPT.with_borrow_mut(|kept| kept.desk.advance(u64::from(steps)) as u32)
}

/// Where the present frame lies.
#[unsafe(no_mangle)]
pub extern "C" fn dbd_frame() -> *const f64 {
    KEPT.with_borrow_mut(|kept| kept.desk.frame().as_ptr())
}
