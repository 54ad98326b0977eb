//! `host-sim new scene`: a starter scene, ready to run, with the schema next to it.
//!
//! `(name, scene to copy) => NAME.toml, scene.schema.json`. An editor that supports Taplo's `#:schema` line completes
//! its keys; nothing is downloaded.

use std::path::{Path, PathBuf};

use clap::{Args, ValueEnum, ValueHint};
use dbd_report::output::file::write_at;
use dbd_scene::file::read_text;

use super::{NewError, filled, name};
use crate::commands::schema;

/// A kind of mechanism to begin with.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq, ValueEnum)]
pub enum Template {
    /// A crank, driven by a motor, a coupler and a rocker.
    #[default]
    Linkage,
    /// A cart on a rail with a pendulum, stops and friction.
    Cart,
    /// An arm of three joints with limits, friction and servos.
    RobotArm,
    /// A quarter of a car: tyre, spring, digressive damper, bump stop, road.
    VehicleCorner,
    /// Two coupled fingers that grasp a ball.
    Gripper,
    /// A motor with winding and gear that turns a flywheel.
    DriveTrain,
}

impl Template {
    fn text(self) -> &'static str {
        match self {
            Self::Linkage => include_str!("../../../templates/scene/crank-rocker.toml.in"),
            Self::Cart => include_str!("../../../templates/scene/cart.toml.in"),
            Self::RobotArm => include_str!("../../../templates/scene/robot-arm.toml.in"),
            Self::VehicleCorner => include_str!("../../../templates/scene/vehicle-corner.toml.in"),
            Self::Gripper => include_str!("../../../templates/scene/gripper.toml.in"),
            Self::DriveTrain => include_str!("../../../templates/scene/drive-train.toml.in"),
        }
    }
}

/// A new scene.
#[derive(Clone, Debug, Args)]
pub struct SceneArguments {
    /// The scene's name, or a path to its file, which must not exist yet; .toml is added
    #[arg(value_hint = ValueHint::FilePath)]
    pub name: PathBuf,
    /// Start from a copy of a scene, by name (see list) or by a path to its file
    #[arg(long, value_name = "SCENE", value_hint = ValueHint::FilePath)]
    pub from: Option<String>,
    /// Start from a kind of mechanism
    #[arg(long, value_name = "KIND", value_enum, default_value_t, conflicts_with = "from")]
    pub template: Template,
}

/// Writes a scene, a copy of a text where there is one, else of a template, and says what to type next.
///
/// # Errors
/// [`NewError`]; no scene is written then.
pub fn scene(path: &Path, copied: Option<&str>, template: Template) -> Result<String, NewError> {
    let own = path.file_name().and_then(|name| name.to_str()).or(path.to_str());
    let own = own.unwrap_or_default();
    let own = own.strip_suffix(".toml").unwrap_or(own);
    name::check_scene(own)?;
    let file = path.with_file_name(format!("{own}.toml"));
    // A dangling link exists, too.
    if file.symlink_metadata().is_ok() {
        return Err(NewError::Taken { path: file });
    }
    let schema_file = file.with_file_name(schema::FILE);
    if !is_free(&schema_file) {
        return Err(NewError::Taken { path: schema_file });
    }
    let text = match copied {
        Some(text) => format!("#:schema ./{}\n{}", schema::FILE, renamed(text, own)),
        None => filled(template.text(), &[("name", own.to_owned())]),
    };
    // A missing folder is reported by its own name.
    let folder = file.parent().filter(|folder| *folder != Path::new(""));
    if let Some(folder) = folder.filter(|folder| !folder.is_dir()) {
        let reason = std::io::ErrorKind::NotFound.into();
        return Err(NewError::Write { path: folder.to_owned(), reason });
    }
    let put = |path: &Path, text: &str| {
        write_at(path, text).map_err(|reason| NewError::Write { path: path.to_owned(), reason })
    };
    put(&schema_file, &schema::text())?;
    put(&file, &text)?;
    let shown = quoted(&file);
    let picture = quoted(&file.with_extension("svg"));
    Ok(format!(
        "{shown}: a scene that runs as it is; {} beside it lets an editor complete its keys\n\n  \
         host-sim check {shown} --watch --svg {picture}    checks and draws it at each save\n  \
         host-sim run {shown}    simulates it: out/{own}/report.html\n",
        schema::FILE,
    ))
}

/// Whether a schema may be written: the file is missing, or was written by a version of this program.
fn is_free(file: &Path) -> bool {
    if file.symlink_metadata().is_err() {
        return true;
    }
    let title = format!("\"title\": \"{}\"", schema::TITLE);
    read_text(file).is_ok_and(|text| text.contains(&title))
}

/// A scene's text with another name and without the line that names a schema.
fn renamed(text: &str, name: &str) -> String {
    let mut in_head = true;
    let mut renamed = String::new();
    for line in text.split_inclusive('\n') {
        in_head &= !line.trim_start().starts_with('[');
        let is_name = in_head
            && line.strip_prefix("name").is_some_and(|rest| rest.trim_start().starts_with('='));
        match () {
            () if line.starts_with("#:schema") => {}
            () if is_name => renamed += &format!("name = \"{name}\"\n"),
            () => renamed += line,
        }
    }
    renamed
}

/// A path quoted for a shell.
fn quoted(path: &Path) -> String {
    let path = path.display().to_string();
    let plain = |c: char| c.is_ascii_alphanumeric() || "._-/\\:~+".contains(c);
    if path.chars().all(plain) { path } else { format!("'{}'", path.replace('\'', "'\\''")) }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_copy_has_its_own_name_and_one_schema() {
        let text =
            "#:schema ./x.json\n# name = 1\nname=\"a\" # old\nnames = 2\n[[body]]\nname = \"b\"\n";
        let copy = renamed(text, "mine");
        assert_eq!(copy, "# name = 1\nname = \"mine\"\nnames = 2\n[[body]]\nname = \"b\"\n");
        assert_eq!(quoted(Path::new("a b/it's.toml")), "'a b/it'\\''s.toml'");
    }
}
