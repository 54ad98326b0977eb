//! `host-sim new firmware`: a project with a plant in firmware, which builds and runs as it is; `host-sim new scene`
//! (`scene.rs`): a scene to begin with; `host-sim new laws` (`laws.rs`): a crate with laws of one's own.
//!
//! `(name, scene) => folder`. The files are those of `templates/firmware/`, with what the scene
//! tells in place of `{{…}}`; the golden bits are those of a run of the scene here.

mod choice;
mod dependencies;
mod folder;
mod laws;
mod name;
mod scene;

use std::fmt;
use std::io;
use std::path::{Path, PathBuf};

use clap::{Args, Subcommand};
use dbd_plant::digits::significant;
use dbd_plant::plant;
use dbd_plant::time::rounded;
use dbd_scene::Scene;
use dbd_scene::export::{constant_name, type_name};
use dbd_scene::laws::{KnownLaw, known_law};
use dbd_study::costs::Costs;
use dbd_study::estimate::instructions;
use miette::Diagnostic;
use thiserror::Error;

use crate::commands::schema;
use crate::help;
use crate::terminal::Found;
use choice::{Choice, ChoiceError, ChoiceOptions};
use dependencies::Dependencies;

pub use dependencies::{DependencyOptions, NoSources};
pub use laws::{LawsArguments, laws};
pub use name::NameError;
pub use scene::{SceneArguments, scene};

/// The scene of a project that names none.
pub const SCENE: &str = "cart-pendulum";

/// Most steps of the golden run: a second or two in QEMU.
const MOST_STEPS: u64 = 10_000;

/// The package of the kernel's own laws.
const KERNEL: &str = "dbd-kernel";

/// Constants that the project's page shows of a kind.
const SHOWN: usize = 6;

/// Files of a project and what they are made from.
const TEMPLATES: &[(&str, &str)] = &[
    ("Cargo.toml", include_str!("../../../templates/firmware/Cargo.toml.in")),
    ("build.rs", include_str!("../../../templates/firmware/build.rs.in")),
    ("memory.x", include_str!("../../../templates/firmware/memory.x.in")),
    (".cargo/config.toml", include_str!("../../../templates/firmware/config.toml.in")),
    (".gitignore", include_str!("../../../templates/firmware/gitignore.in")),
    ("README.md", include_str!("../../../templates/firmware/README.md.in")),
    ("src/lib.rs", include_str!("../../../templates/firmware/lib.rs.in")),
    ("src/main.rs", include_str!("../../../templates/firmware/main.rs.in")),
    ("src/bin/cost.rs", include_str!("../../../templates/firmware/cost.rs.in")),
    ("tests/golden.rs", include_str!("../../../templates/firmware/golden.rs.in")),
    ("check.sh", include_str!("../../../templates/firmware/check.sh.in")),
    (".github/workflows/test.yml", include_str!("../../../templates/firmware/github.yml.in")),
    (".gitlab-ci.yml", include_str!("../../../templates/firmware/gitlab.yml.in")),
    ("Dockerfile", include_str!("../../../templates/firmware/Dockerfile.in")),
    (
        ".devcontainer/devcontainer.json",
        include_str!("../../../templates/firmware/devcontainer.json.in"),
    ),
    (".vscode/extensions.json", include_str!("../../../templates/firmware/extensions.json.in")),
    (".vscode/launch.json", include_str!("../../../templates/firmware/launch.json.in")),
    (".vscode/settings.json", include_str!("../../../templates/firmware/settings.json.in")),
    (".taplo.toml", include_str!("../../../templates/firmware/taplo.toml.in")),
    ("Embed.toml", include_str!("../../../templates/firmware/Embed.toml.in")),
];

/// What files for other machines say where the project's crates are in a folder of this one.
const ELSEWHERE: &str = "\n# The crates are in a folder of one machine (Cargo.toml): elsewhere name their repository there, \
                         or write\n# the project with `host-sim new firmware --git URL --rev REV`.";

/// What is new.
#[derive(Clone, Debug, Subcommand)]
pub enum NewCommand {
    /// Writes a project with a scene as a plant in firmware: builds, runs in QEMU and on the PC
    #[command(after_help = help::NEW_FIRMWARE)]
    Firmware(FirmwareArguments),
    /// Writes a crate with laws of one's own between bodies, tests of them, and the command line that knows them
    #[command(after_help = help::NEW_LAWS)]
    Laws(LawsArguments),
    /// Writes a commented scene that runs as it is, and the schema from which editors complete its keys
    #[command(after_help = help::NEW_SCENE)]
    Scene(SceneArguments),
}

/// A project for firmware.
#[derive(Clone, Debug, Args)]
pub struct FirmwareArguments {
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

/// Writes a project of a scene and says what to type next.
///
/// # Errors
/// [`NewError`]; nothing is written then.
pub fn firmware(arguments: &FirmwareArguments, found: &Found) -> Result<String, NewError> {
    let place = Place::of(&arguments.name)?;
    project(&place, found, &Dependencies::of(&arguments.dependencies)?, &arguments.choice)
}

fn project(
    place: &Place<'_>,
    found: &Found,
    dependencies: &Dependencies,
    options: &ChoiceOptions,
) -> Result<String, NewError> {
    let scene = &found.scene;
    let choice = Choice::of(scene, options)?;
    let steps = ((scene.duration / choice.step).round() as u64).clamp(1, MOST_STEPS);
    let golden = golden(scene, &choice, steps)?;
    let stem = &plain(&found.file.stem);
    let file = format!("scenes/{stem}.toml");
    let estimate = instructions(scene, &choice.method, &Costs::shipped());
    let estimate = estimate.map_or_else(String::new, |count| {
        format!(
            "some {} instructions per step, estimated by bodies and elements",
            significant(rounded(count, 2), 2)
        )
    });
    let reasons: String = choice.reasons.iter().map(|reason| format!("- {reason}\n")).collect();
    let suffix = choice.method.precision_name().to_uppercase();
    let values: &[(&str, String)] = &[
        ("name", place.name.to_owned()),
        ("crate", place.name.replace('-', "_")),
        ("rust_version", env!("CARGO_PKG_RUST_VERSION").to_owned()),
        ("kernel", dependencies.kernel.clone()),
        ("scene_crate", dependencies.scene.clone()),
        ("origin", dependencies.origin.clone()),
        ("elsewhere", if dependencies.is_local { ELSEWHERE } else { "" }.to_owned()),
        ("build", choice.call(&file, &own_laws(scene))),
        ("law_crates", law_crates(scene)),
        ("scene", scene.name.clone()),
        ("stem", stem.clone()),
        ("type", type_name(&scene.name)),
        ("steps", steps.to_string()),
        ("method", choice.words()),
        ("reasons", reasons),
        ("hints", hints(scene, &suffix)),
        ("constants", constants(scene, &suffix)),
    ];
    let scene_file = (PathBuf::from(&file), found.text.clone());
    let golden_file = (PathBuf::from("tests/golden.txt"), golden);
    let schema_file = (PathBuf::from(format!("scenes/{}", schema::FILE)), schema::text());
    place.write(TEMPLATES, values, vec![scene_file, golden_file, schema_file])?;
    Ok(format!(
        "{0}: the scene {1} as a plant in firmware: {3}; {2}\n{4}\n  cd {0}\n  cargo test    golden bits on the \
         PC\n  cargo qemu    the same bits on a Cortex-M4F in QEMU; README.md says what to install\n  cargo \
         cost    instructions of a step there: {5}\n",
        place.folder.display(),
        scene.name,
        dependencies.origin,
        choice.words(),
        choice.reasons.iter().map(|reason| format!("  {reason}\n")).collect::<String>(),
        if estimate.is_empty() { "nothing like it was counted" } else { &estimate },
    ))
}

/// The laws of a scene that are not the kernel's.
fn own_laws(scene: &Scene) -> Vec<KnownLaw> {
    let known = scene.model.laws.names().filter_map(known_law);
    known.filter(|law| law.package[0] != KERNEL).collect()
}

/// The packages that declare them, as dependencies.
fn law_crates(scene: &Scene) -> String {
    let mut packages: Vec<_> = own_laws(scene).into_iter().map(|law| law.package).collect();
    packages.sort_unstable();
    packages.dedup();
    let line = |[name, folder]: [&str; 2]| format!("{name} = {{ path = {folder:?} }}\n");
    packages.into_iter().map(line).collect()
}

/// A file name that stands in source and in paths as it is.
fn plain(stem: &str) -> String {
    let plain = |c: char| if c.is_ascii_alphanumeric() || "._-".contains(c) { c } else { '-' };
    let name: String = stem.chars().map(plain).collect();
    if name.starts_with(|c: char| c.is_ascii_alphanumeric()) {
        name
    } else {
        format!("scene{name}")
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

/// Lines `STEPS HASH` after 1, 10, 100, … steps and at the end, as the project's own run shows them.
fn golden(scene: &Scene, choice: &Choice, steps: u64) -> Result<String, NewError> {
    let plant = plant(scene, &choice.method, choice.step);
    let mut plant = plant.map_err(ChoiceError::from)?;
    let (mut lines, mut next, mut done) = (String::new(), 1, 0);
    while done < steps {
        let count = next.min(steps) - done;
        if let Err(failure) = plant.advance(count).ok() {
            let scene = scene.name.clone();
            let method = choice.words();
            return Err(NewError::Fails { scene, method, failure: failure.to_string() });
        }
        done += count;
        lines += &format!("{done} {:016x}\n", plant.hash());
        next = next.saturating_mul(10);
    }
    Ok(lines)
}

/// Calls of a controller, for the scene's first read-out and input.
fn hints(scene: &Scene, suffix: &str) -> String {
    let prefix = constant_name(&scene.name);
    let readout = scene.readouts.first().map(|readout| {
        let name = constant_name(&readout.name);
        format!("/// plant.read(&model::{prefix}_READOUT_{name}_{suffix})\n")
    });
    let input = scene.inputs.iter().find(|input| !input.table).map(|input| {
        let name = constant_name(&input.name);
        format!("/// plant.set_input_real(model::{prefix}_INPUT_{name}, 0.0)\n")
    });
    let calls: String = readout.into_iter().chain(input).collect();
    if calls.is_empty() { calls } else { format!("///\n/// ```text\n{calls}/// ```\n") }
}

/// The constants that a controller takes, for the project's page.
fn constants(scene: &Scene, suffix: &str) -> String {
    let prefix = constant_name(&scene.name);
    let row = |what: &str, names: Vec<String>| {
        let more = if names.len() > SHOWN { ", …" } else { "" };
        let shown: Vec<String> = names.iter().take(SHOWN).map(|name| format!("`{name}`")).collect();
        (!names.is_empty()).then(|| format!("| {what} | {}{more} |\n", shown.join(", ")))
    };
    let read = format!("_{suffix}");
    let force = format!("_FORCE_{suffix}");
    let name =
        |kind: &str, name: &str, end: &str| format!("{prefix}_{kind}_{}{end}", constant_name(name));
    let inputs = scene.inputs.iter().map(|one| name("INPUT", &one.name, "")).collect();
    let readouts = scene.readouts.iter().map(|one| name("READOUT", &one.name, &read)).collect();
    let bodies = scene.body_names.iter().map(|one| name("BODY", one, "")).collect();
    let joints = scene.joints.iter().map(|one| name("JOINT", &one.name, &force)).collect();
    let rows = [
        row("inputs", inputs),
        row("read-outs", readouts),
        row("bodies", bodies),
        row("forces of joints", joints),
    ];
    let rows: String = rows.into_iter().flatten().collect();
    format!("In `model`, beside the plant:\n\n| what | constants |\n|---|---|\n{rows}")
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn templates_are_filled_once() {
        let values = [("a", "{{b}}".to_owned()), ("b", "2".to_owned())];
        assert_eq!(filled("{{a}} {{b}} {{c}} {{", &values), "{{b}} 2 {{c}} {{");
    }

    /// Nothing is left to be filled in, and nothing is asked for that is not there.
    #[test]
    fn every_name_in_a_template_is_known() {
        let here = tempfile::tempdir().unwrap();
        let folder = here.path().join("plant");
        let found = crate::terminal::Catalogue::default().load("gyroscope").unwrap();
        let place = Place::of(&folder).unwrap();
        let registry = DependencyOptions { registry: true, ..DependencyOptions::default() };
        let dependencies = Dependencies::of(&registry).unwrap();
        project(&place, &found, &dependencies, &ChoiceOptions::default()).unwrap();
        for (path, _) in TEMPLATES {
            let text = std::fs::read_to_string(folder.join(path)).unwrap();
            assert!(!text.contains("{{"), "{path}: {text}");
        }
    }
}
