//! Why there are no modes, and what their differences are made with.

use dbd_kernel::status::Cause;
use miette::Diagnostic;
use thiserror::Error;

/// Bodies at most: time grows with the cube of their number, to some seconds at this one.
pub const MOST_BODIES: usize = 200;

/// \[m, rad\] of the differences, which are of fourth order: what they leave out is of the order of
/// 1e-20 m⁴ over a spring's length to the fourth power, rounding of 1e-16 m over this.
pub(super) const PROBE: f64 = 1e-5;

/// Weights of the differences at 1 and 2 probes.
pub(super) const WEIGHTS: [f64; 2] = [8.0 / 12.0, -1.0 / 12.0];

/// Why there are no modes.
#[derive(Clone, Copy, Debug, PartialEq, Error, Diagnostic)]
pub enum ModesError {
    /// Too many bodies.
    #[error(
        "the modes of {bodies} bodies would take too long; those of {MOST_BODIES} are the most"
    )]
    #[diagnostic(help("`host-sim modes` finds the lowest and the highest modes of larger scenes"))]
    TooMany {
        /// How many there are.
        bodies: usize,
    },
    /// The forces near the pose are undefined, as a torsion spring's are without a twist.
    #[error("there are no modes about this pose: a twist is undefined ({0:?})")]
    #[diagnostic(help("another pose: one in which every torsion spring has a twist"))]
    Pose(Cause),
    /// A law has a freedom of its own.
    #[error("a rotor of the law `{law}` moves beside the bodies, whose modes these would be")]
    #[diagnostic(help("a drive without a rotor, its inertia added to a body"))]
    Rotor {
        /// The law.
        law: &'static str,
    },
    /// A stiffness beyond the range of numbers.
    #[error(
        "there are no modes about this pose: its stiffness over its masses is beyond all numbers"
    )]
    #[diagnostic(help("smaller stiffnesses or larger masses and inertias"))]
    Range,
    /// The iteration does not converge.
    #[error("the iteration for the modes of many bodies does not converge")]
    #[diagnostic(help(
        "fewer modes, or the modes of a part of the mechanism as a scene of its own"
    ))]
    Slow,
}

impl From<Cause> for ModesError {
    fn from(cause: Cause) -> Self {
        Self::Pose(cause)
    }
}
