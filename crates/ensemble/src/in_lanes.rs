//! Schemes that support lanes.
//!
//! `scheme => whether lanes are supported`.

use dbd_kernel::Scheme;
use dbd_kernel::keep::NoStorage;

/// A scheme that supports lanes: all except those with joint-wise damping, whose damping modes are computed per
/// instance.
pub trait InLanes: Scheme<Storage = NoStorage> {}

impl<S: Scheme<Storage = NoStorage>> InLanes for S {}
