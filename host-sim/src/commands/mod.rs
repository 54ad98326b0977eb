//! The commands, each as a function without a terminal.
//!
//! - [`list`]: the scenes that ship.
//! - [`rounding`]: what precisions lose. [`warnings`]: what is probably not meant, in one place for all.
//! - [`assembled`], [`stability`], [`derived`], [`planar`], [`check`]: what a scene is, without running it.
//! - [`picture`]: the mechanism as an SVG. [`mod@write`]: a scene in its long form.
//! - [`watch`]: a file is looked at again each time it has changed.
//! - [`folder`]: where results go.
//! - [`golden`]: a run beside a golden file.
//! - [`modes`]: how a scene vibrates about its pose at t = 0.
//! - [`mod@relax`]: where a scene rests under its loads.
//! - [`mode_table`]: the modes of a scene as a table, a page and matrices.
//! - [`surveyed`]: a survey that lies beside a run's results.
//! - [`run`]: a scene becomes a trace, a summary and a report.
//! - [`sweep`]: many values of a scene, a row per case.
//! - [`compare`]: two recorded runs in one report.
//! - [`trade`]: speed against accuracy. [`advise`]: one way for a microcontroller.
//! - [`mod@reproduce`]: the results of the method's paper, measured again.
//! - [`export`]: Rust source of a scene's const model and its plant.
//! - [`mod@fmu`]: a scene becomes an FMU for other tools.
//! - [`mod@linearise`]: a scene as a linear system.
//! - [`hil`]: one end of a line to a microcontroller.
//! - [`play`]: a page in which scenes run live.
//! - [`mod@import`]: another program's file becomes a scene.
//! - [`schema`]: what a scene file may hold, for editors.
//! - [`new`]: a project with a plant in firmware, a scene to begin with.
//! - [`completions`]: a script for a shell.

pub mod advise;
pub mod assembled;
pub mod check;
pub mod compare;
pub mod completions;
pub mod derived;
pub mod export;
pub mod fmu;
pub mod folder;
pub mod golden;
pub mod hil;
pub mod import;
pub mod linearise;
pub mod list;
pub mod mode_table;
pub mod modes;
pub mod new;
pub mod picture;
pub mod planar;
pub mod play;
pub mod relax;
pub mod reproduce;
pub mod rounding;
pub mod run;
pub mod schema;
pub mod stability;
pub mod surveyed;
pub mod sweep;
pub mod trade;
pub mod warnings;
pub mod watch;
pub mod write;
