//! The plant's end on a PC, for a controller on a microcontroller or in another program.

use std::time::{Duration, Instant};

use serde::Serialize;
use thiserror::Error;

use crate::device::Device as _;
use crate::host::connection::Connection;
use crate::host::plant::HostPlant;
use crate::host::port::PortError;
use crate::message::Statistics;
use crate::plant_end::PlantEnd;

/// \[bytes\] maximum size of a snapshot: about 2,000 bodies.
const SNAPSHOT: usize = 1 << 18;
/// Polling interval of a line without ticks.
const GLANCE: Duration = Duration::from_millis(100);

/// Options of the plant's end.
#[derive(Clone, Copy, Debug)]
pub struct ServeOptions {
    /// Period of real-time ticks; `None` allows only lockstep.
    pub period: Option<Duration>,
    /// Time limit without a connection or a session; unlimited if not given.
    pub patience: Option<Duration>,
    /// Continues after a controller ends its session.
    pub forever: bool,
}

/// Why a plant cannot be served.
#[derive(Debug, Error)]
pub enum ServeError {
    /// The port does not open.
    #[error(transparent)]
    Port(#[from] PortError),
    /// Its snapshot does not fit.
    #[error("a snapshot of the scene requires more than {SNAPSHOT} bytes")]
    Large,
    /// No controller connected.
    #[error("no controller connected within {0} s")]
    Silent(f64),
}

/// The results of a served plant.
#[derive(Clone, Debug, PartialEq, Eq, Serialize)]
pub struct Served {
    /// Steps since t = 0.
    pub steps: u64,
    /// The hash of the state.
    pub hash: String,
    /// Whether the plant has not failed.
    pub running: bool,
    /// The statistics.
    pub plant: Statistics,
    /// Deliberately disturbed frames: corrupted, dropped, repeated, reordered.
    pub disturbed: [u32; 4],
}

/// Serves a plant at a port until a controller ends its session.
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
    // Half a megabyte is too large for a stack.
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
