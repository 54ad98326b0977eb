//! What a user meets around the commands.
//!
//! - [`exit`]: the code a command ends with.
//! - [`text`]: JSON, rows and columns.
//! - [`console`], [`progress`]: where text goes, how errors look, what shows that a run goes on.
//! - [`catalogue`]: the way from what a user names to a scene.

pub mod catalogue;
pub mod console;
pub mod exit;
pub mod progress;
pub mod text;

pub use catalogue::{Catalogue, LoadError};
pub use console::Console;
pub use exit::Exit;
pub use progress::Progress;
