//! A machine that has never seen the repository: an empty folder, and only those variables that find compilers.

use std::cell::RefCell;
use std::ffi::OsStr;
use std::fs;
use std::path::{Path, PathBuf};
use std::process::{Command, Stdio};

use anyhow::{Context as _, Result, bail};

/// What finds compilers and the machine's temporary folder.
const KEPT: [&str; 5] = ["PATH", "RUSTUP_HOME", "RUSTUP_TOOLCHAIN", "TMPDIR", "SSL_CERT_FILE"];

/// An empty folder of a stranger, removed in the end.
pub struct Stranger {
    folder: PathBuf,
    /// The first artefact that ran, and its hash.
    first: RefCell<Option<(String, String)>>,
}

impl Stranger {
    /// Makes the folder.
    ///
    /// # Errors
    /// Where it cannot be created.
    pub fn new() -> Result<Self> {
        let folder = std::env::temp_dir().join(format!("dbd-stranger-{}", std::process::id()));
        let _ = fs::remove_dir_all(&folder);
        fs::create_dir_all(folder.join("work"))
            .with_context(|| format!("cannot create {}", folder.display()))?;
        Ok(Self { folder, first: RefCell::default() })
    }

    /// Holds an artefact's hash of `four-bar` after 20 ms to that of the first artefact.
    ///
    /// # Errors
    /// Where they differ.
    pub fn compare(&self, artefact: &str, hash: &str) -> Result<()> {
        println!("{artefact}: four-bar after 20 ms has the hash {hash}");
        let mut first = self.first.borrow_mut();
        let (other, expected) = first.get_or_insert_with(|| (artefact.to_owned(), hash.to_owned()));
        if hash != expected {
            bail!("{artefact} has {hash}, {other} {expected}");
        }
        Ok(())
    }

    /// Where it works.
    pub fn work(&self) -> PathBuf {
        self.folder.join("work")
    }

    /// Where its cargo keeps settings and installed programs.
    pub fn cargo_home(&self) -> PathBuf {
        self.folder.join("cargo")
    }

    /// A command in its working folder.
    pub fn command(&self, name: impl AsRef<OsStr>) -> Command {
        let mut command = Command::new(name);
        command.current_dir(self.work()).stdin(Stdio::null());
        self.clear(&mut command);
        command
    }

    /// Gives a command the environment of the stranger.
    pub fn clear(&self, command: &mut Command) {
        command.env_clear();
        for name in KEPT {
            if let Some(value) = std::env::var_os(name) {
                command.env(name, value);
            }
        }
        if let (None, Some(home)) = (std::env::var_os("RUSTUP_HOME"), std::env::home_dir()) {
            command.env("RUSTUP_HOME", home.join(".rustup"));
        }
        command.env("HOME", &self.folder).env("CARGO_HOME", self.cargo_home());
        command.env("CARGO_TARGET_DIR", self.folder.join("target"));
    }
}

impl Drop for Stranger {
    fn drop(&mut self) {
        let _ = fs::remove_dir_all(&self.folder);
    }
}

/// The text between two others in what a program printed, or in a file.
pub fn between<'t>(text: &'t str, before: &str, after: &str) -> Option<&'t str> {
    text.split_once(before)?.1.split_once(after).map(|(inner, _)| inner.trim())
}

/// The state hash in a run's `summary.json`.
///
/// # Errors
/// Where the file or its hash is missing.
pub fn hash_of(summary: &Path) -> Result<String> {
    let text = fs::read_to_string(summary)
        .with_context(|| format!("cannot read {}", summary.display()))?;
    let hash = between(&text, "\"state_hash\": \"", "\"");
    Ok(hash.context("the summary has no state_hash")?.to_owned())
}
