//! Joints as a point and an axis that are held: the tangent of many springs in closed form.
//!
//! `(group at t = 0, weights) => seat`. The springs of most joints lie so that all directions are held
//! alike at a centre, `Σ w·u·uᵀ = s·I`, and turns across an axis, `Σ w·(ρ×u)·(ρ×u)ᵀ = n·(I − e·eᵀ)`: then the
//! joint is this point and this axis, wherever its bodies are. Any other group stands for its elements.

use crate::freedoms::Freedoms as _;
use crate::geometry::Geometry;
use crate::model::{Group, Law, ModelRef, Terms};
use crate::pose::{End, Placed, Places, placed};
use crate::real::Real;
use crate::solve::pencil::{Pencil, weight_of};
use crate::space::{Linear as _, Space, Vector as _};

/// Where and how much a joint holds.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub struct Seat<S: Space> {
    /// \[m\] the arms of its centre, in the axes of each body.
    pub(super) arms: [S::Vector; 2],
    /// \[1\] unit axis in the first body's axes.
    pub(super) axis: S::Vector,
    /// Weight of the point; 0 of a group that stands for its elements.
    pub(super) point: S::Real,
    /// \[m²\] weight of the axis; 0 of a point alone.
    pub(super) across: S::Real,
}

/// What the springs of a joint may differ by from what they are taken for, beside the stiffest.
const ALIKE: f64 = 1e-3;

/// The seats of a model's groups at its initial pose.
pub(crate) fn find<P: Geometry, T: Terms>(
    model: &ModelRef<'_, P, T>,
    places: Places<'_, P>,
    pencil: Pencil<P::Real>,
    seats: &mut [Seat<P::Space>],
) {
    for ((number, group), seat) in model.groups.iter().enumerate().zip(seats) {
        let known = T::TSDAS && group.law == Law::Tsda && group.elements() > 1;
        if known && group.clearance.row().is_none() {
            *seat = seat_of(model, places, (number, group), pencil).unwrap_or_default();
        }
    }
}

/// \[m\] from the joint's bodies to the first point of an element.
fn arms<P: Geometry>(element: &Placed<'_, P::Vector>) -> [P::Vector; 2] {
    [element.arm_a, element.arm_b - element.stretch.displacement]
}

fn seat_of<P: Geometry, T: Terms>(
    model: &ModelRef<'_, P, T>,
    places: Places<'_, P>,
    (number, group): (usize, &Group),
    pencil: Pencil<P::Real>,
) -> Option<Seat<P::Space>> {
    let zero = P::Real::ZERO;
    let all = || (0..group.elements()).map(|i| placed(model, places, (number, group), i));
    let mut centre = [P::Vector::ZERO; 2];
    for element in all() {
        let arms = arms::<P>(&element?);
        centre = [centre[0] + arms[0], centre[1] + arms[1]];
    }
    let part = P::Real::ONE / P::Real::from_i32(group.elements() as i32);
    let centre = centre.map(|sum| sum * part);
    // The ground has no arm: what is seen from the other body lies as much apart.
    let seen = usize::from(group.a.is_world());
    let offset = |element: &Placed<'_, P::Vector>| arms::<P>(element)[seen] - centre[seen];
    let (mut axis, mut square) = (P::Vector::ZERO, zero);
    for element in all() {
        let away = offset(&element?);
        if square < away.dot(away) {
            (axis, square) = (away, away.dot(away));
        }
    }
    let reach = square.sqrt();
    let inverse = reach.reciprocal_or_zero();
    let axis = axis * inverse;
    let mut found = Row::<P>::EMPTY;
    let mut sums = [zero; 2];
    for (i, element) in all().enumerate() {
        let element = element?;
        let d = element.stretch.displacement;
        let u = d * d.dot(d).sqrt().reciprocal_or_zero();
        let moment = (offset(&element) * inverse).cross(u);
        let weight = weight_of(model, group, (i, element.index), pencil)?;
        P::Space::row(u, moment).add_square(weight, &mut found);
        sums = [sums[0] + weight * u.dot(u), sums[1] + weight * moment.dot(moment)];
    }
    let dimension = P::Real::from_i32(P::Vector::DIMENSION as i32);
    let (point, across) = (sums[0] / dimension, sums[1] * P::Real::HALF);
    let mut meant = Row::<P>::EMPTY;
    P::Space::add_point(point, P::Vector::ZERO, &mut meant);
    P::Space::add_across(across, axis, &mut meant);
    if zero < point && Row::<P>::are_near(&found, &meant, P::Real::from_f64(ALIKE) * point) {
        let [a, b] = [group.a, group.b].map(|end| End::new(model, places, end, None));
        let arms = [a.to_axes(centre[0]), b.to_axes(centre[1])];
        Some(Seat { arms, axis: a.to_axes(axis), point, across: across * square })
    } else {
        None
    }
}

type Row<P> = <<P as Geometry>::Space as Space>::Row;
