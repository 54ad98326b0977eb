//! Errors of commands, and their exit codes.

use dbd_fmu::ArchiveError;
use dbd_plant::instance::InstanceError;
use dbd_plant::{MethodError, PlantError};
use dbd_scene::Restless;
use dbd_study::SurveyError;
use dbd_study::ideal::IdealError;
use dbd_study::modes::ModesError;
use dbd_study::recommend::AdviseError;
use miette::Diagnostic;
use thiserror::Error;

use crate::commands::advise::AskedError;
use crate::commands::compare::CompareRefusal;
use crate::commands::export::ExportError;
use crate::commands::fmu::FmuError;
use crate::commands::hil::HilError;
use crate::commands::import::ImportError;
use crate::commands::linearise::LineariseError;
use crate::commands::manual::ManualError;
use crate::commands::mode_table::ModeTableError;
use crate::commands::new::NewError;
use crate::commands::picture::PictureError;
use crate::commands::play::PlayError;
use crate::commands::relax::RelaxError;
use crate::commands::replace::ReplaceError;
use crate::commands::report::ReportError;
use crate::commands::reproduce::ReproduceError;
use crate::commands::run::RunError;
use crate::commands::sweep::error::SweepError;
use crate::commands::trade::TradeError;
use crate::commands::watch::WatchError;
use crate::commands::write::WriteError;
use crate::terminal::console::OutputError;
use crate::terminal::{Exit, LoadError};

/// Why a command failed.
#[derive(Debug, Error, Diagnostic)]
pub enum Error {
    /// The scene could not be loaded.
    #[error(transparent)]
    #[diagnostic(transparent)]
    Load(#[from] LoadError),
    /// The method is unknown, or not part of this build.
    #[error(transparent)]
    #[diagnostic(transparent)]
    Method(#[from] MethodError),
    /// The precision cannot represent an input's value.
    #[error(transparent)]
    #[diagnostic(transparent)]
    Plant(#[from] PlantError),
    /// A scene was not exported.
    #[error(transparent)]
    #[diagnostic(transparent)]
    Export(#[from] ExportError),
    /// No FMU was written.
    #[error(transparent)]
    #[diagnostic(transparent)]
    Fmu(#[from] FmuError),
    /// The scene was not linearised.
    #[error(transparent)]
    #[diagnostic(transparent)]
    Linearise(#[from] LineariseError),
    /// Hardware in the loop failed.
    #[error(transparent)]
    #[diagnostic(transparent)]
    Hil(#[from] HilError),
    /// No live page was written.
    #[error(transparent)]
    #[diagnostic(transparent)]
    Play(#[from] PlayError),
    /// Nothing was imported.
    #[error(transparent)]
    #[diagnostic(transparent)]
    Import(#[from] ImportError),
    /// No picture was written.
    #[error(transparent)]
    #[diagnostic(transparent)]
    Picture(#[from] PictureError),
    /// No new project or scene was written.
    #[error(transparent)]
    #[diagnostic(transparent)]
    New(#[from] NewError),
    /// A scene's long form was not written.
    #[error(transparent)]
    #[diagnostic(transparent)]
    LongForm(#[from] WriteError),
    /// The modes were not computed or not written.
    #[error(transparent)]
    #[diagnostic(transparent)]
    ModeTable(#[from] ModeTableError),
    /// A scene was not settled.
    #[error(transparent)]
    #[diagnostic(transparent)]
    Relax(#[from] RelaxError),
    /// A scene cannot be watched.
    #[error(transparent)]
    #[diagnostic(transparent)]
    Watch(#[from] WatchError),
    /// A run was refused, or its results could not be written.
    #[error(transparent)]
    #[diagnostic(transparent)]
    Run(#[from] RunError),
    /// A trade-off study was refused, or its results could not be written.
    #[error(transparent)]
    #[diagnostic(transparent)]
    Trade(#[from] TradeError),
    /// Ideal joints are not reached.
    #[error(transparent)]
    #[diagnostic(transparent)]
    Ideal(#[from] IdealError),
    /// An argument of `advise` is invalid.
    #[error(transparent)]
    #[diagnostic(transparent)]
    Asked(#[from] AskedError),
    /// No recommendation was found.
    #[error(transparent)]
    #[diagnostic(transparent)]
    Advise(#[from] AdviseError),
    /// A recorded run has no page.
    #[error(transparent)]
    #[diagnostic(transparent)]
    Report(#[from] ReportError),
    /// The paper's results could not be reproduced or not be written.
    #[error(transparent)]
    #[diagnostic(transparent)]
    Reproduce(#[from] ReproduceError),
    /// A sweep was refused, or did not complete.
    #[error(transparent)]
    #[diagnostic(transparent)]
    Sweep(#[from] SweepError),
    /// Two runs were not compared.
    #[error(transparent)]
    #[diagnostic(transparent)]
    Compare(#[from] CompareRefusal),
    /// No manual pages were written.
    #[error(transparent)]
    #[diagnostic(transparent)]
    Manual(#[from] ManualError),
    /// A file is not replaced.
    #[error(transparent)]
    #[diagnostic(transparent)]
    File(#[from] ReplaceError),
    /// The results cannot be written to standard output.
    #[error(transparent)]
    #[diagnostic(transparent)]
    Output(#[from] OutputError),
}

impl Error {
    /// The exit code's meaning.
    #[must_use]
    pub fn exit(&self) -> Exit {
        match self {
            Self::Load(_) | Self::Method(_) | Self::Plant(_) => Exit::Refused,
            Self::File(ReplaceError::Write { .. })
            | Self::Fmu(FmuError::Write { .. } | FmuError::Archive(ArchiveError::Archive(_)))
            | Self::New(NewError::Write { .. })
            | Self::Picture(PictureError::Write { .. }) => Exit::Failed,
            Self::Export(_)
            | Self::File(_)
            | Self::Fmu(_)
            | Self::Import(_)
            | Self::New(_)
            | Self::Picture(_) => Exit::Refused,
            Self::Linearise(
                LineariseError::File(ReplaceError::Write { .. })
                | LineariseError::Instance(InstanceError::Failed { .. }),
            ) => Exit::Failed,
            Self::Linearise(_) => Exit::Refused,
            Self::Hil(error) if error.is_refusal() => Exit::Refused,
            Self::Hil(_) => Exit::Failed,
            Self::Play(PlayError::Write { .. } | PlayError::Serve { .. }) => Exit::Failed,
            Self::Play(_) => Exit::Refused,
            Self::LongForm(WriteError::Write { .. } | WriteError::Differs)
            | Self::Relax(RelaxError::Write(WriteError::Write { .. } | WriteError::Differs)) => {
                Exit::Failed
            }
            Self::ModeTable(ModeTableError::Restless(Restless::TooMany { .. }))
            | Self::Relax(RelaxError::Restless(Restless::TooMany { .. })) => Exit::Refused,
            Self::ModeTable(
                ModeTableError::Restless(_)
                | ModeTableError::Modes(ModesError::Slow)
                | ModeTableError::Kick(_)
                | ModeTableError::Write(_),
            ) => Exit::Failed,
            Self::ModeTable(_) => Exit::Refused,
            Self::Relax(RelaxError::Restless(_)) => Exit::Failed,
            Self::Relax(_) => Exit::Refused,
            Self::LongForm(_) | Self::Watch(_) => Exit::Refused,
            Self::Output(_) | Self::Manual(_) => Exit::Failed,
            // 1 means that the runs differ.
            Self::Compare(_) => Exit::Refused,
            Self::Run(error) => match error {
                RunError::Plan(_)
                | RunError::Setting(_)
                | RunError::Plant(_)
                | RunError::Golden(_)
                | RunError::Modes(_)
                | RunError::Folder(_) => Exit::Refused,
                RunError::Write(_) => Exit::Failed,
            },
            Self::Sweep(error) => match error {
                SweepError::Spec(_) | SweepError::Load(_) | SweepError::Folder(_) => Exit::Refused,
                SweepError::Report(RunError::Folder(_)) => Exit::Refused,
                SweepError::Busy { .. }
                | SweepError::Incomplete { .. }
                | SweepError::Report(_)
                | SweepError::Write(_) => Exit::Failed,
            },
            Self::Report(ReportError::Write { .. })
            | Self::Reproduce(ReproduceError::Write { .. }) => Exit::Failed,
            Self::Report(_) => Exit::Refused,
            Self::Reproduce(_) => Exit::Refused,
            Self::Ideal(IdealError::NoJoint { .. }) | Self::Asked(_) => Exit::Refused,
            Self::Ideal(IdealError::NotReached { .. }) => Exit::Failed,
            Self::Advise(AdviseError::NoReferenceSolution(_) | AdviseError::None { .. }) => {
                Exit::Failed
            }
            Self::Advise(_) => Exit::Refused,
            Self::Trade(error) => match error {
                TradeError::Folder(_) | TradeError::Survey(SurveyError::Window(_)) => Exit::Refused,
                TradeError::Survey(_) | TradeError::Write(_) => Exit::Failed,
            },
        }
    }
}
