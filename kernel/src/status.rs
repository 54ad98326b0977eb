//! Failures of steps. A failure latches: no later step runs until the failure is cleared explicitly.

use crate::index::{BodyIndex, LawIndex, TorsionIndex};

/// Why and where a plant failed.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
#[cfg_attr(all(feature = "defmt", target_os = "none"), derive(defmt::Format))]
pub struct Failure {
    /// The cause, with its body or element.
    pub cause: Cause,
    /// The step that failed, counted from 1.
    pub step: u64,
}

/// The cause of a failure, with its body or element.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
#[cfg_attr(all(feature = "defmt", target_os = "none"), derive(defmt::Format))]
#[non_exhaustive]
pub enum Cause {
    /// A number of this body's state is infinite or not a number.
    NonFinite {
        /// The first such body.
        body: BodyIndex,
    },
    /// The torsion angle of this torsion spring is undefined: its bodies rotated by half a revolution about an axis
    /// normal to the spring's.
    UndefinedTorsionAngle {
        /// The first such spring.
        spring: TorsionIndex,
    },
    /// This law is undefined at the pose.
    Undefined {
        /// The first such row.
        law: LawIndex,
    },
    /// This body rotates by more than [`MAX_TURN`] in a step.
    Spin {
        /// The first such body.
        body: BodyIndex,
    },
    /// This body rotates farther in a step than the scheme allows: [`Scheme::MAX_TURN`](crate::Scheme::MAX_TURN),
    /// less than [`MAX_TURN`].
    Turn {
        /// The first such body.
        body: BodyIndex,
    },
    /// This body's position, or its motion in a step, is out of the fixed-point range.
    Extent {
        /// The first such body.
        body: BodyIndex,
    },
    /// The revolution count of this torsion spring has reached its maximum: 2³¹ revolutions.
    Turns {
        /// The first such spring.
        spring: TorsionIndex,
    },
    /// The step counter has reached its maximum: 2⁶⁴ − 1 steps. The state is unchanged.
    Steps,
    /// The matrix of an implicit scheme is not positive definite at this body: a number is out of the precision's
    /// range.
    Pivot {
        /// The first such body.
        body: BodyIndex,
    },
    /// The natural frequency of this body's mounts is too high for the step; see [`crate::watch::Watch`].
    Frequency {
        /// The body.
        body: BodyIndex,
    },
    /// The energy exceeds its limit; see [`crate::watch::Watch`].
    Energy {
        /// The body with the most kinetic energy.
        body: BodyIndex,
    },
}

/// \[rad\] the largest rotation of a body in a step: the rotation polynomials lose digits from 0.3 on, and forces that
/// rotate with the body are undersampled well before that.
pub const MAX_TURN: f64 = 1.0;

impl core::fmt::Display for Failure {
    fn fmt(&self, f: &mut core::fmt::Formatter<'_>) -> core::fmt::Result {
        match self.cause {
            Cause::NonFinite { body } => write!(f, "the state of body {} is not finite", body.0)?,
            Cause::UndefinedTorsionAngle { spring } => {
                write!(f, "the torsion angle of torsion spring {} is undefined", spring.0)?;
            }
            Cause::Undefined { law } => write!(f, "law {} is undefined at this pose", law.0)?,
            Cause::Spin { body } => {
                write!(f, "body {} rotates by more than {MAX_TURN} rad in a step", body.0)?;
            }
            Cause::Turn { body } => {
                write!(f, "body {} rotates farther in a step than the scheme allows", body.0)?;
            }
            Cause::Extent { body } => {
                write!(f, "the position of body {} exceeds the fixed-point range", body.0)?;
            }
            Cause::Turns { spring } => {
                write!(
                    f,
                    "the revolution count of torsion spring {} has reached its maximum",
                    spring.0
                )?;
            }
            Cause::Steps => write!(f, "the step counter has reached its maximum")?,
            Cause::Pivot { body } => {
                write!(f, "the iteration matrix is not positive definite (body {})", body.0)?;
            }
            Cause::Frequency { body } => {
                write!(
                    f,
                    "the natural frequency at the joints of body {} is too high for the step",
                    body.0
                )?;
            }
            Cause::Energy { body } => {
                write!(f, "the energy exceeds its limit, with most of it in body {},", body.0)?;
            }
        }
        write!(f, " after step {}", self.step)
    }
}

impl core::error::Error for Failure {}
