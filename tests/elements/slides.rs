//! Travel along the axis of a sliding joint, and a force along it, against closed forms.

use dbd_plant::instance::{Blueprint, Instance, Settings};

use crate::{instance, value};

const PRECISIONS: [&str; 3] = ["f64", "f32", "fixed"];

/// A cart of 2 kg on a rail through the ground, its travel from 0.1 m on.
fn cart(between: &str, force: f64) -> String {
    format!(
        r#"
name = "cart"
duration = 1
gravity = [0, 0, 0]
body = [{{ name = "cart", mass = 2, inertia = [0.02, 0.02, 0.02], position = [0.3, 0, 0] }}]
joint = [{{ name = "rail", type = "translational", between = {between}, at = [0.3, 0, 0], axis = [1, 0, 0],
    span = 0.2, gauge = 0.1, offset = 0.02, stiffness = 1e6, damping = 100 }}]
input = [{{ name = "push", type = "joint_force", target = "rail", value = {force:?} }}]
readout = [
    {{ name = "travel", type = "joint_travel", target = "rail", offset = "10 cm" }},
    {{ name = "rate", type = "joint_travel_rate", target = "rail" }},
]
"#
    )
}

/// Constant acceleration: a = F/m, v = a·t, x = a·t²/2; with the ground second, of the ground relative to the cart.
#[test]
fn a_force_along_a_rail_accelerates_a_cart() {
    for precision in PRECISIONS {
        let near = if precision == "f64" { 1e-9 } else { 1e-4 };
        for (between, sign) in [(r#"["world", "cart"]"#, 1.0), (r#"["cart", "world"]"#, -1.0)] {
            let mut cart = instance(&cart(between, 6.0), 1e-4, precision);
            for t in [0.0, 0.25, 0.5] {
                cart.advance_to(t).unwrap();
                let [travel, rate] = ["travel", "rate"].map(|name| value(&cart, name));
                let [x, v] = [0.1 + 1.5 * t * t, 3.0 * t];
                assert!((travel - x).abs() < near, "{precision} {between} {t}: {travel} {x}");
                assert!((rate - v).abs() < near, "{precision} {between} {t}: {rate} {v}");
                let moved = value(&cart, "cart.x") - 0.3;
                assert!(
                    (sign * moved - 1.5 * t * t).abs() < near,
                    "{precision} {between}: {moved}"
                );
            }
        }
    }
}

/// A rod that slides and turns in a sleeve, both free and tumbling.
const ROD: &str = r#"
name = "rod"
duration = 1
gravity = [0, 0, 0]
[[body]]
name = "sleeve"
mass = 2
inertia = [0.03, 0.02, 0.04]
position = [0.1, 0.2, -0.1]
angular_velocity = [0.5, 1.5, 0.8]
[[body]]
name = "rod"
mass = 1
inertia = [0.01, 0.02, 0.02]
position = [0.4, 0.3, 0.1]
velocity = [0.3, 0, 0.2]
angular_velocity = [0.5, 1.5, 0.8]
[[joint]]
name = "slide"
type = "cylindrical"
between = ["sleeve", "rod"]
at = [0.25, 0.25, 0]
axis = [3, 1, 2]
span = 0.3
offset = 0.05
stiffness = 1e5
damping = 50
[[input]]
name = "push"
type = "joint_force"
target = "slide"
[[readout]]
name = "travel"
type = "joint_travel"
target = "slide"
[[readout]]
name = "rate"
type = "joint_travel_rate"
target = "slide"
"#;

/// Momentum and angular momentum about the origin, world.
fn momenta(instance: &Instance) -> [f64; 6] {
    let state = instance.plant().state();
    let mut sum = [0.0; 6];
    for (body, state) in instance.scene().model.bodies.iter().zip(&state.bodies) {
        let p = state.velocity * body.mass;
        let spin = state.angular_velocity.scale(body.inertia);
        let l = state.position.cross(p) + state.orientation.rotation().to_world(spin);
        let parts = p.to_f64().into_iter().chain(l.to_f64());
        sum.iter_mut().zip(parts).for_each(|(sum, part)| *sum += part);
    }
    sum
}

/// What acts on one body acts on the other, along one line. Dampers of points on lines would take angular momentum.
#[test]
fn a_joint_force_keeps_both_momenta() {
    let off = |force: f64| {
        let mut rod = instance(&ROD.replace("damping = 50\n", ""), 1e-4, "f64");
        rod.set_input(0, force).unwrap();
        let before = momenta(&rod);
        rod.advance_to(0.3).unwrap();
        let off = momenta(&rod).into_iter().zip(before).map(|(now, then)| (now - then).abs());
        (off.fold(0.0, f64::max), value(&rod, "travel"))
    };
    let ([without, travelled], [with, pushed]) =
        (<[f64; 2]>::from(off(0.0)), <[f64; 2]>::from(off(8.0)));
    assert!((pushed - travelled).abs() > 0.1, "{pushed} {travelled}");
    assert!(without < 1e-11 && with < 1e-11, "{without} {with}");
}

/// The energy that it gives is the force times the rate that the sensor reports, and the rate is that of the travel.
#[test]
fn the_power_is_the_force_times_the_rate_of_the_travel() {
    let (h, force) = (1e-4, 8.0);
    let mut rod = instance(&ROD.replace("damping = 50\n", ""), h, "f64");
    rod.set_input(0, force).unwrap();
    let total = |rod: &Instance| value(rod, "energy.total");
    let start = total(&rod);
    let [mut work, mut way, mut before] = [0.0, 0.0, value(&rod, "rate")];
    for _ in 0..3000 {
        rod.advance(1).unwrap();
        let now = value(&rod, "rate");
        work += 0.5 * force * (before + now) * h;
        way += 0.5 * (before + now) * h;
        before = now;
    }
    let gained = total(&rod) - start;
    assert!(gained > 0.5 && (gained - work).abs() < 1e-3 * gained, "{gained} J of {work} J");
    assert!((value(&rod, "travel") - way).abs() < 1e-6, "{} {way}", value(&rod, "travel"));
}

/// In its plane and in space the same, but for what the joints give way.
#[test]
fn a_planar_slide_is_the_spatial_one() {
    let text = r#"
name = "arm"
duration = 1
gravity = [0, 0, -9.81]
[[body]]
name = "arm"
mass = 2
inertia = [0.02, 0.02, 0.02]
position = [0.2, 0.1, 0]
[[body]]
name = "slider"
mass = 1
inertia = [0.005, 0.005, 0.005]
position = [0.4, 0.1, 0.02]
[[joint]]
name = "pivot"
type = "revolute"
between = ["world", "arm"]
at = [0, 0.1, 0]
axis = [0, 1, 0]
span = 0.1
stiffness = 1e6
damping = 100
[[joint]]
name = "guide"
type = "translational"
between = ["arm", "slider"]
at = [0.4, 0.1, 0.02]
axis = [1, 0, 0.2]
span = 0.1
gauge = 0.1
offset = 0.02
stiffness = 1e6
damping = 100
[[input]]
name = "push"
type = "joint_force"
target = "guide"
table = [[0, 20], [0.1, -5]]
[[readout]]
name = "travel"
type = "joint_travel"
target = "guide"
[[readout]]
name = "rate"
type = "joint_travel_rate"
target = "guide"
"#;
    for (precision, near) in [("f64", 5e-6), ("f32", 1e-3)] {
        let run = |text: String| {
            let mut arm = instance(&text, 2e-4, precision);
            arm.advance_to(0.4).unwrap();
            ["travel", "rate"].map(|name| value(&arm, name))
        };
        let space = run(text.to_owned());
        let plane = run(text.replacen("duration", "planar = true\nduration", 1));
        assert!(space[0].abs() > 0.02, "{space:?}");
        for (space, plane) in space.into_iter().zip(plane) {
            assert!((space - plane).abs() < near, "{precision}: {space} {plane}");
        }
    }
}

/// Linearised, a cart on a rail is a double integrator.
#[test]
fn a_cart_s_linear_system_is_a_double_integrator() {
    let scene = Blueprint::new("cart.toml", cart(r#"["world", "cart"]"#, 0.0));
    let cart = Instance::new(scene, Settings::default()).unwrap();
    let states = Some(["travel", "rate"].map(str::to_owned).to_vec());
    let options = dbd_plant::instance::LinearOptions { states, ..Default::default() };
    let linear = cart.linearise(&options).unwrap();
    assert_eq!(linear.inputs, ["push"]);
    let exact = [[0.0, 1.0], [0.0, 0.0]];
    for (row, exact) in exact.into_iter().enumerate() {
        for (column, exact) in exact.into_iter().enumerate() {
            let found = linear.a[(row, column)];
            assert!((found - exact).abs() < 1e-6, "{row} {column}: {found}");
        }
    }
    assert!(linear.b[(0, 0)].abs() < 1e-9 && (linear.b[(1, 0)] - 0.5).abs() < 1e-6, "{}", linear.b);
}
