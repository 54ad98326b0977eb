//! References in plain std Rust: an independent implementation of the same equations, without force code of the kernel.
//! For scenes with interactions or driven bodies, which they lack, the kernel at fine steps is the reference solution.
//!
//! `model's data => mechanism => accelerations`, and from them the reference solutions of runs. The modules in
//! dependency order:
//!
//! - [`state`], [`signals`]: a mechanism's state and time, in nalgebra's types.
//! - [`instant`]: bodies, points and wrenches at one instant.
//! - [`elements`], [`driven`]: springs, loads and inputs as a std user would write them, `Vec`,
//!   nalgebra, `Box<dyn Element>`, double precision.
//! - [`mechanism`]: a scene of them.
//! - [`naive`]: semi-implicit Euler and leapfrog on it, the baseline of every timing.
//! - [`ordering`], `blocks`: a sparse matrix of a block per pair of bodies, and its elimination.
//! - [`implicit`], [`generalized_alpha`]: linearly implicit Euler and generalised-α, one sparse solve per step.
//! - [`spectrum`]: all eigenfrequencies of a pose.
//! - [`equations`], [`reference_solution`]: the mechanism as a first-order system; DOP853 with a second integrator.
//! - [`perturbed`](mod@perturbed), [`fine`]: a state nearby; the reference solution of any scene.
//! - [`metric`], [`trajectory`]: distance of a run from the reference solution.
//! - [`window`]: how long a trajectory stays close to a perturbed one.

mod blocks;
pub mod driven;
pub mod elements;
pub mod equations;
pub mod fine;
pub mod generalized_alpha;
pub mod implicit;
pub mod instant;
pub mod mechanism;
pub mod metric;
pub mod naive;
pub mod ordering;
pub mod perturbed;
pub mod reference_solution;
pub mod signals;
pub mod spectrum;
pub mod state;
pub mod trajectory;
pub mod window;

pub(crate) use blocks::BlockMatrix;
pub use mechanism::Mechanism;
pub use spectrum::eigenfrequencies;
pub use state::State;
pub use trajectory::Trajectory;
