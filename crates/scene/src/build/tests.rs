//! The lines for cargo and the file written.

use super::*;

/// A scene file in a temporary folder.
struct Folder(PathBuf);

impl Folder {
    fn new(test: &str, scene: &str) -> Self {
        let name = format!("dbd-scene-build-{test}-{}", std::process::id());
        let folder = std::env::temp_dir().join(name);
        std::fs::create_dir_all(&folder).unwrap();
        std::fs::write(folder.join("my.toml"), scene).unwrap();
        Self(folder)
    }

    fn scene(&self) -> PathBuf {
        self.0.join("my.toml")
    }

    /// Whether it was written, and the lines for cargo.
    fn write(&self, build: &Build) -> (bool, String) {
        let mut lines = Vec::new();
        let written = build.write_into(Some(&self.0), &mut lines).unwrap();
        (written, String::from_utf8(lines).unwrap())
    }
}

impl Drop for Folder {
    fn drop(&mut self) {
        let _ = std::fs::remove_dir_all(&self.0);
    }
}

const BALL: &str = "name = \"ball\"\nduration = 1\nstep = 1e-3\n[[body]]\nname = \"ball\"\n\
                    mass = 2\ninertia = [1, 1, 1]\nposition = [1, 0, 0]\n[[tsda]]\n\
                    between = [\"world\", \"ball\"]\npoints = [[0, 0, 0], [0, 0, 0]]\n\
                    stiffness = 2e4\nfree_length = 1\n";

#[test]
fn the_source_lies_where_the_crate_includes_it() {
    let folder = Folder::new("source", BALL);
    let build = Build::scene(folder.scene());
    let (written, lines) = folder.write(&build);
    let watched = format!("cargo::rerun-if-changed={}\n", folder.scene().display());
    assert_eq!((written, lines), (true, watched));
    let text = std::fs::read_to_string(folder.0.join("my.rs")).unwrap();
    assert_eq!(text, build.source().unwrap().source);
    assert!(text.contains("leapfrog, f32, a step of 1ms."), "{text}");
    let other = build.precision("f64").scheme("dbd").newton(1).step("500us").output("other.rs");
    assert!(folder.write(&other).0);
    let text = std::fs::read_to_string(folder.0.join("other.rs")).unwrap();
    assert!(text.contains("dbd, f64, a step of 500us."), "{text}");
}

#[test]
fn a_value_may_be_another_than_in_the_file() {
    let folder = Folder::new("set", BALL);
    let build = || Build::scene(folder.scene());
    let written = Folder::new("set-written", &BALL.replace("mass = 2", "mass = 3"));
    let other = Build::scene(written.scene()).source().unwrap().source;
    let model = |source: &str| source.split_once("static ").unwrap().1.to_owned();
    let set = build().set("body.ball.mass=3").source().unwrap().source;
    assert_eq!(model(&set), model(&other));
    assert_ne!(model(&set), model(&build().source().unwrap().source));
    let (written, lines) = folder.write(&build().set("body.bal.mass=3"));
    assert!(!written && lines.contains("did you mean `ball`?"), "{lines}");
}

#[test]
fn a_scene_with_an_error_is_refused_with_its_place() {
    let folder = Folder::new("place", &BALL.replace("mass = 2", "mass = -2"));
    let (written, lines) = folder.write(&Build::scene(folder.scene()));
    assert!(!written && !folder.0.join("my.rs").exists());
    let said =
        format!("cargo::error={}:6:8: `mass` of body `ball` is -2", folder.scene().display());
    assert!(lines.lines().nth(1).unwrap().starts_with(&said), "{lines}");
    assert!(lines.contains(" (") && lines.ends_with(")\n"), "{lines}");
    let none = Build::scene(folder.0.join("none.toml"));
    let lines = folder.write(&none).1;
    assert!(lines.contains("cargo::error=cannot read") && lines.contains("none.toml"), "{lines}");
}

#[test]
fn what_is_not_meant_is_a_warning_of_cargos() {
    // 1e8 N/m and 2 kg: ω·h = 7 and more.
    let folder = Folder::new("warning", &BALL.replace("2e4", "1e8"));
    let (written, lines) = folder.write(&Build::scene(folder.scene()));
    let said = format!("cargo::warning={}: the step of 1ms may be", folder.scene().display());
    assert!(written && lines.contains(&said), "{lines}");
    let turned = "orientation = { axis = [0, 0, 1], angle = 90 }\n[[tsda]]";
    let folder = Folder::new("angle", &BALL.replacen("[[tsda]]", turned, 1));
    let (written, lines) = folder.write(&Build::scene(folder.scene()));
    let said = format!("cargo::warning={}:", folder.scene().display());
    assert!(written && lines.contains(&said), "{lines}");
}

/// 1 Tera-newton per metre and 2 kg: single precision allows 700 rad per step.
#[test]
fn a_step_that_the_matrix_does_not_bear_is_refused_with_the_longest_one() {
    let folder = Folder::new("stiff", &BALL.replace("2e4", "2e12"));
    let build = || Build::scene(folder.scene()).scheme("generalized-alpha");
    let (written, lines) = folder.write(&build());
    assert!(!written);
    let most = "limits the step to 699.9us with generalized-alpha in f32; it is 1ms";
    assert!(lines.contains(most), "{lines}");
    assert!(folder.write(&build().step("699.9us")).0);
    assert!(folder.write(&build().precision("f64")).0);
    // Without a given step an allowed one is chosen.
    let stiff = BALL.replace("2e4", "2e12").replace("step = 1e-3\n", "");
    std::fs::write(folder.scene(), stiff).unwrap();
    let source = build().source().unwrap().source;
    assert!(
        source.contains(": generalized-alpha, f32, a step of 250us."),
        "{}",
        source.lines().next().unwrap()
    );
}

#[test]
fn options_that_are_not_right_are_refused_with_what_would_be() {
    let folder = Folder::new("options", BALL);
    let refused = |build: &Build| {
        let (written, lines) = folder.write(build);
        assert!(!written);
        lines.lines().nth(1).unwrap().strip_prefix("cargo::error=").unwrap().to_owned()
    };
    let ball = || Build::scene(folder.scene());
    assert_eq!(
        refused(&ball().precision("f16")),
        "unknown precision \"f16\" (expected one of f64, f32, fixed)"
    );
    assert!(refused(&ball().scheme("leapfrg")).contains("(did you mean leapfrog?"));
    assert!(refused(&ball().step("fast")).contains("for example 20us"));
    assert!(refused(&ball().step(-1.0)).contains("must be positive"));
    assert!(refused(&ball().step(1e-60)).contains("f32 cannot represent"));
    assert_eq!(
        ball().step(2e-5).source().unwrap().source,
        ball().step("20us").source().unwrap().source
    );
    let every = BALL.replace("step = 1e-3\n", "every = 0.31830988618379069\n");
    std::fs::write(folder.scene(), every).unwrap();
    assert!(refused(&ball()).contains("no step divides both `duration` and `every`"));
    let gust = "[[input]]\nname = \"gust\"\ntype = \"force\"\nbody = \"ball\"\naxis = [1, 0, 0]\n\
                value = 1e300\n";
    std::fs::write(folder.scene(), format!("{BALL}{gust}")).unwrap();
    assert!(refused(&ball()).contains("my.toml:14: the input `gust`"));
    let mut lines = Vec::new();
    assert!(!ball().write_into(None, &mut lines).unwrap());
}
