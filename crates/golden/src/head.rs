//! The head of a golden file: identification of the run.
//!
//! `scene, plant, names => lines`. One key per line, so that one change is one line in a diff.

use core::fmt::{self, Display, Write};

use crate::component::{Component, ENDS};
use crate::number::Digits;

/// The format that this crate writes and reads.
pub const VERSION: u32 = 1;

/// Start of the first line, before the version.
pub(crate) const FIRST: &str = "# dbd golden ";

/// Properties of a scheme that determine the bits.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct SchemeTag<N> {
    /// Its name, e.g. `leapfrog`.
    pub name: N,
    /// Its damping: `sweeps`, `joint-wise` or `explicit`.
    pub damping: N,
    /// Force evaluations per step, which depend on its Newton iterations.
    pub evaluations: u32,
}

impl<N: Display> Display for SchemeTag<N> {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        let Self { name, damping, evaluations } = self;
        write!(f, "{name} ({damping}, {evaluations} per step)")
    }
}

/// Properties of a precision that determine the bits.
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

/// Number of digits of each quantity.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct NumberFormat {
    /// Of a position.
    pub position: Digits,
    /// Of an orientation.
    pub orientation: Digits,
    /// Of a velocity, linear or angular.
    pub velocity: Digits,
    /// Of a read-out.
    pub value: Digits,
}

impl NumberFormat {
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

/// Identity of a plant, which determines its bits.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Identity<'a> {
    /// The scheme.
    pub scheme: SchemeTag<&'a str>,
    /// The precision.
    pub precision: PrecisionTag<&'a str>,
    /// Number of digits of its numbers.
    pub number_format: NumberFormat,
    /// \[s\] the step as given.
    pub step_size: f64,
    /// Hash of the model, the same in every precision: [`dbd_kernel::fingerprint::model_hash`].
    pub model: u64,
    /// Number of bodies.
    pub bodies: usize,
    /// Number of torsion springs, whose revolutions are counted.
    pub turns: usize,
}

/// Description of a recording: scene, plant, sampling interval, names.
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
    /// The names of the further numbers of a sample: read-outs, inputs, controller states.
    pub values: &'a [&'a str],
}

impl<'a> Head<'a> {
    /// The columns between step and hash, and the chain.
    pub(crate) fn columns(&self) -> impl Iterator<Item = Component<&'a str>> {
        let turns = self.identity.turns;
        let bodies = self.bodies.iter().flat_map(|body| {
            (0..ENDS.len()).map(move |column| Component::Body { body: *body, column })
        });
        let values = self.values.iter().map(|name| Component::Value { name: *name });
        bodies.chain((0..turns).map(|spring| Component::Turns { spring })).chain(values)
    }

    /// The first invalid name: empty or with a control character.
    pub(crate) fn unfit_name(&self) -> Option<&'a str> {
        let names = self.bodies.iter().chain(self.values).copied().chain([self.scene]);
        names.into_iter().find(|name| name.trim().is_empty() || name.contains(char::is_control))
    }

    /// Writes the head, including the line of column names.
    pub(crate) fn write(&self, to: &mut impl Write) -> fmt::Result {
        let Identity { scheme, precision, number_format, step_size, model, bodies, turns } =
            self.identity;
        writeln!(to, "{FIRST}{VERSION}")?;
        writeln!(to, "# scene: {}", self.scene)?;
        writeln!(to, "# model: {model:016x}")?;
        writeln!(to, "# scheme: {}\t{}\t{}", scheme.name, scheme.damping, scheme.evaluations)?;
        writeln!(to, "# precision: {}\t{}", precision.name, precision.orientation)?;
        to.write_str("# digits:")?;
        for digits in number_format.all() {
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
