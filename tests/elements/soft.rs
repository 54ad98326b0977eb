//! Soft starts of stops: continuous force and stiffness, energy, the same in plane and space.

use crate::values::{Case, at, stop, until};
use crate::{instance, value};

/// A pendulum of 0.5 kg between soft stops of its joint, and a mass whose distance has one.
fn scene(planar: bool, soft: &str) -> String {
    format!(
        r#"
        name = "soft"
        duration = 1
        planar = {planar}
        gravity = [0, -9.81, 0]
        [[body]]
        name = "bob"
        mass = 0.5
        inertia = [0.01, 0.01, 0.01]
        position = [0, -0.2, 0]
        angular_velocity = [0, 0, 4]
        velocity = [0.8, 0, 0]
        [[joint]]
        name = "pivot"
        type = "revolute"
        between = ["world", "bob"]
        at = [0, 0, 0]
        axis = [0, 0, 1]
        span = 0.1
        stiffness = 1e6
        limits = {{ from = "-10 deg", to = "12 deg", stiffness = 300{soft} }}
        [[body]]
        name = "mass"
        mass = 1
        inertia = [0.01, 0.01, 0.01]
        position = [1, -0.5, 0]
        [[tsda]]
        name = "cord"
        between = ["world", "mass"]
        points = [[1, 0, 0], [0, 0, 0]]
        stiffness = 0
        free_length = 0.5
        limits = {{ from = 0.2, to = 0.55, stiffness = 8e3{}, dissipation = 0.2 }}
        [[readout]]
        name = "angle"
        type = "joint_angle"
        target = "pivot"
        [[readout]]
        name = "depth"
        type = "interaction"
        target = "pivot.limits"
        quantity = "depth"
        "#,
        soft.replace("deg", "cm"),
    )
}

/// In every precision, in plane and space; a soft start lets it further.
#[test]
fn a_soft_start_lets_further_and_keeps_energy() {
    let run = |planar: bool, soft: &str, precision: &str| {
        let mut run = instance(&scene(planar, soft), 1e-4, precision);
        let (mut deepest, mut lowest) = (0.0_f64, 0.0_f64);
        for _ in 0..10_000 {
            run.advance(1).unwrap();
            deepest = deepest.max(value(&run, "depth"));
            lowest = lowest.min(value(&run, "mass.y"));
        }
        [value(&run, "angle"), value(&run, "mass.y"), deepest, lowest]
    };
    let soft = ", soft = \"2 deg\"";
    let space = run(false, soft, "f64");
    for (planar, precision, near) in
        [(true, "f64", 1e-6), (true, "f32", 2e-3), (false, "f32", 2e-3), (false, "fixed", 2e-3)]
    {
        let found = run(planar, soft, precision);
        for (found, space) in found.into_iter().zip(space) {
            assert!((found - space).abs() < near, "{planar} {precision}: {found} {space}");
        }
    }
    let hard = run(false, "", "f64");
    let [half, none] = [", soft = \"1 deg\"", ", soft = 0"].map(|soft| run(false, soft, "f64"));
    assert_eq!(none.map(f64::to_bits), hard.map(f64::to_bits));
    assert!(hard[2] < half[2] && half[2] < space[2], "{hard:?} {half:?} {space:?}");
    // Far beyond it gives way by half of the soft start more than a hard stop does under the same force.
    assert!(space[3] < half[3] && half[3] < hard[3], "{hard:?} {half:?} {space:?}");
}

/// Without dissipation a soft stop keeps the energy to the order of the step: the error of four times the step is
/// sixteen times as large.
#[test]
fn a_soft_stop_is_of_second_order() {
    let text = r#"
        name = "soft"
        duration = 1
        [[body]]
        name = "mass"
        mass = 1
        inertia = [0.1, 0.1, 0.1]
        position = [0, 0.003, 0]
        velocity = [0, -1, 0]
        [[interaction]]
        law = "soft-end-stop"
        between = ["world", "mass"]
        points = [[0, 0, 0], [0, 0, 0]]
        normal = [0, 1, 0]
        stiffness = 1e5
        soft = "2 mm"
    "#;
    let off = |step: f64| {
        let mut run = instance(text, step, "f64");
        let mut most = 0.0_f64;
        let start = value(&run, "energy.total");
        for _ in 0..(0.015 / step).round() as u32 {
            run.advance(1).unwrap();
            most = most.max((value(&run, "energy.total") - start).abs());
        }
        (most, (value(&run, "mass.vy") - 1.0).abs())
    };
    let [(coarse, rebound), (fine, finer)] = [200e-6, 50e-6].map(off);
    assert!((8.0..40.0).contains(&(coarse / fine)), "{coarse} {fine}");
    assert!(rebound < 1e-3 && finer < 1e-4, "{rebound} {finer}");
}

/// The same with a soft start over 2 mm: the rebound does not depend on the spring.
fn soft_stop() -> String {
    stop().replace("\"end-stop\"", "\"soft-end-stop\"\nsoft = \"2 mm\"")
}

/// The depth x at which the spring, soft over s, has the energy that the impact leaves it: `k·(s²/6 + (x − s)·x/2) =
/// m·(a·v − ln(1 + a·v))/a²`.
fn penetration(soft: f64) -> f64 {
    let (stiffness, a) = (1e5, 0.6_f64);
    let energy = (a - a.ln_1p()) / (a * a);
    0.5 * (soft + (soft * soft - 4.0 * (soft * soft / 3.0 - 2.0 * energy / stiffness)).sqrt())
}

/// The rows of the page.
pub(crate) fn cases() -> Vec<Case> {
    vec![
        Case {
            element: "soft-end-stop",
            what: "penetration, soft over 2 mm",
            unit: "m",
            exact: penetration(2e-3),
            step: 2e-4,
            near: 1e-3,
            found: Box::new(|h| -until(&soft_stop(), h, "mass.y", |time, _| time > 0.02)[0]),
        },
        Case {
            element: "soft-end-stop",
            what: "speed of its rebound",
            unit: "m/s",
            exact: 0.711_950_179_6,
            step: 2e-4,
            near: 1e-3,
            found: Box::new(|h| at(&soft_stop(), h, 0.02, "mass.vy")),
        },
    ]
}
