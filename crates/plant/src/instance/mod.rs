//! A scene of Discrete Body Dynamics as a component of another tool: its inputs, outputs and parameters have names and
//! units, its state is bytes, its time is absolute. The FMU and the Python package use it.
//!
//! ```
//! use dbd_plant::instance::{Blueprint, Instance, Settings};
//!
//! let text = r#"
//! name = "spring"
//! duration = 1.0
//! step = "1 ms"
//! gravity = [0, -9.81, 0]
//! [[body]]
//! name = "weight"
//! mass = 2.0
//! inertia = [0.01, 0.01, 0.01]
//! position = [0, -1.0, 0]
//! [[tsda]]
//! between = ["world", "weight"]
//! points = [[0, 0, 0], [0, 0, 0]]
//! stiffness = 200.0
//! free_length = 0.9
//! [[input]]
//! name = "push"
//! type = "force"
//! body = "weight"
//! axis = [0, 1, 0]
//! "#;
//! let mut spring = Instance::new(Blueprint::new("spring.toml", text), Settings::default())?;
//! spring.set_parameters([("body.weight.mass", 3.0)])?;
//! spring.set_input(spring.input("push")?, 5.0)?;
//! spring.advance_to(0.25)?;
//! let height = spring.output("weight.y")?;
//! assert_eq!(spring.outputs()[height].unit, "m");
//!
//! let state = spring.save()?;
//! spring.advance_to(1.0)?;
//! let end = (spring.value(height), spring.hash());
//! let mut other = Instance::new(Blueprint::new("spring.toml", text), Settings::default())?;
//! other.restore(&state)?; // inputs and parameters, too
//! other.advance_to(1.0)?;
//! assert_eq!((other.value(height), other.hash()), end);
//! # Ok::<(), Box<dyn std::error::Error>>(())
//! ```
//!
//! A run has the bits of `host-sim run` with the same scheme, precision and step.
//!
//! # Modules
//!
//! Each uses only those above it:
//!
//! - `error`: errors, with the messages that all tools show.
//! - [`settings`]: scheme, precision and step by name.
//! - [`blueprint`]: the scene that instances are made from.
//! - [`variables`]: inputs and outputs, their names and units.
//! - `running`: a plant with its inputs and outputs.
//! - `saved`: its state as bytes.
//! - [`linearisation`]: response to small changes of state and inputs.
//! - [`spectrum`]: eigenvalues of a matrix and the subspace of its slowest motions.
//! - [`linear`]: the plant as a linear system.
//! - `inverse`: static equilibrium and inverse dynamics.
//! - `lockstep`: similar instances together, one per SIMD lane, with the feature `lanes`.

pub mod blueprint;
mod error;
mod inverse;
pub mod linear;
pub mod linearisation;
#[cfg(feature = "lanes")]
pub mod lockstep;
mod running;
mod saved;
pub mod settings;
pub mod spectrum;
pub mod variables;

pub use blueprint::Blueprint;
pub use dbd_scene::parameters::SceneNumber;
pub use error::InstanceError;
pub use linear::{Linear, LinearOptions};
pub use running::{Instance, NEAR};
pub use settings::Settings;
pub use variables::{Input, Output};
