//! A scene as URDF, and that URDF as a scene again: the same mechanism, motion and shapes.

use dbd_import::export::{Lack, urdf};
use dbd_import::{Options, Weld};
use dbd_plant::{Method, plant};
use dbd_scene::Scene;

use crate::call;
use crate::import::{loaded, of};

/// A body without symmetry, rotated in the world.
fn body(name: &str, at: [f64; 3]) -> String {
    format!(
        "[[body]]\nname = \"{name}\"\nmass = 2\ninertia = [0.03, 0.02, 0.025]\nposition = {at:?}\n\
         orientation = {{ axis = [1, 2, 3], angle = \"40 deg\" }}\n"
    )
}

fn joint(name: &str, kind: &str, [a, b]: [&str; 2], at: [f64; 3], more: &str) -> String {
    format!(
        "[[joint]]\nname = \"{name}\"\ntype = \"{kind}\"\nbetween = [\"{a}\", \"{b}\"]\nat = {at:?}\n\
         stiffness = 1e8\n{more}\n"
    )
}

const TURN: &str = "span = 0.2\naxis = [1, 0.5, 0]\nrealisation = \"bushing\"";
const SLIDE: &str =
    "span = 0.2\naxis = [0, 0.6, 0.8]\nreference = [1, 0, 0]\ngauge = 0.2\noffset = 0.1";

fn scene(parts: &[String]) -> Scene {
    let text =
        format!("name = \"a & b\"\nduration = 0.2\ngravity = [1, 0, -9]\n{}", parts.concat());
    Scene::parse(&text, "s.toml").unwrap_or_else(|error| panic!("{error}\n{text}"))
}

/// The scene of the URDF of a scene.
fn again(scene: &Scene) -> (Scene, String) {
    let text = urdf(scene, &[]).unwrap_or_else(|error| panic!("{error}")).text;
    // The ends of unbounded slides are limits; their stiffness does not matter.
    let options =
        Options { weld: Weld::Fixed, stiffness: 1e8, duration: 0.2, ..Options::default() };
    (loaded(&of(&text, &options)), text)
}

/// \[m\] the largest distance of a body of the same name after 0.2 s, and how far one has moved.
fn apart(one: &Scene, other: &Scene) -> (f64, f64) {
    let ends = [one, other].map(|scene| {
        let mut plant = plant(scene, &Method::default(), 1e-5).unwrap();
        plant.advance(20_000).unwrap();
        plant.state().bodies
    });
    let mut found = (0.0_f64, 0.0_f64);
    for (row, name) in one.body_names.iter().enumerate() {
        let there = other.body_names.iter().position(|body| body == name);
        let there = there.unwrap_or_else(|| panic!("no {name}: {:?}", other.body_names));
        let length = |v: [f64; 3]| v.iter().map(|x| x * x).sum::<f64>().sqrt();
        let gap = ends[0][row].position - ends[1][there].position;
        let moved = ends[0][row].position - one.model.initial[row].position;
        found = (found.0.max(length(gap.to_f64())), found.1.max(length(moved.to_f64())));
    }
    found
}

/// Every type of joint, given from either of its bodies.
#[test]
fn a_mechanism_comes_back_with_its_motion() {
    let axes = "span = 0.2\naxes = [[1, 0, 0], [0, 1, 0]]\nrealisation = \"bushing\"";
    for (kind, more) in [
        ("revolute", TURN),
        ("translational", SLIDE),
        ("cylindrical", "span = 0.2\naxis = [0, 0.6, 0.8]\noffset = 0.1"),
        ("universal", axes),
        ("spherical", "realisation = \"bushing\""),
        ("fixed", "span = 0.2\naxis = [1, 0, 0]\narm = 0.1"),
    ] {
        for reversed in [false, true] {
            let ends = if reversed { ["forearm", "arm"] } else { ["arm", "forearm"] };
            let one = scene(&[
                body("arm", [0.3, 0.0, 0.0]),
                body("forearm", [0.6, 0.3, 0.1]),
                joint("shoulder", "revolute", ["world", "arm"], [0.0; 3], TURN),
                joint("elbow", kind, ends, [0.5, 0.1, 0.0], more),
            ]);
            let (two, text) = again(&one);
            let (gap, moved) = apart(&one, &two);
            assert!(
                gap < 2e-4 && moved > 0.05,
                "{kind} {reversed}: {gap:e} of {moved:e} m\n{text}"
            );
        }
    }
}

/// Limits, friction, damping, a motor, a coupling and shapes have their values; a free body stays free.
#[test]
fn what_acts_on_coordinates_comes_back() {
    let shapes = "[[geometry]]\nbody = \"arm\"\nshape = \"box\"\nat = [0.1, 0, 0]\nsize = [0.3, 0.02, 0.04]\n\
                  colour = \"#ff0000\"\n[[geometry]]\nbody = \"world\"\nshape = \"cylinder\"\nfrom = [0, 0, 0]\n\
                  to = [0, 0, -1]\nradius = 0.1\n[[geometry]]\nbody = \"cart\"\nshape = \"sphere\"\nradius = 0.05\n";
    let acts = "[[torsion_spring]]\nbetween = [\"arm\", \"world\"]\naxis = [-1, -0.5, 0]\nstiffness = 0\ndamping = 0.3\n\
                [[input]]\nname = \"motor\"\ntype = \"joint_torque\"\ntarget = \"shoulder\"\nrange = [-7, 7]\n\
                [[input]]\nname = \"push\"\ntype = \"joint_force\"\ntarget = \"rail\"\n\
                [[coupling]]\nof = [{ joint = \"rail\", factor = 2 }, { joint = \"shoulder\", factor = -0.5 }]\n\
                stiffness = 1e5\noffset = 0.01\n";
    let one = scene(&[
        body("arm", [0.3, 0.0, 0.0]),
        body("cart", [0.0, 1.0, 0.0]),
        body("ball", [0.0, 0.0, 2.0]),
        joint(
            "shoulder",
            "revolute",
            ["world", "arm"],
            [0.0; 3],
            &format!(
                "{TURN}\nlimits = {{ from = -0.5, to = 0.25, stiffness = 1e4 }}\nfriction = {{ coulomb = 0.2, viscous = 0.1 }}"
            ),
        ),
        joint(
            "rail",
            "translational",
            ["cart", "world"],
            [0.0, 1.0, 0.0],
            &format!("{SLIDE}\nlimits = {{ to = 0.3, stiffness = 1e4 }}"),
        ),
        acts.to_owned(),
        shapes.to_owned(),
    ]);
    let (two, text) = again(&one);
    for part in [
        "<robot name=\"a &amp; b\">",
        "<option gravity=\"1.0 0.0 -9.0\"/>",
        "lower=\"-0.5\" upper=\"0.25\"",
        "effort=\"7.0\" velocity=\"1000000.0\" lower",
        "lower=\"-1000.0\" upper=\"0.3\"",
        "<dynamics damping=\"0.4\" friction=\"0.2\"/>",
        "<mimic joint=\"shoulder\" multiplier=\"0.25\" offset=\"0.005\"/>",
        "<color rgba=\"1.000 0.000 0.000 1\"/>",
        "type=\"floating\"",
    ] {
        assert!(text.contains(part), "{part}\n{text}");
    }
    assert_eq!(two.body_names, ["arm", "cart", "ball"]);
    let laws: Vec<&str> = dbd_scene::interactions(&two).iter().map(|one| one.law).collect();
    assert_eq!(laws, ["hinge-stop", "hinge-friction", "end-stop", "coupling"]);
    let motors: Vec<_> = two.inputs.iter().map(|input| (input.name.as_str(), input.kind)).collect();
    assert_eq!(motors, [("motor", "joint_torque"), ("push", "joint_force")]);
    assert_eq!(two.inputs[0].range, [-7.0, 7.0]);
    assert_eq!((two.geometry.len(), two.torsion_springs()), (one.geometry.len(), 1));
    for (before, after) in one.model.bodies.iter().zip(&two.model.bodies) {
        let [mut a, mut b] = [before, after].map(|body| body.inertia.to_f64());
        a.sort_by(f64::total_cmp);
        b.sort_by(f64::total_cmp);
        let near = a.iter().zip(b).all(|(a, b)| (a - b).abs() < 1e-12);
        assert!(near && (before.mass - after.mass).abs() < 1e-12, "{before:?} {after:?}");
    }
}

/// What a URDF cannot hold is listed with its line, and left out on request only.
#[test]
fn what_a_urdf_cannot_hold_is_refused() {
    let folder = tempfile::tempdir().unwrap();
    let file = folder.path().join("f.urdf");
    let file = file.to_str().unwrap();
    let done = call(&["export", "four-bar", "--urdf", "--out", file]);
    assert!(done.err.contains("loop") && done.err.contains("--ignore loop"), "{}", done.err);
    assert!(!std::path::Path::new(file).exists());
    let done = call(&["export", "four-bar", "--urdf", "--ignore", "all", "--out", file]);
    assert!(done.err.contains("left out:\n  line "), "{}", done.err);
    let text = std::fs::read_to_string(file).unwrap();
    assert_eq!(text.matches("<joint name=").count(), 3, "{text}");
    // Its own file is replaced, another one is not.
    let done = call(&["export", "cart-pendulum", "--urdf", "--ignore", "all", "--out", file]);
    assert!(done.err.is_empty() || done.err.starts_with("note"), "{}", done.err);
    std::fs::write(file, "<robot/>").unwrap();
    let done = call(&["export", "cart-pendulum", "--urdf", "--ignore", "all", "--out", file]);
    assert!(done.err.contains("was not written by host-sim export"), "{}", done.err);
    for (name, kinds) in [
        ("spring-ball", vec![Lack::Spring]),
        ("double-wishbone", vec![Lack::Loop, Lack::Spring, Lack::Input]),
        ("gripper", vec![Lack::Loop]),
    ] {
        let scene = host_sim::terminal::Catalogue::default().load(name).unwrap().scene;
        let refused = urdf(&scene, &[]).unwrap_err();
        for kind in kinds {
            let found = refused.items.iter().any(|item| item.kind == kind && item.line.is_some());
            assert!(found, "{name} {kind:?}: {refused}");
            assert!(refused.to_string().contains(kind.name()), "{refused}");
        }
        assert!(urdf(&scene, Lack::ALL).is_ok());
    }
}

/// A drive lacks its rotor and an input its signal chain, each once; sensors are left out as read-outs are.
#[test]
fn drives_chains_and_sensors_are_named_by_what_they_lack() {
    let file = dbd_tests::results::path("docs/examples/gate-opener/gate-opener.toml");
    let gate = Scene::load(file).unwrap();
    let refused = urdf(&gate, &[]).unwrap_err();
    let kinds: Vec<Lack> = refused.items.iter().map(|item| item.kind).collect();
    assert_eq!(kinds, [Lack::Rotor], "{refused}");
    let chained = scene(&[
        body("arm", [0.3, 0.0, 0.0]),
        joint("shoulder", "revolute", ["world", "arm"], [0.0; 3], TURN),
        "[[input]]\nname = \"motor\"\ntype = \"joint_torque\"\ntarget = \"shoulder\"\nlag = 0.01\nlimits = [-3, 2]\n\
         [[interaction]]\nname = \"laser\"\nlaw = \"slide-sensor\"\nbetween = [\"world\", \"arm\"]\n\
         points = [[0, 0, 0], [0, 0, 0]]\naxis = [1, 0, 0]\ndelay = 0\nseed = 0\n"
            .to_owned(),
    ]);
    let refused = urdf(&chained, &[]).unwrap_err();
    let kinds: Vec<Lack> = refused.items.iter().map(|item| item.kind).collect();
    assert_eq!(kinds, [Lack::Input], "{refused}");
    let text = urdf(&chained, &[Lack::Input]).unwrap().text;
    assert!(
        text.contains("effort=\"3.0\"") && text.contains("<actuator name=\"motor\">"),
        "{text}"
    );
}

/// Links without mass between two joints are several joints of one body, in rotated frames.
#[test]
fn links_without_mass_join_their_joints() {
    let inertial = "<inertial><origin xyz='0.1 0 0'/><mass value='1'/><inertia ixx='0.01' iyy='0.01' izz='0.01' \
                    ixy='0' ixz='0' iyz='0'/></inertial>";
    let link = |between: &str| {
        format!(
            "<robot name='r'><link name='world'/><link name='m'>{between}</link><link name='b'>{inertial}</link>\
             <joint name='j' type='continuous'><origin xyz='0 0 1' rpy='0.3 0 0'/><parent link='world'/>\
             <child link='m'/><axis xyz='1 0 0'/></joint>\
             <joint name='k' type='continuous'><origin xyz='0 0 0' rpy='0 0.4 0'/><parent link='m'/>\
             <child link='b'/><axis xyz='0 1 0'/></joint></robot>"
        )
    };
    let scene = loaded(&of(&link(""), &Options::default()));
    assert_eq!((scene.joints.len(), scene.joints[0].kind), (1, "universal"));
    let [first, second] = scene.joints[0].axes.map(|axis| axis.to_f64());
    let near = |a: [f64; 3], b: [f64; 3]| a.iter().zip(b).all(|(a, b)| (a - b).abs() < 1e-12);
    let (sine, cosine) = 0.3_f64.sin_cos();
    assert!(
        near(first, [1.0, 0.0, 0.0]) && near(second, [0.0, cosine, sine]),
        "{first:?} {second:?}"
    );
    assert!(near(scene.joints[0].at.to_f64(), [0.0, 0.0, 1.0]));
    let (sine, cosine) = 0.4_f64.sin_cos();
    // 0.1 m along x, rotated about y by 0.4 rad, then about x by 0.3 rad.
    let [along, down] = [0.1 * cosine, 0.1 * sine];
    let expected = [along, down * 0.3_f64.sin(), 1.0 - down * 0.3_f64.cos()];
    assert!(
        near(scene.model.initial[0].position.to_f64(), expected),
        "{:?}",
        scene.model.initial[0]
    );
    // A link with a shape needs a mass of its own.
    let shape = "<visual><geometry><sphere radius='0.1'/></geometry></visual>";
    let options = Options::default();
    assert!(
        dbd_import::import_text(&link(shape), "r", std::path::Path::new(""), &options).is_err()
    );
}
