//! A model with the elimination order of a matrix: for schemes with a linear solve.
//!
//! `(pointer to a model, index arrays) => model`. The arrays' sizes are const generics: those of the elimination order,
//! of the pairs of bodies, of the pairs that elimination changes and of groups and torsion springs.

use core::ops::Deref;

use crate::body::BodyState;
use crate::model::plan::Plan;
use crate::model::{ModelOwner, ModelRef};

/// A model and the elimination order of its bodies, see [`Plan`].
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Planned<
    H,
    const ORDER: usize,
    const PAIRS: usize,
    const TARGETS: usize,
    const SLOTS: usize,
> {
    /// The model, by any pointer: `&M` for one in flash.
    pub model: H,
    /// [`Plan::order`].
    pub order: [[u16; 2]; ORDER],
    /// [`Plan::pairs`].
    pub pairs: [[u16; 2]; PAIRS],
    /// [`Plan::targets`].
    pub targets: [u32; TARGETS],
    /// [`Plan::slots`].
    pub slots: [u32; SLOTS],
}

impl<H, const O: usize, const PAIRS: usize, const T: usize, const SLOTS: usize> ModelOwner
    for Planned<H, O, PAIRS, T, SLOTS>
where
    H: Deref<Target: ModelOwner + Sized>,
{
    type Precision = <H::Target as ModelOwner>::Precision;
    type Terms = <H::Target as ModelOwner>::Terms;
    type PerBody<V: Copy> = <H::Target as ModelOwner>::PerBody<V>;
    type PerDampedBody<V: Copy> = <H::Target as ModelOwner>::PerDampedBody<V>;
    type PerTorsion = <H::Target as ModelOwner>::PerTorsion;
    type PerLoad = <H::Target as ModelOwner>::PerLoad;
    type PerInput<V: Copy> = <H::Target as ModelOwner>::PerInput<V>;
    type PerDamper<V: Copy> = <H::Target as ModelOwner>::PerDamper<V>;
    type PerTsda<V: Copy> = <H::Target as ModelOwner>::PerTsda<V>;
    type PerPair<V: Copy> = [V; PAIRS];
    type PerSlot<V: Copy> = [V; SLOTS];
    type PerKnot = <H::Target as ModelOwner>::PerKnot;
    type PerSource = <H::Target as ModelOwner>::PerSource;

    #[inline(always)]
    fn view(
        &self,
    ) -> ModelRef<'_, <H::Target as ModelOwner>::Precision, <H::Target as ModelOwner>::Terms> {
        self.model.view()
    }

    fn initial(&self) -> &[BodyState<<H::Target as ModelOwner>::Precision>] {
        self.model.initial()
    }

    #[inline]
    fn per_body<V: Copy>(&self, value: V) -> <H::Target as ModelOwner>::PerBody<V> {
        self.model.per_body(value)
    }

    #[inline]
    fn per_damped_body<V: Copy>(&self, value: V) -> <H::Target as ModelOwner>::PerDampedBody<V> {
        self.model.per_damped_body(value)
    }

    #[inline]
    fn per_torsion(&self) -> <H::Target as ModelOwner>::PerTorsion {
        self.model.per_torsion()
    }

    #[inline]
    fn per_load(&self) -> <H::Target as ModelOwner>::PerLoad {
        self.model.per_load()
    }

    #[inline]
    fn per_input<V: Copy>(&self, value: V) -> <H::Target as ModelOwner>::PerInput<V> {
        self.model.per_input(value)
    }

    #[inline]
    fn per_damper<V: Copy>(&self, value: V) -> <H::Target as ModelOwner>::PerDamper<V> {
        self.model.per_damper(value)
    }

    #[inline]
    fn per_tsda<V: Copy>(&self, value: V) -> <H::Target as ModelOwner>::PerTsda<V> {
        self.model.per_tsda(value)
    }

    #[inline]
    fn per_pair<V: Copy>(&self, value: V) -> [V; PAIRS] {
        [value; PAIRS]
    }

    #[inline]
    fn per_slot<V: Copy>(&self, value: V) -> [V; SLOTS] {
        [value; SLOTS]
    }

    #[inline]
    fn plan(&self) -> Plan<'_> {
        let Self { order, pairs, targets, slots, .. } = self;
        Plan { order, pairs, targets, slots, decoupled: &[] }
    }

    #[inline]
    fn per_knot(&self) -> <H::Target as ModelOwner>::PerKnot {
        self.model.per_knot()
    }

    #[inline]
    fn per_source(&self) -> <H::Target as ModelOwner>::PerSource {
        self.model.per_source()
    }
}
