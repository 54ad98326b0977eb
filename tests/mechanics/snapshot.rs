//! Snapshots: exact resume, and every kind of wrong bytes.

use dbd_kernel::elements::input::InputKind;
use dbd_kernel::euler::{EulerF32, EulerF64};
use dbd_kernel::snapshot::SnapshotError;
use dbd_kernel::space::Linear as _;
use dbd_kernel::{
    BlanesMoanS6, BodyIndex, Dbd, DbdP2, Explicit, F32, F64, Fixed, Geometry, GroupIndex,
    JointWise, Leapfrog, Load, LoadFrame, Pefrl, Plant, Rk4, Scheme, SemiImplicitEuler,
};
use dbd_tests::{Bench, at, hung_ring};

/// A model with dampers, torsion springs, a load that ends and inputs of both sorts.
fn busy<P: Geometry>() -> Bench<P> {
    let mut model = hung_ring::<P>(0.5);
    let axis = P::Moment::from_f64([0.0, 0.0, 1.0]);
    let torque = P::Moment::from_f64([0.0, 0.2, 0.0]);
    let body = BodyIndex(1);
    let force = P::Vector::ZERO;
    let frame = LoadFrame::Body;
    model.add_load(Load { body, frame, force, torque, from: 0.01, until: 0.06 }).unwrap();
    model.add_input(InputKind::Torque { body, axis, frame }, 0.1).unwrap();
    let table = [[0.0, 0.0], [0.03, 0.5], [0.07, -0.5]];
    model
        .add_table(InputKind::Actuator { group: GroupIndex(2), element: 0 }, &table, true)
        .unwrap();
    model
}

fn resumes<P: Geometry, S: Scheme>(scheme: S) {
    let model = busy::<P>();
    let input = dbd_kernel::InputIndex(0);
    let mut whole = Plant::new(&model, scheme, 1e-4).unwrap();
    let mut bytes = vec![0; whole.snapshot_size()];
    // 500 steps lie within the load's window.
    whole.advance(250).unwrap();
    whole.set_input(input, 0.7).unwrap();
    whole.advance(250).unwrap();
    assert_eq!(whole.snapshot(&mut bytes), Ok(bytes.len()));
    whole.advance(500).unwrap();
    let mut other = Plant::new(&model, scheme, 1e-4).unwrap();
    other.advance(77).unwrap();
    other.restore(&bytes).unwrap();
    assert_eq!(other.state().step, 500);
    other.advance(500).unwrap();
    assert_eq!(whole.hash(), other.hash(), "{} {}", S::NAME, P::NAME);
}

#[test]
fn a_restored_plant_goes_on_with_the_same_bits() {
    resumes::<F64, _>(Leapfrog);
    resumes::<F32, _>(Leapfrog);
    resumes::<F64, _>(Dbd::default());
    resumes::<F32, _>(Dbd { newton: 1 });
    resumes::<F64, _>(DbdP2 { newton: 1 });
    resumes::<F64, _>(Explicit(Leapfrog));
    resumes::<F64, _>(JointWise(Leapfrog));
    resumes::<F32, _>(JointWise(SemiImplicitEuler));
    resumes::<F32, _>(SemiImplicitEuler);
    resumes::<F64, _>(Pefrl);
    resumes::<F32, _>(BlanesMoanS6);
    resumes::<F64, _>(Rk4);
    resumes::<Fixed, _>(Leapfrog);
    resumes::<Fixed, _>(JointWise(Leapfrog));
    resumes::<Fixed, _>(Rk4);
    resumes::<EulerF32, _>(Pefrl);
    resumes::<EulerF64, _>(Leapfrog);
}

#[test]
fn every_flipped_bit_is_refused_and_changes_nothing() {
    let model = busy::<F32>();
    let mut plant = Plant::new(&model, Leapfrog, 1e-4).unwrap();
    plant.advance(10).unwrap();
    let mut bytes = vec![0; plant.snapshot_size()];
    plant.snapshot(&mut bytes).unwrap();
    plant.advance(5).unwrap();
    let before = plant.hash();
    for bit in 0..bytes.len() * 8 {
        bytes[bit / 8] ^= 1 << (bit % 8);
        assert!(plant.restore(&bytes).is_err(), "bit {bit}");
        bytes[bit / 8] ^= 1 << (bit % 8);
    }
    assert_eq!(plant.hash(), before);
    assert_eq!(plant.restore(&bytes), Ok(()));
    assert_ne!(plant.hash(), before);
}

#[test]
fn snapshots_of_other_models_steps_versions_and_lengths_are_refused() {
    let model = busy::<F64>();
    let mut plant = Plant::new(&model, Leapfrog, 1e-4).unwrap();
    let mut bytes = vec![0; plant.snapshot_size()];
    plant.snapshot(&mut bytes).unwrap();
    let mut other_step = Plant::new(&model, Leapfrog, 2e-4).unwrap();
    assert_eq!(other_step.restore(&bytes), Err(SnapshotError::Model));
    // Four words of four bytes either way.
    let (angles, quaternions) = (busy::<EulerF32>(), busy::<F32>());
    let angles = Plant::new(&angles, Leapfrog, 1e-4).unwrap();
    let mut quaternions = Plant::new(&quaternions, Leapfrog, 1e-4).unwrap();
    let mut of_angles = vec![0; angles.snapshot_size()];
    angles.snapshot(&mut of_angles).unwrap();
    assert_eq!(of_angles.len(), quaternions.snapshot_size());
    assert_eq!(quaternions.restore(&of_angles), Err(SnapshotError::Model));
    let other = hung_ring::<F64>(0.25);
    let mut other = Plant::new(&other, Leapfrog, 1e-4).unwrap();
    assert_eq!(other.restore(&bytes), Err(SnapshotError::Model));
    let mut newer = bytes.clone();
    newer[4] = 9;
    assert_eq!(plant.restore(&newer), Err(SnapshotError::Version(9)));
    assert_eq!(plant.restore(&bytes[..7]), Err(SnapshotError::Format));
    assert_eq!(plant.restore(&bytes[..bytes.len() - 1]), Err(SnapshotError::Checksum));
    assert_eq!(plant.restore(b"not a snapshot, but long enough"), Err(SnapshotError::Format));
    let mut short = [0; 8];
    assert_eq!(plant.snapshot(&mut short), Err(SnapshotError::Buffer(bytes.len())));
}

/// What plants of a model say of the bytes that one of another scheme wrote.
fn refusal<A: Scheme, B: Scheme>(from: A, to: B) -> Result<(), SnapshotError> {
    let model = busy::<F64>();
    let mut plant = Plant::new(&model, from, 1e-4).unwrap();
    plant.advance(3).unwrap();
    let mut bytes = vec![0; plant.snapshot_size()];
    plant.snapshot(&mut bytes).unwrap();
    let mut other = Plant::new(&model, to, 1e-4).unwrap();
    let before = other.hash();
    let outcome = other.restore(&bytes);
    assert_eq!(other.hash() == before, outcome.is_err());
    outcome
}

#[test]
fn a_snapshot_of_another_scheme_damping_or_number_of_iterations_is_refused() {
    let refused = Err(SnapshotError::Scheme);
    assert_eq!(refusal(Leapfrog, Dbd::default()), refused);
    assert_eq!(refusal(Pefrl, Rk4), refused);
    assert_eq!(refusal(Leapfrog, Explicit(Leapfrog)), refused);
    assert_eq!(refusal(Explicit(SemiImplicitEuler), SemiImplicitEuler), refused);
    assert_eq!(refusal(Dbd { newton: 1 }, Dbd { newton: 2 }), refused);
    assert_eq!(refusal(DbdP2 { newton: 1 }, Dbd { newton: 1 }), refused);
    assert_eq!(refusal(Dbd { newton: 1 }, Dbd { newton: 1 }), Ok(()));
    assert_eq!(refusal(Explicit(Leapfrog), Explicit(Leapfrog)), Ok(()));
}

#[test]
fn a_snapshot_of_the_same_mechanism_set_up_elsewhere_is_refused() {
    let started = |x: f64| {
        let mut model = Bench::<F64>::new();
        model.add_body(1.0, [0.1; 3], at([x, 0.0, 0.0])).unwrap();
        model
    };
    let (here, there) = (started(0.0), started(0.5));
    let here = Plant::new(&here, Leapfrog, 1e-3).unwrap();
    let mut bytes = vec![0; here.snapshot_size()];
    here.snapshot(&mut bytes).unwrap();
    let mut there = Plant::new(&there, Leapfrog, 1e-3).unwrap();
    assert_eq!(there.restore(&bytes), Err(SnapshotError::Model));
}
