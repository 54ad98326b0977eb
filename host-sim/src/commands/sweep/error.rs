//! Why a sweep was refused or did not complete.

use std::io;
use std::path::PathBuf;

use dbd_study::sweep::refusal::{Refusal, SpecError};
use miette::Diagnostic;
use thiserror::Error;

use crate::commands::folder::FolderError;
use crate::commands::run::RunError;
use crate::terminal::LoadError;

/// Why no table was written.
#[derive(Debug, Error, Diagnostic)]
pub enum SweepError {
    /// Its file, or something in it.
    #[error(transparent)]
    #[diagnostic(transparent)]
    Spec(#[from] SpecError),
    /// Its scene cannot be loaded.
    #[error(transparent)]
    #[diagnostic(transparent)]
    Load(#[from] LoadError),
    /// There is no folder for the results, or it holds those of another sweep.
    #[error(transparent)]
    #[diagnostic(transparent)]
    Folder(#[from] FolderError),
    /// Another program runs these cases.
    #[error("another sweep runs these cases: {} is in use", file.display())]
    #[diagnostic(help(
        "wait for it, or run several programs with one shard each: --shard 1/2, --shard 2/2"
    ))]
    Busy {
        /// Its file of finished cases.
        file: PathBuf,
    },
    /// Cases are missing.
    #[error("{missing} of {cases} cases are not finished: {named}")]
    #[diagnostic(help(
        "run them with the same command without --merge, or with that of their shard; --merge --partial makes a \
         table without them"
    ))]
    Incomplete {
        /// How many.
        missing: usize,
        /// How many there are.
        cases: usize,
        /// Some of them.
        named: String,
    },
    /// The results of a case cannot be written.
    #[error(transparent)]
    #[diagnostic(transparent)]
    Report(#[from] RunError),
    /// Results cannot be written.
    #[error("cannot write the results: {0}")]
    Write(io::Error),
}

impl From<Box<Refusal>> for SweepError {
    fn from(refusal: Box<Refusal>) -> Self {
        Self::Spec(refusal.into())
    }
}
