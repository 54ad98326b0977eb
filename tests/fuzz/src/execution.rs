//! One input through one target: a panic is caught and named by its place, the time is watched.

use std::cell::RefCell;
use std::panic::{self, AssertUnwindSafe};
use std::sync::Once;
use std::sync::atomic::{AtomicU64, Ordering};
use std::time::Duration;

use crate::target::{Finding, Reach, Target};

/// The exit code of a worker whose input took too long.
pub const TOO_LONG: i32 = 3;

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

/// Counts inputs begun and inputs done with: it is odd while one runs.
static COUNT: AtomicU64 = AtomicU64::new(0);

/// Ends this process where an input takes longer than `limit`.
///
/// It counts its own looks and not the clock: where the machine halts the process, it halts both.
pub fn watch(limit: Duration) {
    /// Looks within the limit.
    const LOOKS: u32 = 20;
    std::thread::spawn(move || {
        let mut last = (COUNT.load(Ordering::Relaxed), 0);
        loop {
            std::thread::sleep(limit / LOOKS);
            let now = COUNT.load(Ordering::Relaxed);
            last = (now, if now == last.0 && now % 2 == 1 { last.1 + 1 } else { 0 });
            if last.1 > LOOKS {
                eprintln!("an input takes longer than {limit:?}");
                std::process::exit(TOO_LONG);
            }
        }
    });
}

/// Runs a target on an input.
///
/// # Errors
/// What it finds; a panic is a finding.
pub fn execute(target: &dyn Target, input: &[u8]) -> Result<Reach, Finding> {
    listen();
    // A target keeps nothing between two inputs.
    COUNT.fetch_add(1, Ordering::Relaxed);
    let outcome = panic::catch_unwind(AssertUnwindSafe(|| target.execute(input)));
    COUNT.fetch_add(1, Ordering::Relaxed);
    outcome.unwrap_or_else(|_| {
        let known = PANIC.with(|last| last.borrow_mut().take());
        Err(known.unwrap_or_else(|| Finding::new("panic", "without a word")))
    })
}
