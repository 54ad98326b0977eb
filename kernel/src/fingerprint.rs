//! Fingerprints of models and schemes, which identify what a state belongs to.
//!
//! `constants in the order of their fields => FNV-1a 64`. A plant refuses a state with another fingerprint; a recorded
//! run stores that of its model.

use core::ops::Deref;

use crate::elements::input::{Input, InputKind, Knot};
use crate::elements::load::Load;
use crate::elements::point_bushing::PointBushing;
use crate::elements::point_on_line::PointOnLine;
use crate::elements::revolute::Revolute;
use crate::elements::source::{Sensor, Source, SourceLaw};
use crate::elements::torsion_spring::TorsionSpring;
use crate::elements::tsda::Tsda;
use crate::elements::universal::Universal;
use crate::geometry::{F64, Geometry};
use crate::laws::Laws as _;
use crate::model::{Group, ModelOwner, ModelRef, Terms};
use crate::plant::Plant;
use crate::plant::base::Base;
use crate::real::Real;
use crate::schemes::Scheme;
use crate::words::{Fnv1a, Word, WordVisitor, Words};

impl<H, S> Plant<H, S>
where
    H: Deref<Target: ModelOwner + Sized>,
    S: Scheme,
{
    /// FNV-1a 64 over the model's constants and initial state, its precision and the step: what a state belongs to.
    #[must_use]
    pub fn fingerprint(&self) -> u64 {
        self.base.fingerprint()
    }
}

impl<H> Base<H>
where
    H: Deref<Target: ModelOwner + Sized>,
{
    /// The fingerprint of model, precision and step.
    pub(crate) fn fingerprint(&self) -> u64 {
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
        hash.word(Word::F64(self.step_size));
        visit_model(&self.model.view(), &mut hash);
        self.model.initial().iter().for_each(|state| state.visit(&mut hash));
        hash.finish()
    }
}

/// FNV-1a 64 over the scheme's name, its damping method, its evaluations per step, which identify its Newton
/// iterations, and its other parameters, folded to 32 bits.
pub(crate) fn scheme_fingerprint<S: Scheme>(scheme: &S) -> u32 {
    let mut hash = Fnv1a::new();
    for byte in S::NAME.bytes().chain(S::DAMPING.name().bytes()) {
        hash.word(Word::I32(i32::from(byte)));
    }
    hash.word(Word::U64(u64::from(scheme.evaluations())));
    scheme.visit_parameters(&mut hash);
    let hash = hash.finish();
    (hash >> 32) as u32 ^ hash as u32
}

/// FNV-1a 64 over a model's constants, each number rounded to single precision: the same for a scene in every
/// precision, independent of the scheme, the step and the initial state.
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
fn visit_model<P: Geometry, T: Terms<P>>(
    model: &ModelRef<'_, P, T>,
    visitor: &mut impl WordVisitor,
) {
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
        sources,
        laws,
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
    for &Group { law, a, b, triples, arms, shared, point, element, damper, clearance } in *groups {
        integer(law as u64);
        integer(u64::from(a.0) << 16 | u64::from(b.0));
        integer(u64::from(triples) << 16 | u64::from(arms) << 8 | shared as u64);
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
    // All other constants of a body are derived from these two, and zero where it is driven.
    for body in *bodies {
        visitor.word(body.mass.word());
        body.inertia.visit(visitor);
        if T::DRIVEN && body.is_driven() {
            visitor.word(Word::U64(1));
        }
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
        // Bodies and damper are included above.
        let TorsionSpring { a: _, b: _, damper: _, axis, reference, stiffness, preload } = spring;
        axis.visit(visitor);
        reference.visit(visitor);
        visitor.word(stiffness.word());
        visitor.word(preload.word());
    }
    for load in *loads {
        // Body and frame are included above.
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
    // Added later, after the others: a model without them keeps its hash.
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
    sources.iter().for_each(|source| visit_source(source, visitor));
    laws.look_at_all(&laws.states(), &mut |_, law| {
        law.name().bytes().for_each(|byte| visitor.word(Word::I32(i32::from(byte))));
        law.visit(visitor);
    });
}

fn visit_source<P: Geometry>(source: &Source<P>, visitor: &mut impl WordVisitor) {
    let Source { input, knot, knots, law } = source;
    let mut integers = |kind: u64, numbers: [u16; 3]| {
        let packed = numbers.into_iter().fold(kind, |all, number| all << 16 | u64::from(number));
        visitor.word(Word::U64(packed));
    };
    match law {
        SourceLaw::Sine { period, phase, amplitude, rate, offset } => {
            integers(0, [input.0, *knot, *knots]);
            visitor.word(Word::F64(*period));
            visitor.word(Word::F64(*phase));
            [amplitude, rate, offset].into_iter().for_each(|one| visitor.word(one.word()));
        }
        SourceLaw::Periodic { period } => {
            integers(1, [input.0, *knot, *knots]);
            visitor.word(Word::F64(*period));
        }
        SourceLaw::Over { sensor, weights, offset } => {
            integers(2, [input.0, *knot, *knots]);
            match *sensor {
                Sensor::Angle { spring, offset } => {
                    integers(0, [spring.0, 0, 0]);
                    visitor.word(offset.word());
                }
                Sensor::Rate { spring } => integers(1, [spring.0, 0, 0]),
                Sensor::Point { body, point } => {
                    integers(2, [body.0, 0, 0]);
                    point.visit(visitor);
                }
                Sensor::Velocity { body, point } => {
                    integers(3, [body.0, 0, 0]);
                    point.visit(visitor);
                }
            }
            weights.iter().chain([offset]).for_each(|one| visitor.word(one.word()));
        }
    }
}

fn visit_input<P: Geometry>(input: &Input<P>, visitor: &mut impl WordVisitor) {
    let mut integers = |kind: u64, first: u16, second: u16| {
        visitor.word(Word::U64(kind << 32 | u64::from(first) << 16 | u64::from(second)));
    };
    let Input { kind, value, knot, knots, range } = input;
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
        InputKind::JointTorque { a, b, axes } => {
            integers(4, a.0, b.0);
            for axis in axes {
                axis.visit(visitor);
            }
        }
        InputKind::JointForce { a, b, point, axis } => {
            integers(8, a.0, b.0);
            point.visit(visitor);
            axis.visit(visitor);
        }
        InputKind::Actuator { group, element } => integers(5, group.0, *element),
        InputKind::Signal => integers(7, 0, 0),
        InputKind::Gravity { direction } => {
            integers(9, 0, 0);
            direction.visit(visitor);
        }
        InputKind::Velocity { body, direction } => {
            integers(10, body.0, 0);
            direction.visit(visitor);
        }
        InputKind::AngularVelocity { body, axis } => {
            integers(11, body.0, 0);
            axis.visit(visitor);
        }
        InputKind::Anchor { direction } => {
            integers(6, 0, 0);
            direction.visit(visitor);
        }
    }
    visitor.word(value.word());
    visitor.word(Word::U64(u64::from(*knot) << 16 | u64::from(*knots)));
    // Omitted without bounds, so that the hash is that from before bounds existed.
    if range.iter().any(|bound| bound.is_finite()) {
        range.iter().for_each(|bound| visitor.word(bound.word()));
    }
}
