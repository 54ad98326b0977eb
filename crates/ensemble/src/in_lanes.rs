//! Which schemes step lanes.
//!
//! `scheme => whether lanes can`.

use dbd_kernel::Scheme;
use dbd_kernel::keep::Nothing;

/// A scheme that lanes can step: all but those that damp joint by joint, whose levers are searched for
/// in each instance by itself.
pub trait InLanes: Scheme<Keeps = Nothing> {}

impl<S: Scheme<Keeps = Nothing>> InLanes for S {}
