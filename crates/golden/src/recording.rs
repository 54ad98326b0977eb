//! A run in memory, recorded by a test before it is compared.
//!
//! `(scene, plant, names), plant states => samples, text`. The caller steps the plant and its controller; the recording
//! stores a sample whenever one is due.

use std::borrow::ToOwned as _;
use std::boxed::Box;
use std::format;
use std::string::{String, ToString as _};
use std::vec::Vec;

use dbd_kernel::F64;
use dbd_kernel::readouts::Readout;
use dbd_plant::readings::append;
use dbd_scene::{Scene, UnknownName};

use crate::bands::Tolerance;
use crate::compare::{Comparison, Summary};
use crate::head::{FIRST, Head, Identity};
use crate::mismatch::Mismatch;
use crate::plants::Readable;
use crate::record::{RecordError, Recorder};
use crate::subject::{BodyNumbers, Moment, Subject};
use crate::text::Golden;

/// Why a run could not be recorded.
#[derive(Clone, Debug, PartialEq, thiserror::Error)]
pub enum RecordingError {
    /// A sample, or the head.
    #[error(transparent)]
    Record(RecordError<String>),
    /// The scene has no read-out or input with a name.
    #[error(transparent)]
    Name(#[from] UnknownName),
}

impl<N: AsRef<str>> From<RecordError<N>> for RecordingError {
    fn from(error: RecordError<N>) -> Self {
        Self::Record(error.map(|name| name.as_ref().to_owned()))
    }
}

/// The head with owned names.
#[derive(Clone, Debug, PartialEq)]
pub(crate) struct OwnedHead {
    scene: String,
    identity: Identity<'static>,
    every: u64,
    bodies: Vec<String>,
    values: Vec<String>,
}

impl OwnedHead {
    /// The head with borrowed names.
    pub(crate) fn with<A>(&self, look: impl FnOnce(Head<'_>) -> A) -> A {
        let bodies: Vec<&str> = self.bodies.iter().map(String::as_str).collect();
        let values: Vec<&str> = self.values.iter().map(String::as_str).collect();
        look(Head {
            scene: &self.scene,
            identity: self.identity,
            every: self.every,
            bodies: &bodies,
            values: &values,
        })
    }
}

/// A recorded state.
#[derive(Clone, Debug, PartialEq)]
struct Kept {
    step: u64,
    hash: u64,
    bodies: Vec<BodyNumbers>,
    turns: Vec<i32>,
    values: Vec<f64>,
}

impl Moment for Kept {
    fn steps_done(&self) -> u64 {
        self.step
    }

    fn state_hash(&self) -> u64 {
        self.hash
    }

    fn body_numbers(&self, row: usize) -> Option<BodyNumbers> {
        self.bodies.get(row).copied()
    }

    fn turn_count(&self, spring: usize) -> Option<i32> {
        self.turns.get(spring).copied()
    }
}

/// A run, sample by sample.
#[derive(Debug)]
pub struct Recording {
    head: OwnedHead,
    recorder: Recorder<String>,
    kept: Vec<Kept>,
    readouts: Vec<(Readout<F64>, usize)>,
}

impl Recording {
    /// An empty recording of a scene's plant with a sample every `every` steps. `names` are read-outs and inputs of the
    /// scene, which are recorded with the bodies.
    ///
    /// # Errors
    /// [`RecordingError::Name`] where the scene has no such read-out or input;
    /// [`RecordError::Every`].
    pub fn of_scene(
        scene: &Scene,
        plant: &(impl Subject + ?Sized),
        every: u64,
        names: &[&str],
    ) -> Result<Self, RecordingError> {
        Self::of_controlled(scene, plant, every, names, &[])
    }

    /// [`Self::of_scene`] with further numbers that the caller gives at each [call](Self::look_with), such as
    /// controller states.
    ///
    /// # Errors
    /// As [`Self::of_scene`].
    pub fn of_controlled(
        scene: &Scene,
        plant: &(impl Subject + ?Sized),
        every: u64,
        names: &[&str],
        further: &[&str],
    ) -> Result<Self, RecordingError> {
        let (mut readouts, mut values) = (Vec::new(), Vec::new());
        for name in names {
            let info = scene.readouts.iter().find(|info| info.name == *name);
            match (info, scene.input(name)) {
                (Some(info), _) => {
                    values.extend(info.columns.iter().map(|(end, _)| format!("{name}{end}")));
                    readouts.push((info.readout, info.columns.len()));
                }
                (None, Ok(input)) => {
                    values.push((*name).to_owned());
                    readouts.push((Readout::Input { input }, 1));
                }
                // Its error suggests the probable name.
                (None, Err(_)) => drop(scene.readout(name)?),
            }
        }
        values.extend(further.iter().map(|name| (*name).to_owned()));
        let head = OwnedHead {
            scene: scene.name.clone(),
            identity: plant.identity(),
            every,
            bodies: scene.body_names.clone(),
            values,
        };
        Self::begin(head, readouts)
    }

    /// A recording of any plant: a scene's name, the bodies' names in the model's order, and the names of
    /// the numbers that the caller gives at each [sample](Self::sample).
    ///
    /// # Errors
    /// [`RecordError`] if names or interval are invalid.
    pub fn of_plant(
        scene: &str,
        plant: &(impl Subject + ?Sized),
        every: u64,
        bodies: &[&str],
        values: &[&str],
    ) -> Result<Self, RecordingError> {
        let owned = |names: &[&str]| names.iter().map(|name| (*name).to_owned()).collect();
        let head = OwnedHead {
            scene: scene.to_owned(),
            identity: plant.identity(),
            every,
            bodies: owned(bodies),
            values: owned(values),
        };
        Self::begin(head, Vec::new())
    }

    fn begin(
        head: OwnedHead,
        readouts: Vec<(Readout<F64>, usize)>,
    ) -> Result<Self, RecordingError> {
        let recorder =
            head.with(|head| Recorder::begin(String::new(), &head).map_err(RecordingError::from))?;
        Ok(Self { head, recorder, kept: Vec::new(), readouts })
    }

    /// Stores a sample if one is due; returns whether one was. The first call always stores one.
    ///
    /// # Errors
    /// [`RecordError::Missed`] if the plant is beyond the step at which one was due.
    pub fn look(&mut self, plant: &(impl Readable + ?Sized)) -> Result<bool, RecordingError> {
        self.look_with(plant, &[])
    }

    /// [`Self::look`] with the further numbers of this recording.
    ///
    /// # Errors
    /// As [`Self::look`]; [`RecordError::Values`] if their number differs from that of the names.
    pub fn look_with(
        &mut self,
        plant: &(impl Readable + ?Sized),
        further: &[f64],
    ) -> Result<bool, RecordingError> {
        match self.recorder.due() {
            Some(due) if plant.steps_done() < due => return Ok(false),
            Some(due) if plant.steps_done() > due => {
                return Err(RecordError::<&str>::Missed { due, step: plant.steps_done() }.into());
            }
            _ => {}
        }
        let mut values = Vec::new();
        for (readout, columns) in &self.readouts {
            append(plant.reading(readout), *columns, &mut values);
        }
        values.extend(further);
        self.sample(plant, &values).map(|()| true)
    }

    /// Stores a sample, due or not: the last one may be early.
    ///
    /// # Errors
    /// [`RecordError`] if it is not after the last, or the numbers of values and names differ.
    pub fn sample(
        &mut self,
        moment: &(impl Moment + ?Sized),
        values: &[f64],
    ) -> Result<(), RecordingError> {
        let rows = 0..self.head.bodies.len();
        let springs = 0..self.head.identity.turns;
        let kept = Kept {
            step: moment.steps_done(),
            hash: moment.state_hash(),
            bodies: rows.filter_map(|row| moment.body_numbers(row)).collect(),
            turns: springs.filter_map(|spring| moment.turn_count(spring)).collect(),
            values: values.to_vec(),
        };
        self.recorder.sample(&kept, values)?;
        self.kept.push(kept);
        Ok(())
    }

    /// The golden file of this run.
    #[must_use]
    pub fn text(&self) -> String {
        // A string in memory accepts every line.
        self.recorder.clone().finish().unwrap_or_default()
    }

    /// The scene's name.
    #[must_use]
    pub fn scene(&self) -> &str {
        &self.head.scene
    }

    /// The identity of its plant.
    #[must_use]
    pub fn identity(&self) -> &Identity<'static> {
        &self.head.identity
    }

    pub(crate) fn head(&self) -> &OwnedHead {
        &self.head
    }

    /// Compares the run with a golden file's text.
    ///
    /// # Errors
    /// The first [`Mismatch`].
    pub fn compare(
        &self,
        golden: &str,
        tolerance: &Tolerance<'_>,
    ) -> Result<Summary<String>, Box<Mismatch<String>>> {
        self.head.with(|head| {
            let compared = Golden::read(golden).and_then(|golden| {
                let mut comparison = Comparison::new(golden, head, *tolerance)?;
                for kept in &self.kept {
                    comparison.sample(kept, &kept.values)?;
                }
                comparison.finish()
            });
            let mut owned = |name: &str| name.to_string();
            match compared {
                Ok(Summary { samples, furthest }) => {
                    Ok(Summary { samples, furthest: furthest.map(&mut owned) })
                }
                Err(mismatch) => Err(Box::new(mismatch.map(owned))),
            }
        })
    }
}

/// The golden file within a text with other lines before and after it, such as the console output of a target.
#[must_use]
pub fn within(console: &str) -> Option<&str> {
    let first = format!("\n{FIRST}");
    let start = match console.starts_with(FIRST) {
        true => 0,
        false => console.find(&first)? + 1,
    };
    let text = &console[start..];
    let end = text.find("\n# end: ")? + 1;
    let length = text[end..].find('\n').map_or(text.len(), |length| end + length + 1);
    Some(&text[..length])
}
