//! Which schemes step lanes.
//!
//! `scheme => whether lanes can`.

use dbd_kernel::Scheme;
use dbd_kernel::damping::NoLevers;

/// A scheme that lanes can step: all but those that damp joint by joint, whose levers are searched for
/// in each instance by itself.
pub trait InLanes: Scheme<Levers = NoLevers> {}

impl<S: Scheme<Levers = NoLevers>> InLanes for S {}
