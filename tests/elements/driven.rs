//! Driven bodies: a base that turns, moves by a sine or a table, or at constant velocity, against closed forms; what
//! hangs from it, its work, what is refused.

use dbd_kernel::power::power;
use dbd_plant::instance::{Blueprint, Instance, Settings};

use dbd_scene::{Scene, facts};
use dbd_study::reference::fine::states;
use dbd_study::reference::mechanism::Mechanism;
use dbd_study::reference::reference_solution::Integrator;
use dbd_study::reference::spectrum::eigenfrequencies;

use crate::values::Case;
use crate::{instance, value};

const G: f64 = 9.81;

/// A base that turns about y by `rate` \[rad/s\] with a pendulum of 1 kg at 1 m, started at `angle` \[rad\] in the
/// plane of the axis.
fn carousel(rate: f64, angle: f64) -> String {
    let (sin, cos) = angle.sin_cos();
    format!(
        r#"
        name = "carousel"
        duration = 10
        gravity = [0, -{G}, 0]
        [[body]]
        name = "base"
        mass = 3
        inertia = [1, 2, 2.5]
        position = [0, 0, 0]
        driven = true
        [[body]]
        name = "bob"
        mass = 1
        inertia = [0.1, 0.1, 0.1]
        position = [{sin:?}, {:?}, 0]
        velocity = [0, 0, {:?}]
        angular_velocity = [0, {rate:?}, 0]
        [[joint]]
        name = "pivot"
        type = "revolute"
        between = ["base", "bob"]
        at = [0, 0, 0]
        axis = [0, 0, 1]
        span = 1
        stiffness = 1e6
        [[readout]]
        name = "angle"
        type = "joint_angle"
        target = "pivot"
        offset = {angle:?}
        "#,
        -cos,
        -rate * sin,
    )
}

fn turning(rate: f64) -> String {
    format!(
        "[[input]]\nname = \"spin\"\ntype = \"angular_velocity\"\nbody = \"base\"\naxis = [0, 1, 0]\nvalue = {rate:?}\n"
    )
}

/// \[s\] m·(g/l − Ω²)·l² = I·ω², I = m·l² + Iz.
fn period_of(rate: f64) -> f64 {
    std::f64::consts::TAU / ((G - rate * rate) / 1.1).sqrt()
}

/// \[s\] the mean of three periods, between upward passages.
fn period(rate: f64, step: f64) -> f64 {
    let text = carousel(rate, 1e-3) + &turning(rate);
    let mut run = instance(&text, step, "f64");
    let angle = run.output("angle").unwrap();
    let (mut last, mut passages) = (run.value(angle), Vec::new());
    while passages.len() < 4 {
        run.advance(1).unwrap();
        let now = run.value(angle);
        if last < 0.0 && now >= 0.0 {
            passages.push(run.time() - step * now / (now - last));
        }
        last = now;
    }
    (passages[3] - passages[0]) / 3.0
}

/// 2 kg on a spring of 800 N/m at a driven base; `drive` are the base's inputs.
fn shaken(damping: f64, more: &str, drive: &str) -> String {
    format!(
        r#"
        name = "shaken"
        duration = 2
        {more}
        [[body]]
        name = "base"
        mass = 5
        inertia = [1, 1, 1]
        position = [0, 0, 0]
        driven = true
        [[body]]
        name = "mass"
        mass = 2
        inertia = [0.1, 0.1, 0.1]
        position = [1, 0, 0]
        [[tsda]]
        name = "spring"
        between = ["base", "mass"]
        points = [[0, 0, 0], [0, 0, 0]]
        stiffness = 800
        damping = {damping}
        free_length = 1
        [[readout]]
        name = "tension"
        type = "tsda_force"
        target = "spring"
        {drive}
        "#
    )
}

/// 0.3 m/s at 2 Hz, from its largest.
const SINE: &str = "[[input]]\nname = \"shake\"\ntype = \"velocity\"\nbody = \"base\"\naxis = [1, 0, 0]\n\
                    sine = { amplitude = 0.3, frequency = 2, phase = \"90 deg\" }\n";

/// x″ + ω²·x = ω²·(V/W)·sin(W·t) from rest, ω = 20 rad/s, plus the spring's length.
fn answer(time: f64) -> f64 {
    let (own, turn) = (20.0_f64, std::f64::consts::TAU * 2.0);
    let size = 0.3 / turn * own * own / (own * own - turn * turn);
    1.0 + size * ((turn * time).sin() - turn / own * (own * time).sin())
}

fn shaken_to(time: f64, step: f64, precision: &str, more: &str) -> [f64; 3] {
    let mut run = instance(&shaken(0.0, more, SINE), step, precision);
    run.advance_to(time).unwrap();
    ["mass.x", "base.x", "base.vx"].map(|name| value(&run, name))
}

pub(crate) fn cases() -> Vec<Case> {
    vec![
        Case {
            element: "driven",
            what: "period of a pendulum on a base that turns by 2 rad/s",
            unit: "s",
            exact: period_of(2.0),
            step: 2e-4,
            found: Box::new(|step| period(2.0, step)),
            near: 2e-4,
        },
        Case {
            element: "driven",
            what: "place on a spring 0.7 s after a sine of its base begins",
            unit: "m",
            exact: answer(0.7),
            step: 2e-3,
            found: Box::new(|step| shaken_to(0.7, step, "f64", "")[0]),
            near: 1e-5,
        },
    ]
}

#[test]
fn a_turning_base_slows_a_pendulum_by_the_centrifugal_term() {
    for rate in [0.0, 2.0, -2.9] {
        let (found, exact) = (period(rate, 1e-4), period_of(rate));
        assert!((found / exact - 1.0).abs() < 2e-4, "{rate}: {found} {exact}");
    }
}

#[test]
fn a_sine_of_the_base_gives_the_closed_form_at_second_order() {
    let turn = std::f64::consts::TAU * 2.0;
    let base = 0.3 / turn * (turn * 0.7).sin();
    let errors = [4e-3, 2e-3, 1e-3].map(|step| {
        let [mass, place, speed] = shaken_to(0.7, step, "f64", "");
        // Between steps the velocity is that of the present time.
        assert!((speed - 0.3 * (turn * 0.7).cos()).abs() < 1e-12, "{step}: {speed}");
        [(mass - answer(0.7)).abs(), (place - base).abs()]
    });
    for part in [0, 1] {
        for pair in errors.windows(2) {
            let order = (pair[0][part] / pair[1][part]).log2();
            assert!((order - 2.0).abs() < 0.1, "{part}: {errors:?}");
        }
    }
    for (precision, more) in
        [("f32", ""), ("fixed", ""), ("f64", "planar = true"), ("f32", "planar = true")]
    {
        let near = if precision == "f32" { 1e-4 } else { 2e-5 };
        let [mass, ..] = shaken_to(0.7, 1e-3, precision, more);
        assert!((mass - answer(0.7)).abs() < near, "{precision} {more}: {mass} {}", answer(0.7));
    }
    // A sine costs no evaluation.
    let mut run = instance(&shaken(0.0, "", SINE), 1e-3, "f64");
    run.advance(1000).unwrap();
    assert_eq!(run.plant().evaluations(), 1001);
}

/// A linear table of a velocity is exact, too; a caller sets from step to step.
#[test]
fn constant_and_linear_velocities_move_it_exactly() {
    let table = "[[input]]\nname = \"go\"\ntype = \"velocity\"\nbody = \"base\"\naxis = [0, 3, 4]\n\
                 table = [[0, 0], [1, 2], [2, 2]]\ninterpolate = \"linear\"\n";
    let called =
        "[[input]]\nname = \"along\"\ntype = \"velocity\"\nbody = \"base\"\naxis = [0, 1, 0]\n";
    let mut run = instance(&shaken(0.0, "", &format!("{table}{called}")), 1e-2, "f64");
    run.advance_to(1.0).unwrap();
    let along = run.input("along").unwrap();
    run.set_input(along, -0.5).unwrap();
    run.advance_to(2.0).unwrap();
    let [y, z] = ["base.y", "base.z"].map(|name| value(&run, name));
    assert!((y - (3.0 * 0.6 - 0.5)).abs() < 1e-13 && (z - 3.0 * 0.8).abs() < 1e-13, "{y} {z}");
}

/// Two inputs about different axes: a rotation by 5 rad/s about (3, 4, 0), whatever the inertia.
#[test]
fn it_turns_exactly_about_any_axis() {
    let input = |name: &str, axis: &str, value: f64| {
        format!(
            "[[input]]\nname = \"{name}\"\ntype = \"angular_velocity\"\nbody = \"base\"\naxis = {axis}\n\
             value = {value:?}\n"
        )
    };
    let tip = "[[readout]]\nname = \"tip\"\ntype = \"point\"\nbody = \"base\"\npoint = [0, 0, 1]\n";
    let inputs = input("x", "[1, 0, 0]", 3.0) + &input("y", "[0, 2, 0]", 4.0);
    let base = shaken(0.0, "", tip).replacen("[1, 1, 1]", "[1, 2, 2.5]", 1);
    let constant = base.replacen("driven = true", "driven = true\nangular_velocity = [3, 4, 0]", 1);
    for (text, precision, near) in [
        (base.clone() + &inputs, "f64", 1e-11),
        (base.clone() + &inputs, "fixed", 1e-5),
        (base + &inputs, "f32", 1e-4),
        (constant, "f64", 1e-11),
    ] {
        let mut run = instance(&text, 2e-3, precision);
        run.advance_to(2.0).unwrap();
        let (sin, cos) = (5.0_f64 * 2.0).sin_cos();
        let exact = [0.8 * sin, -0.6 * sin, cos];
        let found = ["tip.x", "tip.y", "tip.z"].map(|name| value(&run, name));
        let off = exact.iter().zip(found).map(|(a, b)| (a - b).abs()).fold(0.0, f64::max);
        assert!(off < near, "{precision}: {off:e}");
    }
}

/// What does not touch it has the bits that it has alone.
#[test]
fn other_bodies_keep_their_bits() {
    let free = "[[body]]\nname = \"a\"\nmass = 2\ninertia = [0.1, 0.2, 0.3]\nposition = [5, 0, 0]\n\
                angular_velocity = [1, 2, 3]\n[[body]]\nname = \"b\"\nmass = 1\ninertia = [0.1, 0.2, 0.2]\n\
                position = [6, 0, 0]\n[[tsda]]\nbetween = [\"a\", \"b\"]\npoints = [[0, 0.1, 0], [0, 0, 0]]\n\
                stiffness = 300\ndamping = 4\nfree_length = 0.8\n";
    let alone = format!("name = \"free\"\nduration = 1\ngravity = [0, -1, 0]\n{free}");
    let base = "[[body]]\nname = \"base\"\nmass = 1\ninertia = [1, 1, 1]\nposition = [0, 0, 0]\ndriven = true\n";
    let with = format!("{alone}{base}{SINE}");
    let names = ["a.x", "a.y", "a.wx", "b.x", "b.vy", "b.wz"];
    let [alone, with] = [&alone, &with].map(|text| {
        let mut run = instance(text, 1e-3, "f64");
        run.advance(1000).unwrap();
        names.map(|name| value(&run, name).to_bits())
    });
    assert_eq!(alone, with);
}

/// The energy without the base's own changes by the work of the base, less what dampers take; the tension gives the
/// momentum of the rest.
#[test]
fn the_energy_changes_by_the_work_of_the_drive() {
    for damping in [0.0, 6.0] {
        let h = 1e-4;
        let gravity = "gravity = [0.5, 0, 0]";
        let mut run = instance(&shaken(damping, gravity, SINE), h, "f64");
        let read = |run: &Instance| {
            let found = power(run.plant().model(), &run.plant().state(), h).unwrap();
            let [energy, tension, speed] =
                ["energy.total", "tension", "mass.vx"].map(|name| value(run, name));
            [found.inputs, found.dampers, energy, tension, speed]
        };
        let mut before = read(&run);
        let start = before;
        let [mut work, mut lost, mut impulse, mut most] = [0.0_f64; 4];
        for _ in 0..20_000 {
            run.advance(1).unwrap();
            let now = read(&run);
            work += 0.5 * h * (before[0] + now[0]);
            lost += 0.5 * h * (before[1] + now[1]);
            impulse += 0.5 * h * (2.0 * 0.5 * 2.0 - before[3] - now[3]);
            most = most.max(work.abs());
            before = now;
        }
        let gained = before[2] - start[2];
        assert!(most > 0.1 && (lost > 0.01) == (damping > 0.0), "{most} {lost}");
        assert!((gained - work + lost).abs() < 1e-3 * (most + lost), "{gained} {work} {lost}");
        let momentum = 2.0 * (before[4] - start[4]);
        assert!((momentum - impulse).abs() < 1e-3, "{damping}: {momentum} {impulse}");
    }
}

/// Joints, damped, between driven bodies, the ground and free bodies, in every kind of damping.
#[test]
fn joints_may_have_driven_bodies_at_both_ends() {
    let joint = |name: &str, a: &str, b: &str, x: f64| {
        format!(
            "[[joint]]\nname = \"{name}\"\ntype = \"revolute\"\nbetween = [\"{a}\", \"{b}\"]\nat = [{x:?}, 0, 0]\n\
             axis = [0, 1, 0]\nspan = 0.3\nstiffness = 1e5\ndamping = 20\n"
        )
    };
    let body = |name: &str, x: f64, driven: bool| {
        format!(
            "[[body]]\nname = \"{name}\"\nmass = 1\ninertia = [0.1, 0.1, 0.1]\nposition = [{x:?}, 0, 0]\n\
             driven = {driven}\n"
        )
    };
    let text = "name = \"driven\"\nduration = 1\ngravity = [0, -9.81, 0]\n".to_owned()
        + &body("a", 1.0, true)
        + &body("b", 2.0, true)
        + &body("c", 3.0, false)
        + &body("d", 4.0, false)
        + &joint("ground", "world", "a", 0.5)
        + &joint("both", "a", "b", 1.5)
        + &joint("one", "b", "c", 2.5)
        + &joint("none", "d", "c", 3.5)
        + &joint("other", "d", "a", 1.0)
        + "[[input]]\nname = \"spin\"\ntype = \"angular_velocity\"\nbody = \"b\"\naxis = [0, 1, 0]\nsine = \
           { amplitude = 0.05, frequency = 1 }\n";
    for (scheme, damping, precision) in [
        ("leapfrog", Some("sweeps"), "f64"),
        ("leapfrog", Some("sweeps"), "fixed"),
        ("leapfrog", Some("joint-wise"), "fixed"),
        ("leapfrog", Some("explicit"), "fixed"),
        ("dbd", None, "fixed"),
        ("leapfrog", Some("joint-wise"), "f64"),
        ("leapfrog", Some("explicit"), "f64"),
        ("semi-implicit-euler", None, "f64"),
        ("dbd", None, "f64"),
        ("dbd-p1", None, "f64"),
        ("dbd-p2", None, "f64"),
    ] {
        let settings = Settings {
            scheme: Some(scheme.to_owned()),
            precision: Some(precision.to_owned()),
            damping: damping.map(str::to_owned),
            step: Some(1e-4),
            ..Settings::default()
        };
        let mut run = Instance::new(Blueprint::new("driven.toml", text.as_str()), settings)
            .unwrap_or_else(|error| panic!("{error}"));
        run.advance(5000).unwrap();
        assert_eq!(
            [value(&run, "a.x"), value(&run, "b.x")],
            [1.0, 2.0],
            "{scheme} {damping:?} {precision}"
        );
        let held = value(&run, "c.y").abs() < 0.02;
        assert!(held, "{scheme} {damping:?} {precision}: {}", value(&run, "c.y"));
    }
}

/// Studies take it as driven: the reference solution of `trade` and `advise`, and the eigenfrequencies of a pose.
#[test]
fn references_and_eigenfrequencies_take_it_as_driven() {
    let scene = Scene::parse(&shaken(0.0, "", SINE), "driven.toml").unwrap();
    let times: Vec<f64> = (0..=7).map(|row| 0.1 * f64::from(row)).collect();
    let states = states(Integrator::Dop853, &scene, false, &times).unwrap();
    for (time, state) in times.iter().zip(&states) {
        let found = state.bodies[1].position.x;
        assert!((found - answer(*time)).abs() < 1e-6, "{time}: {found} {}", answer(*time));
    }
    let (mechanism, start) = Mechanism::of(&scene);
    let highest = eigenfrequencies(&mechanism, &start, 0.0).pop().unwrap();
    assert!((highest - 20.0).abs() < 1e-5, "{highest}");
}

/// It counts as the ground where freedoms are counted; a joint between it and the ground holds nothing.
#[test]
fn freedoms_are_those_of_the_other_bodies() {
    let grounded = carousel(0.0, 0.1)
        + "[[joint]]\nname = \"pillar\"\ntype = \"revolute\"\nbetween = [\"world\", \"base\"]\nat = [0, 0, 0]\n\
           axis = [0, 1, 0]\nspan = 1\nstiffness = 1e6\n";
    for text in [carousel(0.0, 0.1), grounded] {
        let facts = facts(&Scene::parse(&text, "carousel.toml").unwrap());
        assert_eq!((facts.freedoms, facts.equations), (Some(1), 6));
        assert!(facts.locked.is_empty() && facts.jammed.is_empty(), "{facts:?}");
    }
}

/// `driven` alone changes the hash of a model: snapshots of the one do not fit the other.
#[test]
fn a_driven_body_has_another_fingerprint() {
    let free = shaken(0.0, "", "").replacen("driven = true", "", 1);
    let [free, driven] = [free, shaken(0.0, "", "")].map(|text| {
        let run = instance(&text, 1e-3, "f64");
        (
            run.scene().model.bodies[0].is_driven(),
            dbd_kernel::fingerprint::model_hash(run.plant().model()),
        )
    });
    assert!(!free.0 && driven.0 && free.1 != driven.1, "{free:?} {driven:?}");
}

#[test]
fn what_cannot_be_driven_is_refused_with_its_place() {
    let refused = |text: &str, scheme: &str, precision: &str| {
        let settings = Settings {
            scheme: Some(scheme.to_owned()),
            precision: Some(precision.to_owned()),
            step: Some(1e-3),
            ..Settings::default()
        };
        match Instance::new(Blueprint::new("driven.toml", text), settings) {
            Ok(_) => panic!("{scheme} {precision}"),
            Err(error) => error.to_string(),
        }
    };
    let text = shaken(0.0, "", SINE);
    for (scheme, precision, method) in [
        ("rk4", "f64", "the scheme rk4"),
        ("pefrl", "f64", "the scheme pefrl"),
        ("blanes-moan-s6", "f64", "the scheme blanes-moan-s6"),
        ("generalized-alpha", "f64", "the scheme generalized-alpha"),
        ("generalized-alpha-3", "f64", "the scheme generalized-alpha-3"),
    ] {
        let error = refused(&text, scheme, precision);
        assert!(error.contains(method) && error.contains("`base`"), "{error}");
    }
    for (from, to, part) in [
        ("driven = true", "", "names `base`, which forces move"),
        ("mass = 5", "", "`mass`"),
        ("type = \"velocity\"\nbody = \"base\"", "type = \"velocity\"", "`body`"),
        ("duration = 2", "duration = 2\nsettle = true", "cannot bring `base` to rest"),
    ] {
        let error = refused(&text.replacen(from, to, 1), "leapfrog", "f64");
        assert!(error.contains(part), "{error}");
    }
    let aside = shaken(0.0, "gravity = [0, -1, 0]\nplanar = true", SINE);
    let aside = aside.replacen("axis = [1, 0, 0]", "axis = [1, 0, 1]", 1);
    let error = refused(&aside, "leapfrog", "f64");
    assert!(error.contains("leaves the plane"), "{error}");
}
