//! An ensemble: many instances of one scene, each with its own parameters, state and inputs.
//!
//! `(models, scheme, h) => ensemble; steps => states`. Instances are grouped in batches, one per lane, and batches are
//! distributed over threads. Neither changes a bit of any instance.

use std::num::NonZeroUsize;
use std::thread;

use dbd_kernel::geometry::Float;
use dbd_kernel::plant::{InputError, PlantError, StateError};
use dbd_kernel::{Failure, InputIndex, Plant, State};
use dbd_scene::SceneModel;

use crate::alike::{Difference, difference};
use crate::batch::{Batch, PlantOf};
use crate::in_lanes::InLanes;
use crate::instructions::InstructionSet;
use crate::number::Number;

/// A step of lanes is fully inlined. Without optimisation each of its values has its own stack slot: megabytes, more
/// than a main thread may have.
const OPTIMISED: bool = !cfg!(debug_assertions);

/// Stack size of a thread; only the used part is allocated.
const STACK: usize = if OPTIMISED { 2 << 20 } else { 64 << 20 };

/// Why an ensemble cannot be made.
#[derive(Clone, Copy, Debug, PartialEq, thiserror::Error, miette::Diagnostic)]
pub enum EnsembleError {
    /// The instances differ in structure.
    #[error("instance {instance} has another structure: {difference}")]
    #[diagnostic(help(
        "instances advance in lockstep: they may differ in numbers and states, not in bodies, joints, \
         loads, inputs or times; use a separate ensemble for each structure"
    ))]
    Structure {
        /// The first such instance.
        instance: usize,
        /// Its difference from the first.
        difference: Difference,
    },
    /// The step is not representable in this precision.
    #[error("step {step} s is not representable in this precision")]
    #[diagnostic(help("give a positive, finite step that the precision can represent"))]
    Step {
        /// \[s\] the step.
        step: f64,
    },
    /// The machine lacks the requested instruction set.
    #[error("this machine does not support {}", set.name())]
    #[diagnostic(help("the best supported set is {}", InstructionSet::best().name()))]
    Instructions {
        /// The instruction set.
        set: InstructionSet,
    },
}

/// Many instances of one scene, stepped in lockstep.
///
/// Each instance has the bits of a separate [`Plant`], regardless of the instruction set, the number of threads and its
/// index, up to and including a failure, which stops only that instance.
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
    /// [`EnsembleError`] if the models differ in structure, or the step is not representable.
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
    /// As [`Self::new`], or if the machine lacks the instruction set.
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

    /// Number of instances.
    #[must_use]
    pub fn len(&self) -> usize {
        self.count
    }

    /// Whether it is empty.
    #[must_use]
    pub fn is_empty(&self) -> bool {
        self.count == 0
    }

    /// The instruction set.
    #[must_use]
    pub fn instructions(&self) -> InstructionSet {
        self.set
    }

    /// Number of instances in lockstep.
    #[must_use]
    pub fn lanes(&self) -> usize {
        R::lanes(self.set)
    }

    /// `steps` steps of every instance with held inputs, or as many as succeed, on this thread (without optimisation on
    /// another one with a larger stack).
    ///
    /// # Panics
    /// Without optimisation, if no thread can be started.
    pub fn advance(&mut self, steps: u64) {
        self.advance_on(NonZeroUsize::MIN, steps);
    }

    /// [`Self::advance`] on the given number of threads, which share the batches evenly.
    ///
    /// # Panics
    /// If no further thread can be started.
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

    /// An instance as a separate plant: state, status, time, hash, read-outs. It does not count the evaluations of
    /// lanes.
    ///
    /// # Panics
    /// If there is no such instance.
    pub fn plant(&mut self, instance: usize) -> &PlantOf<R, S> {
        let lanes = self.lanes();
        self.batches[instance / lanes].member(instance % lanes)
    }

    /// The result of an instance's last step.
    ///
    /// # Errors
    /// The latched failure.
    ///
    /// # Panics
    /// If there is no such instance.
    pub fn status(&mut self, instance: usize) -> Result<(), Failure> {
        self.plant(instance).status()
    }

    /// The state of an instance.
    ///
    /// # Panics
    /// If there is no such instance.
    pub fn state(&mut self, instance: usize) -> &State<SceneModel<Float<R>>> {
        self.plant(instance).state()
    }

    /// The force evaluations that an instance alone would have made, if it has run in its lane since t = 0; `None` if
    /// it was changed meanwhile, or was stepped alone.
    ///
    /// # Panics
    /// If there is no such instance.
    #[must_use]
    pub fn evaluations(&self, instance: usize) -> Option<u64> {
        let lanes = self.lanes();
        self.batches[instance / lanes].evaluations(instance % lanes)
    }

    /// Sets the state of an instance and clears a failure. Instances at another step than the first of their batch are
    /// stepped alone, which is slower.
    ///
    /// # Errors
    /// As [`Plant::set_state`]; nothing is changed.
    ///
    /// # Panics
    /// If there is no such instance.
    pub fn set_state(
        &mut self,
        instance: usize,
        state: State<SceneModel<Float<R>>>,
    ) -> Result<(), StateError> {
        self.plant_mut(instance).set_state(state)
    }

    /// Sets an input of an instance, which keeps its value until set again.
    ///
    /// # Errors
    /// As [`Plant::set_input`]; nothing is changed.
    ///
    /// # Panics
    /// If there is no such instance.
    pub fn set_input(
        &mut self,
        instance: usize,
        input: InputIndex,
        value: f64,
    ) -> Result<(), InputError> {
        self.plant_mut(instance).set_input(input, value)
    }

    /// An instance for modification: to reset or clear it, or to set signals or the state of a snapshot.
    ///
    /// # Panics
    /// If there is no such instance.
    pub fn plant_mut(&mut self, instance: usize) -> &mut PlantOf<R, S> {
        let lanes = self.lanes();
        self.batches[instance / lanes].member_mut(instance % lanes)
    }
}
