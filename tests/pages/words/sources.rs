//! The sources that users run, as syntax.

use std::fs;
use std::path::Path;

use dbd_tests::results::path;

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

/// The sources by their path from the root, in order, without tests.
pub fn sources() -> Vec<(String, String)> {
    let mut files = Vec::new();
    for folder in FOLDERS {
        files.extend(sources_below(folder));
    }
    assert!(files.len() > 500, "{} sources", files.len());
    files
}

/// The sources of one folder, or of one file, likewise.
pub fn sources_below(name: &str) -> Vec<(String, String)> {
    let mut files = Vec::new();
    walk(&path(name), name, &mut files);
    files
}

/// The documentation among attributes, its lines joined.
pub fn documentation(attributes: &[syn::Attribute]) -> String {
    let lines = attributes.iter().filter_map(|attribute| {
        let syn::Meta::NameValue(pair) = &attribute.meta else { return None };
        let syn::Expr::Lit(syn::ExprLit { lit: syn::Lit::Str(text), .. }) = &pair.value else {
            return None;
        };
        pair.path.is_ident("doc").then(|| text.value())
    });
    lines.collect()
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
