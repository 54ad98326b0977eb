//! Couplings: gears, a rack, a differential, a tendon, a screw, against closed forms.

use dbd_plant::instance::Instance;

use crate::{instance, value};

/// A wheel on a pivot along z, at a place along x, of so much inertia \[kg·m²\].
fn wheel(name: &str, x: f64, inertia: f64, carrier: &str) -> String {
    format!(
        r#"
        [[body]]
        name = "{name}"
        mass = 1
        inertia = [{inertia}, {inertia}, {inertia}]
        position = [{x}, 0, 0]
        [[joint]]
        name = "of_{name}"
        type = "revolute"
        between = ["{carrier}", "{name}"]
        at = [{x}, 0, 0]
        axis = [0, 0, 1]
        span = 0.1
        stiffness = 1e6
        [[readout]]
        name = "{name}"
        type = "joint_angle"
        target = "of_{name}"
        [[readout]]
        name = "rate_{name}"
        type = "joint_rate"
        target = "of_{name}"
        "#
    )
}

/// A body that slides along z.
fn slider(name: &str, x: f64, mass: f64) -> String {
    format!(
        r#"
        [[body]]
        name = "{name}"
        mass = {mass}
        inertia = [0.01, 0.01, 0.01]
        position = [{x}, 0, 0]
        [[joint]]
        name = "of_{name}"
        type = "translational"
        between = ["world", "{name}"]
        at = [{x}, 0, 0]
        axis = [0, 0, 1]
        span = 0.1
        gauge = 0.1
        offset = 0.025
        stiffness = 1e6
        "#
    )
}

fn torque(name: &str, joint: &str, value: f64) -> String {
    format!(
        r#"
        [[input]]
        name = "{name}"
        type = "joint_torque"
        target = "{joint}"
        table = [[0, {value}], [100, {value}]]
        "#
    )
}

fn coupling(of: &str, more: &str) -> String {
    format!(
        r#"
        [[coupling]]
        name = "mesh"
        of = [{of}]
        {more}
        [[readout]]
        name = "load"
        type = "interaction"
        target = "mesh"
        quantity = "load"
        [[readout]]
        name = "stretch"
        type = "interaction"
        target = "mesh"
        quantity = "stretch"
        "#
    )
}

fn scene(parts: &[String]) -> String {
    format!("name = \"coupled\"\nduration = 1\n{}", parts.concat())
}

/// A gear of 3 : 1, 1 kg·m² at its output and 0.01 kg·m² at its input.
fn gear(more: &str, parts: &[String]) -> String {
    let own = [wheel("output", 0.0, 1.0, "world"), wheel("input", 0.5, 0.01, "world")];
    let of = r#"{ joint = "of_output" }, { joint = "of_input", factor = "-1/3" }"#;
    scene(&[&own[..], &[coupling(of, &format!("stiffness = 25e3\n{more}"))], parts].concat())
}

/// A rack of 2 kg that falls and turns a pinion of 0.0125 kg·m² and 50 mm.
pub(crate) fn rack() -> String {
    let parts = [
        "gravity = [0, 0, -9.81]\n".to_owned(),
        wheel("pinion", 0.0, 0.0125, "world"),
        slider("rack", 0.5, 2.0),
        coupling(
            r#"{ joint = "of_rack" }, { joint = "of_pinion", factor = "50 mm/rad" }"#,
            "stiffness = 1e6\ndamping = 500",
        ),
    ];
    scene(&parts)
}

/// A pair of gears that 10 N·m drive at its input.
pub(crate) fn driven(more: &str) -> String {
    gear(more, &[torque("motor", "of_input", 10.0)])
}

/// Mean time between crossings of a level upwards \[s\].
pub(crate) fn period(instance: &mut Instance, column: &str, level: f64, periods: usize) -> f64 {
    let (mut last, mut times) = (value(instance, column), Vec::new());
    while times.len() <= periods {
        instance.advance(1).unwrap();
        let now = value(instance, column);
        if last < level && now >= level {
            let h = instance.step_size();
            times.push(instance.time() - h * (now - level) / (now - last));
        }
        last = now;
    }
    (times[periods] - times[0]) / periods as f64
}

/// 10 N·m at the input: the output's acceleration 30/1.09, the mesh vibrates at √(k·(1/J₂ + 1/(9·J₁))) about the load that
/// it carries.
#[test]
fn a_pair_of_gears_vibrates_and_accelerates() {
    let text = driven("");
    let load = 27.522_936;
    for (step, precision, near) in
        [(20e-6, "f64", 2e-5), (20e-6, "fixed", 2e-5), (20e-6, "f32", 2e-3)]
    {
        let mut pair = instance(&text, step, precision);
        let found = 1.0 / period(&mut pair, "load", -load, 20);
        assert!((found / 87.575_400 - 1.0).abs() < near, "{precision}: {found} Hz");
    }
    let text = driven("damping = 40");
    for precision in ["f64", "f32", "fixed"] {
        let mut pair = instance(&text, 100e-6, precision);
        pair.advance_to(1.0).unwrap();
        let [output, input] = ["rate_output", "rate_input"].map(|name| value(&pair, name));
        assert!((output - 27.522_936).abs() < 2e-3, "{precision}: {output}");
        assert!((input - 3.0 * output).abs() < 2e-3, "{precision}: {input}");
        let carried = value(&pair, "load");
        assert!((carried + load).abs() < 0.05, "{precision}: {carried}");
    }
}

/// After 955 turns of the input in single precision the teeth are where they were.
#[test]
fn many_turns_leave_teeth_where_they_are() {
    let spin = "[start.input]\nangular_velocity = [0, 0, 300]\n[start.output]\nangular_velocity = [0, 0, 100]\n";
    let text = gear("damping = 40", &[spin.to_owned()]);
    for precision in ["f32", "f64"] {
        let mut pair = instance(&text, 200e-6, precision);
        pair.advance_to(20.0).unwrap();
        let (rate, load) = (value(&pair, "rate_output"), value(&pair, "load"));
        assert!((rate - 100.0).abs() < 0.02, "{precision}: {rate}");
        assert!(load.abs() < 1.0, "{precision}: {load} N·m after 955 turns of the input");
    }
}

/// g·m/(m + J/r²).
#[test]
fn a_rack_turns_its_pinion() {
    for precision in ["f64", "f32", "fixed"] {
        let mut rack = instance(&rack(), 50e-6, precision);
        rack.advance_to(0.5).unwrap();
        let fallen = value(&rack, "rack.z");
        let known = -0.5 * 9.81 * 2.0 / (2.0 + 0.0125 / 0.0025) * 0.25;
        assert!((fallen - known).abs() < 2e-4, "{precision}: {fallen} of {known}");
        assert!((value(&rack, "pinion") + fallen / 0.05).abs() < 5e-3, "{precision}");
    }
}

/// Of a differential with one wheel held the other turns at twice the cage's rate.
#[test]
fn a_differential_adds() {
    let held = "[[interaction]]\nlaw = \"hinge-stop\"\nbetween = [\"world\", \"left\"]\naxis = [0, 0, 1]\nfrom = 0\nto = 1e-6\nstiffness = 1e6\n";
    let parts = [
        wheel("cage", 0.0, 0.1, "world"),
        wheel("left", 0.5, 0.01, "world"),
        wheel("right", 1.0, 0.01, "world"),
        coupling(
            r#"{ joint = "of_cage" }, { joint = "of_left", factor = -0.5 }, { joint = "of_right", factor = -0.5 }"#,
            "stiffness = 1e4\ndamping = 10",
        ),
        torque("motor", "of_cage", 1.0),
        held.to_owned(),
    ];
    let mut gears = instance(&scene(&parts), 50e-6, "f64");
    gears.advance_to(1.0).unwrap();
    let [cage, left, right] = ["rate_cage", "rate_left", "rate_right"].map(|n| value(&gears, n));
    assert!(left.abs() < 1e-2 && (right - 2.0 * cage).abs() < 1e-2, "{cage} {left} {right}");
    // T = (J_cage + 4·J_right)·α.
    assert!((cage - 1.0 / 0.14).abs() < 2e-2, "{cage}");
}

/// A nut that cannot turn on a spindle that cannot slide: 10 mm of lead per turn.
#[test]
fn a_screw_moves_its_nut() {
    let parts = [
        wheel("spindle", 0.0, 1e-3, "world"),
        slider("nut", 0.5, 5.0),
        coupling(
            r#"{ joint = "of_spindle" }, { joint = "of_nut", factor = "-1 turn/(10 mm)" }"#,
            "stiffness = 1e4\ndamping = 1",
        ),
        torque("motor", "of_spindle", 0.1),
    ];
    let mut screw = instance(&scene(&parts), 50e-6, "f64");
    screw.advance_to(0.2).unwrap();
    let ratio = 0.01 / std::f64::consts::TAU;
    let turned = 0.5 * 0.1 / (1e-3 + 5.0 * ratio * ratio) * 0.04;
    let [spindle, nut] = ["spindle", "nut.z"].map(|name| value(&screw, name));
    assert!((spindle / turned - 1.0).abs() < 2e-3, "{spindle} of {turned}");
    assert!((nut / (ratio * turned) - 1.0).abs() < 2e-3, "{nut}");
}

/// A tendon over two joints lets go: below its length it does nothing, above it pulls both.
#[test]
fn a_tendon_never_pushes() {
    let of = r#"{ joint = "of_a" }, { joint = "of_b", factor = 2 }"#;
    for (acts, sign) in [("tension", 1.0), ("compression", -1.0)] {
        let parts = [
            wheel("a", 0.0, 0.1, "world"),
            wheel("b", 0.5, 0.1, "world"),
            coupling(of, &format!("stiffness = 1000\ndamping = 100\nacts = \"{acts}\"")),
            format!("[start.a]\nangular_velocity = [0, 0, {}]\n", -sign),
        ];
        let mut free = instance(&scene(&parts), 100e-6, "f64");
        free.advance_to(0.1).unwrap();
        assert!((value(&free, "rate_a") + sign).abs() < 1e-9 && value(&free, "load") == 0.0);
        let parts = [&parts[..3], &[format!("[start.a]\nangular_velocity = [0, 0, {sign}]\n")]];
        let mut taut = instance(&scene(&parts.concat()), 100e-6, "f64");
        let mut least = f64::INFINITY;
        for _ in 0..2000 {
            taut.advance(1).unwrap();
            least = least.min(sign * value(&taut, "load"));
        }
        // Over-damped, it lets go while it still goes apart: b goes with 2·(impulse)/J, a loses impulse/J.
        let [a, b] = ["rate_a", "rate_b"].map(|name| sign * value(&taut, name));
        assert!(least >= 0.0, "{least}");
        assert!((2.0 * (1.0 - a) + b).abs() < 1e-9, "{a} {b}");
        assert!(a + 2.0 * b <= 1e-9, "{a} {b}");
    }
}

/// Play: the wheel that is driven goes through it before the other moves.
#[test]
fn play_is_gone_through_first() {
    let text = gear("damping = 40\nplay = \"1 mrad\"", &[torque("motor", "of_input", 0.01)]);
    let mut pair = instance(&text, 100e-6, "f64");
    // 3·½ mrad at 1 rad/s².
    let meets = (2.0_f64 * 1.5e-3).sqrt();
    pair.advance_to(((meets - 2e-3) * 1e4).round() * 1e-4).unwrap();
    assert_eq!(value(&pair, "rate_output"), 0.0);
    pair.advance_to(((meets + 2e-3) * 1e4).round() * 1e-4).unwrap();
    assert!(value(&pair, "rate_output") > 0.0);
    pair.advance_to(2.0).unwrap();
    let [output, input] = ["rate_output", "rate_input"].map(|name| value(&pair, name));
    assert!((input - 3.0 * output).abs() < 1e-6 && output > 0.0, "{output} {input}");
}

/// Without a damper energy is kept, in a train whose axes a body carries that turns itself: its bearings take the rest.
#[test]
fn a_train_on_a_turning_carrier_keeps_energy_and_momentum() {
    let parts = [
        wheel("carrier", 0.0, 0.5, "world"),
        wheel("sun", 0.0, 0.02, "carrier"),
        wheel("planet", 0.1, 0.01, "carrier"),
        coupling(r#"{ joint = "of_planet" }, { joint = "of_sun", factor = 2 }"#, "stiffness = 2e3"),
        "[start.sun]\nangular_velocity = [0, 0, 5]\n".to_owned(),
    ];
    let mut train = instance(&scene(&parts), 50e-6, "f64");
    let energy = |train: &Instance| train.plant().energy().total();
    let momentum = |train: &Instance| {
        let state = train.plant().state();
        let spin: f64 = (0..3)
            .map(|row| [0.5, 0.02, 0.01][row] * state.bodies[row].angular_velocity.to_f64()[2])
            .sum();
        let planet = &state.bodies[2];
        let (p, v) = (planet.position.to_f64(), planet.velocity.to_f64());
        spin + p[0] * v[1] - p[1] * v[0]
    };
    let (before, turning) = (energy(&train), momentum(&train));
    let mut most: f64 = 0.0;
    for _ in 0..40 {
        train.advance(1000).unwrap();
        most = most.max((energy(&train) / before - 1.0).abs());
        let moved = momentum(&train) / turning - 1.0;
        assert!(moved.abs() < 1e-4, "{moved}");
    }
    assert!(most < 2e-3, "{most}");
    assert!(value(&train, "rate_carrier").abs() > 1e-3);
}

/// All schemes, also those with a matrix, come to the same tension of a mesh that vibrates and is damped; the order of
/// leapfrog is 2.
#[test]
fn every_scheme_turns_gears() {
    let text = driven("damping = 4");
    let load = |scheme: &str, step: f64| {
        use dbd_plant::instance::{Blueprint, Settings};
        let settings =
            Settings { step: Some(step), scheme: Some(scheme.to_owned()), ..Settings::default() };
        let mut pair = Instance::new(Blueprint::new("gear.toml", text.as_str()), settings).unwrap();
        pair.advance_to(0.02).unwrap();
        assert_eq!(pair.plant().status(), Ok(()));
        value(&pair, "load")
    };
    let known = load("leapfrog", 2e-6);
    for (scheme, step) in [
        ("semi-implicit-euler", 10e-6),
        ("dbd", 10e-6),
        ("rk4", 20e-6),
        ("pefrl", 20e-6),
        ("blanes-moan-s6", 20e-6),
        ("generalized-alpha", 100e-6),
        ("generalized-alpha-3", 200e-6),
    ] {
        let found = load(scheme, step);
        assert!((found / known - 1.0).abs() < 0.01, "{scheme}: {found} of {known}");
    }
    let errors = [80e-6, 40e-6, 20e-6].map(|step| (load("leapfrog", step) - known).abs());
    let order = (errors[0] / errors[2]).log2() / 2.0;
    assert!(order > 1.8, "{order}: {errors:?}");
}

/// The mesh is a mode of two bodies that no joint joins.
#[test]
fn a_mesh_is_a_mode_of_both_gears() {
    let scene = dbd_scene::Scene::parse(&gear("", &[]), "gear.toml").unwrap();
    let found = dbd_study::modes::table(&scene, 12).unwrap();
    let near = found.rows.iter().map(|mode| (mode.frequency / 87.575_400 - 1.0).abs());
    let nearest = near.fold(f64::INFINITY, f64::min);
    assert!(nearest < 1e-4, "{nearest}: {:?}", found.rows);
}

/// A plane has the same motion.
#[test]
fn gears_in_a_plane() {
    let text = driven("damping = 40");
    let planar = text.replace("duration = 1", "duration = 1\nplanar = true");
    let [space, plane] = [text, planar].map(|text| {
        let mut pair = instance(&text, 50e-6, "f64");
        pair.advance_to(0.5).unwrap();
        value(&pair, "output")
    });
    assert!((space / plane - 1.0).abs() < 1e-9, "{space} {plane}");
}
