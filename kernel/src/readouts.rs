//! Read-outs: values of a plant's sensors, computed on demand.
//!
//! `(read-out, model, state) => reading`, in the model's precision. A read-out is a separate constant that refers to
//! bodies, groups or springs; a model does not contain read-outs.

use core::ops::Deref;

use crate::body::BodyState;
use crate::elements::element::Element;
use crate::elements::input::InputKind;
use crate::elements::source::Sensor;
use crate::forces::{self, ExplicitDampers, ForcePair};
use crate::geometry::Geometry;
use crate::index::{BodyIndex, GroupIndex, InputIndex, LawIndex, TorsionIndex};
use crate::laws::{self, Instant, Laws as _};
use crate::model::{FrameOf, Group, ModelOwner, ModelRef, RealOf, Terms};
use crate::plant::Plant;
use crate::pose::{End, Places, place_bodies, placed};
use crate::real::Real;
use crate::schemes::Scheme;
use crate::sensors::{Motion, motion};
use crate::space::{Linear, Moment as _};
use crate::state::State;
use crate::vector::Vec3;

/// A translation of one body along an axis of another.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Slide<P: Geometry> {
    /// First body A and second body B.
    pub bodies: [BodyIndex; 2],
    /// \[m\] a point of each, in its axes.
    pub points: [P::Local; 2],
    /// Unit axis, in A's axes.
    pub axis: P::Vector,
}

impl<P: Geometry> Slide<P> {
    /// The same translation in another precision.
    pub fn convert<Q: Geometry>(&self) -> Slide<Q> {
        Slide {
            bodies: self.bodies,
            points: self.points.map(|point| Q::local_from_f64(P::local_to_f64(&point))),
            axis: Q::Vector::from_f64(self.axis.to_f64()),
        }
    }
}

/// The quantity that is read.
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum Readout<P: Geometry> {
    /// \[rad\] the torsion angle of a torsion spring, unwrapped.
    JointAngle {
        /// The spring.
        spring: TorsionIndex,
        /// \[rad\] the value at a torsion angle of 0.
        offset: P::Real,
    },
    /// \[rad/s\] the rate of that torsion angle.
    JointRate {
        /// The spring.
        spring: TorsionIndex,
    },
    /// \[m\] the travel of a point of B from one of A along an axis of A.
    JointTravel {
        /// The translation.
        slide: Slide<P>,
        /// \[m\] the value at a travel of 0.
        offset: P::Real,
    },
    /// \[m/s\] the rate of that travel.
    JointTravelRate {
        /// The translation.
        slide: Slide<P>,
    },
    /// \[m\] the position of a point of a body, world.
    Point {
        /// The body.
        body: BodyIndex,
        /// The point in body axes.
        point: P::Local,
    },
    /// \[m/s\] the velocity of a point of a body, world.
    PointVelocity {
        /// The body.
        body: BodyIndex,
        /// The point in body axes.
        point: P::Local,
    },
    /// \[N\] the tension of a TSDA: spring, damper and actuators.
    TsdaForce {
        /// The TSDA's group.
        group: GroupIndex,
        /// Its index in the group.
        element: u16,
    },
    /// \[N\] the force of a joint on its second body, world: springs, dampers and actuators.
    JointForce {
        /// The joint's group.
        group: GroupIndex,
    },
    /// \[m/s², rad/s\] specific force and angular rate at a point of a body, body axes: an inertial measurement unit.
    Imu {
        /// The body.
        body: BodyIndex,
        /// The point in body axes.
        point: P::Local,
    },
    /// \[N, N·m, m/s², m\] the value of an input at the present time, which the next step uses.
    Input {
        /// The input.
        input: InputIndex,
    },
    /// An output of a law, in the unit of its [`Quantity`](crate::laws::Quantity).
    Law {
        /// The law's row.
        law: LawIndex,
        /// The index of the quantity among the law's.
        quantity: u8,
    },
}

impl<P: Geometry> Readout<P> {
    /// The sensor of a read-out of poses and velocities only; `None` for one of forces or inputs.
    #[inline(always)]
    #[must_use]
    pub fn sensor(&self) -> Option<Sensor<P>> {
        match *self {
            Readout::JointAngle { spring, offset } => Some(Sensor::Angle { spring, offset }),
            Readout::JointRate { spring } => Some(Sensor::Rate { spring }),
            Readout::Point { body, point } => Some(Sensor::Point { body, point }),
            Readout::PointVelocity { body, point } => Some(Sensor::Velocity { body, point }),
            _ => None,
        }
    }

    /// The same read-out in another precision.
    pub fn convert<Q: Geometry>(&self) -> Readout<Q> {
        let local = |point: P::Local| Q::local_from_f64(P::local_to_f64(&point));
        match *self {
            Readout::JointAngle { spring, offset } => {
                Readout::JointAngle { spring, offset: Q::Real::from_f64(offset.to_f64()) }
            }
            Readout::JointRate { spring } => Readout::JointRate { spring },
            Readout::JointTravel { slide, offset } => Readout::JointTravel {
                slide: slide.convert(),
                offset: Q::Real::from_f64(offset.to_f64()),
            },
            Readout::JointTravelRate { slide } => {
                Readout::JointTravelRate { slide: slide.convert() }
            }
            Readout::Point { body, point } => Readout::Point { body, point: local(point) },
            Readout::PointVelocity { body, point } => {
                Readout::PointVelocity { body, point: local(point) }
            }
            Readout::TsdaForce { group, element } => Readout::TsdaForce { group, element },
            Readout::JointForce { group } => Readout::JointForce { group },
            Readout::Imu { body, point } => Readout::Imu { body, point: local(point) },
            Readout::Input { input } => Readout::Input { input },
            Readout::Law { law, quantity } => Readout::Law { law, quantity },
        }
    }
}

/// The value of a read-out.
#[derive(Clone, Copy, Debug, PartialEq)]
#[cfg_attr(all(feature = "defmt", target_os = "none"), derive(defmt::Format))]
pub enum Reading<R> {
    /// An angle, a travel, a rate, a tension or the value of an input.
    Scalar(R),
    /// A position, a velocity or a force, world axes.
    Vector(Vec3<R>),
    /// An inertial measurement unit's, body axes.
    Imu {
        /// \[m/s²\].
        specific_force: Vec3<R>,
        /// \[rad/s\].
        rate: Vec3<R>,
    },
}

impl<R: Real> Reading<R> {
    /// The reading of a scalar quantity; `None` for a vector.
    pub fn scalar(self) -> Option<R> {
        match self {
            Reading::Scalar(value) => Some(value),
            _ => None,
        }
    }

    /// The reading of a vector quantity; `None` for a scalar.
    pub fn vector(self) -> Option<Vec3<R>> {
        match self {
            Reading::Vector(value) => Some(value),
            _ => None,
        }
    }
}

impl<H, S> Plant<H, S>
where
    H: Deref<Target: ModelOwner + Sized>,
    S: Scheme,
{
    /// Reads a sensor in the present state; `None` where the read-out refers to a part that the model lacks or the
    /// torsion angle is undefined. Only an inertial measurement unit costs a force evaluation.
    pub fn read(
        &self,
        readout: &Readout<<H::Target as ModelOwner>::Precision>,
    ) -> Option<Reading<RealOf<H::Target>>> {
        read(self.model(), self.state(), self.step_size(), readout)
    }
}

/// Reads a sensor in a state of a model, with loads active for steps of `step_size` \[s\].
pub fn read<M: ModelOwner>(
    model: &M,
    state: &State<M>,
    step_size: f64,
    readout: &Readout<M::Precision>,
) -> Option<Reading<RealOf<M>>> {
    let view = model.view();
    let bodies = state.bodies.as_ref();
    let mut frames = model.per_body(FrameOf::<M>::default());
    place_bodies::<M::Precision>(bodies, frames.as_mut());
    let places = Places { frames: frames.as_ref(), signals: state.signals.as_ref() };
    if let Some(sensor) = readout.sensor() {
        return Some(match motion(&view, places, state, &sensor)? {
            Motion::Number(value) => Reading::Scalar(value),
            Motion::Vector(v) => Reading::Vector(v),
        });
    }
    let at = Instant { frames: frames.as_ref(), bodies, signals: state.signals.as_ref() };
    let travel = |slide: &Slide<M::Precision>| {
        let seen = at.seen(slide.bodies)?;
        Some(laws::travel(&seen, &slide.points, slide.axis))
    };
    match *readout {
        Readout::JointTravel { slide, offset } => {
            Some(Reading::Scalar(travel(&slide)?[0] + offset))
        }
        Readout::JointTravelRate { slide } => Some(Reading::Scalar(travel(&slide)?[1])),
        Readout::TsdaForce { group, element } => {
            let row = group.row();
            let group = view.groups.get(row)?;
            let tension = tension(&view, places, bodies, (row, group), element as usize)?;
            Some(Reading::Scalar(tension))
        }
        Readout::JointForce { group } => {
            let row = group.row();
            let group = view.groups.get(row)?;
            Some(Reading::Vector(force(&view, places, bodies, (row, group)).in_space()))
        }
        Readout::Imu { body, point } => {
            let constants = view.bodies.get(body.row())?;
            let wrenches = forces::wrenches(model, state, step_size).ok()?;
            let wrench = wrenches.as_ref().get(body.row())?;
            let rate = M::Precision::spin(&bodies.get(body.row())?.angular_velocity);
            let gravity = forces::field(&view, state.signals.as_ref());
            let end = End::new(&view, places, body, Some(bodies));
            // Lever arm, rates and accelerations in body axes.
            let arm = end.to_axes(end.place(&point).1);
            let centre = end.to_axes(wrench.force * constants.inverse_mass - gravity);
            let torque = wrench.torque - rate.commutator(constants.inertia.scale(rate));
            let angular = torque.scale(constants.inverse_inertia);
            let specific_force = centre + angular.cross(arm) + rate.cross(rate.cross(arm));
            let (specific_force, rate) = (specific_force.in_space(), rate.in_space());
            Some(Reading::Imu { specific_force, rate })
        }
        Readout::Input { input } => {
            let signal = state.signals.as_ref().get(input.0 as usize)?;
            Some(Reading::Scalar(signal.value))
        }
        Readout::Law { law, quantity } => {
            let mut reading = None;
            view.laws.look(law.0.into(), &state.laws, &mut |law| {
                let known = usize::from(quantity) < law.quantities().len();
                if let Some(seen) = law.seen(at).filter(|_| known) {
                    reading = Some(Reading::Scalar(law.read(quantity.into(), &seen)));
                }
            });
            reading
        }
        // Sensors of motion.
        _ => None,
    }
}

/// The tension of a group's TSDA: spring, damper and actuators; `None` for another law.
#[inline(always)]
fn tension<P: Geometry, T: Terms<P>>(
    view: &ModelRef<'_, P, T>,
    places: Places<'_, P>,
    bodies: &[BodyState<P>],
    (row, group): (usize, &Group),
    element: usize,
) -> Option<P::Real> {
    let placed = placed(view, places, (row, group), element)?;
    let Element::Tsda(tsda) = view.element(group.law, placed.index)? else { return None };
    let end = |body: BodyIndex| End::new(view, places, body, Some(bodies));
    let d = placed.deformation.displacement;
    let (a, b) = (end(group.a), end(group.b));
    let v_rel = b.point_velocity(placed.arm_b) - a.point_velocity(placed.arm_a);
    let clearance = view.clearance(group);
    let damping = group.damper.row().and_then(|row| view.dampers.get(row + element));
    let force = match damping {
        Some(&damping) => tsda.damped_force(damping, d, v_rel, clearance),
        None => tsda.force(d, clearance),
    };
    let mut tension = force.dot(d) * d.dot(d).sqrt().reciprocal_or_zero();
    for (input, signal) in view.inputs.iter().zip(places.signals) {
        let this = InputKind::Actuator { group: GroupIndex(row as u16), element: element as u16 };
        if input.kind == this {
            tension = tension + signal.value;
        }
    }
    Some(tension)
}

/// The force of a group on its second body: springs, dampers and actuators.
#[inline(always)]
fn force<P: Geometry, T: Terms<P>>(
    view: &ModelRef<'_, P, T>,
    places: Places<'_, P>,
    bodies: &[BodyState<P>],
    (row, group): (usize, &Group),
) -> P::Vector {
    let force_pair =
        forces::force_pair_out_of_line::<P, T, ExplicitDampers>(view, places, (bodies, &[]), group)
            .unwrap_or(ForcePair::ZERO);
    -forces::with_actuators(view, places, row, force_pair.force)
}

/// Visits the tension \[N\] of every TSDA in the order of the groups, as
/// [`Readout::TsdaForce`] reads it, with the index of its group.
pub fn each_tension<M: ModelOwner>(
    model: &M,
    state: &State<M>,
    mut visit: impl FnMut(usize, RealOf<M>),
) {
    let view = model.view();
    let bodies = state.bodies.as_ref();
    let mut frames = model.per_body(FrameOf::<M>::default());
    place_bodies::<M::Precision>(bodies, frames.as_mut());
    let places = Places { frames: frames.as_ref(), signals: state.signals.as_ref() };
    for (row, group) in view.groups.iter().enumerate() {
        for element in 0..group.elements() {
            if let Some(tension) = tension(&view, places, bodies, (row, group), element) {
                visit(row, tension);
            }
        }
    }
}

/// Visits the force \[N\] of every group on its second body, world axes, in their order, as
/// [`Readout::JointForce`] reads it, with the index of the group.
pub fn each_force<M: ModelOwner>(
    model: &M,
    state: &State<M>,
    mut visit: impl FnMut(usize, Vec3<RealOf<M>>),
) {
    let view = model.view();
    let bodies = state.bodies.as_ref();
    let mut frames = model.per_body(FrameOf::<M>::default());
    place_bodies::<M::Precision>(bodies, frames.as_mut());
    let places = Places { frames: frames.as_ref(), signals: state.signals.as_ref() };
    for (row, group) in view.groups.iter().enumerate() {
        visit(row, force(&view, places, bodies, (row, group)).in_space());
    }
}
