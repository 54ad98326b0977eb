//! Inputs, read-outs, clearances and names of elements: what a scene file makes of them.

use dbd_kernel::elements::input::InputKind;
use dbd_kernel::elements::source::{Source, SourceLaw};
use dbd_kernel::readouts::Readout;
use dbd_kernel::{BodyIndex, GroupIndex, InputIndex, LoadFrame, TorsionIndex, Vec3};
use dbd_scene::Scene;

const BODIES: &str = r#"
name = "driven"
duration = 1
[[body]]
name = "arm"
mass = 1
inertia = [0.01, 0.01, 0.01]
position = [0.5, 0, 0]
orientation = { axis = [0, 0, 1], angle = 1.5707963267948966 }
[[body]]
name = "hand"
mass = 1
inertia = [0.01, 0.01, 0.01]
position = [1.5, 0, 0]
[[joint]]
name = "elbow"
type = "revolute"
between = ["arm", "hand"]
at = [1, 0, 0]
axis = [0, 2, 0]
stiffness = 1e5
span = 0.1
clearance = 1e-4
[[joint]]
name = "ball"
type = "spherical"
between = ["world", "arm"]
at = [0, 0, 0]
stiffness = 1e5
arm = 0.1
[[joint]]
name = "cross"
type = "universal"
between = ["arm", "world"]
at = [0, 1, 0]
axes = [[1, 0, 0], [0, 0, 1]]
spider = { mass = 0.1, inertia = [1e-4, 1e-4, 1e-4] }
stiffness = 1e5
span = 0.1
[[tsda]]
name = "cord"
between = ["hand", "world"]
points = [[0, 0, 0], [1.5, 1, 0]]
stiffness = 10
free_length = 0.5
[[point_on_line]]
name = "rail"
between = ["world", "hand"]
line_point = [0, 0, 1]
line_direction = [1, 0, 0]
point = [0, 0, 0]
stiffness = 5
free_length = 0
clearance = 0.02
[[torsion_spring]]
name = "coil"
between = ["arm", "hand"]
axis = [0, 1, 0]
stiffness = 2
"#;

fn scene(driven: &str) -> Scene {
    let text = format!("{BODIES}{driven}");
    Scene::parse(&text, "driven.toml").unwrap_or_else(|e| panic!("{} ({})", e.message(), e.help()))
}

fn input(name: &str, keys: &str) -> String {
    format!("[[input]]\nname = \"{name}\"\n{keys}\n")
}

fn readout(name: &str, keys: &str) -> String {
    format!("[[readout]]\nname = \"{name}\"\n{keys}\n")
}

fn near(a: Vec3<f64>, b: [f64; 3]) {
    let d = a - Vec3::from_f64(b);
    assert!(d.dot(d) < 1e-28, "{a:?} {b:?}");
}

#[test]
fn inputs_become_what_their_types_say() {
    let scene = scene(
        &[
            input("f", "type = \"force\"\nbody = \"hand\"\npoint = [0, 0, 3]\naxis = [0, 5, 0]"),
            input("t", "type = \"torque\"\nbody = \"arm\"\naxis = [0, 0, 1]\nframe = \"body\""),
            input("j", "type = \"joint_torque\"\ntarget = \"elbow\"\nvalue = 3"),
            input("a", "type = \"actuator\"\ntarget = \"cord\""),
            input("b", "type = \"joint_torque\"\ntarget = \"ball\"\naxis = [0, 0, 4]"),
            input("c", "type = \"joint_torque\"\ntarget = \"cross\"\nabout = \"second\""),
            input("s", "type = \"joint_torque\"\ntarget = \"coil\""),
        ]
        .concat(),
    );
    let inputs = &scene.model.inputs;
    assert_eq!(
        inputs[0].kind,
        InputKind::Force {
            body: BodyIndex(1),
            point: Vec3::new(0.0, 0.0, 3.0),
            direction: Vec3::new(0.0, 1.0, 0.0),
            frame: LoadFrame::World
        }
    );
    let axis = Vec3::new(0.0, 0.0, 1.0);
    assert_eq!(
        inputs[1].kind,
        InputKind::Torque { body: BodyIndex(0), axis, frame: LoadFrame::Body }
    );
    // The arm is turned by a quarter about z: the world's y is its x.
    let InputKind::JointTorque { a, b, axes: [axis, _] } = inputs[2].kind else {
        panic!("a joint's torque")
    };
    assert_eq!((a, b, inputs[2].value), (BodyIndex(0), BodyIndex(1), 3.0));
    near(axis, [1.0, 0.0, 0.0]);
    // The groups are the elbow, the ball, two of the cross, the cord and the rail.
    assert_eq!(inputs[3].kind, InputKind::Actuator { group: GroupIndex(4), element: 0 });
    let InputKind::JointTorque { a, b, axes: [axis, _] } = inputs[4].kind else {
        panic!("a ball's torque")
    };
    assert_eq!((a, b), (BodyIndex::WORLD, BodyIndex(0)));
    near(axis, [0.0, 0.0, 1.0]);
    // The spider's axes are the two axes and their product.
    let InputKind::JointTorque { a, b, axes: [axis, _] } = inputs[5].kind else {
        panic!("a cross' torque")
    };
    assert_eq!((a, b), (BodyIndex(2), BodyIndex::WORLD));
    near(axis, [0.0, 1.0, 0.0]);
    let InputKind::JointTorque { axes: [axis, _], .. } = inputs[6].kind else {
        panic!("a coil's torque")
    };
    near(axis, [1.0, 0.0, 0.0]);
    let infos: Vec<_> = scene.inputs.iter().map(|i| (i.kind, i.unit, i.table)).collect();
    assert_eq!(infos[..2], [("force", "N", false), ("torque", "N·m", false)]);
}

#[test]
fn tables_become_knots_with_slopes() {
    let table = "type = \"actuator\"\ntarget = \"cord\"\ntable = [[0, 1], [0.5, 2], [1.5, 0]]";
    let linear = format!("{table}\ninterpolate = \"linear\"");
    let scene = scene(&(input("held", table) + &input("linear", &linear)));
    let knots: Vec<_> = scene.model.knots.iter().map(|k| (k.time, k.value, k.slope)).collect();
    assert_eq!(knots[..3], [(0.0, 1.0, 0.0), (0.5, 2.0, 0.0), (1.5, 0.0, 0.0)]);
    assert_eq!(knots[3..], [(0.0, 1.0, 2.0), (0.5, 2.0, -2.0), (1.5, 0.0, 0.0)]);
    assert_eq!((scene.model.inputs[1].knot, scene.model.inputs[1].knots), (3, 3));
    assert!(scene.inputs[0].table);
}

#[test]
fn sines_and_tables_that_repeat_become_sources() {
    let on = "type = \"actuator\"\ntarget = \"cord\"\n";
    let sine = "sine = { amplitude = \"2 kN\", frequency = 50, phase = \"180 deg\", offset = 1 }";
    let table = "table = [[-1, 1], [0.5, 2], [1, 1]]\nperiodic = true\ninterpolate = \"linear\"";
    let text = input("sine", &format!("{on}{sine}")) + &input("again", &format!("{on}{table}"));
    let found = scene(&text);
    assert!(found.inputs[..2].iter().all(|info| info.table));
    let sources = &found.model.sources;
    let expected = Source::sine(InputIndex(0), [2000.0, 50.0, std::f64::consts::PI, 1.0]);
    assert_eq!(sources[0], expected);
    let law = SourceLaw::Periodic { period: 2.0 };
    assert_eq!(sources[1], Source { input: InputIndex(1), knot: 0, knots: 2, law });
    let knots: Vec<_> = found.model.knots.iter().map(|k| (k.time, k.value, k.slope)).collect();
    assert_eq!(knots[0].0, -1.0);
    assert_eq!(knots[1], (0.5, 2.0, -2.0));
    // Another value by its path, and back to the caller.
    let mut changed = found.with("input.sine.sine.amplitude=5").unwrap();
    assert_eq!(changed.model.sources[0].most(&[])[0], 6.0);
    changed.release_all();
    assert!(changed.model.sources.is_empty() && changed.model.inputs[0].value == 1.0);
    assert_eq!(changed.model.inputs[1].value, 1.0);
    // A const model has them, too.
    let source = dbd_scene::export::model::<f32>(&found);
    for part in
        ["Source { input: InputIndex(0), knot: 0, knots: 0, law: SourceLaw::Sine {", "Periodic {"]
    {
        assert!(source.contains(part), "{source}");
    }
}

#[test]
fn gravity_has_a_direction_in_the_world() {
    let found =
        scene(&input("tilt", "type = \"gravity\"\naxis = [0, 0, -2]\nvalue = \"0.5 m/s^2\""));
    let direction = Vec3::new(0.0, 0.0, -1.0);
    assert_eq!(found.model.inputs[0].kind, InputKind::Gravity { direction });
    assert_eq!((found.model.inputs[0].value, found.inputs[0].unit), (0.5, "m/s²"));
    let source = dbd_scene::export::model::<f32>(&found);
    let part = "Input { kind: InputKind::Gravity { direction: Vec3::new(f32::from_bits(0x00000000), \
                f32::from_bits(0x00000000), f32::from_bits(0xbf800000)) }, value: f32::from_bits(0x3f000000)";
    assert!(source.contains(part), "{source}");
    for (keys, part) in [("", "`axis`"), ("axis = [0, 0, 1]\nbody = \"arm\"", "`body`")] {
        let text = input("tilt", &format!("type = \"gravity\"\n{keys}"));
        let error = Scene::parse(&format!("{BODIES}{text}"), "tilt.toml").unwrap_err();
        assert!(error.message().contains(part), "{}", error.message());
    }
}

#[test]
fn an_anchor_moves_the_grounds_end_of_its_elements() {
    let road = "type = \"anchor\"\ntarget = [\"cord\", \"ball\", \"cross\"]\naxis = [0, 0, 2]";
    let scene =
        scene(&(input("first", "type = \"actuator\"\ntarget = \"cord\"") + &input("road", road)));
    let anchor = BodyIndex::anchor(InputIndex(1));
    let groups: Vec<_> = scene.model.groups.iter().map(|group| (group.a, group.b)).collect();
    let [arm, hand, spider] = [0, 1, 2].map(BodyIndex);
    assert_eq!(
        groups,
        [
            (arm, hand),
            (anchor, arm),
            (arm, spider),
            (spider, anchor),
            (hand, anchor),
            (BodyIndex::WORLD, hand)
        ]
    );
    assert_eq!(
        scene.model.inputs[1].kind,
        InputKind::Anchor { direction: Vec3::new(0.0, 0.0, 1.0) }
    );
    let twice = input("a", "type = \"anchor\"\ntarget = \"cord\"\naxis = [0, 0, 1]")
        + &input("b", "type = \"anchor\"\ntarget = \"cord\"\naxis = [0, 1, 0]");
    let error = Scene::parse(&format!("{BODIES}{twice}"), "twice.toml").unwrap_err();
    assert!(error.message().contains("which input 1 already moves"), "{}", error.message());
}

#[test]
fn an_angle_is_counted_by_a_torsion_spring_that_is_there_or_added() {
    let scene = scene(
        &[
            readout("coil", "type = \"joint_rate\"\ntarget = \"coil\""),
            readout("elbow", "type = \"joint_angle\"\ntarget = \"elbow\""),
            readout("ball", "type = \"joint_angle\"\ntarget = \"ball\"\naxis = [0, 0, 1]"),
            readout("rate", "type = \"joint_rate\"\ntarget = \"ball\"\naxis = [0, 0, 1]"),
        ]
        .concat(),
    );
    let springs = scene.readouts.iter().map(|info| match info.readout {
        Readout::JointAngle { spring, .. } | Readout::JointRate { spring } => spring,
        other => panic!("{other:?}"),
    });
    assert_eq!(springs.collect::<Vec<_>>(), [0, 0, 1, 1].map(TorsionIndex));
    assert_eq!((scene.torsion_springs(), scene.model.torsions.len()), (1, 2));
    assert_eq!(scene.torsion_names, ["torsion_spring `coil` (arm–hand)", "readout `ball`"]);
    let added = &scene.model.torsions[1];
    assert_eq!((added.stiffness, added.preload, added.damper.row()), (0.0, 0.0, None));
    // What only counts is not warned of.
    let about =
        |name: &str| dbd_scene::warnings(&scene).iter().any(|warning| warning.name.contains(name));
    assert!(!about("readout"));
}

#[test]
fn read_outs_become_what_their_types_say() {
    let scene = scene(
        &[
            input("i", "type = \"actuator\"\ntarget = \"cord\""),
            readout("p", "type = \"point\"\nbody = \"hand\"\npoint = [1, 2, 3]"),
            readout("v", "type = \"point_velocity\"\nbody = \"arm\""),
            readout("t", "type = \"tsda_force\"\ntarget = \"cord\""),
            readout("f", "type = \"joint_force\"\ntarget = \"cross\""),
            readout("m", "type = \"imu\"\nbody = \"arm\""),
            readout("s", "type = \"input\"\ntarget = \"i\""),
        ]
        .concat(),
    );
    let readouts: Vec<_> = scene.readouts.iter().map(|info| info.readout).collect();
    let point = Vec3::new(1.0, 2.0, 3.0);
    assert_eq!(
        readouts,
        [
            Readout::Point { body: BodyIndex(1), point },
            Readout::PointVelocity { body: BodyIndex(0), point: Vec3::ZERO },
            Readout::TsdaForce { group: GroupIndex(4), element: 0 },
            Readout::JointForce { group: GroupIndex(3) },
            Readout::Imu { body: BodyIndex(0), point: Vec3::ZERO },
            Readout::Input { input: InputIndex(0) },
        ]
    );
    let units: Vec<_> = scene.readouts.iter().map(|info| info.columns[0]).collect();
    assert_eq!(
        units,
        [(".x", "m"), (".x", "m/s"), ("", "N"), (".x", "N"), (".ax", "m/s²"), ("", "N")]
    );
    assert_eq!(scene.readouts[4].columns.len(), 6);
}

#[test]
fn clearances_are_the_groups_that_name_them() {
    let scene = scene("");
    let rows: Vec<_> = scene.model.groups.iter().map(|group| group.clearance.row()).collect();
    assert_eq!(rows, [Some(0), None, None, None, None, Some(1)]);
    assert_eq!(scene.model.clearances, [1e-4, 0.02]);
}

#[test]
fn names_are_looked_up_and_the_nearest_is_offered() {
    let scene = scene(
        &(input("drive", "type = \"actuator\"\ntarget = \"cord\"")
            + &readout("angle", "type = \"joint_angle\"\ntarget = \"elbow\"")),
    );
    assert_eq!(scene.input("drive"), Ok(InputIndex(0)));
    assert_eq!(
        scene.readout("angle"),
        Ok(Readout::JointAngle { spring: TorsionIndex(0), offset: 0.0 })
    );
    assert_eq!(
        scene.input("drvie").unwrap_err().to_string(),
        "the scene `driven` has no input `drvie`; did you mean `drive`?"
    );
    assert_eq!(
        scene.readout("speed").unwrap_err().to_string(),
        "the scene `driven` has no readout `speed`"
    );
}

/// Points and axis are those of the laws of the joint: on its axis, in the axes of each body.
#[test]
fn a_force_and_a_travel_are_along_the_axis_of_their_joint() {
    let joint = "[[joint]]\nname = \"sleeve\"\ntype = \"cylindrical\"\nbetween = [\"arm\", \"hand\"]\n\
                 at = [1, 0.2, 0]\naxis = [2, 0, 0]\nspan = 0.1\noffset = 0.02\nstiffness = 1e5\n";
    let target = |kind: &str| format!("type = \"{kind}\"\ntarget = \"sleeve\"");
    let scene = scene(
        &[
            joint.to_owned(),
            input("push", &target("joint_force")),
            readout("travel", &format!("{}\noffset = \"2 cm\"", target("joint_travel"))),
            readout("rate", &target("joint_travel_rate")),
        ]
        .concat(),
    );
    let (arm, hand) = (BodyIndex(0), BodyIndex(1));
    let InputKind::JointForce { a, b, point, axis } = scene.model.inputs[0].kind else {
        panic!("a force along a joint")
    };
    assert_eq!((a, b), (arm, hand));
    near(point, [-0.5, 0.2, 0.0]);
    // The arm is turned by a quarter about z: the world's x is its -y.
    near(axis, [0.0, -1.0, 0.0]);
    let Readout::JointTravel { slide, offset } = scene.readouts[0].readout else {
        panic!("a travel")
    };
    assert_eq!((slide.bodies, offset), ([arm, hand], 0.02));
    near(slide.points[0], [0.2, -0.5, 0.0]);
    assert_eq!((slide.points[1], slide.axis), (point, axis));
    assert_eq!(scene.readouts[1].readout, Readout::JointTravelRate { slide });
    assert_eq!(scene.inputs[0].unit, "N");
    let units: Vec<_> = scene.readouts.iter().map(|info| info.columns[0]).collect();
    assert_eq!(units, [("", "m"), ("", "m/s")]);
}
