//! `new firmware` and `export`: what is written, and what is refused. That the project builds and
//! runs is a step of `cargo xtask test`.

use std::collections::BTreeSet;
use std::fs;
use std::path::Path;

use dbd_scene::Build;
use host_sim::terminal::Exit;

use crate::{Folder, call};

fn new(folder: &Path, options: &[&str]) -> crate::Done {
    call(&[&["new", "firmware", folder.to_str().unwrap()], options].concat())
}

#[test]
fn a_new_project_is_whole_and_stands_alone() {
    let folder = Folder::new();
    let project = folder.path("my-plant");
    let done = new(&project, &[]);
    assert_eq!((done.exit, done.err.as_str()), (Exit::Done, ""));
    let read = |path: &str| fs::read_to_string(project.join(path)).unwrap();
    let root = Path::new(env!("CARGO_MANIFEST_DIR")).parent().unwrap();
    let shipped = fs::read_to_string(root.join("scenes/cart-pendulum.toml")).unwrap();
    assert_eq!(read("scenes/cart-pendulum.toml"), shipped);
    let manifest: toml::Table = read("Cargo.toml").parse().unwrap();
    assert!(manifest["workspace"].as_table().unwrap().is_empty());
    assert_eq!(manifest["package"]["name"].as_str(), Some("my-plant"));
    let kernel = manifest["dependencies"]["dbd-kernel"]["path"].as_str().unwrap();
    assert!(Path::new(kernel).join("Cargo.toml").is_file());
    let configuration: toml::Table = read(".cargo/config.toml").parse().unwrap();
    let own: toml::Table =
        fs::read_to_string(root.join(".cargo/config.toml")).unwrap().parse().unwrap();
    // The emulator is the one that the firmware of this repository runs in.
    assert_eq!(configuration["target"], own["target"]);
    for sources in ["src/lib.rs", "src/main.rs", "tests/golden.rs", "build.rs"] {
        syn::parse_file(&read(sources)).unwrap_or_else(|error| panic!("{sources}: {error}"));
    }
    for path in ["README.md", "memory.x", ".gitignore"] {
        assert!(!read(path).contains("{{"), "{path}");
    }
    // The bits are those of `run`.
    let last = read("tests/golden.txt").lines().last().unwrap().to_owned();
    let options = ["--precision", "f32", "--damping", "joint-wise", "--duration", "5s"];
    let run = folder.summary("cart-pendulum", &options);
    let bits = format!("{} {}", run["steps"], run["state_hash"].as_str().unwrap());
    assert_eq!(last, bits, "{}", done.out);
    // Nothing is ever overwritten, not even what is empty.
    let again = new(&project, &[]);
    assert_eq!(again.exit, Exit::Refused);
    assert!(again.err.contains("already") && again.err.contains("another name"), "{}", again.err);
    fs::create_dir(folder.path("empty")).unwrap();
    assert_eq!(new(&folder.path("empty"), &[]).exit, Exit::Refused);
}

#[test]
fn a_project_has_what_other_machines_and_editors_need() {
    let folder = Folder::new();
    let files = |name: &str, options: &[&str]| {
        let done = new(&folder.path(name), options);
        assert_eq!((done.exit, done.err.as_str()), (Exit::Done, ""), "{name}");
        let project = folder.path(name);
        move |path: &str| fs::read_to_string(project.join(path)).unwrap()
    };
    let read = files("plant", &["--git", "https://host/dbd.git", "--rev", "v1"]);
    let manifest: toml::Table = read("Cargo.toml").parse().unwrap();
    for (list, name) in [("dependencies", "dbd-kernel"), ("build-dependencies", "dbd-scene")] {
        let from = &manifest[list][name];
        assert_eq!(from["git"].as_str(), Some("https://host/dbd.git"));
        assert_eq!(from["rev"].as_str(), Some("v1"));
    }
    for path in [".github/workflows/test.yml", ".gitlab-ci.yml"] {
        assert!(read(path).contains("- sh check.sh") || read(path).contains("- run: sh check.sh"));
    }
    assert!(read("Dockerfile").contains(r#"CMD ["sh", "check.sh"]"#));
    for path in
        ["devcontainer/devcontainer", "vscode/extensions", "vscode/launch", "vscode/settings"]
    {
        let text = read(&format!(".{path}.json"));
        serde_json::from_str::<serde_json::Value>(&text).unwrap_or_else(|e| panic!("{path}: {e}"));
    }
    let taplo: toml::Table = read(".taplo.toml").parse().unwrap();
    let schema = read(taplo["rule"][0]["schema"]["path"].as_str().unwrap());
    assert_eq!(schema, call(&["schema"]).out);
    assert!(read("Embed.toml").parse::<toml::Table>().is_ok());
    // Where the crates are in a folder of this machine, files for others say so.
    let note = "in a folder of one machine";
    let local = files("local", &[]);
    for path in [".github/workflows/test.yml", ".gitlab-ci.yml", "Dockerfile", "check.sh"] {
        assert!(!read(path).contains(note) && !read(path).contains("{{"), "{path}");
        assert_eq!(local(path).contains(note), path != "check.sh", "{path}");
    }
    let both = new(&folder.path("both"), &["--git", "x", "--registry"]);
    assert_eq!(both.exit, Exit::Refused);
}

/// The header names what the scene has; the golden bits are those of `run`.
#[test]
fn a_project_for_c_has_the_names_and_the_bits_of_its_scene() {
    let folder = Folder::new();
    let project = folder.path("my-plant");
    let done = call(&["new", "c", project.to_str().unwrap(), "--precision", "fixed"]);
    assert_eq!((done.exit, done.err.as_str()), (Exit::Done, ""));
    let read = |path: &str| fs::read_to_string(project.join(path)).unwrap();
    let header = read("include/my_plant.h");
    for line in [
        "typedef float my_plant_number;",
        "#define MY_PLANT_INPUT_DRIVE 0u /* N */",
        "#define MY_PLANT_READOUT_ANGLE 2u /* rad */",
        "#define MY_PLANT_BODY_PENDULUM 1u",
        "#define MY_PLANT_STEP 0.0005",
        "int32_t my_plant_step(void);",
    ] {
        assert!(header.lines().any(|own| own == line), "{line} is not in {header}");
    }
    // Every function of the header is there in Rust, and no other is exported.
    let declared = header.lines().filter(|line| line.ends_with(");")).filter_map(|line| {
        line.split_once('(').and_then(|(before, _)| before.split_whitespace().last())
    });
    let declared: BTreeSet<String> = declared.map(str::to_owned).collect();
    let library = syn::parse_file(&read("src/lib.rs")).unwrap();
    let exported: BTreeSet<String> = library
        .items
        .iter()
        .filter_map(|item| match item {
            syn::Item::Fn(function) if function.sig.abi.is_some() => {
                Some(function.sig.ident.to_string())
            }
            _ => None,
        })
        .collect();
    assert_eq!(declared, exported);
    assert_eq!(exported.len(), 10);
    let last = read("golden.txt").lines().last().unwrap().to_owned();
    let options = ["--precision", "fixed", "--damping", "joint-wise", "--duration", "5s"];
    let run = folder.summary("cart-pendulum", &options);
    let bits = format!("{} {}", run["steps"], run["state_hash"].as_str().unwrap());
    assert_eq!(last, bits, "{}", done.out);
    let double = folder.path("double");
    let out = double.to_str().unwrap();
    let done = call(&["export", "cart-pendulum", "--c", "--precision", "f64", "--out", out]);
    assert_eq!((done.exit, done.err.as_str()), (Exit::Done, ""));
    let header = fs::read_to_string(double.join("include/double.h")).unwrap();
    assert!(header.contains("typedef double double_number;"), "{header}");
    // A scene without inputs and read-outs.
    let ball = folder.path("ball");
    let text = "name = \"a ball\"\nduration = 1\n[[body]]\nname = \"b\"\nmass = 1\n\
                inertia = [1, 1, 1]\nposition = [0, 0, 0]\n";
    let done = call(&["new", "c", ball.to_str().unwrap(), "--scene", &folder.scene(text)]);
    assert_eq!((done.exit, done.err.as_str()), (Exit::Done, ""));
    let source = fs::read_to_string(ball.join("src/lib.rs")).unwrap();
    assert!(source.contains("static READOUTS: [Readout<Precision>; 0] = [];"), "{source}");
}

#[test]
fn a_project_has_the_scene_that_is_asked_for() {
    let folder = Folder::new();
    let text = "name = \"a ball\"\nduration = 1\n[[body]]\nname = \"b\"\nmass = 1\n\
                inertia = [1, 1, 1]\nposition = [0, 0, 0]\n";
    let scene = folder.scene(text);
    let project = folder.path("ball");
    let done = new(&project, &["--scene", &scene, "--registry"]);
    assert_eq!((done.exit, done.err.as_str()), (Exit::Done, ""));
    let read = |path: &str| fs::read_to_string(project.join(path)).unwrap();
    assert_eq!(read("scenes/scene.toml"), text);
    assert!(read("build.rs").contains("dbd_scene::build(\"scenes/scene.toml\");"));
    assert!(read("src/lib.rs").contains("use model::ABallPlant;"));
    let manifest: toml::Table = read("Cargo.toml").parse().unwrap();
    assert!(manifest["build-dependencies"]["dbd-scene"].is_str());
}

/// What is asked for is what the build script says; where nothing is, a carriage that f32 would lose goes in fixed point.
#[test]
fn a_project_steps_as_it_is_asked_to_or_as_its_scene_needs() {
    let folder = Folder::new();
    let built = |name: &str, options: &[&str]| {
        let done = new(&folder.path(name), options);
        assert_eq!((done.exit, done.err.as_str()), (Exit::Done, ""), "{name}");
        let script = fs::read_to_string(folder.path(name).join("build.rs")).unwrap();
        let call = script.lines().find(|line| line.contains("dbd_scene::")).unwrap().trim();
        (call.to_owned(), done.out)
    };
    let asked = ["--scheme", "semi-implicit-euler", "--damping", "sweeps", "--step", "250us"];
    let (call, _) = built("asked", &[&asked[..], &["--precision", "f64"]].concat());
    assert_eq!(
        call,
        "dbd_scene::Build::scene(\"scenes/cart-pendulum.toml\").scheme(\"semi-implicit-euler\")\
         .precision(\"f64\").step(\"250us\").write();"
    );
    let creeping = "name = \"lift\"\ngravity = [0, 0, 0]\nduration = 2\nstep = \"20us\"\n[[body]]\n\
                    name = \"carriage\"\nmass = 3\ninertia = [1, 1, 1]\nposition = [0, 0, 1.5]\n\
                    velocity = [0, 0, 1e-3]\n";
    let scene = folder.scene(creeping);
    let (call, said) = built("slow", &["--scene", &scene]);
    assert!(call.contains(".precision(\"fixed\").write();"), "{call}");
    assert!(said.contains("fixed, because in f32 body `carriage` has lost"), "{said}");
    let (call, said) = built("single", &["--scene", &scene, "--precision", "f32"]);
    assert_eq!(
        (call.as_str(), said.contains("has lost")),
        ("dbd_scene::build(\"scenes/scene.toml\");", false)
    );
    // In a plane there is no fixed point; that f32 loses motion is said.
    let flat = folder.scene(&creeping.replace("duration = 2", "duration = 2\nplanar = true"));
    let (call, said) = built("flat", &["--scene", &flat]);
    assert!(!call.contains("precision"), "{call}");
    assert!(said.contains("f32, though body `carriage` has lost"), "{said}");
}

#[test]
fn what_cannot_be_a_project_is_refused_and_nothing_is_written() {
    let folder = Folder::new();
    for (name, options, said) in [
        ("my plant", &[][..], "my-plant"),
        ("test", &[], "test-plant"),
        ("plant", &["--scene", "cart-pendulun"], "did you mean cart-pendulum?"),
        ("none/plant", &[], "cannot write"),
    ] {
        let done = new(&folder.path(name), options);
        assert!(matches!(done.exit, Exit::Refused | Exit::Failed), "{name}");
        assert!(done.err.contains(said), "{name}: {}", done.err);
        assert_eq!(fs::read_dir(folder.0.path()).unwrap().count(), 0, "{name}");
    }
    assert_eq!(call(&["new", "firmware", ""]).exit, Exit::Refused);
    assert_eq!(call(&["new"]).exit, Exit::Refused);
}

/// The command and the build script write the same source.
#[test]
fn export_writes_what_a_build_script_writes() {
    let scene = concat!(env!("CARGO_MANIFEST_DIR"), "/../scenes/cart-pendulum.toml");
    let build = Build::scene(scene).precision("f32").scheme("dbd").newton(2).step("250us");
    let options = ["--precision", "f32", "--scheme", "dbd", "--newton", "2", "--step", "250us"];
    let done = call(&[&["export", "cart-pendulum"][..], &options].concat());
    assert_eq!(done.exit, Exit::Done, "{}", done.err);
    assert!(done.out == build.source().unwrap().source);
    assert!(done.out.contains("_SCHEME: dbd_kernel::Dbd = "));
    let scene = concat!(env!("CARGO_MANIFEST_DIR"), "/../scenes/four-bar.toml");
    let solved = Build::scene(scene).precision("f32").scheme("generalized-alpha").rho(0.2);
    let options = ["--precision", "f32", "--scheme", "generalized-alpha", "--rho", "0.2"];
    let done = call(&[&["export", "four-bar"][..], &options].concat());
    assert!(done.out == solved.source().unwrap().source, "{}", done.err);
    assert!(done.out.contains("pub static FOUR_BAR_PLANNED_F32: FourBarPlannedF32 ="));
    let refused = call(&["export", "four-bar", "--newton", "2"]);
    assert_eq!(refused.exit, Exit::Refused);
    assert!(refused.err.contains("no Newton iterations"), "{}", refused.err);
}

#[test]
fn a_file_that_was_not_exported_is_not_replaced() {
    let folder = Folder::new();
    let file = folder.path("model.rs");
    let export = |scene: &str| call(&["export", scene, "--out", file.to_str().unwrap()]);
    for scene in ["four-bar", "gyroscope"] {
        let done = export(scene);
        assert_eq!((done.exit, done.out.as_str()), (Exit::Done, ""), "{}", done.err);
        assert!(fs::read_to_string(&file).unwrap() == call(&["export", scene]).out);
    }
    fs::write(&file, "fn main() {}\n").unwrap();
    let done = export("four-bar");
    assert_eq!(done.exit, Exit::Refused);
    assert!(done.err.contains("was not written by"), "{}", done.err);
    assert_eq!(fs::read_to_string(&file).unwrap(), "fn main() {}\n");
    let out = folder.path("none/model.rs");
    assert_eq!(call(&["export", "four-bar", "--out", out.to_str().unwrap()]).exit, Exit::Failed);
}

/// `run`, `export`, `new firmware`, a build script, and what FMUs and Python are made with take one step.
#[test]
fn a_scene_without_a_step_has_one_default_step() {
    let folder = Folder::new();
    let cases = [
        ("1.7", "stiffness = 3e4", "", "5ms"),
        ("1.7", "stiffness = 3e6", "", "500us"),
        ("1.7", "stiffness = 3e6", "every = \"5 ms\"\n", "500us"),
        ("1.7", "stiffness = 3e6", "every = 0.0078125\n", "710.227"),
        ("1", "stiffness = 0", "", "1ms"),
    ];
    for (row, (mass, spring, every, expected)) in cases.into_iter().enumerate() {
        let text = format!(
            "name = \"ball\"\nduration = 1\n{every}gravity = [0, -9.81, 0]\n[[body]]\nname = \"b\"\nmass = {mass}\n\
             inertia = [1, 1, 1]\nposition = [0, 0, 0]\n[[tsda]]\nname = \"spring\"\nbetween = [\"world\", \"b\"]\n\
             points = [[0, 1, 0], [0, 0, 0]]\nfree_length = 1\n{spring}\n"
        );
        let scene = folder.scene(&text);
        let run = folder.summary(&scene, &[]);
        let taken = run["step"].as_f64().unwrap();
        assert!(dbd_plant::time::display(taken).starts_with(expected), "{taken} {text}");
        let says = |source: &str| {
            let line = source.lines().find(|line| line.contains("BALL_STEP: f64 = ")).unwrap();
            let bits = format!("{:#x}", taken.to_bits());
            assert!(line.replace('_', "").contains(&bits.replace('_', "")), "{line} {bits}");
        };
        says(&call(&["export", &scene]).out);
        says(&Build::scene(&scene).source().unwrap().source);
        let project = folder.path(&format!("project-{row}"));
        assert_eq!(new(&project, &["--scene", &scene]).exit, Exit::Done);
        let golden = fs::read_to_string(project.join("tests/golden.txt")).unwrap();
        let steps = golden.lines().last().unwrap().split(' ').next().unwrap();
        let single = folder.summary(&scene, &["--precision", "f32"]);
        assert_eq!(single["steps"].to_string(), steps);
        let parsed = dbd_scene::Scene::load(Path::new(&scene)).unwrap();
        let settings = dbd_plant::instance::Settings::default();
        let method = settings.method().unwrap();
        assert_eq!(settings.step_of(&parsed, &method).unwrap(), taken);
    }
}

/// Every template runs as it is, without a warning, moves, and names itself alone.
#[test]
fn every_template_of_a_scene_runs() {
    let folder = Folder::new();
    let help = call(&["new", "scene", "--help"]).out;
    let kinds: Vec<&str> = help
        .lines()
        .filter_map(|line| line.trim().strip_prefix("- "))
        .filter_map(|line| line.split(':').next())
        .collect();
    assert!(kinds.contains(&"linkage") && kinds.contains(&"drive-train"), "{help}");
    assert_eq!(kinds.len(), 6, "{kinds:?}");
    for kind in kinds {
        let file = folder.path(&format!("my-{kind}.toml"));
        let name = file.with_extension("");
        let done = call(&["new", "scene", name.to_str().unwrap(), "--template", kind]);
        assert_eq!((done.exit, done.err.as_str()), (Exit::Done, ""), "{kind}");
        let text = fs::read_to_string(&file).unwrap();
        assert!(!text.contains("{{") && text.contains(&format!("name = \"my-{kind}\"")), "{kind}");
        let done = folder.run(file.to_str().unwrap(), &["--duration", "1s"]);
        assert_eq!((done.exit, done.err.as_str()), (Exit::Done, ""), "{kind}");
        assert!(!done.out.contains("warning"), "{kind}: {}", done.out);
        let trace = folder.trace(&format!("my-{kind}"));
        let moves = |column: &str| {
            let row = trace.header.iter().position(|name| name == column).unwrap();
            let value = |cells: &Vec<String>| cells[row].parse::<f64>().unwrap();
            trace.rows.iter().any(|cells| (value(cells) - value(&trace.rows[0])).abs() > 1e-3)
        };
        let scene = dbd_scene::Scene::load(&file).unwrap();
        let columns = scene.readouts.iter().flat_map(|readout| {
            readout.columns.iter().map(move |(end, _)| format!("{}{end}", readout.name))
        });
        assert!(columns.collect::<Vec<_>>().iter().any(|column| moves(column)), "{kind} moves");
    }
    let both = ["new", "scene", "x", "--template", "cart", "--from", "four-bar"];
    assert_eq!(call(&both).exit, Exit::Refused);
}
