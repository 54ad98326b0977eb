//! Guards: each fires where it should, names what it is about, and is silent where all is well.

use dbd_kernel::frequency::bound;
use dbd_kernel::status::{Cause, MAX_TURN};
use dbd_kernel::watch::Watch;
use dbd_kernel::{
    BlanesMoanS6, BodyIndex, BodyState, Dbd, DbdP1, DbdP2, F32, F64, Geometry, Leapfrog, Pefrl,
    Plant, Real, Rk4, Scheme, SemiImplicitEuler, State, TorsionIndex,
};
use dbd_tests::{Bench, at, scene, scene_names};

const WORLD: BodyIndex = BodyIndex::WORLD;
const STEP: f64 = 1e-3;

/// A body at rest and one that spins by `turn` \[rad\] per step about an axis of its own.
fn spinning<P: Geometry>(turn: f64) -> Bench<P> {
    let mut model = Bench::<P>::new();
    model.add_body(1.0, [0.1; 3], at([0.0; 3])).unwrap();
    let rate = turn / STEP;
    let spin = BodyState::from_f64(
        [0.0; 3],
        [1.0, 0.0, 0.0, 0.0],
        [0.0; 3],
        [0.0, 0.6 * rate, 0.8 * rate],
    );
    model.add_body(1.0, [0.1; 3], spin).unwrap();
    model
}

#[test]
fn a_spin_beyond_a_radian_per_step_is_refused_in_every_scheme_and_precision() {
    fn refused<P: Geometry, S: Scheme>(scheme: S) {
        let calm = spinning::<P>(0.99 * MAX_TURN);
        assert!(Plant::new(&calm, scheme, STEP).unwrap().advance(100).is_ok(), "{}", S::NAME);
        let wild = spinning::<P>(1.01 * MAX_TURN);
        let mut plant = Plant::new(&wild, scheme, STEP).unwrap();
        let failure = plant.step().unwrap_err();
        assert_eq!(failure.cause, Cause::Spin { body: BodyIndex(1) }, "{} {}", S::NAME, P::NAME);
        assert_eq!((failure.step, plant.state().step), (1, 1));
        let hash = plant.hash();
        assert!(plant.advance(5).is_err() && plant.hash() == hash);
    }
    fn all<P: Geometry>() {
        refused::<P, _>(Leapfrog);
        refused::<P, _>(SemiImplicitEuler);
        refused::<P, _>(Pefrl);
        refused::<P, _>(BlanesMoanS6);
        refused::<P, _>(Rk4);
        refused::<P, _>(Dbd::default());
        refused::<P, _>(DbdP1::default());
        refused::<P, _>(DbdP2::default());
    }
    all::<F64>();
    all::<F32>();
}

/// A torsion spring whose second body turns 0.5 rad per step.
fn winding<P: Geometry>() -> Bench<P> {
    let mut model = Bench::<P>::new();
    let rate = 0.5 / STEP;
    let state = BodyState::from_f64([0.0; 3], [1.0, 0.0, 0.0, 0.0], [0.0; 3], [0.0, 0.0, rate]);
    let body = model.add_body(1.0, [0.1; 3], state).unwrap();
    model.add_torsion_spring([WORLD, body], [0.0, 0.0, 1.0], 0.0, 0.0, 0.0).unwrap();
    model
}

#[test]
fn a_turn_count_does_not_wrap() {
    let model = winding::<F32>();
    let mut plant = Plant::new(&model, Leapfrog, STEP).unwrap();
    let mut state = plant.state().clone();
    state.turns[0] = i32::MAX - 2;
    plant.set_state(state).unwrap();
    let failure = plant.advance(100).unwrap_err();
    assert_eq!(failure.cause, Cause::Turns { spring: TorsionIndex(0) });
    // Two or three turns of 2π at 0.5 rad per step.
    assert!((18..=38).contains(&failure.step), "{failure:?}");
    assert_eq!(plant.state().turns[0], i32::MAX);
}

#[test]
fn a_step_counter_does_not_wrap() {
    let model = winding::<F64>();
    let mut plant = Plant::new(&model, Leapfrog, STEP).unwrap();
    let mut state = plant.state().clone();
    state.step = u64::MAX - 1;
    plant.set_state(state).unwrap();
    plant.step().unwrap();
    let hash = plant.hash();
    let failure = plant.step().unwrap_err();
    assert_eq!((failure.cause, failure.step), (Cause::Steps, u64::MAX));
    assert_eq!(plant.hash(), hash);
    plant.reset();
    assert!(plant.step().is_ok() && plant.state().step == 1);
}

#[test]
fn a_failure_ends_by_clear_reset_or_another_state() {
    let model = spinning::<F32>(2.0);
    let mut plant = Plant::new(&model, Leapfrog, STEP).unwrap();
    assert!(plant.step().is_err());
    let hash = plant.hash();
    // The state stays, and what is wrong with it is found again.
    plant.clear();
    assert!(plant.status().is_ok() && plant.hash() == hash);
    assert!(plant.step().is_err() && plant.state().step == 2);
    let mut slow = State::initial(&model);
    slow.bodies[1].angular_velocity = slow.bodies[0].angular_velocity;
    plant.set_state(slow).unwrap();
    plant.advance(10).unwrap();
    plant.reset();
    assert!(plant.status().is_ok() && plant.step().is_err());
}

/// A body on a TSDA of free length 1 m along x, a second one beside it.
fn sprung<P: Geometry>(velocity: f64) -> Bench<P> {
    let mut model = Bench::<P>::new();
    model.add_body(1.0, [0.1; 3], at([5.0, 0.0, 0.0])).unwrap();
    let state =
        BodyState::from_f64([1.0, 0.0, 0.0], [1.0, 0.0, 0.0, 0.0], [velocity, 0.0, 0.0], [0.0; 3]);
    let body = model.add_body(1.0, [0.1; 3], state).unwrap();
    model.add_tsda([WORLD, body], [[0.0; 3]; 2], 1e4, 0.0, 1.0).unwrap();
    model
}

/// Compressed to a thirtieth of its free length a spring is twenty-nine times as stiff across as along:
/// a step that was right is no longer. The watch sees it before anything moves across.
#[test]
fn a_spring_compressed_to_next_to_nothing_is_seen() {
    fn seen<P: Geometry>() {
        // ω = 100 rad/s, ω·h = 0.5: across 2.7 where it is shortest.
        let model = sprung::<P>(-97.0);
        let mut plant = Plant::new(&model, Leapfrog, 5e-3).unwrap();
        let mut watch = Watch::new(&plant);
        let mut least = f64::INFINITY;
        let failure = loop {
            if let Err(failure) = plant.step().and_then(|()| watch.look(&mut plant)) {
                break failure;
            }
            least = least.min(P::position_to_f64(&plant.state().bodies[1].position)[0]);
            assert!(plant.state().step < 100, "never seen, {least}");
        };
        assert_eq!(failure.cause, Cause::Frequency { body: BodyIndex(1) }, "{}", P::NAME);
        let z = bound(&model, plant.state()).to_f64() * 5e-3;
        assert!(z > 2.4, "{z}");
        assert!(plant.step().is_err());
        plant.clear();
        plant.step().unwrap();
    }
    seen::<F64>();
    seen::<F32>();
}

/// An energy beyond its limit names the body that has most of it.
#[test]
fn an_energy_beyond_its_limit_is_seen() {
    let model = sprung::<F32>(-1.0);
    let mut plant = Plant::new(&model, Leapfrog, 1e-3).unwrap();
    let mut watch = Watch::new(&plant).with_energy(0.51);
    for _ in 0..200 {
        assert!(plant.step().is_ok() && watch.look(&mut plant).is_ok());
    }
    let mut watch = Watch::new(&plant).with_energy(0.49);
    let failure = watch.look(&mut plant).unwrap_err();
    assert_eq!(failure.cause, Cause::Energy { body: BodyIndex(1) });
    assert_eq!(watch.look(&mut plant), Err(failure));
}

/// Shipped scenes at their own or the advised step are looked at after every step, and nothing is
/// said; the watch changes no bit.
#[test]
fn shipped_scenes_are_calm() {
    for name in scene_names() {
        let scene = scene(&name);
        let omega = bound(&scene.model, &State::initial(&scene.model));
        let step = scene.step.unwrap_or(if omega > 0.0 { 1.0 / omega } else { 1e-3 });
        let mut plant = Plant::new(&scene.model, Leapfrog, step).unwrap();
        let mut plain = Plant::new(&scene.model, Leapfrog, step).unwrap();
        let mut watch = Watch::new(&plant);
        for _ in 0..200 {
            assert!(plant.step().is_ok() && plain.step().is_ok(), "{name}");
            let status = watch.look(&mut plant);
            assert!(status.is_ok(), "{name}: {status:?}");
        }
        assert_eq!(plant.hash(), plain.hash(), "{name}");
        assert_eq!(plant.evaluations(), plain.evaluations(), "{name}");
    }
}
