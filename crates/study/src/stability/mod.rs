//! The largest stable step of a method about a pose.
//!
//! - [`frozen`](mod@frozen): the pose without forces.
//! - [`limit`]: which steps are stable there, found by running them.

pub mod frozen;
pub mod limit;

pub use frozen::frozen;
pub use limit::{LARGEST, MARGIN, Stability, Vibration, stability};
