//! The truth against closed forms, its two opinions against each other, runs against it.

use std::f64::consts::TAU;

use dbd_kernel::elements::input::InputKind;
use dbd_kernel::{BodyIndex, BodyState, F64, Load, LoadFrame, Vec3};
use dbd_plant::{Method, PrecisionName, SchemeName};
use dbd_scene::Scene;
use dbd_study::reference::metric::distance;
use dbd_study::reference::perturbed::{PERTURBATION, perturbed};
use dbd_study::reference::trajectory::{Positions, sample_times};
use dbd_study::reference::window::{GROWTH, before_chaos};
use dbd_study::reference::{Mechanism, Trajectory};
use dbd_tests::page::{block, figure, table};
use dbd_tests::{Bench, at, scene, scene_names, turned};
use nalgebra::{UnitQuaternion, Vector3};

const WORLD: BodyIndex = BodyIndex::WORLD;

fn reference_solution(model: &Bench<F64>, window: f64, samples: u32) -> Trajectory {
    let (mechanism, start) = Mechanism::of_model(model);
    Trajectory::reference_solution_of(&mechanism, &start, sample_times(window, samples)).unwrap()
}

/// The largest difference of a quantity from its closed form over all samples.
fn worst(
    reference_solution: &Trajectory,
    difference: impl Fn(f64, &dbd_study::reference::State) -> f64,
) -> f64 {
    let pairs = reference_solution.times.iter().zip(&reference_solution.states);
    pairs.map(|(t, state)| difference(*t, state).abs()).fold(0.0, f64::max)
}

#[test]
fn a_mass_on_a_spring_with_and_without_damping() {
    for zeta in [0.0, 0.3] {
        let mut model = Bench::new();
        let body = model.add_body(2.0, [0.1; 3], at([1.1, 0.0, 0.0])).unwrap();
        model.add_tsda([WORLD, body], [[0.0; 3]; 2], 50.0, 20.0 * zeta, 1.0).unwrap();
        let reference_solution = reference_solution(&model, 10.0, 40);
        let damped = 5.0 * (1.0_f64 - zeta * zeta).sqrt();
        let error = worst(&reference_solution, |t, state| {
            let (s, c) = (damped * t).sin_cos();
            let x = 0.1 * (-5.0 * zeta * t).exp() * (c + 5.0 * zeta / damped * s);
            state.bodies[0].position.x - 1.0 - x
        });
        assert!(
            error < 1e-11 && reference_solution.largest_uncertainty() < 1e-11,
            "{zeta}: {error:e}"
        );
    }
}

/// A symmetric top in free flight turns about its angular momentum L at |L|/I1 while it spins in
/// itself at ω3·(1 − I3/I1): q = exp(L·t/I1)∘q0∘exp((1 − I3/I1)·ω3·t·z).
#[test]
fn a_free_symmetric_top() {
    let (i1, i3) = (0.4, 0.7);
    let rate = [1.5, -2.0, 5.0];
    let start = turned([0.6, 0.0, 0.8], 0.9);
    let mut model = Bench::new();
    let state = BodyState::<F64>::from_f64([0.0; 3], start, [0.3, 0.0, -0.2], rate);
    model.add_body(1.3, [i1, i1, i3], state).unwrap();
    let reference_solution = reference_solution(&model, 10.0, 20);
    let (_, first) = Mechanism::of_model(&model);
    let first = first.bodies[0].orientation;
    let spin = Vector3::new(i1 * rate[0], i1 * rate[1], i3 * rate[2]);
    let momentum = first * spin;
    let error = worst(&reference_solution, |t, state| {
        let about_momentum = UnitQuaternion::from_scaled_axis(momentum * (t / i1));
        let in_itself = Vector3::z() * ((1.0 - i3 / i1) * rate[2] * t);
        let exact = about_momentum * first * UnitQuaternion::from_scaled_axis(in_itself);
        let moved = (state.bodies[0].position - Vector3::new(0.3, 0.0, -0.2) * t).norm();
        // A quaternion and its negative are one orientation.
        let (q, exact) = (state.bodies[0].orientation.coords, exact.coords);
        moved.max((q - exact).norm().min((q + exact).norm()))
    });
    assert!(error < 1e-10, "{error:e}");
    let kept = worst(&reference_solution, |_, state| {
        let body = &state.bodies[0];
        (body.orientation * Vector3::new(i1, i1, i3).component_mul(&body.rate) - momentum).norm()
    });
    assert!(kept < 1e-11, "{kept:e}");
}

#[test]
fn turns_of_a_torsion_spring_are_counted() {
    // It swings about preload/k = 8 rad, up to 16: more than two turns away and back.
    let (inertia, stiffness) = (0.25, 4.0);
    let mut model = Bench::new();
    let body = model.add_body(1.0, [0.1, 0.2, inertia], at([0.0; 3])).unwrap();
    model.add_torsion_spring([WORLD, body], [0.0, 0.0, 1.0], stiffness, 0.0, 32.0).unwrap();
    let omega = (stiffness / inertia).sqrt();
    // Samples wide apart: more than a turn from one to the next.
    let reference_solution = reference_solution(&model, 2.5 * TAU / omega, 5);
    let error = worst(&reference_solution, |t, state| {
        state.torsion_angles[0] - 8.0 * (1.0 - (omega * t).cos())
    });
    assert!(error < 1e-10, "{error:e}");
    assert!(reference_solution.states.iter().any(|state| state.torsion_angles[0] > 2.0 * TAU));
}

#[test]
fn loads_and_tables_jump_between_samples() {
    let mut model = Bench::new();
    let body = model.add_body(2.0, [0.1; 3], at([0.0; 3])).unwrap();
    let load = Load {
        body,
        frame: LoadFrame::World,
        force: Vec3::new(6.0, 0.0, 0.0),
        torque: Vec3::ZERO,
        from: 0.113,
        until: 0.517,
    };
    model.add_load(load).unwrap();
    let direction = Vec3::new(0.0, 1.0, 0.0);
    let kind = InputKind::Force { body, point: Vec3::ZERO, direction, frame: LoadFrame::World };
    // A ramp from 0 N at 0.2 s to 4 N at 0.6 s, then held at 4 N.
    model.add_table(kind, &[[0.0, 0.0], [0.2, 0.0], [0.6, 4.0]], true).unwrap();
    let reference_solution = reference_solution(&model, 1.0, 7);
    let since = |t: f64, from: f64| (t - from).max(0.0);
    let error = worst(&reference_solution, |t, state| {
        let x = 1.5 * (since(t, 0.113).powi(2) - since(t, 0.517).powi(2));
        let y = 5.0 / 6.0 * (since(t, 0.2).powi(3) - since(t, 0.6).powi(3));
        (state.bodies[0].position - Vector3::new(x, y, 0.0)).norm()
    });
    assert!(error < 1e-13 && reference_solution.largest_uncertainty() < 1e-13, "{error:e}");
}

/// Scenes of one mechanism; those of several consist of them.
fn single(name: &str) -> bool {
    !name.starts_with("two") && !name.starts_with("three")
}

#[test]
fn the_two_opinions_agree_on_every_scene() {
    for name in scene_names().into_iter().filter(|name| single(name)) {
        let reference_solution = Trajectory::reference_solution(&scene(&name), 0.05, 10).unwrap();
        let uncertainty = reference_solution.largest_uncertainty();
        assert!(uncertainty < 2e-11, "{name}: {uncertainty:e}");
        assert!(uncertainty > 0.0, "{name}: two integrators and not one bit between them");
    }
}

fn error_of(scene: &Scene, reference_solution: &Trajectory, scheme: SchemeName, steps: u64) -> f64 {
    let method = Method::new(scheme, None, PrecisionName::F64).unwrap();
    reference_solution.error(&reference_solution.run(scene, &method, steps))
}

#[test]
fn schemes_converge_to_the_truth_with_their_order() {
    // With points on lines; with torsion springs.
    for (name, steps) in [("crank-slider", 1_000), ("four-bar", 500)] {
        let scene = scene(name);
        let reference_solution = Trajectory::reference_solution(&scene, 0.1, 20).unwrap();
        let ratio = |scheme| {
            let [coarse, fine] = [steps, 2 * steps]
                .map(|steps| error_of(&scene, &reference_solution, scheme, steps));
            assert!(fine > 100.0 * reference_solution.largest_uncertainty(), "{fine:e}");
            coarse / fine
        };
        let (leapfrog, dbd) = (ratio(SchemeName::Leapfrog), ratio(SchemeName::Dbd));
        assert!((leapfrog - 4.0).abs() < 0.1 && (dbd - 2.0).abs() < 0.1, "{leapfrog} {dbd}");
    }
}

#[test]
fn an_error_is_a_mean_over_bodies_and_samples_and_infinite_where_a_run_ends_early() {
    let positions = |shift: f64| vec![Vector3::zeros(), Vector3::x() * shift];
    assert!((distance(&positions(0.0), &positions(3.0)) - 3.0 / 2.0_f64.sqrt()).abs() < 1e-15);
    let reference_solution = Trajectory::reference_solution(&scene("spring-ball"), 1.0, 2).unwrap();
    let shifted = |shifts: &[f64]| -> Vec<Positions> {
        let rows = reference_solution.states.iter().zip(shifts);
        rows.map(|(state, shift)| vec![state.positions()[0] + Vector3::x() * *shift]).collect()
    };
    assert!(
        (reference_solution.error(&shifted(&[0.0, 1.0, 1.0])) - (2.0_f64 / 3.0).sqrt()).abs()
            < 1e-12
    );
    assert_eq!(reference_solution.error(&shifted(&[0.0, 1.0])), f64::INFINITY);
    assert_eq!(reference_solution.error(&shifted(&[0.0, 1.0, f64::NAN])), f64::INFINITY);
}

#[test]
fn the_window_ends_where_a_perturbation_has_grown() {
    // Let go against stiff joints it turns over and is chaotic from there on.
    let scene = scene("3rrr-2");
    let window = before_chaos(&scene, 0.5, 50, GROWTH).unwrap();
    let end = window.times.iter().position(|time| *time == window.end).unwrap();
    assert!(0.1 < window.end && window.end < 0.4, "{}", window.end);
    assert!(window.growth[..=end].iter().all(|growth| *growth <= GROWTH));
    assert!(window.growth[end + 1] > GROWTH && (window.growth[0] - 1.0).abs() < 1e-12);
    // A larger factor ends it later, and what grows is the mechanism's, not the integrator's.
    assert!(before_chaos(&scene, 0.5, 50, 100.0 * GROWTH).unwrap().end > window.end);
    // A regular motion has no end.
    let regular = before_chaos(&dbd_tests::scene("hexagon"), 0.5, 50, GROWTH).unwrap();
    assert!(regular.end == 0.5 && regular.growth.iter().all(|growth| *growth < 10.0));
}

#[test]
fn the_papers_mechanisms_are_worth_comparing_for_half_a_second() {
    let mut rows = Vec::new();
    for name in [
        "four-bar",
        "five-bar-a",
        "five-bar-b",
        "six-bar",
        "hexagon",
        "3rrr",
        "3rrr-1",
        "3rrr-2",
        "crank-slider",
        "3ruu",
    ] {
        let window = before_chaos(&scene(name), 0.5, 50, f64::INFINITY).unwrap();
        let most = window.growth.iter().fold(0.0_f64, |most, growth| most.max(*growth));
        let passed = window.growth.iter().position(|growth| *growth > GROWTH);
        let passed = passed.map(|row| window.times[row]);
        let passed_at = passed.map(|time| format!("{time:.2}")).unwrap_or_default();
        rows.push(vec![name.to_owned(), figure(most, 2), passed_at]);
        assert_eq!(passed.is_some(), name == "3rrr-2", "{name}: {most:e}");
    }
    let head = ["growth over 0.5 s", "at most", "beyond 1e3 at [s]"];
    block("docs/reference-solvers.md", "growth", &table(&head, &rows));
    for (name, bound) in [("five-bar-a", 1e-11), ("3rrr-2", 1e-6)] {
        let uncertainty =
            Trajectory::reference_solution(&scene(name), 0.5, 10).unwrap().largest_uncertainty();
        assert!(uncertainty < bound, "{name}: {uncertainty:e}");
    }
}

#[test]
fn a_perturbation_moves_every_body_by_the_same_amount() {
    let (_, state) = Mechanism::of(&scene("hexagon"));
    let moved = perturbed(&state);
    for (a, b) in state.bodies.iter().zip(&moved.bodies) {
        // To the rounding of coordinates of a metre.
        assert!(((a.position - b.position).norm() / PERTURBATION - 1.0).abs() < 1e-6);
        assert_ne!(a.orientation, b.orientation);
    }
}
