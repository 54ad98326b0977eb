//! The head of a golden file: what the samples belong to.
//!
//! `scene, plant, names => lines`. One key per line, so that a change of one shows as one line.

use core::fmt::{self, Display, Write};

use crate::component::{Component, ENDS};
use crate::number::Digits;

/// The format that this crate writes and reads.
pub const VERSION: u32 = 1;

/// How the first line begins, before the version.
pub(crate) const FIRST: &str = "# dbd golden ";

/// A scheme as its bits depend on it.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct SchemeTag<N> {
    /// Its name, e.g. `leapfrog`.
    pub name: N,
    /// How its dampers act: `sweeps`, `joint-wise` or `explicit`.
    pub damping: N,
    /// Force evaluations per step, which tell its Newton iterations.
    pub evaluations: u32,
}

impl<N: Display> Display for SchemeTag<N> {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        let Self { name, damping, evaluations } = self;
        write!(f, "{name} ({damping}, {evaluations} per step)")
    }
}

/// A precision as its bits depend on it.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct PrecisionTag<N> {
    /// Its name, e.g. `f32`.
    pub name: N,
    /// How orientations are stored, e.g. `quaternion`.
    pub orientation: N,
}

impl<N: Display> Display for PrecisionTag<N> {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        write!(f, "{} ({})", self.name, self.orientation)
    }
}

/// How many digits numbers have.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct Numerals {
    /// Of a position.
    pub position: Digits,
    /// Of an orientation.
    pub orientation: Digits,
    /// Of a velocity, linear or angular.
    pub velocity: Digits,
    /// Of a read-out.
    pub value: Digits,
}

impl Numerals {
    /// In the order of the head's line.
    pub(crate) const fn all(self) -> [Digits; 4] {
        [self.position, self.orientation, self.velocity, self.value]
    }

    pub(crate) const fn of_column(self, column: usize) -> Digits {
        match column {
            0..3 => self.position,
            3..7 => self.orientation,
            _ => self.velocity,
        }
    }
}

/// What a plant's bits belong to.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Identity<'a> {
    /// The scheme.
    pub scheme: SchemeTag<&'a str>,
    /// The precision.
    pub precision: PrecisionTag<&'a str>,
    /// How many digits its numbers have.
    pub numerals: Numerals,
    /// \[s\] the step as given.
    pub step_size: f64,
    /// Hash of the model, the same in every precision: [`dbd_kernel::fingerprint::model_hash`].
    pub model: u64,
    /// How many bodies it has.
    pub bodies: usize,
    /// How many torsion springs, whose turns are counted.
    pub turns: usize,
}

/// What is recorded: a plant of a scene, sampled, with names.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Head<'a> {
    /// The scene's name.
    pub scene: &'a str,
    /// The plant: [`crate::Subject::identity`].
    pub identity: Identity<'a>,
    /// Steps from sample to sample.
    pub every: u64,
    /// The names of the bodies, in the model's order.
    pub bodies: &'a [&'a str],
    /// The names of the further numbers of a sample: read-outs, inputs, what a controller holds.
    pub values: &'a [&'a str],
}

impl<'a> Head<'a> {
    /// The columns between those of step and hash and that of the chain.
    pub(crate) fn columns(&self) -> impl Iterator<Item = Component<&'a str>> {
        let turns = self.identity.turns;
        let bodies = self.bodies.iter().flat_map(|body| {
            (0..ENDS.len()).map(move |column| Component::Body { body: *body, column })
        });
        let values = self.values.iter().map(|name| Component::Value { name: *name });
        bodies.chain((0..turns).map(|spring| Component::Turns { spring })).chain(values)
    }

    /// A name that no line can hold: an empty one, or one with a control character.
    pub(crate) fn unfit_name(&self) -> Option<&'a str> {
        let names = self.bodies.iter().chain(self.values).copied().chain([self.scene]);
        names.into_iter().find(|name| name.trim().is_empty() || name.contains(char::is_control))
    }

    /// Writes the head, the line of column names included.
    pub(crate) fn write(&self, to: &mut impl Write) -> fmt::Result {
        let Identity { scheme, precision, numerals, step_size, model, bodies, turns } =
            self.identity;
        writeln!(to, "{FIRST}{VERSION}")?;
        writeln!(to, "# scene: {}", self.scene)?;
        writeln!(to, "# model: {model:016x}")?;
        writeln!(to, "# scheme: {}\t{}\t{}", scheme.name, scheme.damping, scheme.evaluations)?;
        writeln!(to, "# precision: {}\t{}", precision.name, precision.orientation)?;
        to.write_str("# digits:")?;
        for digits in numerals.all() {
            write!(to, " {}", digits.name())?;
        }
        writeln!(to, "\n# step: {step_size:?}")?;
        writeln!(to, "# every: {}", self.every)?;
        writeln!(to, "# bodies: {bodies}")?;
        writeln!(to, "# turns: {turns}")?;
        writeln!(to, "# values: {}", self.values.len())?;
        to.write_str("step\tstate")?;
        for column in self.columns() {
            write!(to, "\t{column}")?;
        }
        to.write_str("\tchain\n")
    }
}
