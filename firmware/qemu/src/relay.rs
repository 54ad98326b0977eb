//! A run that one machine begins and another ends: the state travels as a snapshot.
//!
//! `whole: models => lines; begin: models => files; end: files => lines`. The files are
//! `out/relay-0` and so on, one per model, in the order of
//! [`for_each_relayed`]. The line `relay SCENE SCHEME PRECISION
//! STEPS HASH` must be the same for any assignment of the halves.

use core::ffi::CStr;

use dbd_kernel::model::ModelOwner;
use dbd_kernel::{Geometry, InputIndex, Plant, Scheme};

use crate::console::{load, save};
use crate::models::{Shipped, Visitor, for_each_relayed};
use crate::say;

/// The part of the runs that is done here.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Part {
    /// All of them.
    Whole,
    /// The first half of the steps, then the snapshots.
    Begin,
    /// The other half, from the snapshots.
    End,
}

/// The input that is held over the run, where the model has one that no table drives.
const CALLERS: InputIndex = InputIndex(0);
/// \[N\] its value.
const HELD: f64 = 0.25;
/// Bytes of the largest snapshot.
const LARGEST: usize = 4096;

/// Does a part of all runs; `false` where one did not go well.
// Compiled with the program that calls it, not with the library, which the audit links too.
#[inline]
pub fn run(part: Part) -> bool {
    let mut relay = Relay { part, number: 0, well: true };
    for_each_relayed(&mut relay);
    relay.well
}

struct Relay {
    part: Part,
    number: u8,
    well: bool,
}

impl Visitor for Relay {
    fn visit<M: ModelOwner, S: Scheme>(&mut self, shipped: Shipped<M, S>) {
        let outcome = self.relay(&shipped);
        self.number += 1;
        if let Err(problem) = outcome {
            let precision = M::Precision::NAME;
            say!("relay {} {} {} failed: {}", shipped.scene, S::NAME, precision, problem);
            self.well = false;
        }
    }
}

impl Relay {
    fn relay<M: ModelOwner, S: Scheme>(&self, shipped: &Shipped<M, S>) -> Result<(), &'static str> {
        let Shipped { scene, model, scheme, step, steps, .. } = *shipped;
        let mut name = *b"out/relay-0\0";
        name[10] += self.number;
        let path = CStr::from_bytes_with_nul(&name).map_err(|_| "no name")?;
        let mut buffer = [0; LARGEST];
        let mut plant = Plant::new(model, scheme, step).map_err(|_| "its step")?;
        if self.part != Part::End {
            // Held inputs are part of the state; a model without such an input returns an error.
            let _ = plant.set_input(CALLERS, HELD);
        }
        if self.part == Part::End {
            let bytes = load(path, &mut buffer).ok_or("no snapshot")?;
            plant.restore(bytes).map_err(|_| "snapshot of another model")?;
            if plant.state().step != steps / 2 {
                return Err("snapshot of another time");
            }
        }
        let until = if self.part == Part::Begin { steps / 2 } else { steps };
        if plant.advance(until - plant.state().step).is_err() {
            return Err("it diverged");
        }
        if self.part == Part::Begin {
            let size = plant.snapshot(&mut buffer).map_err(|_| "snapshot too large")?;
            return if save(path, &buffer[..size]) { Ok(()) } else { Err("no file") };
        }
        let (precision, hash) = (M::Precision::NAME, plant.hash());
        say!("relay {} {} {} {} {:016x}", scene, S::NAME, precision, steps, hash);
        Ok(())
    }
}
