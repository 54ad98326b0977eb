//! What ends a command early, and the exit code it ends with.

use std::fmt;
use std::io;
use std::path::PathBuf;
use std::process::ExitCode;

use dbd_scene::{SceneError, UnfitInput};
use miette::{Diagnostic, LabeledSpan, SourceCode};
use thiserror::Error;

use crate::catalogue::UnknownScene;
use crate::method::MethodError;
use crate::plan::PlanError;
use crate::reference::truth::NoTruth;
use crate::time::display;
use crate::trade::survey::WindowError;

/// How a command ended.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Exit {
    /// 0: done.
    Done = 0,
    /// 1: the run failed.
    Failed = 1,
    /// 2: bad input.
    Refused = 2,
}

impl From<Exit> for ExitCode {
    fn from(exit: Exit) -> Self {
        ExitCode::from(exit as u8)
    }
}

/// Why a command could not do its work.
#[derive(Debug, Error)]
pub enum Error {
    /// There is no such scene.
    #[error(transparent)]
    Unknown(#[from] UnknownScene),
    /// The scene is refused.
    #[error(transparent)]
    Scene(#[from] SceneError),
    /// The method is none.
    #[error(transparent)]
    Method(#[from] MethodError),
    /// The step does not fit.
    #[error(transparent)]
    Plan(#[from] PlanError),
    /// The precision cannot hold what an input is given.
    #[error(transparent)]
    Input(#[from] UnfitInput),
    /// There is no truth to compare with.
    #[error(transparent)]
    NoTruth(#[from] NoTruth),
    /// The window of a survey is none.
    #[error(transparent)]
    Window(#[from] WindowError),
    /// Another survey of the same keeps its results in the folder.
    #[error("another survey of this scene writes to {}", folder.display())]
    Busy {
        /// The folder.
        folder: PathBuf,
    },
    /// The step is zero or infinite once rounded.
    #[error("a step of {} is {rounded} in {precision}", display(*step))]
    Step {
        /// \[s\] the step.
        step: f64,
        /// \[s\] what it is rounded to.
        rounded: f64,
        /// The precision's name.
        precision: &'static str,
    },
    /// The folder for the results cannot be made.
    #[error("cannot write to {}: {reason}", folder.display())]
    Folder {
        /// The folder.
        folder: PathBuf,
        /// Why.
        reason: io::Error,
    },
    /// Results cannot be written.
    #[error("cannot write the results: {0}")]
    Write(io::Error),
}

impl Error {
    /// The exit code's meaning.
    #[must_use]
    pub fn exit(&self) -> Exit {
        match self {
            Self::Write(_) | Self::NoTruth(_) | Self::Busy { .. } => Exit::Failed,
            _ => Exit::Refused,
        }
    }

    fn inner(&self) -> Option<&dyn Diagnostic> {
        match self {
            Self::Unknown(error) => Some(error),
            Self::Scene(error) => Some(error),
            Self::Method(error) => Some(error),
            Self::Plan(error) => Some(error),
            Self::NoTruth(error) => Some(error),
            Self::Window(error) => Some(error),
            Self::Input(_)
            | Self::Step { .. }
            | Self::Folder { .. }
            | Self::Write(_)
            | Self::Busy { .. } => None,
        }
    }
}

// Not derived: the derive's calls would meet `SceneError::help`, which is a method of its own.
impl Diagnostic for Error {
    fn help<'a>(&'a self) -> Option<Box<dyn fmt::Display + 'a>> {
        match self {
            Self::Step { .. } => Some(Box::new("a longer step, or --precision f64")),
            Self::Input(_) => {
                Some(Box::new("smaller values, gentler rises, a later begin, or --precision f64"))
            }
            Self::Busy { .. } => {
                Some(Box::new("wait until it is done, or name another folder with --out DIR"))
            }
            Self::Folder { reason, .. } if reason.kind() == io::ErrorKind::InvalidInput => {
                Some(Box::new("results lie in a folder of the scene's name: change its `name`"))
            }
            Self::Folder { .. } => Some(Box::new("name another folder with --out DIR")),
            _ => self.inner()?.help(),
        }
    }

    fn source_code(&self) -> Option<&dyn SourceCode> {
        self.inner()?.source_code()
    }

    fn labels(&self) -> Option<Box<dyn Iterator<Item = LabeledSpan> + '_>> {
        self.inner()?.labels()
    }
}
