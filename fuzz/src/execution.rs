//! One input through one target, a panic caught and named by its place.

use std::cell::RefCell;
use std::panic::{self, AssertUnwindSafe};
use std::sync::Once;

use crate::target::{Finding, Reach, Target};

thread_local! {
    static PANIC: RefCell<Option<Finding>> = const { RefCell::new(None) };
}

/// From now on a panic is told to nobody but [`execute`].
fn listen() {
    static ONCE: Once = Once::new();
    ONCE.call_once(|| {
        panic::set_hook(Box::new(|info| {
            let place = info.location().map_or_else(String::new, ToString::to_string);
            let text = info.payload().downcast_ref::<String>().map(String::as_str);
            let what = text.or(info.payload().downcast_ref().copied()).unwrap_or("a panic");
            // Line and column of the same panic are the same, what it says of numbers is not.
            let finding =
                Finding { key: format!("panic at {place}"), message: format!("{place}: {what}") };
            PANIC.with(|last| *last.borrow_mut() = Some(finding));
        }));
    });
}

/// Runs a target on an input.
///
/// # Errors
/// What it finds; a panic is a finding.
pub fn execute(target: &dyn Target, input: &[u8]) -> Result<Reach, Finding> {
    listen();
    // A target keeps nothing between two inputs.
    let outcome = panic::catch_unwind(AssertUnwindSafe(|| target.execute(input)));
    outcome.unwrap_or_else(|_| {
        let known = PANIC.with(|last| last.borrow_mut().take());
        Err(known.unwrap_or_else(|| Finding::new("panic", "without a word")))
    })
}
