//! The target `planted`: faults that a campaign must find. It is part of none unless it is named.

use std::time::Duration;

use fastrand::Rng;

use crate::target::{Finding, Reach, Target};

/// Faults at certain bytes.
pub struct PlantedTarget;

/// Inputs, by what they do.
pub const PANIC: &[u8] = b"panic";
/// Arithmetic that wraps.
pub const OVERFLOW: &[u8] = b"overflow";
/// Does not end.
pub const HANG: &[u8] = b"hang";
/// Takes all memory.
pub const MEMORY: &[u8] = b"memory";
/// Ends the process.
pub const ABORT: &[u8] = b"abort";
/// Breaks a promise.
pub const BROKEN: &[u8] = b"broken";

impl Target for PlantedTarget {
    fn name(&self) -> &'static str {
        "planted"
    }

    fn share(&self) -> f64 {
        0.0
    }

    fn block(&self) -> u64 {
        10
    }

    fn input(&self, random: &mut Rng) -> Vec<u8> {
        let mut input = vec![b'.'; random.usize(..20)];
        if random.u8(..12) == 0 {
            let faults = [PANIC, OVERFLOW, HANG, MEMORY, ABORT, BROKEN];
            input.extend_from_slice(faults[random.usize(..faults.len())]);
        }
        input
    }

    fn execute(&self, input: &[u8]) -> Result<Reach, Finding> {
        let has = |fault: &[u8]| input.windows(fault.len()).any(|part| part == fault);
        if has(PANIC) {
            panic!("planted");
        }
        if has(OVERFLOW) {
            // Kept from the compiler, which would see it.
            let most = std::hint::black_box(u8::MAX);
            let _ = std::hint::black_box(most + 1);
        }
        while has(HANG) {
            std::thread::sleep(Duration::from_millis(10));
        }
        if has(MEMORY) {
            let mut all: Vec<Vec<u8>> = Vec::new();
            loop {
                // Not touched: to be out of memory takes no time.
                all.push(std::hint::black_box(Vec::with_capacity(1 << 24)));
            }
        }
        if has(ABORT) {
            std::process::abort();
        }
        Finding::unless(!has(BROKEN), "it is whole", || "planted".into())?;
        Ok(Reach::Taken)
    }
}
