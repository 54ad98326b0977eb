//! Where a new project's crates come from: a repository, the registry, or the sources that this program was built from.

use std::path::Path;

use clap::Args;
use miette::Diagnostic;
use thiserror::Error;

/// Where crates come from, as the command line names it.
#[derive(Clone, Debug, Default, Args)]
pub struct DependencyOptions {
    /// Depend on the crates in a git repository, e.g. https://host/owner/name.git
    #[arg(long, value_name = "URL", conflicts_with = "registry")]
    pub git: Option<String>,
    /// Commit, tag or branch for --git [default: the repository's default branch]
    #[arg(long, value_name = "REV", requires = "git")]
    pub rev: Option<String>,
    /// Depend on the crates of this version in the registry; not published yet
    #[arg(long)]
    pub registry: bool,
}

/// The crates of a new project cannot be found.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Error, Diagnostic)]
#[error("the sources of this program are not on this machine, so a new project would not build")]
#[diagnostic(help(
    "name their repository with --git URL --rev REV; --registry works once version {version} is published"
))]
pub struct NoSources {
    version: &'static str,
}

/// The values of the crates' names in `Cargo.toml`.
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
    /// Whether they are in a folder of this machine.
    pub(super) is_local: bool,
}

impl Dependencies {
    /// Those that are asked for, else those of this program's sources.
    ///
    /// # Errors
    /// [`NoSources`] where nothing is asked for and the sources are not on this machine.
    pub(super) fn of(options: &DependencyOptions) -> Result<Self, NoSources> {
        Self::with(options, Path::new(env!("CARGO_MANIFEST_DIR")).parent())
    }

    fn with(options: &DependencyOptions, root: Option<&Path>) -> Result<Self, NoSources> {
        if let Some(url) = &options.git {
            // Quotes and backslashes are escaped in TOML as in Rust.
            let rev = options.rev.as_ref().map(|rev| format!(", rev = {rev:?}"));
            let of_git = format!("{{ git = {url:?}{} }}", rev.unwrap_or_default());
            return Ok(Self::all(&of_git, format!("its crates come from {url}")));
        }
        let version = env!("CARGO_PKG_VERSION");
        if options.registry {
            let origin = format!("its crates come from the registry, version {version}");
            return Ok(Self::all(&format!("{version:?}"), origin));
        }
        let sources = root.filter(|root| {
            let is_there = |room| root.join(room).join("Cargo.toml").is_file();
            ["kernel", "crates/scene"].into_iter().all(is_there)
        });
        // A path that is not UTF-8 cannot be written to a TOML file.
        let root = sources.and_then(Path::to_str).ok_or(NoSources { version })?;
        let in_folder = |folder: &str| format!("{{ path = {:?} }}", format!("{root}/{folder}"));
        Ok(Self {
            kernel: in_folder("kernel"),
            scene: in_folder("crates/scene"),
            host_sim: in_folder("host-sim"),
            fmu: in_folder("crates/fmu"),
            origin: format!("its crates come from {root}"),
            is_local: true,
        })
    }

    /// All crates from one place.
    fn all(place: &str, origin: String) -> Self {
        let [kernel, scene, host_sim, fmu] = [(); 4].map(|()| place.to_owned());
        Self { kernel, scene, host_sim, fmu, origin, is_local: false }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn crates_are_those_of_the_sources_unless_asked_otherwise() {
        let own = Dependencies::of(&DependencyOptions::default()).unwrap();
        assert!(own.kernel.starts_with("{ path = \"") && own.kernel.ends_with("/kernel\" }"));
        assert!(own.is_local);
        let registry = DependencyOptions { registry: true, ..DependencyOptions::default() };
        let published = Dependencies::of(&registry).unwrap();
        assert_eq!(published.scene, format!("\"{}\"", env!("CARGO_PKG_VERSION")));
        let git = Some("https://host/dbd.git".to_owned());
        let options = DependencyOptions { git, rev: Some("v1".to_owned()), registry: false };
        let of_git = Dependencies::of(&options).unwrap();
        assert_eq!(of_git.fmu, "{ git = \"https://host/dbd.git\", rev = \"v1\" }");
    }

    #[test]
    fn without_sources_nothing_is_written_that_cannot_build() {
        let nowhere = Some(Path::new("/no/such/folder"));
        for root in [nowhere, None] {
            let refused = Dependencies::with(&DependencyOptions::default(), root);
            assert!(matches!(refused, Err(NoSources { .. })));
            let registry = DependencyOptions { registry: true, ..DependencyOptions::default() };
            assert!(Dependencies::with(&registry, root).is_ok());
        }
    }
}
