//! Groups at a pose: where points, arms and lines of elements lie.
//!
//! `(model, frames) => placed elements`, for all that looks at elements one by one: dampers,
//! energies, frequencies. The force evaluation places whole stars instead, each point once.

use crate::elements::point_on_line::Projection;
use crate::geometry::Geometry;
use crate::model::{Group, Law, ModelRef, Terms};
use crate::state::BodyState;
use crate::vector::Vec3;

/// Computes the frames of all bodies.
#[inline]
pub(crate) fn place_bodies<P: Geometry>(bodies: &[BodyState<P>], frames: &mut [P::Frame]) {
    for (state, frame) in bodies.iter().zip(frames) {
        *frame = P::frame(&state.position, &state.orientation);
    }
}

/// One body as a group sees it: where it places points and how they move. The world is an end
/// without a frame.
pub(crate) struct End<'s, P: Geometry> {
    frame: Option<&'s P::Frame>,
    velocity: Vec3<P::Real>,
    /// \[rad/s\] world axes.
    pub(crate) spin: Vec3<P::Real>,
}

impl<'s, P: Geometry> End<'s, P> {
    #[inline(always)]
    pub(crate) fn new(
        frame: Option<&'s P::Frame>,
        state: Option<&BodyState<P>>,
        moving: bool,
    ) -> Self {
        let (mut velocity, mut spin) = (Vec3::ZERO, Vec3::ZERO);
        if let (true, Some(frame), Some(state)) = (moving, frame, state) {
            velocity = P::velocity(&state.velocity);
            spin = P::to_world(frame, P::velocity(&state.angular_velocity));
        }
        Self { frame, velocity, spin }
    }

    /// The point's location and its arm, 0 for the ground's.
    #[inline(always)]
    pub(crate) fn place(&self, local: &P::Local) -> (P::Location, Vec3<P::Real>) {
        match self.frame {
            Some(frame) => P::place(frame, local),
            None => (P::ground(local), Vec3::ZERO),
        }
    }

    /// Body axes to world axes.
    #[inline(always)]
    pub(crate) fn to_world(&self, v: Vec3<P::Real>) -> Vec3<P::Real> {
        match self.frame {
            Some(frame) => P::to_world(frame, v),
            None => v,
        }
    }

    /// The arm of a point `offset` away from the point of `arm`; the ground has none.
    #[inline(always)]
    pub(crate) fn arm_at(&self, arm: Vec3<P::Real>, offset: Vec3<P::Real>) -> Vec3<P::Real> {
        if self.frame.is_some() { arm + offset } else { arm }
    }

    /// `v + ω × r`.
    #[inline(always)]
    pub(crate) fn point_velocity(&self, arm: Vec3<P::Real>) -> Vec3<P::Real> {
        self.velocity + self.spin.cross(arm)
    }
}

/// An element of a group at a pose.
pub(crate) struct Placed<'m, R> {
    /// Its group.
    pub(crate) group: &'m Group,
    /// Its group's index.
    pub(crate) number: usize,
    /// Its index among the elements of its law.
    pub(crate) index: usize,
    /// From its first point to its second, world axes; on a line from the foot to the point.
    pub(crate) displacement: Vec3<R>,
    /// The arm of the first point, world axes; 0 on the ground; on a line that of the foot.
    pub(crate) arm_a: Vec3<R>,
    /// The arm of the second point.
    pub(crate) arm_b: Vec3<R>,
    /// The direction of its line, world axes; 0 where the law knows no line.
    pub(crate) direction: Vec3<R>,
}

/// Element `i` of a group with its index, `None` where the model lacks its points.
#[inline(always)]
pub(crate) fn placed<'m, P: Geometry, T: Terms>(
    model: &ModelRef<'m, P, T>,
    frames: &[P::Frame],
    (number, group): (usize, &'m Group),
    i: usize,
) -> Option<Placed<'m, P::Real>> {
    let (stars, arms) = (group.stars as usize, group.arms.max(1) as usize);
    let first = group.point as usize;
    let tip = first + stars + if group.shared { i % arms } else { i };
    let end_a = End::<P>::new(frames.get(group.a.row()), None, false);
    let end_b = End::<P>::new(frames.get(group.b.row()), None, false);
    let (a, mut arm_a) = end_a.place(model.points.get(first + i / arms)?);
    let (b, arm_b) = end_b.place(model.points.get(tip)?);
    let mut displacement = P::displacement(&a, &b);
    let index = group.element as usize + i;
    let mut direction = Vec3::ZERO;
    if T::LINES && group.law == Law::PointOnLine {
        direction = end_a.to_world(model.lines.get(index)?.direction);
        let projection = Projection::new(displacement, direction);
        displacement = projection.deflection;
        arm_a = end_a.arm_at(arm_a, direction * projection.slide);
    }
    Some(Placed { group, number, index, displacement, arm_a, arm_b, direction })
}

/// Visits every element of the groups in order; frames are those of the pose.
pub(crate) fn each_element<'m, P: Geometry, T: Terms>(
    model: &ModelRef<'m, P, T>,
    frames: &[P::Frame],
    mut visit: impl FnMut(Placed<'m, P::Real>),
) {
    for (number, group) in model.groups.iter().enumerate() {
        for i in 0..group.elements() {
            if let Some(element) = placed(model, frames, (number, group), i) {
                visit(element);
            }
        }
    }
}
