//! What a run over a line counted and timed.

use std::time::Duration;

use serde::Serialize;

use crate::host::follower::{Difference, Follower};
use crate::message::Statistics;

/// \[s\] times from inputs that were sent to outputs that had them.
#[derive(Clone, Copy, Debug, Default, PartialEq, Serialize)]
pub struct Latency {
    /// How many were timed.
    pub count: usize,
    /// The shortest.
    pub least: f64,
    /// Half are shorter.
    pub p50: f64,
    /// Nine of ten are shorter.
    pub p90: f64,
    /// All but one of a hundred.
    pub p99: f64,
    /// All but one of a thousand.
    pub p999: f64,
    /// The longest.
    pub most: f64,
}

impl Latency {
    /// The percentiles of times, by the nearest rank; zeros without times.
    #[must_use]
    pub fn of(times: &[Duration]) -> Self {
        let mut times: Vec<f64> = times.iter().map(Duration::as_secs_f64).collect();
        times.sort_by(f64::total_cmp);
        let rank = |share: f64| {
            let place = (share * times.len() as f64).ceil() as usize;
            times.get(place.clamp(1, times.len().max(1)) - 1).copied().unwrap_or_default()
        };
        Self {
            count: times.len(),
            least: rank(0.0),
            p50: rank(0.5),
            p90: rank(0.9),
            p99: rank(0.99),
            p999: rank(0.999),
            most: rank(1.0),
        }
    }
}

/// How a run went.
#[derive(Clone, Debug, Default, PartialEq, Serialize)]
pub struct Report {
    /// Steps since t = 0 at the end.
    pub steps: u64,
    /// The hash of the state at the end.
    pub hash: String,
    /// Whether the plant has not failed.
    pub running: bool,
    /// Frames of outputs of which every bit was compared.
    pub compared: u64,
    /// Frames of outputs that differed.
    pub different: u64,
    /// Frames of outputs that could not be compared.
    pub unknown: u64,
    /// Times that the model went on from the plant's state.
    pub synchronised: u32,
    /// Times that the plant went on from the model's state, having lost its own.
    pub restored: u32,
    /// Times that the port was opened again.
    pub reconnected: u32,
    /// The first difference.
    pub first_difference: Option<Difference>,
    /// From inputs to the outputs that had them.
    pub latency: Latency,
    /// What this end has seen.
    pub own: Statistics,
    /// What the plant's end has seen; nothing where it did not say.
    pub plant: Option<Statistics>,
    /// Frames that were disturbed on purpose: corrupted, dropped, repeated, reordered.
    pub disturbed: [u32; 4],
    /// \[s\] how long it took.
    pub seconds: f64,
}

impl Report {
    /// Whether all was compared, or what could not be was followed by a new comparison, and no bit differed.
    #[must_use]
    pub fn is_equal(&self) -> bool {
        self.different == 0 && self.compared > 0
    }

    pub(crate) fn note(&mut self, follower: &Follower) {
        use crate::device::Device as _;
        self.steps = follower.model().step();
        self.hash = format!("{:016x}", follower.model().hash());
        self.running = follower.model().running();
        self.compared = follower.compared;
        self.different = follower.different;
        self.unknown = follower.unknown;
        self.first_difference.clone_from(&follower.first);
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn percentiles_are_of_the_nearest_rank() {
        let times: Vec<Duration> = (1..=1000).rev().map(Duration::from_millis).collect();
        let latency = Latency::of(&times);
        let found =
            [latency.least, latency.p50, latency.p90, latency.p99, latency.p999, latency.most];
        assert_eq!(found, [0.001, 0.5, 0.9, 0.99, 0.999, 1.0]);
        assert_eq!(Latency::of(&[]), Latency::default());
        assert_eq!(Latency::of(&times[..1]).p50, 1.0);
    }
}
