//! The sources that users run, as syntax.

use std::fs;
use std::path::{Path, PathBuf};

/// The folders whose programs and libraries speak to users.
const FOLDERS: [&str; 8] = [
    "kernel/src",
    "crates",
    "host-sim/src",
    "python/src",
    "firmware/qemu/src",
    "firmware/stm32f405/src",
    "xtask/src",
    "host-sim/build.rs",
];

/// The root of the project.
pub fn root() -> PathBuf {
    Path::new(env!("CARGO_MANIFEST_DIR")).join("..")
}

/// The sources by their path from the root, in order, without tests.
pub fn sources() -> Vec<(String, String)> {
    let mut files = Vec::new();
    for folder in FOLDERS {
        walk(&root().join(folder), folder, &mut files);
    }
    assert!(files.len() > 500, "{} sources", files.len());
    files
}

fn walk(path: &Path, name: &str, files: &mut Vec<(String, String)>) {
    if path.is_file() {
        if Path::new(name).extension().is_some_and(|extension| extension == "rs") {
            files.push((name.into(), fs::read_to_string(path).unwrap()));
        }
        return;
    }
    let mut entries: Vec<_> = fs::read_dir(path).unwrap().map(|entry| entry.unwrap()).collect();
    entries.sort_by_key(fs::DirEntry::file_name);
    for entry in entries {
        let part = entry.file_name().into_string().unwrap();
        if !["tests", "tests.rs", "target", "examples"].contains(&part.as_str()) {
            walk(&entry.path(), &format!("{name}/{part}"), files);
        }
    }
}
