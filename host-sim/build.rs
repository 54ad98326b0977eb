//! Embeds the shipped scenes and a hash of the sources, part of the key of sweep rows, into the program.
//!
//! `scenes/*.toml => OUT_DIR/scenes.rs`: an array of names and texts, by name. `include_dir` would not
//! make cargo detect scenes that are added later. `sources => DBD_SOURCES`: a hash of
//! all sources that affect results, in the repository; empty in a published crate, whose version suffices.

use std::env;
use std::fmt::Write as _;
use std::fs;
use std::io;
use std::path::{Path, PathBuf};

/// Folders and files of the repository whose sources affect the rows of a sweep.
const COMPUTING: [&str; 8] = [
    "kernel/src",
    "crates/scene/src",
    "crates/plant/src",
    "crates/study/src/sweep",
    "host-sim/src/simulate",
    "host-sim/src/report",
    "host-sim/src/commands/run.rs",
    "host-sim/src/commands/sweep",
];

fn main() -> io::Result<()> {
    let variable = |name| {
        env::var_os(name).ok_or_else(|| io::Error::other("this build script must be run by cargo"))
    };
    // A link to those of the repository, and a copy in the published crate.
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
        format!("/// Names and texts of the shipped scenes.\npub static SCENES: {text}];\n");
    fs::write(Path::new(&variable("OUT_DIR")?).join("scenes.rs"), source)?;
    println!(
        "cargo::rustc-env=DBD_SOURCES={}",
        sources(Path::new(&variable("CARGO_MANIFEST_DIR")?))?
    );
    Ok(())
}

/// FNV-1a 64 of all sources that affect results; empty outside the repository.
fn sources(own: &Path) -> io::Result<String> {
    let Some(root) = own.parent().filter(|root| root.join("kernel/src/lib.rs").exists()) else {
        return Ok(String::new());
    };
    let mut files = Vec::new();
    for folder in COMPUTING {
        println!("cargo::rerun-if-changed={}", root.join(folder).display());
        list(&root.join(folder), &mut files)?;
    }
    files.sort();
    let mut hash = 0xcbf2_9ce4_8422_2325_u64;
    for file in files {
        for byte in fs::read(file)? {
            hash = (hash ^ u64::from(byte)).wrapping_mul(0x0000_0100_0000_01b3);
        }
    }
    Ok(format!("+{hash:016x}"))
}

fn list(path: &Path, into: &mut Vec<PathBuf>) -> io::Result<()> {
    if !path.is_dir() {
        into.push(path.to_owned());
        return Ok(());
    }
    fs::read_dir(path)?.try_for_each(|entry| list(&entry?.path(), into))
}
