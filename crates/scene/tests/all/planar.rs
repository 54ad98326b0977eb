//! Which scenes move in a plane, what becomes of them there, and what leaves it.

use dbd_kernel::energy::energy;
use dbd_kernel::model::Law;
use dbd_kernel::{Leapfrog, Plant, Quaternion, State, Vec3};
use dbd_scene::{Scene, SceneError};

/// Scenes that ship and lie in z = 0: bodies, elements in space and in the plane.
const PLANAR: [(&str, usize, usize, usize); 16] = [
    ("3rrr", 7, 54, 18),
    ("3rrr-1", 6, 48, 16),
    ("3rrr-2", 5, 42, 14),
    ("cart-pendulum", 2, 14, 4),
    ("chain-closed", 10, 66, 22),
    ("chain-open-30", 10, 60, 20),
    ("chain-open-60", 10, 60, 20),
    ("crank-slider", 4, 29, 12),
    ("five-bar-a", 4, 30, 10),
    ("five-bar-b", 4, 30, 10),
    ("four-bar", 3, 24, 8),
    ("gripper", 8, 70, 29),
    ("hanging-chain", 20, 60, 40),
    ("hexagon", 5, 36, 12),
    ("six-bar", 5, 36, 12),
    ("spring-ball", 1, 1, 1),
];

/// Scenes that ship and leave every plane, and one thing that leaves the plane which the least leaves.
const SPATIAL: [(&str, &str); 9] = [
    ("3ruu", "body `A2` leaves the plane y = 0 by 0.4867063 m"),
    ("3ruu-1", ""),
    ("3ruu-2", ""),
    ("delta-pick-and-place", ""),
    ("double-wishbone", ""),
    ("gyroscope", "body `top` leaves the plane y = 0: 0.2280443 m/s along its normal"),
    ("macpherson", ""),
    ("three-systems", ""),
    ("two-3ruu", ""),
];

fn shipped(name: &str) -> Scene {
    let path = format!("{}/../../scenes/{name}.toml", env!("CARGO_MANIFEST_DIR"));
    Scene::load(path).unwrap_or_else(|error| panic!("{error}"))
}

#[test]
fn every_scene_that_ships_is_in_a_plane_or_is_told_what_leaves_it() {
    let folder = concat!(env!("CARGO_MANIFEST_DIR"), "/../../scenes");
    let mut seen = 0;
    for entry in std::fs::read_dir(folder).unwrap() {
        let path = entry.unwrap().path();
        if path.extension().is_none_or(|ending| ending != "toml") {
            continue;
        }
        seen += 1;
        let name = path.file_stem().unwrap().to_str().unwrap().to_owned();
        let scene = shipped(&name);
        match (PLANAR.iter().find(|row| row.0 == name), dbd_scene::reduced(&scene)) {
            (Some((_, bodies, before, after)), Ok(planar)) => {
                assert_eq!(planar.plane.name(), "z = 0", "{name}");
                assert_eq!(planar.model.bodies.len(), *bodies, "{name}");
                let counts = (scene.model.tsda_count(), planar.model.tsda_count());
                assert_eq!(counts, (*before, *after), "{name}");
                assert_eq!(planar.model.groups.len(), scene.model.groups.len(), "{name}");
            }
            (None, Err(unplanar)) => {
                let first = unplanar.departures[0].text(&scene);
                let (_, words) = SPATIAL.iter().find(|row| row.0 == name).unwrap();
                assert!(first.starts_with(words), "{name}: {first}");
            }
            (_, found) => panic!("{name}: {found:?}"),
        }
    }
    assert_eq!(seen, PLANAR.len() + SPATIAL.len());
}

/// Stepped in space at z = 0, the reduced model moves as the whole one does: by less than the pins give way
/// beside what they carry. Measured at a tenth of a second of each, the factor is beside the motion.
#[test]
fn the_reduced_model_moves_as_the_spatial_one() {
    for (name, time, share) in [
        ("hexagon", 0.1, 1e-6),
        ("four-bar", 0.1, 1e-4),
        ("crank-slider", 0.1, 1e-4),
        ("cart-pendulum", 1.0, 1e-4),
        ("gripper", 0.2, 2e-2),
        ("3rrr", 0.1, 1e-3),
    ] {
        let scene = shipped(name);
        let planar = dbd_scene::reduced(&scene).unwrap();
        let step = scene.step.unwrap();
        let mut whole = Plant::new(&scene.model, Leapfrog, step).unwrap();
        let mut flat = Plant::new(&planar.model, Leapfrog, step).unwrap();
        let steps = (time / step) as u64;
        let (mut apart, mut moved) = (0.0_f64, 0.0_f64);
        for _ in 0..20 {
            assert!(whole.advance(steps / 20).is_ok() && flat.advance(steps / 20).is_ok());
            for (row, body) in whole.state().bodies.iter().enumerate() {
                let mine = planar.plane.state_outward(row, &flat.state().bodies[row]);
                apart = apart.max(length(body.position - mine.position));
                moved = moved.max(length(body.position - scene.model.initial[row].position));
                assert_eq!(flat.state().bodies[row].position.z, 0.0, "{name}");
            }
        }
        assert!(moved > 1e-3 && apart < share * moved, "{name}: {apart:e} of {moved:e} m");
        let start = |model| energy(model, &State::initial(model), step).total();
        let (start, same) = (start(&planar.model), start(&scene.model));
        assert!((start - same).abs() <= 1e-9 * same.abs().max(1.0), "{name}: {start} {same}");
    }
}

fn length(v: Vec3<f64>) -> f64 {
    v.dot(v).sqrt()
}

/// Four bars between random places of a plane, on bushings, in a plane of this orientation.
fn random_linkage(random: &mut impl FnMut() -> f64, tilt: Option<[f64; 4]>) -> Scene {
    let quaternion = tilt.unwrap_or([1.0, 0.0, 0.0, 0.0]);
    let rotation =
        Quaternion::new(quaternion[0], quaternion[1], quaternion[2], quaternion[3]).rotation();
    let off = [random(), random(), random()].map(|c| 0.3 * c);
    let off = if tilt.is_some() { off } else { [off[0], off[1], 0.0] };
    let world = |x, y| (rotation.to_world(Vec3::new(x, y, 0.0)) + Vec3::from_f64(off)).to_f64();
    let places: [[f64; 2]; 5] =
        std::array::from_fn(|i| [0.4 * i as f64 + 0.1 * random(), 0.3 * random()]);
    let gravity = rotation.to_world(Vec3::new(0.0, -9.81, 0.0)).to_f64();
    let axis = rotation.to_world(Vec3::new(0.0, 0.0, 1.0)).to_f64();
    let mut text = format!(
        "name = \"linkage\"\nduration = 1\nstep = 2e-5\ngravity = {gravity:?}\n\
         realisation = \"bushing\"\n"
    );
    for i in 0..4 {
        let [a, b] = [places[i], places[i + 1]];
        let position = world(0.5 * (a[0] + b[0]), 0.5 * (a[1] + b[1]));
        text += &format!(
            "[[body]]\nname = \"{i}\"\nmass = 1\ninertia = [0.01, 0.01, 0.02]\n\
             position = {position:?}\norientation = {{ quaternion = {quaternion:?} }}\n"
        );
    }
    for (i, [x, y]) in places.into_iter().enumerate() {
        let name =
            |i: usize| if (1..5).contains(&i) { (i - 1).to_string() } else { "world".into() };
        text += &format!(
            "[[joint]]\nname = \"j{i}\"\ntype = \"revolute\"\nbetween = [\"{}\", \"{}\"]\n\
             at = {:?}\naxis = {axis:?}\nspan = 0.1\nstiffness = 1e5\ndamping = 5\n",
            name(i),
            name(i + 1),
            world(x, y)
        );
    }
    Scene::parse(&text, "linkage.toml").unwrap_or_else(|error| panic!("{error}: {}", error.help()))
}

/// What rounding leaves of a bushing's size is no size: linkages of bushings are planar wherever they lie.
#[test]
fn linkages_of_bushings_are_planar_in_any_plane() {
    let mut seed = 2297_u64;
    let mut random = || {
        seed = seed.wrapping_mul(6_364_136_223_846_793_005).wrapping_add(1_442_695_040_888_963_407);
        (seed >> 11) as f64 / (1_u64 << 52) as f64 - 1.0
    };
    for i in 0..40 {
        let q = [random(), random(), random(), random()];
        let norm = q.iter().map(|c| c * c).sum::<f64>().sqrt();
        let tilt = (i % 2 == 0).then(|| q.map(|c| c / norm));
        let scene = random_linkage(&mut random, tilt);
        let planar =
            dbd_scene::reduced(&scene).unwrap_or_else(|u| panic!("{i}: {:?}", u.departures));
        let mut whole = Plant::new(&scene.model, Leapfrog, 2e-5).unwrap();
        let mut flat = Plant::new(&planar.model, Leapfrog, 2e-5).unwrap();
        assert!(whole.advance(5_000).is_ok() && flat.advance(5_000).is_ok());
        for (row, body) in whole.state().bodies.iter().enumerate() {
            let mine = planar.plane.state_outward(row, &flat.state().bodies[row]);
            let moved = length(body.position - scene.model.initial[row].position);
            let apart = length(body.position - mine.position);
            assert!(moved > 1e-4 && apart < 1e-6, "{i}: {apart:e} of {moved:e} m");
        }
    }
}

/// A pendulum of two links in the plane normal to `[2, -1, 0.5]`, off the origin, its bodies turned.
const TILTED: &str = r#"
name = "tilted"
duration = 1
step = 1e-4
gravity = [3.0, 6.0, 0.0]
[points]
O = [0.1, 0.2, 0.3]
A = [0.3, 0.6, 0.3]
B = [0.2, 0.6, 0.7]
[[body]]
name = "upper"
link = { from = "O", to = "A", shape = "box", section = [0.02, 0.03], density = 2700, reference = [2, -1, 0.5] }
[[body]]
name = "lower"
link = { from = "A", to = "B", shape = "box", section = [0.02, 0.03], density = 2700, reference = [2, -1, 0.5] }
[[joint]]
name = "top"
type = "revolute"
between = ["world", "upper"]
at = "O"
axis = [2, -1, 0.5]
stiffness = 1e6
span = 0.04
[[joint]]
name = "knee"
type = "revolute"
between = ["upper", "lower"]
at = "A"
axis = [-2, 1, -0.5]
stiffness = 1e6
damping = 10
span = 0.04
[[torsion_spring]]
between = ["upper", "lower"]
axis = [2, -1, 0.5]
stiffness = 2
damping = 0.1
[[load]]
body = "lower"
force = [1, 2, 0]
torque = [0.2, -0.1, 0.05]
[[readout]]
name = "turn"
type = "joint_angle"
target = "knee"
"#;

#[test]
fn a_plane_may_have_any_normal_and_lie_anywhere() {
    let scene = Scene::parse(TILTED, "tilted.toml")
        .unwrap_or_else(|error| panic!("{error}: {}", error.help()));
    let planar = dbd_scene::reduced(&scene).unwrap_or_else(|u| panic!("{:?}", u.departures));
    let normal = planar.plane.normal();
    assert!(length(normal.cross(Vec3::new(2.0, -1.0, 0.5))) < 1e-12);
    let mut whole = Plant::new(&scene.model, Leapfrog, 1e-4).unwrap();
    let mut flat = Plant::new(&planar.model, Leapfrog, 1e-4).unwrap();
    for _ in 0..10 {
        assert!(whole.advance(500).is_ok() && flat.advance(500).is_ok());
        for row in 0..2 {
            let (body, mine) = (&whole.state().bodies[row], &flat.state().bodies[row]);
            let mine = planar.plane.state_outward(row, mine);
            assert!(length(body.position - mine.position) < 2e-6, "{row}");
            assert!(length(body.angular_velocity - mine.angular_velocity) < 2e-4, "{row}");
            let q = body.orientation.conjugate().product(mine.orientation);
            assert!(q.w.abs() > 1.0 - 1e-9, "{row}: {q:?}");
            let back = planar.plane.state_inward(row, &mine);
            assert!(length(back.position - flat.state().bodies[row].position) < 1e-14);
        }
        assert_eq!(whole.state().turns, flat.state().turns);
    }
    assert!(length(whole.state().bodies[1].position - scene.model.initial[1].position) > 0.1);
}

/// A body on a pin in z = 0, and what else it has; `{}` of it are keys.
fn pinned(body: &str, joint: &str, more: &str) -> String {
    format!(
        "name = \"pinned\"\nduration = 1\nplanar = true\n{more}\n[[body]]\nname = \"arm\"\nmass = 1\n\
         inertia = [0.1, 0.2, 0.25]\n{body}\n[[joint]]\nname = \"pin\"\ntype = \"revolute\"\n\
         between = [\"world\", \"arm\"]\nstiffness = 1e5\nspan = 0.04\n{joint}\n"
    )
}

const AT: &str = "at = [0, 0, 0]\naxis = [0, 0, 1]";
const PLACE: &str = "position = [0.5, 0, 0]";

fn refusal(text: &str) -> SceneError {
    match Scene::parse(text, "pinned.toml") {
        Err(error) => error,
        Ok(_) => panic!("not refused: {text}"),
    }
}

#[test]
fn a_planar_scene_that_leaves_its_plane_is_refused_with_the_place_and_by_how_much() {
    assert!(Scene::parse(&pinned(PLACE, AT, ""), "pinned.toml").unwrap().planar.is_some());
    let tail =
        "\n[[body]]\nname = \"off\"\nmass = 1\ninertia = [1, 1, 1]\nposition = [0, 0, 0.02]\n";
    for (text, key, words) in [
        (
            pinned(PLACE, AT, "") + tail,
            "[0, 0, 0.02]",
            "`position` of body `off` leaves the plane z = 0 by 0.02 m",
        ),
        (
            pinned(PLACE, AT, "gravity = [0, -9.81, 0.5]"),
            "[0, -9.81, 0.5]",
            "`gravity` of the scene leaves the plane z = 0: 0.5 m/s² along its normal",
        ),
        (
            pinned(
                "position = [0.5, 0, 0]\norientation = { axis = [1, 0, 0], angle = \"10 deg\" }",
                AT,
                "",
            ),
            "{ axis = [1, 0, 0], angle = \"10 deg\" }",
            "`orientation` of body `arm` leaves the plane z = 0: no principal axis is normal to \
             it, the nearest is tilted by \
             10 degrees",
        ),
        (
            pinned("position = [0.5, 0, 0]\nvelocity = [1, 0, 0.25]", AT, ""),
            "[1, 0, 0.25]",
            "`velocity` of body `arm` leaves the plane z = 0: 0.25 m/s along its normal",
        ),
        (
            pinned("position = [0.5, 0, 0]\nangular_velocity = [3, 4, 1]", AT, ""),
            "[3, 4, 1]",
            "`angular_velocity` of body `arm` leaves the plane z = 0: 5 rad/s about an axis that lies in it",
        ),
        (
            pinned(PLACE, "at = [0, 0, 0.01]\naxis = [0, 0, 1]", ""),
            "[0, 0, 0.01]",
            "`at` of joint `pin` leaves the plane z = 0 by 0.01 m",
        ),
        (
            pinned(PLACE, AT, "")
                + "[[tsda]]\nbetween = [\"world\", \"arm\"]\npoints = [[0, 1, 0], [0, 0, 0.03]]\n\
             stiffness = 9\nfree_length = 0.5\n",
            "[[0, 1, 0], [0, 0, 0.03]]",
            "`points` of tsda 1 leaves the plane z = 0 by 0.03 m",
        ),
        (
            pinned(PLACE, AT, "")
                + "[[point_on_line]]\nbetween = [\"world\", \"arm\"]\nline_point = [1, 0.1, 0]\n\
             line_direction = [0, 0, 1]\npoint = [0.5, 0, 0]\nstiffness = 9\nfree_length = 0\n\
             clearance = 0.2\n",
            "[[point_on_line]]",
            "point_on_line 1 leaves the plane z = 0: it has a clearance about a point of the \
             plane, which planar elements do not support",
        ),
        (
            pinned(PLACE, AT, "")
                + "[[torsion_spring]]\nbetween = [\"world\", \"arm\"]\naxis = [0, 1, 1]\n\
             stiffness = 9\n",
            "[0, 1, 1]",
            "`axis` of torsion_spring 1 leaves the plane z = 0: its axis is tilted by 45 degrees \
             from the normal",
        ),
        (
            pinned(PLACE, AT, "")
                + "[[input]]\nname = \"tilt\"\ntype = \"gravity\"\naxis = [1, 0, 1]\n",
            "[1, 0, 1]",
            "`axis` of input `tilt` leaves the plane z = 0: its axis is tilted by 45 degrees",
        ),
        (
            pinned(PLACE, AT, "") + "[[load]]\nbody = \"arm\"\nforce = [1, 0, -2]\n",
            "[1, 0, -2]",
            "`force` of load 1 leaves the plane z = 0: -2 N along its normal",
        ),
        (
            pinned(PLACE, AT, "") + "[[load]]\nbody = \"arm\"\ntorque = [0.5, 0, 0]\n",
            "[0.5, 0, 0]",
            "`torque` of load 1 leaves the plane z = 0: 0.5 N·m about an axis that lies in it",
        ),
        (
            pinned(PLACE, AT, "")
                + "[[input]]\nname = \"push\"\ntype = \"force\"\nbody = \"arm\"\naxis = [0, 3, 3]\n",
            "[0, 3, 3]",
            "`axis` of input `push` leaves the plane z = 0: its axis is tilted by 45 degrees",
        ),
        (
            pinned(PLACE, AT, "")
                + "[[input]]\nname = \"push\"\ntype = \"force\"\nbody = \"arm\"\naxis = [0, 1, 0]\n\
             point = [0, 0, 0.1]\n",
            "[0, 0, 0.1]",
            "`point` of input `push` leaves the plane z = 0 by 0.1 m",
        ),
    ] {
        let error = refusal(&text);
        assert_eq!(error.message(), words, "{text}");
        let place = text.rfind(key).unwrap();
        let line = text[..place].matches('\n').count() + 1;
        let column = place - text[..place].rfind('\n').unwrap();
        assert_eq!((error.line(), error.column()), (Some(line), Some(column)), "{words}");
        assert!(error.help().contains("omit `planar`"), "{}", error.help());
    }
}

/// The plane is the one in which the pin turns, whatever else the scene is symmetric about.
#[test]
fn a_pin_turns_in_its_plane() {
    let axis_error = pinned(PLACE, "at = [0, 0, 0]\naxis = [0, 1, 1]", "gravity = [0, -9.81, 0]");
    let words = "`axis` of joint `pin` leaves the plane z = 0: its axis is tilted by 45 degrees \
        from the normal";
    assert_eq!(refusal(&axis_error).message(), words);
    let across = pinned(PLACE, "at = [0, 0, 0]\naxis = [0, 1, 0]", "");
    let scene = Scene::parse(&across, "pinned.toml").unwrap();
    assert_eq!(scene.planar.unwrap().plane.name(), "y = 0");
}

#[test]
fn planar_is_true_or_false_and_can_be_asked_for_from_outside() {
    let text = pinned(PLACE, AT, "").replace("planar = true", "planar = 1");
    let error = refusal(&text);
    assert!(error.help().contains("true or false"), "{}", error.help());
    let text = text.replace("planar = 1\n", "");
    assert!(Scene::parse(&text, "pinned.toml").unwrap().planar.is_none());
    let asked = Scene::parse_with(&text, "pinned.toml", &["planar=true"]).unwrap();
    assert!(asked.planar.is_some());
}

/// What has no length is the same in the plane: one bushing per pin, at any stretch.
#[test]
fn a_pin_of_bushings_is_one_of_the_plane() {
    let scene = Scene::parse_with(
        &text_of("hexagon"),
        "hexagon.toml",
        &["realisation=bushing", "planar=true"],
    )
    .unwrap_or_else(|error| panic!("{error}"));
    let planar = scene.planar.unwrap();
    let model = &planar.model;
    assert_eq!((model.tsdas.len(), model.bushings.len()), (0, 6));
    assert!(planar.at_rest.is_empty());
    let springs = dbd_scene::reduced(&shipped("hexagon")).unwrap();
    // As stiff as the springs in the same plane.
    let stiffness = springs.model.tsdas[0].stiffness;
    assert!((model.bushings[0].stiffness - stiffness).abs() < 1e-6 * stiffness);
}

fn text_of(name: &str) -> String {
    let path = format!("{}/../../scenes/{name}.toml", env!("CARGO_MANIFEST_DIR"));
    std::fs::read_to_string(path).unwrap()
}

#[test]
fn a_pin_becomes_two_springs_of_its_stiffness_and_what_lies_in_the_plane_stays() {
    let text = pinned(PLACE, &format!("{AT}\ndamping = 7"), "")
        + "[[tsda]]\nbetween = [\"world\", \"arm\"]\npoints = [[0, 1, 0], [0, 0.25, 0]]\nstiffness = 9\n\
           free_length = 0.5\n";
    let scene = Scene::parse(&text, "pinned.toml").unwrap();
    let planar = scene.planar.unwrap();
    let model = &planar.model;
    let pin = model.groups[0];
    assert_eq!((pin.law, pin.triples, pin.arms, pin.shared), (Law::Tsda, 1, 2, false));
    // Each of the two ends of the pin has the stiffness k·I.
    for (tsda, damping) in model.tsdas[..2].iter().zip(&model.dampers) {
        assert!((tsda.stiffness - 2e5).abs() < 1e-9, "{tsda:?}");
        assert!((damping - 14.0).abs() < 1e-12, "{damping}");
    }
    assert_eq!(planar.at_rest, [0]);
    let raw = model.groups[1];
    let first = usize::from(raw.point);
    assert_eq!(
        model.points[first..first + 2],
        [Vec3::new(0.0, 1.0, 0.0), Vec3::new(0.0, 0.25, 0.0)]
    );
    assert_eq!((model.tsdas[2].stiffness, model.tsdas[2].free_length), (9.0, 0.5));
}
