//! Const models of the shipped scenes, and link arguments of the target's programs.
//!
//! `scenes/*.toml => SCENE.rs`, and `models.rs`: one module per scene and the macros `shipped`, `shipped_f32`,
//! `charted`, `fixed`, `solved`, `solved_double`, `solved_fixed` and `varied` that list them.
//! Link arguments stand here and not in a configuration, so that RUSTFLAGS in the environment
//! cannot lose them; a host build gets none.

#[path = "../../host-sim/templates/laws/cam.rs.in"]
mod cam;
#[path = "../../host-sim/templates/laws/drag.rs.in"]
mod drag;

use std::path::{Path, PathBuf};

use dbd_scene::{Build, export};

/// Scenes that ship in both precisions: files of `scenes/`, each of which gives its step.
const SCENES: &[&str] = &["four-bar"];
/// Scenes that ship in single precision.
const SCENES_F32: &[&str] = &[
    "3rrr",
    "3rrr-1",
    "3rrr-2",
    "3ruu",
    "3ruu-1",
    "3ruu-2",
    "cart-pendulum",
    "chain-closed",
    "chain-open-30",
    "chain-open-60",
    "crank-slider",
    "double-wishbone",
    "five-bar-a",
    "five-bar-b",
    "gripper",
    "gyroscope",
    "hanging-chain",
    "hexagon",
    "six-bar",
    "spring-ball",
];
/// Scenes in single precision whose inputs a controller drives: the tables that drive them in the
/// scene are left out, and they are in none of the lists that macros go through.
const CONTROLLED: &[&str] = &["delta-pick-and-place"];
/// Scenes of `SCENES_F32` whose steps are counted with every scheme in both precisions.
const CHARTED: &[&str] = &[
    "3rrr",
    "3ruu",
    "crank-slider",
    "double-wishbone",
    "five-bar-a",
    "five-bar-b",
    "hexagon",
    "six-bar",
];
/// Scenes whose steps are counted with other values, too, in single precision: the scene, what its name
/// gets behind it, the changes.
const VARIED: &[(&str, &str, &[&str])] = &[
    ("3ruu", "bushing", &["realisation=bushing"]),
    ("hexagon", "bushing", &["realisation=bushing"]),
    ("hexagon", "damped", &["joint.*.damping=30"]),
    ("hexagon", "planar", &["planar=true"]),
    ("hexagon", "planar-bushing", &["planar=true", "realisation=bushing"]),
];
/// Scenes whose steps with the scheme generalized-alpha are counted, in the precisions that are counted of the
/// other schemes: the scene, what its name gets behind it, the changes, the precisions.
const SOLVED: &[(&str, &str, &[&str], &[&str])] = &[
    ("four-bar", "", &[], &["f32", "f64", "fixed"]),
    ("five-bar-a", "", &[], &["f32", "f64"]),
    ("five-bar-b", "", &[], &["f32", "f64"]),
    ("six-bar", "", &[], &["f32", "f64", "fixed"]),
    ("six-bar", "-planar", &["planar=true"], &["f32"]),
    ("3rrr", "", &[], &["f32", "f64"]),
    ("crank-slider", "", &[], &["f32", "f64"]),
    ("3ruu", "", &[], &["f32", "f64", "fixed"]),
    ("hexagon", "", &[], &["f32", "f64"]),
    ("double-wishbone", "", &[], &["f32", "f64"]),
    ("gripper", "", &[], &["f32"]),
];
/// Elements that do not exist in the plane, or not with these values.
const SPATIAL: &[&str] = &["bushing-matrix"];
/// The golden hashes of scenes with laws.
const LAWS: &str = "../../tests/bits/laws.csv";
/// The scene of the project that `host-sim new laws` writes, with laws of its own.
const OWN: &str = "drop";
const DROP: &str = "../../host-sim/templates/laws/drop.toml.in";
/// Linked from its own entry without start-up code: see its head.
const AUDIT: &str = "audit";

fn main() {
    let here = std::env::var_os("CARGO_MANIFEST_DIR").expect("cargo sets CARGO_MANIFEST_DIR");
    let root = Path::new(&here).ancestors().nth(2).expect("the repository's root");
    println!("cargo:rerun-if-changed=build.rs");
    models();
    if std::env::var_os("CARGO_FEATURE_ELEMENTS").is_some() {
        elements();
    }
    if std::env::var_os("CARGO_FEATURE_LAWS").is_some() {
        laws();
    }
    if std::env::var("CARGO_CFG_TARGET_OS").as_deref() == Ok("none") {
        link_arguments(root);
    }
}

fn models() {
    let [mut modules, mut both, mut f32, mut charted] = [const { String::new() }; 4];
    let mut fixed = String::new();
    let all = SCENES.iter().map(|name| (name, true));
    for (name, double) in all.chain(SCENES_F32.iter().map(|name| (name, false))) {
        let counted = CHARTED.contains(name);
        let mut build = Build::scene(format!("../../scenes/{name}.toml")).precision("f32");
        if double || counted {
            build = build.precision("f64").precision("fixed");
        }
        let source = source(&build);
        let constant = export::constant_name(name);
        let (module, model) = (constant.to_lowercase(), export::type_name(name));
        let single = format!("{module} \"{name}\" {constant}_STEP, {constant}_F32: {model}F32");
        write(&build.file_name(), &source);
        let line = format!("            {single}, {constant}_F64: {model}F64;\n");
        if double {
            both += &line;
        } else {
            f32 += &format!("            {single};\n");
        }
        if counted {
            charted += &line;
        }
        if double || counted {
            fixed += &format!(
                "            {module} \"{name}\" {constant}_STEP, {constant}_FIXED: {model}Fixed;\n"
            );
        }
        modules += &format!("/// The scene `{name}`.\npub mod {module} {{\n{source}}}\n");
    }
    let mut varied = String::new();
    for (scene, variant, changes) in VARIED {
        let name = format!("{scene}-{variant}");
        let file = format!("../../scenes/{scene}.toml");
        let build = changes.iter().fold(Build::scene(file), |build, change| build.set(change));
        let source = source(&build.precision("f32"));
        let module = export::constant_name(&name).to_lowercase();
        let (constant, model) = (export::constant_name(scene), export::type_name(scene));
        varied += &format!(
            "            {module} \"{name}\" {constant}_STEP, {constant}_F32: {model}F32;\n"
        );
        modules += &format!(
            "/// The scene `{scene}` with other values.\npub mod {module} {{\n{source}}}\n"
        );
    }
    let mut solved = [const { String::new() }; 3];
    for (scene, variant, changes, precisions) in SOLVED {
        let name = format!("{scene}{variant}");
        let file = format!("../../scenes/{scene}.toml");
        let build = changes.iter().fold(Build::scene(file), |build, change| build.set(change));
        let build = precisions.iter().fold(build, |build, precision| build.precision(precision));
        let source = source(&build.scheme("generalized-alpha").step("1ms"));
        let module = export::constant_name(&name).to_lowercase() + "_solved";
        let (constant, model) = (export::constant_name(scene), export::type_name(scene));
        for (list, suffix) in solved.iter_mut().zip(["F32", "F64", "Fixed"]) {
            if precisions.contains(&suffix.to_lowercase().as_str()) {
                let capitals = suffix.to_uppercase();
                *list += &format!(
                    "            {module} \"{name}\" {constant}_STEP, \
                     {constant}_PLANNED_{capitals}: {model}Planned{suffix} of {model}{suffix};\n"
                );
            }
        }
        modules += &format!(
            "/// The scene `{name}` with the plan of a matrix.\npub mod {module} {{\n{source}}}\n"
        );
    }
    for name in CONTROLLED {
        let build = Build::scene(format!("../../scenes/{name}.toml")).without_tables();
        let (module, source) = (export::constant_name(name).to_lowercase(), source(&build));
        modules += &format!(
            "/// The scene `{name}` without its tables.\npub mod {module} {{\n{source}}}\n"
        );
    }
    let source = modules
        + &list("shipped", "shipped in both precisions", &both)
        + &list("shipped_f32", "shipped in single precision", &f32)
        + &list("charted", "of those that are counted in both", &charted)
        + &list("fixed", "in fixed point", &fixed)
        + &list("solved", "with the plan of a matrix", &solved[0])
        + &list("solved_double", "with the plan of a matrix in double precision", &solved[1])
        + &list("solved_fixed", "with the plan of a matrix in fixed point", &solved[2])
        + &list("varied", "of scenes with other values", &varied);
    write("models.rs", &source);
}

/// Models of the plain scene of `elements/`, and of it with each element, in space and in the plane, in single precision;
/// the macro `elements`.
fn elements() {
    println!("cargo:rerun-if-changed=elements");
    let out = PathBuf::from(std::env::var_os("OUT_DIR").expect("cargo sets OUT_DIR"));
    let mut files: Vec<PathBuf> = std::fs::read_dir("elements")
        .and_then(|files| files.map(|file| file.map(|file| file.path())).collect())
        .expect("the folder elements");
    files.sort();
    let read = |file: &Path| std::fs::read_to_string(file).expect("a file of elements");
    let plain = read(Path::new("elements/plain.toml"));
    let (mut modules, mut lines) = (String::new(), String::new());
    for file in &files {
        let name = file.file_stem().and_then(|stem| stem.to_str()).expect("a name");
        let more = if name == "plain" { String::new() } else { read(file) };
        write(&format!("{name}.toml"), &(plain.clone() + &more));
        let build = Build::scene(out.join(name).with_extension("toml")).precision("f32");
        let planar = (!SPATIAL.contains(&name))
            .then(|| (format!("{name}-planar"), build.clone().set("planar=true")));
        for (name, build) in [(name.to_owned(), build)].into_iter().chain(planar) {
            let (module, source) = (export::constant_name(&name).to_lowercase(), source(&build));
            modules += &format!("/// The scene with `{name}`.\npub mod {module} {{\n{source}}}\n");
            lines += &format!(
                "            {module} \"{name}\" ELEMENTS_STEP, ELEMENTS_F32: ElementsF32;\n"
            );
        }
    }
    write("elements.rs", &(modules + &list("elements", "of an element", &lines)));
}

/// Models of the scenes with golden hashes of laws that the target has room and time for; the macro `lawful`: those of
/// `tests/fuzz/corpus/scene` and of the project that `host-sim new laws` writes, in double precision for few steps, and
/// the examples in the plane in single precision.
fn laws() {
    println!("cargo:rerun-if-changed={LAWS}");
    println!("cargo:rerun-if-changed={DROP}");
    let golden = std::fs::read_to_string(LAWS).expect("the golden hashes of laws");
    let (mut modules, mut lines) = (String::new(), String::new());
    for row in golden.lines().skip(1) {
        let columns: Vec<&str> = row.split(',').collect();
        let &[name, _, precision, step, steps, _] = &columns[..] else { panic!("a row of {LAWS}") };
        let out = PathBuf::from(std::env::var_os("OUT_DIR").expect("cargo sets OUT_DIR"));
        let together = match name {
            OWN => out.join("drop.toml"),
            _ => PathBuf::from(format!("../../tests/fuzz/corpus/scene/{name}.toml")),
        };
        if name == OWN {
            write("drop.toml", &std::fs::read_to_string(DROP).expect("the scene of a project"));
        }
        let build = match name.strip_suffix("-planar") {
            Some(name) if precision == "f32" => {
                Build::scene(format!("../../docs/examples/{name}/{name}.toml")).set("planar=true")
            }
            None if together.exists() && (precision != "f64" || steps == "100") => {
                let build = Build::scene(together).law::<drag::Drag>("crate::own::Drag");
                build.law::<cam::Cam>("crate::own::Cam")
            }
            _ => continue,
        };
        let build = build.step(step).precision(precision);
        let module = export::constant_name(&format!("{name}-{precision}")).to_lowercase();
        let constant = export::constant_name(build.file_name().trim_end_matches(".rs"));
        let (source, precision) = (source(&build), precision.to_uppercase());
        modules += &format!("/// The scene `{name}`.\npub mod {module} {{\n{source}}}\n");
        lines += &format!(
            "            {module} \"{name}\" {constant}_STEP {steps}, {constant}_{precision};\n"
        );
    }
    write("laws.rs", &(modules + &list("lawful", "with laws", &lines)));
}

/// A macro that calls another with all models of a list.
fn list(name: &str, of: &str, lines: &str) -> String {
    format!(
        "/// Calls a macro with all models {of}: module, name, step, static and type.\n\
         #[macro_export]\n\
         macro_rules! {name} {{\n    \
             ($then:path) => {{\n        \
                 $then! {{\n{lines}        }}\n    \
             }};\n\
         }}\n"
    )
}

/// The source of a scene; where there is none, cargo is told why.
fn source(build: &Build) -> String {
    let out = std::env::var("OUT_DIR").expect("cargo sets OUT_DIR");
    // Cargo would take a scene that this script writes for changed in every build.
    if !build.watched().contains(&out) {
        println!("{}", build.watched());
    }
    let built = build.source().unwrap_or_else(|error| {
        println!("{}", error.line());
        std::process::exit(1)
    });
    built.source
}

fn write(name: &str, source: &str) {
    let out = PathBuf::from(std::env::var_os("OUT_DIR").expect("cargo sets OUT_DIR"));
    std::fs::write(out.join(name), source).expect("OUT_DIR can be written");
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
