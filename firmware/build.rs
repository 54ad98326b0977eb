//! Link arguments of the target's programs.
//!
//! They stand here and not in a configuration, so that RUSTFLAGS in the environment cannot lose
//! them. A host build gets none.

use std::path::Path;

/// Linked from its own entry without start-up code: see its head.
const AUDIT: &str = "audit";

fn main() {
    let root = Path::new(env!("CARGO_MANIFEST_DIR")).parent().expect("the repository's root");
    println!("cargo:rerun-if-changed=build.rs");
    println!("cargo:rerun-if-changed={}", root.join("memory.x").display());
    println!("cargo:rerun-if-changed=src/bin");
    if std::env::var("CARGO_CFG_TARGET_OS").as_deref() != Ok("none") {
        return;
    }
    // Where link.x finds memory.x.
    println!("cargo:rustc-link-search={}", root.display());
    for program in programs() {
        let arguments: &[&str] = if program == AUDIT {
            &["--entry=audit_roots", "--gc-sections"]
        } else {
            &["-Tlink.x", "-Tdefmt.x", "--nmagic"]
        };
        for argument in arguments {
            println!("cargo:rustc-link-arg-bin={program}={argument}");
        }
    }
}

fn programs() -> Vec<String> {
    let files = std::fs::read_dir("src/bin").expect("src/bin");
    files.filter_map(|file| file.ok()?.path().file_stem()?.to_str().map(str::to_owned)).collect()
}
