//! An ensemble: many instances of one scene, each with its own parameters, state and inputs.
//!
//! `(models, scheme, h) => ensemble; steps => states`. Instances lie in batches, one per lane; batches
//! lie on threads. Neither changes a bit of any instance.

use std::num::NonZeroUsize;
use std::thread;

use dbd_kernel::geometry::Float;
use dbd_kernel::index::InputIndex;
use dbd_kernel::plant::{InputError, PlantError, StateError};
use dbd_kernel::{Plant, State, Status};
use dbd_scene::SceneModel;

use crate::alike::{Difference, difference};
use crate::batch::{Batch, PlantOf};
use crate::in_lanes::InLanes;
use crate::instructions::InstructionSet;
use crate::number::Number;

/// A step of lanes is inlined whole. Where it is not optimised, each of its values has a place of its own:
/// megabytes of them, more than a main thread may have.
const OPTIMISED: bool = !cfg!(debug_assertions);

/// What a thread has for its stack; only what is used is taken from the machine.
const STACK: usize = if OPTIMISED { 2 << 20 } else { 64 << 20 };

/// Why there is no ensemble of some models.
#[derive(Clone, Copy, Debug, PartialEq, thiserror::Error, miette::Diagnostic)]
pub enum EnsembleError {
    /// The instances are not of one structure.
    #[error("instance {instance} is of another structure: {difference}")]
    #[diagnostic(help(
        "instances go in lockstep: they may differ in numbers and states, not in bodies, joints, \
         loads, inputs or times; give models of each structure an ensemble of their own"
    ))]
    Structure {
        /// The first such instance.
        instance: usize,
        /// In what it differs from the first.
        difference: Difference,
    },
    /// The step is none in this precision.
    #[error("a step of {step} s is none in this precision")]
    #[diagnostic(help("a step is positive, finite and no less than the precision can hold"))]
    Step {
        /// \[s\] the step.
        step: f64,
    },
    /// The machine lacks the instruction set that was asked for.
    #[error("this machine has no {}", set.name())]
    #[diagnostic(help("the best it has is {}", InstructionSet::best().name()))]
    Instructions {
        /// The instruction set.
        set: InstructionSet,
    },
}

/// Many instances of one scene, stepped in lockstep.
///
/// Each instance has the bits of a [`Plant`] of its own, whatever the instruction set, the number of
/// threads and its place among the others, up to and including a failure, which stops it alone.
pub struct Ensemble<R: Number, S: InLanes> {
    batches: Vec<Box<dyn Batch<R, S>>>,
    set: InstructionSet,
    count: usize,
}

impl<R: Number, S: InLanes + Send + 'static> Ensemble<R, S> {
    /// An ensemble of an instance of each model at its initial state, on the best instruction set
    /// of this machine.
    ///
    /// # Errors
    /// [`EnsembleError`] where the models are not of one structure, or the step is none.
    pub fn new(
        models: Vec<SceneModel<Float<R>>>,
        scheme: S,
        step_size: f64,
    ) -> Result<Self, EnsembleError> {
        Self::with_instructions(models, scheme, step_size, InstructionSet::best())
    }

    /// [`Self::new`] on a chosen instruction set.
    ///
    /// # Errors
    /// As [`Self::new`], or where the machine lacks the instruction set.
    pub fn with_instructions(
        models: Vec<SceneModel<Float<R>>>,
        scheme: S,
        step_size: f64,
        set: InstructionSet,
    ) -> Result<Self, EnsembleError> {
        if !set.is_there() {
            return Err(EnsembleError::Instructions { set });
        }
        if let Some((first, others)) = models.split_first() {
            for (i, other) in others.iter().enumerate() {
                if let Some(difference) = difference(first, other) {
                    return Err(EnsembleError::Structure { instance: i + 1, difference });
                }
            }
        }
        let count = models.len();
        let mut batches = Vec::with_capacity(count.div_ceil(R::lanes(set)));
        let mut models = models.into_iter();
        while models.len() > 0 {
            let plants: Result<Vec<_>, PlantError> = models
                .by_ref()
                .take(R::lanes(set))
                .map(|model| Plant::new(Box::new(model), scheme, step_size))
                .collect();
            let plants = plants.map_err(|_| EnsembleError::Step { step: step_size })?;
            batches.push(R::batch(set, plants));
        }
        Ok(Self { batches, set, count })
    }

    /// How many instances there are.
    #[must_use]
    pub fn len(&self) -> usize {
        self.count
    }

    /// Whether there is none.
    #[must_use]
    pub fn is_empty(&self) -> bool {
        self.count == 0
    }

    /// The instruction set.
    #[must_use]
    pub fn instructions(&self) -> InstructionSet {
        self.set
    }

    /// How many instances go in lockstep.
    #[must_use]
    pub fn lanes(&self) -> usize {
        R::lanes(self.set)
    }

    /// `steps` steps of every instance with held inputs, or as many as succeed, on this thread (without
    /// optimisation on another one, which has the stack for it).
    ///
    /// # Panics
    /// Without optimisation, where the system has no thread.
    pub fn advance(&mut self, steps: u64) {
        self.advance_on(NonZeroUsize::MIN, steps);
    }

    /// [`Self::advance`] on so many threads, which share the batches evenly.
    ///
    /// # Panics
    /// Where the system has no further thread.
    pub fn advance_on(&mut self, threads: NonZeroUsize, steps: u64) {
        let share = self.batches.len().div_ceil(threads.get()).max(1);
        let mut shares = self.batches.chunks_mut(share);
        let own = if OPTIMISED { shares.next() } else { None };
        thread::scope(|scope| {
            for batches in shares {
                let work = move || batches.iter_mut().for_each(|batch| batch.advance(steps));
                let thread = thread::Builder::new().stack_size(STACK);
                thread.spawn_scoped(scope, work).expect("the system has a thread");
            }
            own.into_iter().flatten().for_each(|batch| batch.advance(steps));
        });
    }

    /// An instance as a plant of its own: state, status, time, hash, read-outs. It counts none of the
    /// evaluations of lanes.
    ///
    /// # Panics
    /// Where there is no such instance.
    pub fn plant(&mut self, instance: usize) -> &PlantOf<R, S> {
        let lanes = self.lanes();
        self.batches[instance / lanes].member(instance % lanes)
    }

    /// The status of an instance.
    ///
    /// # Panics
    /// Where there is no such instance.
    pub fn status(&mut self, instance: usize) -> Status {
        self.plant(instance).status()
    }

    /// The state of an instance.
    ///
    /// # Panics
    /// Where there is no such instance.
    pub fn state(&mut self, instance: usize) -> &State<SceneModel<Float<R>>> {
        self.plant(instance).state()
    }

    /// The force evaluations that an instance alone would have made, where it has gone in its lane from t = 0
    /// on; `None` where it was changed on the way, or went by itself.
    ///
    /// # Panics
    /// Where there is no such instance.
    #[must_use]
    pub fn evaluations(&self, instance: usize) -> Option<u64> {
        let lanes = self.lanes();
        self.batches[instance / lanes].evaluations(instance % lanes)
    }

    /// Lets an instance go on from `state`, a failure forgotten. Instances of a batch that are at
    /// another step than the first of it go by themselves, and slower.
    ///
    /// # Errors
    /// As [`Plant::set_state`]; nothing is changed then.
    ///
    /// # Panics
    /// Where there is no such instance.
    pub fn set_state(
        &mut self,
        instance: usize,
        state: State<SceneModel<Float<R>>>,
    ) -> Result<(), StateError> {
        self.plant_mut(instance).set_state(state)
    }

    /// Sets an input of an instance; it is held until set again.
    ///
    /// # Errors
    /// As [`Plant::set_input`]; nothing is changed then.
    ///
    /// # Panics
    /// Where there is no such instance.
    pub fn set_input(
        &mut self,
        instance: usize,
        input: InputIndex,
        value: f64,
    ) -> Result<(), InputError> {
        self.plant_mut(instance).set_input(input, value)
    }

    /// An instance to be changed: to be reset, cleared, given signals or the state of a snapshot.
    ///
    /// # Panics
    /// Where there is no such instance.
    pub fn plant_mut(&mut self, instance: usize) -> &mut PlantOf<R, S> {
        let lanes = self.lanes();
        self.batches[instance / lanes].member_mut(instance % lanes)
    }
}
