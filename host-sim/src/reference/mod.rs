//! References in plain std Rust: another way to the same equations, sharing no force code with
//! the kernel.
//!
//! `model's data => mechanism => accelerations`, and from them:
//!
//! - [`mechanism`], [`elements`], [`driven`], [`state`], [`signals`]: bodies and elements as a std
//!   user would write them, `Vec`, nalgebra, `Box<dyn Element>`, double precision.
//! - [`naive`]: semi-implicit Euler and leapfrog on it, the baseline of every timing.
//! - [`truth`], [`trajectory`]: DOP853 with a second opinion; the error of any run against it.
//! - [`window`]: how long a trajectory can be told from a perturbed one.
//! - [`implicit`]: linearly implicit Euler with a sparse solve, [`ordering`] its elimination.
//! - [`spectrum`]: all eigenfrequencies of a pose.

pub mod driven;
pub mod elements;
pub mod equations;
pub mod implicit;
pub mod mechanism;
pub mod naive;
pub mod ordering;
pub mod signals;
pub mod spectrum;
pub mod state;
pub mod trajectory;
pub mod truth;
pub mod window;

pub use mechanism::Mechanism;
pub use spectrum::eigenfrequencies;
pub use state::State;
pub use trajectory::Trajectory;
