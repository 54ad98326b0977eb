//! The rows of one law, one after the other: common to all tables, wherever their rows are stored.

use crate::elements::share::Share;
use crate::force_pair::{ForcePair, Wrench, apply};
use crate::geometry::Geometry;
use crate::index::BodyIndex;
use crate::laws::branch::Branch;
use crate::laws::branches::Branches;
use crate::laws::end::{Instant, Seen};
use crate::laws::interaction::{Damper, Inner, Interaction, Need, Quantity, SharesOf, Springs};
use crate::laws::row::{Act, DamperPass, Row};
use crate::laws::several::Several;
use crate::real::Real as _;
use crate::words::{Word, WordSource, WordVisitor, Words as _};

/// The weights of a row's dampers.
#[must_use]
pub fn shares_of<P: Geometry, T: Interaction<P>>(_: &T) -> SharesOf<P, T> {
    T::Dampers::of(Share::ALONE)
}

/// Adds the records of the rows in order; fails with the first undefined one.
///
/// # Errors
/// The row.
#[inline(always)]
pub fn act<P: Geometry, T: Interaction<P>>(
    rows: &[T],
    at: Instant<'_, P>,
    states: &mut [T::State],
    act: Act<'_, P>,
    wrenches: &mut [Wrench<P::Space>],
) -> Result<(), usize> {
    for (row, (law, state)) in rows.iter().zip(states).enumerate() {
        let bodies = law.bodies();
        let Some(seen) = at.seen(bodies) else { continue };
        if T::BEARS && act.settle {
            law.bear(&seen, act.groups.force(law.group()), state);
        }
        if T::ADVANCES
            && let Some(h) = act.advance
        {
            law.advance(&seen, h, state);
        }
        if act.settle {
            if !(T::ADVANCE_SETTLES && act.advance.is_some()) {
                law.settle(&seen, state);
            }
        } else {
            law.keep_pose(&seen, state);
        }
        let Some(mut force_pair) = law.force_pair(&seen, state) else { return Err(row) };
        let mut branches = Branches::of(law, &seen, state);
        if act.damped && T::Dampers::COUNT > 0 {
            let own = if T::INNER { law.inner(state, P::Real::ZERO).rate } else { P::Real::ZERO };
            law.dampers(&seen, state, &mut |damper| {
                let mut rate = seen.rate(&damper.direction);
                if T::INNER {
                    rate = rate + damper.inner() * own;
                }
                if T::BRANCHES > 0 {
                    rate = rate + branches.rate(&seen);
                }
                let tension = damper.tension(rate);
                force_pair = force_pair.with(&seen.pull(&damper.direction, tension));
                if T::BRANCHES > 0 {
                    branches.pull(tension);
                }
            });
        }
        let [a, b] = bodies.map(BodyIndex::row);
        apply(wrenches, a, b, &force_pair);
        if T::BRANCHES > 0 {
            branches.apply(&seen, wrenches);
        }
    }
    Ok(())
}

/// Applies the dampers of the rows, in descending order with `reverse`; `kept` where [`act`] was called at this pose with
/// the same memories.
#[inline(always)]
pub fn sweep<P: Geometry, T: Interaction<P>>(
    rows: &[T],
    [reverse, kept]: [bool; 2],
    states: &mut [T::State],
    shares: &[SharesOf<P, T>],
    pass: &mut dyn DamperPass<P>,
) {
    if T::Dampers::COUNT == 0 {
        return;
    }
    for row in 0..rows.len() {
        let row = if reverse { rows.len() - 1 - row } else { row };
        let (Some(law), Some(state), Some(shares)) =
            (rows.get(row), states.get_mut(row), shares.get(row))
        else {
            break;
        };
        if !law.is_damped() {
            continue;
        }
        let bodies = law.bodies();
        if T::KEEPS {
            if !kept && let Some(seen) = pass.seen(bodies) {
                law.keep_pose(&seen, state);
            }
            if law.is_idle(state) {
                continue;
            }
        }
        let mut dampers = T::Dampers::of(Damper::<P>::idle());
        let (mut count, mut kick, time) = (0, P::Real::ZERO, pass.time());
        let branches;
        {
            let Some(seen) = pass.seen(bodies) else { continue };
            if T::INNER {
                kick = law.kick(&seen, time, state);
                if !reverse {
                    law.drive(&seen, [time, kick], state);
                }
            }
            law.dampers(&seen, state, &mut |damper| {
                if let Some(place) = dampers.as_mut().get_mut(count) {
                    *place = damper;
                    count += 1;
                }
            });
            branches = Branches::of(law, &seen, state);
        }
        let known = dampers.as_ref().get(..count).unwrap_or_default();
        if T::BRANCHES > 0 {
            if let Some(known) = known.first().zip(shares.as_ref().first()) {
                pass.act_along(bodies, known, branches.all());
            }
            continue;
        }
        if !T::INNER {
            pass.act(bodies, T::TURNS, known, shares.as_ref(), None);
            continue;
        }
        let mut inner = law.inner(state, kick);
        pass.act(bodies, T::TURNS, known, shares.as_ref(), Some(&mut inner));
        law.set_inner(inner.rate, state);
        if reverse && let Some(seen) = pass.seen(bodies) {
            law.drive(&seen, [time, kick], state);
        }
    }
}

/// Passes a row to `look`.
pub fn look<P: Geometry, T: Interaction<P>>(
    rows: &[T],
    row: usize,
    states: &[T::State],
    look: &mut dyn FnMut(&dyn Row<P>),
) {
    if let (Some(law), Some(state)) = (rows.get(row), states.get(row)) {
        look(&Known { law, state });
    }
}

/// Visits the words of memories.
pub fn visit<P: Geometry, T: Interaction<P>>(states: &[T::State], visitor: &mut dyn WordVisitor) {
    states.iter().for_each(|state| state.visit(&mut Visitor(visitor)));
}

/// Reads memories from a source.
pub fn fill<P: Geometry, T: Interaction<P>>(states: &mut [T::State], source: &mut dyn WordSource) {
    states.iter_mut().for_each(|state| state.fill(&mut Source(source)));
}

/// The law's name and its memory's requirement on a scheme, if any.
#[must_use]
pub fn memory<P: Geometry, T: Interaction<P>>(rows: &[T]) -> Option<(&'static str, Need)> {
    let need = match (T::INNER, T::ADVANCES, T::SLIPS) {
        (true, ..) => Need::Passes,
        (_, true, _) => Need::Steps,
        (.., true) => Need::Forward,
        _ => return None,
    };
    (!rows.is_empty()).then_some((T::NAME, need))
}

/// Adapts a visitor given as a trait object.
struct Visitor<'v>(&'v mut dyn WordVisitor);

impl WordVisitor for Visitor<'_> {
    fn word(&mut self, word: Word) {
        self.0.word(word);
    }
}

struct Source<'v>(&'v mut dyn WordSource);

impl WordSource for Source<'_> {
    fn take(&mut self, size: usize) -> u64 {
        self.0.take(size)
    }
}

/// A row with its memory.
struct Known<'s, T, S> {
    law: &'s T,
    state: &'s S,
}

impl<T, S: Copy> Known<'_, T, S> {
    /// Its memory with what it keeps of a pose.
    fn at<P: Geometry>(&self, seen: &Seen<'_, P>) -> S
    where
        T: Interaction<P, State = S>,
    {
        let mut state = *self.state;
        self.law.keep_pose(seen, &mut state);
        state
    }
}

impl<P: Geometry, T: Interaction<P>> Row<P> for Known<'_, T, T::State> {
    fn name(&self) -> &'static str {
        T::NAME
    }
    fn bodies(&self) -> [BodyIndex; 2] {
        self.law.bodies()
    }
    fn dampers(&self) -> usize {
        T::Dampers::COUNT
    }
    fn force_pair(&self, seen: &Seen<'_, P>) -> Option<ForcePair<P::Space>> {
        self.law.force_pair(seen, &self.at(seen))
    }
    fn energy(&self, seen: &Seen<'_, P>) -> P::Real {
        self.law.energy(seen, &self.at(seen))
    }
    fn tangent(&self, seen: &Seen<'_, P>, visit: Springs<'_, P>) -> [P::Real; 2] {
        self.law.tangent(seen, &self.at(seen), visit)
    }
    fn most_branches(&self) -> usize {
        T::BRANCHES
    }
    fn branch_bodies(&self, visit: &mut dyn FnMut([BodyIndex; 2])) {
        self.law.branch_bodies(visit);
    }
    fn each_branch(&self, seen: &Seen<'_, P>, visit: &mut dyn FnMut(usize, &Branch<P>)) {
        let mut count = 0;
        self.law.branches(seen, &self.at(seen), &mut |branch| {
            visit(count, &branch);
            count += 1;
        });
    }
    fn branch_tangent(
        &self,
        branch: usize,
        seen: &Seen<'_, P>,
        visit: Springs<'_, P>,
    ) -> [P::Real; 2] {
        self.law.branch_tangent(branch, seen, &self.at(seen), visit)
    }
    fn each_damper(&self, seen: &Seen<'_, P>, visit: &mut dyn FnMut(usize, &Damper<P>)) {
        let mut count = 0;
        self.law.dampers(seen, &self.at(seen), &mut |damper| {
            visit(count, &damper);
            count += 1;
        });
    }
    fn drives(&self) -> bool {
        T::DRIVES
    }
    fn inner(&self) -> Option<Inner<P::Real>> {
        T::INNER.then(|| self.law.inner(self.state, P::Real::ZERO))
    }
    fn inner_square(&self) -> P::Real {
        self.law.inner_square()
    }
    fn supply(&self, seen: &Seen<'_, P>) -> P::Real {
        self.law.supply(seen, &self.at(seen))
    }
    fn loss(&self) -> P::Real {
        self.law.loss(self.state)
    }
    fn driven_rate(&self, seen: &Seen<'_, P>) -> P::Real {
        self.law.driven_rate(seen)
    }
    fn quantities(&self) -> &'static [Quantity] {
        T::QUANTITIES
    }
    fn read(&self, quantity: usize, seen: &Seen<'_, P>) -> P::Real {
        self.law.read(quantity, seen, &self.at(seen))
    }
    fn visit(&self, visitor: &mut dyn WordVisitor) {
        self.law.visit(visitor);
    }
}
