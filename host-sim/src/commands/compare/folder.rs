//! The folder of a comparison: `OUT/compare/NAME`, named after the difference of the two runs' paths.
//!
//! The report of two other runs is replaced only with --overwrite: `compare.json` names its runs.

use std::path::{Component, Path, PathBuf};

use dbd_report::output::file;
use dbd_scene::file::read_text;
use serde::Deserialize;

use crate::commands::compare::record::whole;
use crate::commands::folder::FolderError;

/// The file that marks the report complete.
pub const SEAL: &str = "compare.json";

/// The page.
pub const PAGE: &str = "report.html";

/// The destination of a comparison.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct Place {
    out: PathBuf,
    name: String,
    /// The files of A and B.
    files: [String; 2],
    overwrite: bool,
}

/// The runs of a comparison.
#[derive(Deserialize)]
struct Owner {
    a: Of,
    b: Of,
}

#[derive(Deserialize)]
struct Of {
    path: String,
}

impl Place {
    /// That of two runs, by what the user calls them and the files that hold their samples.
    #[must_use]
    pub fn of(out: &Path, called: [&Path; 2], files: [&Path; 2], overwrite: bool) -> Self {
        let name = name(called.map(parts));
        Self { out: out.join("compare"), name, files: files.map(whole), overwrite }
    }

    /// The folder, made where it is not there yet.
    ///
    /// # Errors
    /// Where it cannot be made or written to, or holds the report of two other runs.
    pub fn folder(&self) -> Result<PathBuf, FolderError> {
        let wanted = self.out.join(&self.name);
        let failed = |reason| FolderError::Unwritable { folder: wanted.clone(), reason };
        let folder = file::folder(&self.out, &self.name).map_err(failed)?;
        file::sweep(&folder, &[SEAL, PAGE, "writable"]);
        self.claim(&folder)?;
        Ok(folder)
    }

    /// Checks that a folder has no report of two other runs, unless it is to be replaced.
    ///
    /// # Errors
    /// If it has one.
    pub fn claim(&self, folder: &Path) -> Result<(), FolderError> {
        let owner = read_text(folder.join(SEAL)).ok();
        let owner = owner.and_then(|text| serde_json::from_str::<Owner>(&text).ok());
        match owner.map(|owner| [owner.a.path, owner.b.path]) {
            Some(files) if files != self.files && !self.overwrite => {
                let other = files.join(" and ");
                Err(FolderError::Taken { folder: folder.to_owned(), other })
            }
            _ => Ok(()),
        }
    }
}

/// The components of a run's path, the last first: its folder, or a golden file without its extension.
fn parts(called: &Path) -> Vec<String> {
    let whole = called.canonicalize().unwrap_or_else(|_| called.to_owned());
    let folder = match whole.extension().and_then(|extension| extension.to_str()) {
        Some("csv" | "json") => whole.parent().map(Path::to_owned).unwrap_or_default(),
        Some(_) if whole.is_file() => whole.with_extension(""),
        _ => whole,
    };
    let names = folder.components().rev().filter_map(|part| match part {
        Component::Normal(name) => Some(name.to_string_lossy().into_owned()),
        _ => None,
    });
    names.collect()
}

/// A name from the common end of two paths and their difference.
fn name([a, b]: [Vec<String>; 2]) -> String {
    let shared = a.iter().zip(&b).take_while(|(a, b)| a == b).count();
    let apart = |of: &[String]| of.get(shared).cloned();
    let ends = [apart(&a), apart(&b)].into_iter().flatten().collect::<Vec<_>>().join("-and-");
    match a.first().filter(|_| shared > 0) {
        Some(last) if ends.is_empty() => last.clone(),
        Some(last) => format!("{last}-{ends}"),
        None => ends,
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_folder_is_named_after_what_tells_two_runs_apart() {
        let of = |a: &str, b: &str| name([a, b].map(|path| parts(Path::new(path))));
        assert_eq!(of("/out/four-bar", "/out/chip.golden/"), "four-bar-and-chip.golden");
        assert_eq!(of("/out/four-bar", "/out/six-bar"), "four-bar-and-six-bar");
        assert_eq!(of("/out/a/arm/trace.csv", "/out/b/arm"), "arm-a-and-b");
        assert_eq!(of("/out/a/arm", "/out/a/arm/summary.json"), "arm");
        assert_eq!(of("/x/run/arm", "/y/run/arm"), "arm-x-and-y");
    }
}
