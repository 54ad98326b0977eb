//! The same bits on host and target: whole runs, and runs that change machines half way.

pub mod hashes;
pub mod host;
pub mod relay;
