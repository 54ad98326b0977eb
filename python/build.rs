//! Puts the scenes that ship into the module, and says how it links.
//!
//! `scenes/*.toml => OUT_DIR/scenes.rs`: an array of names and texts, by name. macOS links an extension module only where
//! it is said that the interpreter brings Python's symbols. maturin says it for the crate that it builds; cargo also
//! links this one where a user's crate depends on it.

use std::ffi::OsString;
use std::fmt::Write as _;
use std::path::Path;
use std::{env, fs, io};

fn main() -> io::Result<()> {
    pyo3_build_config::add_extension_module_link_args();
    let folder = Path::new(&set("CARGO_MANIFEST_DIR")?).join("../scenes").canonicalize()?;
    println!("cargo::rerun-if-changed={}", folder.display());
    let mut files = Vec::new();
    for entry in fs::read_dir(folder)? {
        files.push(entry?.path());
    }
    files.retain(|file| file.extension().is_some_and(|extension| extension == "toml"));
    files.sort_by(|a, b| a.file_stem().cmp(&b.file_stem()));
    let mut text = "[\n".to_owned();
    for file in &files {
        let name = file.file_stem().unwrap_or_default().to_string_lossy();
        let _ = writeln!(text, "    ({name:?}, include_str!({:?})),", file.to_string_lossy());
    }
    fs::write(Path::new(&set("OUT_DIR")?).join("scenes.rs"), text + "]\n")
}

/// What cargo sets when the script runs: two checkouts with one target folder share the program.
fn set(name: &str) -> io::Result<OsString> {
    env::var_os(name).ok_or_else(|| io::Error::other(format!("cargo sets {name}")))
}
