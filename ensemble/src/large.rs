//! A plant of one large model, stepped in lanes.
//!
//! `(plant, steps) => plant`, on the instruction set of the machine or on a chosen one.

use std::fmt::{Debug, Formatter};
use std::num::NonZeroUsize;

use dbd_kernel::{Leapfrog, Status};
use thiserror::Error;

use crate::batch::PlantOf;
use crate::instructions::InstructionSet;
use crate::number::Number;
use crate::rows::{Rowed, Unfit, fits};

/// A plant of a large model, stepped in lanes with the bits that it has by itself, leapfrog.
///
/// Joints and bodies of one model lie in the lanes of a register, not instances of many. It pays from a dozen bodies on.
/// Which models it steps says [`fits`]; a run that fails does so at the step and for the cause of the plant by
/// itself.
///
/// ```
/// use std::num::NonZeroUsize;
///
/// use dbd_bench::chain::{self, Joints};
/// use dbd_ensemble::{Large, PlantOf};
/// use dbd_kernel::{Leapfrog, Plant};
///
/// // A hundred links, each on the one before.
/// let model = chain::model(100, Joints::Revolute)?;
/// let plant = || Plant::new(Box::new(model.clone()), Leapfrog, chain::STEP);
/// let mut large = Large::<f64>::new(plant()?)?.on(NonZeroUsize::new(2).expect("not 0"));
/// large.advance(200).ok()?;
///
/// let mut alone: PlantOf<f64, Leapfrog> = plant()?;
/// alone.advance(200).ok()?;
/// assert_eq!(large.plant().hash(), alone.hash());
/// # Ok::<(), Box<dyn std::error::Error>>(())
/// ```
pub struct Large<R: Number> {
    rows: Box<dyn Rowed<R>>,
    set: InstructionSet,
}

/// Why a plant is not stepped in lanes.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Error)]
pub enum LargeError {
    /// The model is of another kind.
    #[error("the model is not one that lanes step by itself: {0}")]
    Unfit(#[from] Unfit),
    /// The machine lacks the instruction set.
    #[error("this machine has no {}", .0.name())]
    Instructions(InstructionSet),
}

/// A plant that is not stepped in lanes, as it was, and why.
#[derive(Error)]
#[error("{error}")]
pub struct Refused<R: Number> {
    /// The plant.
    pub plant: Box<PlantOf<R, Leapfrog>>,
    /// Why.
    pub error: LargeError,
}

impl<R: Number> Debug for Refused<R> {
    fn fmt(&self, f: &mut Formatter<'_>) -> std::fmt::Result {
        f.debug_tuple("Refused").field(&self.error).finish()
    }
}

impl<R: Number> Large<R> {
    /// A plant in lanes on the best instruction set of this machine, from its present state on.
    ///
    /// # Errors
    /// The plant, as it was, where its model does not [fit](fits).
    pub fn new(plant: PlantOf<R, Leapfrog>) -> Result<Self, Refused<R>> {
        Self::with_instructions(plant, InstructionSet::best())
    }

    /// [`Self::new`] on a chosen instruction set.
    ///
    /// # Errors
    /// As [`Self::new`], and where the machine lacks the instruction set.
    pub fn with_instructions(
        plant: PlantOf<R, Leapfrog>,
        set: InstructionSet,
    ) -> Result<Self, Refused<R>> {
        let error = if set.is_there() {
            fits(plant.model()).err().map(LargeError::Unfit)
        } else {
            Some(LargeError::Instructions(set))
        };
        match error {
            None => Ok(Self { rows: R::rows(set, plant, NonZeroUsize::MIN), set }),
            Some(error) => Err(Refused { plant: Box::new(plant), error }),
        }
    }

    /// The same on several threads, at most one per body. Each steps bodies that follow one another, and they meet once
    /// in a step: from a thousand bodies on two are faster than one, on cores that have nothing else to do. Joints
    /// between bodies of two threads are computed by both, so that a mechanism with many of them gains less.
    #[must_use]
    pub fn on(self, threads: NonZeroUsize) -> Self {
        let Self { rows, set } = self;
        Self { rows: R::rows(set, rows.into_plant(), threads), set }
    }

    /// `steps` steps, or as many as succeed. Steps go in blocks of 64, on several threads of 512: fewer at a time take
    /// longer each.
    pub fn advance(&mut self, steps: u64) -> Status {
        self.rows.advance(steps)
    }

    /// The plant at the present: state, status, time, hash, read-outs. Of the force evaluations it counts only those
    /// that it made itself.
    #[must_use]
    pub fn plant(&self) -> &PlantOf<R, Leapfrog> {
        self.rows.plant()
    }

    /// The plant, to be changed: its state, a failure to be forgotten.
    pub fn plant_mut(&mut self) -> &mut PlantOf<R, Leapfrog> {
        self.rows.plant_mut()
    }

    /// The plant alone.
    #[must_use]
    pub fn into_plant(self) -> PlantOf<R, Leapfrog> {
        self.rows.into_plant()
    }

    /// The instruction set that steps it.
    #[must_use]
    pub fn instructions(&self) -> InstructionSet {
        self.set
    }
}

#[cfg(test)]
mod tests {
    use dbd_bench::chain::{self, Joints};
    use dbd_kernel::Plant;

    use super::*;

    #[test]
    fn what_does_not_fit_is_handed_back() {
        let mut model = chain::model(3, Joints::Spherical).unwrap();
        let plant = |model: &dbd_scene::SceneModel<_>| {
            Plant::new(Box::new(model.clone()), Leapfrog, chain::STEP).unwrap()
        };
        let Err(mut refused) = Large::<f64>::new(plant(&model)) else { panic!("it fits") };
        assert_eq!(refused.error, LargeError::Unfit(Unfit::Joint(0)));
        assert!(refused.to_string().contains("group 0"), "{refused}");
        assert!(refused.plant.advance(2).is_running());
        model = chain::model(3, Joints::Revolute).unwrap();
        for set in InstructionSet::ALL {
            let large = Large::<f64>::with_instructions(plant(&model), set);
            match large {
                Ok(large) => assert_eq!(large.instructions(), set),
                Err(refused) => {
                    assert_eq!(refused.error, LargeError::Instructions(set));
                    assert!(!set.is_there());
                }
            }
        }
    }
}
