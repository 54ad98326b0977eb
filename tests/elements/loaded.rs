//! Friction that grows with the force of a joint: under weight and centrifugal force, on an incline, in closed form.

use crate::values::Case;
use crate::{instance, value};

const G: f64 = 9.81;
const MU: f64 = 0.12;
const RADIUS: f64 = 0.02;

/// A rotor of 2 kg and 0.01 kg·m² at 30 rad/s, its centre of mass `off` its axis z.
fn rotor(off: f64, gravity: [f64; 3], friction: &str, more: &str) -> String {
    let speed = 30.0;
    format!(
        "name = \"rotor\"\nduration = 1\ngravity = {gravity:?}\n{more}\n[[body]]\nname = \"rotor\"\nmass = 2\n\
         inertia = [0.01, 0.01, 0.01]\nposition = [{off}, 0, 0]\nangular_velocity = [0, 0, {speed}]\n\
         velocity = [0, {}, 0]\n[[joint]]\nname = \"pivot\"\ntype = \"revolute\"\nbetween = [\"world\", \"rotor\"]\n\
         at = [0, 0, 0]\naxis = [0, 0, 1]\nspan = 0.1\nstiffness = 1e7\ndamping = 2e3\n\
         friction = {{ {friction} }}\n{}[[readout]]\nname = \"speed\"\ntype = \"joint_rate\"\ntarget = \"pivot\"\n",
        off * speed,
        shown("pivot.friction"),
    )
}

/// Read-outs of both quantities.
fn shown(target: &str) -> String {
    let of = |quantity| {
        format!(
            "[[readout]]\nname = \"{quantity}\"\ntype = \"interaction\"\ntarget = \"{target}\"\nquantity = \"{quantity}\"\n"
        )
    };
    of("load") + &of("slip")
}

const LOADED: &str =
    "coulomb = 0, breakaway = 1e-6, load = { mu = 0.12, radius = \"20 mm\", force = 20 }";

/// A block of 2 kg on a rail along x, under gravity of an incline.
fn block(angle: f64, friction: &str, more: &str) -> String {
    let (sin, cos) = angle.sin_cos();
    format!(
        "name = \"block\"\nduration = 1\ngravity = [{}, {}, 0]\n{more}\n[[body]]\nname = \"block\"\nmass = 2\n\
         inertia = [0.01, 0.01, 0.01]\nposition = [0, 0, 0]\n[[joint]]\nname = \"rail\"\ntype = \"translational\"\n\
         between = [\"world\", \"block\"]\nat = [0, 0, 0]\naxis = [1, 0, 0]\nreference = [0, 1, 0]\nspan = 0.2\n\
         gauge = 0.1\noffset = 0.05\nstiffness = 1e6\ndamping = 1e3\nfriction = {{ {friction} }}\n{}",
        G * sin,
        -G * cos,
        shown("rail.friction"),
    )
}

const SLIDING: &str = "coulomb = 0, breakaway = 1e-6, load = { mu = 0.12, force = 20 }";

fn run_to(text: &str, step: f64, precision: &str, time: f64, name: &str) -> f64 {
    let mut run = instance(text, step, precision);
    run.advance_to(time).unwrap();
    value(&run, name)
}

/// `(30 − w)/t·J` is the friction torque: that of the weight across the axis, none of the weight along it.
#[test]
fn a_weight_across_the_axis_brakes_a_rotor() {
    let torque = MU * RADIUS * 2.0 * G;
    for (precision, near) in [("f64", 2e-3), ("f32", 4e-3), ("fixed", 4e-3)] {
        let of = |gravity: [f64; 3], friction: &str| {
            let text = rotor(0.0, gravity, friction, "");
            (30.0 - run_to(&text, 1e-4, precision, 0.5, "speed")) / 0.5 * 0.01
        };
        let across = of([0.0, -G, 0.0], LOADED);
        assert!((across / torque - 1.0).abs() < near, "{precision}: {across} {torque}");
        let tilted = of([0.6 * G, 0.0, -0.8 * G], LOADED);
        assert!((tilted / (0.6 * torque) - 1.0).abs() < near, "{precision}: {tilted}");
        // The last digits of a force have a part across, whatever its sign.
        let along = of([0.0, 0.0, -G], LOADED);
        assert!(along.abs() < 5.0 * near * torque, "{precision}: {along}");
        let both = LOADED.replace("coulomb = 0, breakaway = 1e-6", "coulomb = 0.02");
        let both = of([0.0, -G, 0.0], &both);
        assert!((both / (torque + 0.02) - 1.0).abs() < near, "{precision}: {both}");
    }
}

/// 60 mm off its axis, without gravity: `J·w' = −μ·r·N`, `N² = (m·l)²·(w⁴ + w'²)`.
fn centrifugal(time: f64) -> f64 {
    let (mass, off) = (2.0, 0.06);
    let factor: f64 = MU * RADIUS * mass * off / (0.01 + mass * off * off);
    30.0 / (1.0 + 30.0 * time * factor / (1.0 - factor * factor).sqrt())
}

fn unbalanced(step: f64) -> f64 {
    run_to(&rotor(0.06, [0.0; 3], LOADED, ""), step, "f64", 1.0, "speed")
}

#[test]
fn a_centrifugal_force_brakes_a_rotor() {
    let found = unbalanced(1e-4);
    assert!((found / centrifugal(1.0) - 1.0).abs() < 2e-3, "{found} {}", centrifugal(1.0));
}

/// In the plane as in space, below the angle of friction at rest without creep.
#[test]
fn a_block_slides_or_stays_on_an_incline() {
    let slides = 30_f64.to_radians();
    let exact = G * (slides.sin() - MU * slides.cos());
    for more in ["", "planar = true"] {
        let speed = run_to(&block(slides, SLIDING, more), 1e-4, "f64", 1.0, "block.vx");
        assert!((speed / exact - 1.0).abs() < 1e-3, "{more}: {speed} {exact}");
        let (sticks, mut places) = (6_f64.to_radians(), Vec::new());
        let mut run = instance(&block(sticks, SLIDING, more), 1e-4, "f64");
        for time in [0.5, 5.5] {
            run.advance_to(time).unwrap();
            places.push(value(&run, "block.x"));
        }
        // Within the give of 0.1 mm, but for the first moment, in which the rail takes up the load.
        assert!(places[0] > 0.0 && places[0] < 2e-4, "{more}: {places:?}");
        assert!((places[1] - places[0]).abs() < 1e-9, "{more}: {places:?}");
        let load = value(&run, "load");
        assert!((load / (MU * 2.0 * G * sticks.cos()) - 1.0).abs() < 1e-6, "{more}: {load}");
    }
}

/// The load is that of the read-out of the joint's force, which a damper of the joint does not have at rest.
#[test]
fn the_load_is_the_joint_s_force() {
    let force = "[[readout]]\nname = \"force\"\ntype = \"joint_force\"\ntarget = \"pivot\"\n";
    let text = rotor(0.06, [1.0, -G, 3.0], LOADED, "") + force;
    let text = text.replace("damping = 2e3", "damping = 0");
    let mut run = instance(&text, 1e-4, "f64");
    for _ in 0..50 {
        run.advance(37).unwrap();
        let [x, y] = ["force.x", "force.y"].map(|name| value(&run, name));
        // About an axis of the ground, so across it are x and y.
        let exact = MU * RADIUS * x.hypot(y);
        assert!(
            (value(&run, "load") / exact - 1.0).abs() < 1e-9,
            "{} {exact}",
            value(&run, "load")
        );
    }
}

/// A joint without `load` has the law of before; as a law by itself it names the joint.
#[test]
fn a_law_by_itself_names_the_joint() {
    let laws = |text: &str| {
        let run = instance(text, 1e-4, "f64");
        dbd_scene::interactions(run.scene())[0].law
    };
    let keyed = rotor(0.0, [0.0, -G, 0.0], LOADED, "");
    assert_eq!(laws(&keyed), "hinge-friction-load");
    let plain = keyed.replace(", load = { mu = 0.12, radius = \"20 mm\", force = 20 }", "");
    let plain = plain.replace(&shown("pivot.friction"), "");
    assert_eq!(laws(&plain), "hinge-friction");
    let own = "[[interaction]]\nname = \"own\"\nlaw = \"hinge-friction-load\"\nbetween = [\"world\", \"rotor\"]\n\
               axis = [0, 0, 1]\njoint = \"pivot\"\nmu = 0.12\nradius = 0.02\nforce = 20\ncoulomb = 0\n\
               breakaway = 1e-6\ndamping = 0.01\n";
    let listed =
        keyed.replace(&format!("friction = {{ {LOADED} }}\n"), "").replace("pivot.friction", "own")
            + own;
    let keyed = keyed.replace("breakaway = 1e-6", "breakaway = 1e-6, damping = 0.01");
    let [one, other] = [keyed, listed].map(|text| {
        let mut run = instance(&text, 1e-4, "f64");
        run.advance(1000).unwrap();
        run.hash()
    });
    assert_eq!(one, other);
}

#[test]
fn a_snapshot_keeps_the_load() {
    let text = rotor(0.06, [1.0, -G, 3.0], LOADED, "");
    for precision in ["f64", "f32", "fixed"] {
        let mut one = instance(&text, 1e-4, precision);
        one.advance(777).unwrap();
        assert_eq!(one.plant().evaluations(), 778, "{precision}");
        let saved = one.save().unwrap();
        let mut other = instance(&text, 1e-4, precision);
        other.restore(&saved).unwrap();
        assert_eq!(value(&one, "load"), value(&other, "load"), "{precision}");
        for run in [&mut one, &mut other] {
            run.advance(500).unwrap();
        }
        assert_eq!(one.hash(), other.hash(), "{precision}");
    }
}

/// The rows of the page.
pub(crate) fn cases() -> Vec<Case> {
    let slides = 30_f64.to_radians();
    vec![
        Case {
            element: "hinge-friction-load",
            what: "rate 1 s after 30 rad/s, load by centrifugal force",
            unit: "rad/s",
            exact: centrifugal(1.0),
            step: 1e-4,
            near: 1e-3,
            found: Box::new(unbalanced),
        },
        Case {
            element: "slide-friction-load",
            what: "speed after sliding 1 s on 30°, μ 0.12",
            unit: "m/s",
            exact: G * (slides.sin() - MU * slides.cos()),
            step: 4e-4,
            near: 1e-3,
            found: Box::new(move |h| {
                run_to(&block(slides, SLIDING, ""), h, "f64", 1.0, "block.vx")
            }),
        },
    ]
}
