//! The commands, each as a function without a terminal.
//!
//! - [`list`]: the named scenes.
//! - [`rounding`]: rounding errors. [`warnings`]: all warnings.
//! - [`assembled`], [`stability`], [`derived`], [`planar`], [`check`]: properties of a scene, without running it.
//! - [`picture`]: the mechanism as an SVG. [`mod@write`]: a scene in its long form.
//! - [`watch`]: a file is checked again after each change.
//! - [`folder`]: the folder of results.
//! - [`golden`]: a run compared with a golden file.
//! - [`modes`]: the vibration modes of a scene about its pose at t = 0.
//! - [`mod@relax`]: the static equilibrium of a scene under its loads.
//! - [`mode_table`]: the modes of a scene as a table, a page and matrices.
//! - [`surveyed`]: a trade-off study in the folder of a run's results.
//! - [`run`]: a scene becomes a trace, a summary and a report.
//! - [`sweep`]: many values of a scene, a row per case.
//! - [`compare`]: two recorded runs in one report.
//! - [`report`]: a recorded run as a page.
//! - [`trade`]: speed against accuracy. [`advise`]: a method for a microcontroller.
//! - [`mod@reproduce`]: the reproduced results of the method's paper.
//! - [`mod@replace`]: files that a command may replace.
//! - [`export`]: a scene as Rust source of its const model and plant, as URDF, as a library for C.
//! - [`mod@fmu`]: a scene becomes an FMU for other tools.
//! - [`mod@linearise`]: a scene as a linear system.
//! - [`hil`]: one end of a line to a microcontroller.
//! - [`play`]: a page with live scenes.
//! - [`mod@import`]: another program's file becomes a scene.
//! - [`schema`]: the JSON Schema of scene files, for editors.
//! - [`new`]: new firmware projects, crates of laws and scenes.
//! - [`completions`]: a script for a shell. [`manual`]: pages for `man`.

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
pub mod manual;
pub mod mode_table;
pub mod modes;
pub mod new;
pub mod picture;
pub mod planar;
pub mod play;
pub mod relax;
pub mod replace;
pub mod report;
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
