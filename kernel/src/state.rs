//! The state: plain data, one visitor over its words, one hash.
//!
//! Per body position, orientation, velocity (world) and angular velocity (body axes), then the torsion springs'
//! revolution counts, then the memories of laws, then the step counter. The state contains no cache.

use crate::body::BodyState;
use crate::laws::Laws as _;
use crate::model::{LawStates, LawsIn, ModelOwner, RealOf};
use crate::schedule::Signal;
use crate::words::{Fnv1a, Word, WordSource, WordVisitor, Words};

/// The state of a plant, owned in the shape of its model; `Copy` where the model's sizes are
/// const generics.
pub struct State<M: ModelOwner> {
    /// Per body, in the model's order.
    pub bodies: M::PerBody<BodyState<M::Precision>>,
    /// Half revolutions per torsion spring, see [`crate::elements::torsion_spring`].
    pub turns: M::PerTorsion,
    /// The memories of its laws.
    pub laws: LawStates<M>,
    /// Completed steps: time is `step·h`.
    pub step: u64,
    /// The inputs' signals; not part of the hash.
    pub signals: M::PerInput<Signal<RealOf<M>>>,
}

impl<M: ModelOwner> Clone for State<M> {
    fn clone(&self) -> Self {
        Self {
            bodies: self.bodies.clone(),
            turns: self.turns.clone(),
            laws: self.laws.clone(),
            step: self.step,
            signals: self.signals.clone(),
        }
    }
}

impl<M: ModelOwner> Copy for State<M>
where
    M::PerBody<BodyState<M::Precision>>: Copy,
    M::PerTorsion: Copy,
    LawStates<M>: Copy,
    M::PerInput<Signal<RealOf<M>>>: Copy,
{
}

impl<M: ModelOwner> State<M> {
    /// The state at t = 0.
    pub fn initial(model: &M) -> Self {
        let mut bodies = model.per_body(BodyState::default());
        for (state, initial) in bodies.as_mut().iter_mut().zip(model.initial()) {
            *state = *initial;
        }
        let mut signals = model.per_input(Signal::default());
        for (signal, input) in signals.as_mut().iter_mut().zip(model.view().inputs) {
            signal.value = input.value;
        }
        let laws = model.view().laws.states();
        Self { bodies, turns: model.per_torsion(), laws, step: 0, signals }
    }

    /// FNV-1a 64 over the state's words: the same on every target for the same scene, scheme,
    /// precision and step.
    #[must_use]
    pub fn hash(&self) -> u64 {
        let mut hash = Fnv1a::new();
        self.visit(&mut hash);
        hash.finish()
    }
}

/// The list of laws of a model.
type ListOf<M> = LawsIn<<M as ModelOwner>::Precision, <M as ModelOwner>::Terms>;

impl<M: ModelOwner> Words for State<M> {
    fn visit(&self, visitor: &mut impl WordVisitor) {
        for body in self.bodies.as_ref() {
            body.visit(visitor);
        }
        for &turns in self.turns.as_ref() {
            visitor.word(Word::I32(turns));
        }
        ListOf::<M>::visit(&self.laws, visitor);
        visitor.word(Word::U64(self.step));
    }

    fn fill(&mut self, source: &mut impl WordSource) {
        for body in self.bodies.as_mut() {
            body.fill(source);
        }
        for turns in self.turns.as_mut() {
            *turns = source.take(4) as i32;
        }
        ListOf::<M>::fill(&mut self.laws, source);
        self.step = source.take(8);
    }
}
