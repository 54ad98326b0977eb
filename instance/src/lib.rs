#![doc = include_str!("../README.md")]
//!
//! # Modules
//!
//! Each uses only those before it:
//!
//! - `error`: what can go wrong, in words that every tool shows.
//! - [`settings`]: scheme, precision and step by name.
//! - [`blueprint`]: the scene that instances are made from.
//! - [`variables`]: inputs and outputs, their names and units.
//! - [`instance`]: a plant, what it is given and what it shows.
//! - `saved`: its state as bytes.

pub mod blueprint;
mod error;
pub mod instance;
mod saved;
pub mod settings;
pub mod variables;

pub use blueprint::Blueprint;
pub use dbd_scene::parameters::SceneNumber;
pub use error::InstanceError;
pub use instance::Instance;
pub use settings::Settings;
pub use variables::{Input, Output};
