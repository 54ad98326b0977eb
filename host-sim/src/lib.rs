//! Runs Discrete Body Dynamics scenes on a PC: the command line `host-sim` and what it is made of.
//!
//! `scene → model → step → trace → report`. What steps is `dbd-plant`. The modules in the order in
//! which they stand on each other, each on those before it alone:
//!
//! - [`terminal`]: scenes by name, text out, exit codes.
//! - [`simulate`]: a planned run, sample by sample; where one failed and which step works.
//! - [`compliance`]: how far joints give way under the forces at t = 0.
//! - [`report`]: what is left of a run: trace, summary, page.
//! - [`recorded`]: runs that were recorded, read back.
//! - [`comparison`]: two of them beside each other.
//! - [`help`]: the examples in the help of each command.
//! - [`arguments`]: what several commands take.
//! - [`commands`]: `list`, `check`, `run`, `compare`, `sweep`, `trade`, `reproduce`, `export`, `fmu`, `hil`, `import`, `new`, `completions`.
//! - [`error`]: what ends a command early.
//! - [`cli`]: arguments in, exit code out.
//! - [`program`]: the command line as a program of a user's own, with laws of their own.
//!
//! The feature `comparison` brings methods that are there for comparison only, see `dbd-plant`; `lanes` steps
//! alike cases of a sweep in lockstep; `parquet` writes the table of a sweep as a Parquet file, too.

pub mod arguments;
pub mod cli;
pub mod commands;
pub mod comparison;
pub mod compliance;
pub mod error;
pub mod help;
pub mod program;
pub mod recorded;
pub mod report;
pub mod simulate;
pub mod terminal;

pub use program::Program;
