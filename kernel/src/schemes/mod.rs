//! Time-stepping schemes, one per file, behind one trait.

mod blanes_moan;
mod compose;
mod dbd;
mod dbd_p1;
mod dbd_p2;
mod explicit;
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
pub use joint_wise::JointWise;
pub use leapfrog::Leapfrog;
pub use pefrl::Pefrl;
pub use rk4::{Rk4, Rk4Memory};
pub use semi_implicit_euler::SemiImplicitEuler;

use crate::damping::{Damping, Keep};
use crate::geometry::Geometry;
use crate::model::Terms;
use crate::status::Cause;
use crate::step::Stepper;

/// A one-step scheme of fixed cost. Others may write further ones with what [`Stepper`] offers.
pub trait Scheme: Copy {
    /// The name users give, also in summaries and golden tables.
    const NAME: &'static str;
    /// Order of convergence of a trajectory without dampers.
    const ORDER: u32;
    /// Order of convergence of a trajectory with dampers.
    const ORDER_DAMPED: u32;
    /// How dampers act.
    const DAMPING: Damping;
    /// Memory per body that the scheme needs within a step.
    type Memory<P: Geometry>: Copy + Default + Send;
    /// Whether its plants keep the joints' levers: [`NoLevers`](crate::damping::NoLevers), or
    /// [`Levers`](crate::damping::Levers) for damping joint by joint.
    type Levers: Keep;

    /// Force evaluations per step, when nothing changes between steps.
    fn evaluations(&self) -> u32;

    /// Largest stable `ω_max·h` of an undamped oscillator; all smaller ones are stable, too.
    fn stability_limit(&self) -> f64;

    /// One step of the size [`Workspace::step_size`](crate::step::Workspace::step_size). Ends with the state at the next step's start; the
    /// caller advances the counter and looks for what is not finite or spins too fast.
    ///
    /// # Errors
    /// The torsion spring whose twist is undefined; the state is then that of the stage.
    fn step<P: Geometry, T: Terms>(
        &self,
        stepper: &mut Stepper<'_, '_, P, T, Self::Memory<P>>,
    ) -> Result<(), Cause>;
}
