//! The plant's end on a PC: for a controller on a microcontroller, or in another program.

use std::time::{Duration, Instant};

use serde::Serialize;
use thiserror::Error;

use crate::device::Device as _;
use crate::host::connection::Connection;
use crate::host::plant::HostPlant;
use crate::host::port::PortError;
use crate::message::Statistics;
use crate::plant_end::PlantEnd;

/// \[bytes\] of a snapshot at most: some 2,000 bodies.
const SNAPSHOT: usize = 1 << 18;
/// How often a line without ticks is looked at.
const GLANCE: Duration = Duration::from_millis(100);

/// How a plant is served.
#[derive(Clone, Copy, Debug)]
pub struct ServeOptions {
    /// From tick to tick of real time; `None` allows lockstep alone.
    pub period: Option<Duration>,
    /// How long nobody may be at the port, or in a session, before it ends; for ever where there is none.
    pub patience: Option<Duration>,
    /// Goes on after a controller has said goodbye.
    pub forever: bool,
}

/// Why a plant is not served.
#[derive(Debug, Error)]
pub enum ServeError {
    /// The port does not open.
    #[error(transparent)]
    Port(#[from] PortError),
    /// Its snapshot does not fit.
    #[error("a snapshot of the scene takes more than {SNAPSHOT} bytes")]
    Large,
    /// Nobody came.
    #[error("no controller within {0} s")]
    Silent(f64),
}

/// A plant that was served.
#[derive(Clone, Debug, PartialEq, Eq, Serialize)]
pub struct Served {
    /// Steps since t = 0.
    pub steps: u64,
    /// The hash of the state.
    pub hash: String,
    /// Whether the plant has not failed.
    pub running: bool,
    /// What was counted.
    pub plant: Statistics,
    /// Frames that were disturbed on purpose: corrupted, dropped, repeated, reordered.
    pub disturbed: [u32; 4],
}

/// Serves a plant at a port until a controller says goodbye.
///
/// # Errors
/// [`ServeError`].
pub fn serve(
    plant: HostPlant,
    connection: &mut Connection,
    options: &ServeOptions,
) -> Result<Served, ServeError> {
    let period = options.period.map_or(0, |period| period.as_micros().min(u32::MAX.into()) as u32);
    let end = PlantEnd::<_, SNAPSHOT>::new(plant, period).ok_or(ServeError::Large)?;
    // Half a megabyte has no place on a stack.
    let mut end = Box::new(end);
    let patience = options.patience.unwrap_or(Duration::MAX / 4);
    let (mut next, mut heard, mut was_open) = (None, Instant::now(), false);
    loop {
        if !connection.is_open() {
            connection.open(patience.min(Duration::from_secs(1 << 30)))?;
            heard = Instant::now();
        }
        let now = Instant::now();
        let until = match (options.period, end.is_open()) {
            (Some(period), true) => *next.get_or_insert(now + period),
            _ => {
                next = None;
                now + GLANCE
            }
        };
        while let Some(byte) = connection.byte_until(until) {
            heard = Instant::now();
            end.receive(byte, connection);
            if end.is_open() != was_open {
                was_open = end.is_open();
                if !was_open && !options.forever {
                    return Ok(Served {
                        steps: end.device().step(),
                        hash: format!("{:016x}", end.device().hash()),
                        running: end.device().running(),
                        plant: *end.statistics(),
                        disturbed: connection.disturbed(),
                    });
                }
                break;
            }
        }
        if let (Some(period), Some(due)) = (options.period, next) {
            let now = Instant::now();
            if now >= due {
                let missed = (now - due).as_nanos() / period.as_nanos().max(1);
                let missed = u32::try_from(missed).unwrap_or(u32::MAX);
                next = Some(due + period * missed.saturating_add(1));
                end.tick(missed, connection);
            }
        }
        if heard.elapsed() > patience {
            return Err(ServeError::Silent(patience.as_secs_f64()));
        }
    }
}
