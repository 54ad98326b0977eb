//! Const models of the scenes that the programs step, and link arguments.
//!
//! `scenes/*.toml => SCENE.rs; memory.x => link.x's search path`. A scene with an error fails the build with file,
//! line and column.

use std::path::{Path, PathBuf};

use dbd_scene::{Scene, SceneError, export};

/// Files of the repository's `scenes/`, each of which gives its step.
const SCENES: [&str; 2] = ["four-bar", "cart-pendulum"];

fn main() {
    let set = |name| std::env::var_os(name).unwrap_or_else(|| panic!("cargo sets {name}"));
    let (here, out) = (PathBuf::from(set("CARGO_MANIFEST_DIR")), PathBuf::from(set("OUT_DIR")));
    for name in SCENES {
        let file = here.join("../../scenes").join(name).with_extension("toml");
        println!("cargo:rerun-if-changed={}", file.display());
        let source = model(&file).unwrap_or_else(|message| {
            println!("cargo::error={}", message.replace('\n', " "));
            std::process::exit(1)
        });
        std::fs::write(out.join(name).with_extension("rs"), source)
            .expect("OUT_DIR can be written");
    }
    println!("cargo:rerun-if-changed=build.rs");
    println!("cargo:rerun-if-changed=memory.x");
    println!("cargo:rustc-link-search={}", here.display());
    for argument in ["-Tlink.x", "--nmagic"] {
        println!("cargo:rustc-link-arg-bins={argument}");
    }
}

/// The scene's model in single precision as source.
fn model(file: &Path) -> Result<String, String> {
    let name = file.display().to_string();
    let text = std::fs::read_to_string(file).map_err(|error| format!("{name}: {error}"))?;
    let scene = Scene::parse(&text, &name).map_err(|error| place(&error))?;
    let step = scene.step.ok_or_else(|| format!("{name}: a scene for a board gives its `step`"))?;
    Ok(export::preamble(&scene, step) + &export::model::<f32>(&scene))
}

/// Where in the scene the error lies, what it is and what would be right.
fn place(error: &SceneError) -> String {
    let position = match (error.line(), error.column()) {
        (Some(line), Some(column)) => format!(":{line}:{column}"),
        _ => String::new(),
    };
    format!("{}{position}: {} ({})", error.file(), error.message(), error.help())
}
