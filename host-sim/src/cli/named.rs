//! Arguments that name a scene, a damping method or a results folder.

use std::path::PathBuf;

use clap::{Args, ValueHint};
use dbd_plant::{DampingName, Method};

use crate::arguments::SceneArgument;
use crate::commands::folder::Destination;
use crate::error::Error;
use crate::terminal::{Catalogue, Found, SceneFile};

#[derive(Debug, Args)]
pub(super) struct ResultsArguments {
    /// Folder for results; each scene gets a subfolder named after its file
    #[arg(long, value_name = "DIR", default_value = "out", value_hint = ValueHint::DirPath)]
    out: PathBuf,
    /// Overwrite results of another scene whose file has the same name
    #[arg(long)]
    overwrite: bool,
}

impl ResultsArguments {
    pub(super) fn destination(&self, file: &SceneFile) -> Destination {
        let Self { out, overwrite } = self;
        Destination { out: out.clone(), file: file.clone(), overwrite: *overwrite }
    }
}

pub(super) fn load(catalogue: &Catalogue, argument: &SceneArgument) -> Result<Found, Error> {
    Ok(catalogue.load_with(&argument.scene, &argument.changes())?)
}

/// A method with another spectral radius at infinite frequency.
pub(super) fn leaving(method: Method, rho: Option<f64>) -> Result<Method, Error> {
    Ok(match rho {
        Some(rho) => method.with_rho(rho)?,
        None => method,
    })
}

pub(super) fn damped(method: Method, damping: Option<DampingName>) -> Result<Method, Error> {
    Ok(match damping {
        Some(damping) => method.with_damping(damping)?,
        None => method,
    })
}
