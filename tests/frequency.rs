//! The frequency bound and the estimate against all eigenfrequencies of the reference's forces.
//!
//! `DBD_PRINT=1 cargo test --release -p dbd-tests --test frequency -- --nocapture` prints the table.

use dbd_kernel::builder::{LineLaw, Stars};
use dbd_kernel::inputs::InputKind;
use dbd_kernel::{
    BodyIndex, BodyState, F64, Leapfrog, ModelOwner, Plant, Quaternion, State, Vec3, frequency,
};
use dbd_tests::{Bench, hung_ring, scene, scene_names};
use host_sim::frequencies::Frequencies;
use host_sim::reference::elements::End;
use host_sim::reference::signals::Clock;
use host_sim::reference::{self, Mechanism, eigenfrequencies};
use nalgebra::{Matrix6, Vector6};

/// The highest eigenfrequency \[rad/s\], and the bound over it.
fn bound<M: ModelOwner<Precision = F64>>(model: &M, state: &State<M>, time: f64) -> [f64; 2] {
    let (mechanism, _) = Mechanism::of_model(model);
    let all = eigenfrequencies(&mechanism, &reference::State::of(state), time);
    let highest = all[all.len() - 1];
    [highest, frequency::bound(model, state) / highest]
}

/// The reference's differences are good to this, relative.
const ROUNDING: f64 = 1e-7;

/// Scenes at t = 0 lie unloaded but for the tension of a weight or a preload that is let go.
#[test]
fn the_bound_is_tight_and_the_estimate_close_on_every_scene_at_rest() {
    for name in scene_names() {
        let scene = scene(&name);
        let [highest, ratio] = bound(&scene.model, &State::initial(&scene.model), 0.0);
        let frequencies = Frequencies::of(&scene);
        let estimate = frequencies.estimate / highest;
        if std::env::var_os("DBD_PRINT").is_some() {
            println!("{name:14} {highest:8.1} rad/s  bound {ratio:.3}  estimate {estimate:.4}");
        }
        assert!((1.0 - ROUNDING..=1.45).contains(&ratio), "{name}: bound {ratio}");
        assert!((0.99..=1.0 + ROUNDING).contains(&estimate), "{name}: estimate {estimate}");
    }
}

#[test]
fn the_bound_holds_along_the_run_of_every_scene() {
    for name in scene_names() {
        let scene = scene(&name);
        let h = scene.step.unwrap();
        let mut plant = Plant::new(&scene.model, Leapfrog, h).unwrap();
        let steps = (scene.duration / h).round() as u64;
        let (mut loosest, mut tightest, mut rise) = (0.0_f64, f64::INFINITY, 0.0_f64);
        let [first, _] = bound(&scene.model, plant.state(), 0.0);
        for part in 1..=8 {
            plant.advance(steps * part / 8 - plant.state().step).ok().unwrap();
            let [highest, ratio] = bound(&scene.model, plant.state(), plant.time());
            (loosest, tightest) = (loosest.max(ratio), tightest.min(ratio));
            rise = rise.max(highest / first);
        }
        if std::env::var_os("DBD_PRINT").is_some() {
            println!("{name:14} bound {tightest:.3} to {loosest:.3}, frequency up to {rise:.3}");
        }
        assert!(tightest >= 1.0 - ROUNDING && loosest < 1.6, "{name}: {tightest} {loosest}");
    }
}

/// A wound spring's torque makes the stiffness unsymmetric, more so than the spring is stiff: the
/// estimate knows of the symmetric part alone.
#[test]
fn the_estimate_holds_for_wound_springs() {
    for winding in [0.0, 1.0, 4.0, 10.0, 100.0] {
        for inertia in [[0.01; 3], [0.01, 0.02, 0.015]] {
            let mut model = Bench::<F64>::new();
            let state = BodyState::from_f64([0.0; 3], [1.0, 0.0, 0.0, 0.0], [0.0; 3], [0.0; 3]);
            let body = model.add_body(1.0, inertia, state).unwrap();
            let (z, k) = ([0.0, 0.0, 1.0], 1e3);
            model.add_torsion_spring([BodyIndex::WORLD, body], z, k, 0.0, winding * k).unwrap();
            let start = State::initial(&model);
            let [highest, ratio] = bound(&model, &start, 0.0);
            let estimate = frequency::estimate(&model, &start, 200) / highest;
            if std::env::var_os("DBD_PRINT").is_some() {
                println!("wound by {winding} rad: {highest:.1} rad/s, estimate {estimate:.6}");
            }
            assert!(highest > 250.0 && ratio >= 1.0 - ROUNDING, "{winding}: {highest} {ratio}");
            assert!((0.99..=1.0 + ROUNDING).contains(&estimate), "{winding}: {estimate}");
        }
    }
}

/// The same at poses where every kind of element pulls, and one is driven by an actuator.
#[test]
fn the_estimate_is_close_and_below_at_loaded_poses() {
    let mut scatter = Scatter(11);
    let (mut least, mut most) = (f64::INFINITY, 0.0_f64);
    for i in 0..100 {
        let model = strained(if i % 2 == 0 { 0.0 } else { 2e3 * scatter.next() });
        let mut state = State::initial(&model);
        scatter.scatter(&mut state.bodies, [0.01, 0.1, 0.3, 0.6][i % 4]);
        let [highest, _] = bound(&model, &state, 0.0);
        let ratio = frequency::estimate(&model, &state, 200) / highest;
        assert!((0.95..=1.0 + ROUNDING).contains(&ratio), "pose {i}: {ratio}");
        (least, most) = (least.min(ratio), most.max(ratio));
    }
    if std::env::var_os("DBD_PRINT").is_some() {
        println!("loaded poses: estimate {least:.4} to {most:.7}");
    }
}

/// [`hung_ring`] with looseness, lines that are off their points, and an actuator that pulls.
fn strained(pull: f64) -> Bench<F64> {
    let mut model = hung_ring::<F64>(0.0);
    let [a, b, c] = [0, 1, 2].map(BodyIndex);
    let law = LineLaw { stiffness: 900.0, damping: 0.0, free_length: 0.1, clearance: 0.02 };
    let points = [[0.2, 0.1, 0.0], [0.1, -0.3, 0.2]];
    model.add_points_on_line([b, a], [0.1, 0.0, 0.3], [0.3, 0.4, 1.2], &points, law).unwrap();
    let stars = Stars {
        between: [c, a],
        centres: &[[0.0; 3]],
        arms: &[[0.9, 0.0, 0.0], [0.0, 0.7, 0.0], [0.0, 0.0, 2.0]],
        stiffness: 700.0,
        damping: 0.0,
        free_length: 1.5,
        clearance: 0.1,
    };
    model.add_stars(stars).unwrap();
    model.add_torsion_spring([b, c], [0.0, 0.6, 0.8], 300.0, 0.0, 90.0).unwrap();
    model.add_input(InputKind::Actuator { group: 2, element: 0 }, pull).unwrap();
    model
}

/// Numbers in [−1, 1) that look random and never change.
struct Scatter(u64);

impl Scatter {
    fn next(&mut self) -> f64 {
        self.0 = self.0.wrapping_mul(6_364_136_223_846_793_005).wrapping_add(1_442_695_040_888_963);
        (self.0 >> 11) as f64 / (1_u64 << 52) as f64 - 1.0
    }

    fn vector(&mut self, size: f64) -> Vec3<f64> {
        Vec3::from_f64([self.next() * size, self.next() * size, self.next() * size])
    }

    /// Moves and turns every body by up to `size` \[m\], \[rad\] or so.
    fn scatter(&mut self, bodies: &mut [BodyState<F64>], size: f64) {
        for body in bodies {
            body.position = body.position + self.vector(size);
            let v = self.vector(0.5 * size);
            let w = (1.0 - v.dot(v)).sqrt();
            body.orientation = body.orientation.product(Quaternion { w, v });
        }
    }
}

/// Tensions of every kind of element, up to lengths of several times the free ones.
#[test]
fn the_bound_holds_at_loaded_poses_of_every_kind_of_element() {
    let mut scatter = Scatter(7);
    let (mut loosest, mut tightest) = (0.0_f64, f64::INFINITY);
    for i in 0..300 {
        let model = strained(if i % 2 == 0 { 0.0 } else { 2e3 * scatter.next() });
        let mut state = State::initial(&model);
        scatter.scatter(&mut state.bodies, [0.01, 0.1, 0.3, 0.6][i % 4]);
        // Where a twist is undefined neither has anything to say.
        let [highest, ratio] = bound(&model, &state, 0.0);
        assert!(ratio >= 1.0 - ROUNDING, "pose {i}: {highest} rad/s, bound {ratio}");
        (loosest, tightest) = (loosest.max(ratio), tightest.min(ratio));
    }
    if std::env::var_os("DBD_PRINT").is_some() {
        println!("loaded poses: bound {tightest:.3} to {loosest:.3}");
    }
    assert!(loosest < 3.0, "{loosest}");
}

/// A mass on a spring under a tension T swings across it at √(T/(m·L)), the bound's own term.
#[test]
fn a_tension_alone_swings_across_its_line() {
    let mut model = Bench::<F64>::new();
    let at = |x| BodyState::from_f64([x, 0.0, 0.0], [1.0, 0.0, 0.0, 0.0], [0.0; 3], [0.0; 3]);
    let body = model.add_body(2.0, [0.1; 3], at(0.8)).unwrap();
    let world = BodyIndex::WORLD;
    model.add_tsda([world, body], [[0.0; 3]; 2], 1e-9, 0.0, 0.8).unwrap();
    model.add_input(InputKind::Actuator { group: 0, element: 0 }, 50.0).unwrap();
    let [highest, ratio] = bound(&model, &State::initial(&model), 0.0);
    assert!((highest - (50.0_f64 / (2.0 * 0.8)).sqrt()).abs() < 1e-6, "{highest}");
    assert!((1.0..1.01).contains(&ratio), "{ratio}");
}

/// A body of the bench at the origin, hard to move and easy to turn, or the reverse.
fn lone(model: &mut Bench<F64>, mass: f64, inertia: f64) -> BodyIndex {
    let state = BodyState::from_f64([0.0; 3], [1.0, 0.0, 0.0, 0.0], [0.0; 3], [0.0; 3]);
    model.add_body(mass, [inertia; 3], state).unwrap()
}

/// One body, so that the bound knows no neighbours and has nothing in hand: what the tension of
/// each kind of element adds to its stiffness must be there, and is more than the stiffness.
#[test]
fn what_a_tension_adds_is_in_the_bound() {
    type Case = (&'static str, fn(&mut Bench<F64>));
    const WORLD: BodyIndex = BodyIndex::WORLD;
    let cases: [Case; 7] = [
        ("TSDA: across its line, beside another's stiffness", |model| {
            let body = lone(model, 1.0, 1e3);
            let mut hang = |from, free_length| {
                model.add_tsda([WORLD, body], [from, [0.0; 3]], 50.0, 0.0, free_length).unwrap()
            };
            hang([1.0, 0.0, 0.0], 1.0);
            hang([0.0, 1.0, 0.0], 0.2);
        }),
        ("TSDA: an arm that is pulled outward", |model| {
            let body = lone(model, 1e4, 0.1);
            let points = [[5.0, 0.0, 0.0], [0.2, 0.0, 0.0]];
            model.add_tsda([WORLD, body], points, 50.0, 0.0, 1.0).unwrap();
        }),
        ("bushing: an arm that is pulled outward", |model| {
            let body = lone(model, 1e4, 0.1);
            let points = [[0.2, 0.0, 0.0], [1.0, 0.0, 0.0]];
            model.add_tsda([body, WORLD], points, 50.0, 0.0, 0.0).unwrap();
        }),
        ("line of the ground: an arm that is pulled outward", |model| {
            let body = lone(model, 1e4, 0.1);
            let law = LineLaw { stiffness: 50.0, damping: 0.0, free_length: 0.1, clearance: 0.0 };
            let (on, z) = ([1.0, 0.0, 0.0], [0.0, 0.0, 1.0]);
            let point = [[0.2, 0.0, 0.3]];
            model.add_points_on_line([WORLD, body], on, z, &point, law).unwrap();
        }),
        ("line of the body: it turns under a point that pulls", |model| {
            let body = lone(model, 1e4, 0.1);
            let law = LineLaw { stiffness: 50.0, damping: 0.0, free_length: 0.0, clearance: 0.0 };
            let (on, z) = ([0.1, 0.0, 0.0], [0.0, 0.0, 1.0]);
            let point = [[1.5, 0.0, 0.2]];
            model.add_points_on_line([body, WORLD], on, z, &point, law).unwrap();
        }),
        ("torsion spring: its gradient turns with a swing", |model| {
            let body = lone(model, 1e4, 0.1);
            let z = [0.0, 0.0, 1.0];
            model.add_torsion_spring([WORLD, body], z, 1.0, 0.0, 200.0).unwrap();
        }),
        ("actuator: an arm that is pulled outward", |model| {
            let body = lone(model, 1e4, 0.1);
            let points = [[5.0, 0.0, 0.0], [0.2, 0.0, 0.0]];
            model.add_tsda([WORLD, body], points, 1e-3, 0.0, 1.0).unwrap();
            model.add_input(InputKind::Actuator { group: 0, element: 0 }, 80.0).unwrap();
        }),
    ];
    for (name, build) in cases {
        let mut model = Bench::new();
        build(&mut model);
        let mut state = State::initial(&model);
        if name.starts_with("torsion") {
            let (s, c) = 0.6_f64.sin_cos();
            state.bodies[0].orientation = Quaternion::new(c, s, 0.0, 0.0);
        }
        let [highest, ratio] = bound(&model, &state, 0.0);
        let stiff = highest_of_springs_alone(&model, &state);
        if std::env::var_os("DBD_PRINT").is_some() {
            println!("{name}: {highest:.2} rad/s, springs alone {stiff:.2}, bound {ratio:.3}");
        }
        assert!(highest > 1.3 * stiff, "{name}: {highest} {stiff}");
        assert!((1.0 - ROUNDING..2.0).contains(&ratio), "{name}: {ratio}");
    }
}

/// What the elements' springs give without their tensions.
fn highest_of_springs_alone<M: ModelOwner<Precision = F64>>(model: &M, state: &State<M>) -> f64 {
    let (mechanism, _) = Mechanism::of_model(model);
    let state = reference::State::of(state);
    let at = mechanism.at(&state, Clock::at(0.0));
    let body = &mechanism.bodies[0];
    let (m, i) = (1.0 / body.mass.sqrt(), body.inertia.map(|i| 1.0 / i.sqrt()));
    let mut matrix = Matrix6::zeros();
    for element in &mechanism.elements {
        element.springs(&at, &mut |spring| {
            let end = spring.ends.iter().position(|end| *end == End::Body(0)).unwrap();
            let u = spring.direction * m;
            let n = at.to_body(0, spring.moments[end]).component_mul(&i);
            let j = Vector6::new(u.x, u.y, u.z, n.x, n.y, n.z);
            matrix += j * j.transpose() * spring.stiffness;
        });
    }
    matrix.symmetric_eigenvalues().max().sqrt()
}
