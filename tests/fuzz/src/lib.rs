//! Random input for everything that takes input: what must never panic, hang or lie.
//!
//! `(target, seed) => inputs => findings`. An input is bytes, and a target a function of them, so
//! that a finding is a file, and any other source of bytes may drive a target. The modules in the
//! order in which they stand on each other:
//!
//! - [`target`]: what a target is, and what it can find.
//! - [`execution`]: one input through one target, a panic caught.
//! - [`numbers`], [`edges`], [`mutation`], [`corpus`]: numbers at the extremes; all numbers of a key; texts changed;
//!   where they begin.
//! - [`scene`], [`stepper`], [`snapshot`], [`mod@line`], [`command_line`]: the targets.
//! - [`planted`]: faults that must be found.
//! - [`targets`]: all of them by name.
//! - [`shrink`]: a finding made small.
//! - [`block`], [`worker`]: inputs in numbered blocks; a process that runs them.
//! - [`campaign`]: such processes on every core, and what they found.

pub mod block;
pub mod campaign;
pub mod command_line;
pub mod corpus;
pub mod edges;
pub mod execution;
pub mod line;
pub mod mutation;
pub mod numbers;
pub mod planted;
pub mod scene;
pub mod shrink;
pub mod snapshot;
pub mod stepper;
pub mod target;
pub mod targets;
pub mod worker;
