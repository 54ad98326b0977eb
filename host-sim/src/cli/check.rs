//! `host-sim check` on the command line.

use std::path::PathBuf;

use clap::{Args, ValueHint};
use dbd_picture::Paper;
use dbd_plant::{DampingName, Method, Named as _, PrecisionName, SchemeName};

use crate::arguments::{SceneArgument, names};
use crate::cli::named::{damped, load};
use crate::commands::check::check;
use crate::commands::picture::{self, PictureError};
use crate::commands::stability::StabilityCheck;
use crate::commands::write::{self, WriteError};
use crate::error::Error;
use crate::terminal::text::json;
use crate::terminal::{Catalogue, Console, Exit, Found};

#[derive(Debug, Args)]
pub(super) struct CheckArguments {
    #[command(flatten)]
    pub(super) scene: SceneArgument,
    /// As JSON
    #[arg(long)]
    json: bool,
    /// Write a picture of the mechanism at its initial pose, an SVG; - for standard output, in place
    /// of the table
    #[arg(long, value_name = "FILE", value_hint = ValueHint::FilePath)]
    svg: Option<PathBuf>,
    /// Write the scene in its long form: poses at which the joints are closed, all numbers in SI; - for
    /// standard output, in place of the table
    #[arg(long, value_name = "FILE", value_hint = ValueHint::FilePath)]
    write: Option<PathBuf>,
    /// Replace the file where there is one
    #[arg(long, requires = "write")]
    overwrite: bool,
    /// Look for the largest stable step about the pose at t = 0; takes seconds
    #[arg(long)]
    stability: bool,
    /// Its time-stepping scheme
    #[arg(long, value_parser = names::<SchemeName>(), default_value = SchemeName::default().name(), requires = "stability")]
    scheme: SchemeName,
    /// Its Newton iterations per step, at most 8 [default: 0]
    #[arg(long, value_name = "N", requires = "stability")]
    newton: Option<u32>,
    /// How its dampers act [default: the scheme's own]
    #[arg(long, value_parser = names::<DampingName>(), requires = "stability")]
    damping: Option<DampingName>,
    /// Its precision
    #[arg(long, value_parser = names::<PrecisionName>(), default_value = PrecisionName::default().name(), requires = "stability")]
    precision: PrecisionName,
}

pub(super) fn check_scene(
    catalogue: &Catalogue,
    arguments: &CheckArguments,
    console: &mut Console<'_>,
) -> Result<Exit, Error> {
    let method = Method::new(arguments.scheme, arguments.newton, arguments.precision)?;
    let method = damped(method, arguments.damping)?;
    method.check_built()?;
    let picture_printed = arguments.svg.as_ref().is_some_and(|file| picture::is_output(file));
    if picture_printed && arguments.json {
        return Err(PictureError::Both.into());
    }
    let long_printed = arguments.write.as_ref().is_some_and(|file| write::is_output(file));
    if long_printed && (arguments.json || picture_printed) {
        return Err(WriteError::Both.into());
    }
    let Found { scene, file, text } = load(catalogue, &arguments.scene)?;
    if let Some(target) = &arguments.write {
        let long = write::long_form(&scene, &text, &file.place, &arguments.scene.set)?;
        if long_printed {
            console.print(&long)?;
        } else {
            write::write(target, &long, arguments.overwrite)?;
        }
    }
    match &arguments.svg {
        Some(_) if picture_printed => console.print(&picture::picture(&scene, Paper::File))?,
        Some(file) => picture::write(&scene, file)?,
        None => (),
    }
    if picture_printed || long_printed {
        return Ok(Exit::Done);
    }
    let mut check = check(&scene);
    if arguments.stability {
        check.stability = Some(StabilityCheck::of(&scene, &method)?);
    }
    let mut text = if arguments.json { json(&check) } else { check.text(console.look) };
    if !arguments.json {
        let written = arguments.svg.iter().chain(&arguments.write);
        written.for_each(|file| text += &format!("\nwritten  {}\n", file.display()));
    }
    console.print(&text)?;
    Ok(Exit::Done)
}
