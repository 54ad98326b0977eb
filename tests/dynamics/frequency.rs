//! The frequency bound and the estimate against all eigenfrequencies of the reference's forces.

use std::sync::OnceLock;

use dbd_kernel::builder::{LineLaw, Triples};
use dbd_kernel::elements::input::InputKind;
use dbd_kernel::{
    BodyIndex, BodyState, F64, GroupIndex, Leapfrog, ModelOwner, Plant, Quaternion, State, Vec3,
    frequency,
};
use dbd_plant::frequencies::Frequencies;
use dbd_study::reference::instant::End;
use dbd_study::reference::signals::Clock;
use dbd_study::reference::{self as reference, Mechanism, eigenfrequencies};
use dbd_tests::page::{block, table};
use dbd_tests::{Bench, hung_ring, scene, scene_names};
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

/// The least and the greatest of what was seen.
#[derive(Clone, Copy, Debug)]
struct Range([f64; 2]);

impl Range {
    const EMPTY: Self = Self([f64::INFINITY, f64::NEG_INFINITY]);

    fn see(&mut self, value: f64) {
        self.0 = [self.0[0].min(value), self.0[1].max(value)];
    }

    fn show(self, decimals: usize) -> String {
        let [least, most] = self.0.map(|value| format!("{value:.decimals$}"));
        if least == most { least } else { format!("{least} to {most}") }
    }
}

/// Ranges of a bound and an estimate over the true value.
type Ranges = (Range, Option<Range>);

/// Each row of the table, computed once however many ask.
macro_rules! rows {
    ($($test:ident: $title:expr, $shown:path;)*) => {
        const ROWS: &[(&str, fn() -> &'static Ranges)] = &[$(($title, $test::shown)),*];

        $(mod $test {
            use super::*;

            pub fn shown() -> &'static Ranges {
                static SHOWN: OnceLock<Ranges> = OnceLock::new();
                SHOWN.get_or_init($shown)
            }

            #[test]
            fn test() {
                shown();
            }
        })*
    };
}

rows! {
    the_bound_is_tight_and_the_estimate_close_on_every_scene_at_rest: "25 scenes at t = 0", at_rest;
    the_estimate_holds_for_wound_springs:
        "a body on a torsion spring wound by 0 to 100 rad", wound;
    the_bound_holds_along_the_run_of_every_scene: "25 scenes along their runs", along_runs;
    the_estimate_is_close_and_below_at_loaded_poses: "100 loaded poses of every element", loaded;
    the_bound_holds_at_loaded_poses_of_every_kind_of_element:
        "300 of them, stretched up to several times their lengths", stretched;
    the_bound_holds_for_preloaded_elements_of_any_size: "4,000 preloaded pairs of any size", preloaded;
}

#[test]
fn written_in_the_page() {
    let row = |(title, shown): &(&str, fn() -> &'static Ranges)| {
        let (bound, estimate) = shown();
        let estimate = estimate.map(|estimate| estimate.show(4)).unwrap_or_default();
        vec![(*title).to_owned(), bound.show(3), estimate]
    };
    let rows: Vec<_> = ROWS.iter().map(row).collect();
    assert_eq!(scene_names().len(), 25);
    let head = ["", "bound ÷ true", "estimate ÷ true"];
    block("docs/reference-solvers.md", "frequencies", &table(&head, &rows));
}

/// Scenes at t = 0 lie unloaded but for the tension of a weight or a preload that is let go.
fn at_rest() -> Ranges {
    let (mut bounds, mut estimates) = (Range::EMPTY, Range::EMPTY);
    for name in scene_names() {
        let scene = scene(&name);
        let [highest, ratio] = bound(&scene.model, &State::initial(&scene.model), 0.0);
        let frequencies = Frequencies::of(&scene);
        let estimate = frequencies.estimate / highest;
        bounds.see(ratio);
        estimates.see(estimate);
        assert!((1.0 - ROUNDING..=1.45).contains(&ratio), "{name}: bound {ratio}");
        assert!((0.99..=1.0 + ROUNDING).contains(&estimate), "{name}: estimate {estimate}");
    }
    (bounds, Some(estimates))
}

fn along_runs() -> Ranges {
    let mut bounds = Range::EMPTY;
    for name in scene_names() {
        let scene = scene(&name);
        let h = scene.step.unwrap();
        let mut plant = Plant::new(&scene.model, Leapfrog, h).unwrap();
        let steps = (scene.duration / h).round() as u64;
        for part in 1..=8 {
            plant.advance(steps * part / 8 - plant.state().step).unwrap();
            let [_, ratio] = bound(&scene.model, plant.state(), plant.time());
            assert!((1.0 - ROUNDING..1.6).contains(&ratio), "{name}: {ratio}");
            bounds.see(ratio);
        }
    }
    (bounds, None)
}

/// A wound spring's torque makes the stiffness unsymmetric, more so than the spring is stiff: the
/// estimate knows of the symmetric part alone.
fn wound() -> Ranges {
    let (mut bounds, mut estimates) = (Range::EMPTY, Range::EMPTY);
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
            bounds.see(ratio);
            estimates.see(estimate);
            assert!(highest > 250.0 && ratio >= 1.0 - ROUNDING, "{winding}: {highest} {ratio}");
            assert!((0.99..=1.0 + ROUNDING).contains(&estimate), "{winding}: {estimate}");
        }
    }
    (bounds, Some(estimates))
}

/// The same at poses where every kind of element pulls, and one is driven by an actuator.
fn loaded() -> Ranges {
    let mut scatter = Scatter(11);
    let (mut bounds, mut estimates) = (Range::EMPTY, Range::EMPTY);
    for i in 0..100 {
        let model = strained(if i % 2 == 0 { 0.0 } else { 2e3 * scatter.next() });
        let mut state = State::initial(&model);
        scatter.scatter(&mut state.bodies, [0.01, 0.1, 0.3, 0.6][i % 4]);
        let [highest, over] = bound(&model, &state, 0.0);
        bounds.see(over);
        let ratio = frequency::estimate(&model, &state, 200) / highest;
        assert!((0.95..=1.0 + ROUNDING).contains(&ratio), "pose {i}: {ratio}");
        estimates.see(ratio);
    }
    (bounds, Some(estimates))
}

/// [`hung_ring`] with looseness, lines that are off their points, and an actuator that pulls.
fn strained(pull: f64) -> Bench<F64> {
    let mut model = hung_ring::<F64>(0.0);
    let [a, b, c] = [0, 1, 2].map(BodyIndex);
    let law = LineLaw { stiffness: 900.0, damping: 0.0, free_length: 0.1, clearance: 0.02 };
    let points = [[0.2, 0.1, 0.0], [0.1, -0.3, 0.2]];
    model.add_points_on_line([b, a], [0.1, 0.0, 0.3], [0.3, 0.4, 1.2], &points, law).unwrap();
    let triples = Triples {
        between: [c, a],
        centres: &[[0.0; 3]],
        arms: &[[0.9, 0.0, 0.0], [0.0, 0.7, 0.0], [0.0, 0.0, 2.0]],
        stiffness: 700.0,
        damping: 0.0,
        free_length: 1.5,
        clearance: 0.1,
    };
    model.add_triples(triples).unwrap();
    model.add_torsion_spring([b, c], [0.0, 0.6, 0.8], 300.0, 0.0, 90.0).unwrap();
    model.add_input(InputKind::Actuator { group: GroupIndex(2), element: 0 }, pull).unwrap();
    model
}

/// Numbers in [−1, 1) that look random and never change.
struct Scatter(u64);

impl Scatter {
    fn next(&mut self) -> f64 {
        self.0 = self.0.wrapping_mul(6_364_136_223_846_793_005).wrapping_add(1_442_695_040_888_963);
        (self.0 >> 11) as f64 / (1_u64 << 52) as f64 - 1.0
    }

    /// 10 to a power of the range.
    fn power(&mut self, [least, most]: [i32; 2]) -> f64 {
        let middle = 0.5 * f64::from(least + most);
        10_f64.powf(middle + 0.5 * f64::from(most - least) * self.next())
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
fn stretched() -> Ranges {
    let mut scatter = Scatter(7);
    let mut bounds = Range::EMPTY;
    for i in 0..300 {
        let model = strained(if i % 2 == 0 { 0.0 } else { 2e3 * scatter.next() });
        let mut state = State::initial(&model);
        scatter.scatter(&mut state.bodies, [0.01, 0.1, 0.3, 0.6][i % 4]);
        // Where a twist is undefined neither has anything to say.
        let [highest, ratio] = bound(&model, &state, 0.0);
        assert!(ratio >= 1.0 - ROUNDING, "pose {i}: {highest} rad/s, bound {ratio}");
        assert!(ratio < 3.0, "pose {i}: {ratio}");
        bounds.see(ratio);
    }
    (bounds, None)
}

/// Bodies of any shape on a few preloaded elements of any stiffness, length and arm: alone, so that
/// nothing else hides what a tension adds.
fn preloaded() -> Ranges {
    let mut scatter = Scatter(2297);
    let mut bounds = Range::EMPTY;
    for i in 0..4_000 {
        let mut model = Bench::<F64>::new();
        let mut between = [BodyIndex::WORLD; 2];
        for end in &mut between[usize::from(i % 3 != 0)..] {
            let state = BodyState::from_f64([0.0; 3], [1.0, 0.0, 0.0, 0.0], [0.0; 3], [0.0; 3]);
            let (n, i) = (i, scatter.power([-4, 2]));
            let inertia = if n % 4 == 0 { [i, i, i * 1e-3] } else { [i, i * 1.5, i * 0.8] };
            *end = model.add_body(scatter.power([-2, 2]), inertia, state).unwrap();
        }
        for _ in 0..1 + i % 4 {
            let size = scatter.power([-2, 2]);
            let points = [scatter.vector(size), scatter.vector(size)].map(Vec3::to_f64);
            let stiffness = if i % 7 == 0 { 0.0 } else { scatter.power([0, 6]) };
            let free_length = if i % 5 == 0 { 0.0 } else { scatter.power([-2, 2]) };
            match i % 2 {
                0 => {
                    let axis = scatter.vector(1.0).to_f64();
                    let preload = scatter.power([0, 5]);
                    model.add_torsion_spring(between, axis, stiffness, 0.0, preload).unwrap();
                }
                _ => {
                    let law = (stiffness.max(1.0), free_length);
                    model.add_tsda(between, points, law.0, 0.0, law.1).unwrap();
                }
            }
        }
        let mut state = State::initial(&model);
        scatter.scatter(&mut state.bodies, 0.5);
        let [highest, ratio] = bound(&model, &state, 0.0);
        // A pose that compressed elements push out of has no frequency.
        if highest > 0.0 {
            assert!(ratio >= 1.0 - ROUNDING, "{i}: {highest} rad/s, bound {ratio}");
            bounds.see(ratio);
        }
    }
    (bounds, None)
}

/// A mass on a spring under a tension T swings across it at √(T/(m·L)), the bound's own term.
#[test]
fn a_tension_alone_swings_across_its_line() {
    let mut model = Bench::<F64>::new();
    let at = |x| BodyState::from_f64([x, 0.0, 0.0], [1.0, 0.0, 0.0, 0.0], [0.0; 3], [0.0; 3]);
    let body = model.add_body(2.0, [0.1; 3], at(0.8)).unwrap();
    let world = BodyIndex::WORLD;
    model.add_tsda([world, body], [[0.0; 3]; 2], 1e-9, 0.0, 0.8).unwrap();
    model.add_input(InputKind::Actuator { group: GroupIndex(0), element: 0 }, 50.0).unwrap();
    let [highest, ratio] = bound(&model, &State::initial(&model), 0.0);
    assert!((highest - (50.0_f64 / (2.0 * 0.8)).sqrt()).abs() < 1e-6, "{highest}");
    assert!((1.0..1.01).contains(&ratio), "{ratio}");
}

/// A rod between two prestressed springs along it: their pull does nothing about the rod's axis.
#[test]
fn the_bound_is_tight_for_prestressed_rods() {
    let mut model = Bench::<F64>::new();
    let state = BodyState::from_f64([0.0; 3], [1.0, 0.0, 0.0, 0.0], [0.0; 3], [0.0; 3]);
    let rod = model.add_body(1.0, [1e-5, 1.0 / 12.0, 1.0 / 12.0], state).unwrap();
    for side in [-1.0, 1.0] {
        let points = [[side, 0.0, 0.0], [0.5 * side, 0.0, 0.0]];
        model.add_tsda([BodyIndex::WORLD, rod], points, 1e3, 0.0, 0.3).unwrap();
    }
    let [_, ratio] = bound(&model, &State::initial(&model), 0.0);
    assert!((1.0 - ROUNDING..1.2).contains(&ratio), "{ratio}");
}

/// Points 1e5 m from a centre of mass: differences are of small moves of the points, too.
#[test]
fn the_estimate_stays_below_the_bound_at_long_levers() {
    let mut scatter = Scatter(11);
    for i in 0..100 {
        let mut model = Bench::<F64>::new();
        let state = BodyState::from_f64([0.0; 3], [1.0, 0.0, 0.0, 0.0], [0.0; 3], [0.0; 3]);
        let body = model.add_body(1.0, [scatter.power([4, 8]); 3], state).unwrap();
        for _ in 0..4 {
            let (arm, way) = (scatter.vector(1e5), scatter.vector(1.0));
            let points = [arm + way, arm].map(Vec3::to_f64);
            let length = way.dot(way).sqrt();
            model.add_tsda([BodyIndex::WORLD, body], points, 1e4, 0.0, length).unwrap();
        }
        let state = State::initial(&model);
        let (estimate, bound) =
            (frequency::estimate(&model, &state, 200), frequency::bound(&model, &state));
        assert!(0.5 * bound < estimate && estimate <= bound, "{i}: {estimate} of {bound} rad/s");
    }
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
            model
                .add_input(InputKind::Actuator { group: GroupIndex(0), element: 0 }, 80.0)
                .unwrap();
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
