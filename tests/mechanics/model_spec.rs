//! A model that a person writes in a `const` has the bits of the run-time builder's.

use dbd_kernel::builder::Triples;
use dbd_kernel::model;
use dbd_kernel::model_spec::{ModelSpec, Spring, Start};
use dbd_kernel::space::Linear as _;
use dbd_kernel::{
    BodyIndex, BodyState, F32, F64, Geometry, Leapfrog, Load, LoadFrame, ModelOwner, Plant, Real,
    Vec3,
};
use dbd_tests::Bench;

const WORLD: BodyIndex = BodyIndex::WORLD;
const CRANK: BodyIndex = BodyIndex(0);
const ROD: BodyIndex = BodyIndex(1);
const GRAVITY: [f64; 3] = [0.1, -9.81, 0.3];
const INERTIAS: [[f64; 3]; 2] = [[0.011, 0.012, 0.013], [0.4, 0.3, 0.2]];
const FIRST: Start = Start {
    position: [0.3, -0.0, 0.0],
    orientation: [1.0, 0.0, 0.0, 0.0],
    velocity: [0.1, 0.2, -0.3],
    angular_velocity: [1.0, -2.0, 0.5],
};
const CENTRES: [[f64; 3]; 2] = [[0.0, 0.0, -0.1], [0.0, 0.0, 0.1]];
const ARMS: [[f64; 3]; 3] = [[-0.2, 0.0, 0.0], [-0.35, 0.08, 0.0], [-0.35, -0.08, 0.0]];
const JOINT: Spring = Spring { stiffness: 1e5, damping: 3.0, free_length: 0.1 };
const BUSHING: Spring = Spring { stiffness: 2e3, damping: 0.0, free_length: 0.0 };
const TIE: Spring = Spring { stiffness: 7e3, damping: 0.7, free_length: 0.25 };
const FORCE: [f64; 3] = [0.0, 5.0, -0.0];

const MODEL_SPEC: ModelSpec = ModelSpec::new()
    .gravity(GRAVITY)
    .body(0.7, INERTIAS[0], FIRST)
    .body(2.3, INERTIAS[1], Start::at([0.8, 0.1, -0.2]))
    .triples([WORLD, CRANK], &CENTRES, &ARMS, JOINT)
    .tsda([CRANK, ROD], [[0.1, 0.0, 0.0], [-0.2, -0.1, 0.1]], BUSHING)
    .tsda([ROD, WORLD], [[0.1, -0.0, 0.0], [1.0, 0.5, 0.0]], TIE)
    .torsion_spring([CRANK, ROD], [0.0, 0.0, 1.0], 12.0, 0.3, 0.5)
    .load(Load {
        body: ROD,
        frame: LoadFrame::Body,
        force: Vec3::new(FORCE[0], FORCE[1], FORCE[2]),
        torque: Vec3::new(0.0, 0.0, 0.01),
        from: 0.01,
        until: 0.05,
    });

model!(static IN_F64: F64 = MODEL_SPEC);
model!(static IN_F32: F32 = MODEL_SPEC);

/// The same mechanism, built at run time.
fn built<P: Geometry>() -> Bench<P> {
    let mut model = Bench::<P>::new();
    model.set_gravity(GRAVITY).unwrap();
    let state =
        |s: Start| BodyState::from_f64(s.position, s.orientation, s.velocity, s.angular_velocity);
    model.add_body(0.7, INERTIAS[0], state(FIRST)).unwrap();
    model.add_body(2.3, INERTIAS[1], state(Start::at([0.8, 0.1, -0.2]))).unwrap();
    model
        .add_triples(Triples {
            between: [WORLD, CRANK],
            centres: &CENTRES,
            arms: &ARMS,
            stiffness: JOINT.stiffness,
            damping: JOINT.damping,
            free_length: JOINT.free_length,
            clearance: 0.0,
        })
        .unwrap();
    let mut tsda = |between, points, s: Spring| {
        model.add_tsda(between, points, s.stiffness, s.damping, s.free_length).unwrap();
    };
    tsda([CRANK, ROD], [[0.1, 0.0, 0.0], [-0.2, -0.1, 0.1]], BUSHING);
    tsda([ROD, WORLD], [[0.1, -0.0, 0.0], [1.0, 0.5, 0.0]], TIE);
    model.add_torsion_spring([CRANK, ROD], [0.0, 0.0, 1.0], 12.0, 0.3, 0.5).unwrap();
    model
        .add_load(Load {
            body: ROD,
            frame: LoadFrame::Body,
            force: P::Vector::from_f64(FORCE),
            torque: P::Moment::from_f64([0.0, 0.0, 0.01]),
            from: 0.01,
            until: 0.05,
        })
        .unwrap();
    model
}

/// Hash and fingerprint after 2,000 steps of 50 µs, and that something moved.
fn end<M: ModelOwner>(model: &M) -> (u64, u64) {
    let mut plant = Plant::new(model, Leapfrog, 5e-5).unwrap();
    let start = plant.hash();
    plant.advance(2_000).unwrap();
    assert_ne!(plant.hash(), start);
    (plant.hash(), plant.fingerprint())
}

#[test]
fn a_sketch_has_the_bits_of_the_builders_model() {
    assert_eq!(end(&IN_F64), end(&built::<F64>()));
    assert_eq!(end(&IN_F32), end(&built::<F32>()));
}

#[test]
fn a_model_spec_rounds_once() {
    assert_eq!(IN_F32.bodies[1].inverse_mass, <f32 as Real>::from_f64(1.0 / 2.3));
    assert_eq!(MODEL_SPEC.counts(), [2, 3, 9, 7, 1, 8, 1, 1, 1, 0, 0]);
}
