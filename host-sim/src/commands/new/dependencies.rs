//! Where a new project's crates come from: the sources that this program was built from while they
//! are there, else the registry.

use std::path::Path;

/// What stands behind the crates' names in `Cargo.toml`.
pub(super) struct Dependencies {
    /// Of `dbd-kernel`.
    pub(super) kernel: String,
    /// Of `dbd-scene`.
    pub(super) scene: String,
    /// Of `host-sim`.
    pub(super) host_sim: String,
    /// Of `dbd-fmu`.
    pub(super) fmu: String,
    /// Where they come from, for people.
    pub(super) origin: String,
}

impl Dependencies {
    /// Those of this program's sources, or published ones of its version.
    pub(super) fn of(registry: bool) -> Self {
        let root = Path::new(env!("CARGO_MANIFEST_DIR")).parent();
        let sources = root.filter(|root| {
            !registry
                && ["kernel", "crates/scene"]
                    .iter()
                    .all(|room| root.join(room).join("Cargo.toml").is_file())
        });
        // A path that is no text cannot stand in a TOML file.
        match sources.and_then(Path::to_str) {
            Some(root) => Self {
                kernel: in_folder(&format!("{root}/kernel")),
                scene: in_folder(&format!("{root}/crates/scene")),
                host_sim: in_folder(&format!("{root}/host-sim")),
                fmu: in_folder(&format!("{root}/crates/fmu")),
                origin: format!("its crates are those in {root}"),
            },
            None => {
                let version = env!("CARGO_PKG_VERSION");
                let published = format!("{version:?}");
                Self {
                    kernel: published.clone(),
                    host_sim: published.clone(),
                    fmu: published.clone(),
                    scene: published,
                    origin: format!("its crates are the published ones, version {version}"),
                }
            }
        }
    }
}

/// A dependency on a folder. Backslashes and quotes are escaped in TOML as in Rust.
fn in_folder(path: &str) -> String {
    format!("{{ path = {path:?} }}")
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn crates_are_those_of_the_sources_unless_asked_otherwise() {
        let own = Dependencies::of(false);
        assert!(own.kernel.starts_with("{ path = \"") && own.kernel.ends_with("/kernel\" }"));
        let published = Dependencies::of(true);
        assert_eq!(published.scene, format!("\"{}\"", env!("CARGO_PKG_VERSION")));
    }
}
