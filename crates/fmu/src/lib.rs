#![doc = include_str!("../README.md")]
//!
//! # Modules
//!
//! Each uses only those before it:
//!
//! - [`names`]: names of variables as FMI's structured naming writes them.
//! - [`units`]: SI units in terms of base units.
//! - [`location`]: where resources lie, from what importers say.
//! - [`resource`]: what lies in an FMU's `resources/`.
//! - [`description`]: the variables of an FMU, and what they are.
//! - [`xml`]: the model description.
//! - [`token`]: the key between a model description and the resources beside it.
//! - [`page`]: the page of an FMU's `documentation/`.
//! - [`archive`](mod@archive): the FMU as a file.
//! - [`component`]: an instance as FMI sees it.
//! - `derivative`: derivatives of its outputs with respect to its inputs.
//! - `saved`: its state as bytes.
//! - [`foreign`]: what a caller in C hands over.
//! - [`calls`]: components by their handles, and what happens around each call.
//! - `states`: states by their handles.
//! - `exported`: the shape of a function that C calls.
//! - [`fmi2`], [`fmi3`], [`fmi3_absent`]: the functions of the standards.

pub mod archive;
pub mod calls;
pub mod component;
mod derivative;
pub mod description;
mod exported;
pub mod fmi2;
pub mod fmi3;
pub mod fmi3_absent;
pub mod foreign;
pub mod location;
pub mod names;
pub mod page;
pub mod resource;
mod saved;
mod states;
pub mod token;
pub mod units;
pub mod xml;

pub use dbd_scene::laws;

pub use archive::{ArchiveError, Fmu, LIBRARY, Library, archive};
pub use xml::Fmi;
