//! Inputs: the action of a signal on a mechanism, and its table.
//!
//! `scene => constants`. A signal is a force, a torque, a tension, a field of gravity or a displacement of the ground;
//! it is set by the caller or follows knots that are held or linear, see [`crate::schedule`].

use crate::elements::load::LoadFrame;
use crate::geometry::Geometry;
use crate::index::{BodyIndex, GroupIndex};
use crate::real::Real;
use crate::space::Linear as _;

/// The action of an input's signal.
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum InputKind<P: Geometry> {
    /// A force \[N\] along a direction at a point of a body.
    Force {
        /// The body.
        body: BodyIndex,
        /// The point in body axes.
        point: P::Local,
        /// Unit direction.
        direction: P::Vector,
        /// The direction's axes.
        frame: LoadFrame,
    },
    /// A torque \[N·m\] about an axis on a body.
    Torque {
        /// The body.
        body: BodyIndex,
        /// Unit axis.
        axis: P::Moment,
        /// The axes in which `axis` is given.
        frame: LoadFrame,
    },
    /// A torque \[N·m\] on B along the gradient of its rotation about an axis of A, on A the opposite. Its power is the
    /// torque times the rate of that rotation, as for a torsion spring; about either body's axis alone it would be a
    /// circulatory force (Ziegler 1953).
    JointTorque {
        /// First body.
        a: BodyIndex,
        /// Second body.
        b: BodyIndex,
        /// Unit axis at t = 0, in A's and in B's axes.
        axes: [P::Moment; 2],
    },
    /// A force \[N\] on B at one of its points along an axis of A, on A the opposite along the same line. Its power is
    /// the force times the rate of the point's travel along that axis.
    JointForce {
        /// First body.
        a: BodyIndex,
        /// Second body.
        b: BodyIndex,
        /// The point of B, in its axes.
        point: P::Local,
        /// Unit axis, in A's axes.
        axis: P::Vector,
    },
    /// A tension \[N\] along a TSDA in addition to its spring's: an actuator.
    Actuator {
        /// The TSDA's group.
        group: GroupIndex,
        /// Its index in the group.
        element: u16,
    },
    /// A uniform field of gravity \[m/s²\] in addition to the model's: mass times value along a direction at every
    /// centre of mass.
    Gravity {
        /// Unit direction, world axes.
        direction: P::Vector,
    },
    /// A velocity \[m/s\] of the centre of mass of a [driven](crate::Body::driven) body along a direction.
    Velocity {
        /// The body.
        body: BodyIndex,
        /// Unit direction, world axes.
        direction: P::Vector,
    },
    /// An angular velocity \[rad/s\] of a [driven](crate::Body::driven) body about an axis.
    AngularVelocity {
        /// The body.
        body: BodyIndex,
        /// Unit axis, world axes.
        axis: P::Moment,
    },
    /// A number that laws read, see [`crate::laws::Seen::signal`]; it exerts no force itself.
    Signal,
    /// A displacement \[m\] of ground points along a direction, with its rate \[m/s\]. The points
    /// are those of the elements whose body is [`BodyIndex::anchor`] of this input.
    Anchor {
        /// Unit direction, world axes.
        direction: P::Vector,
    },
}

/// An input of a model.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Input<P: Geometry> {
    /// The action of its signal.
    pub kind: InputKind<P>,
    /// \[N, N·m, m/s², m/s, rad/s or m\] its value at t = 0 where no table drives it.
    pub value: P::Real,
    /// Its first knot among the model's knots.
    pub knot: u16,
    /// The number of its knots; 0 where the caller drives it.
    pub knots: u16,
    /// \[as its value\] the smallest and the largest value; a set value is clamped to them. Infinite without bounds.
    pub range: [P::Real; 2],
}

impl<P: Geometry> Input<P> {
    /// Whether it moves the ground.
    #[inline]
    pub(crate) fn moves_ground(&self) -> bool {
        matches!(self.kind, InputKind::Anchor { .. })
    }

    /// A value clamped to its range.
    #[inline]
    #[must_use]
    pub fn bounded(&self, value: P::Real) -> P::Real {
        let [least, most] = self.range;
        let value = P::Real::pick(most.less_than(value), most, value);
        P::Real::pick(value.less_than(least), least, value)
    }

    /// Whether its value and its table are representable in the precision; `knots` are those of all inputs.
    #[must_use]
    pub fn is_finite(&self, knots: &[Knot<P::Real>]) -> bool {
        let first = self.knot as usize;
        let knots = knots.get(first..first + self.knots as usize).unwrap_or(&[]);
        let mut rows = knots.iter().enumerate();
        let [least, most] = self.range;
        self.value.is_finite()
            && least <= most
            && rows.all(|(i, knot)| knot.is_finite(knots.get(i + 1)))
    }

    /// The same input in another precision.
    pub fn convert<Q: Geometry>(&self) -> Input<Q> {
        let vector = |v: P::Vector| Q::Vector::from_f64(v.to_f64());
        let moment = |m: P::Moment| Q::Moment::from_f64(m.to_f64());
        let kind = match self.kind {
            InputKind::Force { body, point, direction, frame } => InputKind::Force {
                body,
                point: Q::local_from_f64(P::local_to_f64(&point)),
                direction: vector(direction),
                frame,
            },
            InputKind::Torque { body, axis, frame } => {
                InputKind::Torque { body, axis: moment(axis), frame }
            }
            InputKind::JointTorque { a, b, axes } => {
                InputKind::JointTorque { a, b, axes: axes.map(moment) }
            }
            InputKind::JointForce { a, b, point, axis } => {
                let point = Q::local_from_f64(P::local_to_f64(&point));
                InputKind::JointForce { a, b, point, axis: vector(axis) }
            }
            InputKind::Actuator { group, element } => InputKind::Actuator { group, element },
            InputKind::Gravity { direction } => InputKind::Gravity { direction: vector(direction) },
            InputKind::Velocity { body, direction } => {
                InputKind::Velocity { body, direction: vector(direction) }
            }
            InputKind::AngularVelocity { body, axis } => {
                InputKind::AngularVelocity { body, axis: moment(axis) }
            }
            InputKind::Signal => InputKind::Signal,
            InputKind::Anchor { direction } => InputKind::Anchor { direction: vector(direction) },
        };
        let value = Q::Real::from_f64(self.value.to_f64());
        let range = self.range.map(|bound| Q::Real::from_f64(bound.to_f64()));
        Input { kind, value, knot: self.knot, knots: self.knots, range }
    }
}

/// A knot of an input's table.
#[derive(Clone, Copy, Debug, PartialEq)]
#[cfg_attr(all(feature = "defmt", target_os = "none"), derive(defmt::Format))]
pub struct Knot<R> {
    /// \[s\] the time from which it applies.
    pub time: f64,
    /// \[N, N·m, m/s², m/s, rad/s or m\] the value at its time.
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

    /// Whether every value from t = 0 to the next knot, and every part of it, is representable in the precision.
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
