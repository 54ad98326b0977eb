//! Groups at a pose: points, lever arms and lines of elements.
//!
//! `(model, frames) => placed elements`, for code that visits elements one by one: dampers, energies, frequencies. The
//! force evaluation processes whole triples instead, each point once.

use crate::attitude::Attitude as _;
use crate::body::BodyState;
use crate::elements::input::InputKind;
use crate::elements::point_law::Deformation;
use crate::elements::point_on_line::Projection;
use crate::elements::torsion_spring::{TorsionAngle, TorsionSpring};
use crate::elements::universal::{AxisError, Universal};
use crate::geometry::Geometry;
use crate::index::BodyIndex;
use crate::model::{Group, Law, ModelRef, Terms};
use crate::real::Real;
use crate::schedule::Signal;
use crate::space::{Linear as _, Moment as _, Space as _, Vector};

/// Computes the frames of all bodies.
#[inline(always)]
pub(crate) fn place_bodies<P: Geometry>(bodies: &[BodyState<P>], frames: &mut [P::Frame]) {
    if P::Real::ONE_LANE { place_apart(bodies, frames) } else { place_here(bodies, frames) }
}

#[inline]
fn place_apart<P: Geometry>(bodies: &[BodyState<P>], frames: &mut [P::Frame]) {
    place_here(bodies, frames);
}

#[inline(always)]
fn place_here<P: Geometry>(bodies: &[BodyState<P>], frames: &mut [P::Frame]) {
    for (state, frame) in bodies.iter().zip(frames) {
        P::set_frame(frame, &state.position, &state.orientation);
    }
}

/// The data from which points are computed: the frames of the bodies, and the signals that move the ground.
pub(crate) struct Places<'s, P: Geometry> {
    /// One per body.
    pub(crate) frames: &'s [P::Frame],
    /// One per input.
    pub(crate) signals: &'s [Signal<P::Real>],
}

impl<P: Geometry> Clone for Places<'_, P> {
    fn clone(&self) -> Self {
        *self
    }
}

impl<P: Geometry> Copy for Places<'_, P> {}

/// One body of a group: how its points are computed and move. The world is an end without a frame; an anchor is a world
/// whose points are moved.
pub(crate) struct End<'s, P: Geometry> {
    frame: Option<&'s P::Frame>,
    moved: Option<P::Vector>,
    /// \[m/s\] world axes.
    pub(crate) velocity: P::Vector,
    /// \[rad/s\] world axes.
    pub(crate) spin: P::Moment,
}

impl<'s, P: Geometry> End<'s, P> {
    /// The end at a body whose points count as at rest.
    #[inline(always)]
    pub(crate) fn at(frame: &'s P::Frame) -> Self {
        let (velocity, spin) = (P::Vector::ZERO, P::Moment::ZERO);
        Self { frame: Some(frame), moved: None, velocity, spin }
    }

    /// The end at a body; without `bodies` a body's points count as at rest. A moved anchor has its rate either way:
    /// the damper passes rely on it.
    #[inline(always)]
    pub(crate) fn new<T: Terms<P>>(
        model: &ModelRef<'_, P, T>,
        places: Places<'s, P>,
        index: BodyIndex,
        bodies: Option<&[BodyState<P>]>,
    ) -> Self {
        let frame = places.frames.get(index.row());
        let (velocity, spin) = (P::Vector::ZERO, P::Moment::ZERO);
        let mut end = Self { frame, moved: None, velocity, spin };
        if let (Some(frame), Some(state)) = (frame, bodies.and_then(|b| b.get(index.row()))) {
            end.velocity = P::velocity(&state.velocity);
            end.spin = P::moment_to_world(frame, P::spin(&state.angular_velocity));
        }
        if T::INPUTS
            && let Some(row) = index.anchor_row()
            && let (Some(input), Some(signal)) = (model.inputs.get(row), places.signals.get(row))
            && let InputKind::Anchor { direction } = input.kind
        {
            end.moved = Some(direction * signal.value);
            end.velocity = direction * signal.rate;
        }
        end
    }

    /// The point's location and its lever arm, 0 for the ground.
    #[inline(always)]
    pub(crate) fn place(&self, local: &P::Local) -> Spot<P> {
        match self.frame {
            Some(frame) => P::place(frame, local),
            None => {
                let ground = P::ground(local);
                let location = match self.moved {
                    Some(by) => P::shift(&ground, by),
                    None => ground,
                };
                (location, P::Vector::ZERO)
            }
        }
    }

    /// The pose of this end relative to a body's; `None` where the other is not a body.
    #[inline(always)]
    pub(crate) fn apart(&self, b: &Self) -> Option<P::Apart> {
        Some(P::apart(self.frame, self.moved, b.frame?))
    }

    /// The frame of its body, `None` for the ground.
    #[inline(always)]
    pub(crate) fn frame(&self) -> Option<&'s P::Frame> {
        self.frame
    }

    /// This end if it is a body's, known to be one at compile time.
    #[inline(always)]
    pub(crate) fn body(&self) -> Option<Self> {
        self.frame.map(|frame| Self { frame: Some(frame), moved: None, ..*self })
    }

    /// This end of the ground, known to be one at compile time.
    #[inline(always)]
    pub(crate) fn ground(&self) -> Self {
        Self { frame: None, ..*self }
    }

    /// This end if it is of ground that nothing moves, known at compile time.
    #[inline(always)]
    pub(crate) fn still(&self) -> Option<Self> {
        let still = self.frame.is_none() && self.moved.is_none();
        if still { Some(Self { frame: None, moved: None, ..*self }) } else { None }
    }

    /// The moment of a force at a lever arm; 0 for the ground.
    #[inline(always)]
    pub(crate) fn moment(&self, arm: P::Vector, force: P::Vector) -> P::Moment {
        if self.frame.is_some() { arm.cross(force) } else { P::Moment::ZERO }
    }

    /// Body axes to world axes.
    #[inline(always)]
    pub(crate) fn to_world(&self, v: P::Vector) -> P::Vector {
        match self.frame {
            Some(frame) => P::to_world(frame, v),
            None => v,
        }
    }

    /// World axes to body axes.
    #[inline(always)]
    pub(crate) fn to_axes(&self, v: P::Vector) -> P::Vector {
        match self.frame {
            Some(frame) => P::to_body(frame, v),
            None => v,
        }
    }

    /// A moment's body axes to world axes.
    #[inline(always)]
    pub(crate) fn moment_to_world(&self, m: P::Moment) -> P::Moment {
        match self.frame {
            Some(frame) => P::moment_to_world(frame, m),
            None => m,
        }
    }

    /// A moment's world axes to body axes.
    #[inline(always)]
    pub(crate) fn moment_to_axes(&self, m: P::Moment) -> P::Moment {
        match self.frame {
            Some(frame) => P::moment_to_body(frame, m),
            None => m,
        }
    }

    /// The lever arm of a point `offset` away from the point of `arm`; 0 for the ground.
    #[inline(always)]
    pub(crate) fn arm_at(&self, arm: P::Vector, offset: P::Vector) -> P::Vector {
        if self.frame.is_some() { arm + offset } else { arm }
    }

    /// `v + ω × r`.
    #[inline(always)]
    pub(crate) fn point_velocity(&self, arm: P::Vector) -> P::Vector {
        self.velocity + self.spin.cross(arm)
    }
}

/// An element of a group at a pose.
pub(crate) struct Placed<'m, V: Vector> {
    /// Its group.
    pub(crate) group: &'m Group,
    /// Its group's index.
    pub(crate) number: usize,
    /// Its index among the elements of its law.
    pub(crate) index: usize,
    /// From its first point to its second, and its line.
    pub(crate) deformation: Deformation<V>,
    /// The lever arm of the first point, world axes; 0 on the ground; on a line that of the foot, of a revolute joint
    /// that of the second point.
    pub(crate) arm_a: V,
    /// The lever arm of the second point.
    pub(crate) arm_b: V,
}

/// Element `i` of a group with its index, `None` where the model lacks it or its points.
#[inline(always)]
pub(crate) fn placed<'m, P: Geometry, T: Terms<P>>(
    model: &ModelRef<'m, P, T>,
    places: Places<'_, P>,
    (number, group): (usize, &'m Group),
    i: usize,
) -> Option<Placed<'m, P::Vector>> {
    let arms = group.arms.max(1) as usize;
    let (triple, arm) = (i / arms, i % arms);
    let [end_a, end_b] = [group.a, group.b].map(|end| End::new(model, places, end, None));
    let a = end_a.place(model.points.get(group.centre(triple))?);
    let b = end_b.place(model.points.get(group.endpoints(triple) + arm)?);
    between(model, [&end_a, &end_b], [a, b], (number, group), i)
}

/// Element `i` of a group between its two points.
#[inline(always)]
fn between<'m, P: Geometry, T: Terms<P>>(
    model: &ModelRef<'m, P, T>,
    [end_a, end_b]: [&End<'_, P>; 2],
    [(a, mut arm_a), (b, arm_b)]: [Spot<P>; 2],
    (number, group): (usize, &'m Group),
    i: usize,
) -> Option<Placed<'m, P::Vector>> {
    let mut displacement = P::displacement(&a, &b);
    let mut direction = P::Vector::ZERO;
    let index = group.element as usize + i;
    if T::LINES && group.law == Law::PointOnLine {
        direction = end_a.to_world(model.lines.get(index)?.direction);
        let projection = Projection::new(displacement, direction);
        displacement = projection.deflection;
        arm_a = end_a.arm_at(arm_a, direction * projection.slide);
    }
    let (mut ratio, mut axis_errors) = (P::Real::ZERO, P::Real::ZERO);
    if T::REVOLUTES && group.law == Law::Revolute {
        let revolute = model.revolutes.get(index)?;
        let [a, b] = [end_a.to_world(revolute.levers[0]), end_b.to_world(revolute.levers[1])];
        (direction, ratio) = (unit(a), P::Real::ONE + revolute.along * a.dot(a));
        axis_errors = (b - a).dot(b - a).sqrt();
        arm_a = end_a.arm_at(arm_a, displacement);
    }
    if T::UNIVERSALS && group.law == Law::Universal {
        axis_errors = axis_error(model.universals.get(index)?, [end_a, end_b]).by;
    }
    let deformation = Deformation { displacement, direction, ratio, axis_error: axis_errors };
    Some(Placed { group, number, index, deformation, arm_a, arm_b })
}

/// The axis error of a universal joint between two ends.
#[inline(always)]
fn axis_error<P: Geometry>(
    universal: &Universal<P::Space>,
    [a, b]: [&End<'_, P>; 2],
) -> AxisError<P::Space> {
    AxisError::new(a.to_world(universal.lever), b.to_world(universal.axis))
}

// Callees of a step in lanes are inlined, as the step is compiled for more target features than they: closures are not.
#[inline(always)]
fn unit<V: Vector>(v: V) -> V {
    v * v.dot(v).sqrt().reciprocal_or_zero()
}

/// \[m\] The axes of rotation, of the second body relative to the first, that a joint element resists, world, with the
/// length of its lever arm, and their number: one for a universal joint, two for a revolute.
#[inline(always)]
pub(crate) fn held_turns<P: Geometry, T: Terms<P>>(
    model: &ModelRef<'_, P, T>,
    places: Places<'_, P>,
    group: &Group,
    element: usize,
) -> ([P::Moment; 2], usize) {
    match group.law {
        Law::Revolute if T::REVOLUTES => {
            let Some(revolute) = model.revolutes.get(element) else {
                return ([P::Moment::ZERO; 2], 0);
            };
            let lever = End::new(model, places, group.a, None).to_world(revolute.levers[0]);
            let [m, n] = unit(lever).normals();
            ([lever.cross(m), lever.cross(n)], 2)
        }
        Law::Universal if T::UNIVERSALS => {
            let Some(universal) = model.universals.get(element) else {
                return ([P::Moment::ZERO; 2], 0);
            };
            let a = End::new(model, places, group.a, None);
            let b = End::new(model, places, group.b, None);
            ([axis_error(universal, [&a, &b]).gradient, P::Moment::ZERO], 1)
        }
        _ => ([P::Moment::ZERO; 2], 0),
    }
}

/// The largest number of points of the second body joined to one point of the first.
pub(crate) const MAX_ARMS: usize = 3;

/// A world point, and its lever arm.
pub(crate) type Spot<P> = (<P as Geometry>::Location, <P as Geometry>::Vector);

/// Visits every element of the groups in order; frames are those of the pose. Each point is computed once.
pub(crate) fn each_element<'m, P: Geometry, T: Terms<P>>(
    model: &ModelRef<'m, P, T>,
    places: Places<'_, P>,
    mut visit: impl FnMut(Placed<'m, P::Vector>),
) {
    for (number, group) in model.groups.iter().enumerate() {
        let [end_a, end_b] = [group.a, group.b].map(|end| End::new(model, places, end, None));
        let (triples, arms) = (group.triples as usize, group.arms as usize);
        let mut endpoints = [None; MAX_ARMS];
        for triple in 0..triples {
            let Some(centre) = model.points.get(group.centre(triple)) else { break };
            let a = end_a.place(centre);
            let is_new = triple == 0 || !group.shared;
            for (arm, endpoint) in endpoints.iter_mut().enumerate().take(arms) {
                if is_new {
                    *endpoint = model
                        .points
                        .get(group.endpoints(triple) + arm)
                        .map(|endpoint| end_b.place(endpoint));
                }
                let i = triple * arms + arm;
                let element = endpoint
                    .and_then(|b| between(model, [&end_a, &end_b], [a, b], (number, group), i));
                if let Some(element) = element {
                    visit(element);
                }
            }
        }
    }
}

/// The revolution count of a geometry's number.
pub(crate) type CountOf<P> = <<P as Geometry>::Real as Real>::Count;

/// The torsion angle of a torsion spring, `None` where it is undefined.
#[inline(always)]
pub(crate) fn torsion_angle_of<P: Geometry>(
    spring: &TorsionSpring<P::Space>,
    bodies: &[BodyState<P>],
    turns: CountOf<P>,
) -> Option<TorsionAngle<P::Space>> {
    if P::Real::ONE_LANE {
        torsion_angle_apart(spring, bodies, turns)
    } else {
        torsion_angle_here(spring, bodies, turns)
    }
}

fn torsion_angle_apart<P: Geometry>(
    spring: &TorsionSpring<P::Space>,
    bodies: &[BodyState<P>],
    turns: CountOf<P>,
) -> Option<TorsionAngle<P::Space>> {
    torsion_angle_here(spring, bodies, turns)
}

/// The gradient of a torsion spring's angle in the axes of its first body, `None` where it is undefined.
#[inline(always)]
pub(crate) fn gradient_of<P: Geometry>(
    spring: &TorsionSpring<P::Space>,
    bodies: &[BodyState<P>],
) -> Option<P::Moment> {
    if P::Space::PLANAR {
        return Some(spring.axis);
    }
    let orientation = |row: usize| bodies.get(row).map(|s| &s.orientation);
    let relative =
        P::Orientation::relative(orientation(spring.a.row()), orientation(spring.b.row()));
    Some(spring.since_start(relative)?.gradient(spring.axis))
}

#[inline(always)]
fn torsion_angle_here<P: Geometry>(
    spring: &TorsionSpring<P::Space>,
    bodies: &[BodyState<P>],
    turns: CountOf<P>,
) -> Option<TorsionAngle<P::Space>> {
    let orientation = |row: usize| bodies.get(row).map(|s| &s.orientation);
    let relative =
        P::Orientation::relative(orientation(spring.a.row()), orientation(spring.b.row()));
    Some(spring.torsion_angle(&spring.since_start(relative)?, turns))
}
