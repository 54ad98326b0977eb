//! The state of an instance as bytes.
//!
//! `instance <=> bytes`: parameters that were set, then the kernel's snapshot with bodies, revolution counts, step and
//! inputs; a checksum over all. Little-endian throughout.

use std::collections::BTreeMap;

use dbd_kernel::snapshot::SnapshotError;

use crate::instance::error::InstanceError;
use crate::instance::running::Instance;

/// How the bytes begin; the last is the version.
const MAGIC: &[u8; 5] = b"dbdi\x01";
/// How those of the kernel alone begin.
const KERNEL: &[u8; 4] = b"DBDS";

impl Instance {
    /// The state, including inputs and set parameters, as bytes that an instance of the same scene and settings can
    /// restore on any machine.
    ///
    /// # Errors
    /// [`InstanceError::State`] where it has failed.
    pub fn save(&self) -> Result<Vec<u8>, InstanceError> {
        let snapshot = self.plant.snapshot().map_err(InstanceError::State)?;
        let mut bytes = MAGIC.to_vec();
        bytes.extend((self.set.len() as u32).to_le_bytes());
        for (path, value) in &self.set {
            bytes.extend((path.len() as u32).to_le_bytes());
            bytes.extend(path.as_bytes());
            bytes.extend(value.to_le_bytes());
        }
        bytes.extend(snapshot);
        bytes.extend(crc32fast::hash(&bytes).to_le_bytes());
        Ok(bytes)
    }

    /// Continues from a saved state, bit for bit; clears a failure. Also accepts a snapshot of the kernel, such as a
    /// firmware writes: it contains no parameters, so the present ones must match.
    ///
    /// # Errors
    /// [`InstanceError::State`] where the bytes are damaged or of another scene or other settings; nothing is
    /// changed then.
    pub fn restore(&mut self, bytes: &[u8]) -> Result<(), InstanceError> {
        if bytes.starts_with(KERNEL) {
            return self.plant.restore(bytes).map_err(InstanceError::State);
        }
        let (set, snapshot) = parts(bytes).map_err(InstanceError::State)?;
        if set == self.set {
            return self.plant.restore(snapshot).map_err(InstanceError::State);
        }
        let of_another = |_| InstanceError::State(SnapshotError::Model);
        let other = Self::with(self.blueprint.clone(), self.settings.clone(), set);
        let mut other = other.map_err(of_another)?;
        other.plant.restore(snapshot).map_err(InstanceError::State)?;
        *self = other;
        Ok(())
    }
}

/// The parameters and the kernel's snapshot.
fn parts(bytes: &[u8]) -> Result<(BTreeMap<String, f64>, &[u8]), SnapshotError> {
    let (checked, sum) = bytes.split_last_chunk::<4>().ok_or(SnapshotError::Format)?;
    let rest = checked.strip_prefix(&MAGIC[..4]).ok_or(SnapshotError::Format)?;
    let (version, mut rest) = rest.split_first().ok_or(SnapshotError::Format)?;
    if *version != MAGIC[4] {
        return Err(SnapshotError::Version(u16::from(*version)));
    }
    if crc32fast::hash(checked) != u32::from_le_bytes(*sum) {
        return Err(SnapshotError::Checksum);
    }
    let mut take = |count: usize| {
        let (taken, left) = rest.split_at_checked(count).ok_or(SnapshotError::Format)?;
        rest = left;
        Ok::<_, SnapshotError>(taken)
    };
    let number = |bytes: &[u8]| bytes.try_into().map(u32::from_le_bytes).unwrap_or_default();
    let mut set = BTreeMap::new();
    for _ in 0..number(take(4)?) {
        let length = number(take(4)?) as usize;
        let path = std::str::from_utf8(take(length)?).map_err(|_| SnapshotError::Format)?;
        let value = take(8)?.try_into().map(f64::from_le_bytes).unwrap_or(f64::NAN);
        set.insert(path.to_owned(), value);
    }
    Ok((set, rest))
}
