//! What a step reports. A failure latches: no later step runs and nothing resets itself.

use crate::index::{BodyIndex, TorsionIndex};

/// The status of a plant after a step.
#[must_use = "a failed step leaves the plant where it failed"]
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
#[cfg_attr(feature = "defmt", derive(defmt::Format))]
pub enum Status {
    /// All is well.
    #[default]
    Running,
    /// The plant failed and stays where it failed.
    Failed(Failure),
}

/// Why and where a plant failed.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
#[cfg_attr(feature = "defmt", derive(defmt::Format))]
pub struct Failure {
    /// What went wrong, and with which body or element.
    pub cause: Cause,
    /// The step that failed, counted from 1.
    pub step: u64,
}

/// What went wrong, and with which body or element.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
#[cfg_attr(feature = "defmt", derive(defmt::Format))]
pub enum Cause {
    /// A velocity of this body is infinite or not a number.
    NonFinite {
        /// The first such body.
        body: BodyIndex,
    },
    /// The twist of this torsion spring is undefined: its bodies turned by half a turn about an
    /// axis normal to the spring's.
    UndefinedTwist {
        /// The first such spring.
        spring: TorsionIndex,
    },
}

impl Status {
    /// Whether the plant has not failed.
    #[must_use]
    pub const fn is_running(self) -> bool {
        matches!(self, Status::Running)
    }

    /// The status as a result.
    ///
    /// # Errors
    /// The failure, where there is one.
    pub const fn ok(self) -> Result<(), Failure> {
        match self {
            Status::Running => Ok(()),
            Status::Failed(failure) => Err(failure),
        }
    }
}

impl core::fmt::Display for Failure {
    fn fmt(&self, f: &mut core::fmt::Formatter<'_>) -> core::fmt::Result {
        match self.cause {
            Cause::NonFinite { body } => write!(f, "body {} is not finite", body.0)?,
            Cause::UndefinedTwist { spring } => {
                write!(f, "the twist of torsion spring {} is undefined", spring.0)?;
            }
        }
        write!(f, " after step {}", self.step)
    }
}

impl core::error::Error for Failure {}
