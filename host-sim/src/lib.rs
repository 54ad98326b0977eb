//! Runs Discrete Body Dynamics scenes on a PC: the command line `host-sim` and its parts.
//!
//! `scene → model → step → trace → report`. `dbd-plant` does the stepping. The modules in
//! dependency order, each depending only on those before it:
//!
//! - [`terminal`]: scenes by name, text out, exit codes.
//! - [`simulate`]: a planned run, sample by sample.
//! - [`report`]: the results of a run: trace, summary, page.
//! - [`recorded`]: recorded runs, read back.
//! - [`comparison`]: comparison of two of them.
//! - [`help`]: the examples in the help of each command.
//! - [`arguments`]: arguments shared by several commands.
//! - [`commands`]: `list`, `check`, `run`, `compare`, `report`, `sweep`, `trade`, `reproduce`, `export`, `fmu`, `hil`, `import`, `new`, `completions`, `manual`.
//! - [`error`]: errors of commands.
//! - [`cli`]: arguments in, exit code out.
//! - [`program`]: the command line as a custom program with custom laws.
//!
//! The feature `comparison` adds methods for comparison only, see `dbd-plant`; `lanes` steps
//! similar cases of a sweep in lockstep; `parquet` also writes the table of a sweep as a Parquet file.

pub mod arguments;
pub mod cli;
pub mod commands;
pub mod comparison;
pub mod error;
pub mod help;
pub mod program;
pub mod recorded;
pub mod report;
pub mod simulate;
pub mod terminal;

pub use program::Program;
