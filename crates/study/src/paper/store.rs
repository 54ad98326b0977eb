//! Cached findings: a file per item, valid for its build and scenes.
//!
//! `(folder, item, scenes) => finding`. A file is written completely or not at all: an interrupted call continues with
//! its last item.

use std::fs;
use std::hash::{DefaultHasher, Hash as _, Hasher as _};
use std::io;
use std::path::Path;

use dbd_report::output::file;
use serde::{Deserialize, Serialize};

use crate::cache::build;
use crate::paper::Finding;
use crate::paper::Item;
use crate::paper::context::Scenes;

#[derive(Serialize, Deserialize)]
struct Kept {
    key: String,
    finding: Finding,
}

/// The key of an item in this build with these scenes.
#[must_use]
pub fn key(item: &Item, scenes: &Scenes<'_>) -> String {
    let mut hash = DefaultHasher::new();
    (item.name, build()).hash(&mut hash);
    for name in item.scenes {
        format!("{:?}", scenes(name)).hash(&mut hash);
    }
    format!("{:016x}", hash.finish())
}

fn name(item: &Item) -> String {
    format!("{}.json", item.name)
}

/// The cached finding of an item under a key; `None` if missing, damaged or of another build.
#[must_use]
pub fn kept(folder: &Path, item: &Item, key: &str) -> Option<Finding> {
    let text = fs::read_to_string(folder.join(name(item))).ok()?;
    let kept: Kept = serde_json::from_str(&text).ok()?;
    (kept.key == key).then_some(kept.finding)
}

/// Keeps a finding.
///
/// # Errors
/// Where the folder cannot be written to.
pub fn keep(folder: &Path, item: &Item, key: &str, finding: &Finding) -> io::Result<()> {
    let kept = Kept { key: key.into(), finding: finding.clone() };
    let text = serde_json::to_string_pretty(&kept).map_err(io::Error::other)?;
    file::write(folder, &name(item), &text)
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::paper::Row;
    use crate::paper::item;

    #[test]
    fn a_finding_is_found_again_under_its_key_alone() {
        let folder = tempfile::tempdir().unwrap();
        let item = item("table-7a").unwrap();
        let rows = vec![Row::extra("x", "m", 0.1 + 0.2)];
        let finding = Finding { rows, ..Finding::default() };
        assert_eq!(kept(folder.path(), item, "1"), None);
        keep(folder.path(), item, "1", &finding).unwrap();
        assert_eq!(kept(folder.path(), item, "1"), Some(finding));
        assert_eq!(kept(folder.path(), item, "2"), None);
        fs::write(folder.path().join("table-7a.json"), "{").unwrap();
        assert_eq!(kept(folder.path(), item, "1"), None);
    }
}
