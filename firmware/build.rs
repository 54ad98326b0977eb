//! Const models of the shipped scenes, and link arguments of the target's programs.
//!
//! `scenes/*.toml => models.rs`: one module per scene and the macro `shipped` that lists them.
//! Link arguments stand here and not in a configuration, so that RUSTFLAGS in the environment
//! cannot lose them; a host build gets none.

use std::path::{Path, PathBuf};

use dbd_scene::{Scene, SceneError, export};

/// The shipped scenes: files of `scenes/`, each of which gives its step.
const SCENES: [&str; 1] = ["four-bar"];
/// Linked from its own entry without start-up code: see its head.
const AUDIT: &str = "audit";

fn main() {
    let root = Path::new(env!("CARGO_MANIFEST_DIR")).parent().expect("the repository's root");
    println!("cargo:rerun-if-changed=build.rs");
    models(root);
    if std::env::var("CARGO_CFG_TARGET_OS").as_deref() == Ok("none") {
        link_arguments(root);
    }
}

fn models(root: &Path) {
    let mut modules = String::new();
    let mut lines = String::new();
    for name in SCENES {
        let file = format!("scenes/{name}.toml");
        println!("cargo:rerun-if-changed={}", root.join(&file).display());
        let text = std::fs::read_to_string(root.join(&file));
        let text = text.unwrap_or_else(|error| refuse(&format!("{file}: {error}")));
        let scene = Scene::parse(&text, &file).unwrap_or_else(|error| refuse(&place(&error)));
        let Some(step) = scene.step else {
            refuse(&format!("{file}: a scene for the firmware gives its `step`"));
        };
        let (preamble, f32, f64) = (
            export::preamble(&scene, step),
            export::model::<f32>(&scene),
            export::model::<f64>(&scene),
        );
        let constant = export::constant_name(name);
        let (module, model) = (constant.to_lowercase(), export::type_name(name));
        modules +=
            &format!("/// The scene `{name}`.\npub mod {module} {{\n{preamble}{f32}{f64}}}\n");
        lines += &format!(
            "            {module} \"{name}\" {constant}_STEP, \
             {constant}_F32: {model}F32, {constant}_F64: {model}F64;\n"
        );
    }
    let list = format!(
        "/// Calls a macro with all shipped models: module, name, step, static and type per precision.\n\
         #[macro_export]\n\
         macro_rules! shipped {{\n    \
             ($then:path) => {{\n        \
                 $then! {{\n{lines}        }}\n    \
             }};\n\
         }}\n"
    );
    let out = PathBuf::from(std::env::var_os("OUT_DIR").expect("cargo sets OUT_DIR"));
    std::fs::write(out.join("models.rs"), modules + &list).expect("OUT_DIR can be written");
}

/// Where in the scene the error lies, what it is and what would be right.
fn place(error: &SceneError) -> String {
    let position = match (error.line(), error.column()) {
        (Some(line), Some(column)) => format!(":{line}:{column}"),
        _ => String::new(),
    };
    format!("{}{position}: {} ({})", error.file(), error.message(), error.help())
}

/// Fails the build with one line that cargo shows.
fn refuse(message: &str) -> ! {
    println!("cargo::error={}", message.replace('\n', " "));
    std::process::exit(1)
}

fn link_arguments(root: &Path) {
    println!("cargo:rerun-if-changed={}", root.join("memory.x").display());
    println!("cargo:rerun-if-changed=src/bin");
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
