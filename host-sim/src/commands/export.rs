//! `host-sim export`: a scene as Rust source of its const model and plant, or as URDF.
//!
//! `(scene, precisions, scheme, step) => source`, the one that a build script writes
//! ([`dbd_scene::Build`]). The constant of the step is the one asked for, else the scene's, else the
//! default one before it is shortened to fit.

use std::fmt;
use std::path::{Path, PathBuf};

use clap::builder::TypedValueParser;
use clap::{Args, ValueHint};
use dbd_import::export::{Exported, Lack};
use dbd_plant::plan::step_of;
use dbd_plant::plant::check;
use dbd_plant::time::Time;
use dbd_plant::{
    DampingName, Frequencies, Method, Named as _, PlanError, PlantError, PrecisionName, SchemeName,
};
use dbd_scene::Scene;
use dbd_scene::export::{self as source, ExportScheme, HEAD, SchemeError};
use miette::Diagnostic;
use thiserror::Error;

use crate::arguments::{Ignored, SceneArgument, ignorable, names};
use crate::commands::replace::{ReplaceError, replace};

/// The exported scene and the destination.
#[derive(Clone, Debug, Args)]
pub struct ExportArguments {
    /// The scene
    #[command(flatten)]
    pub scene: SceneArgument,
    /// The format [default: Rust source]
    #[command(flatten)]
    pub format: FormatOptions,
    /// The exported parts
    #[command(flatten)]
    pub options: ExportOptions,
    /// Write to this file, atomically, instead of to standard output; with --c to this new folder
    #[arg(long, value_name = "FILE", value_hint = ValueHint::FilePath)]
    pub out: Option<PathBuf>,
}

/// Formats other than Rust source.
#[derive(Clone, Debug, Default, Args)]
pub struct FormatOptions {
    /// Write URDF, the robots of ROS: a tree of ideal joints
    #[arg(long, conflicts_with_all = ["c", "precision", "scheme", "newton", "rho", "damping", "step"])]
    pub urdf: bool,
    /// Omit elements of this kind that a URDF cannot hold; may be repeated
    #[arg(long, value_name = "KIND", requires = "urdf", value_parser = lacks())]
    pub ignore: Vec<Ignored<Lack>>,
    /// Write a project with a static library and its header for C, as new c does
    #[arg(long, requires = "out", conflicts_with_all = ["newton", "rho", "set", "planar", "settle"])]
    pub c: bool,
}

fn lacks() -> impl TypedValueParser<Value = Ignored<Lack>> {
    ignorable(Lack::ALL, |kind| [kind.name(), kind.summary()])
}

/// What is exported of a scene.
#[derive(Clone, Debug, Default, Args)]
pub struct ExportOptions {
    /// The model's precision [default: all]
    #[arg(long, value_enum)]
    pub precision: Option<ExportPrecision>,
    /// Time-stepping scheme of the plant
    #[arg(long, value_parser = names::<SchemeName>(), default_value = SchemeName::default().name())]
    pub scheme: SchemeName,
    /// Newton iterations per step of the dbd schemes, at most 8 [default: 0]
    #[arg(long, value_name = "N")]
    pub newton: Option<u32>,
    /// Spectral radius of generalized-alpha at infinite frequency, 0 to 0.8: the fraction of an unresolved
    /// vibration that remains per step [default: 0.5]
    #[arg(long, value_name = "RHO", allow_hyphen_values = true)]
    pub rho: Option<f64>,
    /// Damping method [default: the scheme's own]
    #[arg(long, value_parser = names::<DampingName>())]
    pub damping: Option<DampingName>,
    /// Step, e.g. 20us [default: the scene's, else the advised one]
    #[arg(long, value_name = "TIME", allow_hyphen_values = true)]
    pub step: Option<Time>,
}

/// Why a scene was not exported.
#[derive(Debug, Error)]
pub enum ExportError {
    /// There is no such scheme.
    #[error(transparent)]
    Scheme(#[from] SchemeError),
    /// A precision cannot hold the step or what an input is given.
    #[error(transparent)]
    Plant(#[from] PlantError),
    /// No step fits the scene.
    #[error(transparent)]
    Step(#[from] PlanError),
    /// A URDF cannot hold the scene.
    #[error(transparent)]
    Urdf(#[from] dbd_import::export::ExportError),
}

impl Diagnostic for ExportError {
    fn help<'a>(&'a self) -> Option<Box<dyn fmt::Display + 'a>> {
        match self {
            Self::Scheme(error) => Some(Box::new(error.help())),
            Self::Plant(error) => error.help(),
            Self::Step(error) => error.help(),
            Self::Urdf(error) => error.help(),
        }
    }
}

/// The source of a scene's const model and its plant, in f64 and f32 where no precision is named.
///
/// # Errors
/// [`ExportError`], except for those of files.
pub fn export(scene: &Scene, options: &ExportOptions) -> Result<String, ExportError> {
    let damping = options.damping.map(DampingName::name);
    let scheme = ExportScheme::named(options.scheme.name(), options.newton, damping)?;
    let scheme = match options.rho {
        Some(rho) => scheme.with_rho(rho)?,
        None => scheme,
    };
    let precisions = match options.precision {
        Some(one) => vec![one],
        None => vec![ExportPrecision::F64, ExportPrecision::F32],
    };
    let method = Method::new(options.scheme, None, PrecisionName::F64).map_err(PlantError::from)?;
    let methods = precisions.iter().map(|precision| method.with_precision(precision.name()));
    let methods: Vec<Method> = methods.collect();
    let longest = || {
        let frequencies = Frequencies::of(scene);
        let longest = methods.iter().map(|way| frequencies.default_limit(way, scene.duration));
        longest.fold(f64::INFINITY, f64::min)
    };
    let step = step_of(scene, options.step.map(Time::seconds), longest)?;
    for method in &methods {
        check(scene, method, step)?;
    }
    let precisions = precisions.into_iter().map(ExportPrecision::source).collect();
    Ok(source::source(scene, &source::Export { precisions, scheme, step }))
}

/// A scene as URDF, with what it leaves out.
///
/// # Errors
/// [`ExportError::Urdf`] where an element has no counterpart and its kind is not ignored.
pub fn urdf(scene: &Scene, options: &FormatOptions) -> Result<Exported, ExportError> {
    Ok(dbd_import::export::urdf(scene, &Ignored::all_of(&options.ignore, Lack::ALL))?)
}

/// Writes exported text to a file, in place of an older one of the same format.
///
/// # Errors
/// [`ReplaceError`].
pub fn write(file: &Path, text: &str, options: &FormatOptions) -> Result<(), ReplaceError> {
    let head = if options.urdf { dbd_import::export::HEAD } else { HEAD };
    replace(file, text, (head, "export"))
}

/// Precisions that const models are written in.
#[derive(Clone, Copy, Debug, PartialEq, Eq, clap::ValueEnum)]
pub enum ExportPrecision {
    /// Double precision.
    F64,
    /// Single precision.
    F32,
    /// Fixed-point geometry with forces in single precision.
    Fixed,
}

impl ExportPrecision {
    /// Its name.
    #[must_use]
    pub fn name(self) -> PrecisionName {
        match self {
            Self::F64 => PrecisionName::F64,
            Self::F32 => PrecisionName::F32,
            Self::Fixed => PrecisionName::Fixed,
        }
    }

    fn source(self) -> source::ExportPrecision {
        match self {
            Self::F64 => source::ExportPrecision::F64,
            Self::F32 => source::ExportPrecision::F32,
            Self::Fixed => source::ExportPrecision::Fixed,
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    /// Exactly the methods that run on the PC can be exported.
    #[test]
    fn a_plant_has_the_schemes_that_run_on_the_pc() {
        for scheme in SchemeName::ALL {
            for newton in [None, Some(0), Some(8), Some(9)] {
                let ways = DampingName::ALL.iter().copied().map(Some);
                for damping in [None].into_iter().chain(ways) {
                    let method = Method::new(*scheme, newton, PrecisionName::F64)
                        .and_then(|method| damping.map_or(Ok(method), |d| method.with_damping(d)));
                    let damping = damping.map(DampingName::name);
                    let exported = ExportScheme::named(scheme.name(), newton, damping);
                    assert_eq!(
                        method.is_ok(),
                        exported.is_ok(),
                        "{scheme:?} {newton:?} {damping:?}"
                    );
                    if let (Ok(method), Ok(exported)) = (method, exported) {
                        assert_eq!(method.scheme_name(), exported.name());
                        assert_eq!(method.stability_limit(), exported.stability_limit());
                    }
                }
            }
        }
    }
}
