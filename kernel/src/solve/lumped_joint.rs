//! Lumped joints, a point and an axis: the tangent of many springs in closed form.
//!
//! `(group at t = 0, weights) => lumped joint`. The springs of most joints are isotropic about an axis e, for displacements
//! of a centre, `Σ w·u·uᵀ = s·I + t·e·eᵀ`, and for rotations across it, `Σ w·(ρ×u)·(ρ×u)ᵀ = n·(I − e·eᵀ)`: the joint is then
//! equivalent to this point and this axis in any pose, and so is one bushing or revolute joint of bushings. Any other
//! group is assembled element by element.

use crate::elements::point_law::Deformation;
use crate::freedoms::Freedoms as _;
use crate::geometry::Geometry;
use crate::model::{Group, Law, ModelRef, Terms};
use crate::pose::{End, Placed, Places, placed};
use crate::real::Real;
use crate::solve::matrix_weights::{MatrixWeights, weight_of};
use crate::space::{Linear as _, Space, Vector as _};

/// The centre, the axis and the weights of a lumped joint.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub struct LumpedJoint<S: Space> {
    /// \[m\] the lever arms of its centre, in the axes of each body.
    pub(super) arms: [S::Vector; 2],
    /// \[1\] unit axis in the first body's axes.
    pub(super) axis: S::Vector,
    /// Weight s of the point; 0 for a group that is assembled element by element.
    pub(super) point: S::Real,
    /// Additional weight t of the point along the axis; 0 without an axis, in a plane, and where its springs are alike in
    /// all directions.
    pub(super) along: S::Real,
    /// \[m²\] weight of the axis; 0 without an axis.
    pub(super) across: S::Real,
}

/// The largest deviation of a joint's springs from the lumped form, relative to the stiffest.
const ALIKE: f64 = 1e-3;

/// The lumped joints of a model's groups at its initial pose.
pub(crate) fn find<P: Geometry, T: Terms<P>>(
    model: &ModelRef<'_, P, T>,
    places: Places<'_, P>,
    matrix_weights: MatrixWeights<P::Real>,
    lumped_joints: &mut [LumpedJoint<P::Space>],
) {
    for ((number, group), lumped_joint) in model.groups.iter().enumerate().zip(lumped_joints) {
        if group.clearance.row().is_some() {
            continue;
        }
        let found = match group.law {
            Law::Tsda if T::TSDAS && group.elements() > 1 => {
                of_springs(model, places, (number, group), matrix_weights)
            }
            Law::PointBushing | Law::Revolute if group.elements() == 1 => {
                of_bushing(model, places, (number, group), matrix_weights)
            }
            _ => None,
        };
        *lumped_joint = found.unwrap_or_default();
    }
}

/// That of a bushing or a revolute joint: its own point and axis.
fn of_bushing<P: Geometry, T: Terms<P>>(
    model: &ModelRef<'_, P, T>,
    places: Places<'_, P>,
    (number, group): (usize, &Group),
    matrix_weights: MatrixWeights<P::Real>,
) -> Option<LumpedJoint<P::Space>> {
    let element = placed(model, places, (number, group), 0)?;
    let point = weight_of(model, group, (0, element.index), matrix_weights)?;
    let Deformation { direction, ratio, .. } = element.deformation;
    let (mut along, mut across) = (P::Real::ZERO, P::Real::ZERO);
    if T::REVOLUTES && group.law == Law::Revolute {
        let lever = model.revolutes.get(element.index)?.levers[0];
        (along, across) = (point * (ratio - P::Real::ONE), point * lever.dot(lever));
    }
    let [a, b] = [group.a, group.b].map(|end| End::new(model, places, end, None));
    let arms = [a.to_axes(element.arm_a), b.to_axes(element.arm_b)];
    Some(LumpedJoint { arms, axis: a.to_axes(direction), point, along, across })
}

/// \[m\] from the joint's bodies to the first point of an element.
fn arms<P: Geometry>(element: &Placed<'_, P::Vector>) -> [P::Vector; 2] {
    [element.arm_a, element.arm_b - element.deformation.displacement]
}

fn of_springs<P: Geometry, T: Terms<P>>(
    model: &ModelRef<'_, P, T>,
    places: Places<'_, P>,
    (number, group): (usize, &Group),
    matrix_weights: MatrixWeights<P::Real>,
) -> Option<LumpedJoint<P::Space>> {
    let zero = P::Real::ZERO;
    let all = || (0..group.elements()).map(|i| placed(model, places, (number, group), i));
    let mut centre = [P::Vector::ZERO; 2];
    for element in all() {
        let arms = arms::<P>(&element?);
        centre = [centre[0] + arms[0], centre[1] + arms[1]];
    }
    let part = P::Real::ONE / P::Real::from_i32(group.elements() as i32);
    let centre = centre.map(|sum| sum * part);
    // The ground has no lever arm: the points of the other body have the same distances.
    let seen = usize::from(group.a.is_world());
    let offset = |element: &Placed<'_, P::Vector>| arms::<P>(element)[seen] - centre[seen];
    let (mut axis, mut square, mut far) = (P::Vector::ZERO, zero, zero);
    for element in all() {
        let element = element?;
        for arm in [element.arm_a, element.arm_b, element.deformation.displacement] {
            far = P::Real::pick(far.less_than(arm.dot(arm)), arm.dot(arm), far);
        }
        let away = offset(&element);
        if square < away.dot(away) {
            (axis, square) = (away, away.dot(away));
        }
    }
    // Coincident points differ by rounding.
    let rounding = P::Real::from_f64(64.0) * P::Real::epsilon();
    if square < rounding * rounding * far {
        (axis, square) = (P::Vector::ZERO, zero);
    }
    let elongation = square.sqrt();
    let inverse = elongation.reciprocal_or_zero();
    let axis = axis * inverse;
    let mut found = Row::<P>::EMPTY;
    let mut sums = [zero; 3];
    for (i, element) in all().enumerate() {
        let element = element?;
        let d = element.deformation.displacement;
        let u = d * d.dot(d).sqrt().reciprocal_or_zero();
        let moment = (offset(&element) * inverse).cross(u);
        let weight = weight_of(model, group, (i, element.index), matrix_weights)?;
        P::Space::row(u, moment).add_square(weight, &mut found);
        let projection = u.dot(axis);
        sums = [
            sums[0] + weight * u.dot(u),
            sums[1] + weight * moment.dot(moment),
            sums[2] + weight * projection * projection,
        ];
    }
    let dimension = P::Vector::DIMENSION as i32;
    let [mean, beside] = [dimension, dimension - 1].map(P::Real::from_i32);
    let across = sums[1] * P::Real::HALF;
    // Alike in all directions, or about the axis.
    let other = (sums[0] - sums[2]) / beside;
    let ways = [(sums[0] / mean, zero), (other, sums[2] - other)];
    let (point, along) = ways.into_iter().find(|&(point, along)| {
        let mut meant = Row::<P>::EMPTY;
        P::Space::add_point(point, P::Vector::ZERO, &mut meant);
        P::Space::row(axis, P::Moment::ZERO).add_square(along, &mut meant);
        P::Space::add_across(across, axis, &mut meant);
        (along == zero || (dimension > 2 && zero < across))
            && zero < point
            && Row::<P>::are_near(&found, &meant, P::Real::from_f64(ALIKE) * point)
    })?;
    let [a, b] = [group.a, group.b].map(|end| End::new(model, places, end, None));
    let arms = [a.to_axes(centre[0]), b.to_axes(centre[1])];
    Some(LumpedJoint { arms, axis: a.to_axes(axis), point, along, across: across * square })
}

type Row<P> = <<P as Geometry>::Space as Space>::Row;

#[cfg(test)]
mod tests {
    use super::*;
    use crate::index::BodyIndex;
    use crate::model::{ModelOwner, Plan};
    use crate::model_spec::{ModelSpec, Spring, Start};
    use crate::pose::place_bodies;
    use crate::solve::{System, assemble};
    use crate::state::State;

    const PLACES: [[f64; 3]; 4] =
        [[0.3, 0.0, 0.0], [0.1, 0.7, 0.3], [1.3, -0.017, 2.9], [-0.77, 0.011, 0.003]];

    /// Bodies on spherical joints at the origin.
    const MODEL_SPEC: ModelSpec = {
        const SPRING: Spring = Spring { stiffness: 1e4, damping: 1e2, free_length: 0.05 };
        let mut model_spec = ModelSpec::new();
        let mut i = 0;
        while i < PLACES.len() {
            let [x, y, z] = PLACES[i];
            let arms = [[0.05 - x, -y, -z], [-x, 0.05 - y, -z], [-x, -y, 0.05 - z]];
            let between = [BodyIndex::WORLD, BodyIndex(i as u16)];
            model_spec = model_spec.body(1.0, [0.01; 3], Start::at(PLACES[i]));
            model_spec = model_spec.triples(between, &[[0.0; 3]], &arms, SPRING);
            i += 1;
        }
        model_spec
    };

    crate::model!(static DOUBLE: F64 = MODEL_SPEC);
    crate::model!(static SINGLE: F32 = MODEL_SPEC);

    fn are_points<M: ModelOwner>(model: &M) {
        let state = State::initial(model);
        let mut frames = model.per_body(Default::default());
        place_bodies::<M::Precision>(state.bodies.as_ref(), frames.as_mut());
        let places = Places { frames: frames.as_ref(), signals: state.signals.as_ref() };
        let (zero, one) = (crate::model::RealOf::<M>::ZERO, crate::model::RealOf::<M>::ONE);
        let matrix_weights = MatrixWeights { mass: one, damping: one, stiffness: one };
        let mut lumped_joints = [LumpedJoint::default(); PLACES.len()];
        find(&model.view(), places, matrix_weights, &mut lumped_joints);
        for lumped_joint in lumped_joints {
            assert!(lumped_joint.point > one && lumped_joint.across == zero, "{lumped_joint:?}");
        }
    }

    /// \[m, N/m\] span, ring and stiffness of a revolute about the z axis at the origin.
    const REVOLUTE: [f64; 3] = [0.06, 0.03, 9e6];

    const RING: ModelSpec = {
        let [span, ring, stiffness] = REVOLUTE;
        let free_length = 0.042_426_406_871_192_85;
        let spring = Spring { stiffness, damping: 0.0, free_length };
        let place = [0.3, -0.2, 0.0];
        let half = span / 2.0;
        let other = 0.866_025_403_784_438_6 * ring;
        let [x, y] = [-place[0], -place[1]];
        let tips = [
            [x + ring, y, 0.0],
            [x - ring / 2.0, y + other, 0.0],
            [x - ring / 2.0, y - other, 0.0],
        ];
        ModelSpec::new().body(1.0, [0.01; 3], Start::at(place)).triples(
            [BodyIndex::WORLD, BodyIndex(0)],
            &[[0.0, 0.0, -half], [0.0, 0.0, half]],
            &tips,
            spring,
        )
    };

    crate::model!(static WITH_RING: F64 = RING);

    /// A revolute of any ring is a point and an axis, with the stiffnesses of docs/joints.md.
    #[test]
    fn a_revolute_of_another_ring_is_stiffer_along_its_axis() {
        let state = State::initial(&WITH_RING);
        let mut frames = WITH_RING.per_body(Default::default());
        place_bodies::<crate::F64>(state.bodies.as_ref(), frames.as_mut());
        let places = Places { frames: frames.as_ref(), signals: state.signals.as_ref() };
        let matrix_weights = MatrixWeights { mass: 1.0, damping: 1.0, stiffness: 1.0 };
        let mut lumped_joints = [LumpedJoint::default()];
        find(&WITH_RING.view(), places, matrix_weights, &mut lumped_joints);
        let [LumpedJoint { axis, point, along, across, .. }] = lumped_joints;
        let [span, ring, k] = REVOLUTE;
        let square = ring * ring + span * span / 4.0;
        let near = |found: f64, meant: f64| (found / meant - 1.0).abs() < 1e-9;
        assert!(near(axis.z.abs(), 1.0), "{axis:?}");
        assert!(near(point, k * 3.0 * ring * ring / square), "{point}");
        assert!(near(point + along, k * 3.0 * span * span / (2.0 * square)), "{along}");
        assert!(near(across, k * 3.0 * (span * ring).powi(2) / (4.0 * square)), "{across}");
    }

    /// Two bodies on revolute joints of bushings about slanted axes, with dampers, and a bushing between them.
    const BUSHINGS: ModelSpec = {
        let axes = [[0.6, 0.0, 0.8]; 2];
        let (first, second) = (BodyIndex(0), BodyIndex(1));
        let rubber = Spring { stiffness: 2e5, damping: 7.0, free_length: 0.0 };
        ModelSpec::new()
            .body(1.0, [0.01, 0.02, 0.03], Start::at([0.5, 0.0, 0.1]))
            .body(2.0, [0.03, 0.02, 0.01], Start::at([1.2, 0.1, 0.3]))
            .revolute(
                [BodyIndex::WORLD, first],
                [[0.1, 0.0, 0.0], [-0.4, 0.0, -0.1]],
                axes,
                [0.05, 1.7],
                [1e6, 30.0],
            )
            .revolute(
                [second, first],
                [[-0.3, 0.0, -0.2], [0.4, 0.1, 0.0]],
                axes,
                [0.02, 0.3],
                [3e6, 0.0],
            )
            .triples([first, second], &[[0.2, 0.1, 0.3]], &[[-0.5, 0.0, 0.1]], rubber)
    };

    crate::model!(static ON_BUSHINGS: F64 = BUSHINGS);

    /// The matrix is that of the elements, in every block.
    #[test]
    fn bushings_are_their_own_points_and_axes() {
        let model = ON_BUSHINGS.view();
        let state = State::initial(&ON_BUSHINGS);
        let mut frames = ON_BUSHINGS.per_body(Default::default());
        place_bodies::<crate::F64>(state.bodies.as_ref(), frames.as_mut());
        let places = Places { frames: frames.as_ref(), signals: state.signals.as_ref() };
        let matrix_weights = MatrixWeights { mass: 1.5, damping: 1e-3, stiffness: 1e-6 };
        let mut lumped_joints = [LumpedJoint::default(); 3];
        find(&model, places, matrix_weights, &mut lumped_joints);
        assert!(lumped_joints.iter().all(|joint| joint.point > 0.0), "{lumped_joints:?}");
        let plan = Plan {
            order: &[[0, 1], [1, 0]],
            pairs: &[[0, 1]],
            targets: &[],
            slots: &[Plan::GROUND, 0, 0],
            decoupled: &[],
        };
        let matrix = |lumped_joints: &[LumpedJoint<f64>]| {
            let (mut diagonal, mut pairs) = ([<[f64; 6]>::EMPTY; 2], [<[f64; 6]>::EMPTY]);
            let mut system = System { plan, diagonal: &mut diagonal, pairs: &mut pairs };
            let known = (matrix_weights, lumped_joints);
            let bodies = state.bodies.as_ref();
            assemble(&model, places, bodies, known, &state.laws, &mut system);
            [diagonal[0], diagonal[1], pairs[0]].as_flattened().as_flattened().to_vec()
        };
        let [lumped, of_elements] = [matrix(&lumped_joints), matrix(&[])];
        let scale = of_elements.iter().fold(0.0_f64, |most, entry| most.max(entry.abs()));
        for (a, b) in lumped.iter().zip(&of_elements) {
            assert!((a - b).abs() < 1e-14 * scale, "{a} {b}");
        }
    }

    /// Rounding differences between the points of a spherical joint do not make an axis, at any position.
    #[test]
    fn a_spherical_joint_is_a_point_at_any_place() {
        are_points(&DOUBLE);
        are_points(&SINGLE);
    }
}
