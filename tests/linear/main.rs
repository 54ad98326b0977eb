//! Linear systems against textbook matrices and against steps of the plant.

#[allow(dead_code, reason = "an example has a main function of its own")]
#[path = "../../host-sim/examples/balance.rs"]
mod balance;
mod gains;
#[allow(dead_code, reason = "a controller of firmware")]
#[path = "../../docs/examples/balance-robot/controller.rs"]
mod robot;

use dbd_kernel::{F64, Quaternion, State, Vec3};
use dbd_plant::instance::{Blueprint, Instance, Linear, LinearOptions, Settings};
use dbd_scene::SceneModel;
use nalgebra::{DMatrix, DVector};

// Of the scene `cart-pendulum`.
/// \[m/s²\] gravity.
const G: f64 = 9.81;
/// \[kg\] the cart.
const CART: f64 = 0.94;
/// \[kg\] the pendulum.
const ROD: f64 = 0.23;
/// \[m\] from the pivot to its centre of mass.
const LENGTH: f64 = 0.33;
/// \[kg·m²\] about that.
const INERTIA: f64 = 7.88e-3;
/// \[N·m·s/rad\] of the pivot.
const FRICTION: f64 = 2.4e-3;

const STATES: [&str; 4] = ["cart_point.x", "angle", "cart_velocity.x", "rate"];

fn names(of: &[&str]) -> Option<Vec<String>> {
    Some(of.iter().map(|name| (*name).to_owned()).collect())
}

fn instance(text: &str, changes: &[String]) -> Instance {
    let scene = Blueprint::new("scene.toml", text);
    let scene = changes.iter().fold(scene, |scene, change| scene.with(change.as_str()));
    Instance::new(scene, Settings::default()).unwrap()
}

/// The pendulum upright (`side` 1) or hanging (`side` -1), its joints by a factor stiffer than the scene's.
fn cart(side: f64, stiffer: f64) -> Instance {
    let file = concat!(env!("CARGO_MANIFEST_DIR"), "/../scenes/cart-pendulum.toml");
    let angle = if side > 0.0 { 0.0 } else { std::f64::consts::PI };
    let changes = [
        format!("body.pendulum.position=[0, {:?}, 0]", side * LENGTH),
        format!("body.pendulum.orientation={{axis=[0,0,1], angle={angle:?}}}"),
        format!("joint.rail.stiffness={:?}", 1e5 * stiffer),
        format!("joint.pivot.stiffness={:?}", 8e4 * stiffer),
        "step=1e-5".to_owned(),
    ];
    instance(&std::fs::read_to_string(file).unwrap(), &changes)
}

/// A and B of the ideal cart and pendulum, its angle from upright or from hanging.
fn textbook(side: f64) -> (DMatrix<f64>, DMatrix<f64>) {
    let (about, arm) = (INERTIA + ROD * LENGTH * LENGTH, side * ROD * LENGTH);
    let (whole, weight) = (CART + ROD, arm * G);
    let scale = whole * about - arm * arm;
    let a = [
        [0.0, 0.0, 1.0, 0.0],
        [0.0, 0.0, 0.0, 1.0],
        [0.0, arm * weight / scale, 0.0, -arm * FRICTION / scale],
        [0.0, whole * weight / scale, 0.0, -whole * FRICTION / scale],
    ];
    let b = [0.0, 0.0, about / scale, arm / scale];
    (DMatrix::from_row_slice(4, 4, a.as_flattened()), DMatrix::from_row_slice(4, 1, &b))
}

#[test]
fn the_cart_s_matrices_are_those_of_the_textbook_as_its_joints_become_rigid() {
    for side in [1.0, -1.0] {
        let (a, b) = textbook(side);
        let off = |stiffer: f64| {
            let options = LinearOptions { states: names(&STATES), ..LinearOptions::default() };
            let cart = cart(side, stiffer);
            let (hash, linear) = (cart.hash(), cart.linearise(&options).unwrap());
            assert_eq!(cart.hash(), hash, "the plant has changed");
            assert_eq!(linear.outputs, STATES);
            assert_eq!(linear.inputs, ["drive"]);
            assert!(linear.drift.norm() < 1e-6, "{}", linear.drift);
            assert!((&linear.c - DMatrix::identity(4, 4)).norm() < 1e-9, "{}", linear.c);
            let off = [&linear.a - &a, &linear.b - b.columns(0, 1)].map(|off| off.abs().max());
            println!("{side} {stiffer}: {off:?}, left out {}", linear.slowest_left_out);
            off
        };
        let ([a1, b1], [a2, b2]) = (off(1.0), off(100.0));
        // Of 26.6 /s² and 2.32 rad/(s²·N): joints that are a hundred times as stiff are a hundred times as near.
        assert!(a1 < 0.02 && b1 < 2e-3, "{a1} {b1}");
        assert!(a2 < a1 / 50.0 && b2 < b1 / 50.0, "{a2} {b2}");
    }
}

/// Three masses along x on four springs and dampers, between two walls.
const CHAIN: &str = r#"
name = "chain"
duration = 1.0
step = "1 ms"
gravity = [0, 0, 0]
body = [
    { name = "a", mass = 1.0, inertia = [0.1, 0.1, 0.1], position = [1, 0, 0] },
    { name = "b", mass = 2.0, inertia = [0.1, 0.1, 0.1], position = [2, 0, 0] },
    { name = "c", mass = 4.0, inertia = [0.1, 0.1, 0.1], position = [3, 0, 0] },
]
[[tsda]]
between = ["world", "a"]
points = [[0, 0, 0], [0, 0, 0]]
stiffness = 300.0
damping = 3.0
free_length = 1.0
[[tsda]]
between = ["a", "b"]
points = [[0, 0, 0], [0, 0, 0]]
stiffness = 500.0
damping = 5.0
free_length = 1.0
[[tsda]]
between = ["b", "c"]
points = [[0, 0, 0], [0, 0, 0]]
stiffness = 700.0
damping = 7.0
free_length = 1.0
[[tsda]]
between = ["c", "world"]
points = [[0, 0, 0], [4, 0, 0]]
stiffness = 900.0
damping = 9.0
free_length = 1.0
[[input]]
name = "push"
type = "force"
body = "b"
axis = [1, 0, 0]
[[readout]]
name = "end"
type = "point"
body = "c"
"#;

#[test]
fn a_chain_s_matrices_are_those_of_its_springs() {
    let linear = instance(CHAIN, &[]).linearise(&LinearOptions::default()).unwrap();
    assert_eq!((linear.states.len(), linear.outputs.len()), (36, 3));
    assert!(linear.slowest_left_out.is_infinite());
    let at = |name: &str| linear.states.iter().position(|state| state == name).unwrap();
    let springs = [300.0, 500.0, 700.0, 900.0];
    let mut largest = 0.0_f64;
    for (row, (to, mass)) in [("a.vx", 1.0), ("b.vx", 2.0), ("c.vx", 4.0)].into_iter().enumerate() {
        for (column, body) in ["a", "b", "c"].into_iter().enumerate() {
            let k = match column.abs_diff(row) {
                0 => -(springs[row] + springs[row + 1]),
                1 => springs[row.max(column)],
                _ => 0.0,
            };
            let found = |part: &str| linear.a[(at(to), at(&format!("{body}.{part}")))];
            largest = largest.max((found("x") - k / mass).abs());
            largest = largest.max((found("vx") - 0.01 * k / mass).abs());
        }
        let push = if row == 1 { 0.5 } else { 0.0 };
        largest = largest.max((linear.b[(at(to), 0)] - push).abs());
    }
    println!("largest difference {largest}");
    assert!(largest < 1e-7, "{largest}");
    assert_eq!(linear.outputs, ["end.x", "end.y", "end.z"]);
    assert!((linear.c[(0, at("c.x"))] - 1.0).abs() < 1e-9);
    assert_eq!(linear.d, DMatrix::zeros(3, 1));
}

/// A body on six springs that hold all of its freedoms, at rest.
const HELD: &str = r#"
name = "held"
duration = 1.0
step = "1 ms"
gravity = [0, 0, 0]
[[body]]
name = "box"
mass = 2.0
inertia = [0.3, 0.2, 0.1]
position = [0, 0, 0]
"#;

fn held(step: f64) -> Instance {
    let mut text = HELD.to_owned();
    let legs = [
        ([0.5, 0.0, 0.1], [1.0, 0.2, 0.0]),
        ([-0.5, 0.1, 0.0], [-0.6, 1.0, 0.1]),
        ([0.0, 0.5, 0.0], [0.1, 0.6, 1.0]),
        ([0.2, -0.4, 0.0], [-0.8, -0.4, 0.1]),
        ([0.0, 0.1, 0.4], [0.0, -0.9, 0.3]),
        ([0.1, 0.3, -0.4], [0.2, 0.3, -1.0]),
    ];
    for (on, to) in legs {
        let length =
            on.iter().zip(to).map(|(a, b): (&f64, f64)| (b - a).powi(2)).sum::<f64>().sqrt();
        text += &format!(
            "[[tsda]]\nbetween = [\"box\", \"world\"]\npoints = [{on:?}, {to:?}]\nstiffness = 400.0\ndamping = 2.0\nfree_length = {length:?}\n"
        );
    }
    instance(&text, &[format!("step={step:?}")])
}

/// A state with one of the twelve coordinates of the only body displaced.
fn moved(state: &State<SceneModel<F64>>, coordinate: usize, by: f64) -> State<SceneModel<F64>> {
    let mut state = state.clone();
    let (body, axis) = (&mut state.bodies[0], Vec3::axes()[coordinate % 3]);
    match coordinate / 3 {
        0 => body.position = body.position + axis * by,
        1 => {
            let v = axis * (0.5 * by).sin();
            let turn = Quaternion::new((0.5 * by).cos(), v.x, v.y, v.z);
            body.orientation = body.orientation.product(turn);
        }
        2 => body.velocity = body.velocity + axis * by,
        _ => body.angular_velocity = body.angular_velocity + axis * by,
    }
    state
}

/// The twelve coordinates of the only body, small, about a pose without rotation.
fn coordinates(state: &State<SceneModel<F64>>) -> DVector<f64> {
    let body = &state.bodies[0];
    let [_, x, y, z] = body.orientation.to_f64();
    let (place, rates) = (body.position.to_f64(), [body.velocity, body.angular_velocity]);
    let all = place.into_iter().chain([2.0 * x, 2.0 * y, 2.0 * z]);
    DVector::from_iterator(12, all.chain(rates.into_iter().flat_map(|rate| rate.to_f64())))
}

/// The Jacobian of one step, by differences of whole steps.
fn of_a_step(plant: &mut Instance) -> DMatrix<f64> {
    let (start, by) = (plant.plant().state(), 1e-4);
    let mut map = DMatrix::zeros(12, 12);
    for coordinate in 0..12 {
        let mut end = |by: f64| {
            plant.plant_mut().set_state(&moved(&start, coordinate, by)).unwrap();
            plant.advance(1).unwrap();
            coordinates(&plant.plant().state())
        };
        let (forth, back) = (end(by) - end(-by), end(2.0 * by) - end(-2.0 * by));
        map.set_column(coordinate, &((forth * 8.0 - back) / (12.0 * by)));
    }
    map
}

#[test]
fn a_step_is_the_exponential_of_the_linear_system_to_the_scheme_s_order() {
    let Linear { a, .. } = held(1e-3).linearise(&LinearOptions::default()).unwrap();
    let fastest = a.complex_eigenvalues().iter().map(|pole| pole.norm()).fold(0.0, f64::max);
    let off: Vec<f64> = [8e-3, 4e-3, 2e-3, 1e-3]
        .into_iter()
        .map(|step| (of_a_step(&mut held(step)) - (&a * step).exp()).norm())
        .collect();
    let ratios: Vec<f64> = off.windows(2).map(|pair| pair[0] / pair[1]).collect();
    println!("fastest pole {fastest} rad/s; differences {off:?}, ratios {ratios:?}");
    // Leapfrog is of second order: one step is wrong by h³.
    assert!(ratios.iter().all(|ratio| (7.0..9.0).contains(ratio)), "{ratios:?}");
}

#[test]
fn a_linear_system_that_there_is_not_is_refused_with_the_remedy() {
    let cart = cart(1.0, 1.0);
    for (states, outputs, words) in [
        (&STATES[..3], &STATES[..], "the 3 slowest motions are not separated"),
        (
            &["cart_point.x", "cart.x", "cart_velocity.x", "rate"],
            &STATES,
            "do not distinguish the 4",
        ),
        (&["angle", "angle"], &STATES, "each output once"),
        (&[], &STATES, "at least one"),
        (&["angel"], &STATES, "did you mean `angle`?"),
        (&STATES, &["angel"], "did you mean `angle`?"),
    ] {
        let options = LinearOptions {
            states: names(states),
            outputs: names(outputs),
            ..LinearOptions::default()
        };
        let refused = cart.linearise(&options).unwrap_err().sentence();
        assert!(refused.contains(words), "{refused}");
    }
    let options = LinearOptions { perturb: f64::NAN, ..LinearOptions::default() };
    let refused = cart.linearise(&options).unwrap_err().sentence();
    assert_eq!(refused, "perturb cannot be NaN; give a number between 0 and 0.1");
    let options = LinearOptions { inputs: names(&["dirve"]), ..LinearOptions::default() };
    let refused = cart.linearise(&options).unwrap_err().sentence();
    assert!(refused.contains("did you mean `drive`?"), "{refused}");
}

/// A quasi-static output: what a stiff joint carries follows the input at once.
#[test]
fn what_is_fast_shows_in_d() {
    let cart = cart(-1.0, 1.0);
    let options = LinearOptions {
        states: names(&STATES),
        outputs: names(&["pendulum.vx", "cart.x"]),
        ..LinearOptions::default()
    };
    let linear = cart.linearise(&options).unwrap();
    assert_eq!((linear.c.shape(), linear.d.shape()), ((2, 4), (2, 1)));
    // The pendulum's centre moves with the cart and by its arm.
    assert!(
        (linear.c[(0, 2)] - 1.0).abs() < 1e-3 && (linear.c[(0, 3)] - LENGTH).abs() < 1e-3,
        "{}",
        linear.c
    );
    assert!((linear.c[(1, 0)] - 1.0).abs() < 1e-6, "{}", linear.c);
}

/// A block slides along a rail with dry friction, and sticks.
const BLOCK: &str = r#"
name = "block"
duration = 2.0
step = "0.2 ms"
gravity = [0, 0, 0]
[[body]]
name = "block"
mass = 1.0
inertia = [0.01, 0.01, 0.01]
position = [0, 0, 0]
[[joint]]
name = "rail"
type = "translational"
between = ["world", "block"]
at = [0, 0, 0]
axis = [1, 0, 0]
stiffness = 1e5
damping = 20.0
span = 0.1
gauge = 0.06
offset = 0.01
friction = { coulomb = 2.0 }
[[input]]
name = "push"
type = "force"
body = "block"
axis = [1, 0, 0]
"#;

/// Where friction sticks is part of the state that is linearised.
#[test]
fn friction_sticks_where_it_has_come_to_rest() {
    let mut block = instance(BLOCK, &[]);
    block.set_input(0, 6.0).unwrap();
    block.advance_to(0.2).unwrap();
    block.set_input(0, 0.0).unwrap();
    block.advance_to(1.8).unwrap();
    assert!(block.value(block.output("block.x").unwrap()) > 0.05);
    let linear = block.linearise(&LinearOptions::default()).unwrap();
    let row = linear.states.iter().position(|state| state == "block.vx").unwrap();
    println!("drift {} m/s², stiffness {} /s²", linear.drift[row], linear.a[(row, 0)]);
    assert!(linear.drift[row].abs() < 0.02 && linear.a[(row, 0)] < -100.0, "{}", linear.drift);
}
