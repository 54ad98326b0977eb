//! Errors of a golden file, and differences of a run from it.
//!
//! `kind, position, both values => message`. Allocation-free with borrowed names.

use core::fmt::{self, Display};

use crate::component::{Component, Quantity};
use crate::head::{PrecisionTag, SchemeTag, VERSION};

/// How a file is damaged.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Damage {
    /// It does not start like a golden file.
    Foreign,
    /// It is not UTF-8.
    Text,
    /// This header line is missing or has other contents.
    Head(&'static str),
    /// The number of fields of the line differs from the number of columns.
    Fields {
        /// Fields found.
        found: usize,
        /// Columns.
        columns: usize,
    },
    /// This column, from 1, is not a number.
    Number(usize),
    /// Its step is not after that of the previous line.
    Order,
    /// It, or a line from this one on, was edited, or one between them is missing.
    Chain {
        /// The first line in doubt.
        from: usize,
    },
    /// The file ends without its last line.
    Cut,
    /// The last line has another number of samples or another hash.
    Count,
    /// There is text after the last line.
    Rest,
}

impl Display for Damage {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        match self {
            Damage::Foreign => f.write_str("not a golden file"),
            Damage::Text => f.write_str("not UTF-8"),
            Damage::Head(key) => write!(f, "header line `{key}` is missing or damaged"),
            Damage::Fields { found, columns } => {
                write!(f, "the line has {found} of {columns} columns: it was truncated or edited")
            }
            Damage::Number(column) => write!(f, "column {column} is not a number"),
            Damage::Order => f.write_str("its step is not after that of the previous line"),
            Damage::Chain { from } => write!(
                f,
                "the hash does not match the previous lines: this line, or one from line {from} \
                 on, was edited or is missing"
            ),
            Damage::Cut => f.write_str("the file is truncated: its last line is missing"),
            Damage::Count => f.write_str(
                "the last line does not match the previous ones: one is missing, or it was edited",
            ),
            Damage::Rest => f.write_str("there is text after the last line"),
        }
    }
}

/// Why a run and a golden file do not match, or differ. `N` is the text type of names.
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum Mismatch<N> {
    /// The file is damaged.
    Damaged {
        /// Its line, from 1.
        line: usize,
        /// How.
        damage: Damage,
    },
    /// It is of another version of the format.
    Version {
        /// The file's.
        golden: N,
        /// This crate's.
        present: u32,
    },
    /// It is of another scene.
    Scene {
        /// The file's.
        golden: N,
        /// The run's.
        present: N,
    },
    /// It is of another model of the scene: masses, points or stiffnesses differ.
    Model {
        /// The file's hash.
        golden: u64,
        /// The run's.
        present: u64,
    },
    /// It is of another scheme.
    Scheme {
        /// The file's.
        golden: SchemeTag<N>,
        /// The run's.
        present: SchemeTag<N>,
    },
    /// It is of another precision.
    Precision {
        /// The file's.
        golden: PrecisionTag<N>,
        /// The run's.
        present: PrecisionTag<N>,
    },
    /// It is of another step.
    Step {
        /// \[s\] the file's.
        golden: f64,
        /// \[s\] the run's.
        present: f64,
    },
    /// It is sampled at another interval.
    Every {
        /// Steps, the file's.
        golden: u64,
        /// Steps, the run's.
        present: u64,
    },
    /// It has another column at this index, or none where the run has one.
    Column {
        /// The index, from 1.
        number: usize,
        /// The file's.
        golden: Option<N>,
        /// The run's.
        present: Option<Component<N>>,
    },
    /// It has its next sample at another step than the run, or none where the run has one.
    Sample {
        /// The file's step.
        golden: Option<u64>,
        /// The run's.
        present: Option<u64>,
    },
    /// A band is given for a value that is not recorded.
    UnknownBand(N),
    /// No band is given for a value.
    NoBand(N),
    /// The numbers of names and of bodies or values differ.
    Count {
        /// Names.
        names: usize,
        /// Bodies or values.
        given: usize,
    },
    /// The run differs.
    Difference(Difference<N>),
}

/// Where a run first differs from the golden one, and how far.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Difference<N> {
    /// The step of the first sample that differs.
    pub step: u64,
    /// The step of the previous sample, if any: the first step that differs is after it.
    pub equal: Option<u64>,
    /// Bit for bit: the first number that differs. Within bands: the number with the largest difference in the quantity
    /// that is furthest beyond its band.
    pub component: Component<N>,
    /// \[unit of the component\] its golden value.
    pub golden: f64,
    /// \[unit of the component\] its present value.
    pub present: f64,
    /// Distance in ULP of the precision; none for a NaN.
    pub ulps: Option<u64>,
    /// \[unit of the quantity\] within bands: its distance, and its band.
    pub beyond: Option<(f64, f64)>,
    /// Numbers that differ at this sample.
    pub differing: usize,
    /// Numbers of a sample.
    pub numbers: usize,
    /// The distance of each quantity at this sample.
    pub furthest: Furthest<N>,
}

/// The largest distance of each quantity, with its body.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Furthest<N> {
    /// In the order of [`Quantity::ALL`]; none where all are equal.
    pub quantities: [Option<(f64, N)>; 4],
    /// Of the recorded values, each in its own unit.
    pub value: Option<(f64, N)>,
}

impl<N> Default for Furthest<N> {
    fn default() -> Self {
        Self { quantities: [None, None, None, None], value: None }
    }
}

impl<N> Furthest<N> {
    /// The same with another text type for names.
    pub fn map<M>(self, with: &mut impl FnMut(N) -> M) -> Furthest<M> {
        let mut one = |far: Option<(f64, N)>| far.map(|(distance, name)| (distance, with(name)));
        Furthest { quantities: self.quantities.map(&mut one), value: one(self.value) }
    }

    /// Stores a distance if it is the largest so far. NaN is larger than any number.
    pub(crate) fn take(place: &mut Option<(f64, N)>, distance: f64, name: N) {
        let largest = place.as_ref().is_none_or(|(most, _)| {
            let within = distance <= *most;
            !within && !most.is_nan()
        });
        if distance != 0.0 && largest {
            *place = Some((distance, name));
        }
    }
}

impl<N> Mismatch<N> {
    /// Whether the run was compared and differs; otherwise there was nothing to compare.
    #[must_use]
    pub fn is_difference(&self) -> bool {
        matches!(self, Mismatch::Difference(_) | Mismatch::Sample { .. })
    }

    /// The same with another text type for names.
    pub fn map<M>(self, mut with: impl FnMut(N) -> M) -> Mismatch<M> {
        let with = &mut with;
        match self {
            Mismatch::Damaged { line, damage } => Mismatch::Damaged { line, damage },
            Mismatch::Version { golden, present } => {
                Mismatch::Version { golden: with(golden), present }
            }
            Mismatch::Scene { golden, present } => {
                Mismatch::Scene { golden: with(golden), present: with(present) }
            }
            Mismatch::Model { golden, present } => Mismatch::Model { golden, present },
            Mismatch::Scheme { golden, present } => {
                let mut tag = |SchemeTag { name, damping, evaluations }| SchemeTag {
                    name: with(name),
                    damping: with(damping),
                    evaluations,
                };
                Mismatch::Scheme { golden: tag(golden), present: tag(present) }
            }
            Mismatch::Precision { golden, present } => {
                let mut tag = |PrecisionTag { name, orientation }| PrecisionTag {
                    name: with(name),
                    orientation: with(orientation),
                };
                Mismatch::Precision { golden: tag(golden), present: tag(present) }
            }
            Mismatch::Step { golden, present } => Mismatch::Step { golden, present },
            Mismatch::Every { golden, present } => Mismatch::Every { golden, present },
            Mismatch::Column { number, golden, present } => Mismatch::Column {
                number,
                golden: golden.map(&mut *with),
                present: present.map(|column| column.map(with)),
            },
            Mismatch::Sample { golden, present } => Mismatch::Sample { golden, present },
            Mismatch::UnknownBand(name) => Mismatch::UnknownBand(with(name)),
            Mismatch::NoBand(name) => Mismatch::NoBand(with(name)),
            Mismatch::Count { names, given } => Mismatch::Count { names, given },
            Mismatch::Difference(difference) => Mismatch::Difference(Difference {
                component: difference.component.map(with),
                furthest: difference.furthest.map(with),
                step: difference.step,
                equal: difference.equal,
                golden: difference.golden,
                present: difference.present,
                ulps: difference.ulps,
                beyond: difference.beyond,
                differing: difference.differing,
                numbers: difference.numbers,
            }),
        }
    }
}

impl<N: Display> Display for Mismatch<N> {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        match self {
            Mismatch::Damaged { line, damage } => write!(f, "line {line}: {damage}"),
            Mismatch::Version { golden, present } => {
                write!(f, "it has format version {golden}; expected {present}")
            }
            Mismatch::Scene { golden, present } => {
                write!(f, "it is of another scene: `{golden}`; the run is of `{present}`")
            }
            Mismatch::Model { golden, present } => write!(
                f,
                "it is of another model of the scene: hash {golden:016x}; the run has {present:016x}; \
                 a mass, a point, a stiffness or another constant has changed"
            ),
            Mismatch::Scheme { golden, present } => {
                write!(f, "it used another scheme: {golden}; the run uses {present}")
            }
            Mismatch::Precision { golden, present } => {
                write!(f, "it used another precision: {golden}; the run uses {present}")
            }
            Mismatch::Step { golden, present } => {
                write!(f, "it used another step: {golden:?} s; the run uses {present:?} s")
            }
            Mismatch::Every { golden, present } => write!(
                f,
                "it used another sampling interval: every {golden} steps; the run uses {present}"
            ),
            Mismatch::Column { number, golden, present } => {
                write!(f, "column {number} differs: ")?;
                match golden {
                    Some(name) => write!(f, "`{name}`")?,
                    None => f.write_str("the file has none")?,
                }
                match present {
                    Some(column) => write!(f, "; the run has `{column}`"),
                    None => f.write_str("; the run has none"),
                }
            }
            Mismatch::Sample { golden, present } => {
                match golden {
                    Some(step) => write!(f, "the golden run's next sample is at step {step}")?,
                    None => f.write_str("the golden run has no further sample")?,
                }
                match present {
                    Some(step) => write!(f, "; that of the run is at step {step}"),
                    None => f.write_str("; the run has no further sample"),
                }
            }
            Mismatch::UnknownBand(name) => {
                write!(f, "a band is given for `{name}`, which is not recorded")
            }
            Mismatch::NoBand(name) => write!(f, "no band is given for `{name}`"),
            Mismatch::Count { names, given } => {
                write!(f, "{names} names for {given} bodies or values")
            }
            Mismatch::Difference(difference) => difference.fmt(f),
        }
    }
}

impl<N: Display + fmt::Debug> core::error::Error for Mismatch<N> {}

impl<N: Display> Display for Difference<N> {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        let Self { step, golden, present, .. } = self;
        let what = if self.beyond.is_some() { "beyond its band" } else { "different" };
        match self.equal {
            Some(equal) if equal + 1 == *step => {
                write!(f, "step {step} is the first that is {what}: ")?;
            }
            Some(equal) => {
                let good = if self.beyond.is_some() { "within" } else { "equal" };
                write!(f, "step {step} is {what}, step {equal} was still {good}: ")?;
            }
            None => write!(f, "the first sample, step {step}, is {what}: ")?,
        }
        if let Component::State = self.component {
            return write!(
                f,
                "the hash of the stored state differs, though all {} numbers shown are equal",
                self.numbers
            );
        }
        let unit = self.component.quantity().map_or("", Quantity::unit);
        write!(f, "{} is {present:?}, golden {golden:?}", self.component)?;
        write!(f, " ({:.3e}", (present - golden).abs())?;
        if !unit.is_empty() && self.component.quantity() != Some(Quantity::Orientation) {
            write!(f, " {unit}")?;
        }
        match self.ulps {
            Some(ulps) => write!(f, ", {ulps} ULP)")?,
            None => f.write_str(")")?,
        }
        if let (Some((distance, band)), quantity) = (self.beyond, self.component.quantity()) {
            let name = quantity.map_or("value", Quantity::name);
            write!(f, "; the {name} is off by {distance:.3e} {unit}, its band is {band:e} {unit}")?;
        }
        write!(f, "; {} of {} numbers differ", self.differing, self.numbers)?;
        self.furthest.fmt(f)
    }
}

impl<N: Display> Display for Furthest<N> {
    /// A line for each quantity that differs.
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        for (quantity, far) in Quantity::ALL.into_iter().zip(&self.quantities) {
            if let Some((distance, name)) = far {
                let (kind, unit) = (quantity.name(), quantity.unit());
                write!(f, "\n  {kind:<17} {distance:.3e} {unit} at most, {name}")?;
            }
        }
        if let Some((distance, name)) = &self.value {
            write!(f, "\n  {:<17} {distance:.3e} at most, {name}", "value")?;
        }
        Ok(())
    }
}

/// The version of this crate, for a message.
pub(crate) const KNOWN: u32 = VERSION;
