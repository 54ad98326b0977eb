//! Geometry of bodies and the ground: where it lies, what is refused, and that the model knows nothing of it.

use dbd_scene::{Scene, Solid};

const BODIES: &str = r#"
name = "shapes"
duration = 1
step = 1e-3
gravity = [0, 0, -9.81]
points = { A = [0, 0, 0], B = [2, 0, 0], C = [2, 1, 0] }
parameters = { L = "50 mm" }
[[body]]
name = "arm"
link = { from = "A", to = "B", mass = 1 }
[[body]]
name = "stone"
mass = 1
inertia = [[1, 0.2, 0], [0.2, 2, 0], [0, 0, 2]]
position = [1, 1, 1]
"#;

fn with(geometry: &str) -> String {
    format!("{BODIES}{geometry}")
}

fn read(geometry: &str) -> Scene {
    let text = with(geometry);
    Scene::parse(&text, "a.toml").unwrap_or_else(|e| panic!("{e}\n{}\n{geometry}", e.help()))
}

fn solid(geometry: &str) -> Solid {
    read(&format!("[[geometry]]\n{geometry}")).geometry[0].solid.clone()
}

#[test]
fn solids_lie_in_the_axes_of_their_bodies() {
    let at = |place: &str| match solid(&format!(
        "body = \"arm\"\nshape = \"sphere\"\nradius = 1\n{place}"
    )) {
        Solid::Sphere { at, radius } => (at, radius),
        other => panic!("{other:?}"),
    };
    assert_eq!(at(""), ([0.0; 3], 1.0));
    assert_eq!(at("at = [0.5, \"2 * L\", 0]"), ([0.5, 0.1, 0.0], 1.0));
    // Ends of its own link, and a point of the world at the initial pose.
    assert_eq!(at("at = \"B\""), ([1.0, 0.0, 0.0], 1.0));
    assert_eq!(at("at = \"C\""), ([1.0, 1.0, 0.0], 1.0));
    let ends = [[-1.0, 0.0, 0.0], [1.0, 0.0, 0.0]];
    let link =
        solid("body = \"arm\"\nshape = \"link\"\nfrom = \"A\"\nto = \"B\"\ndiameter = \"L\"");
    assert_eq!(link, Solid::Link { ends, radius: 0.025 });
    let by_axis =
        "body = \"arm\"\nshape = \"cylinder\"\naxis = [4, 0, 0]\nlength = 2\nradius = 0.1";
    assert_eq!(solid(by_axis), Solid::Cylinder { ends, radius: 0.1 });
    let ground = solid("body = \"world\"\nshape = \"box\"\nat = \"C\"\nsize = [1, 2, \"4 m\"]");
    let (at, turn, half) = ([2.0, 1.0, 0.0], [1.0, 0.0, 0.0, 0.0], [0.5, 1.0, 2.0]);
    assert_eq!(ground, Solid::Box { at, turn, half });
}

/// The stone's principal axes are not those that it is written in: what is given in these lies where it did.
#[test]
fn solids_of_a_tensor_stay_where_they_are_written() {
    let scene = read(
        "[[geometry]]\nbody = \"stone\"\nshape = \"cylinder\"\nat = [1, 0, 0]\naxis = [0, 1, 0]\n\
         length = 2\nradius = 0.1\n[[geometry]]\nbody = \"stone\"\nshape = \"box\"\nsize = [1, 2, 3]\n",
    );
    let rotation = scene.model.initial[1].orientation.rotation();
    let world = |point: [f64; 3]| rotation.to_world(dbd_kernel::Vec3::from_f64(point)).to_f64();
    let near = |a: [f64; 3], b: [f64; 3]| a.iter().zip(b).all(|(a, b)| (a - b).abs() < 1e-15);
    let Solid::Cylinder { ends, .. } = scene.geometry[0].solid else { panic!("a cylinder") };
    assert!(near(world(ends[0]), [1.0, -1.0, 0.0]) && near(world(ends[1]), [1.0, 1.0, 0.0]));
    assert!(!near(ends[0], [1.0, -1.0, 0.0]));
    let Solid::Box { turn, .. } = scene.geometry[1].solid else { panic!("a box") };
    let own = dbd_kernel::Quaternion::<f64>::from_f64(turn).rotation();
    let axis = own.to_world(dbd_kernel::Vec3::new(1.0, 0.0, 0.0)).to_f64();
    assert!(near(world(axis), [1.0, 0.0, 0.0]));
}

/// One of each, of bodies with and without other axes, in words and numbers.
const EACH: &str = r##"
[defaults]
geometry = { colour = "silver", radius = 0.1 }
# A ball.
[[geometry]]
body = "arm"  # at its end
shape = "sphere"
at = "B"
colour = "red"
[[geometry]]
body = "stone"
shape = "link"
from = [0, 0, 0]
to = "C"
diameter = "2 * L"
[[geometry]]
body = "stone"
shape = "cylinder"
axis = [1, 2, 3]
length = "L"
colour = "#ABC"
[[geometry]]
body = "stone"
shape = "box"
at = [0.1, 0.2, 0.3]
size = [1, 2, 3]
orientation = { euler_321 = [0.1, "20 deg", 0.3] }
[[geometry]]
body = "stone"
shape = "box"
size = [1, 2, 3]
"##;

#[test]
fn the_model_its_source_and_its_warnings_are_the_same_without() {
    let (with, without) = (read(EACH), read(""));
    assert_eq!((with.geometry.len(), without.geometry.len()), (5, 0));
    assert_eq!(format!("{:?}", with.model), format!("{:?}", without.model));
    let warnings = |scene: &Scene| {
        let warnings = dbd_scene::warnings(scene);
        warnings.iter().map(|warning| warning.name.clone()).collect::<Vec<_>>()
    };
    // The parameter is named by geometry alone.
    assert_eq!(warnings(&with).len() + 1, warnings(&without).len());
}

#[test]
fn the_long_form_keeps_geometry_to_the_last_bit() {
    let text = with(EACH);
    let before = Scene::parse(&text, "a.toml").unwrap();
    let long = Scene::long_form(&text, "a.toml", &[""; 0]).unwrap();
    let after =
        Scene::parse(&long, "a.toml").unwrap_or_else(|e| panic!("{e}\n{}\n{long}", e.help()));
    assert_eq!(format!("{:?}", before.geometry), format!("{:?}", after.geometry), "{long}");
    assert_eq!(format!("{:?}", before.model), format!("{:?}", after.model), "{long}");
    assert_eq!(Scene::long_form(&long, "a.toml", &[""; 0]).unwrap(), long);
    assert!(long.contains("# A ball.\n[[geometry]]\nbody = \"arm\"  # at its end\n"), "{long}");
}

#[test]
fn what_is_no_solid_is_refused_with_line_and_remedy() {
    for (geometry, line, said, help) in [
        ("body = \"amr\"\nshape = \"sphere\"\nradius = 1", 17, "names no body", "mean \"arm\"?"),
        ("body = \"arm\"\nshape = \"cube\"\nsize = [1, 1, 1]", 18, "is \"cube\"", "\"box\""),
        ("body = \"arm\"\nradius = 1", 16, "has no `shape`", "\"box\""),
        ("body = \"arm\"\nshape = \"sphere\"", 16, "has no `radius`", "or `diameter`"),
        ("body = \"arm\"\nshape = \"sphere\"\nradius = 0", 19, "is 0", "> 0 in m"),
        ("body = \"arm\"\nshape = \"sphere\"\nradius = \"1 kg\"", 19, "value in kg", "in m"),
        (
            "body = \"arm\"\nshape = \"sphere\"\nradius = 1\ndiameter = 2",
            20,
            "contradicts",
            "either",
        ),
        ("body = \"arm\"\nshape = \"box\"\nsize = [1, 1]", 19, "has 2 entries", "array of 3"),
        ("body = \"arm\"\nshape = \"box\"\nsize = [1, 1, -1]", 19, "is -1", "> 0"),
        (
            "body = \"arm\"\nshape = \"box\"\nsize = [1, 1, 1]\nradius = 1",
            20,
            "no key `radius`",
            "`size`",
        ),
        (
            "body = \"arm\"\nshape = \"link\"\nfrom = \"A\"\nto = \"A\"\nradius = 1",
            20,
            "coincides with",
            "sphere",
        ),
        (
            "body = \"arm\"\nshape = \"link\"\nfrom = \"A\"\nto = \"Q\"\nradius = 1",
            20,
            "names no point",
            "\"A\"",
        ),
        ("body = \"arm\"\nshape = \"cylinder\"\nradius = 1", 16, "has no position", "`axis`"),
        (
            "body = \"arm\"\nshape = \"cylinder\"\nradius = 1\naxis = [0, 0, 0]\nlength = 1",
            20,
            "no direction",
            "not all 0",
        ),
        (
            "body = \"arm\"\nshape = \"cylinder\"\nradius = 1\nfrom = \"A\"\nto = \"B\"\naxis = [1, 0, 0]",
            22,
            "contradicts",
            "either",
        ),
        (
            "body = \"arm\"\nshape = \"sphere\"\nradius = 1\ncolour = \"rde\"",
            20,
            "is \"rde\"",
            "mean \"red\"?",
        ),
        (
            "body = \"arm\"\nshape = \"sphere\"\nradius = 1\ncolour = \"#12\"",
            20,
            "is \"#12\"",
            "#rrggbb",
        ),
        (
            "body = \"arm\"\nshape = \"sphere\"\nradius = 1\ncolour = 7",
            20,
            "is an integer",
            "#rrggbb",
        ),
        (
            "body = \"arm\"\nshape = \"sphere\"\nradius = 1\ncolor = \"red\"",
            20,
            "no key `color`",
            "`colour`?",
        ),
        (
            "body = \"arm\"\nshape = \"sphere\"\nradius = 1e200",
            16,
            "exceeds the range of coordinates",
            "1e150",
        ),
    ] {
        let text = with(&format!("[[geometry]]\n{geometry}\n"));
        let error = Scene::parse(&text, "a.toml").expect_err(geometry);
        assert!(error.message().contains(said), "{geometry}: {error}");
        assert!(error.help().contains(help), "{geometry}: {}", error.help());
        assert_eq!(error.line(), Some(line), "{geometry}: {error}");
    }
}
