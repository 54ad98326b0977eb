//! Friction of the motor's shaft: a rotor that coasts down, sticks, holds a load, against closed forms.

use crate::drives::wheel;
use crate::values::Case;
use crate::{instance, reference, value};

/// Rotor of 0.05 kg·m² and wheel of 0.02 kg·m² on a stiff gear, with 20 rad/s; friction of 0.7 N·m.
fn coasting(friction: &str) -> String {
    let drive = format!(
        "mode = \"torque\"\nrotor = \"2e-5 kg*m^2\"\nratio = 50\n\
         gear = {{ stiffness = \"5 kN*m/rad\", damping = 2 }}\nfriction = {{ {friction} }}"
    );
    let rate = "[[readout]]\nname = \"rate\"\ntype = \"interaction\"\ntarget = \"motor\"\nquantity = \"rate\"\n";
    (wheel(&drive, "") + rate)
        .replace("position = [0, 0, 0]", "position = [0, 0, 0]\nangular_velocity = [0, 0, 20]")
}

const COULOMB: &str = "coulomb = \"14 mN*m\"";

/// `ω²·(J + N²·m)/(2·N·F)`.
const COASTED: f64 = 400.0 * 0.07 / (2.0 * 0.7);

/// Where the wheel comes to rest, and when the rotor does.
fn coasted(step: f64, precision: &str) -> [f64; 2] {
    let mut run = instance(&coasting(COULOMB), step, precision);
    let mut rest = f64::NAN;
    for ms in 1..=3000 {
        run.advance_to(f64::from(ms) * 1e-3).unwrap();
        if value(&run, "rate") != 0.0 {
            rest = run.time();
        }
    }
    [value(&run, "angle"), rest]
}

/// The angle after 1 s with dry and viscous friction, `J·ω′ = −T − b·ω`.
fn slowed() -> f64 {
    let (inertia, torque, viscous) = (0.07_f64, 0.35, 0.0125);
    let (decay, end) = (viscous / inertia, torque / viscous);
    (20.0 + end) / decay * (1.0 - (-decay).exp()) - end
}

/// The same by a run.
fn viscous(step: f64) -> f64 {
    let friction = "coulomb = \"7 mN*m\", viscous = 5e-6";
    let mut run = instance(&coasting(friction), step, "f64");
    run.advance_to(1.0).unwrap();
    value(&run, "angle")
}

/// It stops after `ω·J/T`, exactly, and stays where it is.
#[test]
fn a_rotor_coasts_down_and_sticks() {
    for (precision, near) in [("f64", 2e-3), ("f32", 2e-2), ("fixed", 2e-2)] {
        let [angle, rest] = coasted(2e-4, precision);
        assert!((angle - COASTED).abs() < near, "{precision}: {angle}");
        assert!((1.99..2.01).contains(&rest), "{precision}: {rest}");
    }
}

/// A load below the friction does not drive the motor back, one above does; half of it, because it is there at once.
#[test]
fn a_rotor_holds_a_load_without_creep() {
    let loaded = |torque: f64| {
        let text = coasting(COULOMB).replace("angular_velocity = [0, 0, 20]", "");
        format!("{text}[[load]]\nbody = \"wheel\"\ntorque = [0, 0, {torque}]\n")
    };
    for precision in ["f64", "f32", "fixed"] {
        let mut run = instance(&loaded(0.34), 2e-4, precision);
        run.advance_to(1.0).unwrap();
        let held = value(&run, "angle");
        run.advance_to(21.0).unwrap();
        // As far as the gear gives, and no further.
        let near = if precision == "f64" { 1e-12 } else { 1e-7 };
        assert!((held - 0.34 / 5e3).abs() < 2e-6, "{precision}: {held}");
        let now = value(&run, "angle");
        assert!((now - held).abs() < near, "{precision}: {now} {held}");
        assert_eq!(value(&run, "rate"), 0.0, "{precision}");
    }
    let mut run = instance(&loaded(0.75), 2e-4, "f64");
    let [early, late] = [1.0, 2.0].map(|time| {
        run.advance_to(time).unwrap();
        value(&run, "speed")
    });
    assert!((late - early - 0.05 / 0.07).abs() < 1e-3, "{early} {late}");
}

/// Servo, winding and lag with friction, against a reference of their own; where they push too little they stick.
#[test]
fn a_drive_overcomes_its_friction() {
    let gear = "rotor = \"2e-5 kg*m^2\"\nratio = 50\ngear = { stiffness = \"200 N*m/rad\", damping = 0.5 }\n\
                friction = { coulomb = \"6 mN*m\", viscous = 2e-5 }";
    let (j, m, k, c, coulomb, b) = (0.02, 0.05, 200.0, 0.5, 0.3, 0.05);
    let stuck = |torque: f64, v: f64| {
        let of = torque - b * v;
        if v.abs() < 1e-6 && of.abs() <= coulomb {
            0.0
        } else {
            of - coulomb * if v.abs() < 1e-6 { of.signum() } else { v.signum() }
        }
    };
    // Velocity servo that starts, and is bounded.
    let servo = format!("mode = \"velocity\"\nkd = 4\nmost = 1.5\nvalue = 8\n{gear}");
    let known = reference([0.0; 4], 0.3, |&[_, w, ahead, v], _| {
        let pull = k * ahead + c * (v - w);
        let effort = (4.0 * (8.0 - v)).clamp(-1.5, 1.5);
        [w, pull / j, v - w, stuck(effort - pull, v) / m]
    });
    let errors = [500e-6, 125e-6].map(|step| {
        let mut run = instance(&wheel(&servo, ""), step, "f64");
        let mut most = 0.0_f64;
        for (ms, row) in known.iter().enumerate() {
            run.advance_to((ms + 1) as f64 * 1e-3).unwrap();
            most = most.max((value(&run, "angle") - row[0]).abs());
        }
        most
    });
    assert!(errors[0] < 2e-3 && errors[1] < 5e-4, "{errors:?}");
    // In the end `kd·(8 − v) = F + b·v`, at any step.
    let speed = (4.0 * 8.0 - coulomb) / (4.0 + b);
    for (kd, step) in [(4.0, 1e-3), (4.0, 1e-4), (4e4, 1e-3)] {
        let text = wheel(&servo.replace("kd = 4", &format!("kd = {kd}")), "");
        let mut run = instance(&text, step, "f64");
        run.advance_to(3.0).unwrap();
        let exact = if kd == 4.0 { speed } else { 8.0 };
        assert!(
            (value(&run, "speed") - exact).abs() < 1e-3,
            "{kd} {step}: {}",
            value(&run, "speed")
        );
    }
    // A winding that pushes less than friction, then more.
    let motor = "mode = \"voltage\"\nwinding = { resistance = 1.2, inductance = \"0.8 mH\", constant = 0.05 }\n\
                 table = [[0, \"0.13 V\"], [0.5, \"6 V\"]]";
    let mut run = instance(&wheel(&format!("{motor}\n{gear}"), ""), 2e-4, "f64");
    run.advance_to(0.5).unwrap();
    assert!(value(&run, "angle").abs() < 1e-12, "{}", value(&run, "angle"));
    assert!((value(&run, "effort") - 0.13 / 1.2 * 2.5).abs() < 1e-6, "{}", value(&run, "effort"));
    run.advance_to(3.0).unwrap();
    // `N·K·(V − N·K·v)/R = F + b·v`.
    let exact = (2.5 * 6.0 / 1.2 - coulomb) / (2.5 * 2.5 / 1.2 + b);
    assert!((value(&run, "speed") - exact).abs() < 1e-4, "{} {exact}", value(&run, "speed"));
}

/// A drive without friction is the law without it, one with zeros likewise.
#[test]
fn no_friction_costs_nothing() {
    let laws = |friction: &str| {
        let run = instance(&coasting(friction), 1e-3, "f64");
        dbd_scene::interactions(run.scene())[0].law
    };
    assert_eq!(laws("coulomb = 0"), "hinge-drive");
    assert_eq!(laws(COULOMB), "hinge-drive-friction");
}

/// The rows of the page.
pub(crate) fn cases() -> Vec<Case> {
    vec![
        Case {
            element: "hinge-drive-friction",
            what: "angle at which a rotor stops after 20 rad/s",
            unit: "rad",
            exact: COASTED,
            step: 5e-4,
            near: 1e-4,
            found: Box::new(|h| coasted(h, "f64")[0]),
        },
        Case {
            element: "hinge-drive-friction",
            what: "angle after 1 s, half of that and 5 µN·m·s/rad",
            unit: "rad",
            exact: slowed(),
            step: 5e-4,
            near: 1e-4,
            found: Box::new(viscous),
        },
    ]
}
