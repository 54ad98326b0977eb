//! `host-sim new`: projects and scenes that build and run as they are.
//!
//! `(name, scene) => folder`. The files are those of `templates/`, with what the scene tells in place of `{{…}}`.

mod c;
mod choice;
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

use crate::help;
use choice::{ChoiceError, ChoiceOptions};

pub use c::c;
pub use dependencies::{DependencyOptions, NoSources};
pub use firmware::firmware;
pub use laws::{LawsArguments, laws};
pub use name::NameError;
pub use scene::{SceneArguments, scene};

/// The scene of a project that names none.
pub const SCENE: &str = "cart-pendulum";

/// What is new.
#[derive(Clone, Debug, Subcommand)]
pub enum NewCommand {
    /// Writes a project with a scene as a plant in firmware: builds, runs in QEMU and on the PC
    #[command(after_help = help::NEW_FIRMWARE)]
    Firmware(PlantArguments),
    /// Writes a project with a scene as a plant for firmware in C: a static library, its header and a program
    #[command(after_help = help::NEW_C)]
    C(PlantArguments),
    /// Writes a crate with laws of one's own between bodies, tests of them, and the command line that knows them
    #[command(after_help = help::NEW_LAWS)]
    Laws(LawsArguments),
    /// Writes a commented scene that runs as it is, and the schema from which editors complete its keys
    #[command(after_help = help::NEW_SCENE)]
    Scene(SceneArguments),
}

/// A project with a plant.
#[derive(Clone, Debug, Args)]
pub struct PlantArguments {
    /// The project's name, or a path to its folder, which must not exist yet
    pub name: PathBuf,
    /// A scene by name (see list) or a path to a .toml file; the project gets a copy
    #[arg(long, default_value = SCENE)]
    pub scene: String,
    /// Where its crates come from [default: the sources of this program]
    #[command(flatten)]
    pub dependencies: DependencyOptions,
    /// How the plant steps
    #[command(flatten)]
    pub choice: ChoiceOptions,
}

/// Why there is no project or scene.
#[derive(Debug, Error)]
pub enum NewError {
    /// It cannot be called so.
    #[error(transparent)]
    Name(#[from] NameError),
    /// Something has its folder's or its file's name.
    #[error("there is something called {} already", path.display())]
    Taken {
        /// The folder or the file.
        path: PathBuf,
    },
    /// No method or no step holds the scene.
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
    /// Its crates are nowhere.
    #[error(transparent)]
    Sources(#[from] NoSources),
    /// It cannot be written.
    #[error("cannot write to {}: {reason}", path.display())]
    Write {
        /// The folder or the file.
        path: PathBuf,
        /// Why; part of the message and therefore not a source, which would say it twice.
        reason: io::Error,
    },
}

impl Diagnostic for NewError {
    fn help<'a>(&'a self) -> Option<Box<dyn fmt::Display + 'a>> {
        match self {
            Self::Name(error) => error.help(),
            Self::Choice(error) => error.help(),
            Self::Taken { .. } => Some(Box::new("another name; nothing is ever overwritten")),
            Self::Fails { scene, .. } => {
                let help = format!("host-sim run {scene} with that method finds a step that works");
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

/// A template with its values. No value is looked through for names: a scene may hold anything.
fn filled(template: &str, values: &[(&str, String)]) -> String {
    let mut text = String::new();
    let mut rest = template;
    while let Some((before, name, after)) = placeholder(rest) {
        text += before;
        match values.iter().find(|(known, _)| *known == name) {
            Some((_, value)) => text += value,
            // Braces of the template's own.
            None => text += &format!("{{{{{name}}}}}"),
        }
        rest = after;
    }
    text + rest
}

/// What stands before the first `{{name}}`, its name, and what stands behind it.
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
