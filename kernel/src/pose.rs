//! Groups at a pose: where points, arms and lines of elements lie.
//!
//! `(model, frames) => placed elements`, for all that looks at elements one by one: dampers,
//! energies, frequencies. The force evaluation places whole stars instead, each point once.

use crate::attitude::Attitude as _;
use crate::body::BodyState;
use crate::elements::input::InputKind;
use crate::elements::point_law::Stretch;
use crate::elements::point_on_line::Projection;
use crate::elements::torsion_spring::{TorsionSpring, Twist};
use crate::geometry::Geometry;
use crate::index::BodyIndex;
use crate::model::{Group, Law, ModelRef, Terms};
use crate::schedule::Signal;
use crate::space::{Linear as _, Moment as _};

/// Computes the frames of all bodies.
#[inline]
pub(crate) fn place_bodies<P: Geometry>(bodies: &[BodyState<P>], frames: &mut [P::Frame]) {
    for (state, frame) in bodies.iter().zip(frames) {
        *frame = P::frame(&state.position, &state.orientation);
    }
}

/// What points are placed by: the frames of the bodies, and the signals that move the ground.
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

/// One body as a group sees it: where it places points and how they move. The world is an end
/// without a frame; an anchor is a world whose points are moved.
pub(crate) struct End<'s, P: Geometry> {
    frame: Option<&'s P::Frame>,
    moved: Option<P::Vector>,
    /// \[m/s\] world axes.
    pub(crate) velocity: P::Vector,
    /// \[rad/s\] world axes.
    pub(crate) spin: P::Moment,
}

impl<'s, P: Geometry> End<'s, P> {
    /// The end at a body; without `bodies` a body's points count as at rest. A moved anchor has its
    /// rate either way: the sweeps rely on it.
    #[inline(always)]
    pub(crate) fn new<T: Terms>(
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

    /// The point's location and its arm, 0 for the ground's.
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

    /// The arm of a point `offset` away from the point of `arm`; the ground has none.
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
pub(crate) struct Placed<'m, V> {
    /// Its group.
    pub(crate) group: &'m Group,
    /// Its group's index.
    pub(crate) number: usize,
    /// Its index among the elements of its law.
    pub(crate) index: usize,
    /// From its first point to its second, and its line.
    pub(crate) stretch: Stretch<V>,
    /// The arm of the first point, world axes; 0 on the ground; on a line that of the foot.
    pub(crate) arm_a: V,
    /// The arm of the second point.
    pub(crate) arm_b: V,
}

/// Element `i` of a group with its index, `None` where the model lacks it or its points.
#[inline(always)]
pub(crate) fn placed<'m, P: Geometry, T: Terms>(
    model: &ModelRef<'m, P, T>,
    places: Places<'_, P>,
    (number, group): (usize, &'m Group),
    i: usize,
) -> Option<Placed<'m, P::Vector>> {
    let arms = group.arms.max(1) as usize;
    let (star, arm) = (i / arms, i % arms);
    let end_a = End::new(model, places, group.a, None);
    let end_b = End::new(model, places, group.b, None);
    let (a, mut arm_a) = end_a.place(model.points.get(group.centre(star))?);
    let (b, arm_b) = end_b.place(model.points.get(group.tips(star) + arm)?);
    let mut displacement = P::displacement(&a, &b);
    let mut direction = P::Vector::ZERO;
    let index = group.element as usize + i;
    if T::LINES && group.law == Law::PointOnLine {
        direction = end_a.to_world(model.lines.get(index)?.direction);
        let projection = Projection::new(displacement, direction);
        displacement = projection.deflection;
        arm_a = end_a.arm_at(arm_a, direction * projection.slide);
    }
    let stretch = Stretch { displacement, direction };
    Some(Placed { group, number, index, stretch, arm_a, arm_b })
}

/// The most points of the second body that one of the first is joined to.
pub(crate) const MOST_ARMS: usize = 3;

/// Where a point lies, and its arm.
pub(crate) type Spot<P> = (<P as Geometry>::Location, <P as Geometry>::Vector);

/// The stars of a group in blocks: the first body's points, and the second's points that they share.
/// Stars that share none are a block each.
#[inline(always)]
pub(crate) fn blocks<'m, L, const ARMS: usize>(
    points: &'m [L],
    group: &Group,
) -> impl Iterator<Item = (&'m [L], &'m [L; ARMS])> {
    let own = points.get(group.point as usize..).unwrap_or_default();
    let (mut centres, tips) = own.split_at_checked(group.stars as usize).unwrap_or_default();
    let stars = group.stars_per_block();
    tips.as_chunks::<ARMS>().0.iter().map_while(move |tips| {
        let (block, rest) = centres.split_at_checked(stars)?;
        centres = rest;
        Some((block, tips))
    })
}

/// Visits every element of the groups in order; frames are those of the pose.
pub(crate) fn each_element<'m, P: Geometry, T: Terms>(
    model: &ModelRef<'m, P, T>,
    places: Places<'_, P>,
    mut visit: impl FnMut(Placed<'m, P::Vector>),
) {
    for (number, group) in model.groups.iter().enumerate() {
        for i in 0..group.elements() {
            if let Some(element) = placed(model, places, (number, group), i) {
                visit(element);
            }
        }
    }
}

/// The twist of a torsion spring, `None` where it is undefined.
pub(crate) fn twist_of<P: Geometry>(
    spring: &TorsionSpring<P::Space>,
    bodies: &[BodyState<P>],
    turns: i32,
) -> Option<Twist<P::Space>> {
    let orientation = |row: usize| bodies.get(row).map(|s| &s.orientation);
    let relative =
        P::Orientation::relative(orientation(spring.a.row()), orientation(spring.b.row()));
    Some(spring.twist(&spring.since_start(relative)?, turns))
}
