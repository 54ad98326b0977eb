//! `host-sim new laws`: a crate with custom laws, a command line that includes them, a scene, tests.
//!
//! `name => folder`. The files are those of `templates/laws/`.

use std::path::PathBuf;

use clap::Args;

use super::dependencies::{Dependencies, DependencyOptions};
use super::{NewError, Place};

/// Files of a project and what they are made from.
const TEMPLATES: &[(&str, &str)] = &[
    ("Cargo.toml", include_str!("../../../templates/laws/Cargo.toml.in")),
    (".gitignore", include_str!("../../../templates/laws/gitignore.in")),
    ("README.md", include_str!("../../../templates/laws/README.md.in")),
    ("src/lib.rs", include_str!("../../../templates/laws/lib.rs.in")),
    ("src/drag.rs", include_str!("../../../templates/laws/drag.rs.in")),
    ("src/cam.rs", include_str!("../../../templates/laws/cam.rs.in")),
    ("tests/laws.rs", include_str!("../../../templates/laws/tests.rs.in")),
    ("program/Cargo.toml", include_str!("../../../templates/laws/program.toml.in")),
    ("program/src/main.rs", include_str!("../../../templates/laws/main.rs.in")),
    ("fmu/Cargo.toml", include_str!("../../../templates/laws/fmu.toml.in")),
    ("fmu/src/lib.rs", include_str!("../../../templates/laws/fmu.rs.in")),
    ("scenes/drop.toml", include_str!("../../../templates/laws/drop.toml.in")),
];

/// A crate of laws.
#[derive(Clone, Debug, Args)]
pub struct LawsArguments {
    /// The crate's name, or a path to its folder, which must not exist yet
    pub name: PathBuf,
    /// Source of its crates [default: the sources of this program]
    #[command(flatten)]
    pub dependencies: DependencyOptions,
}

/// Writes a crate of laws and says what to type next.
///
/// # Errors
/// [`NewError`]; nothing is written then.
pub fn laws(arguments: &LawsArguments) -> Result<String, NewError> {
    let place = Place::of(&arguments.name)?;
    let dependencies = Dependencies::of(&arguments.dependencies)?;
    let values: &[(&str, String)] = &[
        ("name", place.name.to_owned()),
        ("crate", place.name.replace('-', "_")),
        ("rust_version", env!("CARGO_PKG_RUST_VERSION").to_owned()),
        ("kernel", dependencies.kernel.clone()),
        ("scene_crate", dependencies.scene.clone()),
        ("host_sim", dependencies.host_sim.clone()),
        ("fmu", dependencies.fmu.clone()),
        ("origin", capital(&dependencies.origin)),
    ];
    place.write(TEMPLATES, values, Vec::new())?;
    Ok(format!(
        "{0}: two laws of one's own, `drag` and `cam`; {1}\n\n  cd {0}\n  cargo test    the laws keep what laws \
         promise\n  cargo run -p {2}-sim -- run scenes/drop.toml    host-sim that knows them\n",
        place.folder.display(),
        dependencies.origin,
        place.name,
    ))
}

/// A separate sentence.
fn capital(text: &str) -> String {
    let mut letters = text.chars();
    letters.next().map(|first| first.to_uppercase().chain(letters).collect()).unwrap_or_default()
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn every_name_in_a_template_is_known() {
        let here = tempfile::tempdir().unwrap();
        let folder = here.path().join("my-laws");
        let dependencies = DependencyOptions { registry: true, ..DependencyOptions::default() };
        laws(&LawsArguments { name: folder.clone(), dependencies }).unwrap();
        for (path, _) in TEMPLATES {
            let text = std::fs::read_to_string(folder.join(path)).unwrap();
            assert!(!text.contains("{{"), "{path}: {text}");
        }
        let main = std::fs::read_to_string(folder.join("program/src/main.rs")).unwrap();
        assert!(main.contains("my_laws::Drag"), "{main}");
        let library = std::fs::read_to_string(folder.join("fmu/src/lib.rs")).unwrap();
        assert!(library.contains("{ my_laws::Drag, my_laws::Cam }"), "{library}");
    }
}
