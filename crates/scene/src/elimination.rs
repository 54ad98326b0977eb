//! Elimination order of a matrix with a block per body and per pair of bodies.
//!
//! `(number of bodies, ends of groups and torsion springs) => plan`. The body with the fewest neighbours is
//! eliminated next, the first of equal ones, and its neighbours become connected (Tinney & Walker 1967): chains and
//! loops of mechanisms have almost no fill-in.

use std::collections::BTreeSet;
use std::ops::Deref;

use dbd_kernel::laws::Laws as _;
use dbd_kernel::model::{Law, ModelOwner, ModelRef, Plan, Terms};
use dbd_kernel::{BodyState, Geometry};

/// A plan on the heap, see [`Plan`] for the fields.
#[derive(Clone, Debug, Default, PartialEq, Eq)]
pub struct Elimination {
    /// [`Plan::order`].
    pub order: Vec<[u16; 2]>,
    /// [`Plan::pairs`].
    pub pairs: Vec<[u16; 2]>,
    /// [`Plan::targets`].
    pub targets: Vec<u32>,
    /// [`Plan::slots`].
    pub slots: Vec<u32>,
    /// [`Plan::decoupled`].
    pub decoupled: Vec<bool>,
}

impl Elimination {
    /// The largest number of [`Plan::targets`]: a factorisation takes as many products of blocks, each some 50 ns on a
    /// PC.
    pub const MAX_PRODUCTS: usize = 1 << 24;

    /// The plan of a model with this number of bodies and stiff elements between these ends: groups, then torsion
    /// springs, then laws. Ends that are not bodies are the ground. `None` if it takes more than
    /// [`Self::MAX_PRODUCTS`].
    #[must_use]
    pub fn new(bodies: usize, ends: &[[u16; 2]]) -> Option<Self> {
        Self::with_cliques(bodies, ends, &[])
    }

    /// [`Self::new`] with a block for every pair of bodies.
    fn with_cliques(bodies: usize, ends: &[[u16; 2]], cliques: &[Vec<u16>]) -> Option<Self> {
        let is_body = |body: u16| usize::from(body) < bodies;
        let mut neighbours: Vec<BTreeSet<u16>> = vec![BTreeSet::new(); bodies];
        let within = |clique: &Vec<u16>| {
            let pairs = clique.iter().flat_map(|a| clique.iter().map(|b| [*a, *b]));
            pairs.filter(|[a, b]| a < b).collect::<Vec<_>>()
        };
        let all = ends.iter().copied().chain(cliques.iter().flat_map(within));
        for [a, b] in all.filter(|ends| ends.iter().all(|end| is_body(*end))) {
            neighbours[usize::from(a)].insert(b);
            neighbours[usize::from(b)].insert(a);
        }
        // Sorted by number of neighbours: the next body is the first.
        let mut left: BTreeSet<(usize, u16)> =
            (0..).zip(&neighbours).map(|(body, near)| (near.len(), body)).collect();
        let mut plan = Self::default();
        let (mut columns, mut work) = (Vec::with_capacity(bodies), 0);
        while let Some((_, next)) = left.pop_first() {
            let joined = std::mem::take(&mut neighbours[usize::from(next)]);
            work += joined.len() * joined.len().saturating_sub(1) / 2;
            if work > Self::MAX_PRODUCTS {
                return None;
            }
            for &a in &joined {
                let near = &mut neighbours[usize::from(a)];
                left.remove(&(near.len(), a));
                near.remove(&next);
                near.extend(joined.iter().copied().filter(|b| *b != a));
                left.insert((near.len(), a));
            }
            plan.order.push([next, joined.len() as u16]);
            columns.push(joined);
        }
        let mut places = vec![0; bodies];
        for (place, [body, _]) in plan.order.iter().enumerate() {
            places[usize::from(*body)] = place;
        }
        let place = |body: u16| places[usize::from(body)];
        let mut starts = vec![0; bodies];
        for ([first, _], joined) in plan.order.iter().zip(&columns) {
            let mut joined: Vec<u16> = joined.iter().copied().collect();
            joined.sort_by_key(|body| place(*body));
            starts[usize::from(*first)] = plan.pairs.len();
            plan.pairs.extend(joined.into_iter().map(|second| [*first, second]));
        }
        let slot = |a: u16, b: u16| {
            let [first, second] = if place(a) < place(b) { [a, b] } else { [b, a] };
            let start = starts[usize::from(first)];
            let column = &plan.pairs[start..start + columns[place(first)].len()];
            let found = column.binary_search_by_key(&place(second), |[_, body]| place(*body));
            found.map_or(Plan::GROUND, |row| (start + row) as u32)
        };
        for column in plan.pairs.chunk_by(|a, b| a[0] == b[0]) {
            for (i, [_, second]) in column.iter().enumerate() {
                plan.targets.extend(column[..i].iter().map(|[_, first]| slot(*first, *second)));
            }
        }
        let both =
            |&[a, b]: &[u16; 2]| if is_body(a) && is_body(b) { slot(a, b) } else { Plan::GROUND };
        plan.slots = ends.iter().map(both).collect();
        Some(plan)
    }

    /// The plan of a model.
    pub(crate) fn of<P: Geometry, T: Terms<P>>(model: &ModelRef<'_, P, T>) -> Option<Self> {
        let ModelRef { bodies, groups, points, torsions, laws, .. } = *model;
        let (mut ends, mut cliques) = (Vec::new(), Vec::new());
        laws.look_at_all(&laws.states(), &mut |_, law| {
            let own = law.bodies().map(|end| end.0);
            ends.push(own);
            let mut clique = own.to_vec();
            law.branch_bodies(&mut |bodies| clique.extend(bodies.map(|end| end.0)));
            cliques.push(clique);
        });
        let torsions = torsions.iter().map(|spring| [spring.a.0, spring.b.0]);
        let mut decoupled = vec![true; bodies.len()];
        let mut couple = |body: u16| {
            if let Some(decoupled) = decoupled.get_mut(usize::from(body)) {
                *decoupled = false;
            }
        };
        cliques.iter().flatten().copied().chain(torsions.clone().flatten()).for_each(&mut couple);
        for group in groups {
            let from = usize::from(group.point);
            let own = points.get(from..from + group.points()).unwrap_or_default();
            let (a, b) = own.split_at_checked(usize::from(group.triples)).unwrap_or_default();
            for (body, own) in [(group.a, a), (group.b, b)] {
                let mut own = own.iter().map(P::local_to_f64);
                if group.law != Law::Tsda || own.any(|point| point != [0.0; 3]) {
                    couple(body.0);
                }
            }
        }
        let groups = groups.iter().map(|group| [group.a.0, group.b.0]);
        let ends: Vec<_> = groups.chain(torsions).chain(ends).collect();
        let mut plan = Self::with_cliques(bodies.len(), &ends, &cliques)?;
        // In this order the bodies that are eliminated later are still known by themselves.
        for [first, second] in &plan.pairs {
            let joined = decoupled[usize::from(*second)];
            decoupled[usize::from(*first)] &= joined;
        }
        plan.decoupled = decoupled;
        Some(plan)
    }

    /// The plan in the form of the kernel.
    #[must_use]
    pub fn plan(&self) -> Plan<'_> {
        let Self { order, pairs, targets, slots, decoupled } = self;
        Plan { order, pairs, targets, slots, decoupled }
    }

    /// Number of pairs filled in by elimination.
    #[must_use]
    pub fn filled(&self) -> usize {
        self.pairs.len()
            - self.slots.iter().filter(|slot| **slot != Plan::GROUND).collect::<BTreeSet<_>>().len()
    }
}

/// A model of any owner with a plan on the heap, for schemes with a matrix.
#[derive(Clone, Debug)]
pub struct Eliminated<H> {
    model: H,
    plan: Elimination,
}

impl<H: Deref<Target: ModelOwner + Sized>> Eliminated<H> {
    /// The model that `model` points to with its plan; `None` if the plan is too large.
    #[must_use]
    pub fn new(model: H) -> Option<Self> {
        let plan = Elimination::of(&model.view())?;
        Some(Self { model, plan })
    }
}

impl<H: Deref<Target: ModelOwner + Sized>> ModelOwner for Eliminated<H> {
    type Precision = <H::Target as ModelOwner>::Precision;
    type Terms = <H::Target as ModelOwner>::Terms;
    type PerBody<T: Copy> = <H::Target as ModelOwner>::PerBody<T>;
    type PerDampedBody<T: Copy> = <H::Target as ModelOwner>::PerDampedBody<T>;
    type PerTorsion = <H::Target as ModelOwner>::PerTorsion;
    type PerLoad = <H::Target as ModelOwner>::PerLoad;
    type PerInput<T: Copy> = <H::Target as ModelOwner>::PerInput<T>;
    type PerDamper<T: Copy> = <H::Target as ModelOwner>::PerDamper<T>;
    type PerTsda<T: Copy> = <H::Target as ModelOwner>::PerTsda<T>;
    type PerPair<T: Copy> = Vec<T>;
    type PerSlot<T: Copy> = Vec<T>;
    type PerKnot = <H::Target as ModelOwner>::PerKnot;
    type PerSource = <H::Target as ModelOwner>::PerSource;

    fn view(&self) -> ModelRef<'_, Self::Precision, Self::Terms> {
        self.model.view()
    }

    fn initial(&self) -> &[BodyState<Self::Precision>] {
        self.model.initial()
    }

    fn per_body<T: Copy>(&self, value: T) -> Self::PerBody<T> {
        self.model.per_body(value)
    }

    fn per_damped_body<T: Copy>(&self, value: T) -> Self::PerDampedBody<T> {
        self.model.per_damped_body(value)
    }

    fn per_torsion(&self) -> Self::PerTorsion {
        self.model.per_torsion()
    }

    fn per_load(&self) -> Self::PerLoad {
        self.model.per_load()
    }

    fn per_input<T: Copy>(&self, value: T) -> Self::PerInput<T> {
        self.model.per_input(value)
    }

    fn per_damper<T: Copy>(&self, value: T) -> Self::PerDamper<T> {
        self.model.per_damper(value)
    }

    fn per_tsda<T: Copy>(&self, value: T) -> Self::PerTsda<T> {
        self.model.per_tsda(value)
    }

    fn per_pair<T: Copy>(&self, value: T) -> Vec<T> {
        vec![value; self.plan.pairs.len()]
    }

    fn per_slot<T: Copy>(&self, value: T) -> Vec<T> {
        vec![value; self.plan.slots.len()]
    }

    fn plan(&self) -> Plan<'_> {
        self.plan.plan()
    }

    fn per_knot(&self) -> Self::PerKnot {
        self.model.per_knot()
    }

    fn per_source(&self) -> Self::PerSource {
        self.model.per_source()
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    const GROUND: u16 = u16::MAX;

    #[test]
    fn a_chain_and_a_star_fill_nothing() {
        let chain = [[GROUND, 0], [0, 1], [1, 2], [2, 3]];
        let plan = Elimination::new(4, &chain).unwrap();
        assert!(plan.plan().fits(4, chain.into_iter()), "{plan:?}");
        assert_eq!((plan.pairs.len(), plan.filled(), plan.targets.len()), (3, 0, 0));
        let triple = [[0, 1], [2, 0], [0, 3], [4, 0]];
        let plan = Elimination::new(5, &triple).unwrap();
        assert!(plan.plan().fits(5, triple.into_iter()), "{plan:?}");
        assert_eq!(
            (plan.order.iter().position(|[body, _]| *body == 0), plan.filled()),
            (Some(3), 0)
        );
    }

    #[test]
    fn a_ring_is_filled_in_and_a_grid_more() {
        let ring = [[0, 1], [1, 2], [2, 3], [4, 3], [0, 4]];
        let plan = Elimination::new(5, &ring).unwrap();
        assert!(plan.plan().fits(5, ring.into_iter()), "{plan:?}");
        assert_eq!((plan.pairs.len(), plan.filled()), (7, 2));
        let at = |x: u16, y: u16| 4 * y + x;
        let across = (0..4).flat_map(|y| (0..3).map(move |x| [at(x, y), at(x + 1, y)]));
        let along = (0..3).flat_map(|y| (0..4).map(move |x| [at(x, y + 1), at(x, y)]));
        let grid: Vec<[u16; 2]> = across.chain(along).collect();
        let plan = Elimination::new(16, &grid).unwrap();
        assert!(plan.plan().fits(16, grid.iter().copied()), "{plan:?}");
        assert!(plan.filled() > 5, "{}", plan.filled());
    }

    #[test]
    fn a_net_of_ten_thousand_has_a_plan_and_a_dense_one_has_none() {
        let at = |x: u16, y: u16| 100 * y + x;
        let across = (0..100).flat_map(|y| (0..99).map(move |x| [at(x, y), at(x + 1, y)]));
        let along = (0..99).flat_map(|y| (0..100).map(move |x| [at(x, y), at(x, y + 1)]));
        let net: Vec<[u16; 2]> = across.chain(along).collect();
        let plan = Elimination::new(10_000, &net).unwrap();
        assert!(plan.pairs.len() > 65_535, "{}", plan.pairs.len());
        // As docs/near-rigid.md says.
        assert_eq!(plan.targets.len() / 1_000_000, 7);
        assert!(plan.plan().fits(10_000, net.into_iter()));
        let all = (0..500).flat_map(|a| (0..a).map(move |b| [a, b])).collect::<Vec<_>>();
        assert_eq!(Elimination::new(500, &all), None);
    }
}
