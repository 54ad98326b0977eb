//! Why there is no such method.
//!
//! `(names, parameters) => refusal with what would be right`.

use dbd_kernel::schemes::{GeneralizedAlpha, RhoError};
use miette::Diagnostic;
use thiserror::Error;

use super::MOST_ITERATIONS;

/// Why there is no such method.
#[derive(Clone, Copy, Debug, PartialEq, Error, Diagnostic)]
pub enum MethodError {
    /// Newton iterations for a scheme without any.
    #[error("the scheme {scheme} has no Newton iterations")]
    #[diagnostic(help(
        "--newton goes with --scheme dbd, dbd-p1 or dbd-p2; leave it out for {scheme}"
    ))]
    Newton {
        /// The scheme's name.
        scheme: &'static str,
    },
    /// More than [`MOST_ITERATIONS`].
    #[error("{newton} Newton iterations are more than {MOST_ITERATIONS}")]
    #[diagnostic(help("--newton 0 to --newton {MOST_ITERATIONS}; more of them buy nothing"))]
    Iterations {
        /// How many.
        newton: u32,
    },
    /// ρ∞ for a scheme without it.
    #[error("the scheme {scheme} has no rho")]
    #[diagnostic(help("--rho goes with --scheme generalized-alpha; leave it out for {scheme}"))]
    NoRho {
        /// The scheme's name.
        scheme: &'static str,
    },
    /// ρ∞ beyond what it may be.
    #[error("{0}")]
    #[diagnostic(help("--rho 0 damps most, --rho {most} least; 0.5 where nothing is said", most = GeneralizedAlpha::MOST_RHO))]
    Rho(RhoError),
    /// A damping that the scheme has not.
    #[error("the scheme {scheme} has no {asked} damping, only {own}")]
    #[diagnostic(help(
        "leapfrog and semi-implicit-euler have sweeps, joint-wise and explicit; leave --damping out for {scheme}"
    ))]
    Damping {
        /// The scheme's name.
        scheme: &'static str,
        /// What was asked for.
        asked: &'static str,
        /// What it has.
        own: &'static str,
    },
    /// A method for comparison, in a build without the feature `comparison`.
    #[error("{what} is there for comparison only, and not part of this build")]
    #[diagnostic(help(
        "cargo run --release --features comparison -- …; or --precision f64 or f32, --orientation \
         quaternion"
    ))]
    Comparison {
        /// The precision or the way of storing orientations.
        what: &'static str,
    },
    /// A way of storing orientations that a precision has not.
    #[error("{precision} has no orientations as {orientation}")]
    #[diagnostic(help(
        "it stores quaternions only: leave --orientation out, or --precision f64 or f32"
    ))]
    Orientation {
        /// The precision's name.
        precision: &'static str,
        /// The way of storing orientations.
        orientation: &'static str,
    },
    /// A precision in which no pose is at rest.
    #[error("there is no stability to look at in {precision}: its square root is off by per cents")]
    #[diagnostic(help(
        "no frozen pose is at rest in it, nothing vibrates about one; --precision f64 or f32"
    ))]
    Restless {
        /// The precision's name.
        precision: &'static str,
    },
}
