//! The state of a component as bytes.
//!
//! `component <=> bytes`: a header, the token, mode, start time, set parameters, then the instance's bytes; a checksum
//! over all. Little-endian throughout.

use std::collections::BTreeMap;

use crate::component::{Component, Mode, Refusal};
use crate::description::Role;
use crate::token::hash;

/// The first bytes; the last of them is the version.
const MAGIC: &[u8; 5] = b"dbdf\x01";
/// Modes by number in a state.
const MODES: [Mode; 4] = [Mode::Instantiated, Mode::Initializing, Mode::Stepping, Mode::Terminated];

/// The contents of a state.
struct Parts<'b> {
    mode: Mode,
    is_waiting: bool,
    start_time: f64,
    set: BTreeMap<u32, f64>,
    instance: &'b [u8],
}

impl Component {
    /// The state as bytes.
    ///
    /// # Errors
    /// If the plant has failed.
    pub fn save(&self) -> Result<Vec<u8>, Refusal> {
        let mut bytes = MAGIC.to_vec();
        bytes.extend(self.token.as_bytes());
        let mode = MODES.iter().position(|mode| *mode == self.mode).unwrap_or_default();
        bytes.extend([mode as u8, u8::from(self.is_waiting)]);
        bytes.extend(self.start_time.to_le_bytes());
        bytes.extend((self.set.len() as u32).to_le_bytes());
        for (reference, value) in &self.set {
            bytes.extend(reference.to_le_bytes());
            bytes.extend(value.to_le_bytes());
        }
        bytes.extend(self.instance.save()?);
        bytes.extend(hash(&bytes).to_le_bytes());
        Ok(bytes)
    }

    /// Continues from a state, bit for bit; a failure is cleared.
    ///
    /// # Errors
    /// If the bytes are not a state of this FMU; nothing is changed.
    pub fn restore(&mut self, bytes: &[u8]) -> Result<(), Refusal> {
        let Parts { mode, is_waiting, start_time, set, instance } = self.parts(bytes)?;
        self.instance.restore(instance)?;
        (self.mode, self.is_waiting, self.start_time, self.set) =
            (mode, is_waiting, start_time, set);
        Ok(self.note_parameters()?)
    }

    /// Whether bytes are a state of this FMU.
    ///
    /// # Errors
    /// If they are not.
    pub fn check(&self, bytes: &[u8]) -> Result<(), Refusal> {
        self.parts(bytes).map(drop)
    }

    fn parts<'b>(&self, bytes: &'b [u8]) -> Result<Parts<'b>, Refusal> {
        let refused = |what: &str| Refusal::Error(format!("cannot restore the state: {what}"));
        let damaged = || refused("it is damaged");
        let (checked, sum) = bytes.split_last_chunk::<8>().ok_or_else(damaged)?;
        if hash(checked) != u64::from_le_bytes(*sum) {
            return Err(damaged());
        }
        let rest = checked.strip_prefix(MAGIC).ok_or_else(damaged)?;
        let rest = rest.strip_prefix(self.token.as_bytes());
        let mut rest = rest.ok_or_else(|| refused("it belongs to another FMU"))?;
        let mut take = |count: usize| {
            let (taken, left) = rest.split_at_checked(count).ok_or_else(damaged)?;
            rest = left;
            Ok::<_, Refusal>(taken)
        };
        let whole = |bytes: &[u8]| bytes.try_into().map(u32::from_le_bytes).unwrap_or_default();
        let real = |bytes: &[u8]| bytes.try_into().map(f64::from_le_bytes).unwrap_or(f64::NAN);
        let head = take(2)?;
        let mode = *MODES.get(usize::from(head[0])).ok_or_else(damaged)?;
        let is_waiting = head[1] != 0;
        let start_time = real(take(8)?);
        let mut set = BTreeMap::new();
        for _ in 0..whole(take(4)?) {
            let reference = whole(take(4)?);
            let variable = self.description.variables.get(reference as usize);
            if !matches!(variable.map(|variable| &variable.role), Some(Role::Parameter(_))) {
                return Err(damaged());
            }
            set.insert(reference, real(take(8)?));
        }
        Ok(Parts { mode, is_waiting, start_time, set, instance: rest })
    }
}
