//! Statistics and timing of a run over a line.

use std::time::Duration;

use serde::Serialize;

use crate::host::follower::{Difference, Follower};
use crate::message::Statistics;

/// \[s\] times from sending inputs to receiving the corresponding outputs.
#[derive(Clone, Copy, Debug, Default, PartialEq, Serialize)]
pub struct Latency {
    /// Number of times.
    pub count: usize,
    /// The shortest.
    pub least: f64,
    /// The median.
    pub p50: f64,
    /// The 90th percentile.
    pub p90: f64,
    /// The 99th percentile.
    pub p99: f64,
    /// The 99.9th percentile.
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

/// The results of a run.
#[derive(Clone, Debug, Default, PartialEq, Serialize)]
pub struct Report {
    /// Steps since t = 0 at the end.
    pub steps: u64,
    /// The hash of the state at the end.
    pub hash: String,
    /// Whether the plant has not failed.
    pub running: bool,
    /// Frames of outputs compared completely.
    pub compared: u64,
    /// Frames of outputs that differed.
    pub different: u64,
    /// Frames of outputs that could not be compared.
    pub unknown: u64,
    /// Number of times the model took the plant's state.
    pub synchronised: u32,
    /// Number of times the plant was restored to the model's state.
    pub restored: u32,
    /// Number of times the port was reopened.
    pub reconnected: u32,
    /// The first difference.
    pub first_difference: Option<Difference>,
    /// Round-trip times of inputs.
    pub latency: Latency,
    /// Statistics of this end.
    pub own: Statistics,
    /// Statistics of the plant's end, if received.
    pub plant: Option<Statistics>,
    /// Deliberately disturbed frames: corrupted, dropped, repeated, reordered.
    pub disturbed: [u32; 4],
    /// \[s\] duration.
    pub seconds: f64,
}

impl Report {
    /// Whether no bit differed and each frame that could not be compared was followed by one that was.
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
