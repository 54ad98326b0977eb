//! Errors of modes, and the step of their differences.

use dbd_kernel::Cause;
use miette::Diagnostic;
use thiserror::Error;

/// Bodies at most: time grows with the cube of their number, to some seconds at this one.
pub const MAX_BODIES: usize = 200;

/// \[m, rad\] step of the fourth-order differences: their truncation error is of the order of 1e-20 m⁴ over a spring's
/// length to the fourth power, rounding of 1e-16 m over this.
pub(super) const PROBE: f64 = 1e-5;

/// Weights of the differences at 1 and 2 probes.
pub(super) const WEIGHTS: [f64; 2] = [8.0 / 12.0, -1.0 / 12.0];

/// Why there are no modes.
#[derive(Clone, Copy, Debug, PartialEq, Error, Diagnostic)]
pub enum ModesError {
    /// Too many bodies.
    #[error(
        "computing all modes of {bodies} bodies would take too long; the maximum is {MAX_BODIES}"
    )]
    #[diagnostic(help(
        "use `host-sim modes`, which finds the lowest and highest modes of larger scenes"
    ))]
    TooMany {
        /// How many there are.
        bodies: usize,
    },
    /// The forces near the pose are undefined, for example with an undefined torsion angle.
    #[error("the modes about this pose are undefined: a torsion angle is undefined ({0:?})")]
    #[diagnostic(help("use a pose in which every torsion spring has a defined angle"))]
    Pose(Cause),
    /// A law has an internal degree of freedom.
    #[error(
        "the rotor of the law `{law}` is a degree of freedom outside the bodies, which modes do not include"
    )]
    #[diagnostic(help("use a drive without a rotor and add its inertia to a body"))]
    Rotor {
        /// The law.
        law: &'static str,
    },
    /// A body is driven.
    #[error("modes do not include driven bodies, as body {row} in scene order")]
    #[diagnostic(help("remove `driven` and hold the body by joints or springs"))]
    Driven {
        /// The body, from 1.
        row: usize,
    },
    /// A stiffness beyond the range of numbers.
    #[error("the modes about this pose cannot be computed: stiffness over mass overflows")]
    #[diagnostic(help("use smaller stiffnesses or larger masses and inertias"))]
    Range,
    /// The iteration does not converge.
    #[error("the iteration for the modes of many bodies does not converge")]
    #[diagnostic(help(
        "ask for fewer modes, or put a part of the mechanism into a separate scene"
    ))]
    Slow,
}

impl From<Cause> for ModesError {
    fn from(cause: Cause) -> Self {
        Self::Pose(cause)
    }
}
