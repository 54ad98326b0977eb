//! The matrix `μ·M + Σ w·j·jᵀ` at a pose: masses, and every element as a set of springs.
//!
//! `(model, pose, weights) => blocks`. Velocities and angular velocities are in world axes. Only the material part of
//! an element's tangent, which no pose and no load makes indefinite: springs along its directions, `w = κ·k + χ·c` of
//! stiffness and damping. Its geometric stiffness is left out.

use crate::body::BodyState;
use crate::damping::{Direction, Far, FarHeld};
use crate::elements::element::Element;
use crate::elements::point_law::Deformation;
use crate::forces::springs;
use crate::freedoms::Freedoms;
use crate::geometry::Geometry;
use crate::index::BodyIndex;
use crate::laws::{Instant, Laws as _, Row as Law, Seen};
use crate::model::{Group, ModelRef, Plan, StatesIn, Terms};
use crate::pose::{End, Places, gradient_of, held_turns, placed};
use crate::real::Real;
use crate::solve::lumped_joint::LumpedJoint;
use crate::solve::matrix_weights::{MatrixWeights, damping_of};
use crate::solve::system::System;
use crate::space::{BlockOf, Linear as _, Space, Vector as _};

/// Writes the matrix.
pub(crate) fn assemble<P: Geometry, T: Terms<P>>(
    model: &ModelRef<'_, P, T>,
    places: Places<'_, P>,
    bodies: &[BodyState<P>],
    (matrix_weights, lumped_joints): (MatrixWeights<P::Real>, &[LumpedJoint<P::Space>]),
    memories: &StatesIn<P, T>,
    system: &mut System<'_, P::Space>,
) {
    if T::ALL {
        system.clear_pairs();
    } else {
        system.pairs.fill(Row::<P>::EMPTY);
    }
    let rows = system.diagonal.iter_mut().zip(model.bodies).zip(places.frames);
    for ((block, body), frame) in rows {
        let (mass, inertia) = (matrix_weights.mass * body.mass, body.inertia * matrix_weights.mass);
        P::Space::set_mass(mass, inertia, P::moment_axes(frame), block);
    }
    for (number, group) in model.groups.iter().enumerate() {
        let mut mount = Mount::new(system, [group.a, group.b], number);
        match lumped_joints.get(number) {
            Some(lumped_joint) if P::Real::ZERO < lumped_joint.point => {
                mount.hold(model, places, group, lumped_joint)
            }
            _ => add_group(model, places, (number, group), matrix_weights, &mut mount),
        }
    }
    if T::TORSIONS {
        for (row, spring) in model.torsions.iter().enumerate() {
            let Some(gradient) = gradient_of::<P>(spring, bodies) else { continue };
            let gradient = End::new(model, places, spring.a, None).moment_to_world(gradient);
            let damping = spring.damper.row().and_then(|row| model.dampers.get(row).copied());
            let weight = matrix_weights.weight(spring.stiffness, damping.unwrap_or(P::Real::ZERO));
            let mut mount = Mount::new(system, [spring.a, spring.b], model.groups.len() + row);
            mount.add(weight, P::Vector::ZERO, [gradient; 2]);
        }
    }
    let before = model.groups.len() + model.torsions.len();
    let at = Instant { frames: places.frames, bodies, signals: places.signals };
    model.laws.look_at_all(memories, &mut |row, law| {
        let ends = law.bodies();
        let Some(seen) = law.seen(at) else { return };
        if law.most_branches() > 0 {
            return along(law, &seen, (matrix_weights, places.frames), system);
        }
        let mut mount = Mount::new(system, ends, before + row);
        // Velocities and rotations of the matrix are in world axes.
        let mut add = |weight, direction: &Direction<P::Space>| {
            let [a, b] = direction.moments;
            let moments = [seen.a.moment_to_world(a), seen.b.moment_to_world(b)];
            mount.add(weight, direction.along, moments);
        };
        law.tangent(&seen, &mut |stiffness, direction| {
            add(matrix_weights.weight(stiffness, P::Real::ZERO), direction);
        });
        law.each_damper(&seen, &mut |_, damper| {
            add(matrix_weights.weight(P::Real::ZERO, damper.coefficient), &damper.direction);
        });
    });
}

/// A spring and a damper along the directions of a law and of its branches, for all pairs of their bodies.
fn along<P: Geometry>(
    law: &dyn Law<P>,
    seen: &Seen<'_, P>,
    (matrix_weights, frames): (MatrixWeights<P::Real>, &[P::Frame]),
    system: &mut System<'_, P::Space>,
) {
    let (mut own, mut damping) = (None, P::Real::ZERO);
    law.tangent(seen, &mut |stiffness, direction| {
        own.get_or_insert((stiffness, *direction));
    });
    law.each_damper(seen, &mut |_, damper| damping = damping + damper.coefficient);
    let Some((stiffness, direction)) = own else { return };
    let mut far = Far::<P>::default();
    far.add(law.bodies(), &direction);
    law.branches(seen).iter().for_each(|branch| far.add(branch.bodies, &branch.direction));
    let weight = matrix_weights.weight(stiffness, damping);
    let row = |held: &FarHeld<P>| {
        let moment = frames.get(held.row).map(|frame| P::moment_to_world(frame, held.moment));
        P::Space::row(held.along, moment.unwrap_or(held.moment))
    };
    for (place, first) in far.iter().enumerate() {
        if let Some(block) = system.diagonal.get_mut(first.row) {
            row(first).add_square(weight, block);
        }
        for second in far.iter().take(place) {
            let found = system.plan.pairs.iter().position(|pair| {
                let [a, b] = pair.map(usize::from);
                (a, b) == (first.row, second.row) || (b, a) == (first.row, second.row)
            });
            let Some(pair) = found else { continue };
            let ordered =
                system.plan.pairs.get(pair).is_some_and(|[a, _]| usize::from(*a) == first.row);
            let Some(block) = system.pairs.get_mut(pair) else { continue };
            let (rows, columns) = if ordered { (second, first) } else { (first, second) };
            row(rows).add_product(weight, &row(columns), block);
        }
    }
}

type Row<P> = <<P as Geometry>::Space as Space>::Row;

/// Element by element.
fn add_group<P: Geometry, T: Terms<P>>(
    model: &ModelRef<'_, P, T>,
    places: Places<'_, P>,
    (number, group): (usize, &Group),
    matrix_weights: MatrixWeights<P::Real>,
    mount: &mut Mount<'_, P::Space>,
) {
    for i in 0..group.elements() {
        let Some(element) = placed(model, places, (number, group), i) else { continue };
        let Some(law) = model.element(group.law, element.index) else { continue };
        let weight = matrix_weights.weight(law.stiffness(), damping_of(model, group, i));
        let arms = [element.arm_a, element.arm_b];
        match law {
            Element::PointBushing(_) => mount.hold_point(weight, arms),
            Element::Universal(_) => mount.hold_point(weight, arms),
            Element::Revolute(revolute) => {
                mount.hold_point(weight, arms);
                let Deformation { direction, ratio, .. } = element.deformation;
                let more = weight * (ratio - P::Real::ONE);
                mount.add(more, direction, arms.map(|arm| arm.cross(direction)));
                let lever = revolute.levers[0];
                mount.hold_axis(weight * lever.dot(lever), direction);
                continue;
            }
            Element::Tsda(_) | Element::PointOnLine(_) => {
                let known = (damping_of(model, group, i), model.clearance(group));
                let Some(springs) = springs(model, &law, &element.deformation, known) else {
                    continue;
                };
                let parts = springs.directions.into_iter().zip(springs.constants);
                for (u, [k, c]) in parts.take(springs.count) {
                    mount.add(matrix_weights.weight(k, c), u, arms.map(|arm| arm.cross(u)));
                }
            }
        }
        let (turns, count) = held_turns(model, places, group, element.index);
        for turn in turns.into_iter().take(count) {
            mount.add(weight, P::Vector::ZERO, [turn, turn]);
        }
    }
}

/// The blocks of two ends.
struct Mount<'s, S: Space> {
    diagonal: &'s mut [BlockOf<S>],
    ends: [BodyIndex; 2],
    /// The block of both, and whether its rows are those of the second end.
    pair: Option<(&'s mut BlockOf<S>, bool)>,
}

impl<'s, S: Space> Mount<'s, S> {
    fn new(system: &'s mut System<'_, S>, ends: [BodyIndex; 2], number: usize) -> Self {
        let Plan { pairs, slots, .. } = system.plan;
        let slot = slots.get(number).map_or(usize::MAX, |slot| *slot as usize);
        let pair = pairs.get(slot).map(|[first, _]| *first == ends[0].0);
        let pair = pair.and_then(|ordered| Some((system.pairs.get_mut(slot)?, ordered)));
        Self { diagonal: system.diagonal, ends, pair }
    }

    /// Adds a spring along `u`, with the moments of a unit force at the points of both ends.
    #[inline(always)]
    fn add(&mut self, weight: S::Real, u: S::Vector, moments: [S::Moment; 2]) {
        let [a, b] = moments.map(|moment| S::row(u, moment));
        for (end, row) in self.ends.into_iter().zip([&a, &b]) {
            if let Some(block) = self.diagonal.get_mut(end.row()) {
                row.add_square(weight, block);
            }
        }
        if let Some((block, ordered)) = &mut self.pair {
            let (rows, columns) = if *ordered { (&b, &a) } else { (&a, &b) };
            rows.add_product(-weight, columns, block);
        }
    }

    /// Adds a point at both lever arms.
    #[inline(always)]
    fn hold_point(&mut self, weight: S::Real, arms: [S::Vector; 2]) {
        for (end, arm) in self.ends.into_iter().zip(arms) {
            if let Some(block) = self.diagonal.get_mut(end.row()) {
                S::add_point(weight, arm, block);
            }
        }
        if let Some((block, ordered)) = &mut self.pair {
            let [a, b] = arms;
            S::take_points(weight, if *ordered { [b, a] } else { [a, b] }, block);
        }
    }

    /// Adds an axis.
    #[inline(always)]
    fn hold_axis(&mut self, weight: S::Real, axis: S::Vector) {
        for end in self.ends {
            if let Some(block) = self.diagonal.get_mut(end.row()) {
                S::add_across(weight, axis, block);
            }
        }
        if let Some((block, _)) = &mut self.pair {
            S::take_across(weight, axis, block);
        }
    }

    /// Adds a lumped joint.
    #[inline(always)]
    fn hold<P: Geometry<Space = S, Real = S::Real, Vector = S::Vector>, T: Terms<P>>(
        &mut self,
        model: &ModelRef<'_, P, T>,
        places: Places<'_, P>,
        group: &Group,
        lumped_joint: &LumpedJoint<S>,
    ) {
        let [a, b] = [group.a, group.b].map(|end| End::new(model, places, end, None));
        let arms = [a.to_world(lumped_joint.arms[0]), b.to_world(lumped_joint.arms[1])];
        self.hold_point(lumped_joint.point, arms);
        if S::Real::ZERO < lumped_joint.across {
            let axis = a.to_world(lumped_joint.axis);
            self.hold_axis(lumped_joint.across, axis);
            // No joint in a plane has it.
            if S::Vector::DIMENSION > 2 && lumped_joint.along != S::Real::ZERO {
                self.add(lumped_joint.along, axis, arms.map(|arm| arm.cross(axis)));
            }
        }
    }
}
