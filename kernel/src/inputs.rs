//! Inputs: what a controller, a road or a table does to a plant at run time.
//!
//! `(input, signal, frames) => wrenches | the motion of ground points`. A signal is sampled for
//! the start of a step, when the one before it ends, and held for all its stages: what is read
//! between two steps is what the next one begins with. It is set by the caller, or follows a table
//! that is held or linear between its knots:
//! `value + slope·((n − first)·h + offset)`, n the step, `first` the knot's first step and
//! `offset` what lies between the knot's time and that step. Forces and torques of inputs are
//! added after the loads, in ascending order.

use crate::elements::load::LoadFrame;
use crate::forces::{Record, Wrench, apply};
use crate::geometry::Geometry;
use crate::groups::{End, Places, placed};
use crate::model::{BodyIndex, ModelRef, Terms};
use crate::real::Real;
use crate::vector::Vec3;
use crate::words::{WordSource, WordVisitor, Words};

/// The index of an input.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
#[cfg_attr(feature = "defmt", derive(defmt::Format))]
pub struct InputIndex(pub u16);

/// What an input's signal does.
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum InputKind<P: Geometry> {
    /// A force \[N\] along a direction at a point of a body.
    Force {
        /// The body.
        body: BodyIndex,
        /// The point in body axes.
        point: P::Local,
        /// Unit direction.
        direction: Vec3<P::Real>,
        /// The direction's axes.
        frame: LoadFrame,
    },
    /// A torque \[N·m\] about an axis on a body.
    Torque {
        /// The body.
        body: BodyIndex,
        /// Unit axis.
        axis: Vec3<P::Real>,
        /// The axis' axes.
        frame: LoadFrame,
    },
    /// A torque \[N·m\] on B about an axis of A, on A the opposite.
    JointTorque {
        /// First body.
        a: BodyIndex,
        /// Second body.
        b: BodyIndex,
        /// Unit axis in A's axes.
        axis: Vec3<P::Real>,
    },
    /// A tension \[N\] along a TSDA beside its spring's: the actuator of the TSDA.
    Actuator {
        /// The TSDA's group.
        group: u16,
        /// Its place in the group.
        element: u16,
    },
    /// A displacement \[m\] of ground points along a direction, with its rate \[m/s\]. The points
    /// are those of the elements whose body is [`BodyIndex::anchor`] of this input.
    Anchor {
        /// Unit direction, world axes.
        direction: Vec3<P::Real>,
    },
}

/// An input of a model.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Input<P: Geometry> {
    /// What its signal does.
    pub kind: InputKind<P>,
    /// Its value at t = 0 where no table drives it.
    pub value: P::Real,
    /// Its first knot among the model's knots.
    pub knot: u16,
    /// The number of its knots; 0 where the caller drives it.
    pub knots: u16,
}

impl<P: Geometry> Input<P> {
    /// Whether the precision holds its value and its table; `knots` are those of all inputs.
    #[must_use]
    pub fn is_finite(&self, knots: &[Knot<P::Real>]) -> bool {
        let first = self.knot as usize;
        let knots = knots.get(first..first + self.knots as usize).unwrap_or(&[]);
        let mut rows = knots.iter().enumerate();
        self.value.is_finite() && rows.all(|(i, knot)| knot.is_finite(knots.get(i + 1)))
    }

    /// The same input in another precision.
    pub fn convert<Q: Geometry>(&self) -> Input<Q> {
        let vector = |v: Vec3<P::Real>| Vec3::from_f64(v.to_f64());
        let kind = match self.kind {
            InputKind::Force { body, point, direction, frame } => InputKind::Force {
                body,
                point: Q::local_from_f64(P::local_to_f64(&point)),
                direction: vector(direction),
                frame,
            },
            InputKind::Torque { body, axis, frame } => {
                InputKind::Torque { body, axis: vector(axis), frame }
            }
            InputKind::JointTorque { a, b, axis } => {
                InputKind::JointTorque { a, b, axis: vector(axis) }
            }
            InputKind::Actuator { group, element } => InputKind::Actuator { group, element },
            InputKind::Anchor { direction } => InputKind::Anchor { direction: vector(direction) },
        };
        let value = Q::Real::from_f64(self.value.to_f64());
        Input { kind, value, knot: self.knot, knots: self.knots }
    }
}

/// A knot of an input's table.
#[derive(Clone, Copy, Debug, PartialEq)]
#[cfg_attr(feature = "defmt", derive(defmt::Format))]
pub struct Knot<R> {
    /// \[s\] from when it holds.
    pub time: f64,
    /// The value at its time.
    pub value: R,
    /// The value's rate \[1/s\] until the next knot; 0 where the table is held.
    pub slope: R,
}

impl<R: Real> Knot<R> {
    /// Knot `i` of a table of (time \[s\], value) with ascending times; `None` beyond its end.
    pub fn of_table(table: &[[f64; 2]], i: usize, linear: bool) -> Option<Self> {
        let [time, value] = *table.get(i)?;
        let slope = match table.get(i + 1) {
            Some([next, then]) if linear => (then - value) / (next - time),
            _ => 0.0,
        };
        Some(Self { time, value: R::from_f64(value), slope: R::from_f64(slope) })
    }

    /// Whether the precision holds every value from t = 0 to the next knot, and what makes it up.
    #[must_use]
    pub fn is_finite(&self, next: Option<&Self>) -> bool {
        let slope = self.slope.to_f64();
        let rise = match next {
            Some(next) if slope != 0.0 => slope * (next.time - self.time),
            _ => 0.0,
        };
        // A table may begin long before the first step.
        let begun = if self.time < 0.0 { self.time } else { 0.0 };
        self.value.is_finite()
            && self.slope.is_finite()
            && [rise, begun].into_iter().all(|number| R::from_f64(number).is_finite())
    }

    /// The same knot in another precision.
    pub fn convert<Q: Real>(&self) -> Knot<Q> {
        let (value, slope) = (self.value.to_f64(), self.slope.to_f64());
        Knot { time: self.time, value: Q::from_f64(value), slope: Q::from_f64(slope) }
    }
}

/// Where a knot lies among a plant's steps.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
#[cfg_attr(feature = "defmt", derive(defmt::Format))]
pub struct KnotStep<R> {
    /// The first step that starts at or after the knot's time.
    pub first: u64,
    /// \[s\] from the knot's time to that step's start.
    pub offset: R,
}

impl<R: Real> KnotStep<R> {
    /// The place of a knot at `time` \[s\] among steps of `step` \[s\].
    #[must_use]
    pub fn new(time: f64, step: f64) -> Self {
        let first = crate::elements::load::first_step(time, step);
        Self { first, offset: R::from_f64(first as f64 * step - time) }
    }
}

/// The present value of an input and its rate.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
#[cfg_attr(feature = "defmt", derive(defmt::Format))]
pub struct Signal<R> {
    /// N, N·m or m.
    pub value: R,
    /// m/s, of an anchor; unused by other kinds.
    pub rate: R,
}

impl<R: Real> Signal<R> {
    /// The same signal in another precision.
    pub fn convert<Q: Real>(&self) -> Signal<Q> {
        Signal { value: Q::from_f64(self.value.to_f64()), rate: Q::from_f64(self.rate.to_f64()) }
    }
}

impl<R: Real> Words for Signal<R> {
    fn visit(&self, visitor: &mut impl WordVisitor) {
        visitor.word(self.value.word());
        visitor.word(self.rate.word());
    }

    fn fill(&mut self, source: &mut impl WordSource) {
        self.value = R::from_words(source);
        self.rate = R::from_words(source);
    }
}

/// Brings the signals of tables to step `n`; whether any changed.
#[inline]
pub(crate) fn sample<P: Geometry>(
    inputs: &[Input<P>],
    knots: &[Knot<P::Real>],
    steps: &[KnotStep<P::Real>],
    n: u64,
    h: P::Real,
    signals: &mut [Signal<P::Real>],
) -> bool {
    let mut changed = false;
    for (input, signal) in inputs.iter().zip(signals) {
        let range = input.knot as usize..input.knot as usize + input.knots as usize;
        let (Some(knots), Some(steps)) = (knots.get(range.clone()), steps.get(range)) else {
            continue;
        };
        let Some(now) = table(knots, steps, n, h) else { continue };
        changed |= now != *signal;
        *signal = now;
    }
    changed
}

/// The value of a table at step `n`: that of its first knot before it, `None` without knots.
#[inline]
fn table<R: Real>(knots: &[Knot<R>], steps: &[KnotStep<R>], n: u64, h: R) -> Option<Signal<R>> {
    let begun = steps.partition_point(|knot| knot.first <= n);
    let Some(row) = begun.checked_sub(1) else {
        return knots.first().map(|knot| Signal { value: knot.value, rate: R::ZERO });
    };
    let (knot, step) = (knots.get(row)?, steps.get(row)?);
    let since = R::from_u64(n - step.first) * h + step.offset;
    Some(Signal { value: knot.value + knot.slope * since, rate: knot.slope })
}

/// The forces and torques of inputs.
#[inline(always)]
pub(crate) fn push<P: Geometry, T: Terms>(
    model: &ModelRef<'_, P, T>,
    places: Places<'_, P>,
    wrenches: &mut [Wrench<P::Real>],
) {
    let turned = |body: BodyIndex, frame: LoadFrame, v: Vec3<P::Real>| match frame {
        LoadFrame::World => v,
        LoadFrame::Body => End::new(model, places, body, None).to_world(v),
    };
    for (input, signal) in model.inputs.iter().zip(places.signals) {
        let value = signal.value;
        let zero = Vec3::ZERO;
        match input.kind {
            InputKind::Force { body, point, direction, frame } => {
                let force = turned(body, frame, direction) * value;
                let (_, arm) = End::new(model, places, body, None).place(&point);
                let record = Record { force, torque_a: arm.cross(force), torque_b: zero };
                apply(wrenches, body.row(), BodyIndex::WORLD.row(), &record);
            }
            InputKind::Torque { body, axis, frame } => {
                let torque_a = turned(body, frame, axis) * value;
                let record = Record { force: zero, torque_a, torque_b: zero };
                apply(wrenches, body.row(), BodyIndex::WORLD.row(), &record);
            }
            InputKind::JointTorque { a, b, axis } => {
                let torque_b = turned(a, LoadFrame::Body, axis) * value;
                let record = Record { force: zero, torque_a: -torque_b, torque_b };
                apply(wrenches, a.row(), b.row(), &record);
            }
            InputKind::Actuator { group, element } => {
                let row = group as usize;
                let element = model
                    .groups
                    .get(row)
                    .and_then(|group| placed(model, places, (row, group), element as usize));
                let Some(element) = element else { continue };
                let d = element.displacement;
                let force = d * (value * d.dot(d).sqrt().reciprocal_or_zero());
                let torque_a = element.arm_a.cross(force);
                let record = Record { force, torque_a, torque_b: -element.arm_b.cross(force) };
                apply(wrenches, element.group.a.row(), element.group.b.row(), &record);
            }
            InputKind::Anchor { .. } => {}
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    fn values(linear: bool, step: f64) -> [f64; 6] {
        let (slope0, slope1) = if linear { (10.0, -5.0) } else { (0.0, 0.0) };
        let knots = [
            Knot { time: 0.1, value: 1.0, slope: slope0 },
            Knot { time: 0.2, value: 2.0, slope: slope1 },
            Knot { time: 0.4, value: 1.0, slope: 0.0 },
        ];
        let steps = knots.map(|knot| KnotStep::new(knot.time, step));
        [0.0, 0.1, 0.15, 0.25, 0.4, 9.0].map(|time: f64| {
            let n = libm::round(time / step) as u64;
            table(&knots, &steps, n, step).unwrap().value
        })
    }

    #[test]
    fn tables_are_held_or_linear() {
        assert_eq!(values(false, 0.01), [1.0, 1.0, 1.0, 2.0, 1.0, 1.0]);
        let expected = [1.0, 1.0, 1.5, 1.75, 1.0, 1.0];
        for (value, expected) in values(true, 0.01).into_iter().zip(expected) {
            assert!((value - expected).abs() < 1e-12, "{value} {expected}");
        }
    }

    #[test]
    fn a_knot_between_two_steps_begins_at_the_later_with_its_value_there() {
        let knots = [
            Knot { time: 0.0, value: 0.0_f64, slope: 0.0 },
            Knot { time: 0.015, value: 0.0, slope: 2.0 },
        ];
        let steps = knots.map(|knot| KnotStep::new(knot.time, 0.01));
        let at = |n| table(&knots, &steps, n, 0.01).unwrap();
        assert_eq!((at(1).value, at(1).rate), (0.0, 0.0));
        assert!((at(2).value - 0.01).abs() < 1e-15 && at(2).rate == 2.0);
    }
}
