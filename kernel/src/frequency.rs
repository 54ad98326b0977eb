//! How fast a model can vibrate at a pose: a guaranteed bound and an estimate.
//!
//! `(model, state) => ω` \[rad/s\]. The bound is block Gershgorin on the mass-scaled tangent
//! stiffness: for a spring κ with rows `j_a`, `j_b` over its two bodies,
//! `(j_a·x_a + j_b·x_b)² ≤ 2·(j_a·x_a)² + 2·(j_b·x_b)²`, so `ω² ≤ max_b λ_max(Σ φ·κ·j·jᵀ)` with
//! φ = 2, or 1 where the other end is the world (Feingold & Varga 1962). A spring under the
//! tension T adds |T|/L along both normals of its line and |T|·|r| on each body's rotation.
//! A clearance counts as taken up, an actuator's pull as a tension. Loads and other inputs, whose
//! share of the stiffness is that of a weight and not of a spring, are left out.
//! The estimate is power iteration on differences of forces, one pair of evaluations each, on the
//! symmetric part of the stiffness alone: a torque τ that rests on a body, as that of a wound
//! spring, adds `½·φ × τ` to the response to a turn φ in body axes (the commutator of turns), which
//! is taken off again. Both speak for the pose, not for the future.

use crate::body::{Body, BodyState, Increment};
use crate::elements::input::InputKind;
use crate::elements::load::LoadFrame;
use crate::elements::point_law::taut;
use crate::forces::{self, At, DampersLeft, Evaluation, Instant, Turns, Wrench};
use crate::geometry::Geometry;
use crate::index::BodyIndex;
use crate::model::{FrameOf, ModelOwner, ModelRef, RealOf, SpaceOf, Terms};
use crate::pose::{Places, place_bodies, placed, twist_of};
use crate::real::Real;
use crate::rotation;
use crate::schedule::Signal;
use crate::space::{Linear, Moment, Space, Vector as _};
use crate::state::State;

/// A symmetric 6×6 matrix over (linear, angular), in full.
type Block<R> = [[R; 6]; 6];

/// Squarings of the block: `λ_max ≤ trace(S^n)^(1/n)`, n = 2^8, exceeds it by 6^(1/256) at most.
const SQUARINGS: usize = 8;

/// What rounding may take from a bound, in either precision, is given back.
const ROUNDING_MARGIN: f64 = 1.0 + 1e-6;

/// An upper bound of the highest angular frequency \[rad/s\] at the pose of `state`; 0 for a model
/// without springs. At most 0.4 % above the exact block bound.
pub fn bound<M: ModelOwner>(model: &M, state: &State<M>) -> RealOf<M> {
    let view = model.view();
    let bodies = state.bodies.as_ref();
    let mut frames = model.per_body(FrameOf::<M>::default());
    place_bodies::<M::Precision>(bodies, frames.as_mut());
    let frames = frames.as_ref();
    let places = Places { frames, signals: state.signals.as_ref() };
    let mut largest = RealOf::<M>::ZERO;
    for row in 0..bodies.len() {
        let eigenvalue = square_of(&view, places, bodies, state.turns.as_ref(), row);
        if eigenvalue > largest {
            largest = eigenvalue;
        }
    }
    largest.sqrt()
}

/// The square of the bound of what is mounted to one body, 0 where there is none.
pub(crate) fn square_of<P: Geometry, T: Terms>(
    view: &ModelRef<'_, P, T>,
    places: Places<'_, P>,
    bodies: &[BodyState<P>],
    turns: &[i32],
    row: usize,
) -> P::Real {
    let zero = P::Real::ZERO;
    let (Some(body), Some(frame)) = (view.bodies.get(row), places.frames.get(row)) else {
        return zero;
    };
    let here = BodyIndex(row as u16);
    let mut block = [[zero; 6]; 6];
    let mut add = |stiffness: P::Real, other: BodyIndex, u: P::Vector, moment: P::Moment| {
        let share = if other.is_world() { P::Real::ONE } else { P::Real::TWO };
        let n = P::moment_to_body(frame, moment);
        add_row(&mut block, share * stiffness, scaled(body, u, n));
    };
    let mut turning = zero;
    for (number, group) in view.groups.iter().enumerate() {
        let at_a = group.a == here;
        if !(at_a || group.b == here) {
            continue;
        }
        let other = if at_a { group.b } else { group.a };
        for i in 0..group.elements() {
            let Some(e) = placed(view, places, (number, group), i) else { continue };
            let Some(law) = view.element(group.law, e.index) else { continue };
            let arm = if at_a { e.arm_a } else { e.arm_b };
            let mut add = |stiffness, u: P::Vector| add(stiffness, other, u, arm.cross(u));
            turning = turning + law.tangent(&e.stretch, arm, &mut add);
        }
    }
    for (input, signal) in view.inputs.iter().zip(places.signals) {
        let InputKind::Actuator { group, element } = input.kind else { continue };
        let row = group as usize;
        let group = view.groups.get(row);
        let element = group.and_then(|g| placed(view, places, (row, g), element as usize));
        let Some(e) = element else { continue };
        let ends = [(e.group.a, e.group.b, e.arm_a), (e.group.b, e.group.a, e.arm_b)];
        for (_, other, arm) in ends.into_iter().filter(|(body, ..)| *body == here) {
            let mut add = |stiffness, u: P::Vector| add(stiffness, other, u, arm.cross(u));
            let tension = signal.value.abs();
            turning = turning + taut(tension, e.stretch.displacement, arm, &mut add);
        }
    }
    for (spring, &turns) in view.torsions.iter().zip(turns) {
        let other = if spring.a == here {
            spring.b
        } else if spring.b == here {
            spring.a
        } else {
            continue;
        };
        let Some(twist) = twist_of::<P>(spring, bodies, turns) else { continue };
        let gradient = match places.frames.get(spring.a.row()) {
            Some(frame) => P::moment_to_world(frame, twist.gradient),
            None => twist.gradient,
        };
        add(spring.stiffness, other, P::Vector::ZERO, gradient);
        turning = turning + spring.turning(twist.angle, gradient);
    }
    for axis in P::Moment::axes() {
        add_row(&mut block, turning, scaled(body, P::Vector::ZERO, axis));
    }
    largest_eigenvalue(block)
}

/// `M^-1/2·(u, n)`.
fn scaled<S: Space>(body: &Body<S>, u: S::Vector, n: S::Moment) -> [S::Real; 6] {
    let m = body.inverse_mass.sqrt();
    let i = body.inverse_inertia.in_space();
    let (u, n) = (u.in_space(), n.in_space());
    [u.x * m, u.y * m, u.z * m, n.x * i.x.sqrt(), n.y * i.y.sqrt(), n.z * i.z.sqrt()]
}

/// Adds `stiffness·j·jᵀ`.
fn add_row<R: Real>(block: &mut Block<R>, stiffness: R, j: [R; 6]) {
    for (row, a) in block.iter_mut().zip(j) {
        for (entry, b) in row.iter_mut().zip(j) {
            *entry = *entry + stiffness * a * b;
        }
    }
}

/// An upper bound of the largest eigenvalue of a positive semidefinite block.
fn largest_eigenvalue<R: Real>(mut block: Block<R>) -> R {
    let mut traces = [R::ZERO; SQUARINGS + 1];
    for (k, slot) in traces.iter_mut().enumerate() {
        let mut trace = R::ZERO;
        for (i, row) in block.iter().enumerate() {
            trace = trace + row[i];
        }
        *slot = trace;
        if trace == R::ZERO || k == SQUARINGS {
            break;
        }
        let inverse = R::ONE / trace;
        for row in &mut block {
            for entry in row {
                *entry = *entry * inverse;
            }
        }
        let s = block;
        for (i, row) in block.iter_mut().enumerate() {
            for (j, entry) in row.iter_mut().enumerate() {
                *entry = s[i].iter().zip(&s).fold(R::ZERO, |sum, (a, b)| sum + *a * b[j]);
            }
        }
    }
    // S = t0·S1 with trace 1, S1² = t1·S2, …: λ ≤ t0·√(t1·√(t2·…)).
    let mut eigenvalue = R::ONE;
    for trace in traces.iter().rev() {
        eigenvalue = *trace * eigenvalue.sqrt();
    }
    eigenvalue * R::from_f64(ROUNDING_MARGIN)
}

/// Largest displacement \[m\] and turn \[rad\] of the estimate's differences.
const PROBE: f64 = 1e-6;

/// The share of the response that lies along a direction, from which on the eigenvalues it mixes
/// are positive.
const CLEARLY_POSITIVE: f64 = 0.99;

/// A lower estimate of the highest angular frequency \[rad/s\] at the pose of `state`, by
/// `iterations` power iterations on the symmetric part of `M^-1/2·K·M^-1/2`; each takes two force
/// evaluations. Not above the true frequency of the elements, but for the rounding of the
/// differences, about 1e-8 of it, as every Rayleigh quotient of a symmetric matrix; torques and
/// forces that turn with a body, which have no energy, are left out. Meant for double precision:
/// forces are differenced over 1e-6 m.
pub fn estimate<M: ModelOwner>(model: &M, state: &State<M>, iterations: u32) -> f64 {
    let mut rest = state.clone();
    for (signal, input) in rest.signals.as_mut().iter_mut().zip(model.view().inputs) {
        let has_energy = match input.kind {
            InputKind::Actuator { .. } | InputKind::Anchor { .. } => true,
            InputKind::Force { frame, .. } => frame == LoadFrame::World,
            InputKind::Torque { .. } | InputKind::JointTorque { .. } => false,
        };
        if !has_energy {
            *signal = Signal::default();
        }
    }
    let Some(torques) = torques(model, &rest) else { return 0.0 };
    let power = |shift| largest_by_magnitude(model, &rest, torques.as_ref(), iterations, shift);
    let (mut square, radius) = power(0.0);
    if square < CLEARLY_POSITIVE * radius {
        // Compressed springs can have the largest eigenvalue by magnitude, a negative one, or one
        // that rivals the positive; a shift by it leaves the positive ones at the top.
        square = power(radius).0 - radius;
    }
    libm::sqrt(if square > 0.0 { square } else { 0.0 })
}

/// The torques at rest, body axes; `None` where a twist is undefined.
fn torques<M: ModelOwner>(model: &M, state: &State<M>) -> Option<M::PerBody<Wrench<SpaceOf<M>>>> {
    let mut frames = model.per_body(FrameOf::<M>::default());
    let mut wrenches = model.per_body(Wrench::default());
    forces::evaluate::<M::Precision, M::Terms, DampersLeft>(
        &model.view(),
        Instant {
            step: 0,
            windows: model.per_load().as_ref(),
            signals: state.signals.as_ref(),
            bodies: state.bodies.as_ref(),
        },
        Turns { counts: state.turns.clone().as_mut(), at: At::Stage },
        Evaluation { frames: frames.as_mut(), wrenches: wrenches.as_mut() },
    )
    .ok()?;
    Some(wrenches)
}

/// The eigenvalue of the symmetric part of `M^-1/2·K·M^-1/2 + shift·I` \[1/s²\] of the largest
/// magnitude, and the magnitude of the response, which is that of the eigenvalue but where several
/// mix. `torques` are those at rest.
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
    let mut found = (0.0, 0.0);
    for _ in 0..iterations {
        let scale = PROBE / largest_move(view.bodies, direction.as_ref());
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
            let turned = forces::evaluate::<M::Precision, M::Terms, DampersLeft>(
                &view,
                Instant {
                    step: 0,
                    windows: windows.as_ref(),
                    signals: state.signals.as_ref(),
                    bodies: moved.bodies.as_ref(),
                },
                Turns { counts: moved.turns.as_mut(), at: At::Stage },
                Evaluation { frames: frames.as_mut(), wrenches: wrenches.as_mut() },
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

/// The largest component of `M^-1/2·x`.
fn largest_move<S: Space>(bodies: &[Body<S>], direction: &[Increment<S>]) -> f64 {
    let mut largest = 0.0_f64;
    for (body, x) in bodies.iter().zip(direction) {
        let linear = x.linear * body.inverse_mass.sqrt();
        let angular = x.angular.scale(body.inverse_inertia.root());
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

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn the_eigenvalue_bound_is_tight_and_above() {
        let mut block = [[0.0; 6]; 6];
        add_row(&mut block, 3.0, [1.0, 2.0, 0.0, 0.0, 0.0, 1.0]);
        add_row(&mut block, 1.0, [0.0, 0.0, 1.0, 0.0, 0.0, 0.0]);
        let exact = 3.0 * 6.0;
        let bound = largest_eigenvalue(block);
        assert!(bound >= exact && bound < exact * 1.008, "{bound}");
        assert_eq!(largest_eigenvalue([[0.0_f64; 6]; 6]), 0.0);
    }
}
