//! Dampers at a pose, and the coupling of their impulses.
//!
//! `(model, pose) => directions of dampers, motion per impulse, rates`. For analyses before or during a run; the damper
//! passes of a step have code of their own.

use crate::body::{BodyState, Increment};
use crate::damping::mode::DampingMode;
use crate::damping::modes::{fixed, held};
use crate::damping::near::{Held, hold, near};
use crate::damping::{each_direction, torsion_direction};
use crate::force_pair::Direction;
use crate::geometry::Geometry;
use crate::index::BodyIndex;
use crate::laws::{Instant, Laws as _};
use crate::model::{ModelRef, StatesIn, Terms};
use crate::pose::{Places, held_turns, placed};
use crate::real::{Mask as _, Real};
use crate::space::{Linear as _, Moment as _, Space};

/// The response of two bodies to a unit impulse along a damper.
#[derive(Clone, Copy)]
pub(super) struct Motion<S: Space> {
    bodies: [BodyIndex; 2],
    increments: [Increment<S>; 2],
    /// `K_ii`, 1/μ.
    pub(super) rate: S::Real,
    coefficient: S::Real,
    /// The lanes in which the impulse moves anything.
    pub(super) known: <S::Real as Real>::Mask,
}

/// The mount of a damper: groups in order, then torsion springs, then laws.
#[derive(Clone, Copy)]
pub(super) enum Mount {
    Group(usize),
    Torsion(usize),
    Law(usize),
}

impl Mount {
    /// The mount at an index, for the given numbers of groups and torsion springs.
    fn at(place: usize, [groups, torsions]: [usize; 2]) -> Self {
        match place.checked_sub(groups) {
            None => Self::Group(place),
            Some(row) if row < torsions => Self::Torsion(row),
            Some(row) => Self::Law(row - torsions),
        }
    }
}

/// Whether two pairs have a body in common.
pub(super) fn meet(a: [BodyIndex; 2], b: [BodyIndex; 2]) -> bool {
    a.iter().any(|body| !body.is_world() && b.contains(body))
}

/// A model at a pose.
pub(crate) struct Pose<'s, 'm, P: Geometry, T: Terms<P>> {
    pub(crate) model: &'s ModelRef<'m, P, T>,
    pub(crate) places: Places<'s, P>,
    pub(crate) bodies: &'s [BodyState<P>],
    /// Revolution counts of torsion springs, memories of laws.
    pub(crate) memories: (&'s [i32], &'s StatesIn<P, T>),
    /// The joints' damping modes, which represent their dampers; empty where dampers act one by one.
    pub(crate) modes: &'s [DampingMode<P>],
}

impl<P: Geometry, T: Terms<P>> Pose<'_, '_, P, T> {
    pub(super) fn mounts(&self) -> impl Iterator<Item = Mount> + use<P, T> {
        let counts = self.counts();
        (0..self.count()).map(move |place| Mount::at(place, counts))
    }

    fn counts(&self) -> [usize; 2] {
        [self.model.groups.len(), self.model.torsions.len()]
    }

    fn count(&self) -> usize {
        self.model.groups.len() + self.model.torsions.len() + self.model.laws.count()
    }

    /// Records which body has which mount; `held` has an empty entry per body.
    pub(super) fn hold(&self, held: &mut [Held]) {
        for (place, mount) in self.mounts().enumerate() {
            if let Some(ends) = self.ends(mount) {
                hold(held, ends, place);
            }
        }
    }

    /// The mounts with dampers that share a body with a pair, in order: index, mount, bodies.
    pub(super) fn meeting<'h>(
        &self,
        held: &'h [Held],
        ends: [BodyIndex; 2],
    ) -> impl Iterator<Item = (usize, Mount, [BodyIndex; 2])> + use<'_, 'h, P, T> {
        let counts = self.counts();
        near(held, ends, self.count()).filter_map(move |place| {
            let mount = Mount::at(place, counts);
            let others = self.ends(mount).filter(|others| meet(ends, *others))?;
            Some((place, mount, others))
        })
    }

    /// The bodies of a mount that has dampers.
    pub(super) fn ends(&self, mount: Mount) -> Option<[BodyIndex; 2]> {
        let (damper, ends) = match mount {
            Mount::Group(row) => {
                let group = self.model.groups.get(row)?;
                (group.damper, [group.a, group.b])
            }
            Mount::Torsion(row) => {
                let spring = self.model.torsions.get(row)?;
                (spring.damper, [spring.a, spring.b])
            }
            Mount::Law(row) => {
                let mut ends = None;
                self.model.laws.look(row, self.memories.1, &mut |law| {
                    // With branches it moves more than two bodies and is treated alone.
                    let pair = law.dampers() > 0 && law.most_branches() == 0;
                    ends = pair.then_some(law.bodies());
                });
                return ends;
            }
        };
        damper.row().map(|_| ends)
    }

    /// Visits the dampers of a mount direction by direction: row (for a law the damper's number in the law), fraction
    /// of the direction in its damper, coefficient, direction.
    pub(super) fn each_damper(
        &self,
        mount: Mount,
        mut visit: impl FnMut(usize, P::Real, P::Real, &Direction<P::Space>),
    ) {
        let Self { model, places, bodies, memories: (turns, states), modes } = *self;
        let one = P::Real::ONE;
        match mount {
            Mount::Group(group) => {
                let Some(group) = model.groups.get(group) else { return };
                let Some(first) = group.damper.row() else { return };
                if let Some(ends) = fixed::<P, T>(group).filter(|_| !modes.is_empty()) {
                    for (i, mode) in held(group, modes).iter().enumerate() {
                        visit(first + i, one, one, &mode.direction(places, ends, group.a));
                    }
                    return;
                }
                for i in 0..group.elements() {
                    let Some(&coefficient) = model.dampers.get(first + i) else { return };
                    let Some(element) = placed(model, places, (0, group), i) else { return };
                    let directions = model.damped(group.law, &element.deformation);
                    let (_, turns) = held_turns(model, places, group, element.index);
                    let count = directions.map_or(1, |(_, count)| count + turns);
                    let part = one / P::Real::from_i32(count as i32);
                    let mut each = |direction: &Direction<_>| {
                        visit(first + i, part, coefficient, direction);
                    };
                    each_direction::<P, T, false>(model, places, &element, &mut each);
                }
            }
            Mount::Torsion(row) => {
                let turns = P::Real::counts(turns);
                let Some((spring, &turns)) = model.torsions.iter().zip(turns).nth(row) else {
                    return;
                };
                let direction = torsion_direction(model, places, spring, turns, bodies);
                if let (Some(row), Some(direction)) = (spring.damper.row(), direction)
                    && let Some(&coefficient) = model.dampers.get(row)
                {
                    visit(row, one, coefficient, &direction);
                }
            }
            Mount::Law(row) => model.laws.look(row, states, &mut |law| {
                let at = Instant { frames: places.frames, bodies, signals: places.signals };
                let Some(seen) = law.seen(at) else { return };
                law.each_damper(&seen, &mut |number, damper| {
                    visit(number, one, damper.coefficient, &damper.direction);
                });
            }),
        }
    }
}

impl<S: Space> Motion<S> {
    /// `None` for a damper that moves nothing.
    pub(super) fn new<P: Geometry<Space = S, Real = S::Real>, T: Terms<P>>(
        model: &ModelRef<'_, P, T>,
        bodies: [BodyIndex; 2],
        coefficient: S::Real,
        direction: &Direction<S>,
    ) -> Option<Self> {
        let mut motion = Self {
            bodies,
            increments: [Increment::default(); 2],
            rate: S::Real::ZERO,
            coefficient,
            known: S::Real::mask(true),
        };
        let ends = bodies.into_iter().zip(direction.moments).zip([-S::Real::ONE, S::Real::ONE]);
        for (((body, moment), sign), increment) in ends.zip(&mut motion.increments) {
            if let Some(body) = model.bodies.get(body.row()) {
                *increment = Increment {
                    linear: direction.along * (sign * body.inverse_mass),
                    angular: moment.scale(body.inverse_inertia) * sign,
                };
            }
        }
        motion.rate = motion.rate(bodies, direction);
        let zero = S::Real::ZERO;
        motion.known = zero.less_than(motion.rate) & zero.less_than(coefficient);
        motion.known.any().then_some(motion)
    }

    /// The rate along a direction between two bodies.
    pub(super) fn rate(&self, ends: [BodyIndex; 2], direction: &Direction<S>) -> S::Real {
        let mut rate = S::Real::ZERO;
        for (moved, increment) in self.bodies.iter().zip(&self.increments) {
            for ((end, moment), sign) in
                ends.iter().zip(direction.moments).zip([-S::Real::ONE, S::Real::ONE])
            {
                if end == moved && !end.is_world() {
                    let here =
                        direction.along.dot(increment.linear) + moment.dot(increment.angular);
                    rate = rate + sign * here;
                }
            }
        }
        rate
    }

    /// The power that a damper takes from this motion, over the power of the motion's own damper.
    pub(super) fn power(
        &self,
        ends: [BodyIndex; 2],
        coefficient: S::Real,
        direction: &Direction<S>,
    ) -> S::Real {
        let share = self.rate(ends, direction) / self.rate;
        coefficient / self.coefficient * (share * share)
    }
}
