//! Checks that models have the same structure: the same parts between the same bodies, with any parameters.
//!
//! `(model, model) => the first part that differs`.

use dbd_kernel::elements::input::{Input, InputKind};
use dbd_kernel::elements::source::{Sensor, Source, SourceLaw};
use dbd_kernel::geometry::Float;
use dbd_kernel::lanes::Named;
use dbd_kernel::{BodyIndex, Load, LoadFrame, Real, TorsionSpring};
use dbd_scene::SceneModel;

/// A structural difference of two models.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Difference {
    /// The numbers of these parts differ.
    Count {
        /// The parts, in plural.
        parts: &'static str,
        /// Their number in the first.
        first: usize,
        /// Their number in the other.
        other: usize,
    },
    /// This part connects other bodies, has another law, or acts at other times.
    Part {
        /// The kind of part.
        part: &'static str,
        /// Its row among its kind.
        row: usize,
    },
}

impl std::fmt::Display for Difference {
    fn fmt(&self, f: &mut std::fmt::Formatter<'_>) -> std::fmt::Result {
        match self {
            Self::Count { parts, first, other } => {
                write!(f, "it has {other} {parts}; the first instance has {first}")
            }
            Self::Part { part, row } => write!(
                f,
                "its {part} {row} differs from that of the first instance in bodies, kind or \
                 time"
            ),
        }
    }
}

/// The first structural difference of `other` from `first`.
pub(crate) fn difference<R: Real + Named>(
    first: &SceneModel<Float<R>>,
    other: &SceneModel<Float<R>>,
) -> Option<Difference> {
    let counts = |model: &SceneModel<Float<R>>| {
        [
            ("bodies", model.bodies.len()),
            ("gravity fields", model.gravity.len()),
            ("joints and single elements", model.groups.len()),
            ("points", model.points.len()),
            ("TSDAs", model.tsdas.len()),
            ("point bushings", model.bushings.len()),
            ("dampers", model.dampers.len()),
            ("torsion springs", model.torsions.len()),
            ("loads", model.loads.len()),
            ("points on lines", model.lines.len()),
            ("inputs", model.inputs.len()),
            ("table knots", model.knots.len()),
            ("clearances", model.clearances.len()),
            ("bushing revolutes", model.revolutes.len()),
            ("bushing universal joints", model.universals.len()),
            ("input sources", model.sources.len()),
            ("interactions", model.laws.bodies().count()),
        ]
    };
    for ((parts, first), (_, other)) in counts(first).into_iter().zip(counts(other)) {
        if first != other {
            return Some(Difference::Count { parts, first, other });
        }
    }
    fn row<T>(first: &[T], other: &[T], alike: impl Fn(&T, &T) -> bool) -> Option<usize> {
        first.iter().zip(other).position(|(first, other)| !alike(first, other))
    }
    let parts = [
        ("joint or element", row(&first.groups, &other.groups, PartialEq::eq)),
        ("torsion spring", row(&first.torsions, &other.torsions, |a, b| spring(a) == spring(b))),
        ("load", row(&first.loads, &other.loads, |a, b| load(a) == load(b))),
        ("input", row(&first.inputs, &other.inputs, |a, b| input(a) == input(b))),
        ("table knot", row(&first.knots, &other.knots, |a, b| a.time == b.time)),
        ("interaction", row(&ends(first), &ends(other), PartialEq::eq)),
        ("input source", row(&first.sources, &other.sources, |a, b| source(a) == source(b))),
    ];
    parts.into_iter().find_map(|(part, row)| row.map(|row| Difference::Part { part, row }))
}

/// The bodies of every interaction.
fn ends<R: Real + Named>(model: &SceneModel<Float<R>>) -> Vec<[BodyIndex; 2]> {
    model.laws.bodies().collect()
}

fn spring<R: Real>(spring: &TorsionSpring<R>) -> ([BodyIndex; 2], Option<usize>) {
    ([spring.a, spring.b], spring.damper.row())
}

/// The parts of a source that lanes share: its input, knots, period and phase, or sensor.
fn source<R: Real + Named>(source: &Source<Float<R>>) -> ([u16; 5], [f64; 2]) {
    let (kind, times) = match source.law {
        SourceLaw::Sine { period, phase, .. } => ([0, 0], [period, phase]),
        SourceLaw::Periodic { period } => ([1, 0], [period, 0.0]),
        SourceLaw::Over { sensor, .. } => {
            let read = match sensor {
                Sensor::Angle { spring, .. } => [2, spring.0],
                Sensor::Rate { spring } => [3, spring.0],
                Sensor::Point { body, .. } => [4, body.0],
                Sensor::Velocity { body, .. } => [5, body.0],
            };
            (read, [0.0; 2])
        }
    };
    ([source.input.0, source.knot, source.knots, kind[0], kind[1]], times)
}

fn load<R: Real>(load: &Load<R>) -> (BodyIndex, LoadFrame, [f64; 2]) {
    (load.body, load.frame, [load.from, load.until])
}

/// Kind, bodies or element, axes and table of an input.
type InputShape = (u8, [u16; 2], LoadFrame, [u16; 2]);

fn input<R: Real + Named>(input: &Input<Float<R>>) -> InputShape {
    let (kind, of, frame) = match input.kind {
        InputKind::Force { body, frame, .. } => (0, [body.0, 0], frame),
        InputKind::Torque { body, frame, .. } => (1, [body.0, 0], frame),
        InputKind::JointTorque { a, b, .. } => (2, [a.0, b.0], LoadFrame::Body),
        InputKind::JointForce { a, b, .. } => (6, [a.0, b.0], LoadFrame::Body),
        InputKind::Actuator { group, element } => (3, [group.0, element], LoadFrame::World),
        InputKind::Anchor { .. } => (4, [0; 2], LoadFrame::World),
        InputKind::Gravity { .. } => (7, [0; 2], LoadFrame::World),
        InputKind::Velocity { body, .. } => (8, [body.0, 0], LoadFrame::World),
        InputKind::AngularVelocity { body, .. } => (9, [body.0, 0], LoadFrame::World),
        InputKind::Signal => (5, [0; 2], LoadFrame::World),
    };
    (kind, of, frame, [input.knot, input.knots])
}
