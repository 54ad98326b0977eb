//! Runs Discrete Body Dynamics scenes on a PC: the command line `host-sim` and what it is made of.
//!
//! `scene → model → step → trace → report`. The modules in the order in which a run uses them:
//!
//! - [`cli`], [`console`], [`error`], [`progress`]: arguments in, text and exit code out.
//! - [`catalogue`], [`list`], [`check`]: scenes before they run.
//! - [`time`], [`method`], [`frequencies`], [`plan`]: what is to be run, in whole numbers.
//! - [`run`], [`simulate`]: the run; [`failure`]: where one failed and which step works.
//! - [`stability`] about a [`frozen`] pose, [`stability_check`]: the largest stable step.
//! - [`mod@reference`]: the same equations in plain std Rust, what runs are held against.
//! - [`trade`], [`costs`]: every way of stepping a scene, its accuracy and its cost.
//! - [`numerals`], [`trace`], [`statistics`], [`summary`], [`curves`], [`plot`], [`report`],
//!   [`output`]: what is left of it.
//! - [`costs`]: what a step costs on the target.

pub mod catalogue;
pub mod check;
pub mod cli;
pub mod console;
pub mod costs;
pub mod curves;
pub mod error;
pub mod failure;
mod fitting;
pub mod frequencies;
pub mod frozen;
mod judge;
pub mod list;
pub mod method;
pub mod numerals;
pub mod output;
pub mod plan;
pub mod plot;
pub mod progress;
pub mod reference;
pub mod report;
pub mod run;
mod sensors;
pub mod simulate;
pub mod stability;
pub mod stability_check;
pub mod statistics;
pub mod summary;
pub mod time;
pub mod trace;
pub mod trade;
