//! Interface of a plant, independent of its method.
//!
//! `(inputs, steps) => state, energy, sensors`. All values are in double precision: inputs are rounded once to the
//! plant's precision, outputs are the stored words, widened exactly.

use dbd_kernel::plant::{InputError, StateError};
use dbd_kernel::readouts::{Reading, Readout};
use dbd_kernel::schedule::Signal;
use dbd_kernel::snapshot::SnapshotError;
use dbd_kernel::{BodyState, Energy, F64, Failure, InputIndex, State};
use dbd_scene::SceneModel;

use crate::method::Method;
use crate::number_format::NumberFormat;

/// A scene's model, stepped by a method.
///
/// A failure latches: later steps change nothing until [`AnyPlant::reset`], [`AnyPlant::set_state`]
/// or [`AnyPlant::restore`].
pub trait AnyPlant: Send {
    /// One step.
    ///
    /// # Errors
    /// The latched failure.
    fn step(&mut self) -> Result<(), Failure>;

    /// `n` steps with held inputs.
    ///
    /// # Errors
    /// As [`Self::step`]; the steps before it are done.
    fn advance(&mut self, n: u64) -> Result<(), Failure>;

    /// Sets an input and its rate until they are set again: a force \[N\], a torque \[N·m\], or the
    /// displacement \[m\] of an anchor with its velocity \[m/s\], which its dampers feel; the other
    /// kinds do not use the rate.
    ///
    /// # Errors
    /// [`InputError`] where the model lacks the input, a table drives it, or the numbers are not
    /// finite in the precision; nothing is changed then.
    fn set(&mut self, input: InputIndex, value: f64, rate: f64) -> Result<(), InputError>;

    /// The present value of a sensor, SI units; `None` if the model lacks its parts or the torsion angle is undefined.
    /// Computed in the plant's precision.
    fn read(&self, readout: &Readout<F64>) -> Option<Reading<f64>>;

    /// The state of all bodies: positions \[m\] and velocities \[m/s\] in the world, orientations body
    /// → world, angular velocities \[rad/s\] in body axes; with revolution counts, step counter and signals.
    fn state(&self) -> State<SceneModel<F64>>;

    /// Replaces the contents of `bodies` by the states of all bodies, see [`AnyPlant::state`].
    fn bodies(&self, bodies: &mut Vec<BodyState<F64>>);

    /// Values \[N, N·m or m\] and rates of all inputs at the end of the coming step, before any jump at that time.
    fn signals_at_end(&self) -> Vec<Signal<f64>>;

    /// \[J\] the energies of the present state by kind.
    fn energy(&self) -> Energy<f64>;

    /// Resets to t = 0 with the initial inputs; clears a failure.
    fn reset(&mut self);

    /// Continues from a state, including step counter and signals, each number rounded once; clears a failure.
    ///
    /// # Errors
    /// [`StateError`] where it is not of this model, not finite, or an orientation is not of unit
    /// length; nothing is changed then.
    fn set_state(&mut self, state: &State<SceneModel<F64>>) -> Result<(), StateError>;

    /// The state as bytes, which a plant of the same model, method and step can restore on any machine.
    ///
    /// # Errors
    /// [`SnapshotError::Failed`] where the plant has failed.
    fn snapshot(&self) -> Result<Vec<u8>, SnapshotError>;

    /// Continues from a snapshot, bit for bit; clears a failure.
    ///
    /// # Errors
    /// [`SnapshotError`] where the bytes are damaged or of another model, method or step; nothing is
    /// changed then.
    fn restore(&mut self, bytes: &[u8]) -> Result<(), SnapshotError>;

    /// FNV-1a 64 over the state's stored words: the same on every machine for the same bits.
    fn hash(&self) -> u64;

    /// The result of the last step.
    ///
    /// # Errors
    /// The latched failure.
    fn status(&self) -> Result<(), Failure>;

    /// \[s\] the present time: steps done times the step, never accumulated.
    fn time(&self) -> f64;

    /// Steps done since t = 0, a failed one included.
    fn steps(&self) -> u64;

    /// Force evaluations performed since t = 0.
    fn evaluations(&self) -> u64;

    /// \[s\] the step as given.
    fn step_size(&self) -> f64;

    /// Number format of its state.
    fn number_format(&self) -> NumberFormat;

    /// The method.
    fn method(&self) -> &Method;

    /// The model of the plant, with constants rounded to the precision and widened exactly; in world axes, like the
    /// states, also if the scene is planar.
    fn model(&self) -> &SceneModel<F64>;
}
