//! What a user meets around the commands.
//!
//! - [`exit`]: the code a command ends with.
//! - [`look`]: whether what goes somewhere is coloured, and how wide.
//! - [`text`]: JSON, rows and columns.
//! - [`console`], [`progress`]: where text goes, how errors look, what shows that a run goes on.
//! - [`interrupt`]: nothing half-written is left where a program is told to end.
//! - [`catalogue`]: the way from what a user names to a scene.

pub mod catalogue;
pub mod console;
pub mod exit;
pub mod interrupt;
pub mod look;
pub mod progress;
pub mod text;

pub use catalogue::{Catalogue, Found, LoadError, SceneFile};
pub use console::Console;
pub use exit::Exit;
pub use look::Look;
pub use progress::Progress;
