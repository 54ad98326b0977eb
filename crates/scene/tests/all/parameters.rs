//! Values of a scene changed by their paths.

use dbd_scene::{Scene, SceneError, SceneText};

const SCENE: &str = r#"name = "cart"
duration = 1
gravity = [0, -9.81, 0]

[[body]]
name = "cart"
mass = 0.94
inertia = [1, 2, 3]
position = [0, 0, 0]

[[body]]
name = "leg 1"
mass = 2
inertia = [1, 1, 1]
position = [1, 0, 0]
orientation = { axis = [0, 0, 1], angle = 0.5 }

[[body]]
name = "leg.2"
mass = 3
inertia = [1, 1, 1]
position = [2, 0, 0]

[[tsda]]
between = ["cart", "leg 1"]
points = [[0, 0, 0], [0, 0, 0]]
stiffness = 10
free_length = 1

[[joint]]
name = "rail"
type = "spherical"
between = ["world", "cart"]
at = [0, 0, 0]
stiffness = 1e5
arm = 0.1
"#;

fn with(changes: &[&str]) -> Result<Scene, SceneError> {
    Scene::parse_with(SCENE, "cart.toml", changes)
}

/// A scene whose text was changed by hand.
fn edited(from: &str, to: &str) -> Scene {
    assert_eq!(SCENE.matches(from).count(), 1, "{from}");
    Scene::parse(&SCENE.replace(from, to), "cart.toml").unwrap()
}

#[test]
fn a_changed_value_gives_the_model_of_a_changed_file() {
    for (change, from, to, path) in [
        ("body.cart.mass=1.5", "0.94", "1.5", "body.cart.mass"),
        ("body.cart.inertia[1]=3", "[1, 2, 3]", "[1, 3, 3]", "body.cart.inertia[1]"),
        ("gravity=[0, 0, -1.62]", "[0, -9.81, 0]", "[0, 0, -1.62]", "gravity"),
        ("gravity[1] = -1", "-9.81", "-1", "gravity[1]"),
        ("body.\"leg.2\".mass=4", "mass = 3", "mass = 4", "body.\"leg.2\".mass"),
        ("body.leg 1.orientation.angle=1", "0.5", "1", "body.leg 1.orientation.angle"),
        ("tsda.1.stiffness=20", "= 10", "= 20", "tsda.1.stiffness"),
        ("tsda.1.points[1][2]=0.1", "], [0, 0, 0]]", "], [0, 0, 0.1]]", "tsda.1.points[1][2]"),
        ("tsda.1.damping=3", "= 10", "= 10\ndamping = 3", "tsda.1.damping"),
        ("joint.rail.type=spherical", "\"spherical\"", "\"spherical\"", "joint.rail.type"),
        // Missing tables are added.
        (
            "defaults.tsda.damping=3",
            "duration = 1",
            "duration = 1\ndefaults.tsda.damping = 3",
            "defaults.tsda.damping",
        ),
        (
            "body.leg?2.orientation.quaternion=[0, 1, 0, 0]",
            "mass = 3",
            "mass = 3\norientation.quaternion = [0, 1, 0, 0]",
            "body.\"leg.2\".orientation.quaternion",
        ),
    ] {
        let scene = with(&[change]).unwrap_or_else(|error| panic!("{change}: {error}"));
        assert_eq!(scene.model, edited(from, to).model, "{change}");
        assert_eq!(scene.changed.len(), 1, "{change}");
        assert_eq!(scene.changed[0].path, path, "{change}");
    }
    let scene = with(&["step=20us", "duration=0x2", "every=1e-1"]).unwrap();
    assert_eq!((scene.step, scene.duration, scene.every), (Some(20e-6), 2.0, Some(0.1)));
    let reported: Vec<_> = scene.changed.iter().map(|c| (c.before.as_deref(), &*c.now)).collect();
    assert_eq!(reported, [(None, "\"20us\""), (Some("1"), "0x2"), (None, "1e-1")]);
}

#[test]
fn a_pattern_changes_all_that_it_fits_and_the_last_change_holds() {
    let scene = with(&["body.*.mass=5", "body.leg*.mass=6", "body.\"leg.2\".mass=7"]).unwrap();
    let masses: Vec<_> = scene.model.bodies.iter().map(|body| body.mass).collect();
    assert_eq!(masses, [5.0, 6.0, 7.0]);
    assert_eq!(scene.changed.len(), 3 + 2 + 1);
    // A table that one of them has is not added to the others.
    assert_eq!(with(&["body.leg*.orientation.angle=1"]).unwrap().changed.len(), 1);
    let last = scene.changed.last().unwrap();
    assert_eq!((last.before.as_deref(), last.now.as_str()), (Some("6"), "7"));
    // What stands in the file is told by its place as ever.
    let lines = dbd_scene::warnings(&with(&[]).unwrap()).len();
    assert_eq!(dbd_scene::warnings(&scene).len(), lines);
}

#[test]
fn what_is_wrong_with_a_change_is_shown_in_it() {
    for (change, column, message, help) in [
        ("body.cart.mass=-1", 16, "`mass` of body `cart` is -1", "> 0 in kg"),
        ("body.cart.mass=heavy", 17, "`heavy` is neither a unit nor", "> 0 in kg"),
        ("body.crat.mass=1", 6, "the scene has no body `crat`", "did you mean `cart`?"),
        ("bdoy.cart.mass=1", 1, "the scene has no key `bdoy`", "did you mean `body`?"),
        ("body.cart.mas=1", 1, "no key `mas`", "did you mean `mass`?"),
        ("body.cart.mass.x=1", 16, "no body `x`", "plain value"),
        ("joint.rail.limts.max=1", 1, "no key `limts`", "may have"),
        ("torsion_spring.1.damping=1", 1, "has no key `torsion_spring`", "known: body"),
        ("body.cart.orientation[0]=1", 11, "no body `orientation`", "known: inertia"),
        ("body.cart.inertia[3]=1", 18, "no entry 3", "entries 0 to 2"),
        ("body.cart[0]=1", 10, "no entry 0", "known: inertia, mass"),
        ("body.z*.mass=1", 6, "no body `z*`", "cart"),
        ("gravity=[0, 1", 14, "unclosed array", ""),
        ("duration=", 10, "is not a valid value", "PATH"),
        ("duration=1\nname=2", 10, "is not a valid value", "one line"),
        ("duration", 9, "missing `=VALUE`", "PATH=VALUE"),
        ("joint.rail.between=[\"world\", \"crat\"]", 0, "crat", "cart"),
    ] {
        let error = with(&["gravity[0]=0", change]).unwrap_err();
        assert_eq!(error.file(), "--set", "{change}: {error}");
        assert_eq!(error.line(), Some(1), "{change}: {error}");
        if column > 0 {
            assert_eq!(error.column(), Some(column), "{change}: {error}");
        }
        assert!(error.message().contains(message), "{change}: {error}");
        let said = format!("{} {}", error.help(), error.message());
        assert!(said.contains(help) || help == "PATH", "{change}: {said}");
    }
    // A fault of the file stays one of the file.
    let error = Scene::parse_with(&SCENE.replace("mass = 2", "mass = 0"), "cart.toml", &["step=1"]);
    let error = error.unwrap_err();
    assert_eq!((error.file(), error.line()), ("cart.toml", Some(13)));
}

/// A text that is parsed once gives what it gives parsed each time, in any order of the changes.
#[test]
fn a_parsed_text_keeps_no_change() {
    let text = SceneText::parse(SCENE, "cart.toml").unwrap();
    let cases: [&[&str]; 6] = [
        &["body.cart.mass=1.5", "gravity[1]=-1"],
        &[],
        &["step=20us"],
        &["body.cart.mass=-1"],
        &["body.cat.mass=1"],
        &["body.cart.mass=2.5"],
    ];
    for changes in cases {
        match (text.scene(changes), with(changes)) {
            (Ok(scene), Ok(expected)) => {
                assert_eq!(scene.long_text().unwrap(), expected.long_text().unwrap());
                assert_eq!(scene.changes, expected.changes);
                assert_eq!(
                    (scene.step, scene.model.gravity),
                    (expected.step, expected.model.gravity)
                );
            }
            (Err(error), Err(expected)) => assert_eq!(error.to_string(), expected.to_string()),
            (found, expected) => panic!("{changes:?}: {:?}, {:?}", found.err(), expected.err()),
        }
    }
    let error = SceneText::parse("name = ", "cart.toml").unwrap_err();
    assert_eq!((error.file(), error.line()), ("cart.toml", Some(1)));
}

#[test]
fn every_number_has_a_path_that_gives_it_otherwise() {
    let scene = Scene::parse(SCENE, "cart.toml").unwrap();
    let numbers = scene.numbers().unwrap();
    let find = |path: &str| {
        let found = numbers.iter().find(|number| number.path == path);
        found.map(|number| (number.value, number.unit.as_str()))
    };
    assert_eq!(find("gravity[1]"), Some((-9.81, "m/s²")));
    assert_eq!(find("body.cart.mass"), Some((0.94, "kg")));
    assert_eq!(find("body.\"leg.2\".mass"), Some((3.0, "kg")));
    assert_eq!(find("body.leg 1.orientation.angle"), Some((0.5, "rad")));
    assert_eq!(find("tsda.1.stiffness"), Some((10.0, "N/m")));
    assert_eq!(find("joint.rail.arm"), Some((0.1, "m")));
    let changed = scene.with("body.cart.mass=3").unwrap().numbers().unwrap();
    assert!(changed.iter().any(|number| number.path == "body.cart.mass" && number.value == 3.0));
}

/// What is listed is what a change takes: each number given as itself leaves the model as it is.
#[test]
fn a_number_given_as_itself_changes_nothing() {
    let folder = concat!(env!("CARGO_MANIFEST_DIR"), "/../../scenes");
    let mut count = 0;
    for entry in std::fs::read_dir(folder).unwrap() {
        let path = entry.unwrap().path();
        if path.extension().is_none_or(|end| end != "toml") {
            continue;
        }
        let scene = Scene::load(&path).unwrap();
        let numbers = scene.numbers().unwrap();
        assert!(numbers.len() > 10, "{}", path.display());
        let mut changes = Vec::new();
        for number in &numbers {
            changes.push(format!("{}={:?}", number.path, number.value));
        }
        count += numbers.len();
        let text = std::fs::read_to_string(&path).unwrap();
        let again = Scene::parse_with(&text, "again.toml", &changes).unwrap();
        assert_eq!(again.model, scene.model, "{}", path.display());
        assert_eq!(again.numbers().unwrap(), numbers);
    }
    assert!(count > 500, "{count}");
}
