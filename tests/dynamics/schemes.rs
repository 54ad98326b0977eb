//! What each scheme states of itself: stability limit, dissipation, evaluations, what it
//! conserves, and how inputs reach its stages.

use dbd_kernel::damping::Damping;
use dbd_kernel::elements::input::InputKind;
use dbd_kernel::energy::energy;
use dbd_kernel::{
    BlanesMoanS6, BodyIndex, BodyState, Dbd, DbdP1, DbdP2, Explicit, F32, F64, GeneralizedAlpha,
    GeneralizedAlpha3, Geometry, JointWise, Leapfrog, LoadFrame, ModelOwner, Pefrl, Plant, Rk4,
    Scheme, SemiImplicitEuler, State, Vec3,
};
use dbd_tests::page::{block, table};
use dbd_tests::{Bench, at, free_ring, hung_ring, momenta};

/// Calls a generic function with every scheme.
macro_rules! for_every_scheme {
    ($function:ident $(, $argument:expr)*) => {
        for newton in 0..=8 {
            $function(Dbd { newton } $(, $argument)*);
            $function(DbdP1 { newton } $(, $argument)*);
            $function(DbdP2 { newton } $(, $argument)*);
        }
        $function(SemiImplicitEuler $(, $argument)*);
        $function(Explicit(SemiImplicitEuler) $(, $argument)*);
        $function(JointWise(SemiImplicitEuler) $(, $argument)*);
        $function(Leapfrog $(, $argument)*);
        $function(Explicit(Leapfrog) $(, $argument)*);
        $function(JointWise(Leapfrog) $(, $argument)*);
        $function(Pefrl $(, $argument)*);
        $function(BlanesMoanS6 $(, $argument)*);
        $function(Rk4 $(, $argument)*);
    };
}

/// 1 kg on a spring of 1 N/m without free length, whose frequency is 1 rad/s, with a damper.
fn oscillator(x: f64, v: f64, damping: f64) -> Bench<F64> {
    oscillator_in(x, v, damping)
}

/// The same in any precision.
fn oscillator_in<P: Geometry>(x: f64, v: f64, damping: f64) -> Bench<P> {
    let mut model = Bench::new();
    let state = BodyState::from_f64([x, 0.0, 0.0], [1.0, 0.0, 0.0, 0.0], [v, 0.0, 0.0], [0.0; 3]);
    let body = model.add_body(1.0, [1.0; 3], state).unwrap();
    model.add_tsda([BodyIndex::WORLD, body], [[0.0; 3]; 2], 1.0, damping, 0.0).unwrap();
    model
}

/// The largest magnitude of an eigenvalue of one step of `h` of the [`oscillator`].
fn spectral_radius<S: Scheme>(scheme: S, h: f64, damping: f64) -> f64 {
    let column = |x, v| {
        let model = oscillator(x, v, damping);
        let mut plant = Plant::new(&model, scheme, h).unwrap();
        plant.step().unwrap();
        let body = &plant.state().bodies[0];
        (body.position.x, body.velocity.x)
    };
    let ((a, c), (b, d)) = (column(1.0, 0.0), column(0.0, 1.0));
    let (half, determinant) = ((a + d) / 2.0, a * d - b * c);
    let discriminant = half * half - determinant;
    if discriminant > 0.0 { half.abs() + discriminant.sqrt() } else { determinant.sqrt() }
}

#[test]
fn stable_up_to_the_stated_limit_and_not_beyond() {
    fn check<S: Scheme>(scheme: S) {
        let limit = scheme.stability_limit();
        for i in 1..500 {
            let z = limit * f64::from(i) / 500.0;
            let radius = spectral_radius(scheme, z, 0.0);
            assert!(radius < 1.0 + 1e-9, "{} at {z} of {limit}: {radius}", S::NAME);
        }
        let beyond = spectral_radius(scheme, limit * 1.002, 0.0);
        assert!(beyond > 1.0 + 1e-5, "{} beyond {limit}: {beyond}", S::NAME);
    }
    for_every_scheme!(check);
}

#[test]
fn amplitudes_shrink_as_stated() {
    // ln|λ| over z² for the first-order schemes, over z⁶ for rk4; 0 for the symplectic ones.
    fn check<S: Scheme>(scheme: S, power: i32, stated: f64) {
        let z = 0.02_f64;
        let seen = spectral_radius(scheme, z, 0.0).ln() / z.powi(power);
        assert!((seen - stated).abs() < 1e-3, "{}: {seen}, stated {stated}", S::NAME);
    }
    check(Dbd { newton: 0 }, 2, 0.0);
    check(DbdP1 { newton: 0 }, 2, -0.25);
    check(DbdP2 { newton: 0 }, 2, -0.25);
    for newton in 1..=8 {
        check(Dbd { newton }, 2, -0.5);
        check(DbdP1 { newton }, 2, -0.5);
        check(DbdP2 { newton }, 2, -0.5);
    }
    check(SemiImplicitEuler, 2, 0.0);
    check(Leapfrog, 2, 0.0);
    check(Pefrl, 2, 0.0);
    check(BlanesMoanS6, 2, 0.0);
    let z = 0.2_f64;
    let seen = spectral_radius(Rk4, z, 0.0).ln() / z.powi(6);
    assert!((seen + 1.0 / 144.0).abs() < 1e-4, "rk4: {seen}");
}

#[test]
fn sweeps_bear_any_damper_and_explicit_ones_do_not() {
    fn check<S: Scheme>(scheme: S) {
        for damping in [0.1, 1.0, 10.0, 1e3, 1e6] {
            let z = 0.9 * scheme.stability_limit();
            let radius = spectral_radius(scheme, z, damping);
            let sweeps = S::DAMPING != Damping::Explicit;
            assert!(!sweeps || radius < 1.0, "{} with c = {damping}: {radius}", S::NAME);
            assert!(sweeps || damping < 10.0 || radius > 1.0, "{}: {damping}", S::NAME);
        }
        // Within the limits the header states.
        let light = spectral_radius(scheme, 0.05, 1.0);
        assert!((light - (-0.025_f64).exp()).abs() < 1e-3, "{}: {light}", S::NAME);
    }
    for_every_scheme!(check);
}

/// How fast sweeps with `x = ½·h·c/m` take the energy of an [`oscillator`] away in a precision, as
/// a share of `2·x` per step, which it should be.
fn decay<P: Geometry>(x: f64) -> f64 {
    let h = 0.01;
    let model: Bench<P> = oscillator_in(1.0, 0.0, 2.0 * x / h);
    let mut plant = Plant::new(&model, Leapfrog, h).unwrap();
    // Whole periods of 628.3 steps, over which the share of the kinetic energy is a half.
    let steps = if x < 1e-5 {
        1_884_956
    } else if x < 1e-3 {
        62_832
    } else {
        6_283
    };
    let mut total = |n| {
        plant.advance(n).unwrap();
        let body: BodyState<F64> = plant.state().bodies[0].convert();
        body.position.dot(body.position) + body.velocity.dot(body.velocity)
    };
    let (start, end) = (total(0), total(steps));
    (start / end).ln() / (2.0 * x * steps as f64)
}

#[test]
fn light_dampers_act_in_single_precision_too() {
    for (x, tolerance) in [(1e-7, 0.1), (1e-6, 0.01), (1e-5, 1e-3), (1e-4, 1e-3), (1e-3, 2e-3)] {
        let (double, single) = (decay::<F64>(x), decay::<F32>(x));
        assert!((double - 1.0).abs() < 1e-2, "{x}: {double}");
        assert!((single / double - 1.0).abs() < tolerance, "{x}: {single} {double}");
    }
}

#[test]
fn evaluations_are_counted_as_performed() {
    fn check<S: Scheme>(scheme: S) {
        let model = hung_ring::<F64>(2.0);
        let mut plant = Plant::new(&model, scheme, 1e-4).unwrap();
        plant.step().unwrap();
        let first = plant.evaluations();
        plant.advance(10).unwrap();
        assert_eq!(plant.evaluations() - first, 10 * u64::from(scheme.evaluations()));
        assert!(first <= u64::from(scheme.evaluations()) + 1);
    }
    for_every_scheme!(check);
}

#[test]
fn another_damping_without_a_damper_is_the_scheme_itself() {
    fn hash<S: Scheme>(scheme: S) -> u64 {
        let model = hung_ring::<F64>(0.0);
        let mut plant = Plant::new(&model, scheme, 1e-4).unwrap();
        plant.advance(100).unwrap();
        plant.hash()
    }
    assert_eq!(hash(Leapfrog), hash(Explicit(Leapfrog)));
    assert_eq!(hash(SemiImplicitEuler), hash(Explicit(SemiImplicitEuler)));
    assert_eq!(hash(Leapfrog), hash(JointWise(Leapfrog)));
    assert_eq!(hash(SemiImplicitEuler), hash(JointWise(SemiImplicitEuler)));
}

/// Relative changes of the linear and the angular momentum of three free bodies over a time \[s\].
fn momentum_changes<S: Scheme>(scheme: S, damping: f64, h: f64, time: f64) -> (f64, f64) {
    let model = free_ring::<F64>(damping);
    let masses: [_; 3] = std::array::from_fn(|i| {
        let body = &model.view().bodies[i];
        (body.mass, body.inertia.to_f64())
    });
    let (p0, l0) = momenta(&masses, &State::initial(&model).bodies);
    let mut plant = Plant::new(&model, scheme, h).unwrap();
    plant.advance((time / h).round() as u64).unwrap();
    let (p, l) = momenta(&masses, &plant.state().bodies);
    let size = |v: Vec3<f64>| v.dot(v).sqrt();
    (size(p - p0) / size(p0), size(l - l0) / size(l0))
}

#[test]
fn momentum_is_kept_as_stated() {
    for damping in [0.0, 2.0] {
        fn exact<S: Scheme>(scheme: S, damping: f64) {
            let (linear, angular) = momentum_changes(scheme, damping, 1e-3, 5.0);
            assert!(linear < 1e-12 && angular < 1e-12, "{}: {linear:e} {angular:e}", S::NAME);
        }
        exact(SemiImplicitEuler, damping);
        exact(Leapfrog, damping);
        exact(JointWise(Leapfrog), damping);
        exact(Pefrl, damping);
        exact(BlanesMoanS6, damping);
        fn drifting<S: Scheme>(scheme: S, damping: f64, h: f64, order: f64) {
            let [coarse, fine] = [h, h / 2.0].map(|h| momentum_changes(scheme, damping, h, 0.2));
            assert!(coarse.0 < 1e-12 && fine.0 < 1e-12, "{}: {coarse:?} {fine:?}", S::NAME);
            let seen = (coarse.1 / fine.1).log2();
            assert!((seen - order).abs() < 0.25, "{}: {coarse:?} {fine:?}", S::NAME);
        }
        let (linear, angular) = momentum_changes(Dbd::default(), damping, 1e-4, 0.5);
        assert!(linear < 1e-12 && angular < 1e-3, "dbd: {linear:e} {angular:e}");
        drifting(Dbd::default(), damping, 1e-4, 1.0);
        drifting(DbdP1::default(), damping, 1e-4, 1.0);
        drifting(DbdP2::default(), damping, 1e-4, 1.0);
        drifting(Rk4, damping, 1e-3, 4.0);
    }
}

/// The mean error of the energy over each quarter of a time \[s\], and the worst, in parts of the peak
/// kinetic energy, and that \[J\].
fn energy_errors<S: Scheme>(scheme: S, h: f64, time: f64) -> ([f64; 4], f64, f64) {
    let model = hung_ring::<F64>(0.0);
    let mut plant = Plant::new(&model, scheme, h).unwrap();
    let start = energy(&model, plant.state(), h).total();
    let samples = (time / 4.0 / h / 10.0).round();
    let (mut means, mut worst, mut kinetic) = ([0.0; 4], 0.0_f64, 0.0_f64);
    for mean in &mut means {
        for _ in 0..samples as u32 {
            plant.advance(10).unwrap();
            let now = energy(&model, plant.state(), h);
            let error = now.total() - start;
            kinetic = kinetic.max(now.kinetic);
            *mean += error / samples;
            worst = worst.max(error.abs());
        }
    }
    (means.map(|mean| mean / kinetic), worst / kinetic, kinetic)
}

#[test]
fn energy_oscillates_in_symplectic_schemes_and_drifts_in_others() {
    // ω·h is about 0.4.
    fn steady<S: Scheme>(scheme: S, bound: f64) {
        let (means, worst, _) = energy_errors(scheme, 1e-3, 8.0);
        assert!(worst < bound, "{}: {worst:e}", S::NAME);
        for mean in means {
            assert!((mean - means[0]).abs() < 0.2 * bound, "{}: {means:?}", S::NAME);
        }
    }
    steady(SemiImplicitEuler, 0.2);
    steady(Leapfrog, 0.02);
    steady(Pefrl, 5e-5);
    steady(BlanesMoanS6, 5e-6);
    fn falling<S: Scheme>(scheme: S) {
        let (means, ..) = energy_errors(scheme, 1e-3, 8.0);
        assert!(means.windows(2).all(|pair| pair[1] < pair[0]), "{}: {means:?}", S::NAME);
    }
    falling(DbdP1::default());
    falling(DbdP2::default());
    falling(Dbd { newton: 1 });
    falling(Rk4);
}

#[test]
fn energy_does_not_drift_in_a_long_run_of_leapfrog() {
    // z = ω·h = 0.04. The mean error moves a little (1.5e-4 J over 40 s) while the motion's
    // energy spreads into the joints' vibration; Newton iterations dissipate visibly.
    let (means, worst, kinetic) = energy_errors(Leapfrog, 1e-4, 40.0);
    assert!(worst < 1e-3, "{worst:e}");
    for mean in &means {
        assert!((mean - means[0]).abs() * kinetic < 3e-4, "{means:?} of {kinetic}");
    }
    let (means, _, kinetic) = energy_errors(Dbd { newton: 1 }, 1e-4, 10.0);
    let mean = means.iter().sum::<f64>() / 4.0 * kinetic;
    assert!(mean < -0.1, "{mean}");
}

/// A free mass of 2 kg that a force pushes along x.
fn pushed() -> (Bench<F64>, InputKind<F64>) {
    let mut model = Bench::<F64>::new();
    let body = model.add_body(2.0, [0.1; 3], at([0.0; 3])).unwrap();
    let (direction, frame) = (Vec3::new(1.0, 0.0, 0.0), LoadFrame::World);
    (model, InputKind::Force { body, point: Vec3::ZERO, direction, frame })
}

#[test]
fn tables_are_sampled_at_the_stages() {
    // The impulse of a ramp is its integral; a scheme of first order takes one side of each step.
    fn check<S: Scheme>(scheme: S) {
        let (mut model, kind) = pushed();
        model.add_table(kind, &[[0.0, 1.0], [0.01, 5.0]], true).unwrap();
        let (h, steps) = (1e-3, 10);
        let mut plant = Plant::new(&model, scheme, h).unwrap();
        plant.advance(steps).unwrap();
        let (impulse, v) = (0.03, plant.state().bodies[0].velocity.x);
        let bound = if S::ORDER == 1 { 0.5 * h * 4.0 / 2.0 * 1.01 } else { 1e-15 };
        assert!((v - impulse / 2.0).abs() < bound, "{}: {v}", S::NAME);
    }
    for_every_scheme!(check);
}

#[test]
fn what_a_caller_sets_is_held_for_all_stages() {
    // A force that the caller ramps: h/m times the sum of the forces, in every scheme.
    fn check<S: Scheme>(scheme: S) {
        let (mut model, kind) = pushed();
        let push = model.add_input(kind, 0.0).unwrap();
        let (h, steps) = (1e-3, 10);
        let mut plant = Plant::new(&model, scheme, h).unwrap();
        let mut sum = 0.0;
        for n in 0..steps {
            let force = 1.0 + 400.0 * h * f64::from(n);
            plant.set_input(push, force).unwrap();
            plant.step().unwrap();
            sum += force;
        }
        let v = plant.state().bodies[0].velocity.x;
        assert!((v - sum * h / 2.0).abs() < 1e-15, "{}: {v}, {}", S::NAME, sum * h / 2.0);
    }
    for_every_scheme!(check);
}

/// What the schemes state of themselves, which the tests above and `convergence.rs` hold them to.
#[test]
fn the_page_says_what_the_schemes_state() {
    fn row<S: Scheme>(scheme: fn(u32) -> S, newton: bool, words: [&str; 2]) -> Vec<String> {
        let plain = scheme(0);
        let short = |limit: f64| match limit.is_infinite() {
            true => "any".into(),
            false => format!("{}", (1e3 * limit).round() / 1e3),
        };
        let limits: Vec<f64> = (0..=8).map(|n| scheme(n).stability_limit()).collect();
        let evaluations = plain.evaluations();
        let (mut evaluations, mut limit) = (format!("{evaluations}"), short(limits[0]));
        if newton {
            for n in 0..=8 {
                assert_eq!(scheme(n).evaluations(), plain.evaluations() + n);
            }
            evaluations += " + N";
            // From the first iteration on that changes it: one value, or all of them.
            if let Some(first) = limits.iter().position(|limit| *limit != limits[0]) {
                let rest: Vec<String> = limits[first..].iter().map(|limit| short(*limit)).collect();
                limit += &match rest.iter().all(|limit| *limit == rest[0]) {
                    true => format!(", with N ≥ {first}: {}", rest[0]),
                    false => format!("; N = {first}…8: {}", rest.join(", ")),
                };
            }
        }
        let order = format!("{} / {}", S::ORDER, S::ORDER_DAMPED);
        let name = format!("`{}`", S::NAME);
        let words = words.map(str::to_owned);
        let cells = [name, order, evaluations, limit, S::DAMPING.name().to_owned()];
        cells.into_iter().chain(words).collect()
    }
    let momenta = "no drift; with quaternions momenta to rounding";
    let by = |power: &str| format!("energy oscillates by O(h{power}), {momenta}");
    let rows = [
        row(|_| Leapfrog, false, [&by("²"), "by default; stiff, heavily damped or near its limit"]),
        row(|_| Pefrl, false, [&by("⁴"), "for accuracy, lightly damped or not at all"]),
        row(
            |_| BlanesMoanS6,
            false,
            [
                "as pefrl, a tenth of its energy error at equal step",
                "long runs whose energy matters",
            ],
        ),
        row(|_| SemiImplicitEuler, false, [&by(""), "as `dbd` without its price"]),
        row(
            |_| Rk4,
            false,
            [
                "linear momentum; loses z⁶/72 of a mode's energy per step",
                "order 4 with dampers, short runs",
            ],
        ),
        row(
            |newton| Dbd { newton },
            true,
            [
                "linear momentum; energy as semi-implicit-euler, with N ≥ 1 a mode loses z² of its \
                 energy per step",
                "to follow the paper",
            ],
        ),
        row(
            |newton| DbdP1 { newton },
            true,
            [
                "linear momentum; a mode loses ½·z² of its energy per step, with N ≥ 1 z²",
                "for the record",
            ],
        ),
        row(|newton| DbdP2 { newton }, true, ["as dbd-p1", "for the record"]),
        row(
            |_| GeneralizedAlpha::DEFAULT,
            false,
            [
                "nothing; takes the energy of what vibrates within a few steps",
                "all but rigid joints at steps of milliseconds: [when](near-rigid.md)",
            ],
        ),
        row(
            |_| GeneralizedAlpha3,
            false,
            [
                "nothing; takes the energy of what vibrates, gains some where a body turns by a tenth of a radian \
                 in a step",
                "the same to 1e-4 m and better: [how](near-rigid.md#third-order)",
            ],
        ),
    ];
    let head = [
        "scheme",
        "order, undamped / damped",
        "evaluations per step",
        "stable for z below",
        "dampers",
        "conserves (undamped)",
        "choose it",
    ];
    block("docs/schemes.md", "schemes", &table(&head, &rows));
}
