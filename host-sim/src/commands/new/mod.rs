//! `host-sim new`: projects and scenes, ready to build and run.
//!
//! `(name, scene) => folder`. The files are those of `templates/`, with `{{…}}` replaced by the scene's values.

mod c;
mod choice;
mod core;
mod dependencies;
mod firmware;
mod folder;
mod laws;
mod name;
mod plant;
mod scene;

use std::fmt;
use std::io;
use std::path::{Path, PathBuf};

use clap::{Args, Subcommand};
use miette::Diagnostic;
use thiserror::Error;

use crate::commands::export::ExportOptions;
use crate::help;
use choice::{ChoiceError, ChoiceOptions};

pub use c::c;
pub use core::Core;
pub use dependencies::{DependencyOptions, NoSources};
pub use firmware::{FirmwareArguments, firmware};
pub use laws::{LawsArguments, laws};
pub use name::NameError;
pub use scene::{SceneArguments, scene};

/// The scene of a project without a given scene.
pub const SCENE: &str = "cart-pendulum";

/// The kinds of new projects and files.
#[derive(Clone, Debug, Subcommand)]
pub enum NewCommand {
    /// Writes a firmware project with a scene as its plant, for QEMU and the PC
    #[command(after_help = help::NEW_FIRMWARE)]
    Firmware(FirmwareArguments),
    /// Writes a C firmware project with a scene as its plant: a static library, its header and a program
    #[command(after_help = help::NEW_C)]
    C(PlantArguments),
    /// Writes a crate with custom laws between bodies, their tests, and a command line that includes them
    #[command(after_help = help::NEW_LAWS)]
    Laws(LawsArguments),
    /// Writes a commented scene, ready to run, and the schema for completion in editors
    #[command(after_help = help::NEW_SCENE)]
    Scene(SceneArguments),
}

/// A project with a plant.
#[derive(Clone, Debug, Args)]
pub struct PlantArguments {
    /// The project's name, or a path to its folder, which must not exist yet
    pub name: PathBuf,
    /// A scene by name (see list) or a path to a .toml file; copied into the project
    #[arg(long, default_value = SCENE)]
    pub scene: String,
    /// Source of its crates [default: the sources of this program]
    #[command(flatten)]
    pub dependencies: DependencyOptions,
    /// How the plant steps
    #[command(flatten)]
    pub choice: ChoiceOptions,
}

impl PlantArguments {
    /// The project of an export: its sources are those of this program.
    #[must_use]
    pub fn of(folder: &Path, scene: &str, options: &ExportOptions) -> Self {
        let ExportOptions { scheme, damping, precision, step, .. } = *options;
        Self {
            name: folder.to_owned(),
            scene: scene.to_owned(),
            dependencies: DependencyOptions::default(),
            choice: ChoiceOptions { scheme: Some(scheme), damping, precision, step },
        }
    }
}

/// Why there is no project or scene.
#[derive(Debug, Error)]
pub enum NewError {
    /// Invalid name.
    #[error(transparent)]
    Name(#[from] NameError),
    /// Its folder or file exists.
    #[error("{} already exists", path.display())]
    Taken {
        /// The folder or the file.
        path: PathBuf,
    },
    /// No method or step represents the scene.
    #[error(transparent)]
    Choice(#[from] ChoiceError),
    /// The scene fails within the golden run.
    #[error("the scene {scene} fails with {method}: {failure}")]
    Fails {
        /// The scene.
        scene: String,
        /// How it steps.
        method: String,
        /// Where.
        failure: String,
    },
    /// Its crates cannot be found.
    #[error(transparent)]
    Sources(#[from] NoSources),
    /// It cannot be written.
    #[error("cannot write to {}: {reason}", path.display())]
    Write {
        /// The folder or the file.
        path: PathBuf,
        /// The reason; part of the message and therefore not a source, which would repeat it.
        reason: io::Error,
    },
}

impl Diagnostic for NewError {
    fn help<'a>(&'a self) -> Option<Box<dyn fmt::Display + 'a>> {
        match self {
            Self::Name(error) => error.help(),
            Self::Choice(error) => error.help(),
            Self::Taken { .. } => {
                Some(Box::new("choose another name; files are never overwritten"))
            }
            Self::Fails { scene, .. } => {
                let help = format!("host-sim run {scene} with that method finds a stable step");
                Some(Box::new(help))
            }
            Self::Sources(error) => error.help(),
            Self::Write { .. } => None,
        }
    }
}

/// A project's name and folder.
struct Place<'p> {
    name: &'p str,
    folder: &'p Path,
}

impl<'p> Place<'p> {
    fn of(folder: &'p Path) -> Result<Self, NameError> {
        let name = folder.file_name().and_then(|name| name.to_str());
        let name = name.or(folder.to_str()).unwrap_or_default();
        name::check(name).map(|()| Self { name, folder })
    }

    /// Writes the files of templates with their values, and others.
    fn write(
        &self,
        templates: &[(&str, &str)],
        values: &[(&str, String)],
        others: Vec<(PathBuf, String)>,
    ) -> Result<(), NewError> {
        let made = templates.iter().map(|(path, text)| (PathBuf::from(path), filled(text, values)));
        let files: Vec<(PathBuf, String)> = made.chain(others).collect();
        let path = self.folder.to_owned();
        folder::write(self.folder, &files).map_err(|reason| match reason.kind() {
            io::ErrorKind::AlreadyExists => NewError::Taken { path },
            _ => NewError::Write { path, reason },
        })
    }
}

/// A template with its values. Values are not searched for placeholders: a scene may contain anything.
fn filled(template: &str, values: &[(&str, String)]) -> String {
    let mut text = String::new();
    let mut rest = template;
    while let Some((before, name, after)) = placeholder(rest) {
        text += before;
        match values.iter().find(|(known, _)| *known == name) {
            Some((_, value)) => text += value,
            // Braces that belong to the template.
            None => text += &format!("{{{{{name}}}}}"),
        }
        rest = after;
    }
    text + rest
}

/// The text before the first `{{name}}`, the name, and the text after it.
fn placeholder(text: &str) -> Option<(&str, &str, &str)> {
    let (before, rest) = text.split_once("{{")?;
    let (name, after) = rest.split_once("}}")?;
    Some((before, name, after))
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn templates_are_filled_once() {
        let values = [("a", "{{b}}".to_owned()), ("b", "2".to_owned())];
        assert_eq!(filled("{{a}} {{b}} {{c}} {{", &values), "{{b}} 2 {{c}} {{");
    }
}
