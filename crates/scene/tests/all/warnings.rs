//! Each warning once, and none for the scenes that ship.

use std::path::Path;

use dbd_scene::{Scene, Severity};

/// An arm on a revolute with a hand on a fixed joint; nothing about it is odd.
const BASE: &str = r#"name = "base"
duration = 1
gravity = [0, 0, -9.81]

[[body]]
name = "arm"
mass = 1
inertia = [0.01, 0.1, 0.1]
position = [0.5, 0, 0]

[[body]]
name = "hand"
mass = 0.5
inertia = [0.01, 0.01, 0.01]
position = [1.1, 0, 0]

[[joint]]
name = "shoulder"
type = "revolute"
between = ["world", "arm"]
at = [0, 0, 0]
axis = [0, 1, 0]
stiffness = 1e5
span = 0.1

[[joint]]
name = "wrist"
type = "fixed"
between = ["arm", "hand"]
at = [1, 0, 0]
axis = [1, 0, 0]
stiffness = 1e4
span = 0.1
arm = 0.03

[[tsda]]
between = ["world", "hand"]
points = [[1, 0, 0.5], [0, 0, 0]]
stiffness = 10
free_length = 0.4

[[torsion_spring]]
between = ["world", "arm"]
axis = [0, 1, 0]
stiffness = 5
"#;

fn warnings(text: &str) -> Vec<(Severity, String)> {
    let scene = Scene::parse(text, "base.toml").unwrap_or_else(|e| panic!("{e}\n{text}"));
    dbd_scene::warnings(&scene).into_iter().map(|w| (w.severity, w.to_string())).collect()
}

#[test]
fn the_base_scene_and_all_that_ship_are_not_warned_of() {
    assert_eq!(warnings(BASE), []);
    let scenes = Path::new(env!("CARGO_MANIFEST_DIR")).join("../../scenes");
    for file in std::fs::read_dir(scenes).unwrap() {
        let scene = Scene::load(file.unwrap().path()).unwrap_or_else(|error| panic!("{error}"));
        let odd: Vec<_> = dbd_scene::warnings(&scene)
            .into_iter()
            .filter(|w| w.severity == Severity::Warning)
            .collect();
        assert!(odd.is_empty(), "{}: {odd:#?}", scene.name);
    }
}

const WARNING: Severity = Severity::Warning;
const NOTE: Severity = Severity::Note;

/// What stands in the base scene, what stands there instead, and all that is said of it.
type Case = (&'static str, &'static str, &'static [(Severity, &'static str)]);

#[rustfmt::skip]
const CASES: &[Case] = &[
    // Angles without a unit at any key; one with a unit is meant.
    ("position = [0.5, 0, 0]", "position = [0.5, 0, 0]\norientation = { axis = [0, 1, 0], angle = \"720 deg\" }", &[]),
    ("gravity = ", "points.far = { from = [0, 0, 0], distance = 1, angle = 60 }\ngravity = ",
        &[(WARNING, "point `far` (line 3): `angle` is 60 rad, more than one revolution: 60 deg \
                     would be 1.05 rad")]),
    ("axis = [0, 1, 0]\nstiffness = 5\n", "axis = [0, 1, 0]\nstiffness = { load = 5, deflection = 10 }\n",
        &[(WARNING, "torsion_spring 1 (line 45): `deflection` of its stiffness is 10 rad, more \
                     than one revolution: 10 deg would be 0.1745 rad")]),
    // Bodies.
    ("[[joint]]\nname = \"shoulder\"", "[[body]]\nname = \"loose\"\nmass = 1\ninertia = [1, 1, 1]\nposition = [9, 0, 0]\n\n[[joint]]\nname = \"shoulder\"",
        &[(WARNING, "body `loose` (line 17): no element acts on it: it falls freely")]),
    ("inertia = [0.01, 0.1, 0.1]", "inertia = [1e-5, 1e-4, 1e-4]",
        &[(WARNING, "body `arm` (line 5): its inertia gives a radius of gyration of 0.01 m, but \
                     elements act 0.55 m from its centre of mass; check that the inertia is in \
                     kg·m² and the point in m")]),
    ("inertia = [0.01, 0.01, 0.01]", "inertia = [1e4, 1e4, 1e4]",
        &[(WARNING, "body `hand` (line 11): its inertia gives a radius of gyration of 141.42 m, \
                     but all elements act within 0.153 m of its centre of mass; check that the \
                     inertia is in kg·m²")]),
    ("inertia = [0.01, 0.1, 0.1]", "inertia = [1e-8, 0.1, 0.1]",
        &[(WARNING, "body `arm` (line 5): its principal moments differ by a factor of 1e7: the \
                     smallest may limit the step size")]),
    ("mass = 0.5\ninertia = [0.01, 0.01, 0.01]", "mass = 5e-7\ninertia = [1e-9, 1e-9, 1e-9]",
        &[(WARNING, "body `hand` (line 11): has 5e-7 of the mass of `arm`: its vibration limits \
                     the step size of the whole scene")]),
    ("[[joint]]\nname = \"wrist\"\ntype = \"fixed\"\nbetween = [\"arm\", \"hand\"]\nat = [1, 0, 0]\naxis = [1, 0, 0]\nstiffness = 1e4\nspan = 0.1\narm = 0.03\n\n[[tsda]]\nbetween = [\"world\", \"hand\"]\npoints = [[1, 0, 0.5], [0, 0, 0]]\nstiffness = 10\nfree_length = 0.4\n",
        "[[torsion_spring]]\nbetween = [\"world\", \"hand\"]\naxis = [0, 1, 0]\nstiffness = 1\n",
        &[(WARNING, "body `hand` (line 11): only torsion springs act on it: nothing constrains its \
                     position"),
          (NOTE, "torsion_spring 1 (world–hand) (line 26): no revolute joint guides its two \
                  bodies: its torsion angle is undefined after half a revolution about another \
                  axis")]),
    // Joints and raw elements.
    ("stiffness = 1e4", "stiffness = 0",
        &[(WARNING, "joint `wrist` (line 26): has neither stiffness nor damping: it has no effect")]),
    ("stiffness = 1e4", "stiffness = 0\ndamping = 1",
        &[(WARNING, "joint `wrist` (line 26): has damping but no stiffness: it constrains no \
                     position")]),
    ("position = [1.1, 0, 0]", "position = [1.1, 0, 0]\nvelocity = [0, 0.5, 0]",
        &[(NOTE, "joint `wrist` (line 27): the initial velocities separate it at 0.5 m/s: it will \
                  oscillate")]),
    ("stiffness = 10\n", "stiffness = 0\n",
        &[(WARNING, "tsda 1 (world–hand) (line 36): has neither stiffness nor damping: it has no \
                     effect")]),
    ("free_length = 0.4", "free_length = 0.1",
        &[(WARNING, "tsda 1 (world–hand) (line 36): is 0.5099 m long at t = 0, more than twice its \
                     free length of 0.1 m; check that its points are in the axes of their bodies")]),
    ("[[torsion_spring]]", "[[point_on_line]]\nbetween = [\"world\", \"hand\"]\nline_point = [0, 0, 1]\nline_direction = [1, 0, 0]\npoint = [0, 0, 0]\nstiffness = 2\nfree_length = 0.3\n\n[[torsion_spring]]",
        &[(WARNING, "point_on_line 1 (world–hand) (line 42): is 1 m long at t = 0, more than twice \
                     its free length of 0.3 m; check that its points are in the axes of their \
                     bodies")]),
    // Springs: on the side on which what the name says does not act, far too short, full of energy.
    ("[[tsda]]\n", "[[tsda]]\nname = \"left rope\"\n",
        &[(NOTE, "tsda `left rope` (world–hand) (line 36): acts in both directions: unlike a rope \
                  it also pushes when it gets too short; use the law `distance-stop` of an \
                  interaction")]),
    ("[[tsda]]\nbetween = [\"world\", \"hand\"]\npoints = [[1, 0, 0.5], [0, 0, 0]]\nstiffness = 10\nfree_length = 0.4\n", "[[tsda]]\nname = \"ropes\"\nbetween = [\"world\", \"hand\"]\npoints = [[1, 0, 0.5], [0, 0, 0]]\nstiffness = 10\nfree_length = 0.6\n",
        &[(WARNING, "tsda `ropes` (world–hand) (line 36): pushes at t = 0, unlike a rope: it is \
                     0.5099 m long and its free length is 0.6 m; change the free length, or use \
                     the law `distance-stop` of an interaction, which acts in one direction")]),
    ("[[tsda]]\n", "[[tsda]]\nname = \"end_stop\"\n",
        &[(WARNING, "tsda `end_stop` (world–hand) (line 36): pulls at t = 0, unlike a stop: it is \
                     0.5099 m long and its free length is 0.4 m; change the free length, or use \
                     the law `distance-stop` of an interaction, which acts in one direction")]),
    ("free_length = 0.4", "free_length = 1.1",
        &[(WARNING, "tsda 1 (world–hand) (line 36): is 0.5099 m long at t = 0, less than half its \
                     free length of 1.1 m; check that its points are in the axes of their bodies \
                     and its free length is in m")]),
    ("stiffness = 10\nfree_length = 0.4", "stiffness = 2e6\nfree_length = 0.45",
        &[(WARNING, "tsda 1 (world–hand) (line 36): stores 3588.24 J at t = 0, enough to \
                     accelerate the 1.5 kg of its bodies to 69.17 m/s; check its points, free \
                     length and stiffness, or add a `clearance`")]),
    ("[[torsion_spring]]\n", "[[torsion_spring]]\nname = \"stop\"\n",
        &[(NOTE, "torsion_spring `stop` (world–arm) (line 42): acts in both directions, unlike a \
                  stop; use the `limits` of a joint, which act only outside their range")]),
    // Joints between two bodies.
    ("[[tsda]]\n", "[[joint]]\nname = \"second\"\ntype = \"revolute\"\nbetween = [\"arm\", \"world\"]\nat = [0.3, 0, 0]\naxis = [0, 1, 0]\nstiffness = 1e5\nspan = 0.1\n\n[[tsda]]\n",
        &[(WARNING, "joint `second` (line 36): together with joint `shoulder` leaves `arm` and \
                     `world` no relative motion: hinges between two bodies must share one axis; \
                     check the bodies, or use a `fixed` joint")]),
    ("[[tsda]]\n", "[[joint]]\nname = \"second\"\ntype = \"revolute\"\nbetween = [\"arm\", \"world\"]\nat = [0, 0.3, 0]\naxis = [0, 1, 0]\nstiffness = 1e5\nspan = 0.1\n\n[[tsda]]\n", &[]),
    // Torsion springs.
    ("axis = [0, 1, 0]\nstiffness = 5\n", "axis = [0, 1, 0]\nstiffness = 0\n",
        &[(WARNING, "torsion_spring 1 (world–arm) (line 42): has neither stiffness nor damping nor \
                     preload: it has no effect")]),
    ("axis = [0, 1, 0]\nstiffness = 5\n", "axis = [0, -1, 0.1]\nstiffness = 5\n",
        &[(WARNING, "torsion_spring 1 (world–arm) (line 42): its axis is 5.71 degrees off that of \
                     the revolute joint `shoulder` between the same bodies")]),
    ("between = [\"world\", \"arm\"]\naxis = [0, 1, 0]\nstiffness = 5\n", "between = [\"arm\", \"hand\"]\naxis = [0, 1, 0]\nstiffness = 5\n",
        &[(NOTE, "torsion_spring 1 (arm–hand) (line 42): no revolute joint guides its two bodies: \
                  its torsion angle is undefined after half a revolution about another axis")]),
    // Interactions: a body that a stop catches is no loose one, friction holds no place, a stop is engaged at t = 0.
    ("[[joint]]\nname = \"shoulder\"", "[[body]]\nname = \"ball\"\nmass = 1\ninertia = [1, 1, 1]\nposition = [9, 0, 1]\n\n[[interaction]]\nlaw = \"end-stop\"\nbetween = [\"world\", \"ball\"]\npoints = [[900, 0, 0], [0, 0, -0.5]]\nnormal = [0, 0, 1]\nstiffness = 1e4\n\n[[joint]]\nname = \"shoulder\"", &[]),
    ("[[joint]]\nname = \"shoulder\"", "[[body]]\nname = \"ball\"\nmass = 1\ninertia = [1, 1, 1]\nposition = [9, 0, 0.4]\n\n[[interaction]]\nname = \"floor\"\nlaw = \"end-stop\"\nbetween = [\"world\", \"ball\"]\npoints = [[9, 0, 0], [0, 0, -0.5]]\nnormal = [0, 0, 1]\nstiffness = 1e4\n\n[[joint]]\nname = \"shoulder\"",
        &[(WARNING, "interaction `floor` (world–ball) (line 23): is engaged at t = 0: a depth of 0.1 m, 1000 N; check its geometry, or start in equilibrium with `settle = true`")]),
    ("[[joint]]\nname = \"shoulder\"", "[[body]]\nname = \"rotor\"\nmass = 1\ninertia = [1, 1, 1]\nposition = [9, 0, 0]\n\n[[interaction]]\nlaw = \"hinge-friction\"\nbetween = [\"world\", \"rotor\"]\naxis = [0, 0, 1]\ncoulomb = 1\nbreakaway = 1\n\n[[joint]]\nname = \"shoulder\"",
        &[(WARNING, "body `rotor` (line 17): only torsion springs or interactions about an axis \
                     act on it: nothing constrains its position")]),
    ("[[tsda]]\n", "[[interaction]]\nname = \"stop\"\nlaw = \"hinge-stop\"\nbetween = [\"world\", \"arm\"]\naxis = [0, 1, 0]\nfrom = \"5 deg\"\nto = 1\nstiffness = 100\n\n[[tsda]]\n",
        &[(WARNING, "interaction `stop` (world–arm) (line 36): is engaged at t = 0: a depth of 0.0873 rad, 8.73 N·m; check its geometry, or start in equilibrium with `settle = true`")]),
    // Inputs and read-outs.
    ("[[torsion_spring]]", "[[input]]\nname = \"wind\"\ntype = \"force\"\nbody = \"hand\"\naxis = [0, 1, 0]\ntable = [[0, 0], [200, 0], [300, -4]]\ninterpolate = \"linear\"\n\n[[torsion_spring]]",
        &[(WARNING, "input `wind` (line 42): 2 of the 3 times of its table are after the end of \
                     the run at 1 s, the last at 300 s; check that they are in s and that the \
                     `duration` is long enough")]),
    ("[[torsion_spring]]", "[[input]]\nname = \"wind\"\ntype = \"force\"\nbody = \"hand\"\naxis = [0, 1, 0]\ntable = [[0, 0], [0.5, 1], [3, -4]]\ninterpolate = \"linear\"\n\n[[torsion_spring]]", &[]),
    ("[[torsion_spring]]", "[[input]]\nname = \"wind\"\ntype = \"force\"\nbody = \"hand\"\naxis = [0, 1, 0]\ntable = [[0, 0], [1.5, -4]]\n\n[[torsion_spring]]",
        &[(WARNING, "input `wind` (line 42): 1 of the 2 times of its table are after the end of \
                     the run at 1 s, the last at 1.5 s; check that they are in s and that the \
                     `duration` is long enough")]),
    ("[[torsion_spring]]", "[[input]]\nname = \"wind\"\ntype = \"force\"\nbody = \"hand\"\naxis = [0, 1, 0]\ntable = [[-1, 0], [-0.5, -4], [0, 0]]\nperiodic = true\n\n[[torsion_spring]]", &[]),
    ("[[torsion_spring]]", "[[input]]\nname = \"wind\"\ntype = \"force\"\nbody = \"hand\"\naxis = [0, 1, 0]\ntable = [[0, 0], [200, -4], [300, 0]]\nperiodic = true\n\n[[torsion_spring]]",
        &[(WARNING, "input `wind` (line 42): its table repeats every 300 s, but the run ends at 1 \
                     s; check that its time is in s and that the `duration` is long enough")]),
    ("[[torsion_spring]]", "[[input]]\nname = \"wind\"\ntype = \"force\"\nbody = \"hand\"\naxis = [0, 1, 0]\nsine = { amplitude = 4, frequency = 0.5 }\n\n[[torsion_spring]]", &[]),
    ("[[torsion_spring]]", "[[input]]\nname = \"wind\"\ntype = \"force\"\nbody = \"hand\"\naxis = [0, 1, 0]\nsine = { amplitude = 4, frequency = 1e-3 }\n\n[[torsion_spring]]",
        &[(WARNING, "input `wind` (line 42): its sine repeats every 1000 s, but the run ends at 1 \
                     s; check that its time is in s and that the `duration` is long enough")]),
    ("[[torsion_spring]]", "[[readout]]\nname = \"pull\"\ntype = \"joint_force\"\ntarget = \"wrist\"\n\n[[torsion_spring]]",
        &[(NOTE, "read-out `pull` (line 42): joint `wrist` is undamped, so its force oscillates \
                  about the load; give the joint a `damping_ratio` with a `frequency`")]),
    ("[[tsda]]\n", "[[input]]\nname = \"motor\"\ntype = \"joint_torque\"\ntarget = \"shoulder\"\n\n[[tsda]]\n", &[]),
    ("type = \"fixed\"\nbetween = [\"arm\", \"hand\"]\nat = [1, 0, 0]\naxis = [1, 0, 0]\nstiffness = 1e4\nspan = 0.1\narm = 0.03\n\n[[tsda]]", "type = \"spherical\"\nbetween = [\"arm\", \"hand\"]\nat = [1, 0, 0]\nstiffness = 1e4\narm = 0.03\n\n[[input]]\nname = \"motor\"\ntype = \"joint_torque\"\ntarget = \"shoulder\"\n\n[[tsda]]",
        &[(NOTE, "input `motor` (line 34): joints leave 4 degrees of freedom, of which 1 is driven \
                  and 2 are sprung; check for a missing joint")]),
];

#[test]
fn each_warning_names_what_it_is_about_and_where() {
    let mut failures = String::new();
    for (from, to, expected) in CASES {
        assert_eq!(BASE.matches(from).count(), 1, "{from:?} occurs once in the base scene");
        let found = warnings(&BASE.replacen(from, to, 1));
        let expected: Vec<_> = expected.iter().map(|(s, text)| (*s, (*text).to_owned())).collect();
        if found != expected {
            failures += &format!("{to:?}\n  expected {expected:#?}\n  found {found:#?}\n");
        }
    }
    assert!(failures.is_empty(), "{failures}");
}

/// Free in space a scene is fine; under gravity it falls. A spider is warned of at its joint.
#[test]
fn islands_and_spiders_have_their_place() {
    let text = BASE
        .replace("[\"world\", \"arm\"]\nat", "[\"hand\", \"arm\"]\nat")
        .replace(
            "[[tsda]]\nbetween = [\"world\", \"hand\"]",
            "[[tsda]]\nbetween = [\"arm\", \"hand\"]",
        )
        .replace("points = [[1, 0, 0.5]", "points = [[0.5, 0, 0.3]")
        .replace(
            "[[torsion_spring]]\nbetween = [\"world\", \"arm\"]",
            "[[torsion_spring]]\nbetween = [\"hand\", \"arm\"]",
        );
    let says = "body `arm` (line 5): is connected to 1 more body but not to the world";
    assert_eq!(warnings(&text), [(WARNING, format!("{says} and falls"))]);
    let free = text.replace("gravity = [0, 0, -9.81]", "gravity = [0, 0, 0]");
    assert_eq!(warnings(&free), [(NOTE, says.into())]);
    // A rotor's thrust carries them, a force by a table of the scene does not.
    let thrust =
        "\n[[input]]\nname = \"thrust\"\ntype = \"force\"\nbody = \"hand\"\naxis = [0, 0, 1]\n";
    assert_eq!(warnings(&(text.clone() + thrust)), [(NOTE, says.into())]);
    let table = format!("{thrust}table = [[0, 0], [1, 5]]\n");
    assert_eq!(warnings(&(text.clone() + &table)), [(WARNING, format!("{says} and falls"))]);

    let text = BASE.replace("type = \"fixed\"", "type = \"universal\"").replace(
        "axis = [1, 0, 0]\nstiffness = 1e4\nspan = 0.1\narm = 0.03",
        "axes = [[0, 1, 0], [0, 0, 1]]\nstiffness = 1e4\nspan = 0.1\n\
         spider = { mass = 1e-2, inertia = [1e-9, 1e-9, 1e-9] }",
    );
    let found = warnings(&text);
    assert_eq!(found.len(), 1, "{found:?}");
    assert!(found[0].1.starts_with("body `wrist.spider` (line 26): its inertia"), "{found:?}");
}
