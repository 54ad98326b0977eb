//! Invalid methods.
//!
//! `(names, parameters) => error with remedy`.

use dbd_kernel::schemes::{GeneralizedAlpha, RhoError};
use miette::Diagnostic;
use thiserror::Error;

use super::MAX_ITERATIONS;

/// Invalid methods.
#[derive(Clone, Copy, Debug, PartialEq, Error, Diagnostic)]
pub enum MethodError {
    /// Newton iterations for a scheme without any.
    #[error("the scheme {scheme} has no Newton iterations")]
    #[diagnostic(help(
        "--newton requires --scheme dbd, dbd-p1 or dbd-p2; leave it out for {scheme}"
    ))]
    Newton {
        /// The scheme's name.
        scheme: &'static str,
    },
    /// More than [`MAX_ITERATIONS`].
    #[error("{newton} Newton iterations exceed the maximum of {MAX_ITERATIONS}")]
    #[diagnostic(help(
        "use --newton 0 to --newton {MAX_ITERATIONS}; further iterations change nothing"
    ))]
    Iterations {
        /// The number.
        newton: u32,
    },
    /// ρ∞ for a scheme without it.
    #[error("the scheme {scheme} has no rho")]
    #[diagnostic(help("--rho requires --scheme generalized-alpha; leave it out for {scheme}"))]
    NoRho {
        /// The scheme's name.
        scheme: &'static str,
    },
    /// ρ∞ out of range.
    #[error("{0}")]
    #[diagnostic(help("give --rho from 0 (most damping) to {most} (least); the default is 0.5", most = GeneralizedAlpha::MAX_RHO))]
    Rho(RhoError),
    /// A damping that the scheme does not support.
    #[error("the scheme {scheme} does not support {asked} damping, only {own}")]
    #[diagnostic(help(
        "leapfrog and semi-implicit-euler support sweeps, joint-wise and explicit; leave --damping out for {scheme}"
    ))]
    Damping {
        /// The scheme's name.
        scheme: &'static str,
        /// The requested damping.
        asked: &'static str,
        /// Its supported damping.
        own: &'static str,
    },
    /// A method for comparison, in a build without the feature `comparison`.
    #[error("{what} is for comparison only and not part of this build")]
    #[diagnostic(help(
        "use cargo run --release --features comparison -- …, or --precision f64 or f32 with --orientation quaternion"
    ))]
    Comparison {
        /// The precision or the orientation representation.
        what: &'static str,
    },
    /// An orientation representation that a precision does not support.
    #[error("{precision} does not support {orientation} orientations")]
    #[diagnostic(help(
        "{precision} stores quaternions only: leave --orientation out, or use --precision f64 or f32"
    ))]
    Orientation {
        /// The precision's name.
        precision: &'static str,
        /// The orientation representation.
        orientation: &'static str,
    },
    /// A precision in which no pose is in equilibrium.
    #[error(
        "stability cannot be computed in {precision}: its square root has an error of some per cent"
    )]
    #[diagnostic(help(
        "use --precision f64 or f32; in {precision} no frozen pose is in equilibrium"
    ))]
    Restless {
        /// The precision's name.
        precision: &'static str,
    },
}
