//! Puts the scenes that ship into the program.
//!
//! `scenes/*.toml => OUT_DIR/scenes.rs`: an array of names and texts, by name. `include_dir` would do
//! it as well but for a scene that is added later: cargo would not hear of it.

use std::env;
use std::fmt::Write as _;
use std::fs;
use std::io;
use std::path::Path;

fn main() -> io::Result<()> {
    let variable = |name| env::var_os(name).ok_or_else(|| io::Error::other("cargo runs this"));
    // A link to those of the repository, and theirs in what is published.
    let folder = Path::new(&variable("CARGO_MANIFEST_DIR")?).join("scenes").canonicalize()?;
    println!("cargo::rerun-if-changed={}", folder.display());
    let mut files = Vec::new();
    for entry in fs::read_dir(folder)? {
        files.push(entry?.path());
    }
    files.retain(|file| file.extension().is_some_and(|extension| extension == "toml"));
    files.sort();
    let mut text = format!("[(&str, &str); {}] = [\n", files.len());
    for file in &files {
        let name = file.file_stem().unwrap_or_default().to_string_lossy();
        let _ = writeln!(text, "    ({name:?}, include_str!({:?})),", file.to_string_lossy());
    }
    let source =
        format!("/// Names and texts of the scenes that ship.\npub static SCENES: {text}];\n");
    fs::write(Path::new(&variable("OUT_DIR")?).join("scenes.rs"), source)
}
