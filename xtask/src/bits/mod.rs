//! The same bits on host and target, on other machines and however they are optimised: whole runs,
//! and runs that change machines half way.

pub mod closed_loop;
pub mod hashes;
pub mod host;
pub mod machines;
pub mod relay;
