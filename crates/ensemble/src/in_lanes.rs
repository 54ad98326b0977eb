//! Schemes that support lanes.
//!
//! `scheme => whether lanes are supported`.

use dbd_kernel::Scheme;
use dbd_kernel::keep::Nothing;

/// A scheme that supports lanes: all except those with joint-wise damping, whose damping modes are computed per
/// instance.
pub trait InLanes: Scheme<Keeps = Nothing> {}

impl<S: Scheme<Keeps = Nothing>> InLanes for S {}
