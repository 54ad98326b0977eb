//! Failures latch and name what failed; a builder refuses what does not fit.

use dbd_kernel::builder::{BuildError, LineLaw, ModelBuilder, Part, Quantity, Triples};
use dbd_kernel::model::ModelOwner;
use dbd_kernel::plant::{PlantError, StateError};
use dbd_kernel::space::Linear as _;
use dbd_kernel::{
    BodyIndex, BodyState, Cause, Dbd, F32, F64, Failure, Geometry, Leapfrog, Plant, Rk4, Scheme,
};
use dbd_tests::{Bench, at, turned};

const WORLD: BodyIndex = BodyIndex::WORLD;

/// Steps until the plant fails, and checks that it stays as it failed.
fn failure<S: Scheme>(model: &Bench<F32>, scheme: S, step: f64) -> (Cause, u64) {
    let mut plant = Plant::new(model, scheme, step).unwrap();
    for _ in 0..100_000 {
        if let Err(failure) = plant.step() {
            let evaluations = plant.evaluations();
            assert_eq!(failure.step, plant.state().step);
            assert_eq!(plant.step(), Err(failure));
            assert_eq!(plant.advance(10), Err(failure));
            assert_eq!(plant.status(), Err(failure));
            assert_eq!((plant.state().step, plant.evaluations()), (failure.step, evaluations));
            return (failure.cause, failure.step);
        }
    }
    panic!("it was to fail");
}

#[test]
fn a_body_that_is_not_finite_is_named() {
    // The second body's spring is stiff: ω·h = 3.2; the first keeps still.
    let mut model = Bench::<F32>::new();
    model.add_body(1.0, [0.1; 3], at([0.0; 3])).unwrap();
    let stiff = model.add_body(1.0, [0.1; 3], at([1.1, 0.0, 0.0])).unwrap();
    model.add_tsda([WORLD, stiff], [[0.0; 3]; 2], 1e7, 0.0, 1.0).unwrap();
    for (cause, step) in [failure(&model, Leapfrog, 1e-3), failure(&model, Dbd::default(), 1e-3)] {
        assert_eq!(cause, Cause::NonFinite { body: stiff });
        assert!(step < 100, "{step}");
    }
}

/// A pose overflows while every velocity is still finite: the step in which that happens fails, not
/// the next, and a body that nothing acts on does not go on without a place.
#[test]
fn a_pose_that_is_not_finite_is_named_in_its_own_step() {
    fn first<P: Geometry, S: Scheme>(scheme: S, most: f64, spin: f64) {
        let rest = at::<P>([0.0; 3]);
        let far =
            BodyState::from_f64([most, 0.0, 0.0], [1.0, 0.0, 0.0, 0.0], [most, 0.0, 0.0], [0.0; 3]);
        let spun = BodyState::from_f64([0.0; 3], [1.0, 0.0, 0.0, 0.0], [0.0; 3], [spin, 0.0, 0.0]);
        for (state, pose) in [(far, "position"), (spun, "orientation")] {
            let mut model = Bench::<P>::new();
            model.add_body(1.0, [0.1; 3], rest).unwrap();
            let lost = model.add_body(1.0, [0.1; 3], state).unwrap();
            let mut plant = Plant::new(&model, scheme, 1.0).unwrap();
            let failure = plant.step().unwrap_err();
            let velocities = plant.state().bodies.iter();
            assert!(velocities.map(|b| P::velocity(&b.velocity)).all(|v| v.is_finite()));
            let wanted = Failure { cause: Cause::NonFinite { body: lost }, step: 1 };
            assert_eq!(failure, wanted, "{pose} {} {}", S::NAME, P::NAME);
        }
    }
    first::<F64, _>(Leapfrog, 1.5e308, 1e160);
    first::<F64, _>(Rk4, 1.5e308, 1e160);
    first::<F32, _>(Leapfrog, 3e38, 1e30);
    first::<F32, _>(Dbd::default(), 3e38, 1e30);
}

/// Numbers whose sum overflows are finite all the same.
#[test]
fn a_body_far_away_is_finite() {
    let mut model = Bench::<F32>::new();
    model.add_body(1.0, [0.1; 3], at([3e38, 3e38, 3e38])).unwrap();
    assert!(Plant::new(&model, Leapfrog, 1e-3).unwrap().advance(3).is_ok());
}

/// A NaN's sign and payload are the machine's: `-0.0/0.0`, `inf − inf` and what a fused or wider
/// instruction makes of them differ.
#[test]
fn the_hash_of_a_state_that_is_not_finite_knows_no_payload() {
    let mut model = Bench::<F64>::new();
    model.add_body(1.0, [0.1; 3], at([0.0; 3])).unwrap();
    let state = dbd_kernel::State::initial(&model);
    let hash = |bits: u64| {
        let mut state = state.clone();
        state.bodies[0].velocity.y = f64::from_bits(bits);
        state.hash()
    };
    let quiet = hash(0x7ff8_0000_0000_0000);
    for bits in [0xfff8_0000_0000_0000, 0x7ff8_0000_0000_0001, 0x7ff0_dead_beef_0000, u64::MAX] {
        assert_eq!(hash(bits), quiet, "{bits:x}");
    }
    let [infinite, zero] = [f64::INFINITY, 0.0].map(f64::to_bits);
    assert!(hash(infinite) != quiet && hash(zero) == state.hash());
}

#[test]
fn a_spring_whose_twist_is_undefined_is_named() {
    // Two torsion springs; the body turns about x, normal to the second's axis.
    let mut model = Bench::<F32>::new();
    let state = BodyState::from_f64([0.0; 3], [1.0, 0.0, 0.0, 0.0], [0.0; 3], [2.0, 0.0, 0.0]);
    let body = model.add_body(1.0, [0.1; 3], state).unwrap();
    model.add_torsion_spring([WORLD, body], [1.0, 0.0, 0.0], 0.0, 0.0, 0.0).unwrap();
    model.add_torsion_spring([WORLD, body], [0.0, 0.0, 1.0], 0.0, 0.0, 0.0).unwrap();
    let (cause, step) = failure(&model, Leapfrog, 1e-4);
    assert_eq!(cause, Cause::UndefinedTorsionAngle { spring: dbd_kernel::TorsionIndex(1) });
    // Half a turn at 2 rad/s takes π/2 s.
    assert!((15_690..15_720).contains(&step), "{step}");
}

#[test]
fn steps_that_are_no_steps_are_refused() {
    let mut model = Bench::<F32>::new();
    model.add_body(1.0, [0.1; 3], at([0.0; 3])).unwrap();
    for step in [0.0, -1e-3, f64::NAN, f64::INFINITY, 1e-60] {
        let refused = Plant::new(&model, Leapfrog, step).err();
        assert!(matches!(refused, Some(PlantError::Step(_))), "{step}");
    }
}

#[test]
fn a_builder_refuses_and_stays_as_it_was() {
    type Small = ModelBuilder<F64, 2, 2, 4, 2, 1, 1, 1, 1, 1>;
    let mut model = Small::new();
    let refused = model.add_body(-1.0, [0.1; 3], at([0.0; 3]));
    assert_eq!(refused, Err(BuildError::OutOfRange(Quantity::Mass)));
    let refused = model.add_body(1.0, [0.1, 0.1, 0.3], at([0.0; 3]));
    assert_eq!(refused, Err(BuildError::OutOfRange(Quantity::Inertia)));
    let refused = model.add_body(1.0, [0.1; 3], at([f64::NAN, 0.0, 0.0]));
    assert_eq!(refused, Err(BuildError::OutOfRange(Quantity::State)));
    let body = model.add_body(1.0, [0.1; 3], at([0.0; 3])).unwrap();
    let mut tsda = |between, points, stiffness, damping, free_length| {
        model.add_tsda(between, points, stiffness, damping, free_length)
    };
    let ends = [[0.0; 3], [1.0, 0.0, 0.0]];
    let absent = BodyIndex(5);
    let out = |quantity| Err(BuildError::OutOfRange(quantity));
    assert_eq!(tsda([body, absent], ends, 1.0, 0.0, 1.0), Err(BuildError::UnknownBody(absent)));
    assert_eq!(tsda([body, body], ends, 1.0, 0.0, 1.0), Err(BuildError::SameBody(body)));
    assert_eq!(tsda([WORLD, WORLD], ends, 1.0, 0.0, 1.0), Err(BuildError::SameBody(WORLD)));
    assert_eq!(tsda([WORLD, body], ends, -1.0, 0.0, 1.0), out(Quantity::Stiffness));
    assert_eq!(tsda([WORLD, body], ends, 1.0, f64::NAN, 1.0), out(Quantity::Damping));
    assert_eq!(tsda([WORLD, body], ends, 1.0, 0.0, -1.0), out(Quantity::FreeLength));
    let nowhere = [[f64::INFINITY, 0.0, 0.0], [0.0; 3]];
    assert_eq!(tsda([WORLD, body], nowhere, 1.0, 0.0, 1.0), out(Quantity::Point));
    let four_arms = Triples {
        between: [WORLD, body],
        centres: &[[0.0; 3]],
        arms: &[[0.0; 3]; 4],
        stiffness: 1.0,
        damping: 0.0,
        free_length: 1.0,
        clearance: 0.0,
    };
    assert_eq!(model.add_triples(four_arms), out(Quantity::Arms));
    let law = LineLaw { stiffness: 1.0, damping: 0.0, free_length: 0.0, clearance: 0.0 };
    let refused = model.add_points_on_line([WORLD, body], [0.0; 3], [0.0; 3], &[[0.0; 3]], law);
    assert_eq!(refused, out(Quantity::Axis));
    let refused = model.add_torsion_spring([WORLD, body], [0.0; 3], 1.0, 0.0, 0.0);
    assert_eq!(refused, out(Quantity::Axis));
    let view = model.view();
    assert_eq!((view.bodies.len(), view.groups.len(), view.points.len()), (1, 0, 0));

    // Room for two TSDAs, four points and one damper.
    model.add_tsda([WORLD, body], ends, 1.0, 0.5, 1.0).unwrap();
    let full = |part| Err(BuildError::Full(part));
    assert_eq!(model.add_tsda([WORLD, body], ends, 1.0, 0.5, 1.0), full(Part::Dampers));
    model.add_tsda([WORLD, body], ends, 1.0, 0.0, 1.0).unwrap();
    assert_eq!(model.add_tsda([WORLD, body], ends, 1.0, 0.0, 1.0), full(Part::Groups));
    let quarter = turned([0.0, 0.0, 1.0], 1.0);
    let state = BodyState::from_f64([0.0; 3], quarter, [0.0; 3], [0.0; 3]);
    model.add_body(1.0, [0.1; 3], state).unwrap();
    assert_eq!(model.add_body(1.0, [0.1; 3], state).err(), Some(BuildError::Full(Part::Bodies)));
}

/// A pendulum of one body and a spring from the world, at its model's start.
fn swinging() -> Bench<F64> {
    let mut model = Bench::<F64>::new();
    let body = model.add_body(1.0, [0.1; 3], at([1.1, 0.0, 0.0])).unwrap();
    model.add_tsda([WORLD, body], [[0.0; 3]; 2], 100.0, 0.0, 1.0).unwrap();
    model
}

#[test]
fn a_reset_plant_runs_as_a_new_one() {
    let model = swinging();
    let mut plant = Plant::new(&model, Leapfrog, 1e-3).unwrap();
    plant.advance(100).unwrap();
    let first = plant.hash();
    plant.reset();
    assert_eq!((plant.time(), plant.evaluations()), (0.0, 0));
    plant.advance(100).unwrap();
    assert_eq!(plant.hash(), first);
    // Far too stiff for this step: reset is the way out of a failure, too.
    let mut failing = Plant::new(&model, Leapfrog, 1.0).unwrap();
    while failing.step().is_ok() {}
    failing.reset();
    assert!(failing.status().is_ok() && failing.step().is_ok());
}

#[test]
fn a_plant_goes_on_from_a_state_that_is_set() {
    let model = swinging();
    let mut plant = Plant::new(&model, Leapfrog, 1e-3).unwrap();
    plant.advance(50).unwrap();
    let halfway = plant.state().clone();
    plant.advance(50).unwrap();
    let mut other = Plant::new(&model, Leapfrog, 1e-3).unwrap();
    other.set_state(halfway.clone()).unwrap();
    other.advance(50).unwrap();
    assert_eq!(other.hash(), plant.hash());

    let before = other.hash();
    let mut refused = |spoil: &dyn Fn(&mut dbd_kernel::State<Bench<F64>>)| {
        let mut state = halfway.clone();
        spoil(&mut state);
        let error = other.set_state(state).unwrap_err();
        assert_eq!(other.hash(), before, "nothing is changed by {error}");
        error
    };
    let body = BodyIndex(0);
    assert_eq!(refused(&|s| s.bodies[0].velocity.y = f64::NAN), StateError::NotFinite(body));
    assert_eq!(refused(&|s| s.bodies[0].orientation.w = 0.9), StateError::Orientation(body));
    assert_eq!(refused(&|s| s.bodies.clear()), StateError::Count);
}

#[test]
fn a_plant_may_own_its_model() {
    fn needs_send<T: Send + 'static>(_: &T) {}
    let borrowed = swinging();
    let mut borrowing = Plant::new(&borrowed, Leapfrog, 1e-3).unwrap();
    let mut owning = Plant::new(std::sync::Arc::new(swinging()), Leapfrog, 1e-3).unwrap();
    needs_send(&owning);
    borrowing.advance(100).unwrap();
    owning.advance(100).unwrap();
    assert_eq!(borrowing.hash(), owning.hash());
}
