//! Damper pass of the laws.
//!
//! `(tables, memories, pose, velocities, kick) => velocities`. A law states where its dampers act and how strong they
//! are; this module turns that into impulses, once for all laws of a model.

use crate::damping::far::Far;
use crate::damping::kick::Kick;
use crate::damping::moving::Moving;
use crate::damping::pair::Pair;
use crate::damping::pass::Sweep;
use crate::elements::share::Share;
use crate::geometry::Geometry;
use crate::index::BodyIndex;
use crate::laws::{Branch, Damper, DamperPass, End, Inner, Instant, Laws, Seen};
use crate::model::{LawsIn, ModelRef, SharesIn, StatesIn, Terms};
use crate::real::Real as _;
use crate::space::Linear as _;

/// Memories of laws and weights of their dampers.
pub(crate) type LawsKnown<'s, P, T> = (&'s mut StatesIn<P, T>, &'s SharesIn<P, T>);

/// The dampers of all laws, ascending, or descending with `REVERSE`.
#[inline(always)]
pub(super) fn sweep_laws<P: Geometry, T: Terms<P>, K: Kick<P>, const REVERSE: bool>(
    model: &ModelRef<'_, P, T>,
    sweep: &Sweep<'_, P, K>,
    known: LawsKnown<'_, P, T>,
    moving: &mut Moving<'_, P>,
) {
    if T::Laws::DAMPED {
        sweep_apart::<P, T, K, REVERSE>(model, sweep, known, moving);
    }
}

// Not inlined: it would take registers from the code of every damped model.
#[inline(never)]
fn sweep_apart<P: Geometry, T: Terms<P>, K: Kick<P>, const REVERSE: bool>(
    model: &ModelRef<'_, P, T>,
    sweep: &Sweep<'_, P, K>,
    (states, shares): LawsKnown<'_, P, T>,
    moving: &mut Moving<'_, P>,
) {
    let mut pass = Pass::<_, _, _, REVERSE> { model, sweep, moving };
    model.laws.sweep(REVERSE, states, shares, &mut pass);
}

struct Pass<'s, 'm, 'b, P: Geometry, T: Terms<P>, K, const REVERSE: bool> {
    model: &'s ModelRef<'m, P, T>,
    sweep: &'s Sweep<'s, P, K>,
    moving: &'s mut Moving<'b, P>,
}

impl<P: Geometry, T: Terms<P>, K: Kick<P>, const REVERSE: bool> DamperPass<P>
    for Pass<'_, '_, '_, P, T, K, REVERSE>
{
    fn time(&self) -> P::Real {
        self.sweep.h
    }

    fn is_evaluated(&self) -> bool {
        self.sweep.evaluated
    }

    fn seen(&self, [a, b]: [BodyIndex; 2]) -> Option<Seen<'_, P>> {
        let places = self.sweep.places;
        let end = |index: BodyIndex| self.moving.body(index.row(), places.frames.get(index.row())?);
        let (a, b) = (End { body: end(a) }, End { body: Some(end(b)?) });
        let (frames, bodies) = (places.frames, &*self.moving.states);
        Some(Seen { a, b, at: Instant { frames, bodies, signals: places.signals } })
    }

    fn act(
        &mut self,
        bodies: [BodyIndex; 2],
        turns: bool,
        dampers: &[Damper<P>],
        shares: &[Share<P::Real>],
        inner: Option<&mut Inner<P::Real>>,
    ) {
        if <LawsIn<P, T> as Laws<P>>::TURNS && (turns || !<LawsIn<P, T> as Laws<P>>::PUSHES) {
            self.act_on::<true>(bodies, dampers, shares, inner);
        } else {
            self.act_on::<false>(bodies, dampers, shares, inner);
        }
    }

    fn act_along(
        &mut self,
        bodies: [BodyIndex; 2],
        (damper, share): (&Damper<P>, &Share<P::Real>),
        branches: &[Option<Branch<P>>],
    ) {
        if damper.coefficient == P::Real::ZERO {
            return;
        }
        let mut far = Far::default();
        far.add(bodies, &damper.direction);
        for branch in branches.iter().flatten() {
            far.add(branch.bodies, &branch.direction);
        }
        let bounds = damper.bounds().map(|bound| bound * self.sweep.h);
        let known = self.sweep.damper::<REVERSE>(damper.coefficient, share);
        let limits = (damper.rate, bounds, damper.brakes());
        far.damp(self.model, &self.sweep.kick, (known, limits), self.moving);
    }
}

impl<P: Geometry, T: Terms<P>, K: Kick<P>, const REVERSE: bool> Pass<'_, '_, '_, P, T, K, REVERSE> {
    #[inline(always)]
    fn act_on<const TURNS: bool>(
        &mut self,
        bodies: [BodyIndex; 2],
        dampers: &[Damper<P>],
        shares: &[Share<P::Real>],
        mut inner: Option<&mut Inner<P::Real>>,
    ) {
        let idle = |damper: &Damper<P>| damper.coefficient == P::Real::ZERO;
        if P::Real::ONE_LANE && dampers.iter().all(idle) {
            return;
        }
        let (model, sweep) = (self.model, self.sweep);
        let rows = bodies.map(BodyIndex::row);
        let ground_rate = P::Vector::ZERO;
        let mut pair = Pair::<_, TURNS>::new(model, rows, self.moving, ground_rate, &sweep.kick);
        let count = dampers.len();
        for i in 0..count {
            let i = if REVERSE { count - 1 - i } else { i };
            let (Some(damper), Some(share)) = (dampers.get(i), shares.get(i)) else { break };
            // Its impulse is 0.
            if P::Real::ONE_LANE && idle(damper) {
                continue;
            }
            let bounds = damper.bounds().map(|bound| bound * sweep.h);
            let known = sweep.damper::<REVERSE>(damper.coefficient, share);
            let limits = (damper.rate, bounds, damper.brakes());
            let inner = inner.as_deref_mut().map(|inner| (damper.inner(), inner));
            pair.damp_within::<P, K>(&damper.direction, known, limits, inner);
        }
        pair.store::<P>(self.moving);
    }
}
