//! Progress messages for long work.
//!
//! `(title, action) => lines "… title: N s" on standard error, the action's outcome`. Of work within
//! work only the innermost is reported.

use std::cell::RefCell;
use std::sync::Arc;
use std::sync::atomic::{AtomicBool, Ordering};
use std::sync::mpsc::{RecvTimeoutError, channel};
use std::time::{Duration, Instant};

/// How often.
const STILL: Duration = Duration::from_secs(30);

thread_local! {
    /// Whether the present work is silent, because other work within it prints progress.
    static SILENT: RefCell<Arc<AtomicBool>> = RefCell::default();
}

/// Does the work of this title.
pub fn attended<T>(title: &str, action: impl FnOnce() -> T) -> T {
    attended_every(STILL, &|seconds| eprintln!("    … {title}: {seconds:.0} s"), action)
}

fn attended_every<T>(
    interval: Duration,
    say: &(impl Fn(f64) + Sync),
    action: impl FnOnce() -> T,
) -> T {
    let (start, silent) = (Instant::now(), Arc::<AtomicBool>::default());
    let outer = SILENT.replace(Arc::clone(&silent));
    outer.store(true, Ordering::Relaxed);
    let outcome = std::thread::scope(|scope| {
        let (end, ended) = channel::<()>();
        scope.spawn(move || {
            while ended.recv_timeout(interval) == Err(RecvTimeoutError::Timeout) {
                if !silent.load(Ordering::Relaxed) {
                    say(start.elapsed().as_secs_f64());
                }
            }
        });
        let outcome = action();
        drop(end);
        outcome
    });
    outer.store(false, Ordering::Relaxed);
    SILENT.set(outer);
    outcome
}

#[cfg(test)]
mod tests {
    use super::*;
    use std::sync::atomic::AtomicUsize;
    use std::thread::sleep;

    #[test]
    fn the_innermost_work_is_told_of() {
        let [outer, inner] = [const { AtomicUsize::new(0) }; 2];
        let count = |counter: &AtomicUsize| counter.load(Ordering::Relaxed);
        let interval = Duration::from_millis(20);
        let tell_outer = |_| _ = outer.fetch_add(1, Ordering::Relaxed);
        let tell_inner = |_| _ = inner.fetch_add(1, Ordering::Relaxed);
        let known = attended_every(interval, &tell_outer, || {
            let before = attended_every(interval, &tell_inner, || {
                sleep(Duration::from_millis(200));
                count(&outer)
            });
            sleep(Duration::from_millis(200));
            before
        });
        // Silent within, and reported again after it.
        assert_eq!(known, 0);
        assert!(count(&inner) > 0 && count(&outer) > 0);
    }
}
