//! A model with the plan of a matrix: for schemes with a linear solve.
//!
//! `(model, index arrays) => model`. The arrays' sizes are const generics: those of the order of
//! elimination, of the pairs of bodies, of the pairs that elimination changes and of groups and torsion
//! springs.

use crate::body::BodyState;
use crate::model::{ModelOwner, ModelRef};
use crate::solve::Plan;

/// A model and the order in which its bodies are eliminated, see [`Plan`].
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Planned<
    M,
    const ORDER: usize,
    const PAIRS: usize,
    const TARGETS: usize,
    const HOMES: usize,
> {
    /// The model.
    pub model: M,
    /// [`Plan::order`].
    pub order: [u16; ORDER],
    /// [`Plan::pairs`].
    pub pairs: [[u16; 2]; PAIRS],
    /// [`Plan::targets`].
    pub targets: [u16; TARGETS],
    /// [`Plan::homes`].
    pub homes: [u16; HOMES],
}

impl<M: ModelOwner, const O: usize, const PAIRS: usize, const T: usize, const H: usize> ModelOwner
    for Planned<M, O, PAIRS, T, H>
{
    type Precision = M::Precision;
    type Terms = M::Terms;
    type PerBody<V: Copy> = M::PerBody<V>;
    type PerTorsion = M::PerTorsion;
    type PerLoad = M::PerLoad;
    type PerInput = M::PerInput;
    type PerDamper<V: Copy> = M::PerDamper<V>;
    type PerTsda<V: Copy> = M::PerTsda<V>;
    type PerPair<V: Copy> = [V; PAIRS];
    type PerKnot = M::PerKnot;

    #[inline(always)]
    fn view(&self) -> ModelRef<'_, M::Precision, M::Terms> {
        self.model.view()
    }

    fn initial(&self) -> &[BodyState<M::Precision>] {
        self.model.initial()
    }

    #[inline]
    fn per_body<V: Copy>(&self, value: V) -> M::PerBody<V> {
        self.model.per_body(value)
    }

    #[inline]
    fn per_torsion(&self) -> M::PerTorsion {
        self.model.per_torsion()
    }

    #[inline]
    fn per_load(&self) -> M::PerLoad {
        self.model.per_load()
    }

    #[inline]
    fn per_input(&self) -> M::PerInput {
        self.model.per_input()
    }

    #[inline]
    fn per_damper<V: Copy>(&self, value: V) -> M::PerDamper<V> {
        self.model.per_damper(value)
    }

    #[inline]
    fn per_tsda<V: Copy>(&self, value: V) -> M::PerTsda<V> {
        self.model.per_tsda(value)
    }

    #[inline]
    fn per_pair<V: Copy>(&self, value: V) -> [V; PAIRS] {
        [value; PAIRS]
    }

    #[inline]
    fn plan(&self) -> Plan<'_> {
        Plan { order: &self.order, pairs: &self.pairs, targets: &self.targets, homes: &self.homes }
    }

    #[inline]
    fn per_knot(&self) -> M::PerKnot {
        self.model.per_knot()
    }
}
