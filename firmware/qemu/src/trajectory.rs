//! A run recorded on the target, for `host-sim compare` to hold against one on a PC.
//!
//! `the four-bar in single precision => golden file on the console`: 0.1 s, a sample every 2 ms. Nothing else is
//! printed, and a line at a time is in memory.

use core::fmt::{self, Write};

use dbd_golden::{Head, RecordError, Recorder, Subject as _};
use dbd_kernel::{Leapfrog, Plant};
use heapless::String;

use crate::models::four_bar::{FOUR_BAR_BODIES, FOUR_BAR_F32, FOUR_BAR_STEP};
use crate::say;

/// Steps from sample to sample.
const EVERY: u64 = 100;
/// Steps of the run.
const STEPS: u64 = 5_000;
/// Bytes of the longest line, that of the columns' names.
const LONGEST: usize = 1024;

/// Prints what is written, line by line.
#[derive(Default)]
struct Console {
    line: String<LONGEST>,
}

impl Write for Console {
    fn write_str(&mut self, text: &str) -> fmt::Result {
        let mut rest = text;
        while let Some((end, next)) = rest.split_once('\n') {
            self.line.push_str(end).map_err(|_| fmt::Error)?;
            say!("{}", self.line.as_str());
            self.line.clear();
            rest = next;
        }
        self.line.push_str(rest).map_err(|_| fmt::Error)
    }
}

/// Records and prints the run; `false` where it did not go well.
// Compiled with the program that calls it, not with the library, which the audit links too.
#[inline]
pub fn run() -> bool {
    let Ok(mut plant) = Plant::new(&FOUR_BAR_F32, Leapfrog, FOUR_BAR_STEP) else { return false };
    let (identity, bodies) = (plant.identity(), &FOUR_BAR_BODIES);
    let head = Head { scene: "four-bar", identity, every: EVERY, bodies, values: &[] };
    let mut record = || -> Result<(), RecordError<&'static str>> {
        let mut recorder = Recorder::begin(Console::default(), &head)?;
        while recorder.look(&plant, &[])? && plant.state().step < STEPS {
            if plant.advance(EVERY).is_err() {
                break;
            }
        }
        recorder.finish().map(drop)
    };
    let recorded = record();
    recorded.is_ok() && plant.status().is_ok()
}
