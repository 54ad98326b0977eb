#![doc = include_str!("../README.md")]
//!
//! # Modules
//!
//! Each uses only those before it:
//!
//! - [`names`]: names of variables in FMI's structured naming.
//! - [`units`]: SI units in terms of base units.
//! - [`location`]: the resource folder, from an importer's argument.
//! - [`resource`]: the contents of an FMU's `resources/`.
//! - [`description`]: the variables of an FMU and their roles.
//! - [`xml`]: the model description.
//! - [`token`]: the key that ties a model description to its resources.
//! - [`page`]: the page of an FMU's `documentation/`.
//! - [`archive`](mod@archive): the FMU as a file.
//! - [`component`]: an instance for FMI.
//! - `derivative`: derivatives of its outputs with respect to its inputs.
//! - `saved`: its state as bytes.
//! - [`foreign`]: arguments of a C caller.
//! - [`calls`]: components by handle, and the common part of each call.
//! - `states`: states by handle.
//! - `exported`: macros for functions called from C.
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
