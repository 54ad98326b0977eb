//! Several joints of one body.

use dbd_import::{ImportError, Kind, Options, import_text};
use dbd_tests::page::{block, figure, table};

use crate::import::{distances, imported, loaded, of, worst};

fn start(stiffness: f64) -> Options {
    Options { stiffness, duration: 0.5, keyframe: Some("start".into()), ..Options::default() }
}

/// Universal, cylindrical, spherical joints, carriers, servos, tendons, springs of balls, meshes from a keyframe
/// on: off by what joints give way, which falls as 1/k.
#[test]
fn several_joints_and_servos_move_as_in_mujoco() {
    let of = |stiffness: f64| {
        let scene = loaded(&imported("several-joints.xml", &start(stiffness)));
        distances(&scene, "tests/command_line/import/several-joints.csv")
    };
    let (soft, stiff) = (of(1e6), of(1e7));
    assert!(worst(&stiff) < 1e-4, "{stiff:?}");
    assert!(worst(&stiff) < worst(&soft) / 5.0, "{soft:?} {stiff:?}");
    let rows: Vec<Vec<String>> = [("1e6", soft), ("1e7", stiff)]
        .into_iter()
        .map(|(k, distances)| {
            let figures = distances.iter().map(|(_, distance)| figure(distance * 1e3, 2));
            std::iter::once(k.to_owned()).chain(figures).collect()
        })
        .collect();
    let names = of_names();
    let head: Vec<&str> =
        std::iter::once("k [N/m]").chain(names.iter().map(String::as_str)).collect();
    block("docs/import.md", "several", &table(&head, &rows));
}

fn of_names() -> Vec<String> {
    let rows = dbd_tests::results::rows("tests/command_line/import/several-joints.csv");
    rows[0].names().filter_map(|column| column.strip_suffix(".x")).map(str::to_owned).collect()
}

/// Two slides and a hinge in a planar model: no joint, in a planar scene; their springs, servos, motors, too.
#[test]
fn a_body_may_slide_and_turn_in_the_plane() {
    let made = imported("in-the-plane.xml", &start(1e7));
    let scene = loaded(&made);
    assert!(scene.planar.is_some() && scene.joints.len() == 1, "{}", made.scene);
    let found = distances(&scene, "tests/command_line/import/in-the-plane.csv");
    assert!(worst(&found) < 1e-5, "{found:?}");
}

/// Two slides at right angles, alone and with a hinge across them, of a model in space: bushings, with springs, a servo,
/// motors, one of them at a tendon of one joint, and stops, whose rebounds are not MuJoCo's.
#[test]
fn a_body_may_slide_along_two_axes_in_space() {
    let of = |stiffness: f64| {
        let made = imported("two-slides.xml", &start(stiffness));
        let scene = loaded(&made);
        assert!(scene.planar.is_none() && scene.joints.len() == 2, "{}", made.scene);
        let laws = |law: &str| made.scene.matches(&format!("law = \"{law}\"")).count();
        // Four bodies, a spring, a damper and a servo along slides, and the damper of the trunk's slide.
        assert_eq!([laws("bushing"), laws("end-stop"), laws("hinge-stop")], [8, 4, 1]);
        distances(&scene, "tests/command_line/import/two-slides.csv")
    };
    let (soft, stiff) = (of(1e6), of(1e7));
    let apart =
        |of: &[(String, f64)], name: &str| of.iter().find(|(one, _)| one == name).unwrap().1;
    for name in ["table", "bob", "trunk", "leg", "sledge"] {
        let [soft, stiff] = [&soft, &stiff].map(|of| apart(of, name));
        assert!(stiff < 1e-5 && stiff < soft / 5.0, "{name}: {soft} {stiff}");
    }
    assert!(apart(&stiff, "puck") < 2e-3, "{stiff:?}");
}

/// Balls, a capsule and boxes on a slope roll, slip, slide and stay: off by what contacts give way, and by what
/// MuJoCo's are off.
#[test]
fn solids_on_a_slope_move_as_in_mujoco() {
    for (stiffness, most) in [(1e6, 3e-4), (1e7, 1e-4)] {
        let options = Options { stiffness, duration: 0.5, ..Options::default() };
        let scene = loaded(&imported("slope.xml", &options));
        assert_eq!(dbd_scene::interactions(&scene).len(), 21);
        let found = distances(&scene, "tests/command_line/import/slope.csv");
        assert!(worst(&found) < most, "{stiffness}: {found:?}");
    }
}

/// A ball rolls down a ball, another slides, two meet: off by what contacts give way, and by what MuJoCo's are off.
#[test]
fn balls_on_balls_move_as_in_mujoco() {
    let scene = loaded(&imported("balls.xml", &start(1e7)));
    let laws = dbd_scene::interactions(&scene);
    assert_eq!(laws.iter().filter(|one| one.law == "sphere-contact").count(), 3);
    let found = distances(&scene, "tests/command_line/import/balls.csv");
    // The rebounds of the last two differ, and half of MuJoCo's own error is theirs.
    for ((name, apart), most) in found.iter().zip([2e-3, 1e-5, 1e-2, 1e-2]) {
        assert!(*apart < most, "{name}: {found:?}");
    }
}

/// What comes to its limit is off by what stops give way, less with stiffer ones; what sticks, stays, slides and swings by
/// what friction gives before it is whole, whatever the joints' stiffness.
#[test]
fn limits_and_dry_friction_act_as_in_mujoco() {
    let trajectory = "tests/command_line/import/stops.csv";
    let of =
        |stiffness: f64| distances(&loaded(&imported("stops.xml", &start(stiffness))), trajectory);
    let (soft, stiff) = (of(1e6), of(1e7));
    let most = [3e-5, 3e-5, 3e-3, 4e-4, 2e-3, 4e-4, 7e-4];
    for (row, ((found, soft), most)) in stiff.iter().zip(&soft).zip(most).enumerate() {
        let falls = if row < 2 { found.1 < soft.1 } else { (found.1 / soft.1 - 1.0).abs() < 0.1 };
        assert!(found.1 < most && falls, "{found:?} {soft:?}");
    }
    let rows = [("1e6", &soft), ("1e7", &stiff)].map(|(k, distances)| {
        let figures = distances.iter().map(|(_, distance)| figure(distance * 1e3, 2));
        std::iter::once(k.to_owned()).chain(figures).collect::<Vec<_>>()
    });
    let names = stiff.iter().map(|(name, _)| name.as_str());
    let head: Vec<&str> = std::iter::once("k [N/m]").chain(names).collect();
    block("docs/import.md", "stops", &table(&head, &rows));
}

/// A body with these joints; where `parent` holds, on another that hangs at a hinge.
fn body(joints: &str, parent: bool) -> String {
    let own = format!(
        "<body name='b' pos='0.2 0.1 0'>{joints}\
         <inertial pos='0.1 0.02 0.03' mass='1' diaginertia='0.01 0.02 0.025'/></body>"
    );
    let world = if parent {
        format!(
            "<body name='a'><joint name='r' axis='1 0 0'/>\
             <inertial pos='0 0.1 0' mass='2' diaginertia='0.03 0.02 0.025'/>{own}</body>"
        )
    } else {
        own
    };
    format!("<mujoco>\n<worldbody>{world}</worldbody></mujoco>")
}

const X: &str = "<joint name='x' type='slide' axis='1 0 0'/>";
const Y: &str = "<joint name='y' type='slide' axis='0 1 0'/>";
const A: &str = "<joint name='p' axis='1 0 0' stiffness='1'/>";
const B: &str = "<joint name='q' axis='0 1 0'/>";
const SKEW: &str = "<joint name='y' type='slide' axis='0.1 1 0'/>";
const C: &str = "<joint name='w' axis='0 0 1'/>";

/// Which joints a scene says them with; a carrier takes no mass but that of its neighbours.
#[test]
fn joints_of_a_body_are_said_by_the_fewest_joints() {
    let skew = "<joint name='q' axis='0 1 0' pos='0 0 0.01'/>";
    let cases: [(String, bool, &[&str], usize); 9] = [
        ([A, B].concat(), true, &["universal"], 2),
        ([A, skew].concat(), true, &["revolute", "revolute"], 3),
        ([A, X].concat(), true, &["cylindrical"], 2),
        ([X, C].concat(), true, &["translational", "revolute"], 3),
        ([C, X].concat(), false, &["revolute", "translational"], 2),
        ([B, C, "<joint axis='1 0 0.1'/>"].concat(), true, &["spherical"], 2),
        ([X, Y].concat(), true, &[], 2),
        ([X, Y, C].concat(), true, &[], 2),
        ([A, "<joint type='ball' pos='0 0 0.1'/>"].concat(), true, &["revolute", "spherical"], 3),
    ];
    for (joints, parent, kinds, bodies) in cases {
        let made = of(&body(&joints, parent), &Options::default());
        let scene = loaded(&made);
        let own = scene.joints.iter().skip(usize::from(parent));
        let found: Vec<&str> = own.map(|joint| joint.kind).collect();
        assert_eq!((found.as_slice(), scene.body_names.len()), (kinds, bodies), "{joints}");
        let total: f64 = scene.model.bodies.iter().map(|body| body.mass).sum();
        // The world gives for nothing: a carrier on a hinge of it turns about that hinge alone.
        let least = if parent { 3.0 } else { 1.0 };
        assert!(total > least - 1e-12 && (!parent || total < least + 1e-12), "{joints}: {total}");
        assert_eq!(made.notes.iter().any(|note| note.contains("b.carrier")), kinds.len() > 1);
    }
}

/// What neither joints nor carriers say exactly is refused with the way on; a stated share says it nearly, and
/// ignored it is left with its first joint.
#[test]
fn joints_that_cannot_be_said_exactly_are_refused() {
    let spring = "<joint name='q' axis='0 1 0' damping='0.1'/>";
    for (joints, named) in
        [([X, SKEW, C].concat(), "slide `y`"), ([A, spring, C].concat(), "hinge `w`")]
    {
        let text = body(&joints, true);
        let refused = import_text(&text, "test.xml", "".as_ref(), &Options::default());
        let Err(ImportError::Omitted { omissions, .. }) = refused else { panic!("{refused:?}") };
        let [one] = &omissions[..] else { panic!("{omissions:?}") };
        assert_eq!((one.kind, one.line), (Kind::Joints, 2));
        assert!(one.what.contains(named) && one.what.contains("--carriers"), "{}", one.what);
        let near = of(&text, &Options { carriers: Some(0.02), ..Options::default() });
        assert!(near.omitted.is_empty() && near.notes.iter().any(|note| note.contains("0.02")));
        let total: f64 = loaded(&near).model.bodies.iter().map(|body| body.mass).sum();
        assert!((total - 3.0).abs() < 1e-12, "{total}");
        let first = of(&text, &Options { ignored: vec![Kind::Joints], ..Options::default() });
        let scene = loaded(&first);
        assert_eq!(scene.body_names, ["a", "b"]);
        assert_eq!(scene.joints.len(), 2);
    }
    // Stops cannot lock a coordinate.
    let locked = X.replace("/>", " range='0.1 0.1' limited='true'/>");
    let refused = import_text(
        &body(&[&locked, Y].concat(), false),
        "t.xml",
        "".as_ref(),
        &Options::default(),
    );
    let Err(ImportError::Omitted { omissions, .. }) = refused else { panic!("{refused:?}") };
    assert_eq!(omissions.iter().map(|one| one.kind).collect::<Vec<_>>(), [Kind::Limit]);
    let spatial = body(&[X, SKEW, C].concat(), false);
    let refused = import_text(&spatial, "test.xml", "".as_ref(), &Options::default());
    let Err(ImportError::Omitted { omissions, .. }) = refused else { panic!("{refused:?}") };
    assert!(omissions[0].what.contains("the model is not planar"), "{omissions:?}");
}
