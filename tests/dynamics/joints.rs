//! Every type of joint: what it holds is as stiff as `docs/joints.md` says, what it frees is free,
//! and its energy is kept.

mod matrix;

use dbd_kernel::energy::energy;
use dbd_kernel::forces::wrenches;
use dbd_kernel::{F64, Leapfrog, Plant, Quaternion, State, Vec3};
use dbd_scene::{Scene, SceneModel};
use dbd_tests::page::{block, table};
use dbd_tests::{momenta, turned};
use matrix::{AT, K, Matrix, axes, diagonal, largest_difference, load, matrix, shifted, stiffness};

/// \[N·s/m\] per TSDA, where a joint is damped.
const C: f64 = 30.0;

/// A joint, what the documentation says of it and its free motion.
struct Case {
    name: &'static str,
    /// Keys besides those of every joint; `AXIS` is replaced by its axes.
    keys: &'static str,
    /// \[m\] the length that makes the matrix dimensionless.
    length: f64,
    /// The stiffness matrix in k and that length.
    stiffness: fn() -> Matrix,
    /// Turns \[rad\] about (e1, e2, axis), applied in this order in axes that turn with it, and
    /// the slide \[m\] along the axis.
    free: ([f64; 3], f64),
}

const UNIVERSAL: &str = "spider = { mass = 0.3, inertia = [2e-3, 2e-3, 2e-3] }\nspan = 0.1";

/// The lengths: span 0.1 throughout, arm 0.05, offset 0.02, gauge 0.06, ring 0.04.
#[rustfmt::skip]
const CASES: &[Case] = &[
    Case { name: "spherical", keys: "arm = 0.05", length: 0.05, free: ([0.9, -0.6, 1.2], 0.0),
        stiffness: || diagonal([1.0, 1.0, 1.0], [0.0; 3]) },
    Case { name: "revolute", keys: "AXIS\nspan = 0.1", length: 0.1, free: ([0.0, 0.0, 1.05], 0.0),
        stiffness: || diagonal([2.0, 2.0, 2.0], [0.5, 0.5, 0.0]) },
    Case { name: "revolute, ring 0.4 s", keys: "AXIS\nspan = 0.1\nring = 0.04", length: 0.1, free: ([0.0, 0.0, -2.0], 0.0),
        // L² = r² + s²/4 = 0.41 s²: across 3r²/L², along 3s²/(2L²), about the normals (3/4)s²r²/L².
        stiffness: || diagonal([0.48 / 0.41, 0.48 / 0.41, 1.5 / 0.41], [0.12 / 0.41, 0.12 / 0.41, 0.0]) },
    Case { name: "spherical, bushing", keys: "realisation = \"bushing\"", length: 0.05, free: ([0.9, -0.6, 1.2], 0.0),
        stiffness: || diagonal([1.0, 1.0, 1.0], [0.0; 3]) },
    Case { name: "revolute, bushing", keys: "AXIS\nspan = 0.1\nrealisation = \"bushing\"", length: 0.1, free: ([0.0, 0.0, 1.05], 0.0),
        stiffness: || diagonal([2.0, 2.0, 2.0], [0.5, 0.5, 0.0]) },
    Case { name: "revolute, bushing, ring 0.4 s", keys: "AXIS\nspan = 0.1\nring = 0.04\nrealisation = \"bushing\"", length: 0.1, free: ([0.0, 0.0, -2.0], 0.0),
        stiffness: || diagonal([0.48 / 0.41, 0.48 / 0.41, 1.5 / 0.41], [0.12 / 0.41, 0.12 / 0.41, 0.0]) },
    Case { name: "universal, bushing", keys: "span = 0.1\nrealisation = \"bushing\"", length: 0.1, free: ([1.05, -0.7, 0.0], 0.0),
        stiffness: || diagonal([1.0, 1.0, 1.0], [0.0, 0.0, 0.25]) },
    Case { name: "fixed, bushing", keys: "AXIS\nspan = 0.1\nrealisation = \"bushing\"", length: 0.1, free: ([0.0; 3], 0.0),
        stiffness: fixed },
    Case { name: "universal", keys: UNIVERSAL, length: 0.1, free: ([1.05, -0.7, 0.0], 0.0),
        stiffness: || diagonal([1.0, 1.0, 1.0], [0.0, 0.0, 0.25]) },
    Case { name: "cylindrical", keys: "AXIS\nspan = 0.1\noffset = 0.02", length: 0.1, free: ([0.0, 0.0, 1.05], 0.1),
        stiffness: || diagonal([2.0, 2.0, 0.0], [0.5, 0.5, 0.0]) },
    Case { name: "translational", keys: "AXIS\nspan = 0.1\noffset = 0.02\ngauge = 0.06", length: 0.1, free: ([0.0; 3], -0.1),
        stiffness: || diagonal([4.0, 4.0, 0.0], [1.0, 1.0, 0.36]) },
    Case { name: "translational, outward", keys: "AXIS\nspan = 0.1\noffset = 0.02\ngauge = 0.06\noffsets = \"outward\"", length: 0.1, free: ([0.0; 3], -0.1),
        stiffness: || diagonal([4.0, 4.0, 0.0], [1.0, 1.0, 0.36]) },
    Case { name: "fixed", keys: "AXIS\nspan = 0.1\narm = 0.05", length: 0.1, free: ([0.0; 3], 0.0),
        stiffness: fixed },
];

/// The third tripod stands aside: the centre of stiffness is s/6 along the reference.
fn fixed() -> Matrix {
    let mut matrix = diagonal([3.0, 3.0, 3.0], [0.5, 0.75, 0.25]);
    for (force, turn, coupling) in [(1, 5, 0.5), (2, 4, -0.5)] {
        matrix[force][turn] = coupling;
        matrix[turn][force] = coupling;
    }
    matrix
}

fn scene(case: &Case, grounded: bool, damping: f64) -> Scene {
    let [e1, e2, axis] = axes().map(Vec3::to_f64);
    let keys = case.keys.replace("AXIS", &format!("axis = {axis:?}\nreference = {e1:?}"));
    let kind = case.name.split(',').next().unwrap_or_default();
    let keys = match kind {
        "universal" => format!("axes = [{e1:?}, {e2:?}]\n{keys}"),
        _ => keys,
    };
    let first = if grounded { "world" } else { "first" };
    let text = format!(
        r#"
        name = "joint"
        duration = 1
        [[body]]
        name = "first"
        mass = 1.2
        inertia = [0.02, 0.03, 0.025]
        position = [0.1, 0.1, -0.2]
        orientation = {{ euler_321 = [0.4, 1.1, -0.7] }}
        [[body]]
        name = "second"
        mass = 0.8
        inertia = [0.01, 0.02, 0.015]
        position = [0.5, -0.1, 0.3]
        orientation = {{ euler_321 = [-1.4, 0.2, 0.9] }}
        [[joint]]
        name = "joint"
        type = "{kind}"
        between = ["{first}", "second"]
        at = {AT:?}
        stiffness = {K:?}
        damping = {damping:?}
        {keys}
        "#
    );
    Scene::parse(&text, "joint.toml").unwrap_or_else(|error| panic!("{error}\n{text}"))
}

#[test]
fn stiffness_is_what_the_documentation_says() {
    let mut rows = Vec::new();
    for case in CASES {
        let documented = (case.stiffness)();
        let greatest =
            documented.as_flattened().iter().fold(0.0_f64, |m, entry| m.max(entry.abs()));
        for grounded in [true, false] {
            let measured = stiffness(&scene(case, grounded, 0.0), case.length);
            let difference = largest_difference(&measured, &documented);
            if grounded {
                let row = |from: usize| {
                    let of = |m: &Matrix| {
                        [0, 1, 2]
                            .map(|i| {
                                format!("{:.5}", (1e5 * m[from + i][from + i]).round() / 1e5 + 0.0)
                            })
                            .join(", ")
                    };
                    format!("{} / {}", of(&measured), of(&documented))
                };
                rows.push(vec![case.name.to_owned(), row(0), row(3)]);
            }
            assert!(
                difference < 1e-7 * greatest,
                "{}, grounded {grounded}: {measured:.6?}",
                case.name
            );
        }
    }
    let head = ["joint", "K_t measured / documented, in k", "K_φ measured / documented, in k·s²"];
    block("docs/joints.md", "stiffness", &table(&head, &rows));
}

/// What the second body feels, the first feels reversed, spider included: the loads about one
/// point add up to 0 in any pose.
#[test]
fn loads_on_all_bodies_of_a_joint_are_in_equilibrium() {
    for (case, damping) in CASES.iter().flat_map(|case| [(case, 0.0), (case, C)]) {
        let scene = scene(case, false, damping);
        let mut state = State::initial(&scene.model);
        state = shifted(&state, 1, turned([0.48, 0.6, 0.64], 0.2), Vec3::new(0.01, -0.02, 0.015));
        state.bodies[1].velocity = Vec3::new(1.0, 2.0, -0.5);
        let loads: Vec<_> =
            (0..scene.model.bodies.len()).map(|b| load(&scene.model, &state, b)).collect();
        let [force, torque] =
            loads.iter().fold([Vec3::ZERO; 2], |sum, l| [sum[0] + l[0], sum[1] + l[1]]);
        assert!(loads[1][0].dot(loads[1][0]) > 1.0, "{}: a force acts", case.name);
        assert!(force.dot(force).sqrt() < 1e-9, "{}: {force:?}", case.name);
        // The damper of a point on a line keeps no angular momentum while the point is off it, that of a
        // point bushing while its points are apart; that of a revolute acts on both bodies at one place.
        let lines = ["cylindrical", "translational"].iter().any(|line| case.name.starts_with(line));
        let bushing = case.name.ends_with("bushing") && !case.name.starts_with("revolute");
        let exact = damping == 0.0 || !(lines || bushing);
        assert!(!exact || torque.dot(torque).sqrt() < 1e-9, "{}: {torque:?}", case.name);
    }
}

/// The pose in which the joint has made its free motion.
fn moved(case: &Case, scene: &Scene) -> State<SceneModel<F64>> {
    let [e1, e2, axis] = axes().map(Vec3::to_f64);
    let (turns, slide) = case.free;
    let [first, second, third] = [(e1, turns[0]), (e2, turns[1]), (axis, turns[2])]
        .map(|(axis, angle)| Quaternion::<f64>::from_f64(turned(axis, angle)));
    let mut state = State::initial(&scene.model);
    if scene.model.bodies.len() > 2 {
        // The spider follows the turn about the first axis, which is its own with the first body.
        state = shifted(&state, 2, first.to_f64(), Vec3::ZERO);
    }
    let turn = first.product(second).product(third).to_f64();
    shifted(&state, 1, turn, Vec3::from_f64(axis) * slide)
}

#[test]
fn free_directions_are_free_however_far() {
    for case in CASES {
        for grounded in [true, false] {
            let scene = scene(case, grounded, 0.0);
            let mut state = moved(case, &scene);
            if !grounded {
                // All bodies turned and shifted together.
                for body in 0..scene.model.bodies.len() {
                    let turn = turned([0.48, -0.6, 0.64], 2.5);
                    state = shifted(&state, body, turn, Vec3::new(0.7, -0.4, 0.2));
                }
            }
            for wrench in wrenches(&scene.model, &state, 1e-3).unwrap() {
                let greatest =
                    wrench.force.dot(wrench.force).max(wrench.torque.dot(wrench.torque)).sqrt();
                assert!(greatest < 1e-9 * K, "{}, grounded {grounded}: {greatest:e}", case.name);
            }
        }
    }
}

/// Both bodies and the spider turn together about `AT`; the second moves along what is free.
fn in_motion(case: &Case, scene: &Scene) -> SceneModel<F64> {
    let [e1, e2, axis] = axes();
    let together = e1 * 0.8 - e2 * 0.5 + axis * 1.1;
    let (turns, slide) = case.free;
    let free = [e1 * turns[0], e2 * turns[1], axis * turns[2]];
    let mut model = scene.model.clone();
    for (body, state) in model.initial.iter_mut().enumerate() {
        let spin = match body {
            1 => free.into_iter().fold(together, |sum, turn| sum + turn),
            2 => together + free[0],
            _ => together,
        };
        let slide = if body == 1 { axis * slide } else { Vec3::ZERO };
        state.velocity = spin.cross(state.position - Vec3::from_f64(AT)) + slide;
        state.angular_velocity = state.orientation.rotation().to_body(spin);
    }
    model
}

/// Leapfrog at ω·h ≤ 0.2 for 5 s. The energy's error is (ω·h)² of what swings in the joint and
/// stays there; momentum is kept to rounding.
#[test]
fn energy_and_momentum_of_a_free_motion_are_kept() {
    for case in CASES {
        let model = in_motion(case, &scene(case, false, 0.0));
        let h = 0.2 / dbd_kernel::frequency::bound(&model, &State::initial(&model));
        let steps = (5.0 / h) as u64;
        let mut plant = Plant::new(&model, Leapfrog, h).unwrap();
        let start = energy(&model, plant.state(), h).total();
        let mut errors = Vec::new();
        let before = momentum(&model, plant.state());
        for _ in 0..steps {
            plant.step().unwrap();
            errors.push(energy(&model, plant.state(), h).total() / start - 1.0);
        }
        let band = errors.iter().fold(0.0_f64, |m, error| m.max(error.abs()));
        let mean = |errors: &[f64]| errors.iter().sum::<f64>() / errors.len() as f64;
        let quarter = errors.len() / 4;
        let drift = mean(&errors[3 * quarter..]) - mean(&errors[..quarter]);
        let after = momentum(&model, plant.state());
        let lost =
            before.iter().zip(after).map(|(b, a)| (*b - a).dot(*b - a).sqrt()).fold(0.0, f64::max);
        assert!(band < 3e-8 && drift.abs() < 3e-9, "{}: {band:e} {drift:e}", case.name);
        assert!(lost < 1e-12, "{}: {lost:e}", case.name);
    }
}

/// Linear momentum and angular momentum about the origin.
fn momentum(model: &SceneModel<F64>, state: &State<SceneModel<F64>>) -> [Vec3<f64>; 2] {
    let mut sum = [Vec3::ZERO; 2];
    for (body, state) in model.bodies.iter().zip(&state.bodies) {
        let (linear, angular) = momenta(&[(body.mass, body.inertia.to_f64())], &[*state]);
        sum = [sum[0] + linear, sum[1] + angular];
    }
    sum
}

/// A joint's TSDAs damp as they spring: C = c/k·K. A point on a line damps in every direction
/// across it, so a cylindrical joint brakes the turn and a translational one more than it
/// springs; neither brakes the slide.
#[test]
fn damping_is_what_the_documentation_says() {
    for case in CASES.iter().filter(|case| case.name != "universal") {
        let scene = scene(case, true, C);
        let state = State::initial(&scene.model);
        let measured = matrix(case.length, C, |freedom| {
            let axis = axes()[freedom % 3];
            let at = |rate: f64| {
                let mut state = state.clone();
                let body = &mut state.bodies[1];
                if freedom < 3 {
                    body.velocity = axis * rate;
                } else {
                    body.velocity = (axis * rate).cross(body.position - Vec3::from_f64(AT));
                    body.angular_velocity = body.orientation.rotation().to_body(axis * rate);
                }
                load(&scene.model, &state, 1)
            };
            ([at(1.0), at(-1.0)], 2.0)
        });
        // Offset 0.2 s, gauge 0.6 s.
        let documented = match case.name {
            "cylindrical" => damped_lines(4.0, [1.0, 1.0, 0.16], [0.4; 2]),
            "translational" => damped_lines(8.0, [2.0, 2.0, 1.04], [0.8; 2]),
            "translational, outward" => damped_lines(8.0, [2.0, 2.0, 1.52], [0.8, 0.0]),
            _ => (case.stiffness)(),
        };
        let difference = largest_difference(&measured, &documented);
        assert!(difference < 1e-9, "{}: {measured:.6?}", case.name);
    }
}

/// Where points stand off their lines to the same side, a turn moves their middle.
fn damped_lines(across: f64, turn: [f64; 3], coupling: [f64; 2]) -> Matrix {
    let mut matrix = diagonal([across, across, 0.0], turn);
    for (force, coupling) in [(0, -coupling[0]), (1, coupling[1])] {
        matrix[force][5] = coupling;
        matrix[5][force] = coupling;
    }
    matrix
}
