//! The folder in which commands run, and what lies in it.

use std::cell::RefCell;
use std::fs;
use std::io;
use std::path::{Path, PathBuf};
use std::time::SystemTime;

use tempfile::TempDir;

use crate::target::Finding;

/// The scene file of an input.
pub const SCENE: &str = "scene.toml";

/// A folder with a scene, a file, a folder and another scene's results; the current folder of this
/// process. It lies within one that holds nothing else: `..` is looked at, too.
pub struct Folder {
    outer: TempDir,
    inner: PathBuf,
    clean: bool,
}

/// What lies in a folder: paths, lengths and times.
pub type Listing = Vec<(PathBuf, u64, Option<SystemTime>)>;

thread_local! {
    static FOLDER: RefCell<Option<Folder>> = const { RefCell::new(None) };
}

/// Does something in this thread's folder.
///
/// # Errors
/// What the action finds; that no folder can be made.
pub fn with<T>(action: impl FnOnce(&mut Folder) -> Result<T, Finding>) -> Result<T, Finding> {
    FOLDER.with(|kept| {
        let mut kept = kept.borrow_mut();
        // Left out while in use: what panics leaves a folder that nobody knows.
        let mut folder = match kept.take() {
            Some(folder) => folder,
            None => Folder::new().map_err(failed)?,
        };
        let done = action(&mut folder);
        *kept = Some(folder);
        done
    })
}

fn failed(error: io::Error) -> Finding {
    Finding::new("there is a folder to work in", error)
}

impl Folder {
    fn new() -> io::Result<Self> {
        let outer = tempfile::Builder::new().prefix("dbd-fuzz-").tempdir()?;
        let inner = outer.path().join("here");
        fs::create_dir(&inner)?;
        std::env::set_current_dir(&inner)?;
        Ok(Self { outer, inner, clean: false })
    }

    /// Where it lies.
    pub fn path(&self) -> &Path {
        &self.inner
    }

    /// What a command changed is brought back before the next.
    pub fn soil(&mut self) {
        self.clean = false;
    }

    /// Makes all as it is to be, with this scene file.
    ///
    /// # Errors
    /// Where it cannot be written.
    pub fn place(&mut self, scene: &[u8]) -> Result<(), Finding> {
        self.lay(scene).map_err(failed)
    }

    fn lay(&mut self, scene: &[u8]) -> io::Result<()> {
        let here = self.inner.as_path();
        if !self.clean {
            empty(here)?;
            empty(self.outer.path())?;
            fs::write(here.join("file"), "neither a scene nor a folder")?;
            fs::create_dir(here.join("folder"))?;
            fs::create_dir_all(here.join("taken/scene"))?;
            let owner = r#"{"scene":"another","scene_file":"built in","scene_hash":"0"}"#;
            fs::write(here.join("taken/scene/summary.json"), owner)?;
            self.clean = true;
        }
        fs::write(here.join(SCENE), scene)
    }

    /// What lies in it now.
    pub fn listing(&self) -> Listing {
        let mut listing = Vec::new();
        list(self.outer.path(), &mut listing);
        listing.sort();
        listing
    }
}

/// Removes what lies in a folder, but not the current one.
fn empty(folder: &Path) -> io::Result<()> {
    for entry in fs::read_dir(folder)? {
        let path = entry?.path();
        if path.ends_with("here") {
            continue;
        }
        if path.is_dir() { fs::remove_dir_all(path)? } else { fs::remove_file(path)? }
    }
    Ok(())
}

fn list(folder: &Path, into: &mut Listing) {
    let Ok(entries) = fs::read_dir(folder) else { return };
    for entry in entries.flatten() {
        let path = entry.path();
        let Ok(known) = entry.metadata() else { continue };
        if known.is_dir() {
            list(&path, into);
            into.push((path, 0, None));
        } else {
            into.push((path, known.len(), known.modified().ok()));
        }
    }
}
