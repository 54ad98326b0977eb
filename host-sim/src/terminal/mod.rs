//! The user interface around the commands.
//!
//! - [`exit`]: the code a command ends with.
//! - [`look`]: colours and width of text output.
//! - [`text`]: JSON, rows and columns.
//! - [`console`], [`progress`]: output streams, format of errors, progress.
//! - [`interrupt`]: removal of incomplete files on termination.
//! - [`catalogue`]: finding scenes by name or path.

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
