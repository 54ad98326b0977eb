//! Snapshots: a plant's state as bytes, restored exactly.
//!
//! `plant => bytes => plant`. Little-endian: magic `DBDS`, version (u16), fingerprint of the scheme (u32), fingerprint
//! of model, precision and step (u64), the state's words in the order of its hash, then two words per input, then, for
//! a scheme with a memory of the last step, whether it is valid and its words per body, then the CRC-32 (IEEE 802.3,
//! reflected) of all before it. A plant of the same model, scheme and step, on any target, continues with the same
//! bits. Invalid bytes are refused and change nothing.

use core::ops::Deref;

use crate::fingerprint::scheme_fingerprint;
use crate::model::ModelOwner;
use crate::plant::Plant;
use crate::plant::base::Base;
use crate::schemes::Scheme;
use crate::state::State;
use crate::words::{Finite, Word, WordSource, WordVisitor, Words};

const MAGIC: [u8; 4] = *b"DBDS";
/// The version of the layout; others are refused.
const VERSION: u16 = 2;
/// Magic, version, fingerprints of scheme and model.
const HEADER: usize = 18;
const CHECKSUM: usize = 4;

/// Why a snapshot was not written, or refused.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
#[cfg_attr(all(feature = "defmt", target_os = "none"), derive(defmt::Format))]
#[non_exhaustive]
pub enum SnapshotError {
    /// The buffer is shorter than the given number of bytes.
    Buffer(usize),
    /// The plant has failed; its state is not saved.
    Failed,
    /// The bytes are not a snapshot, or an incomplete one.
    Format,
    /// The layout is that of another version.
    Version(u16),
    /// The checksum does not match.
    Checksum,
    /// It belongs to another model, precision or step.
    Model,
    /// It belongs to another scheme, damping method, number of Newton iterations or ρ∞.
    Scheme,
    /// It contains a number that is not finite.
    NotFinite,
}

impl core::fmt::Display for SnapshotError {
    fn fmt(&self, f: &mut core::fmt::Formatter<'_>) -> core::fmt::Result {
        match self {
            SnapshotError::Buffer(size) => {
                write!(f, "buffer too small: the snapshot needs {size} bytes")
            }
            SnapshotError::Failed => f.write_str("the plant has failed; its state cannot be saved"),
            SnapshotError::Format => f.write_str("not a snapshot, or an incomplete one"),
            SnapshotError::Version(found) => {
                write!(f, "unsupported snapshot version {found}, expected {VERSION}")
            }
            SnapshotError::Checksum => f.write_str("checksum mismatch"),
            SnapshotError::Model => {
                f.write_str("the snapshot belongs to another model, precision or step")
            }
            SnapshotError::Scheme => f.write_str(
                "the snapshot belongs to another scheme, damping method or number of iterations",
            ),
            SnapshotError::NotFinite => {
                f.write_str("the snapshot contains a number that is not finite")
            }
        }
    }
}

impl core::error::Error for SnapshotError {}

impl<H, S> Plant<H, S>
where
    H: Deref<Target: ModelOwner + Sized>,
    S: Scheme,
{
    /// The size of a snapshot of this plant \[bytes\].
    #[must_use]
    pub fn snapshot_size(&self) -> usize {
        let mut count = Count(0);
        self.visit_all(&mut count);
        HEADER + count.0 + CHECKSUM
    }

    /// Writes the state to the start of `buffer`; returns the number of bytes written.
    ///
    /// # Errors
    /// [`SnapshotError::Buffer`], [`SnapshotError::Failed`].
    pub fn snapshot(&self, buffer: &mut [u8]) -> Result<usize, SnapshotError> {
        if self.status().is_err() {
            return Err(SnapshotError::Failed);
        }
        let size = self.snapshot_size();
        let out = buffer.get_mut(..size).ok_or(SnapshotError::Buffer(size))?;
        let mut writer = Writer { out, crc: Crc32::default() };
        writer.bytes(&MAGIC);
        writer.bytes(&VERSION.to_le_bytes());
        writer.bytes(&scheme_fingerprint(self.scheme()).to_le_bytes());
        writer.bytes(&self.fingerprint().to_le_bytes());
        self.visit_all(&mut writer);
        let crc = writer.crc.finish();
        writer.bytes(&crc.to_le_bytes());
        Ok(size)
    }

    /// Restores the state from a snapshot of the same model, precision, scheme and step.
    ///
    /// # Errors
    /// A [`SnapshotError`]; the plant is then unchanged. A failed plant runs again after a successful call.
    pub fn restore(&mut self, bytes: &[u8]) -> Result<(), SnapshotError> {
        let size = self.snapshot_size();
        let (state, mut source, mut finite) =
            self.base.read_state(bytes, size, scheme_fingerprint(self.scheme()))?;
        let begun = match S::REMEMBERS.then(|| source.take(4)) {
            Some(1) => true,
            // Without a valid memory all words are zero: a state has exactly one snapshot.
            Some(0) if source.bytes.iter().any(|byte| *byte != 0) => {
                return Err(SnapshotError::Format);
            }
            Some(0) | None => false,
            Some(_) => return Err(SnapshotError::Format),
        };
        let mut memory = begun.then(|| self.memory());
        for of_body in memory.iter_mut().flat_map(|memory| memory.as_mut()) {
            S::fill_memory(of_body, &mut source);
            S::visit_memory(of_body, &mut finite);
        }
        if !finite.0 {
            return Err(SnapshotError::NotFinite);
        }
        self.resume_with(state, memory);
        Ok(())
    }

    fn visit_all(&self, visitor: &mut impl WordVisitor) {
        self.base.visit(visitor);
        if S::REMEMBERS {
            let remembered = self.remembered();
            visitor.word(Word::I32(i32::from(remembered.is_some())));
            // Written also without a valid memory: the size of a snapshot depends on the plant only.
            let memory = remembered
                .map_or_else(|| self.model().per_body(S::Memory::default()), Clone::clone);
            memory.as_ref().iter().for_each(|of_body| S::visit_memory(of_body, visitor));
        }
    }
}

impl<H> Base<H>
where
    H: Deref<Target: ModelOwner + Sized>,
{
    /// Passes the state's words to the visitor.
    fn visit(&self, visitor: &mut impl WordVisitor) {
        self.state.visit(visitor);
        for signal in self.state.signals.as_ref() {
            signal.visit(visitor);
        }
    }

    /// The state in a snapshot of `size` bytes of the scheme `own`, the remaining bytes, and whether its numbers are
    /// finite.
    fn read_state<'b>(
        &self,
        bytes: &'b [u8],
        size: usize,
        own: u32,
    ) -> Result<(State<H::Target>, Reader<'b>, Finite), SnapshotError> {
        let mut reader = Reader { bytes: bytes.get(..HEADER).ok_or(SnapshotError::Format)? };
        if reader.take(4) != u64::from(u32::from_le_bytes(MAGIC)) {
            return Err(SnapshotError::Format);
        }
        let version = reader.take(2) as u16;
        if version != VERSION {
            return Err(SnapshotError::Version(version));
        }
        let covered = bytes.len().checked_sub(CHECKSUM).ok_or(SnapshotError::Format)?;
        let (covered, checksum) = bytes.split_at_checked(covered).ok_or(SnapshotError::Format)?;
        let mut crc = Crc32::default();
        crc.add(covered);
        if (Reader { bytes: checksum }).take(4) != u64::from(crc.finish()) {
            return Err(SnapshotError::Checksum);
        }
        let scheme = reader.take(4);
        if reader.take(8) != self.fingerprint() {
            return Err(SnapshotError::Model);
        }
        if scheme != u64::from(own) {
            return Err(SnapshotError::Scheme);
        }
        if bytes.len() != size {
            return Err(SnapshotError::Format);
        }
        let mut state = self.state.clone();
        let mut source = Reader { bytes: covered.get(HEADER..).unwrap_or(&[]) };
        state.fill(&mut source);
        let mut finite = Finite(true);
        state.visit(&mut finite);
        for signal in state.signals.as_mut() {
            signal.fill(&mut source);
            signal.visit(&mut finite);
        }
        Ok((state, source, finite))
    }
}

/// The number of bytes so far.
struct Count(usize);

impl WordVisitor for Count {
    fn word(&mut self, word: Word) {
        self.0 += word.size();
    }
}

struct Writer<'b> {
    out: &'b mut [u8],
    crc: Crc32,
}

impl Writer<'_> {
    fn bytes(&mut self, bytes: &[u8]) {
        self.crc.add(bytes);
        let out = core::mem::take(&mut self.out);
        if let Some((here, rest)) = out.split_at_mut_checked(bytes.len()) {
            here.iter_mut().zip(bytes).for_each(|(to, from)| *to = *from);
            self.out = rest;
        }
    }
}

impl WordVisitor for Writer<'_> {
    fn word(&mut self, word: Word) {
        let bytes = word.bits().to_le_bytes();
        self.bytes(bytes.get(..word.size()).unwrap_or(&[]));
    }
}

struct Reader<'b> {
    bytes: &'b [u8],
}

impl WordSource for Reader<'_> {
    /// The next bytes as a number; 0 beyond the end, which the length check excludes.
    fn take(&mut self, size: usize) -> u64 {
        let (here, rest) = self.bytes.split_at_checked(size).unwrap_or((&[], &[]));
        self.bytes = rest;
        here.iter().rev().fold(0, |value, byte| value << 8 | u64::from(*byte))
    }
}

/// CRC-32 of IEEE 802.3, reflected, bit by bit: a snapshot is short and rarely taken.
struct Crc32(u32);

impl Default for Crc32 {
    fn default() -> Self {
        Self(u32::MAX)
    }
}

impl Crc32 {
    fn add(&mut self, bytes: &[u8]) {
        for byte in bytes {
            self.0 ^= u32::from(*byte);
            for _ in 0..8 {
                let lowest = self.0 & 1;
                self.0 = (self.0 >> 1) ^ (0xedb8_8320 & lowest.wrapping_neg());
            }
        }
    }

    fn finish(&self) -> u32 {
        !self.0
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn the_checksum_is_the_published_one() {
        let mut crc = Crc32::default();
        crc.add(b"123456789");
        assert_eq!(crc.finish(), 0xcbf4_3926);
    }
}
