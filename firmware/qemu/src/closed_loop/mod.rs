//! Controller and plant in one image, tick by tick.
//!
//! `(loop, pace, ticks) => lines "loop NAME TICK CHAIN", "last NAME …", "pace NAME …"`. In a tick the plant
//! takes its steps, then the controller measures and acts. The chain is a hash of the plant's state
//! and of what the controller did after every tick, so two machines that print one chain did the
//! same all along. The pace is a board's timer or none: it changes no bit, for the plant's time is its
//! steps. A late tick is reported but not compensated: the plant falls behind real time.

mod cart_pendulum;
mod delta;
mod pace;
mod trace;

use dbd_node::Fault;
use dbd_node::fault::WiringError;

pub use cart_pendulum::{CartPendulum, balanced};
pub use delta::Delta;
pub use pace::{Pace, Unpaced};
pub use trace::{KEPT, Sample};

use crate::controllers::ControlError;
use crate::{log, say};
use trace::Trace;

/// Why a loop ended early.
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum LoopError {
    /// A part is wired to nothing.
    Wiring(WiringError),
    /// The plant or a part has failed.
    Plant(Fault),
    /// The controller could not see or drive.
    Control(ControlError),
}

/// A plant with a controller, set up and ticked.
pub trait Loop {
    /// The scene's name.
    const NAME: &'static str;
    /// \[µs\] of the plant's time in a tick.
    const TICK: u32;
    /// \[µs\] of real time that a tick is given: [`Self::TICK`] where the board is fast enough, else so much
    /// that it is.
    const PERIOD: u32;

    /// Sets up and calls `ticks` with what makes one tick: the sample, and the hash of the state.
    ///
    /// # Errors
    /// [`LoopError::Wiring`], and what `ticks` returns.
    fn with(
        &self,
        ticks: impl FnOnce(
            &mut dyn FnMut() -> Result<(Sample, u64), LoopError>,
        ) -> Result<(), LoopError>,
    ) -> Result<(), LoopError>;
}

/// Runs a loop and prints its trace; returns whether it succeeded. Overruns are not an error here: the caller
/// chooses the rate.
pub fn run<L: Loop>(the_loop: &L, ticks: u32, pace: &mut impl Pace) -> bool {
    let mut trace = Trace::new(ticks);
    let (mut missed, mut busy, mut busiest) = (0_u32, 0_u64, (0_u32, 0_u32));
    log!(info, "{}: {} ticks of {} us", L::NAME, ticks, L::TICK);
    let ended = the_loop.with(|tick| {
        pace.start();
        for number in 1..=ticks {
            let late = pace.wait();
            if late > 0 && missed == 0 {
                log!(warn, "{}: tick {} is late by {} periods", L::NAME, number, late);
            }
            missed = missed.saturating_add(late);
            let (sample, hash) = tick()?;
            trace.push(number, sample, hash);
            let passed = pace.passed();
            busy += u64::from(passed);
            busiest = busiest.max((passed, number));
        }
        // Ticks that came due during the last tick.
        missed = missed.saturating_add(pace.ahead());
        Ok(())
    });
    trace.print(L::NAME);
    let mean = (busy / u64::from(ticks.max(1))) as u32;
    let (most, number) = busiest;
    say!(
        "pace {} overruns {} busy {} us of {}, {} in tick {}",
        L::NAME,
        missed,
        mean,
        pace.period(),
        most,
        number
    );
    match ended {
        Ok(()) => true,
        Err(error) => {
            tell(L::NAME, error);
            false
        }
    }
}

/// One line of why a loop ended.
#[cfg(target_os = "none")]
fn tell(name: &str, error: LoopError) {
    match error {
        LoopError::Wiring(error) => {
            defmt::error!("{}: {}", name, defmt::Display2Format(&error));
        }
        LoopError::Plant(fault) => {
            defmt::error!("{}: {}", name, defmt::Display2Format(&fault));
        }
        LoopError::Control(error) => {
            defmt::error!("{}: {}", name, defmt::Debug2Format(&error));
        }
    }
}

/// One line of why a loop ended.
#[cfg(not(target_os = "none"))]
fn tell(name: &str, error: LoopError) {
    match error {
        LoopError::Wiring(error) => log!(error, "{name}: {error}"),
        LoopError::Plant(fault) => log!(error, "{name}: {fault}"),
        LoopError::Control(error) => log!(error, "{name}: {error:?}"),
    }
}
