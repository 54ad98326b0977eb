//! Why there is no plant of a scene.
//!
//! `(scene, method, step) => refusal with what would be right`.

use dbd_scene::{Misfit, UnfitInput};
use miette::Diagnostic;
use thiserror::Error;

use crate::method::MethodError;
use crate::time::{at_most, display};

/// Why there is no such plant.
#[derive(Clone, Debug, PartialEq, Error, Diagnostic)]
pub enum PlantError {
    /// The step is zero or infinite once it is rounded to the precision.
    #[error("a step of {} is {rounded} in {precision}", display(*step))]
    #[diagnostic(help("a longer step, or --precision f64"))]
    Step {
        /// \[s\] the step.
        step: f64,
        /// \[s\] what it is rounded to.
        rounded: f64,
        /// The precision's name.
        precision: &'static str,
    },
    /// A planar scene has no such precision or way of storing orientations.
    #[error("a planar scene does not run in {what}")]
    #[diagnostic(help(
        "--precision f64 or f32 with --orientation quaternion, or the scene without `planar`"
    ))]
    Planar {
        /// The precision or the way of storing orientations.
        what: &'static str,
    },
    /// A part of the model is beyond what the precision holds.
    #[error(transparent)]
    #[diagnostic(help("{}", .0.remedy))]
    Extent(#[from] Misfit),
    /// The scheme has a matrix, and the bodies of the scene form more pairs than it holds.
    #[error("a matrix of more than 65535 pairs of bodies")]
    #[diagnostic(help("a scheme without a matrix: --scheme leapfrog"))]
    Pairs,
    /// The precision does not bear joints so stiff with so long a step.
    #[error("joints as stiff as these take a step of at most {} in {precision}", display(at_most(*most)))]
    #[diagnostic(help("a shorter step, softer joints, or --precision f64"))]
    Stiff {
        /// \[s\] the longest step.
        most: f64,
        /// The precision's name.
        precision: &'static str,
    },
    /// The scheme cannot bring on what a law remembers.
    #[error("what an interaction of the law `{law}` remembers cannot be brought on by {scheme}")]
    #[diagnostic(help("--scheme leapfrog: one evaluation per step, at its end"))]
    Memory {
        /// The law's name.
        law: &'static str,
        /// The scheme's name.
        scheme: &'static str,
    },
    /// The precision exists for comparison alone and has no laws.
    #[error("interactions do not run in {precision}, which exists for comparison alone")]
    #[diagnostic(help("--precision f64, f32 or fixed with --orientation quaternion"))]
    Laws {
        /// The precision's name.
        precision: &'static str,
    },
    /// This build does not hold the method.
    #[error(transparent)]
    #[diagnostic(transparent)]
    Method(#[from] MethodError),
    /// The precision cannot hold what an input is given.
    #[error(transparent)]
    #[diagnostic(help("smaller values, gentler rises, a later begin, or --precision f64"))]
    Input(#[from] UnfitInput),
}
