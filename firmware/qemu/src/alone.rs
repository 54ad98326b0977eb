//! A model that shares no code of a step with the same model under another scheme.
//!
//! `model, scheme => type of its own`. An evaluation depends on the kinds of element, not on the
//! scheme: in an image with several schemes the compiler makes one function of it, where an image
//! with one scheme may inline it: instructions differ by up to 15 %. A type per scheme keeps them
//! apart, so that each step is compiled as in an image that has no other.

use core::marker::PhantomData;

use dbd_kernel::model::Plan;
use dbd_kernel::model::{ModelOwner, ModelRef, Terms};
use dbd_kernel::{BodyState, Geometry, Scheme};

/// The model, for this scheme only.
#[derive(Clone, Copy, Debug)]
#[repr(transparent)]
pub struct Alone<M, S> {
    model: M,
    scheme: PhantomData<S>,
}

impl<M, S> Alone<M, S> {
    /// The model by itself.
    #[must_use]
    pub const fn new(model: M) -> Self {
        Self { model, scheme: PhantomData }
    }
}

/// The terms of a model, for one scheme only.
#[derive(Clone, Copy, Debug, Default)]
pub struct TermsAlone<T, S>(PhantomData<(T, S)>);

impl<P: Geometry, T: Terms<P>, S: Scheme + Default + 'static> Terms<P> for TermsAlone<T, S> {
    type Laws = T::Laws;

    const GRAVITY: bool = T::GRAVITY;
    const LOADS: bool = T::LOADS;
    const TSDAS: bool = T::TSDAS;
    const BUSHINGS: bool = T::BUSHINGS;
    const TORSIONS: bool = T::TORSIONS;
    const DAMPERS: bool = T::DAMPERS;
    const LINES: bool = T::LINES;
    const INPUTS: bool = T::INPUTS;
    const CLEARANCES: bool = T::CLEARANCES;
    const REVOLUTES: bool = T::REVOLUTES;
    const UNIVERSALS: bool = T::UNIVERSALS;
    const SOURCES: bool = T::SOURCES;
    const DRIVEN: bool = T::DRIVEN;
}

impl<M: ModelOwner, S: Scheme + Default + 'static> ModelOwner for Alone<M, S> {
    type Precision = M::Precision;
    type Terms = TermsAlone<M::Terms, S>;
    type PerBody<T: Copy> = M::PerBody<T>;
    type PerDampedBody<T: Copy> = M::PerDampedBody<T>;
    type PerTorsion = M::PerTorsion;
    type PerLoad = M::PerLoad;
    type PerInput<T: Copy> = M::PerInput<T>;
    type PerDamper<T: Copy> = M::PerDamper<T>;
    type PerTsda<T: Copy> = M::PerTsda<T>;
    type PerPair<T: Copy> = M::PerPair<T>;
    type PerSlot<T: Copy> = M::PerSlot<T>;
    type PerKnot = M::PerKnot;
    type PerSource = M::PerSource;

    #[inline(always)]
    fn view(&self) -> ModelRef<'_, M::Precision, Self::Terms> {
        let view = self.model.view();
        ModelRef {
            bodies: view.bodies,
            gravity: view.gravity,
            groups: view.groups,
            points: view.points,
            tsdas: view.tsdas,
            bushings: view.bushings,
            dampers: view.dampers,
            torsions: view.torsions,
            loads: view.loads,
            lines: view.lines,
            inputs: view.inputs,
            knots: view.knots,
            clearances: view.clearances,
            revolutes: view.revolutes,
            universals: view.universals,
            sources: view.sources,
            laws: view.laws,
        }
    }

    fn initial(&self) -> &[BodyState<M::Precision>] {
        self.model.initial()
    }

    #[inline]
    fn per_body<T: Copy>(&self, value: T) -> M::PerBody<T> {
        self.model.per_body(value)
    }

    #[inline]
    fn per_damped_body<T: Copy>(&self, value: T) -> M::PerDampedBody<T> {
        self.model.per_damped_body(value)
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
    fn per_input<T: Copy>(&self, value: T) -> M::PerInput<T> {
        self.model.per_input(value)
    }

    #[inline]
    fn per_damper<T: Copy>(&self, value: T) -> M::PerDamper<T> {
        self.model.per_damper(value)
    }

    #[inline]
    fn per_pair<T: Copy>(&self, value: T) -> M::PerPair<T> {
        self.model.per_pair(value)
    }

    #[inline]
    fn per_slot<T: Copy>(&self, value: T) -> M::PerSlot<T> {
        self.model.per_slot(value)
    }

    #[inline]
    fn plan(&self) -> Plan<'_> {
        self.model.plan()
    }

    #[inline]
    fn per_tsda<T: Copy>(&self, value: T) -> M::PerTsda<T> {
        self.model.per_tsda(value)
    }

    #[inline]
    fn per_knot(&self) -> M::PerKnot {
        self.model.per_knot()
    }

    #[inline]
    fn per_source(&self) -> M::PerSource {
        self.model.per_source()
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::models::double_wishbone::{DOUBLE_WISHBONE_F32, DOUBLE_WISHBONE_STEP};
    use dbd_kernel::{Leapfrog, Plant};

    #[test]
    fn a_model_by_itself_has_the_same_bits() {
        let alone: Alone<_, Leapfrog> = Alone::new(DOUBLE_WISHBONE_F32);
        let mut plant = Plant::new(&alone, Leapfrog, DOUBLE_WISHBONE_STEP).unwrap();
        let mut other = Plant::new(&DOUBLE_WISHBONE_F32, Leapfrog, DOUBLE_WISHBONE_STEP).unwrap();
        assert_eq!(size_of_val(&plant), size_of_val(&other));
        assert!(plant.advance(100).is_ok() && other.advance(100).is_ok());
        assert_eq!(plant.hash(), other.hash());
        assert_ne!(
            plant.hash(),
            Plant::new(&alone, Leapfrog, DOUBLE_WISHBONE_STEP).unwrap().hash()
        );
    }
}
