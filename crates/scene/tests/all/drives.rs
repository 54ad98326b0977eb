//! Inputs of the type `drive`: the laws that they stand for, their units, what is refused.

use dbd_kernel::{Leapfrog, Plant};
use dbd_scene::Scene;

/// A slider on a guide, a lever on it and a sleeve on the lever, with drives.
fn scene(inputs: &str) -> Result<Scene, String> {
    let text = format!(
        r#"
name = "drives"
duration = 1
[[body]]
name = "slider"
mass = 2
inertia = [0.01, 0.01, 0.01]
position = [0, 0, 0]
[[body]]
name = "lever"
mass = 1
inertia = [0.01, 0.01, 0.01]
position = [0, 0.3, 0]
[[body]]
name = "sleeve"
mass = 1
inertia = [0.01, 0.01, 0.01]
position = [0, 0.5, 0]
[[joint]]
name = "guide"
type = "translational"
between = ["world", "slider"]
at = [0, 0, 0]
axis = [1, 0, 0]
span = 0.1
gauge = 0.05
offset = 0.02
stiffness = 1e6
[[joint]]
name = "pivot"
type = "revolute"
between = ["slider", "lever"]
at = [0, 0, 0]
axis = [0, 0, 1]
span = 0.05
stiffness = 1e6
[[joint]]
name = "bush"
type = "cylindrical"
between = ["lever", "sleeve"]
at = [0, 0.5, 0]
axis = [0, 1, 0]
span = 0.05
offset = 0.02
stiffness = 1e6
[[tsda]]
name = "spring"
between = ["slider", "lever"]
points = [[0.1, 0, 0], [0, 0, 0]]
stiffness = 100
free_length = "initial"
{inputs}
"#
    );
    Scene::parse(&text, "drives.toml").map_err(|error| format!("{:?}", miette::Report::new(error)))
}

fn drive(keys: &str) -> String {
    format!("[[input]]\nname = \"motor\"\ntype = \"drive\"\n{keys}\n")
}

#[test]
fn a_drive_is_an_input_and_the_interaction_of_its_name() {
    let keyed = scene(&drive(
        "target = \"pivot\"\nmode = \"voltage\"\nwinding = { resistance = 2, inductance = \"4 mH\", \
         constant = \"50 mNm/A\", most_current = 3 }\nrotor = \"20 kg*mm^2\"\nratio = 10\n\
         gear = { stiffness = 500, damping = 1, play = \"1 deg\" }\nvalue = \"12 V\"",
    ))
    .unwrap();
    let input = &keyed.inputs[0];
    assert_eq!((input.name.as_str(), input.kind, input.unit), ("motor", "drive", "V"));
    let law = &dbd_scene::interactions(&keyed)[0];
    assert_eq!((law.law, law.name()), ("hinge-drive", Some("motor")));
    assert_eq!(law.label, "drive `motor` (slider–lever)");
    // The same as a law by itself: all at the output of the gear.
    let listed = scene(
        "[[input]]\nname = \"u\"\ntype = \"signal\"\nvalue = 12\n[[interaction]]\nlaw = \"hinge-drive\"\n\
         between = [\"slider\", \"lever\"]\naxis = [0, 0, 1]\ninput = \"u\"\nservo_damping = 0.125\nfeed = 2\nmost = 1.5\n\
         lag = 0.002\ninertia = 0.002\nstiffness = 500\ndamping = 1\nplay = \"1 deg\"",
    )
    .unwrap();
    let of = |scene: &Scene| Plant::new(&scene.model, Leapfrog, 1e-4).unwrap().fingerprint();
    assert_eq!(of(&keyed), of(&listed));
}

#[test]
fn the_mode_says_the_unit() {
    let servo = "kp = 10\nkd = 1";
    let wound = "winding = { constant = 0.1 }\nrotor = 1e-3\ngear = { stiffness = 100 }";
    for (target, mode, keys, unit, law) in [
        ("target = \"pivot\"", "position", servo, "rad", "hinge-servo"),
        ("target = \"guide\"", "position", servo, "m", "slide-servo"),
        ("target = \"guide\"", "velocity", "kd = 1", "m/s", "slide-servo"),
        ("target = \"pivot\"", "velocity", "kd = 1", "rad/s", "hinge-servo"),
        (
            "target = \"pivot\"",
            "torque",
            "rotor = 1\ngear = { stiffness = 1 }",
            "N·m",
            "hinge-drive",
        ),
        ("target = \"guide\"", "force", "rotor = 1\ngear = { stiffness = 1 }", "N", "slide-drive"),
        ("target = \"pivot\"", "current", wound, "A", "hinge-drive"),
        (
            "target = \"bush\"\nfreedom = \"slide\"\nratio = \"1 rev/(5 mm)\"",
            "current",
            wound,
            "A",
            "slide-drive",
        ),
        ("target = \"bush\"\nfreedom = \"turn\"", "velocity", "kd = 1", "rad/s", "hinge-servo"),
    ] {
        let text = drive(&format!("{target}\nmode = \"{mode}\"\n{keys}"));
        let scene = scene(&text).unwrap_or_else(|error| panic!("{error}"));
        assert_eq!(scene.inputs[0].unit, unit, "{target} {mode}");
        assert_eq!(dbd_scene::interactions(&scene)[0].law, law, "{target} {mode}");
    }
}

#[test]
fn what_is_no_drive_is_refused_with_a_remedy() {
    let rotor = "rotor = 1e-3\ngear = { stiffness = 100 }";
    let pivot = "target = \"pivot\"";
    for (keys, parts) in [
        (format!("{pivot}\nmode = \"speed\""), ["mode", "velocity"]),
        (
            "target = \"spring\"\nmode = \"velocity\"\nkd = 1".to_owned(),
            ["tsda", "the name of a joint"],
        ),
        ("target = \"pivto\"\nmode = \"velocity\"\nkd = 1".to_owned(), ["pivto", "pivot"]),
        (
            format!("{pivot}\nfreedom = \"turn\"\nmode = \"velocity\"\nkd = 1"),
            ["freedom", "cylindrical"],
        ),
        ("target = \"bush\"\nmode = \"velocity\"\nkd = 1".to_owned(), ["freedom", "slide"]),
        (format!("{pivot}\nmode = \"position\"\nkp = 1"), ["kd", "add"]),
        (format!("{pivot}\nmode = \"position\"\nkp = -1\nkd = 1"), ["kp", "≥ 0"]),
        (format!("{pivot}\nmode = \"position\"\nkp = 1\nkd = 0"), ["kd", "> 0"]),
        (format!("{pivot}\nmode = \"velocity\"\nkp = 1\nkd = 1"), ["kp", "position"]),
        (format!("{pivot}\nmode = \"torque\""), ["rotor", "joint_torque"]),
        (format!("{pivot}\nmode = \"torque\"\nrotor = 1e-3"), ["gear", "couple"]),
        (format!("{pivot}\nmode = \"torque\"\n{rotor}\nratio = 0"), ["ratio", "is 0"]),
        (format!("{pivot}\nmode = \"velocity\"\nkd = 1\nratio = 3"), ["ratio", "rotor"]),
        (
            format!("{pivot}\nmode = \"velocity\"\nkd = 1\ngear = {{ stiffness = 1, play = 0.1 }}"),
            ["gear", "rotor"],
        ),
        (format!("{pivot}\nmode = \"velocity\"\nkd = 1\nlag = \"1 ms\""), ["lag", "rotor"]),
        (
            format!(
                "{pivot}\nmode = \"torque\"\nrotor = 1e-3\ngear = {{ stiffness = 1, play = -0.1 }}"
            ),
            ["play", "≥ 0"],
        ),
        (
            format!("{pivot}\nmode = \"torque\"\nrotor = 1e-3\ngear = {{ stifness = 1 }}"),
            ["stifness", "stiffness"],
        ),
        (format!("{pivot}\nmode = \"voltage\"\n{rotor}"), ["winding", "resistance"]),
        (
            format!(
                "{pivot}\nmode = \"voltage\"\nwinding = {{ resistance = 1, constant = 0 }}\n{rotor}"
            ),
            ["constant", "is 0"],
        ),
        (
            format!(
                "{pivot}\nmode = \"current\"\nwinding = {{ resistance = 1, constant = 1 }}\n{rotor}"
            ),
            ["resistance", "voltage"],
        ),
        (
            format!(
                "{pivot}\nmode = \"voltage\"\nlag = 1\nwinding = {{ resistance = 1, constant = 1 }}\n{rotor}"
            ),
            ["lag", "inductance"],
        ),
        (
            format!(
                "target = \"guide\"\nmode = \"current\"\nwinding = {{ constant = 1 }}\n{rotor}"
            ),
            ["ratio", "rad/m"],
        ),
        (format!("{pivot}\nmode = \"torque\"\n{rotor}\nvalue = \"3 V\""), ["value", "N·m"]),
    ] {
        let Err(error) = scene(&drive(&keys)) else { panic!("it is read: {keys}") };
        for part in parts {
            assert!(error.contains(part), "{keys}: `{part}` is not in\n{error}");
        }
    }
    let unknown = "[[interaction]]\nlaw = \"hinge-servo\"\nbetween = [\"slider\", \"lever\"]\naxis = [0, 0, 1]\n\
                   input = \"u\"\nservo_damping = 1";
    let error = scene(unknown).unwrap_err();
    assert!(error.contains("names no input"), "{error}");
}

/// What drives it, may be a table, a sine or a table over a read-out, as of any input.
#[test]
fn a_drive_follows_a_table() {
    let text = drive(
        "target = \"pivot\"\nmode = \"position\"\nkp = 400\nkd = 40\n\
         table = [[0, 0], [0.5, \"30 deg\"]]\ninterpolate = \"linear\"",
    );
    let model = scene(&text).unwrap().model;
    let mut plant = Plant::new(&model, Leapfrog, 1e-4).unwrap();
    plant.advance(10_000).unwrap();
    let lever = plant.state().bodies[1].orientation;
    let slider = plant.state().bodies[0].orientation;
    let turn = 2.0 * (lever.v.z.atan2(lever.w) - slider.v.z.atan2(slider.w));
    assert!((turn - 30_f64.to_radians()).abs() < 2e-3, "{turn}");
}

/// What a caller sets beyond the range of an input is the nearer bound; a scene's own value, table or sine is refused.
#[test]
fn a_range_bounds_what_a_caller_sets() {
    let text =
        |more: &str| drive(&format!("target = \"pivot\"\nmode = \"velocity\"\nkd = 1\n{more}"));
    let scene_of = |more: &str| scene(&text(more));
    let bounded = scene_of("range = [\"-2 rad/s\", \"30 rpm\"]").unwrap();
    let most = std::f64::consts::PI;
    assert_eq!(bounded.inputs[0].range, [-2.0, most]);
    let input = bounded.inputs[0].index;
    let single: dbd_scene::SceneModel<dbd_kernel::F32> = bounded.model.convert();
    let mut double = Plant::new(&bounded.model, Leapfrog, 1e-4).unwrap();
    let mut single = Plant::new(&single, Leapfrog, 1e-4).unwrap();
    for (asked, set) in [(1.0, 1.0), (99.0, most), (-99.0, -2.0)] {
        double.set_input(input, asked).unwrap();
        single.set_input(input, asked).unwrap();
        assert_eq!(double.state().signals[0].value, set);
        assert_eq!(single.state().signals[0].value, set as f32);
    }
    assert!(double.set_input(input, f64::NAN).is_err());
    let free = scene_of("").unwrap();
    assert_eq!(free.inputs[0].range, [f64::NEG_INFINITY, f64::INFINITY]);
    // Other ranges make another model; none makes the one that there was before ranges.
    let of = |scene: &Scene| Plant::new(&scene.model, Leapfrog, 1e-4).unwrap().fingerprint();
    assert_ne!(of(&bounded), of(&free));
    for (more, part) in [
        ("range = [1, -1]\nvalue = 0", "wrong order"),
        ("range = [1, 2]", "does not contain the value 0"),
        ("range = [1, 2]\nvalue = 3", "outside `range`"),
        ("range = [1]", "range"),
        ("range = [-1, 1]\ntable = [[0, 0], [1, 0.5]]", "contradicts `table`"),
        ("range = [-1, 1]\nsine = { amplitude = 0.5, frequency = 1 }", "contradicts `sine`"),
        ("range = [\"-1 m\", 1]", "rad/s"),
    ] {
        let Err(error) = scene_of(more) else { panic!("it is read: {more}") };
        assert!(error.contains(part), "{more}: `{part}` is not in\n{error}");
    }
}

/// Friction is given at the shaft: the ratio brings it to the joint.
#[test]
fn friction_of_a_shaft_is_that_of_its_law_at_the_joint() {
    let keyed = scene(&drive(
        "target = \"pivot\"\nmode = \"torque\"\nrotor = \"20 kg*mm^2\"\nratio = -10\n\
         gear = { stiffness = 500 }\nfriction = { coulomb = \"3 mN*m\", viscous = 1e-5 }\nvalue = 12",
    ))
    .unwrap();
    let listed = scene(
        "[[input]]\nname = \"u\"\ntype = \"signal\"\nvalue = 12\n[[interaction]]\n\
         law = \"hinge-drive-friction\"\nbetween = [\"slider\", \"lever\"]\naxis = [0, 0, 1]\ninput = \"u\"\n\
         gain = 1\ninertia = 0.002\nstiffness = 500\ncoulomb = 0.03\nviscous = 0.001",
    )
    .unwrap();
    let of = |scene: &Scene| {
        let mut plant = Plant::new(&scene.model, Leapfrog, 1e-4).unwrap();
        for _ in 0..100 {
            let _ = plant.step();
        }
        plant.state().hash()
    };
    assert_eq!(of(&keyed), of(&listed));
    let slide = "target = \"guide\"\nmode = \"force\"\nrotor = 0.1\ngear = { stiffness = 500 }";
    for (keys, law) in [
        ("friction = { coulomb = \"1 N\" }", "slide-drive-friction"),
        ("friction = { viscous = \"1 N*s/m\" }", "slide-drive-friction"),
        ("ratio = \"100 rad/m\"\nfriction = { coulomb = \"1 mN*m\" }", "slide-drive-friction"),
        ("friction = { viscous = 0 }", "slide-drive"),
    ] {
        let scene = scene(&drive(&format!("{slide}\n{keys}"))).unwrap();
        assert_eq!(dbd_scene::interactions(&scene)[0].law, law, "{keys}");
    }
    let servo = "target = \"pivot\"\nmode = \"velocity\"\nkd = 1";
    for (keys, parts) in [
        (format!("{servo}\nfriction = {{ coulomb = 1 }}"), ["requires a `rotor`", "joint"]),
        (format!("{slide}\nfriction = {{ coulomb = -1 }}"), ["`coulomb`", "≥ 0 in N"]),
        (format!("{slide}\nfriction = {{ coulomb = \"1 N*m\" }}"), ["`coulomb`", "N"]),
        (format!("{slide}\nfriction = {{ breakaway = 1 }}"), ["no key `breakaway`", "viscous"]),
        (format!("{slide}\nfriction = 1"), ["friction", "coulomb"]),
    ] {
        let said = scene(&drive(&keys)).err().unwrap_or_default();
        let flat = said.split_whitespace().collect::<Vec<_>>().join(" ").replace("│ ", "");
        assert!(parts.iter().all(|part| flat.contains(part)), "{keys}: {said}");
    }
}

const MACHINE: &str = "target = \"pivot\"\nmode = \"voltage\"\nratio = 10\nrotor = 1e-5\n\
                       gear = { stiffness = 500, damping = 1 }\nd_input = \"ud\"\nvalue = \"12 V\"\n\
                       winding = { resistance = 2, inductance_d = \"4 mH\", inductance_q = \"6 mH\", \
                       flux = \"20 mV*s\", pole_pairs = 5, most_current = 3 }";

const SIGNAL: &str = "[[input]]\nname = \"ud\"\ntype = \"signal\"\nvalue = -2\n";

/// A winding in rotor axes is one law, whose pole pairs are times the ratio.
#[test]
fn a_winding_in_rotor_axes_is_a_law() {
    let keyed = scene(&(drive(MACHINE) + SIGNAL)).unwrap();
    assert_eq!(
        (keyed.inputs[0].unit, dbd_scene::interactions(&keyed)[0].law),
        ("V", "hinge-drive-dq")
    );
    let of_law = "[[interaction]]\nlaw = \"hinge-drive-dq\"\nbetween = [\"slider\", \"lever\"]\naxis = [0, 0, 1]\n\
                  input = \"u\"\nd_input = \"ud\"\nresistance = 2\ninductance_d = 0.004\ninductance_q = 0.006\n\
                  flux = 0.02\npoles = 50\nmost_current = 3\ninertia = 0.001\nstiffness = 500\ndamping = 1";
    let other = "[[input]]\nname = \"u\"\ntype = \"signal\"\nvalue = 12\n";
    let listed = scene(&format!("{other}{SIGNAL}{of_law}")).unwrap();
    let of = |scene: &Scene| {
        let mut plant = Plant::new(&scene.model, Leapfrog, 1e-4).unwrap();
        plant.advance(100).unwrap();
        plant.state().hash()
    };
    assert_eq!(of(&keyed), of(&listed));
    // Without an input of d its voltage is 0.
    let alone = scene(&drive(&MACHINE.replace("d_input = \"ud\"\n", ""))).unwrap();
    let zero = scene(&(drive(MACHINE) + &SIGNAL.replace("-2", "0"))).unwrap();
    let rates = [&alone, &zero].map(|scene| {
        let mut plant = Plant::new(&scene.model, Leapfrog, 1e-4).unwrap();
        plant.advance(100).unwrap();
        plant.state().bodies[1].angular_velocity
    });
    assert_eq!(rates[0], rates[1]);
    assert!(rates[0].z > 0.0, "{rates:?}");
}

#[test]
fn what_is_no_winding_in_rotor_axes_is_refused() {
    let with = |from: &str, to: &str| {
        assert!(MACHINE.contains(from), "{from}");
        drive(&MACHINE.replace(from, to)) + SIGNAL
    };
    let slide = MACHINE.replace("pivot", "guide").replace("ratio = 10", "ratio = \"10 rad/m\"");
    let current = MACHINE.replace("voltage", "current").replace("12 V", "1 A");
    for (text, parts) in [
        (with("inductance_d = \"4 mH\"", "inductance_d = 0"), ["inductance_d", "> 0"]),
        (with("inductance_q = \"6 mH\"", "inductance_q = -1"), ["inductance_q", "> 0"]),
        (with("inductance_q = \"6 mH\", ", ""), ["inductance_q", "add"]),
        (with("resistance = 2", "resistance = 0"), ["resistance", "> 0"]),
        (with("flux = \"20 mV*s\"", "flux = -1"), ["flux", "≥ 0"]),
        (with("pole_pairs = 5", "pole_pairs = 0"), ["pole_pairs", "whole number"]),
        (with("pole_pairs = 5", "pole_pairs = 2.5"), ["pole_pairs", "whole number"]),
        (with("pole_pairs = 5", "poles = 5"), ["poles", "pole_pairs"]),
        (with("most_current = 3", "most_current = 0"), ["most_current", "> 0"]),
        (with("most_current = 3", "constant = 1"), ["constant", "no key"]),
        (with("d_input = \"ud\"", "d_input = \"du\""), ["names no input", "ud"]),
        (with("d_input = \"ud\"", "d_input = \"motor\""), ["d_input", "not of the type"]),
        (with("rotor = 1e-5\n", ""), ["gear", "rotor"]),
        (with("ratio = 10", "most = 1"), ["most", "most_current"]),
        (with("ratio = 10", "lag = 1"), ["lag", "inductance"]),
        (with("mode = \"voltage\"", "mode = \"velocity\"\nkd = 1"), ["winding", "voltage"]),
        (drive(&slide) + SIGNAL, ["winding", "rotation"]),
        (drive(&current) + SIGNAL, ["resistance", "voltage"]),
        (
            with("inductance_q = \"6 mH\", flux = \"20 mV*s\"", "inductance_q = 0.004, flux = 0"),
            ["flux", "equal inductances"],
        ),
        (
            with(
                "inductance_d = \"4 mH\", inductance_q = \"6 mH\", flux = \"20 mV*s\", pole_pairs = 5",
                "constant = 1",
            ),
            ["d_input", "inductance_d"],
        ),
    ] {
        let said = scene(&text).err().unwrap_or_default();
        assert!(parts.iter().all(|part| said.contains(part)), "{parts:?}\n{text}\n{said}");
    }
    let law = |more: &str| {
        format!(
            "{SIGNAL}[[interaction]]\nlaw = \"hinge-drive-dq\"\nbetween = [\"slider\", \"lever\"]\n\
             axis = [0, 0, 1]\ninput = \"ud\"\nd_input = \"ud\"\ninertia = 1\nstiffness = 1\n{more}"
        )
    };
    let wound = "inductance_d = 1\ninductance_q = 1\nflux = 1\npoles = 1";
    scene(&law(wound)).unwrap();
    for (from, to, part) in [
        ("inductance_d = 1", "inductance_d = 0", "inductance_d"),
        ("flux = 1", "flux = 0", "equal inductances"),
        ("poles = 1", "poles = 0", "poles"),
    ] {
        let said = scene(&law(&wound.replace(from, to))).err().unwrap_or_default();
        assert!(said.contains(part), "{to}: {said}");
    }
}
