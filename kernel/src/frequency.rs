//! The highest natural frequency of a model at a pose: a guaranteed bound and an estimate.
//!
//! `(model, state) => ω` \[rad/s\]. The bound is block Gershgorin on the mass-scaled tangent stiffness: for a spring κ
//! with rows `j_a`, `j_b` over its two bodies, `(j_a·x_a + j_b·x_b)² ≤ 2·(j_a·x_a)² + 2·(j_b·x_b)²`, so
//! `ω² ≤ max_b λ_max(Σ φ·κ·j·jᵀ)` with φ = 2, or 1 where the other end is the world (Feingold & Varga 1962). A spring
//! under the tension T adds |T|/L along both normals of its line and, for the force F at the lever arm r of each body,
//! `(r·F)·I − ½·(r·Fᵀ + F·rᵀ)` to its rotations. A clearance counts as closed, an actuator's force as a tension. Loads
//! and other inputs, whose stiffness is that of a weight and not of a spring, are left out. The estimate is power
//! iteration on differences of forces, one pair of evaluations each, on the symmetric part of the stiffness only: a
//! constant torque τ on a body, as that of a wound spring, adds `½·φ × τ` to the response to a rotation φ in body axes
//! (the commutator of rotations), which is subtracted again. Both are valid for the pose only.

mod bound;

pub use bound::bound;
pub(crate) use bound::square_of;

use crate::body::{Body, BodyState, Increment};
use crate::elements::input::InputKind;
use crate::elements::load::LoadFrame;
use crate::forces::{self, At, DampersLeft, Evaluation, Instant, Memories, Wrench};
use crate::geometry::Geometry;
use crate::model::{FrameOf, ModelOwner, RealOf, SpaceOf};
use crate::real::Real;
use crate::rotation;
use crate::schedule::Signal;
use crate::space::{Linear as _, Moment as _, Space};
use crate::state::State;

/// Largest displacement \[m\] of a centre of mass or a point, and rotation \[rad\], of the estimate's differences.
const PROBE: f64 = 1e-6;

/// The fraction of the response along a direction above which the eigenvalues involved are positive.
const CLEARLY_POSITIVE: f64 = 0.99;

/// A lower estimate of the highest angular frequency \[rad/s\] at the pose of `state`, by `iterations` power iterations
/// on the symmetric part of `M^-1/2·K·M^-1/2`; each needs two force evaluations. Not above the exact frequency of the
/// elements, like every Rayleigh quotient of a symmetric matrix, except for the rounding of the differences, about 1e-8
/// of it; torques and forces that rotate with a body, which have no energy, are left out. Intended for double
/// precision: forces are differenced over 1e-6 m. Never above `bound`.
pub fn estimate<M: ModelOwner>(model: &M, state: &State<M>, iterations: u32) -> f64 {
    let mut rest = state.clone();
    for (signal, input) in rest.signals.as_mut().iter_mut().zip(model.view().inputs) {
        let has_energy = match input.kind {
            InputKind::Actuator { .. }
            | InputKind::Gravity { .. }
            | InputKind::Anchor { .. }
            | InputKind::Signal => true,
            InputKind::Force { frame, .. } => frame == LoadFrame::World,
            InputKind::Velocity { .. }
            | InputKind::AngularVelocity { .. }
            | InputKind::Torque { .. }
            | InputKind::JointTorque { .. }
            | InputKind::JointForce { .. } => false,
        };
        if !has_energy {
            *signal = Signal::default();
        }
    }
    let Some(torques) = torques(model, &rest) else { return 0.0 };
    let power = |shift| largest_by_magnitude(model, &rest, torques.as_ref(), iterations, shift);
    let (mut square, radius) = power(0.0);
    if square < CLEARLY_POSITIVE * radius {
        // Compressed springs can have the largest eigenvalue by magnitude, a negative one, or one close to the positive
        // one; a shift by it makes the positive ones the largest.
        square = power(radius).0 - radius;
    }
    let found = libm::sqrt(if square > 0.0 { square } else { 0.0 });
    // Far from the origin differences of forces are inaccurate.
    let most = bound(model, state).to_f64();
    if found > most { most } else { found }
}

/// \[m\] The distance from the centre of mass of each body to the furthest point of its elements.
fn reaches<M: ModelOwner>(model: &M) -> M::PerBody<f64> {
    let view = model.view();
    let mut reaches = model.per_body(0.0);
    for group in view.groups {
        for triple in 0..group.triples as usize {
            let endpoints =
                (0..group.arms as usize).map(|arm| (group.b, group.endpoints(triple) + arm));
            for (body, point) in core::iter::once((group.a, group.centre(triple))).chain(endpoints)
            {
                let point = view.points.get(point);
                if let (Some(elongation), Some(point)) =
                    (reaches.as_mut().get_mut(body.row()), point)
                {
                    let [x, y, z] = M::Precision::local_to_f64(point);
                    let away = libm::sqrt(x * x + y * y + z * z);
                    *elongation = if away > *elongation { away } else { *elongation };
                }
            }
        }
    }
    reaches
}

/// The torques of the undisplaced pose, body axes; `None` where a torsion angle is undefined.
fn torques<M: ModelOwner>(model: &M, state: &State<M>) -> Option<M::PerBody<Wrench<SpaceOf<M>>>> {
    let mut frames = model.per_body(FrameOf::<M>::default());
    let mut wrenches = model.per_body(Wrench::default());
    forces::evaluate_out_of_line::<M::Precision, M::Terms, DampersLeft>(
        &model.view(),
        Instant {
            step: 0,
            windows: model.per_load().as_ref(),
            signals: state.signals.as_ref(),
            bodies: state.bodies.as_ref(),
            in_line: false,
            rests: &[],
            placed: false,
        },
        Memories {
            turns: state.turns.clone().as_mut(),
            laws: &mut state.laws.clone(),
            at: At::Stage,
            advance: None,
        },
        Evaluation { frames: frames.as_mut(), wrenches: wrenches.as_mut(), unpushed: &mut [] },
    )
    .ok()?;
    Some(wrenches)
}

/// The eigenvalue of the symmetric part of `M^-1/2·K·M^-1/2 + shift·I` \[1/s²\] of the largest magnitude, and the
/// magnitude of the response, which is that of the eigenvalue except where several mix. `torques` are those of the
/// undisplaced pose.
fn largest_by_magnitude<M: ModelOwner>(
    model: &M,
    state: &State<M>,
    torques: &[Wrench<SpaceOf<M>>],
    iterations: u32,
    shift: f64,
) -> (f64, f64) {
    let view = model.view();
    let mut direction = model.per_body(Increment::default());
    start_direction(direction.as_mut());
    let mut response = model.per_body(Increment::<SpaceOf<M>>::default());
    let mut frames = model.per_body(FrameOf::<M>::default());
    let mut wrenches = model.per_body(Wrench::default());
    let mut moved = state.clone();
    let windows = model.per_load();
    let reaches = reaches(model);
    let mut found = (0.0, 0.0);
    for _ in 0..iterations {
        let scale = PROBE / largest_move(view.bodies, direction.as_ref(), reaches.as_ref());
        if !scale.is_finite() {
            return (0.0, 0.0);
        }
        for (i, sign) in [1.0, -1.0].into_iter().enumerate() {
            displace::<M>(
                view.bodies,
                state.bodies.as_ref(),
                direction.as_ref(),
                sign * scale,
                moved.bodies.as_mut(),
            );
            let turned = forces::evaluate_out_of_line::<M::Precision, M::Terms, DampersLeft>(
                &view,
                Instant {
                    step: 0,
                    windows: windows.as_ref(),
                    signals: state.signals.as_ref(),
                    bodies: moved.bodies.as_ref(),
                    in_line: false,
                    rests: &[],
                    placed: false,
                },
                Memories {
                    turns: moved.turns.as_mut(),
                    laws: &mut moved.laws,
                    at: At::Stage,
                    advance: None,
                },
                Evaluation {
                    frames: frames.as_mut(),
                    wrenches: wrenches.as_mut(),
                    unpushed: &mut [],
                },
            );
            if turned.is_err() {
                return (0.0, 0.0);
            }
            let rows = response.as_mut().iter_mut().zip(wrenches.as_ref()).zip(view.bodies);
            for ((out, wrench), body) in rows {
                let s = RealOf::<M>::from_f64(-0.5 * sign / scale);
                let m = body.inverse_mass.sqrt();
                let linear = wrench.force * (s * m);
                let angular = wrench.torque.scale(body.inverse_inertia.root()) * s;
                let base = if i == 0 { Increment::default() } else { *out };
                *out = Increment { linear: base.linear + linear, angular: base.angular + angular };
            }
        }
        let rows = response.as_mut().iter_mut().zip(direction.as_ref()).zip(torques);
        for (((out, x), rest), body) in rows.zip(view.bodies) {
            let i = body.inverse_inertia.root();
            let commutator =
                x.angular.scale(i).commutator(rest.torque).scale(i) * RealOf::<M>::HALF;
            out.angular = out.angular - commutator;
        }
        let (mut along, mut norm) = (0.0, 0.0);
        let s = RealOf::<M>::from_f64(shift);
        for (x, y) in direction.as_ref().iter().zip(response.as_mut()) {
            *y = Increment { linear: y.linear + x.linear * s, angular: y.angular + x.angular * s };
            along += x.linear.dot(y.linear).to_f64() + x.angular.dot(y.angular).to_f64();
            norm += y.linear.dot(y.linear).to_f64() + y.angular.dot(y.angular).to_f64();
        }
        let norm = libm::sqrt(norm);
        found = (along, norm);
        if !(norm > 0.0 && norm.is_finite()) {
            return (0.0, 0.0);
        }
        let inverse = RealOf::<M>::from_f64(1.0 / norm);
        for (x, y) in direction.as_mut().iter_mut().zip(response.as_ref()) {
            *x = Increment { linear: y.linear * inverse, angular: y.angular * inverse };
        }
    }
    found
}

/// A fixed unit vector without symmetry: multiples of the golden ratio, modulo 1, less a half.
fn start_direction<S: Space>(direction: &mut [Increment<S>]) {
    let mut golden = 0.0;
    let mut next = || {
        golden += 0.618_033_988_749_894_9;
        if golden >= 1.0 {
            golden -= 1.0;
        }
        golden - 0.5
    };
    let mut norm = 0.0;
    for x in direction.iter_mut() {
        let linear = [next(), next(), next()];
        let angular = [next(), next(), next()];
        norm += linear.iter().chain(&angular).map(|c| c * c).sum::<f64>();
        let (linear, angular) = (S::Vector::from_f64(linear), S::Moment::from_f64(angular));
        *x = Increment { linear, angular };
    }
    let inverse = S::Real::from_f64(1.0 / libm::sqrt(norm));
    for x in direction {
        *x = Increment { linear: x.linear * inverse, angular: x.angular * inverse };
    }
}

/// The largest component of `M^-1/2·x`; rotations count at the body's largest point distance.
fn largest_move<S: Space>(bodies: &[Body<S>], direction: &[Increment<S>], reaches: &[f64]) -> f64 {
    let mut largest = 0.0_f64;
    for ((body, x), &elongation) in bodies.iter().zip(direction).zip(reaches) {
        let elongation = S::Real::from_f64(if elongation > 1.0 { elongation } else { 1.0 });
        let linear = x.linear * body.inverse_mass.sqrt();
        let angular = x.angular.scale(body.inverse_inertia.root()) * elongation;
        for component in linear.to_f64().into_iter().chain(angular.to_f64()) {
            largest = if component.abs() > largest { component.abs() } else { largest };
        }
    }
    largest
}

/// `moved = state + scale·M^-1/2·direction`.
fn displace<M: ModelOwner>(
    bodies: &[Body<SpaceOf<M>>],
    state: &[BodyState<M::Precision>],
    direction: &[Increment<SpaceOf<M>>],
    scale: f64,
    moved: &mut [BodyState<M::Precision>],
) {
    let scale = RealOf::<M>::from_f64(scale);
    for (((body, state), x), moved) in bodies.iter().zip(state).zip(direction).zip(moved) {
        *moved = *state;
        let linear = x.linear * (scale * body.inverse_mass.sqrt());
        let angular = x.angular.scale(body.inverse_inertia.root()) * scale;
        M::Precision::translate(&mut moved.position, linear);
        let half = angular * RealOf::<M>::HALF;
        rotation::turn_by::<M::Precision>(&mut moved.orientation, half);
    }
}
