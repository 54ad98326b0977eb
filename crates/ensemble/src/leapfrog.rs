//! Leapfrog's ensembles and their speed measurement, compiled here once for all callers.
//!
//! `(models, h) => ensemble of either precision; (model, h, instruction set, threads) => steps per second`, see
//! [`crate::pace()`].

use dbd_kernel::plant::InputError;
use dbd_kernel::{F32, F64, Failure, InputIndex, Leapfrog, State};
use dbd_scene::{SceneModel, rounded, widen};

use crate::ensemble::{Ensemble, EnsembleError};
use crate::in_lanes::InLanes;
use crate::instructions::InstructionSet;
use crate::number::Number;
use crate::pace::{Course, Pace, pace};

/// An ensemble with the precision chosen at run time. Its outputs are in double precision, the stored words widened
/// exactly.
pub trait AnyEnsemble: Send {
    /// `steps` steps of every instance, or as many as succeed, on this thread.
    fn advance(&mut self, steps: u64);

    /// The status of an instance.
    ///
    /// # Panics
    /// If there is no such instance.
    fn status(&mut self, instance: usize) -> Result<(), Failure>;

    /// The state of an instance.
    ///
    /// # Panics
    /// If there is no such instance.
    fn state(&mut self, instance: usize) -> State<SceneModel<F64>>;

    /// The hash of an instance's state, as [`dbd_kernel::Plant::hash`].
    ///
    /// # Panics
    /// If there is no such instance.
    fn hash(&mut self, instance: usize) -> u64;

    /// An instance continues from a state of a plant of its model, each number rounded once; clears a failure.
    ///
    /// # Panics
    /// If there is no such instance.
    fn resume(&mut self, instance: usize, state: &State<SceneModel<F64>>);

    /// As [`Ensemble::set_input`].
    ///
    /// # Errors
    /// As there.
    ///
    /// # Panics
    /// If there is no such instance.
    fn set_input(
        &mut self,
        instance: usize,
        input: InputIndex,
        value: f64,
    ) -> Result<(), InputError>;

    /// Resets an instance to its initial state, as [`dbd_kernel::Plant::reset`].
    ///
    /// # Panics
    /// If there is no such instance.
    fn reset(&mut self, instance: usize);

    /// As [`Ensemble::evaluations`].
    ///
    /// # Panics
    /// If there is no such instance.
    fn evaluations(&self, instance: usize) -> Option<u64>;
}

impl<R: Number, S: InLanes + Send + 'static> AnyEnsemble for Ensemble<R, S> {
    fn advance(&mut self, steps: u64) {
        self.advance(steps);
    }

    fn status(&mut self, instance: usize) -> Result<(), Failure> {
        self.status(instance)
    }

    fn state(&mut self, instance: usize) -> State<SceneModel<F64>> {
        widen(self.state(instance))
    }

    fn hash(&mut self, instance: usize) -> u64 {
        self.plant(instance).hash()
    }

    fn resume(&mut self, instance: usize, state: &State<SceneModel<F64>>) {
        self.plant_mut(instance).resume(rounded(state));
    }

    fn set_input(
        &mut self,
        instance: usize,
        input: InputIndex,
        value: f64,
    ) -> Result<(), InputError> {
        self.set_input(instance, input, value)
    }

    fn reset(&mut self, instance: usize) {
        self.plant_mut(instance).reset();
    }

    fn evaluations(&self, instance: usize) -> Option<u64> {
        self.evaluations(instance)
    }
}

/// Instances in double precision.
///
/// # Errors
/// As [`Ensemble::with_instructions`].
pub fn ensemble_in_f64(
    models: Vec<SceneModel<F64>>,
    step_size: f64,
    set: InstructionSet,
) -> Result<Box<dyn AnyEnsemble>, EnsembleError> {
    Ok(Box::new(Ensemble::with_instructions(models, Leapfrog, step_size, set)?))
}

/// Instances rounded to single precision.
///
/// # Errors
/// As [`Ensemble::with_instructions`].
pub fn ensemble_in_f32(
    models: Vec<SceneModel<F64>>,
    step_size: f64,
    set: InstructionSet,
) -> Result<Box<dyn AnyEnsemble>, EnsembleError> {
    let models = models.iter().map(|model| model.convert::<F32>()).collect();
    Ok(Box::new(Ensemble::with_instructions(models, Leapfrog, step_size, set)?))
}

/// Number of instances in double precision in lockstep on this machine; twice as many in single.
#[must_use]
pub fn lanes_in_f64() -> usize {
    f64::lanes(InstructionSet::best())
}

/// The speed for a model in double precision.
///
/// # Errors
/// As [`crate::pace()`].
pub fn pace_in_f64(
    model: &SceneModel<F64>,
    step_size: f64,
    course: Course,
) -> Result<Pace, EnsembleError> {
    pace(model, Leapfrog, step_size, course)
}

/// The speed for a model rounded to single precision.
///
/// # Errors
/// As [`crate::pace()`].
pub fn pace_in_f32(
    model: &SceneModel<F64>,
    step_size: f64,
    course: Course,
) -> Result<Pace, EnsembleError> {
    pace(&model.convert::<F32>(), Leapfrog, step_size, course)
}
