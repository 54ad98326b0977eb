//! Time-stepping schemes, one per file, behind one trait.

mod blanes_moan;
mod compose;
mod dbd;
mod dbd_p1;
mod dbd_p2;
mod explicit;
mod extrapolated;
mod generalized_alpha;
mod joint_wise;
mod leapfrog;
mod pefrl;
mod rk4;
mod semi_implicit_euler;

pub use blanes_moan::BlanesMoanS6;
pub use dbd::{Dbd, DbdMemory};
pub use dbd_p1::DbdP1;
pub use dbd_p2::DbdP2;
pub use explicit::{Explicit, Kicked};
pub use extrapolated::{GeneralizedAlpha3, GeneralizedAlpha3Memory};
pub use generalized_alpha::{GeneralizedAlpha, GeneralizedAlphaMemory, RhoError};
pub use joint_wise::JointWise;
pub use leapfrog::Leapfrog;
pub use pefrl::Pefrl;
pub use rk4::{Rk4, Rk4Memory};
pub use semi_implicit_euler::SemiImplicitEuler;

use crate::damping::Damping;
use crate::geometry::Geometry;
use crate::keep::Storage;
use crate::laws::Need;
use crate::model::Terms;
use crate::real::{Constant, Real};
use crate::solve::MatrixWeights;
use crate::status::{Cause, MAX_TURN};
use crate::step::Stepper;
use crate::words::{WordSource, WordVisitor};

/// A one-step scheme of fixed cost. User-defined ones can be written with the methods of [`Stepper`].
pub trait Scheme: Copy {
    /// The name users give, also in summaries and golden tables.
    const NAME: &'static str;
    /// Order of convergence of a trajectory without dampers.
    const ORDER: u32;
    /// Order of convergence of a trajectory with dampers.
    const ORDER_DAMPED: u32;
    /// How dampers act.
    const DAMPING: Damping;
    /// Whether its memory per body continues from step to step: it is then part of a snapshot.
    const REMEMBERS: bool = false;
    /// Whether memories that lose energy may be updated at its evaluations: not where it steps back in time.
    const SETTLES: bool = true;
    /// Whether its steps advance memories of laws: it evaluates once per step, at its end.
    const ADVANCES: bool = false;
    /// Whether its steps move driven bodies: by one drift, or at one velocity, over the whole step.
    const DRIVES: bool = false;
    /// \[rad\] the largest rotation of a body in a step.
    const MAX_TURN: Constant = Constant::new(MAX_TURN);
    /// \[rad\] the largest `ω·h` of a model's natural frequencies that its matrix allows in double and in single
    /// precision.
    const MAX_VIBRATION: Option<Constant> = None;
    /// Memory per body that the scheme needs within a step, or from one to the next.
    type Memory<P: Geometry>: Copy + Default + Send;
    /// Its storage in a plant: [`NoStorage`](crate::keep::NoStorage), [`DampingModes`](crate::keep::DampingModes) for damping joint by
    /// joint, or a [`Matrix`](crate::keep::Matrix).
    type Storage: Storage;

    /// Force evaluations per step, when nothing changes between steps.
    fn evaluations(&self) -> u32;

    /// Largest stable `ω_max·h` of an undamped oscillator; all smaller ones are stable, too.
    fn stability_limit(&self) -> f64;

    /// Whether it fulfils the requirement of a law's memory.
    #[must_use]
    fn bears(need: Need) -> bool {
        match need {
            Need::Forward => Self::SETTLES,
            Need::Steps => Self::ADVANCES,
            Need::Passes => Self::ADVANCES && Self::DAMPING != Damping::Explicit,
        }
    }

    /// Passes its parameters to the visitor, except those determined by [`Self::evaluations`].
    fn visit_parameters(&self, _visitor: &mut impl WordVisitor) {}

    /// The weights of mass, damping and stiffness in its matrix, for a scheme that has one.
    fn matrix_weights<R: Real>(&self, _h: R) -> MatrixWeights<R> {
        MatrixWeights::default()
    }

    /// Passes the memory of a body to the visitor, word by word.
    fn visit_memory<P: Geometry>(_memory: &Self::Memory<P>, _visitor: &mut impl WordVisitor) {}

    /// Reads it from the source in the same order.
    fn fill_memory<P: Geometry>(_memory: &mut Self::Memory<P>, _source: &mut impl WordSource) {}

    /// One step of the size [`Workspace::step_size`](crate::step::Workspace::step_size). Ends with the state at the
    /// next step's start; the caller increments the counter and checks for values that are not finite and for too fast
    /// rotation.
    ///
    /// # Errors
    /// The torsion spring whose torsion angle is undefined; the state is then that of the stage.
    fn step<P: Geometry, T: Terms<P>>(
        &self,
        stepper: &mut Stepper<'_, '_, P, T, Self::Memory<P>>,
    ) -> Result<(), Cause>;
}
