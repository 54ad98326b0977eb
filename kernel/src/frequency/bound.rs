//! The guaranteed bound, body by body.
//!
//! `(model, pose) => per body its block of the mass-scaled stiffness => λ_max`. Every mount is visited once and adds to
//! the blocks of its two bodies, in the order of each body's sums.

use crate::body::{Body, BodyState};
use crate::elements::input::InputKind;
use crate::elements::point_law::{Turning, geometric_stiffness};
use crate::force_pair::Direction;
use crate::geometry::Geometry;
use crate::index::BodyIndex;
use crate::laws::{Instant, Laws as _};
use crate::model::{FrameOf, ModelOwner, ModelRef, RealOf, StatesIn, Terms};
use crate::pose::{Places, held_turns, place_bodies, placed, torsion_angle_of};
use crate::real::Real;
use crate::space::{Linear as _, Space, Vector as _};
use crate::state::State;

/// A symmetric 6×6 matrix over (linear, angular), in full.
type Block<R> = [[R; 6]; 6];

/// Squarings of the block: `λ_max ≤ trace(S^n)^(1/n)`, n = 2^8, exceeds it by 6^(1/256) at most.
const SQUARINGS: usize = 8;

/// Compensates the rounding of a bound, in either precision.
const ROUNDING_MARGIN: f64 = 1.0 + 1e-6;

/// An upper bound of the highest angular frequency \[rad/s\] at the pose of `state`; 0 for a model without springs. At
/// most 0.4 % above the exact block bound. Points of each element are computed once per body, and each body's block is
/// stored until all are complete: 148 bytes per body of a spatial model in single precision.
pub fn bound<M: ModelOwner>(model: &M, state: &State<M>) -> RealOf<M> {
    let view = model.view();
    let bodies = state.bodies.as_ref();
    let mut frames = model.per_body(FrameOf::<M>::default());
    place_bodies::<M::Precision>(bodies, frames.as_mut());
    let places = Places { frames: frames.as_ref(), signals: state.signals.as_ref() };
    let memories = (state.turns.as_ref(), &state.laws);
    let pose = Pose { view: &view, places, bodies, memories };
    let mut blocks = model.per_body(BodyBlock::default());
    pose.each_mount(|mount, [a, b]| {
        for here in [Some(a), (a != b).then_some(b)].into_iter().flatten() {
            if let Some(block) = blocks.as_mut().get_mut(here.row()) {
                pose.add(mount, here, block);
            }
        }
    });
    let mut largest = RealOf::<M>::ZERO;
    for (row, block) in blocks.as_ref().iter().enumerate() {
        let eigenvalue = pose.eigenvalue(row, *block);
        if eigenvalue > largest {
            largest = eigenvalue;
        }
    }
    // λ_max of a positive matrix of two blocks is at most the sum of theirs.
    let mut own = RealOf::<M>::ZERO;
    view.laws.look_at_all(&state.laws, &mut |_, law| {
        let square = law.inner_square();
        if square > own {
            own = square;
        }
    });
    (largest + own).sqrt()
}

/// The square of the bound for the mounts of one body, 0 without any.
pub(crate) fn square_of<P: Geometry, T: Terms<P>>(
    view: &ModelRef<'_, P, T>,
    places: Places<'_, P>,
    bodies: &[BodyState<P>],
    memories: (&[i32], &StatesIn<P, T>),
    row: usize,
) -> P::Real {
    let pose = Pose { view, places, bodies, memories };
    let here = BodyIndex(row as u16);
    let mut block = BodyBlock::default();
    pose.each_mount(|mount, [a, b]| {
        if a == here || b == here {
            pose.add(mount, here, &mut block);
        }
    });
    pose.eigenvalue(row, block)
}

/// The contributions of mounts to one of their bodies.
#[derive(Clone, Copy)]
struct BodyBlock<R> {
    stiffness: Block<R>,
    /// \[N·m/rad\] about any axis.
    turning: R,
}

impl<R: Real> Default for BodyBlock<R> {
    fn default() -> Self {
        Self { stiffness: [[R::ZERO; 6]; 6], turning: R::ZERO }
    }
}

/// A part with a stiffness, by its row.
#[derive(Clone, Copy)]
enum Mount {
    Group(usize),
    Actuator(usize),
    Torsion(usize),
    Law(usize),
    /// A branch of a law, by its index.
    Branch(usize, usize),
}

/// A model at a pose.
struct Pose<'s, 'm, P: Geometry, T: Terms<P>> {
    view: &'s ModelRef<'m, P, T>,
    places: Places<'s, P>,
    bodies: &'s [BodyState<P>],
    /// Revolution counts of torsion springs, memories of laws.
    memories: (&'s [i32], &'s StatesIn<P, T>),
}

impl<P: Geometry, T: Terms<P>> Pose<'_, '_, P, T> {
    /// The instant, as laws see it.
    fn at(&self) -> Instant<'_, P> {
        let Places { frames, signals, .. } = self.places;
        Instant { frames, bodies: self.bodies, signals }
    }

    /// Visits all parts with a stiffness with their two ends, in the order of each body's sums.
    #[inline(always)]
    fn each_mount(&self, mut visit: impl FnMut(Mount, [BodyIndex; 2])) {
        for (row, group) in self.view.groups.iter().enumerate() {
            visit(Mount::Group(row), [group.a, group.b]);
        }
        for (row, input) in self.view.inputs.iter().enumerate() {
            let InputKind::Actuator { group, .. } = input.kind else { continue };
            if let Some(group) = self.view.groups.get(group.row()) {
                visit(Mount::Actuator(row), [group.a, group.b]);
            }
        }
        for (row, spring) in self.view.torsions.iter().enumerate() {
            visit(Mount::Torsion(row), [spring.a, spring.b]);
        }
        let at = self.at();
        self.view.laws.look_at_all(self.memories.1, &mut |row, law| {
            visit(Mount::Law(row), law.bodies());
            if law.most_branches() > 0
                && let Some(seen) = law.seen(at)
            {
                for (place, branch) in law.branches(&seen).iter().enumerate() {
                    visit(Mount::Branch(row, place), branch.bodies);
                }
            }
        });
    }

    /// The end of a pair that a body is, and the factor of a spring to the other end.
    #[inline(always)]
    fn end_of(&self, ends: [BodyIndex; 2], here: BodyIndex) -> (usize, P::Real) {
        let end = usize::from(ends[0] != here);
        (end, if self.is_still(ends[1 - end]) { P::Real::ONE } else { P::Real::TWO })
    }

    /// Whether no force moves an end: the ground or a driven body.
    #[inline(always)]
    fn is_still(&self, end: BodyIndex) -> bool {
        let body = || self.view.bodies.get(end.row());
        end.is_world() || (T::DRIVEN && body().is_some_and(Body::is_driven))
    }

    /// Adds the contribution of a mount to the body `here`, one of its ends.
    fn add(&self, mount: Mount, here: BodyIndex, to: &mut BodyBlock<P::Real>) {
        let Self { view, places, .. } = *self;
        let row = here.row();
        let (Some(body), Some(frame)) = (view.bodies.get(row), places.frames.get(row)) else {
            return;
        };
        let BodyBlock { stiffness: block, turning } = to;
        let add = |block: &mut Block<P::Real>, stiffness, other: BodyIndex, u, moment| {
            let share = if self.is_still(other) { P::Real::ONE } else { P::Real::TWO };
            let n = P::moment_to_body(frame, moment);
            add_row(block, share * stiffness, scaled(body, u, n));
        };
        let turn = |block: &mut Block<P::Real>, arm, force| {
            add_force(block, body, P::to_body(frame, arm), P::to_body(frame, force));
        };
        match mount {
            Mount::Group(number) => {
                let Some(group) = view.groups.get(number) else { return };
                let at_a = group.a == here;
                let other = if at_a { group.b } else { group.a };
                for i in 0..group.elements() {
                    let Some(e) = placed(view, places, (number, group), i) else { continue };
                    let Some(law) = view.element(group.law, e.index) else { continue };
                    let arm = if at_a { e.arm_a } else { e.arm_b };
                    let (turns, count) = held_turns(view, places, group, e.index);
                    for held in turns.into_iter().take(count) {
                        add(block, law.stiffness(), other, P::Vector::ZERO, held);
                    }
                    let mut along =
                        |stiffness, u: P::Vector| add(block, stiffness, other, u, arm.cross(u));
                    let turned = law.tangent(&e.deformation, arm, &mut along);
                    *turning = *turning + turned.rest;
                    if group.clearance.row().is_none() {
                        turn(block, arm, if at_a { turned.force } else { -turned.force });
                    } else {
                        // Its force may be smaller than with its clearance closed.
                        let Turning { force, .. } = turned;
                        *turning = *turning + (force.dot(force) * arm.dot(arm)).sqrt();
                    }
                }
            }
            Mount::Actuator(input) => {
                let Some((input, signal)) = view.inputs.iter().zip(places.signals).nth(input)
                else {
                    return;
                };
                let InputKind::Actuator { group, element } = input.kind else { return };
                let row = group.row();
                let group = view.groups.get(row);
                let element = group.and_then(|g| placed(view, places, (row, g), element as usize));
                let Some(e) = element else { return };
                let one = P::Real::ONE;
                let ends =
                    [(e.group.a, e.group.b, e.arm_a, one), (e.group.b, e.group.a, e.arm_b, -one)];
                for (_, other, arm, sign) in ends.into_iter().filter(|(body, ..)| *body == here) {
                    let mut along =
                        |stiffness, u: P::Vector| add(block, stiffness, other, u, arm.cross(u));
                    let turned =
                        geometric_stiffness(signal.value, e.deformation.displacement, &mut along);
                    turn(block, arm, turned.force * sign);
                }
            }
            Mount::Torsion(spring) => {
                let Some((spring, &turns)) =
                    view.torsions.iter().zip(P::Real::counts(self.memories.0)).nth(spring)
                else {
                    return;
                };
                let other = if spring.a == here { spring.b } else { spring.a };
                let Some(torsion_angle) = torsion_angle_of::<P>(spring, self.bodies, turns) else {
                    return;
                };
                let gradient = match places.frames.get(spring.a.row()) {
                    Some(frame) => P::moment_to_world(frame, torsion_angle.gradient),
                    None => torsion_angle.gradient,
                };
                add(block, spring.stiffness, other, P::Vector::ZERO, gradient);
                *turning = *turning + spring.turning(torsion_angle.angle, gradient);
            }
            Mount::Law(row) => {
                view.laws.look(row, self.memories.1, &mut |law| {
                    let ends = law.bodies();
                    let Some(seen) = law.seen(self.at()) else { return };
                    let (end, share): (_, P::Real) = self.end_of(ends, here);
                    // (Σ rᵢ)² ≤ n·Σ rᵢ²: a spring along n directions counts at most n times each.
                    let branches = law.branches(&seen);
                    let mut terms =
                        branches.iter().fold(P::Real::ONE, |terms, _| terms + P::Real::ONE);
                    let turned = law.tangent(&seen, &mut |stiffness, direction| {
                        let moment = direction.moments[end];
                        let stiffness = share * stiffness * terms;
                        terms = P::Real::ONE;
                        add_row(block, stiffness, scaled(body, direction.along, moment));
                    });
                    *turning = *turning + turned[end];
                });
            }
            Mount::Branch(row, place) => view.laws.look(row, self.memories.1, &mut |law| {
                let Some(seen) = law.seen(self.at()) else { return };
                let mut first = None;
                law.tangent(&seen, &mut |stiffness, _| {
                    first.get_or_insert(stiffness);
                });
                let Some(stiffness) = first else { return };
                let branches = law.branches(&seen);
                let terms = branches.iter().fold(P::Real::ONE, |terms, _| terms + P::Real::ONE);
                let Some(branch) = branches.iter().nth(place) else { return };
                let (end, share): (_, P::Real) = self.end_of(branch.bodies, here);
                let mut add = |stiffness: P::Real, direction: &Direction<P::Space>| {
                    let moment = direction.moments[end];
                    add_row(block, share * stiffness, scaled(body, direction.along, moment));
                };
                add(stiffness * terms, &branch.direction);
                let turned = law.branch_tangent(place, &seen, &mut add);
                *turning = *turning + turned[end];
            }),
        }
    }

    /// The bound of the eigenvalues of a body's block with all mounts.
    fn eigenvalue(&self, row: usize, block: BodyBlock<P::Real>) -> P::Real {
        let Some(body) = self.view.bodies.get(row) else { return P::Real::ZERO };
        let BodyBlock { mut stiffness, turning } = block;
        for axis in P::Moment::axes() {
            add_row(&mut stiffness, turning, scaled(body, P::Vector::ZERO, axis));
        }
        largest_eigenvalue(stiffness)
    }
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

/// Adds the effect of a force at a lever arm, both in body axes, on a rotation φ of the body:
/// `φᵀ·((r·F)·I − ½·(r·Fᵀ + F·rᵀ))·φ`, which is 0 about an axis along which both are.
fn add_force<S: Space>(
    block: &mut Block<S::Real>,
    body: &Body<S>,
    arm: S::Vector,
    force: S::Vector,
) {
    let along = arm.dot(force);
    let i = body.inverse_inertia.in_space();
    let roots = [i.x, i.y, i.z].map(Real::sqrt);
    let (r, f) = (arm.in_space(), force.in_space());
    let (r, f) = ([r.x, r.y, r.z], [f.x, f.y, f.z]);
    for (a, row) in block[3..].iter_mut().enumerate() {
        for (b, entry) in row[3..].iter_mut().enumerate() {
            let mut turned = -(S::Real::HALF * (r[a] * f[b] + f[a] * r[b]));
            if a == b {
                turned = along + turned;
            }
            *entry = *entry + turned * roots[a] * roots[b];
        }
    }
}

/// An upper bound of the largest eigenvalue by magnitude of a symmetric block.
fn largest_eigenvalue<R: Real>(mut block: Block<R>) -> R {
    let mut traces = [R::ZERO; SQUARINGS + 1];
    for (k, slot) in traces.iter_mut().enumerate() {
        // The block is normalised so that squares are finite, its squares by the trace.
        let mut trace = R::ZERO;
        for (i, row) in block.iter().enumerate() {
            trace = trace + row[i].abs();
        }
        if k == 0 {
            for entry in block.iter().flatten() {
                let entry = entry.abs();
                trace = if entry > trace { entry } else { trace };
            }
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

#[cfg(test)]
mod tests {
    use super::*;
    use crate::geometry::F64;
    use crate::model_spec::{ModelSpec, Spring, Start};

    const WORLD: BodyIndex = BodyIndex::WORLD;
    const SPRING: Spring = Spring { stiffness: 300.0, damping: 0.0, free_length: 0.1 };

    /// Springs in both directions between three bodies and the world in no order, under tension, and a wound one.
    const MODEL_SPEC: ModelSpec = ModelSpec::new()
        .body(2.0, [0.1, 0.2, 0.15], Start::at([0.0, 0.1, 0.2]))
        .body(1.0, [0.2, 0.1, 0.15], Start::at([0.5, -0.1, 0.3]))
        .body(0.5, [0.3, 0.2, 0.25], Start::at([0.2, 0.7, -0.4]))
        .tsda([BodyIndex(2), BodyIndex(0)], [[0.1, 0.0, 0.0], [0.0, 0.2, 0.1]], SPRING)
        .tsda([WORLD, BodyIndex(1)], [[0.0; 3], [0.1, 0.2, 0.0]], SPRING)
        .tsda([BodyIndex(0), BodyIndex(1)], [[0.0, 0.1, 0.0], [0.3, 0.0, 0.1]], SPRING)
        .tsda([BodyIndex(2), WORLD], [[0.0, 0.1, 0.2], [0.5; 3]], SPRING)
        .torsion_spring([BodyIndex(1), BodyIndex(2)], [0.0, 0.0, 1.0], 20.0, 0.0, 3.0);

    crate::model!(static MODEL: F64 = MODEL_SPEC);

    /// All bodies in one pass and each separately: the same bits, because [`crate::watch`] compares them.
    #[test]
    fn the_bound_is_that_of_the_stiffest_body() {
        let state = State::initial(&MODEL);
        let mut frames = MODEL.per_body(<F64 as Geometry>::Frame::default());
        place_bodies::<F64>(state.bodies.as_ref(), frames.as_mut());
        let places = Places { frames: frames.as_ref(), signals: state.signals.as_ref() };
        let of = |row| {
            square_of(&MODEL.view(), places, &state.bodies, (&state.turns[..], &state.laws), row)
        };
        let [a, b, c] = [of(0), of(1), of(2)];
        assert!(a > 0.0 && b > 0.0 && c > 0.0 && a != b && b != c, "{a} {b} {c}");
        assert_eq!(bound(&MODEL, &state), a.max(b).max(c).sqrt());
        assert_eq!(of(3), 0.0);
    }

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
