//! What a step reports. A failure latches: no later step runs and nothing resets itself.

use crate::index::{BodyIndex, LawIndex, TorsionIndex};

/// The status of a plant after a step.
#[must_use = "a failed step leaves the plant where it failed"]
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
#[cfg_attr(all(feature = "defmt", target_os = "none"), derive(defmt::Format))]
pub enum Status {
    /// All is well.
    #[default]
    Running,
    /// The plant failed and stays where it failed.
    Failed(Failure),
}

/// Why and where a plant failed.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
#[cfg_attr(all(feature = "defmt", target_os = "none"), derive(defmt::Format))]
pub struct Failure {
    /// What went wrong, and with which body or element.
    pub cause: Cause,
    /// The step that failed, counted from 1.
    pub step: u64,
}

/// What went wrong, and with which body or element.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
#[cfg_attr(all(feature = "defmt", target_os = "none"), derive(defmt::Format))]
pub enum Cause {
    /// A number of this body's state is infinite or not a number.
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
    /// What this law does is undefined at the pose.
    Undefined {
        /// The first such row.
        law: LawIndex,
    },
    /// This body turns by more than [`MOST_TURN`] in a step.
    Spin {
        /// The first such body.
        body: BodyIndex,
    },
    /// This body turns farther in a step than the scheme bears:
    /// [`Scheme::MOST_TURN`](crate::Scheme::MOST_TURN), less than [`MOST_TURN`].
    Turn {
        /// The first such body.
        body: BodyIndex,
    },
    /// This body is farther from the origin, or moved farther in a step, than fixed-point numbers hold.
    Extent {
        /// The first such body.
        body: BodyIndex,
    },
    /// The turn count of this torsion spring is at its end: 2³¹ turns.
    Turns {
        /// The first such spring.
        spring: TorsionIndex,
    },
    /// The step counter is at its end: 2⁶⁴ − 1 steps. The state is left as it was.
    Steps,
    /// The matrix of an implicit scheme is not positive definite at this body: a number is beyond what
    /// the precision holds.
    Pivot {
        /// The first such body.
        body: BodyIndex,
    },
    /// What is mounted to this body can vibrate faster than the step bears; see
    /// [`crate::watch::Watch`].
    Frequency {
        /// The body.
        body: BodyIndex,
    },
    /// The energy is beyond what was allowed; see [`crate::watch::Watch`].
    Energy {
        /// The body with the most kinetic energy.
        body: BodyIndex,
    },
}

/// \[rad\] what a body may turn in a step: the polynomials of a turn lose digits from 0.3 on, and
/// forces that turn with the body are sampled too rarely long before.
pub const MOST_TURN: f64 = 1.0;

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
            Cause::Undefined { law } => write!(f, "law {} is undefined here", law.0)?,
            Cause::Spin { body } => {
                write!(f, "body {} turns by more than {MOST_TURN} rad in a step", body.0)?;
            }
            Cause::Turn { body } => {
                write!(f, "body {} turns farther in a step than the scheme bears", body.0)?;
            }
            Cause::Extent { body } => {
                write!(f, "body {} is farther away than fixed-point numbers hold", body.0)?;
            }
            Cause::Turns { spring } => {
                write!(f, "the turn count of torsion spring {} is at its end", spring.0)?;
            }
            Cause::Steps => write!(f, "the step counter is at its end")?,
            Cause::Pivot { body } => {
                write!(f, "the matrix of the step has no factor at body {}", body.0)?;
            }
            Cause::Frequency { body } => {
                write!(f, "the mounts of body {} can vibrate too fast for the step", body.0)?;
            }
            Cause::Energy { body } => {
                write!(f, "the energy is beyond its limit, most of it in body {},", body.0)?;
            }
        }
        write!(f, " after step {}", self.step)
    }
}

impl core::error::Error for Failure {}
