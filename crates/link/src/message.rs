//! Messages of the protocol between plant and controller.
//!
//! Postcard (a stable binary format) encodes fields and variants in declaration order: changing it requires another
//! [`VERSION`].

use heapless::{String, Vec};
use serde::{Deserialize, Serialize};

/// Version of the protocol, the first byte of every frame.
pub const VERSION: u8 = 1;
/// Maximum number of values in a message.
pub const MAX_VALUES: usize = 64;
/// \[bytes\] maximum piece of a snapshot in a message.
pub const MAX_CHUNK: usize = 128;
/// Maximum number of input changes in an [`Outputs`].
pub const MAX_CHANGES: usize = 4;

/// Values of inputs or sensors, in the order of the [`Identity`]. Double precision represents those of every precision
/// exactly.
pub type Values = Vec<f64, MAX_VALUES>;
/// Values as sent: in single precision if that represents all of them exactly, else in double.
#[allow(clippy::large_enum_variant)] // It lives for one frame.
#[derive(Serialize, Deserialize)]
enum Packed {
    Single(Vec<f32, MAX_VALUES>),
    Double(Values),
}

/// Encoding of values.
mod packed {
    use serde::{Deserialize as _, Deserializer, Serialize as _, Serializer};

    use super::{Packed, Values};

    pub fn serialize<S: Serializer>(values: &Values, serializer: S) -> Result<S::Ok, S::Error> {
        let is_exact = |value: &f64| f64::from(*value as f32) == *value || value.is_nan();
        let packed = if values.iter().all(is_exact) {
            Packed::Single(values.iter().map(|value| *value as f32).collect())
        } else {
            Packed::Double(values.clone())
        };
        packed.serialize(serializer)
    }

    pub fn deserialize<'d, D: Deserializer<'d>>(deserializer: D) -> Result<Values, D::Error> {
        Ok(match Packed::deserialize(deserializer)? {
            Packed::Single(values) => values.into_iter().map(f64::from).collect(),
            Packed::Double(values) => values,
        })
    }
}

/// A name, truncated if it is longer.
pub type Name = String<32>;

/// The header of each message.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq, Serialize, Deserialize)]
pub struct Header {
    /// The session that the controller opened; 0 means that no session is open.
    pub session: u16,
    /// The sender's counter of frames.
    pub sequence: u32,
}

/// A message.
// A frame is decoded once, in place: messages are not stored in bulk.
#[allow(clippy::large_enum_variant)]
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
pub enum Message {
    /// Controller: opens a session.
    Hello(Hello),
    /// Plant: the session is open.
    Welcome(Welcome),
    /// Plant: a message was not accepted; nothing was changed.
    Refused(Refusal),
    /// Controller: values of the inputs.
    Inputs(Inputs),
    /// Plant: values of the sensors.
    Outputs(Outputs),
    /// Controller: asks for a piece of the plant's state. At offset 0 the plant takes a new snapshot.
    Save {
        /// \[bytes\] offset of the piece.
        offset: u32,
    },
    /// Plant: the piece.
    Saved(Chunk),
    /// Controller: a piece of the state from which the plant continues.
    Restore(Chunk),
    /// Plant: number of bytes received; the state is applied when complete.
    Restored {
        /// \[bytes\] that have arrived in order.
        received: u32,
    },
    /// Controller: asks for the plant's statistics.
    Count,
    /// Plant: its statistics.
    Counted(Statistics),
    /// Controller: ends the session. The plant stops and keeps its state.
    Goodbye,
    /// Plant: the session is over.
    Farewell,
}

/// The identity of the plant: two ends communicate only if all of it except the names is equal.
#[derive(Clone, Debug, Default, PartialEq, Serialize, Deserialize)]
pub struct Identity {
    /// Name of the scene.
    pub scene: Name,
    /// Name of the scheme.
    pub scheme: Name,
    /// Name of the precision.
    pub precision: Name,
    /// \[s\] the step.
    pub step: f64,
    /// Version of the snapshots, fingerprints of scheme and model (constants, initial state, precision and step): the
    /// header of a snapshot.
    pub fingerprint: [u8; 14],
    /// Inputs that are not driven by a table of the scene.
    pub inputs: u8,
    /// Numbers of all sensors.
    pub outputs: u8,
}

/// The first difference between two identities.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Serialize, Deserialize)]
pub enum Mismatch {
    /// Another number of inputs.
    Inputs,
    /// Another number of sensor values.
    Outputs,
    /// Another step.
    Step,
    /// Another precision.
    Precision,
    /// Another scheme or damping method.
    Scheme,
    /// Other constants or another initial state.
    Model,
}

impl Mismatch {
    /// The name of the difference.
    #[must_use]
    pub fn name(self) -> &'static str {
        match self {
            Self::Inputs => "number of inputs",
            Self::Outputs => "number of sensor values",
            Self::Step => "step",
            Self::Precision => "precision",
            Self::Scheme => "scheme or damping",
            Self::Model => "model (constants or initial state)",
        }
    }
}

impl Identity {
    /// The first difference from another identity, if any. Names are ignored.
    #[must_use]
    pub fn mismatch(&self, other: &Self) -> Option<Mismatch> {
        // Bytes 0 and 1 are the version, 2 to 5 the scheme, 6 to 13 the model.
        let schemes = [&self.fingerprint[..6], &other.fingerprint[..6]];
        if self.precision != other.precision {
            Some(Mismatch::Precision)
        } else if self.step.to_bits() != other.step.to_bits() {
            Some(Mismatch::Step)
        } else if schemes[0] != schemes[1] {
            Some(Mismatch::Scheme)
        } else if self.inputs != other.inputs {
            Some(Mismatch::Inputs)
        } else if self.outputs != other.outputs {
            Some(Mismatch::Outputs)
        } else {
            (self.fingerprint != other.fingerprint).then_some(Mismatch::Model)
        }
    }
}

/// Who advances the plant.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq, Serialize, Deserialize)]
pub enum Mode {
    /// The controller: the plant takes its steps when inputs arrive and waits for them indefinitely.
    #[default]
    Lockstep,
    /// A timer: the plant takes its steps at each tick, with the newest inputs.
    RealTime,
}

/// What a plant in real time does when no inputs arrive for [`Settings::timeout`] ticks.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq, Serialize, Deserialize)]
pub enum Policy {
    /// The inputs keep their values.
    #[default]
    Hold,
    /// The inputs are set to 0.
    Zero,
    /// The plant stops until inputs arrive; it keeps its state.
    Stop,
}

/// Settings of a session.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Serialize, Deserialize)]
pub struct Settings {
    /// Who advances the plant.
    pub mode: Mode,
    /// Steps per frame of inputs, or per tick.
    pub steps: u32,
    /// Reaction to a late controller.
    pub policy: Policy,
    /// Ticks without inputs after which it is late. At least 1.
    pub timeout: u32,
}

impl Default for Settings {
    fn default() -> Self {
        Self { mode: Mode::Lockstep, steps: 1, policy: Policy::Hold, timeout: 20 }
    }
}

/// Opens a session.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
pub struct Hello {
    /// What the controller expects.
    pub identity: Identity,
    /// The requested settings.
    pub settings: Settings,
}

/// Answers a [`Hello`].
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
pub struct Welcome {
    /// The plant's identity.
    pub identity: Identity,
    /// The plant's present outputs.
    pub outputs: Outputs,
    /// \[µs\] period of ticks; 0 without a timer.
    pub period: u32,
}

/// Why a message was not accepted.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
pub enum Refusal {
    /// No session is open, or another one.
    Session,
    /// The two models differ; with the plant's identity.
    Identity(Mismatch, Identity),
    /// The plant has no timer for [`Mode::RealTime`], or the settings ask for 0 steps.
    Settings,
    /// The inputs belong to another step than the plant's present one, which is given.
    Step(u64),
    /// The number of values is wrong, or a value is not finite in the plant's precision.
    Values,
    /// The plant has failed; it needs a state.
    Failed,
    /// The state was not accepted: damaged, of another model, out of order or larger than the plant's buffer.
    State,
}

/// Values of the inputs.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
pub struct Inputs {
    /// The step of the outputs that they answer; in lockstep the plant's present one.
    pub step: u64,
    /// One per input.
    #[serde(with = "packed")]
    pub values: Values,
}

/// A change of the plant's inputs.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Serialize, Deserialize)]
pub struct Change {
    /// Steps that were done before.
    pub step: u64,
    /// The sequence number of the [`Inputs`] with the values; 0: [`Policy::Zero`] set them.
    pub sequence: u32,
}

/// The outputs of a plant.
#[derive(Clone, Debug, Default, PartialEq, Serialize, Deserialize)]
pub struct Outputs {
    /// Steps since t = 0.
    pub step: u64,
    /// Whether the plant has not failed.
    pub running: bool,
    /// The hash of the state's stored words: equal if all bits are equal.
    #[serde(with = "postcard::fixint::le")]
    pub hash: u64,
    /// The sequence number of the newest [`Inputs`] that arrived.
    pub received: u32,
    /// Values of the sensors; NaN if undefined.
    #[serde(with = "packed")]
    pub values: Values,
    /// The last changes of the inputs, oldest first.
    pub changes: Vec<Change, MAX_CHANGES>,
}

/// A piece of a snapshot.
#[derive(Clone, Debug, Default, PartialEq, Serialize, Deserialize)]
pub struct Chunk {
    /// \[bytes\] size of the whole snapshot.
    pub total: u32,
    /// \[bytes\] offset of the piece.
    pub offset: u32,
    /// The piece.
    pub bytes: Vec<u8, MAX_CHUNK>,
}

/// Statistics of an end since its start.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq, Serialize, Deserialize)]
pub struct Statistics {
    /// Frames sent.
    pub sent: u32,
    /// Frames accepted.
    pub good: u32,
    /// Frames that could not be decoded: too long, not COBS, wrong checksum, not a message.
    pub bad: u32,
    /// Frames of another version of the protocol.
    pub version: u32,
    /// Frames that arrived twice, after a newer one, or too late for their step.
    pub late: u32,
    /// Frames missing between two sequence numbers.
    pub dropped: u32,
    /// Frames without an open session.
    pub foreign: u32,
    /// Frames that were understood and refused.
    pub refused: u32,
    /// Questions answered again because the first answer was lost.
    pub repeated: u32,
    /// Bytes that the receiver of the line lost.
    pub lost: u32,
    /// Number of times the controller was late by more than the timeout.
    pub timeouts: u32,
    /// Ticks of the timer.
    pub ticks: u32,
    /// Ticks that occurred during processing of the previous one.
    pub overruns: u32,
    /// \[cycles\] of the slowest call that stepped; 0 if not counted.
    pub slowest: u32,
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn the_first_difference_is_named() {
        let own = Identity { step: 1e-3, inputs: 1, outputs: 2, ..Identity::default() };
        assert_eq!(own.mismatch(&own), None);
        let with = |change: fn(&mut Identity)| {
            let mut other = own.clone();
            change(&mut other);
            own.mismatch(&other)
        };
        assert_eq!(with(|other| other.scene = Name::try_from("x").unwrap()), None);
        assert_eq!(with(|other| other.step = 2e-3), Some(Mismatch::Step));
        assert_eq!(with(|other| other.inputs = 2), Some(Mismatch::Inputs));
        assert_eq!(with(|other| other.outputs = 3), Some(Mismatch::Outputs));
        assert_eq!(with(|other| other.fingerprint[13] = 1), Some(Mismatch::Model));
        assert_eq!(with(|other| other.fingerprint[2] = 1), Some(Mismatch::Scheme));
        let f32 = |other: &mut Identity| other.precision = Name::try_from("f32").unwrap();
        assert_eq!(with(f32), Some(Mismatch::Precision));
    }
}
