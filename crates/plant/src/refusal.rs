//! Errors when creating a plant.
//!
//! `(scene, method, step) => error with remedy`.

use dbd_scene::{Elimination, Misfit, UnfitInput};
use miette::Diagnostic;
use thiserror::Error;

use crate::method::MethodError;
use crate::time::{at_most, display};

/// Reason why a plant cannot be created.
#[derive(Clone, Debug, PartialEq, Error, Diagnostic)]
pub enum PlantError {
    /// The step is zero or infinite once it is rounded to the precision.
    #[error("step {} is not representable in {precision}: it rounds to {rounded}", display(*step))]
    #[diagnostic(help("use a longer step, or --precision f64"))]
    Step {
        /// \[s\] the step.
        step: f64,
        /// \[s\] its rounded value.
        rounded: f64,
        /// The precision's name.
        precision: &'static str,
    },
    /// Precision or orientation representation without planar scenes.
    #[error("planar scenes do not support {what}")]
    #[diagnostic(help(
        "use --precision f64 or f32 with --orientation quaternion, or remove `planar` from the scene"
    ))]
    Planar {
        /// The precision or the orientation representation.
        what: &'static str,
    },
    /// A part of the model exceeds the range of the precision.
    #[error(transparent)]
    #[diagnostic(help("{}", .0.remedy))]
    Extent(#[from] Misfit),
    /// The scheme has a matrix, which the connections of the bodies fill too far.
    #[error(
        "the factorisation of the iteration matrix takes more than {} products of blocks",
        Elimination::MAX_PRODUCTS
    )]
    #[diagnostic(help("use a scheme without a matrix: --scheme leapfrog"))]
    Pairs,
    /// The joints are too stiff for this precision and step.
    #[error("the joints are too stiff for this step in {precision}: the longest step is {}", display(at_most(*most)))]
    #[diagnostic(help("use a shorter step, softer joints, or --precision f64"))]
    Stiff {
        /// \[s\] the longest step.
        most: f64,
        /// The precision's name.
        precision: &'static str,
    },
    /// The scheme cannot update the internal state of a law.
    #[error("the scheme {scheme} cannot update the internal state of the law `{law}`")]
    #[diagnostic(help("use --scheme leapfrog, which has one evaluation per step, at its end"))]
    Memory {
        /// The law's name.
        law: &'static str,
        /// The scheme's name.
        scheme: &'static str,
    },
    /// The scheme cannot move a driven body.
    #[error("the scheme {scheme} cannot move the driven body `{body}`")]
    #[diagnostic(help("use --scheme leapfrog, or remove `driven`"))]
    Driven {
        /// The body's name.
        body: String,
        /// The scheme's name.
        scheme: &'static str,
    },
    /// The precision exists for comparison alone and has no laws.
    #[error("{precision} does not support interactions: it is for comparison only")]
    #[diagnostic(help("use --precision f64, f32 or fixed with --orientation quaternion"))]
    Laws {
        /// The precision's name.
        precision: &'static str,
    },
    /// This build does not include the method.
    #[error(transparent)]
    #[diagnostic(transparent)]
    Method(#[from] MethodError),
    /// The precision cannot represent the values of an input.
    #[error(transparent)]
    #[diagnostic(help("use smaller values, slower changes, a later start, or --precision f64"))]
    Input(#[from] UnfitInput),
}
