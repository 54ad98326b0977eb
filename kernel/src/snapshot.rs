//! Snapshots: a plant's state as plain bytes, and back, exactly.
//!
//! `plant => bytes => plant`. Little-endian: magic `DBDS`, version (u16), fingerprint of the scheme
//! (u32), fingerprint of model, precision and step (u64), the state's words in the order of its
//! hash, then two words per input, then, of a scheme that remembers the step before, whether it does and
//! its words per body, then the CRC-32 (IEEE 802.3, reflected) of all before it. A
//! plant of the same model, scheme and step, on whatever target, goes on with the very same bits.
//! Bytes that do not fit are refused and change nothing.

use core::ops::Deref;

use crate::body::Body;
use crate::elements::input::{Input, InputKind, Knot};
use crate::elements::load::Load;
use crate::elements::point_bushing::PointBushing;
use crate::elements::point_on_line::PointOnLine;
use crate::elements::revolute::Revolute;
use crate::elements::torsion_spring::TorsionSpring;
use crate::elements::tsda::Tsda;
use crate::elements::universal::Universal;
use crate::geometry::{F64, Geometry};
use crate::model::{Group, ModelOwner, ModelRef};
use crate::plant::Plant;
use crate::real::Real;
use crate::schemes::Scheme;
use crate::words::{Finite, Fnv1a, Word, WordSource, WordVisitor, Words};

const MAGIC: [u8; 4] = *b"DBDS";
/// Of the layout; another one is refused.
const VERSION: u16 = 2;
/// Magic, version, fingerprints of scheme and model.
const HEADER: usize = 18;
const CHECKSUM: usize = 4;

/// Why a snapshot was not taken, or refused.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
#[cfg_attr(feature = "defmt", derive(defmt::Format))]
pub enum SnapshotError {
    /// The buffer is shorter than this many bytes.
    Buffer(usize),
    /// The plant has failed; it has no state worth keeping.
    Failed,
    /// The bytes are not a snapshot, or not a whole one.
    Format,
    /// The layout is that of another version.
    Version(u16),
    /// A bit was changed.
    Checksum,
    /// It is the state of another model, precision or step.
    Model,
    /// It is of another scheme, way of damping, number of Newton iterations or ρ∞.
    Scheme,
    /// It holds a number that is not finite.
    NotFinite,
}

impl core::fmt::Display for SnapshotError {
    fn fmt(&self, f: &mut core::fmt::Formatter<'_>) -> core::fmt::Result {
        match self {
            SnapshotError::Buffer(size) => write!(f, "the snapshot takes {size} bytes"),
            SnapshotError::Failed => f.write_str("the plant has failed"),
            SnapshotError::Format => f.write_str("these bytes are not a whole snapshot"),
            SnapshotError::Version(found) => write!(f, "version {found}, known is {VERSION}"),
            SnapshotError::Checksum => f.write_str("the checksum is wrong"),
            SnapshotError::Model => f.write_str("a snapshot of another model, precision or step"),
            SnapshotError::Scheme => {
                f.write_str("a snapshot of another scheme, damping or number of iterations")
            }
            SnapshotError::NotFinite => f.write_str("the snapshot holds a number not finite"),
        }
    }
}

impl core::error::Error for SnapshotError {}

impl<H, S> Plant<H, S>
where
    H: Deref<Target: ModelOwner + Sized>,
    S: Scheme,
{
    /// The bytes that a snapshot of this plant takes.
    #[must_use]
    pub fn snapshot_size(&self) -> usize {
        let mut count = Count(0);
        self.visit_all(&mut count);
        HEADER + count.0 + CHECKSUM
    }

    /// Writes the state to the start of `buffer`; the number of bytes written.
    ///
    /// # Errors
    /// [`SnapshotError::Buffer`], [`SnapshotError::Failed`].
    pub fn snapshot(&self, buffer: &mut [u8]) -> Result<usize, SnapshotError> {
        if !self.status().is_running() {
            return Err(SnapshotError::Failed);
        }
        let size = self.snapshot_size();
        let out = buffer.get_mut(..size).ok_or(SnapshotError::Buffer(size))?;
        let mut writer = Writer { out, crc: Crc32::default() };
        writer.bytes(&MAGIC);
        writer.bytes(&VERSION.to_le_bytes());
        writer.bytes(&self.scheme_fingerprint().to_le_bytes());
        writer.bytes(&self.fingerprint().to_le_bytes());
        self.visit_all(&mut writer);
        let crc = writer.crc.finish();
        writer.bytes(&crc.to_le_bytes());
        Ok(size)
    }

    /// Takes the state from a snapshot of the same model, precision, scheme and step.
    ///
    /// # Errors
    /// A [`SnapshotError`]; the plant is then as it was. A failed plant runs again after a
    /// successful call.
    pub fn restore(&mut self, bytes: &[u8]) -> Result<(), SnapshotError> {
        let size = self.snapshot_size();
        let (header, rest) = bytes.split_at_checked(HEADER).ok_or(SnapshotError::Format)?;
        let mut reader = Reader { bytes: header };
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
        if scheme != u64::from(self.scheme_fingerprint()) {
            return Err(SnapshotError::Scheme);
        }
        if bytes.len() != size {
            return Err(SnapshotError::Format);
        }
        let mut state = self.state().clone();
        let mut source = Reader { bytes: rest };
        state.fill(&mut source);
        let mut finite = Finite(true);
        state.visit(&mut finite);
        for signal in state.signals.as_mut() {
            signal.fill(&mut source);
            signal.visit(&mut finite);
        }
        let begun = S::REMEMBERS && source.take(4) != 0;
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

    /// FNV-1a 64 over the model's constants and initial state, its precision and the step: what a
    /// state belongs to.
    #[must_use]
    pub fn fingerprint(&self) -> u64 {
        let mut hash = Fnv1a::new();
        for byte in <H::Target as ModelOwner>::Precision::NAME.bytes() {
            hash.word(Word::I32(i32::from(byte)));
        }
        let orientation = <H::Target as ModelOwner>::Precision::ORIENTATION;
        if orientation != F64::ORIENTATION {
            for byte in orientation.bytes() {
                hash.word(Word::I32(i32::from(byte)));
            }
        }
        hash.word(Word::F64(self.step_size()));
        visit_model(&self.model().view(), &mut hash);
        self.model().initial().iter().for_each(|state| state.visit(&mut hash));
        hash.finish()
    }

    /// FNV-1a 64 over the scheme's name, its way of damping, its evaluations per step, which tell its
    /// Newton iterations, and its other parameters, folded to 32 bits.
    fn scheme_fingerprint(&self) -> u32 {
        let mut hash = Fnv1a::new();
        for byte in S::NAME.bytes().chain(S::DAMPING.name().bytes()) {
            hash.word(Word::I32(i32::from(byte)));
        }
        hash.word(Word::U64(u64::from(self.scheme().evaluations())));
        self.scheme().visit_parameters(&mut hash);
        let hash = hash.finish();
        (hash >> 32) as u32 ^ hash as u32
    }

    fn visit_all(&self, visitor: &mut impl WordVisitor) {
        self.state().visit(visitor);
        for signal in self.state().signals.as_ref() {
            signal.visit(visitor);
        }
        if S::REMEMBERS {
            let remembered = self.remembered();
            visitor.word(Word::I32(i32::from(remembered.is_some())));
            // Not begun it has the words, too: a snapshot's size is that of its plant.
            let memory = remembered
                .map_or_else(|| self.model().per_body(S::Memory::default()), Clone::clone);
            memory.as_ref().iter().for_each(|of_body| S::visit_memory(of_body, visitor));
        }
    }
}

/// FNV-1a 64 over a model's constants, each number rounded to single precision: the same for a scene in
/// every precision, whatever the scheme, the step and the initial state.
#[must_use]
pub fn model_hash<M: ModelOwner>(model: &M) -> u64 {
    let mut hash = Singles(Fnv1a::new());
    visit_model(&model.view(), &mut hash);
    hash.0.finish()
}

/// Hashes numbers rounded to single precision.
struct Singles(Fnv1a);

impl WordVisitor for Singles {
    fn word(&mut self, word: Word) {
        self.0.word(match word {
            Word::F64(x) => Word::F32(x as f32),
            other => other,
        });
    }
}

/// Every constant of a model in the order of its fields, counts first.
fn visit_model<P: Geometry, T>(model: &ModelRef<'_, P, T>, visitor: &mut impl WordVisitor) {
    // Field by field, so that a new one cannot be forgotten.
    let ModelRef {
        bodies,
        gravity,
        groups,
        points,
        tsdas,
        bushings,
        dampers,
        torsions,
        loads,
        lines,
        inputs,
        knots,
        clearances,
        revolutes,
        universals,
        terms: _,
    } = model;
    let counts = [
        bodies.len(),
        gravity.len(),
        groups.len(),
        points.len(),
        tsdas.len(),
        bushings.len(),
        dampers.len(),
        torsions.len(),
        loads.len(),
        lines.len(),
        inputs.len(),
        knots.len(),
        clearances.len(),
    ];
    let mut integer = |value: u64| visitor.word(Word::U64(value));
    counts.into_iter().for_each(|count| integer(count as u64));
    for &Group { law, a, b, stars, arms, shared, point, element, damper, clearance } in *groups {
        integer(law as u64);
        integer(u64::from(a.0) << 16 | u64::from(b.0));
        integer(u64::from(stars) << 16 | u64::from(arms) << 8 | shared as u64);
        integer(u64::from(point) << 16 | u64::from(element));
        integer(u64::from(damper.0) << 16 | u64::from(clearance.0));
    }
    for spring in *torsions {
        integer(u64::from(spring.a.0) << 16 | u64::from(spring.b.0));
        integer(u64::from(spring.damper.0));
    }
    for load in *loads {
        integer(u64::from(load.body.0) << 1 | load.frame as u64);
    }
    // All else of a body is derived from these two.
    for Body { mass, inertia, .. } in *bodies {
        visitor.word(mass.word());
        inertia.visit(visitor);
    }
    gravity.iter().for_each(|field| field.visit(visitor));
    points.iter().for_each(|point| point.visit(visitor));
    for &Tsda { stiffness, free_length } in *tsdas {
        visitor.word(stiffness.word());
        visitor.word(free_length.word());
    }
    for &PointBushing { stiffness } in *bushings {
        visitor.word(stiffness.word());
    }
    dampers.iter().chain(*clearances).for_each(|number| visitor.word(number.word()));
    for spring in *torsions {
        // Bodies and damper stand above.
        let TorsionSpring { a: _, b: _, damper: _, axis, reference, stiffness, preload } = spring;
        axis.visit(visitor);
        reference.visit(visitor);
        visitor.word(stiffness.word());
        visitor.word(preload.word());
    }
    for load in *loads {
        // Body and frame stand above.
        let Load { body: _, frame: _, force, torque, from, until } = load;
        force.visit(visitor);
        torque.visit(visitor);
        visitor.word(Word::F64(*from));
        visitor.word(Word::F64(*until));
    }
    for PointOnLine { direction, stiffness, free_length } in *lines {
        direction.visit(visitor);
        visitor.word(stiffness.word());
        visitor.word(free_length.word());
    }
    inputs.iter().for_each(|input| visit_input(input, visitor));
    for Knot { time, value, slope } in *knots {
        visitor.word(Word::F64(*time));
        visitor.word(value.word());
        visitor.word(slope.word());
    }
    // They came after the others: a model without them keeps its hash.
    for Revolute { stiffness, along, levers } in *revolutes {
        visitor.word(stiffness.word());
        visitor.word(along.word());
        levers.iter().for_each(|lever| lever.visit(visitor));
    }
    for Universal { stiffness, lever, axis } in *universals {
        visitor.word(stiffness.word());
        lever.visit(visitor);
        axis.visit(visitor);
    }
}

fn visit_input<P: Geometry>(input: &Input<P>, visitor: &mut impl WordVisitor) {
    let mut integers = |kind: u64, first: u16, second: u16| {
        visitor.word(Word::U64(kind << 32 | u64::from(first) << 16 | u64::from(second)));
    };
    let Input { kind, value, knot, knots } = input;
    match kind {
        InputKind::Force { body, point, direction, frame } => {
            integers(*frame as u64, body.0, 0);
            point.visit(visitor);
            direction.visit(visitor);
        }
        InputKind::Torque { body, axis, frame } => {
            integers(2 + *frame as u64, body.0, 0);
            axis.visit(visitor);
        }
        InputKind::JointTorque { a, b, axis } => {
            integers(4, a.0, b.0);
            axis.visit(visitor);
        }
        InputKind::Actuator { group, element } => integers(5, *group, *element),
        InputKind::Anchor { direction } => {
            integers(6, 0, 0);
            direction.visit(visitor);
        }
    }
    visitor.word(value.word());
    visitor.word(Word::U64(u64::from(*knot) << 16 | u64::from(*knots)));
}

/// Bytes so far.
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
    /// The next bytes as a number; 0 beyond the end, which the length check precedes.
    fn take(&mut self, size: usize) -> u64 {
        let (here, rest) = self.bytes.split_at_checked(size).unwrap_or((&[], &[]));
        self.bytes = rest;
        here.iter().rev().fold(0, |value, byte| value << 8 | u64::from(*byte))
    }
}

/// CRC-32 of IEEE 802.3, reflected, bit by bit: a snapshot is short and seldom taken.
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
