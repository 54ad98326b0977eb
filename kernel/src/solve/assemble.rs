//! The matrix `μ·M + Σ w·j·jᵀ` at a pose: masses, and every element as the springs that it is made of.
//!
//! `(model, pose, weights) => blocks`. Velocities and angular velocities along the world's axes. Of an
//! element's tangent the material part alone, which no pose and no load makes indefinite: springs along
//! its directions, `w = κ·k + χ·c` of stiffness and damping. What its tension adds as it turns is left out.

use crate::body::BodyState;
use crate::elements::element::Element;
use crate::geometry::Geometry;
use crate::index::BodyIndex;
use crate::model::{Group, ModelRef, Terms};
use crate::pose::{End, Placed, Places, held_turns, placed, twist_of};
use crate::real::Real;
use crate::solve::freedoms::Freedoms;
use crate::solve::plan::Plan;
use crate::solve::springs::springs;
use crate::solve::system::{BlockOf, System};
use crate::space::{Linear as _, Moment as _, Space, Vector as _};

/// The weights of mass, damping and stiffness.
#[derive(Clone, Copy)]
pub(crate) struct Pencil<R> {
    pub(crate) mass: R,
    /// \[s\].
    pub(crate) damping: R,
    /// \[s²\].
    pub(crate) stiffness: R,
}

/// Writes the matrix.
pub(crate) fn assemble<P: Geometry, T: Terms>(
    model: &ModelRef<'_, P, T>,
    places: Places<'_, P>,
    (bodies, turns): (&[BodyState<P>], &[i32]),
    pencil: Pencil<P::Real>,
    system: &mut System<'_, P::Space>,
) {
    for block in system.pairs.iter_mut() {
        *block = Row::<P>::EMPTY;
    }
    let rows = system.diagonal.iter_mut().zip(model.bodies).zip(places.frames);
    for ((block, body), frame) in rows {
        *block = Row::<P>::EMPTY;
        let mass = pencil.mass * body.mass;
        for axis in P::Vector::axes().into_iter().take(P::Vector::DIMENSION) {
            P::Space::row(axis, P::Moment::ZERO).add_square(mass, block);
        }
        let axes = P::Moment::axes().into_iter().zip(P::moment_axes(frame));
        for (own, axis) in axes.take(P::Moment::DIMENSION) {
            let inertia = pencil.mass * body.inertia.dot(own);
            P::Space::row(P::Vector::ZERO, axis).add_square(inertia, block);
        }
    }
    for (number, group) in model.groups.iter().enumerate() {
        add_group(model, places, (number, group), pencil, system);
    }
    if T::TORSIONS {
        let springs = model.torsions.iter().zip(P::Real::counts(turns));
        for (row, (spring, &turns)) in springs.enumerate() {
            let Some(twist) = twist_of::<P>(spring, bodies, turns) else { continue };
            let gradient = End::new(model, places, spring.a, None).moment_to_world(twist.gradient);
            let damping = spring.damper.row().and_then(|row| model.dampers.get(row).copied());
            let weight = pencil.stiffness * spring.stiffness
                + pencil.damping * damping.unwrap_or(P::Real::ZERO);
            let mut mount = Mount::new(system, [spring.a, spring.b], model.groups.len() + row);
            mount.add(weight, P::Vector::ZERO, [gradient; 2]);
        }
    }
}

type Row<P> = <<P as Geometry>::Space as Space>::Row;

fn add_group<P: Geometry, T: Terms>(
    model: &ModelRef<'_, P, T>,
    places: Places<'_, P>,
    (number, group): (usize, &Group),
    pencil: Pencil<P::Real>,
    system: &mut System<'_, P::Space>,
) {
    let mut mount = Mount::new(system, [group.a, group.b], number);
    for i in 0..group.elements() {
        let Some(element) = placed(model, places, (number, group), i) else { continue };
        let Some(law) = model.element(group.law, element.index) else { continue };
        let damping = group.damper.row().and_then(|row| model.dampers.get(row + i).copied());
        let damping = damping.unwrap_or(P::Real::ZERO);
        add_element(model, places, (&element, law), (damping, pencil), &mut mount);
    }
}

fn add_element<P: Geometry, T: Terms>(
    model: &ModelRef<'_, P, T>,
    places: Places<'_, P>,
    (element, law): (&Placed<'_, P::Vector>, Element<'_, P::Space>),
    (damping, pencil): (P::Real, Pencil<P::Real>),
    mount: &mut Mount<'_, P::Space>,
) {
    let clearance = model.clearance(element.group);
    let Some(springs) = springs(model, &law, &element.stretch, (damping, clearance)) else { return };
    for (u, [k, c]) in springs.directions.into_iter().zip(springs.constants).take(springs.count) {
        let weight = pencil.stiffness * k + pencil.damping * c;
        mount.add(weight, u, [element.arm_a.cross(u), element.arm_b.cross(u)]);
    }
    let (turns, count) = held_turns(model, places, element.group, element.index);
    for turn in turns.into_iter().take(count) {
        let weight = pencil.stiffness * law.stiffness() + pencil.damping * damping;
        mount.add(weight, P::Vector::ZERO, [turn, turn]);
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
        let Plan { pairs, homes, .. } = system.plan;
        let home = homes.get(number).map_or(usize::MAX, |home| usize::from(*home));
        let pair = pairs.get(home).map(|[first, _]| *first == ends[0].0);
        let pair = pair.and_then(|ordered| Some((system.pairs.get_mut(home)?, ordered)));
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
}
