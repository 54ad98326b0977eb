//! A planar model moves as the spatial one with the same elements in z = 0, and holds as much.

use dbd_kernel::builder::{BuildError, LineLaw, Quantity, Triples};
use dbd_kernel::damping::strengths;
use dbd_kernel::elements::input::InputKind;
use dbd_kernel::energy::energy;
use dbd_kernel::readouts::{Reading, Readout, each_force, each_tension};
use dbd_kernel::space::Linear as _;
use dbd_kernel::{
    BlanesMoanS6, BodyIndex, BodyState, Dbd, DbdP1, DbdP2, Explicit, F32, F64, Geometry,
    GroupIndex, Leapfrog, Load, LoadFrame, Model, Pefrl, Planar32, Planar64, Plant, Rk4, Scheme,
    SemiImplicitEuler, State, TorsionIndex, frequency,
};
use dbd_tests::{Bench, turned};

const WORLD: BodyIndex = BodyIndex::WORLD;
const CRANK: BodyIndex = BodyIndex(0);
const ROD: BodyIndex = BodyIndex(1);
const SLIDER: BodyIndex = BodyIndex(2);
const Z: [f64; 3] = [0.0, 0.0, 1.0];

/// Which laws have dampers.
#[derive(Clone, Copy)]
struct Damped {
    /// TSDAs and torsion springs, whose dampers act in the plane alone.
    along: f64,
    /// Point bushings and points on lines, whose dampers act off the plane, too, where there is space.
    all_around: f64,
}

const NONE: Damped = Damped { along: 0.0, all_around: 0.0 };
const ALONG: Damped = Damped { along: 3.0, all_around: 0.0 };
const ALL: Damped = Damped { along: 3.0, all_around: 2.0 };

fn pin(
    between: [BodyIndex; 2],
    a: [f64; 2],
    b: [f64; 2],
    damping: f64,
    model: &mut Bench<impl Geometry>,
) {
    let reach = 0.2;
    let (centre, arms) =
        ([a[0], a[1], 0.0], [[b[0] + reach, b[1], 0.0], [b[0], b[1] + reach, 0.0]]);
    let clearance = 0.0;
    let (stiffness, free_length) = (900.0, 0.2);
    let triples = Triples {
        between,
        centres: &[centre],
        arms: &arms,
        stiffness,
        damping,
        free_length,
        clearance,
    };
    model.add_triples(triples).unwrap();
}

/// A crank, a rod and a slider with every kind of element, load and input.
fn machine<P: Geometry>(damped: Damped) -> Bench<P> {
    let mut model = Bench::<P>::new();
    let Damped { along, all_around } = damped;
    model.set_gravity([0.3, -9.81, 0.0]).unwrap();
    let state = |x: f64, y: f64, angle: f64, v: [f64; 2], w: f64| {
        BodyState::from_f64([x, y, 0.0], turned(Z, angle), [v[0], v[1], 0.0], [0.0, 0.0, w])
    };
    model.add_body(1.5, [0.02, 0.05, 0.06], state(0.2, 0.1, 0.4, [0.1, -0.2], 9.0)).unwrap();
    model.add_body(0.8, [0.01, 0.04, 0.045], state(0.7, 0.15, -0.3, [0.3, 0.1], -2.0)).unwrap();
    model.add_body(2.0, [0.05, 0.05, 0.09], state(1.2, 0.0, 0.05, [0.0, 0.1], 0.4)).unwrap();
    pin([WORLD, CRANK], [0.0, 0.0], [-0.2, 0.0], along, &mut model);
    pin([CRANK, ROD], [0.25, 0.0], [-0.3, 0.02], along, &mut model);
    model
        .add_tsda([ROD, SLIDER], [[0.28, 0.0, 0.0], [0.05, 0.1, 0.0]], 700.0, all_around, 0.0)
        .unwrap();
    let rail = LineLaw { stiffness: 800.0, damping: all_around, free_length: 0.0, clearance: 0.0 };
    let points = [[-0.1, 0.0, 0.0], [0.1, 0.02, 0.0]];
    model
        .add_points_on_line([WORLD, SLIDER], [0.0, 0.02, 0.0], [1.0, 0.1, 0.0], &points, rail)
        .unwrap();
    let approximate = LineLaw { free_length: 0.05, clearance: 1e-3, ..rail };
    let point = [[0.1, 0.05, 0.0]];
    model
        .add_points_on_line([CRANK, ROD], [0.1, 0.1, 0.0], [0.6, 0.8, 0.0], &point, approximate)
        .unwrap();
    let centres = [[0.0, 0.3, 0.0], [1.0, 0.6, 0.0]];
    let arms = [[0.1, 0.1, 0.0], [-0.1, 0.05, 0.0]];
    let triples = Triples {
        between: [WORLD, SLIDER],
        centres: &centres,
        arms: &arms,
        stiffness: 60.0,
        damping: along,
        free_length: 0.4,
        clearance: 2e-3,
    };
    model.add_triples(triples).unwrap();
    model.add_torsion_spring([WORLD, CRANK], Z, 4.0, 0.2 * along, 1.5).unwrap();
    model.add_torsion_spring([CRANK, ROD], [0.0, 0.0, -2.0], 1.0, 0.01 * along, -0.3).unwrap();
    model
        .add_load(Load {
            body: ROD,
            frame: LoadFrame::Body,
            force: P::Vector::from_f64([3.0, -4.0, 0.0]),
            torque: P::Moment::from_f64([0.0, 0.0, 0.2]),
            from: 0.02,
            until: 0.12,
        })
        .unwrap();
    let force = P::Vector::from_f64([0.0, -2.0, 0.0]);
    let (torque, frame) = (P::Moment::ZERO, LoadFrame::World);
    model.add_load(Load { body: CRANK, frame, force, torque, from: 0.0, until: 1e9 }).unwrap();
    let direction = P::Vector::from_f64([0.6, 0.8, 0.0]);
    let axis = P::Moment::from_f64(Z);
    let point = P::local_from_f64([0.1, -0.2, 0.0]);
    let frame = LoadFrame::Body;
    model.add_input(InputKind::Force { body: SLIDER, point, direction, frame }, 5.0).unwrap();
    model.add_input(InputKind::Torque { body: CRANK, axis, frame }, 0.7).unwrap();
    model.add_input(InputKind::JointTorque { a: CRANK, b: ROD, axes: [axis; 2] }, -0.4).unwrap();
    let table = [[0.0, 0.0], [0.05, 6.0], [0.2, -3.0]];
    model
        .add_table(InputKind::Actuator { group: GroupIndex(5), element: 1 }, &table, true)
        .unwrap();
    let table = [[0.0, 0.0], [0.1, 0.02], [0.15, 0.0]];
    let road = model.add_table(InputKind::Anchor { direction }, &table, true).unwrap();
    let between = [BodyIndex::anchor(road), ROD];
    model.add_tsda(between, [[0.6, 0.5, 0.0], [0.0; 3]], 50.0, along, 0.3).unwrap();
    model
}

/// Numbers of a state in space: positions, orientations, velocities, rates, turn counts.
fn numbers<P: Geometry>(bodies: &[BodyState<P>], turns: &[i32]) -> Vec<f64> {
    let wide: Vec<BodyState<F64>> = bodies.iter().map(BodyState::convert).collect();
    let body = |b: &BodyState<F64>| {
        let turn = b.orientation.to_f64();
        let vectors = [b.position, b.velocity, b.angular_velocity].map(|v| v.to_f64());
        turn.into_iter().chain(vectors.into_iter().flatten()).collect::<Vec<_>>()
    };
    wide.iter().flat_map(body).chain(turns.iter().map(|t| f64::from(*t))).collect()
}

fn apart(a: &[f64], b: &[f64]) -> f64 {
    assert_eq!(a.len(), b.len());
    a.iter().zip(b).map(|(a, b)| (a - b).abs()).fold(0.0, f64::max)
}

/// How far a planar run ends from the spatial one, over 0.2 s.
fn runs_apart<P: Geometry, Q: Geometry, S: Scheme>(scheme: S, damped: Damped, steps: u64) -> f64 {
    let (spatial, planar) = (machine::<P>(damped), machine::<Q>(damped));
    let h = 0.2 / steps as f64;
    let mut spatial = Plant::new(&spatial, scheme, h).unwrap();
    let mut planar = Plant::new(&planar, scheme, h).unwrap();
    spatial.advance(steps).unwrap();
    planar.advance(steps).unwrap();
    assert_eq!(spatial.evaluations(), planar.evaluations());
    let (spatial, planar) = (spatial.state(), planar.state());
    apart(&numbers(&spatial.bodies, &spatial.turns), &numbers(&planar.bodies, &planar.turns))
}

/// Every scheme, as an expression of its own.
macro_rules! every_scheme {
    ($call:ident::<$($precision:ty),*>($($argument:expr),*)) => {
        [
            ("leapfrog", $call::<$($precision,)* _>(Leapfrog, $($argument),*)),
            ("explicit", $call::<$($precision,)* _>(Explicit(Leapfrog), $($argument),*)),
            ("euler", $call::<$($precision,)* _>(SemiImplicitEuler, $($argument),*)),
            ("pefrl", $call::<$($precision,)* _>(Pefrl, $($argument),*)),
            ("bm-s6", $call::<$($precision,)* _>(BlanesMoanS6, $($argument),*)),
            ("rk4", $call::<$($precision,)* _>(Rk4, $($argument),*)),
            ("dbd", $call::<$($precision,)* _>(Dbd { newton: 0 }, $($argument),*)),
            ("dbd-2", $call::<$($precision,)* _>(Dbd { newton: 2 }, $($argument),*)),
            ("p1", $call::<$($precision,)* _>(DbdP1 { newton: 1 }, $($argument),*)),
            ("p2", $call::<$($precision,)* _>(DbdP2 { newton: 0 }, $($argument),*)),
        ]
    };
}

#[test]
fn a_planar_model_moves_as_the_spatial_one_in_every_scheme() {
    for damped in [NONE, ALONG] {
        for (scheme, apart) in every_scheme!(runs_apart::<F64, Planar64>(damped, 2_000)) {
            assert!(apart < 1e-11, "{scheme}: {apart:e}");
        }
        for (scheme, apart) in every_scheme!(runs_apart::<F32, Planar32>(damped, 2_000)) {
            assert!(apart < 1e-3, "{scheme}: {apart:e}");
        }
    }
}

/// In space a damper off the plane bears a share of its element's, see [`dbd_kernel::damping`]: the
/// same motion in the limit of small steps.
#[test]
fn dampers_all_around_differ_by_their_shares_to_second_order() {
    let [coarse, fine] = [500, 2_000].map(|n| runs_apart::<F64, Planar64, _>(Leapfrog, ALL, n));
    assert!(fine < 1e-4 && coarse / fine > 12.0, "{coarse:e} {fine:e}");
    assert!(runs_apart::<F64, Planar64, _>(Explicit(Leapfrog), ALL, 500) < 1e-11);
    assert!(runs_apart::<F64, Planar64, _>(Rk4, ALL, 500) < 1e-11);
}

/// Energies, tensions, forces, read-outs and strengths of dampers.
fn looks<P: Geometry>(damped: Damped) -> (Vec<f64>, f64, f64) {
    use dbd_kernel::Real as _;
    let model = machine::<P>(damped);
    let mut plant = Plant::new(&model, Leapfrog, 1e-4).unwrap();
    plant.advance(700).unwrap();
    let mut seen = Vec::new();
    let e = energy(&model, plant.state(), 1e-4);
    let energies = [e.kinetic, e.gravity, e.tsda, e.bushing, e.line, e.torsion, e.load];
    assert!(energies.iter().all(|e| e.to_f64() != 0.0), "{energies:?}");
    seen.extend(energies.map(|e| e.to_f64()));
    each_tension(&model, plant.state(), |_, tension| seen.push(tension.to_f64()));
    each_force(&model, plant.state(), |_, force| seen.extend(force.to_f64()));
    strengths(&model, plant.state(), |strength| seen.push(strength.rate));
    let point = P::local_from_f64([0.1, 0.2, 0.0]);
    for readout in [
        Readout::JointAngle { spring: TorsionIndex(0), offset: dbd_kernel::Real::ZERO },
        Readout::JointAngle { spring: TorsionIndex(1), offset: dbd_kernel::Real::ZERO },
        Readout::JointRate { spring: TorsionIndex(1) },
        Readout::Point { body: ROD, point },
        Readout::PointVelocity { body: ROD, point },
        Readout::TsdaForce { group: GroupIndex(5), element: 1 },
        Readout::JointForce { group: GroupIndex(1) },
        Readout::Imu { body: SLIDER, point },
    ] {
        match plant.read(&readout).unwrap() {
            Reading::Scalar(value) => seen.push(value.to_f64()),
            Reading::Vector(value) => seen.extend(value.to_f64()),
            Reading::Imu { specific_force, rate } => {
                seen.extend(specific_force.to_f64());
                seen.extend(rate.to_f64());
            }
        }
    }
    let bound = frequency::bound(&model, plant.state()).to_f64();
    (seen, bound, frequency::estimate(&model, plant.state(), 300))
}

#[test]
fn energies_forces_and_read_outs_are_those_of_space() {
    let (spatial, spatial_bound, _) = looks::<F64>(ALONG);
    let (planar, bound, estimate) = looks::<Planar64>(ALONG);
    assert!(apart(&spatial, &planar) < 1e-10, "{spatial:?}\n{planar:?}");
    // What lies off the plane can only raise a bound.
    assert!(bound <= spatial_bound * (1.0 + 1e-9), "{bound} {spatial_bound}");
    assert!(estimate <= bound && estimate > 0.6 * bound, "{estimate} {bound}");
}

#[test]
fn the_highest_frequency_is_that_of_the_inertias_and_springs() {
    // A mass on one spring: ω² = k/m; a wheel on a torsion spring: ω² = κ/I.
    let mut model = Bench::<Planar64>::new();
    let still = |x: f64| BodyState::from_f64([x, 0.0, 0.0], turned(Z, 0.3), [0.0; 3], [0.0; 3]);
    let mass = model.add_body(2.0, [0.1; 3], still(1.0)).unwrap();
    model.add_tsda([WORLD, mass], [[0.0; 3]; 2], 800.0, 0.0, 1.0).unwrap();
    let highest = |model: &Bench<Planar64>| {
        let plant = Plant::new(model, Leapfrog, 1e-3).unwrap();
        let state = plant.state();
        [frequency::bound(model, state), frequency::estimate(model, state, 50)]
    };
    for found in highest(&model) {
        assert!((found / 20.0 - 1.0).abs() < 5e-3, "{found}");
    }
    // A torque that rests on a wheel counts by half: ω² = τ/2I.
    let mut wound = Bench::<Planar64>::new();
    let wheel = wound.add_body(2.0, [0.05, 0.05, 0.1], still(2.0)).unwrap();
    wound.add_torsion_spring([WORLD, wheel], Z, 0.0, 0.0, 20.0).unwrap();
    assert!((highest(&wound)[0] / 10.0 - 1.0).abs() < 5e-3);
    let wheel = model.add_body(2.0, [0.05, 0.05, 0.1], still(2.0)).unwrap();
    model.add_torsion_spring([WORLD, wheel], Z, 250.0, 0.0, 0.0).unwrap();
    for found in highest(&model) {
        assert!((found / 50.0 - 1.0).abs() < 5e-3, "{found}");
    }
}

/// A spring wound by many turns counts them as in space.
#[test]
fn turns_are_counted_as_in_space() {
    fn wound<P: Geometry>(direction: f64) -> (i32, f64) {
        let mut model = Bench::<P>::new();
        let state =
            BodyState::from_f64([0.0; 3], turned(Z, 2.0), [0.0; 3], [0.0, 0.0, direction * 40.0]);
        let wheel = model.add_body(1.0, [0.1; 3], state).unwrap();
        model.add_torsion_spring([WORLD, wheel], [0.0, 0.0, 1.0], 1e-6, 0.0, 0.0).unwrap();
        let mut plant = Plant::new(model_of(model), Leapfrog, 0.02).unwrap();
        plant.advance(100).unwrap();
        let Some(Reading::Scalar(angle)) = plant
            .read(&Readout::JointAngle { spring: TorsionIndex(0), offset: dbd_kernel::Real::ZERO })
        else {
            panic!("an angle")
        };
        (plant.state().turns[0], dbd_kernel::Real::to_f64(angle))
    }
    fn model_of<P: Geometry>(model: Bench<P>) -> Box<Bench<P>> {
        Box::new(model)
    }
    for direction in [1.0, -1.0] {
        let (turns, angle) = wound::<Planar64>(direction);
        assert!((angle - direction * 80.0).abs() < 1e-3, "{angle}");
        let (spatial_turns, spatial_angle) = wound::<F64>(direction);
        assert!(turns == spatial_turns && (angle - spatial_angle).abs() < 1e-10);
        assert!((wound::<Planar32>(direction).1 - direction * 80.0).abs() < 1e-2);
    }
}

#[test]
fn a_snapshot_goes_on_with_the_same_bits_and_is_refused_in_space() {
    fn goes_on<P: Geometry>() {
        let model = machine::<P>(ALL);
        let mut whole = Plant::new(&model, Leapfrog, 1e-4).unwrap();
        whole.advance(300).unwrap();
        let mut bytes = [0; 1024];
        let size = whole.snapshot(&mut bytes).unwrap();
        // Per body seven words, two turn counts, the step, two words per input.
        let word = if P::NAME == "f32" { 4 } else { 8 };
        assert_eq!(size, 22 + word * (3 * 7 + 5 * 2) + 2 * 4 + 8);
        let mut other = Plant::new(&model, Leapfrog, 1e-4).unwrap();
        other.restore(&bytes[..size]).unwrap();
        whole.advance(500).unwrap();
        other.advance(500).unwrap();
        assert_eq!(whole.hash(), other.hash());
    }
    goes_on::<Planar64>();
    goes_on::<Planar32>();
    let (spatial, planar) = (machine::<F64>(NONE), machine::<Planar64>(NONE));
    let spatial = Plant::new(&spatial, Leapfrog, 1e-4).unwrap();
    let planar = Plant::new(&planar, Leapfrog, 1e-4).unwrap();
    assert_ne!(spatial.fingerprint(), planar.fingerprint());
    assert_eq!((F64::SPACE, Planar32::SPACE, Planar32::NAME), ("spatial", "planar", "f32"));
}

/// The energy of an undamped machine stays, and the momenta of a free one.
#[test]
fn a_free_pair_keeps_its_momenta() {
    let mut model = Bench::<Planar64>::new();
    let state = |x: f64, w: f64| {
        BodyState::from_f64([x, 0.0, 0.0], turned(Z, x), [0.2, w, 0.0], [0.0, 0.0, w])
    };
    model.add_body(1.0, [0.1; 3], state(0.0, 3.0)).unwrap();
    model.add_body(2.0, [0.2; 3], state(1.0, -1.0)).unwrap();
    pin([CRANK, ROD], [0.5, 0.0], [-0.3, -0.4], 0.5, &mut model);
    let momenta = |state: &State<Bench<Planar64>>| {
        let mut sum = [0.0; 3];
        for (body, (mass, inertia)) in state.bodies.iter().zip([(1.0, 0.1), (2.0, 0.2)]) {
            let (x, v) = (body.position, body.velocity);
            sum[0] += mass * v.x;
            sum[1] += mass * v.y;
            sum[2] += mass * (x.x * v.y - x.y * v.x) + inertia * body.angular_velocity.z;
        }
        sum
    };
    let mut plant = Plant::new(&model, Leapfrog, 1e-3).unwrap();
    let before = momenta(plant.state());
    plant.advance(5_000).unwrap();
    assert!(apart(&before, &momenta(plant.state())) < 1e-12);
}

#[test]
fn the_builder_refuses_what_leaves_the_plane() {
    let mut model = Bench::<Planar64>::new();
    let state = BodyState::from_f64([0.0; 3], turned(Z, 0.0), [0.0; 3], [0.0; 3]);
    let body = model.add_body(1.0, [0.1; 3], state).unwrap();
    let off = |quantity| Err(BuildError::OutOfRange(quantity));
    let between = [WORLD, body];
    assert_eq!(model.set_gravity([0.0, 0.0, -9.81]), off(Quantity::Gravity));
    let lifted = [[0.0, 0.0, 0.1], [0.0; 3]];
    assert_eq!(model.add_tsda(between, lifted, 1.0, 0.0, 1.0), off(Quantity::Point));
    let law = LineLaw { stiffness: 1.0, damping: 0.0, free_length: 0.0, clearance: 0.0 };
    let (x, flat) = ([1.0, 0.0, 0.0], [[0.0; 3]]);
    assert_eq!(model.add_points_on_line(between, [0.0; 3], Z, &flat, law), off(Quantity::Axis));
    let tilted = model.add_points_on_line(between, Z, x, &flat, law);
    assert_eq!(tilted, off(Quantity::Point));
    assert_eq!(model.add_torsion_spring(between, x, 1.0, 0.0, 0.0), off(Quantity::Axis));
    model.add_torsion_spring(between, Z, 1.0, 0.0, 0.0).unwrap();
}

/// A const model of the plane has the bits of the builder's.
#[test]
fn a_sketch_has_the_bits_of_the_builder() {
    use dbd_kernel::model_spec::{ModelSpec, Spring, Start};
    const ARMS: [[f64; 3]; 2] = [[-0.1, 0.0, 0.0], [-0.3, 0.2, 0.0]];
    const SPRING: Spring = Spring { stiffness: 500.0, damping: 0.7, free_length: 0.2 };
    const PENDULUM: ModelSpec = ModelSpec::new()
        .gravity([0.0, -9.81, 0.0])
        .body(1.0, [0.1, 0.2, 0.25], Start::at([0.3, 0.0, 0.0]))
        .triples([BodyIndex::WORLD, BodyIndex(0)], &[[0.0; 3]], &ARMS, SPRING)
        .torsion_spring([BodyIndex::WORLD, BodyIndex(0)], [0.0, 0.0, 1.0], 2.0, 0.1, 0.3);
    dbd_kernel::model!(static DOUBLE: Planar64 = PENDULUM);
    dbd_kernel::model!(static SINGLE: Planar32 = PENDULUM);
    fn built<P: Geometry>() -> u64 {
        let mut model = Bench::<P>::new();
        model.set_gravity([0.0, -9.81, 0.0]).unwrap();
        let state = BodyState::from_f64([0.3, 0.0, 0.0], turned(Z, 0.0), [0.0; 3], [0.0; 3]);
        let body = model.add_body(1.0, [0.1, 0.2, 0.25], state).unwrap();
        let Spring { stiffness, damping, free_length } = SPRING;
        let (centres, arms, clearance) = (&[[0.0; 3]], &ARMS, 0.0);
        let between = [WORLD, body];
        model
            .add_triples(Triples {
                between,
                centres,
                arms,
                stiffness,
                damping,
                free_length,
                clearance,
            })
            .unwrap();
        model.add_torsion_spring(between, Z, 2.0, 0.1, 0.3).unwrap();
        let mut plant = Plant::new(Box::new(model), Leapfrog, 1e-3).unwrap();
        plant.advance(1_000).unwrap();
        plant.hash()
    }
    fn hash<M: dbd_kernel::ModelOwner>(model: &M) -> u64 {
        let mut plant = Plant::new(model, Leapfrog, 1e-3).unwrap();
        plant.advance(1_000).unwrap();
        plant.hash()
    }
    assert_eq!(hash(&DOUBLE), built::<Planar64>());
    assert_eq!(hash(&SINGLE), built::<Planar32>());
    let _: &Model<Planar64, 1, 1, 3, 2, 0, 3, 1, 1, 0, 0, 0, 0, 0, 0, 0, 1> = &DOUBLE;
}
