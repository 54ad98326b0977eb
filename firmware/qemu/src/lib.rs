//! Discrete Body Dynamics on Cortex-M4F: const models in flash, board drivers, programs.
//!
//! `shipped models => program => lines on the console`. Hardware is touched in [`board`] only;
//! models and programs also compile for a host, where `hash` prints the same lines.
//!
//! # Modules
//!
//! Each uses only those before it:
//!
//! - [`models`], [`alone`]: shipped models, const and in flash; a model that shares no code with another.
//! - [`console`]: arguments, lines and files of a program.
//! - [`root`], [`sensors`], [`trajectory`], [`relay`]: square roots, sensors on a script, a recorded run, a run in two halves.
//! - `own`: laws of a user's project.
//! - [`mod@hash`], `laws`: hashes of shipped models, and of scenes with laws.
//! - [`board`]: the hardware.
//! - [`chart`], [`sample`], `elements`: which models and schemes are counted.
//! - `cost`, `guards`: instructions and memory of a step, on the target only.
//! - [`controllers`], [`wiring`], [`closed_loop`], [`hil`]: controllers in a loop with a plant here or outside.
#![cfg_attr(target_os = "none", no_std)]

// First, for its macros.
#[macro_use]
pub mod models;

pub mod alone;
pub mod board;
pub mod chart;
pub mod closed_loop;
pub mod console;
pub mod controllers;
#[cfg(feature = "elements")]
pub mod elements;
pub mod hash;
pub mod hil;
#[cfg(feature = "laws")]
pub mod laws;
#[cfg(feature = "laws")]
pub mod own;
pub mod relay;
pub mod root;
pub mod sample;
pub mod sensors;
pub mod trajectory;
pub mod wiring;

#[cfg(target_os = "none")]
pub mod cost;
#[cfg(target_os = "none")]
pub mod guards;

/// The README's programs compile: the model that they include is one of [`models`].
#[cfg(doctest)]
#[doc = include_str!("../../../README.md")]
pub mod readme {}

/// The page on controllers compiles and does what it says.
#[cfg(doctest)]
#[doc = include_str!("../../../docs/controllers.md")]
pub mod controllers_page {}
