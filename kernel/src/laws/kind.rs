//! The kinds of constants of laws: how each is stored, rounded, hashed, read and written.

use core::fmt::Debug;

use crate::geometry::{F64, Geometry};
use crate::index::{GroupIndex, InputIndex};
use crate::laws::curve::Curve;
use crate::laws::hinge::Hinge;
use crate::laws::ldl::Ldl;
use crate::laws::term::{CoordinateKind, MAX_TERMS, Term};
use crate::real::Real as _;
use crate::space::{Linear as _, Space, Turn as _};
use crate::vector::{Quaternion, Vec3};
use crate::words::{Word, WordVisitor, Words as _};

/// A constant of a law: its name, its kind's name, its units, its description.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Field {
    /// The key in a scene.
    pub name: &'static str,
    /// [`Kind::NAME`].
    pub kind: &'static str,
    /// Units as in scenes, for example `N/m`; `1` without one. A table has two; a matrix has four, those of its blocks
    /// row by row.
    pub units: &'static [&'static str],
    /// \[unit of the field, SI\] the default of a number; of a table its value at any x.
    pub default: Option<f64>,
    /// Its description, from its documentation.
    pub about: &'static str,
}

/// Provides constants by name, in double precision, in the axes they are stored in. A source that returns `None` has
/// refused the constant and records why.
pub trait FieldSource {
    /// A number in the field's SI unit.
    fn number(&mut self, field: &Field) -> Option<f64>;
    /// A whole number; for the kind `signal` the row of an input, for the kind `joint` that of a group.
    fn count(&mut self, field: &Field) -> Option<u32>;
    /// \[m\] a point of A and a point of B, each in the axes of its body.
    fn points(&mut self, field: &Field) -> Option<[[f64; 3]; 2]>;
    /// \[1\] a unit vector in the axes of A.
    fn normal(&mut self, field: &Field) -> Option<[f64; 3]>;
    /// \[1\] a unit axis in the axes of A, and the inverse of B's orientation in A at t = 0, scalar first. An axis of
    /// the kind `axle` is fixed in B, given at t = 0.
    fn axis(&mut self, field: &Field) -> Option<([f64; 3], [f64; 4])>;
    /// Writes knots with ascending x to the front of `to`; returns their number.
    fn table(&mut self, field: &Field, to: &mut [[f64; 2]]) -> Option<usize>;
    /// A symmetric positive semi-definite matrix.
    fn matrix(&mut self, field: &Field) -> Option<Ldl<f64>>;
    /// Terms of a sum, the present ones first.
    fn terms(&mut self, field: &Field) -> Option<[Option<Term>; MAX_TERMS]>;
}

/// Accepts constants by name, in double precision.
pub trait FieldSink {
    /// A number.
    fn number(&mut self, field: &Field, value: f64);
    /// A whole number.
    fn count(&mut self, field: &Field, value: u32);
    /// Points of A and of B.
    fn points(&mut self, field: &Field, points: [[f64; 3]; 2]);
    /// A unit vector.
    fn normal(&mut self, field: &Field, normal: [f64; 3]);
    /// An axis and a reference.
    fn axis(&mut self, field: &Field, axis: [f64; 3], reference: [f64; 4]);
    /// Knots, and their largest number.
    fn table(&mut self, field: &Field, knots: &[[f64; 2]], capacity: usize);
    /// A symmetric positive semi-definite matrix.
    fn matrix(&mut self, field: &Field, matrix: &Ldl<f64>);
    /// Terms of a sum.
    fn terms(&mut self, field: &Field, terms: &[Option<Term>; MAX_TERMS]);
}

/// A kind of constant.
pub trait Kind {
    /// The stored form in a precision.
    type In<P: Geometry>: Copy + Debug + PartialEq + Send + Sync + 'static;
    /// The kind's name.
    const NAME: &'static str;

    /// Rounded once from double precision.
    fn rounded<P: Geometry>(of: &Self::In<F64>) -> Self::In<P>;
    /// Visits its words.
    fn visit<P: Geometry>(of: &Self::In<P>, visitor: &mut dyn WordVisitor);
    /// Reads it from a source.
    fn read_from(field: &Field, source: &mut dyn FieldSource) -> Option<Self::In<F64>>;
    /// Writes it to a sink.
    fn write_to(of: &Self::In<F64>, field: &Field, sink: &mut dyn FieldSink);
}

/// Adapts a visitor given as a trait object.
struct Hand<'v>(&'v mut dyn WordVisitor);

impl WordVisitor for Hand<'_> {
    fn word(&mut self, word: Word) {
        self.0.word(word);
    }
}

/// A number: `P::Real`.
#[derive(Clone, Copy, Debug)]
pub struct Number;

impl Kind for Number {
    type In<P: Geometry> = P::Real;
    const NAME: &'static str = "number";

    fn rounded<P: Geometry>(of: &f64) -> P::Real {
        P::Real::from_f64(*of)
    }
    fn visit<P: Geometry>(of: &P::Real, visitor: &mut dyn WordVisitor) {
        visitor.word(of.word());
    }
    fn read_from(field: &Field, source: &mut dyn FieldSource) -> Option<f64> {
        source.number(field)
    }
    fn write_to(of: &f64, field: &Field, sink: &mut dyn FieldSink) {
        sink.number(field, *of);
    }
}

/// A whole number: `u32`.
#[derive(Clone, Copy, Debug)]
pub struct Count;

impl Kind for Count {
    type In<P: Geometry> = u32;
    const NAME: &'static str = "count";

    fn rounded<P: Geometry>(of: &u32) -> u32 {
        *of
    }
    fn visit<P: Geometry>(of: &u32, visitor: &mut dyn WordVisitor) {
        visitor.word(Word::I32(*of as i32));
    }
    fn read_from(field: &Field, source: &mut dyn FieldSource) -> Option<u32> {
        source.count(field)
    }
    fn write_to(of: &u32, field: &Field, sink: &mut dyn FieldSink) {
        sink.count(field, *of);
    }
}

/// An input of the model that the law reads: [`InputIndex`].
#[derive(Clone, Copy, Debug)]
pub struct Signal;

impl Kind for Signal {
    type In<P: Geometry> = InputIndex;
    const NAME: &'static str = "signal";

    fn rounded<P: Geometry>(of: &InputIndex) -> InputIndex {
        *of
    }
    fn visit<P: Geometry>(of: &InputIndex, visitor: &mut dyn WordVisitor) {
        visitor.word(Word::I32(i32::from(of.0)));
    }
    fn read_from(field: &Field, source: &mut dyn FieldSource) -> Option<InputIndex> {
        source.count(field).and_then(|input| u16::try_from(input).ok()).map(InputIndex)
    }
    fn write_to(of: &InputIndex, field: &Field, sink: &mut dyn FieldSink) {
        sink.count(field, u32::from(of.0));
    }
}

/// A group of the model whose force the law bears: [`GroupIndex`], see
/// [`Interaction::group`](crate::laws::Interaction::group).
#[derive(Clone, Copy, Debug)]
pub struct JointGroup;

impl Kind for JointGroup {
    type In<P: Geometry> = GroupIndex;
    const NAME: &'static str = "joint";

    fn rounded<P: Geometry>(of: &GroupIndex) -> GroupIndex {
        *of
    }
    fn visit<P: Geometry>(of: &GroupIndex, visitor: &mut dyn WordVisitor) {
        visitor.word(Word::I32(i32::from(of.0)));
    }
    fn read_from(field: &Field, source: &mut dyn FieldSource) -> Option<GroupIndex> {
        source.count(field).and_then(|group| u16::try_from(group).ok()).map(GroupIndex)
    }
    fn write_to(of: &GroupIndex, field: &Field, sink: &mut dyn FieldSink) {
        sink.count(field, u32::from(of.0));
    }
}

/// A point of A and a point of B: `[P::Local; 2]`.
#[derive(Clone, Copy, Debug)]
pub struct Points;

impl Kind for Points {
    type In<P: Geometry> = [P::Local; 2];
    const NAME: &'static str = "points";

    fn rounded<P: Geometry>(of: &[Vec3<f64>; 2]) -> [P::Local; 2] {
        of.map(|point| P::local_from_f64(F64::local_to_f64(&point)))
    }
    fn visit<P: Geometry>(of: &[P::Local; 2], visitor: &mut dyn WordVisitor) {
        of.iter().for_each(|point| point.visit(&mut Hand(visitor)));
    }
    fn read_from(field: &Field, source: &mut dyn FieldSource) -> Option<[Vec3<f64>; 2]> {
        Some(source.points(field)?.map(F64::local_from_f64))
    }
    fn write_to(of: &[Vec3<f64>; 2], field: &Field, sink: &mut dyn FieldSink) {
        sink.points(field, of.map(|point| F64::local_to_f64(&point)));
    }
}

/// A unit vector in the axes of A: `P::Vector`.
#[derive(Clone, Copy, Debug)]
pub struct Normal;

impl Kind for Normal {
    type In<P: Geometry> = P::Vector;
    const NAME: &'static str = "normal";

    fn rounded<P: Geometry>(of: &Vec3<f64>) -> P::Vector {
        P::Vector::from_f64(of.to_f64())
    }
    fn visit<P: Geometry>(of: &P::Vector, visitor: &mut dyn WordVisitor) {
        of.visit(&mut Hand(visitor));
    }
    fn read_from(field: &Field, source: &mut dyn FieldSource) -> Option<Vec3<f64>> {
        Some(Vec3::from_f64(source.normal(field)?))
    }
    fn write_to(of: &Vec3<f64>, field: &Field, sink: &mut dyn FieldSink) {
        sink.normal(field, of.to_f64());
    }
}

/// An axis about which B rotates in A: [`Hinge`].
#[derive(Clone, Copy, Debug)]
pub struct Axis;

impl Kind for Axis {
    type In<P: Geometry> = Hinge<P::Space>;
    const NAME: &'static str = "axis";

    fn rounded<P: Geometry>(of: &Hinge<f64>) -> Hinge<P::Space> {
        Hinge {
            axis: P::Moment::from_f64(of.axis.to_f64()),
            reference: TurnIn::<P>::from_f64(of.reference.to_f64()),
        }
    }
    fn visit<P: Geometry>(of: &Hinge<P::Space>, visitor: &mut dyn WordVisitor) {
        of.axis.visit(&mut Hand(visitor));
        of.reference.visit(&mut Hand(visitor));
    }
    fn read_from(field: &Field, source: &mut dyn FieldSource) -> Option<Hinge<f64>> {
        let (axis, reference) = source.axis(field)?;
        Some(Hinge { axis: Vec3::from_f64(axis), reference: Quaternion::from_f64(reference) })
    }
    fn write_to(of: &Hinge<f64>, field: &Field, sink: &mut dyn FieldSink) {
        sink.axis(field, of.axis.to_f64(), of.reference.to_f64());
    }
}

/// An axis fixed in B: [`Hinge`], as an [`Axis`]; [`Hinge::of_b`] is the axis in B.
#[derive(Clone, Copy, Debug)]
pub struct Axle;

impl Kind for Axle {
    type In<P: Geometry> = Hinge<P::Space>;
    const NAME: &'static str = "axle";

    fn rounded<P: Geometry>(of: &Hinge<f64>) -> Hinge<P::Space> {
        Axis::rounded::<P>(of)
    }
    fn visit<P: Geometry>(of: &Hinge<P::Space>, visitor: &mut dyn WordVisitor) {
        Axis::visit::<P>(of, visitor);
    }
    fn read_from(field: &Field, source: &mut dyn FieldSource) -> Option<Hinge<f64>> {
        Axis::read_from(field, source)
    }
    fn write_to(of: &Hinge<f64>, field: &Field, sink: &mut dyn FieldSink) {
        Axis::write_to(of, field, sink);
    }
}

type TurnIn<P> = <<P as Geometry>::Space as Space>::Turn;

/// A piecewise linear function of at most `N` knots: [`Curve`].
#[derive(Clone, Copy, Debug)]
pub struct Table<const N: usize>;

impl<const N: usize> Kind for Table<N> {
    type In<P: Geometry> = Curve<P::Real, N>;
    const NAME: &'static str = "table";

    fn rounded<P: Geometry>(of: &Curve<f64, N>) -> Curve<P::Real, N> {
        Curve { knots: of.knots.map(|knot| knot.map(P::Real::from_f64)), count: of.count }
    }
    fn visit<P: Geometry>(of: &Curve<P::Real, N>, visitor: &mut dyn WordVisitor) {
        of.known().iter().flatten().for_each(|number| visitor.word(number.word()));
    }
    fn read_from(field: &Field, source: &mut dyn FieldSource) -> Option<Curve<f64, N>> {
        let mut knots = [[0.0; 2]; N];
        let count = source.table(field, &mut knots)?;
        Some(Curve { knots, count: count as u16 })
    }
    fn write_to(of: &Curve<f64, N>, field: &Field, sink: &mut dyn FieldSink) {
        sink.table(field, of.known(), N);
    }
}

/// A symmetric positive semi-definite matrix over three displacements and three rotations: [`Ldl`].
#[derive(Clone, Copy, Debug)]
pub struct Matrix;

impl Kind for Matrix {
    type In<P: Geometry> = Ldl<P::Real>;
    const NAME: &'static str = "matrix";

    fn rounded<P: Geometry>(of: &Ldl<f64>) -> Ldl<P::Real> {
        of.rounded()
    }
    fn visit<P: Geometry>(of: &Ldl<P::Real>, visitor: &mut dyn WordVisitor) {
        of.diagonal.iter().chain(&of.below).for_each(|number| visitor.word(number.word()));
    }
    fn read_from(field: &Field, source: &mut dyn FieldSource) -> Option<Ldl<f64>> {
        source.matrix(field)
    }
    fn write_to(of: &Ldl<f64>, field: &Field, sink: &mut dyn FieldSink) {
        sink.matrix(field, of);
    }
}

/// The terms of a sum: `[Option<Term<P>>; MAX_TERMS]`, the present ones first.
#[derive(Clone, Copy, Debug)]
pub struct Terms;

impl Kind for Terms {
    type In<P: Geometry> = [Option<Term<P>>; MAX_TERMS];
    const NAME: &'static str = "terms";

    fn rounded<P: Geometry>(of: &Self::In<F64>) -> Self::In<P> {
        of.map(|term| {
            let Term { bodies, factor, way } = term?;
            let way = match way {
                CoordinateKind::Turn(axis) => CoordinateKind::Turn(Axis::rounded::<P>(&axis)),
                CoordinateKind::Travel { points, axis } => CoordinateKind::Travel {
                    points: Points::rounded::<P>(&points),
                    axis: Normal::rounded::<P>(&axis),
                },
            };
            Some(Term { bodies, factor: P::Real::from_f64(factor), way })
        })
    }
    fn visit<P: Geometry>(of: &Self::In<P>, visitor: &mut dyn WordVisitor) {
        for Term { bodies: [a, b], factor, way } in of.iter().flatten() {
            visitor.word(Word::U64(u64::from(a.0) << 16 | u64::from(b.0)));
            visitor.word(factor.word());
            match way {
                CoordinateKind::Turn(axis) => Axis::visit::<P>(axis, &mut Hand(visitor)),
                CoordinateKind::Travel { points, axis } => {
                    Points::visit::<P>(points, &mut Hand(visitor));
                    Normal::visit::<P>(axis, &mut Hand(visitor));
                }
            }
        }
    }
    fn read_from(field: &Field, source: &mut dyn FieldSource) -> Option<Self::In<F64>> {
        source.terms(field)
    }
    fn write_to(of: &Self::In<F64>, field: &Field, sink: &mut dyn FieldSink) {
        sink.terms(field, of);
    }
}

/// The first of the numbers, if any: the default of a field.
#[doc(hidden)]
#[must_use]
pub const fn first(numbers: &[f64]) -> Option<f64> {
    match numbers {
        [first, ..] => Some(*first),
        [] => None,
    }
}
