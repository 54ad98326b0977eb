//! Cases on all cores.
//!
//! `(cases, threads) => outcomes, as they finish`. Each thread takes the next free case; the
//! caller's thread collects the outcomes. If collecting fails, no further case begins.

use std::sync::atomic::{AtomicBool, AtomicUsize, Ordering};
use std::sync::mpsc;
use std::thread;

/// Runs the cases of these numbers in the given number of threads; `take` is called as each finishes.
///
/// # Errors
/// The error of `take`.
pub fn on_all<T: Send, E>(
    cases: &[usize],
    threads: usize,
    run: &(dyn Fn(usize) -> T + Sync),
    take: &mut dyn FnMut(usize, T) -> Result<(), E>,
) -> Result<(), E> {
    let (next, stop) = (AtomicUsize::new(0), AtomicBool::new(false));
    let (sender, receiver) = mpsc::channel();
    thread::scope(|scope| {
        for _ in 0..threads.clamp(1, cases.len().max(1)) {
            let (sender, next, stop) = (sender.clone(), &next, &stop);
            scope.spawn(move || {
                while !stop.load(Ordering::Relaxed) {
                    let Some(case) = cases.get(next.fetch_add(1, Ordering::Relaxed)) else { break };
                    // The receiver is gone if `take` has failed.
                    let _ = sender.send((*case, run(*case)));
                }
            });
        }
        drop(sender);
        let taken = receiver.iter().try_for_each(|(case, done)| take(case, done));
        stop.store(true, Ordering::Relaxed);
        taken
    })
}

#[cfg(test)]
mod tests {
    use std::io;

    use super::*;

    #[test]
    fn every_case_runs_once_and_none_after_a_failure() {
        let cases: Vec<usize> = (0..500).filter(|case| case % 3 == 0).collect();
        for threads in [1, 4, 1000] {
            let run = |case: usize| 2 * case;
            let mut seen = Vec::new();
            let mut take = |case: usize, double: usize| {
                assert_eq!(double, 2 * case);
                seen.push(case);
                Ok::<(), io::Error>(())
            };
            on_all(&cases, threads, &run, &mut take).unwrap();
            seen.sort_unstable();
            assert_eq!(seen, cases);
        }
        let (begun, mut taken) = (AtomicUsize::new(0), 0);
        let run = |_: usize| {
            begun.fetch_add(1, Ordering::Relaxed);
            thread::sleep(std::time::Duration::from_micros(200));
        };
        let mut take = |_, ()| {
            taken += 1;
            if taken < 3 { Ok(()) } else { Err(io::Error::from(io::ErrorKind::StorageFull)) }
        };
        let failed = on_all(&(0..10_000).collect::<Vec<_>>(), 2, &run, &mut take);
        assert_eq!(failed.unwrap_err().kind(), io::ErrorKind::StorageFull);
        assert!(begun.load(Ordering::Relaxed) < 1000);
    }
}
