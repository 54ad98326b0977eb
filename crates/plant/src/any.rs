//! What a plant of any method can do.
//!
//! `(inputs, steps) => state, energy, read-outs`. What goes in and comes out is in double precision:
//! what goes in is rounded once to the precision that steps, what comes out is the stored words,
//! widened exactly.

use dbd_kernel::index::InputIndex;
use dbd_kernel::plant::{InputError, StateError};
use dbd_kernel::readouts::{Reading, Readout};
use dbd_kernel::schedule::Signal;
use dbd_kernel::snapshot::SnapshotError;
use dbd_kernel::{BodyState, Energy, F64, State, Status};
use dbd_scene::SceneModel;

use crate::method::Method;
use crate::numerals::Numerals;

/// A scene's model, stepped by a method.
///
/// A failure latches: later steps change nothing until [`AnyPlant::reset`], [`AnyPlant::set_state`]
/// or [`AnyPlant::restore`].
pub trait AnyPlant: Send {
    /// One step.
    fn step(&mut self) -> Status;

    /// `n` steps with held inputs, or as many as succeed.
    fn advance(&mut self, n: u64) -> Status;

    /// Sets an input and its rate until they are set again: a force \[N\], a torque \[N·m\], or the
    /// displacement \[m\] of an anchor with its velocity \[m/s\], which its dampers feel; the other
    /// kinds do not use the rate.
    ///
    /// # Errors
    /// [`InputError`] where the model lacks the input, a table drives it, or the numbers are not
    /// finite in the precision; nothing is changed then.
    fn set(&mut self, input: InputIndex, value: f64, rate: f64) -> Result<(), InputError>;

    /// What a read-out shows now, SI units; `None` where it names what the model lacks or the twist
    /// is undefined. Computed in the precision that steps.
    fn read(&self, readout: &Readout<F64>) -> Option<Reading<f64>>;

    /// The state of all bodies: positions \[m\] and velocities \[m/s\] in the world, orientations body
    /// → world, angular velocities \[rad/s\] in body axes; with turn counts, step counter and signals.
    fn state(&self) -> State<SceneModel<F64>>;

    /// The states of all bodies, as [`AnyPlant::state`] has them, in place of what `bodies` held.
    fn bodies(&self, bodies: &mut Vec<BodyState<F64>>);

    /// Values \[N, N·m or m\] and rates of all inputs at the end of the coming step, before what jumps there.
    fn signals_at_end(&self) -> Vec<Signal<f64>>;

    /// \[J\] the energies of the present state by kind.
    fn energy(&self) -> Energy<f64>;

    /// Goes back to t = 0; a failure is forgotten, inputs have their first values.
    fn reset(&mut self);

    /// Goes on from a state, its step counter and signals included, each number rounded once; a
    /// failure is forgotten.
    ///
    /// # Errors
    /// [`StateError`] where it is not of this model, not finite, or an orientation is not of unit
    /// length; nothing is changed then.
    fn set_state(&mut self, state: &State<SceneModel<F64>>) -> Result<(), StateError>;

    /// The state as bytes, which a plant of the same model, method and step takes up on any machine.
    ///
    /// # Errors
    /// [`SnapshotError::Failed`] where the plant has failed.
    fn snapshot(&self) -> Result<Vec<u8>, SnapshotError>;

    /// Goes on from a snapshot, bit for bit; a failure is forgotten.
    ///
    /// # Errors
    /// [`SnapshotError`] where the bytes are damaged or of another model, method or step; nothing is
    /// changed then.
    fn restore(&mut self, bytes: &[u8]) -> Result<(), SnapshotError>;

    /// FNV-1a 64 over the state's stored words: the same on every machine for the same bits.
    fn hash(&self) -> u64;

    /// The status of the last step.
    fn status(&self) -> Status;

    /// \[s\] the present time: steps done times the step, never accumulated.
    fn time(&self) -> f64;

    /// Steps done since t = 0, a failed one included.
    fn steps(&self) -> u64;

    /// Force evaluations performed since t = 0.
    fn evaluations(&self) -> u64;

    /// \[s\] the step as given.
    fn step_size(&self) -> f64;

    /// How many digits the numbers of its state have.
    fn numerals(&self) -> Numerals;

    /// The method.
    fn method(&self) -> &Method;

    /// The model that steps, its constants as rounded to the precision, widened exactly; in the world's
    /// axes, in which states are, also where the scene is planar.
    fn model(&self) -> &SceneModel<F64>;
}
