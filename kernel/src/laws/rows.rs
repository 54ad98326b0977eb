//! The rows of laws, one by one: common to all tables, wherever their rows are stored.

use crate::elements::share::Share;
use crate::force_pair::{ForcePair, Wrench, apply};
use crate::geometry::Geometry;
use crate::index::BodyIndex;
use crate::laws::branches::Branches;
use crate::laws::end::{Instant, Seen};
use crate::laws::interaction::{Damper, Inner, Interaction, Need, Quantity, Springs};
use crate::laws::row::{Act, DamperPass, Row};
use crate::laws::several::Several;
use crate::real::Real as _;
use crate::words::{Word, WordSource, WordVisitor, Words as _};

/// Adds the record of a row to the wrenches; `None` where it is undefined.
#[inline(always)]
pub fn act<P: Geometry, R: Row<P> + ?Sized>(
    row: &mut R,
    at: Instant<'_, P>,
    act: Act<'_, P>,
    wrenches: &mut [Wrench<P::Space>],
) -> Option<()> {
    let bodies = row.bodies();
    let Some(seen) = at.seen(bodies) else { return Some(()) };
    row.update(&seen, act);
    let mut force_pair = row.force_pair(&seen)?;
    let branching = row.most_branches() > 0;
    let mut branches = row.branches(&seen);
    if act.damped && row.dampers() > 0 {
        let own = row.inner(P::Real::ZERO);
        row.each_damper(&seen, &mut |_, damper| {
            let mut rate = seen.rate(&damper.direction);
            if let Some(own) = own {
                rate = rate + damper.inner() * own.rate;
            }
            if branching {
                rate = rate + branches.rate(&seen);
            }
            let tension = damper.tension(rate);
            force_pair = force_pair.with(&seen.pull(&damper.direction, tension));
            if branching {
                branches.pull(tension);
            }
        });
    }
    let [a, b] = bodies.map(BodyIndex::row);
    apply(wrenches, a, b, &force_pair);
    if branching {
        branches.apply(&seen, wrenches);
    }
    Some(())
}

/// Applies the dampers of a row, in the second half of a step with `reverse`; `kept` where [`act`] was called at this pose
/// with the same memory. `room` makes a buffer for all of them.
#[inline(always)]
pub fn sweep<P: Geometry, R: Row<P> + ?Sized, D: AsMut<[Damper<P>]>>(
    row: &mut R,
    [reverse, kept]: [bool; 2],
    shares: &[Share<P::Real>],
    room: impl FnOnce() -> D,
    pass: &mut dyn DamperPass<P>,
) {
    if !row.is_damped() {
        return;
    }
    let bodies = row.bodies();
    if row.keeps() {
        if !kept && let Some(seen) = pass.seen(bodies) {
            row.keep_pose(&seen);
        }
        if row.is_idle() {
            return;
        }
    }
    let (mut count, mut kick, time) = (0, P::Real::ZERO, pass.time());
    let inner = row.inner(kick).is_some();
    // Made only here: an idle row does without.
    let mut room = room();
    let dampers = room.as_mut();
    let branches;
    {
        let Some(seen) = pass.seen(bodies) else { return };
        if inner {
            kick = row.kick(&seen, time);
            if !reverse {
                row.drive(&seen, [time, kick]);
            }
        }
        row.each_damper(&seen, &mut |place, damper| {
            if let Some(place) = dampers.get_mut(place) {
                *place = *damper;
                count += 1;
            }
        });
        branches = row.branches(&seen);
    }
    let known = dampers.get(..count).unwrap_or_default();
    if row.most_branches() > 0 {
        if let Some(known) = known.first().zip(shares.first()) {
            pass.act_along(bodies, known, branches.all());
        }
        return;
    }
    let mut own = if inner { row.inner(kick) } else { None };
    pass.act(bodies, row.turns(), known, shares, own.as_mut());
    if let Some(own) = own {
        row.set_inner(own.rate);
        if reverse && let Some(seen) = pass.seen(bodies) {
            row.drive(&seen, [time, kick]);
        }
    }
}

/// A law with its memory.
#[inline(always)]
pub fn row<'s, P: Geometry, T: Interaction<P>>(
    law: &'s T,
    state: &'s mut T::State,
) -> impl Row<P> + use<'s, P, T> {
    Known { law, state }
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
    state: &'s mut S,
}

impl<P: Geometry, T: Interaction<P>> Row<P> for Known<'_, T, T::State> {
    #[inline(always)]
    fn name(&self) -> &'static str {
        T::NAME
    }
    #[inline(always)]
    fn bodies(&self) -> [BodyIndex; 2] {
        self.law.bodies()
    }
    fn seen<'s>(&mut self, at: Instant<'s, P>) -> Option<Seen<'s, P>> {
        let seen = at.seen(self.law.bodies())?;
        self.law.keep_pose(&seen, self.state);
        Some(seen)
    }
    #[inline(always)]
    fn update(&mut self, seen: &Seen<'_, P>, act: Act<'_, P>) {
        let Self { law, state } = self;
        if T::BEARS && act.settle {
            law.bear(seen, act.groups.force(law.group()), state);
        }
        if T::ADVANCES
            && let Some(h) = act.advance
        {
            law.advance(seen, h, state);
        }
        if act.settle {
            if !(T::ADVANCE_SETTLES && act.advance.is_some()) {
                law.settle(seen, state);
            }
        } else {
            law.keep_pose(seen, state);
        }
    }
    #[inline(always)]
    fn keeps(&self) -> bool {
        T::KEEPS
    }
    #[inline(always)]
    fn keep_pose(&mut self, seen: &Seen<'_, P>) {
        self.law.keep_pose(seen, self.state);
    }
    #[inline(always)]
    fn is_idle(&self) -> bool {
        self.law.is_idle(self.state)
    }
    #[inline(always)]
    fn force_pair(&self, seen: &Seen<'_, P>) -> Option<ForcePair<P::Space>> {
        self.law.force_pair(seen, self.state)
    }
    fn energy(&self, seen: &Seen<'_, P>) -> P::Real {
        self.law.energy(seen, self.state)
    }
    fn tangent(&self, seen: &Seen<'_, P>, visit: Springs<'_, P>) -> [P::Real; 2] {
        self.law.tangent(seen, self.state, visit)
    }
    #[inline(always)]
    fn most_branches(&self) -> usize {
        T::BRANCHES
    }
    fn branch_bodies(&self, visit: &mut dyn FnMut([BodyIndex; 2])) {
        self.law.branch_bodies(visit);
    }
    #[inline(always)]
    fn branches(&self, seen: &Seen<'_, P>) -> Branches<P> {
        Branches::of(self.law, seen, self.state)
    }
    fn branch_tangent(
        &self,
        branch: usize,
        seen: &Seen<'_, P>,
        visit: Springs<'_, P>,
    ) -> [P::Real; 2] {
        self.law.branch_tangent(branch, seen, self.state, visit)
    }
    #[inline(always)]
    fn dampers(&self) -> usize {
        T::Dampers::COUNT
    }
    #[inline(always)]
    fn is_damped(&self) -> bool {
        T::Dampers::COUNT > 0 && self.law.is_damped()
    }
    #[inline(always)]
    fn turns(&self) -> bool {
        T::TURNS
    }
    #[inline(always)]
    fn each_damper(&self, seen: &Seen<'_, P>, visit: &mut dyn FnMut(usize, &Damper<P>)) {
        let mut count = 0;
        self.law.dampers(seen, self.state, &mut |damper| {
            visit(count, &damper);
            count += 1;
        });
    }
    #[inline(always)]
    fn drives(&self) -> bool {
        T::DRIVES
    }
    #[inline(always)]
    fn inner(&self, kick: P::Real) -> Option<Inner<P::Real>> {
        if T::INNER { Some(self.law.inner(self.state, kick)) } else { None }
    }
    #[inline(always)]
    fn set_inner(&mut self, rate: P::Real) {
        self.law.set_inner(rate, self.state);
    }
    #[inline(always)]
    fn kick(&mut self, seen: &Seen<'_, P>, h: P::Real) -> P::Real {
        self.law.kick(seen, h, self.state)
    }
    #[inline(always)]
    fn drive(&mut self, seen: &Seen<'_, P>, time_and_kick: [P::Real; 2]) {
        self.law.drive(seen, time_and_kick, self.state);
    }
    fn inner_square(&self) -> P::Real {
        self.law.inner_square()
    }
    fn supply(&self, seen: &Seen<'_, P>) -> P::Real {
        self.law.supply(seen, self.state)
    }
    fn loss(&self) -> P::Real {
        self.law.loss(self.state)
    }
    fn driven_rate(&self, seen: &Seen<'_, P>) -> P::Real {
        self.law.driven_rate(seen)
    }
    fn turn(&mut self, turn: &mut dyn FnMut(usize, [f64; 3]) -> [f64; 3]) {
        T::turn(self.state, turn);
    }
    fn quantities(&self) -> &'static [Quantity] {
        T::QUANTITIES
    }
    fn read(&self, quantity: usize, seen: &Seen<'_, P>) -> P::Real {
        self.law.read(quantity, seen, self.state)
    }
    fn visit(&self, visitor: &mut dyn WordVisitor) {
        self.law.visit(visitor);
    }
}
