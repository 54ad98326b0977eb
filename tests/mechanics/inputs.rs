//! Inputs against closed forms, and what may not be set.

use dbd_kernel::builder::{BuildError, Quantity};
use dbd_kernel::elements::input::{Input, InputKind};
use dbd_kernel::index::{ClearanceIndex, DamperIndex};
use dbd_kernel::model::{Group, Law, ModelOwner as _};
use dbd_kernel::plant::InputError;
use dbd_kernel::space::Linear as _;
use dbd_kernel::{
    Body, BodyIndex, Dbd, F32, F64, Fixed, Geometry, GroupIndex, InputIndex, JointWise, Leapfrog,
    LoadFrame, Model, Plant, Real as _, Scheme, Tsda, Vec3,
};
use dbd_tests::{Bench, at, free_ring, hung_ring, momenta, uneven_ring};

const X: Vec3<f64> = Vec3::new(1.0, 0.0, 0.0);

#[test]
fn a_force_at_a_point_pushes_and_turns() {
    let mut model = Bench::<F64>::new();
    let body = model.add_body(2.0, [0.1, 0.2, 0.25], at([0.0; 3])).unwrap();
    let point = Vec3::new(0.0, 0.5, 0.0);
    let kind = InputKind::Force { body, point, direction: X, frame: LoadFrame::Body };
    let push = model.add_input(kind, 0.0).unwrap();
    let axis = Vec3::new(0.0, 0.0, 1.0);
    let kind = InputKind::Torque { body, axis, frame: LoadFrame::World };
    let torsion_angle = model.add_input(kind, 0.0).unwrap();
    let mut plant = Plant::new(&model, Leapfrog, 1e-3).unwrap();
    // The torque cancels the force's moment −0.5·F, so the body slides without turning.
    plant.set_input(push, 4.0).unwrap();
    plant.set_input(torsion_angle, 2.0).unwrap();
    plant.advance(500).unwrap();
    let state = plant.state().bodies[0];
    assert!((state.velocity.x - 1.0).abs() < 1e-12 && state.angular_velocity.z.abs() < 1e-12);
    assert!((state.position.x - 0.25).abs() < 1e-12);
    // Held until set again; then the force alone turns it at −F·0.5/Iz.
    plant.set_input(torsion_angle, 0.0).unwrap();
    plant.advance(1).unwrap();
    let rate = plant.state().bodies[0].angular_velocity.z;
    assert!((rate + 4.0 * 0.5 / 0.25 * 1e-3).abs() < 1e-9, "{rate}");
}

#[test]
fn inputs_between_two_bodies_keep_the_momentum() {
    let mut model = free_ring::<F64>(0.0);
    let [a, b] = [BodyIndex(0), BodyIndex(1)];
    let axis = Vec3::new(0.0, 0.6, 0.8);
    let turn = model.add_input(InputKind::JointTorque { a, b, axes: [axis; 2] }, 3.0).unwrap();
    let point = Vec3::new(0.1, -0.2, 0.3);
    model.add_input(InputKind::JointForce { a, b, point, axis }, 5.0).unwrap();
    // Group 2 is the raw TSDA between the third body and the first.
    let pull =
        model.add_input(InputKind::Actuator { group: GroupIndex(2), element: 0 }, 0.0).unwrap();
    let masses: [_; 3] = std::array::from_fn(|i| {
        let body = &dbd_kernel::ModelOwner::view(&model).bodies[i];
        (body.mass, body.inertia.to_f64())
    });
    let mut plant = Plant::new(&model, Leapfrog, 1e-4).unwrap();
    let (p0, l0) = momenta(&masses, &plant.state().bodies);
    plant.set_input(pull, 25.0).unwrap();
    plant.advance(2_000).unwrap();
    plant.set_input(turn, -3.0).unwrap();
    plant.advance(2_000).unwrap();
    let (p, l) = momenta(&masses, &plant.state().bodies);
    for residue in (p - p0).to_f64().into_iter().chain((l - l0).to_f64()) {
        assert!(residue.abs() < 1e-11, "{residue:e}");
    }
}

#[test]
fn an_actuator_pulls_its_points_together() {
    let mut model = Bench::<F64>::new();
    let body = model.add_body(2.0, [0.1; 3], at([1.0, 0.0, 0.0])).unwrap();
    model.add_tsda([BodyIndex::WORLD, body], [[0.0; 3]; 2], 0.0, 0.0, 1.0).unwrap();
    let kind = InputKind::Actuator { group: GroupIndex(0), element: 0 };
    let table = [[0.0, 8.0], [0.05, 0.0]];
    model.add_table(kind, &table, false).unwrap();
    let mut plant = Plant::new(&model, Leapfrog, 1e-3).unwrap();
    plant.advance(100).unwrap();
    // 8 N for 0.05 s on 2 kg.
    assert!((plant.state().bodies[0].velocity.x + 0.2).abs() < 1e-12);
}

/// The largest error of a mass on a spring and damper whose other end moves at a constant speed:
/// with y the mass' distance from the moving rest, ÿ + 2ζω·ẏ + ω²·y = 0, y(0) = 0, ẏ(0) = −v.
fn moving_base<P: Geometry, S: Scheme>(scheme: S, damping: f64) -> f64 {
    let (mass, stiffness, speed) = (2.0, 50.0, 0.3);
    let mut model = Bench::<P>::new();
    let body = model.add_body(mass, [0.1; 3], at([0.0; 3])).unwrap();
    let direction = P::Vector::from_f64([1.0, 0.0, 0.0]);
    let table = [[0.0, 0.0], [2.0, 2.0 * speed]];
    let road = model.add_table(InputKind::Anchor { direction }, &table, true).unwrap();
    let between = [BodyIndex::anchor(road), body];
    model.add_tsda(between, [[-1.0, 0.0, 0.0], [0.0; 3]], stiffness, damping, 1.0).unwrap();
    let omega = (stiffness / mass).sqrt();
    let zeta = damping / (2.0 * mass * omega);
    let damped = omega * (1.0 - zeta * zeta).sqrt();
    let mut plant = Plant::new(&model, scheme, 1e-3).unwrap();
    let mut worst = 0.0_f64;
    for n in 1..=1_500 {
        plant.step().unwrap();
        let t = 1e-3 * f64::from(n);
        let y = -speed / damped * (-zeta * omega * t).exp() * (damped * t).sin();
        let x = P::position_to_f64(&plant.state().bodies[0].position)[0];
        worst = worst.max((x - speed * t - y).abs());
    }
    worst
}

#[test]
fn a_moving_anchor_drives_springs_and_dampers() {
    // Leapfrog: a phase error of (ω·h)²/24 per radian, 4.7e-7 of the 0.06 m. dbd holds the anchor
    // over a step, so that it lags by half a step on average, 0.3 m/s · 0.5 ms.
    for damping in [0.0, 6.0] {
        let error = moving_base::<F64, _>(Leapfrog, damping);
        assert!(error < 5e-7, "leapfrog, {damping}: {error:e}");
        let error = moving_base::<F64, _>(Dbd::default(), damping);
        assert!(error < 6e-4, "dbd, {damping}: {error:e}");
        let error = moving_base::<F32, _>(Leapfrog, damping);
        assert!(error < 2e-6, "f32, {damping}: {error:e}");
    }
}

#[test]
fn what_is_not_an_input_or_not_finite_is_refused_and_changes_nothing() {
    let mut model = free_ring::<F64>(0.0);
    let axis = Vec3::new(0.0, 0.0, 1.0);
    let body = BodyIndex(0);
    let kind = InputKind::Torque { body, axis, frame: LoadFrame::World };
    let free = model.add_input(kind, 0.5).unwrap();
    let table = model.add_table(kind, &[[0.0, 0.1]], false).unwrap();
    let mut plant = Plant::new(&model, Leapfrog, 1e-3).unwrap();
    plant.advance(10).unwrap();
    let before = (plant.hash(), plant.state().signals.clone());
    assert_eq!(plant.set_input(free, f64::NAN), Err(InputError::NotFinite(free)));
    assert_eq!(plant.set_signal(free, 0.0, f64::INFINITY), Err(InputError::NotFinite(free)));
    assert_eq!(plant.set_input(table, 1.0), Err(InputError::Table(table)));
    let none = InputIndex(2);
    assert_eq!(plant.set_input(none, 1.0), Err(InputError::Unknown(none)));
    assert_eq!((plant.hash(), plant.state().signals.clone()), before);
}

/// A controller in single precision hands over its own numbers; those in double precision are
/// rounded to the same.
#[test]
fn an_input_is_set_in_the_plants_number_or_in_double_precision() {
    fn driven<P: Geometry>(set: impl Fn(&mut Driven<P>)) -> u64 {
        let mut model = free_ring::<P>(0.0);
        let (axis, body) = (P::Moment::from_f64([0.0, 0.0, 1.0]), BodyIndex(0));
        let kind = InputKind::Torque { body, axis, frame: LoadFrame::World };
        model.add_input(kind, 0.0).unwrap();
        let mut plant = Plant::new(Box::new(model), Leapfrog, 1e-3).unwrap();
        set(&mut plant);
        plant.advance(10).unwrap();
        plant.hash()
    }
    type Driven<P> = Plant<Box<Bench<P>>, Leapfrog>;
    let free = InputIndex(0);
    let single = driven::<F32>(|plant| plant.set_input_real(free, 0.1).unwrap());
    assert_eq!(single, driven::<F32>(|plant| plant.set_input(free, 0.1).unwrap()));
    assert_ne!(single, driven::<F32>(|plant| plant.set_input_real(free, 0.2).unwrap()));
    let double = driven::<F64>(|plant| plant.set_input_real(free, 0.1).unwrap());
    assert_eq!(double, driven::<F64>(|plant| plant.set_input(free, 0.1).unwrap()));
    driven::<F32>(|plant| {
        let refused = Err(InputError::NotFinite(free));
        assert_eq!(plant.set_signal_real(free, 0.0, f32::NAN), refused);
    });
}

/// A controller sets inputs in every step: one evaluation per step, with the bits of a plant that evaluates twice.
#[test]
fn an_input_set_in_every_step_costs_no_evaluation() {
    /// With all inputs, which act on every body, and with the first of them.
    fn is_kept<P: Geometry, S: Scheme>(scheme: S, model: &Bench<P>) {
        let [a, b] = [BodyIndex(0), BodyIndex(1)];
        let axis = P::Moment::from_f64([0.0, 0.6, 0.8]);
        let (point, direction) =
            (P::local_from_f64([0.1, 0.2, 0.0]), P::Vector::from_f64([0.0, 1.0, 0.0]));
        let inputs = [
            InputKind::Force { body: b, point, direction, frame: LoadFrame::Body },
            InputKind::JointTorque { a, b, axes: [axis; 2] },
            InputKind::Actuator { group: GroupIndex(2), element: 0 },
        ];
        for count in [1, inputs.len()] {
            let mut model = model.clone();
            let inputs: Vec<InputIndex> =
                inputs[..count].iter().map(|kind| model.add_input(*kind, 0.0).unwrap()).collect();
            let mut plant = Plant::new(&model, scheme, 1e-4).unwrap();
            let mut twice = Plant::new(&model, scheme, 1e-4).unwrap();
            for i in 0..200 {
                // Not in each: what was prepared for a step serves the next.
                for plant in [&mut plant, &mut twice].into_iter().filter(|_| i % 4 != 3) {
                    for (input, scale) in inputs.iter().zip([-0.1, 0.01, 1.0]) {
                        plant.set_input(*input, scale * f64::from(i % 7)).unwrap();
                    }
                }
                twice.resume(twice.state().clone());
                plant.step().unwrap();
                twice.step().unwrap();
                assert_eq!(plant.hash(), twice.hash(), "{} step {i}", P::NAME);
            }
            assert_eq!(plant.evaluations(), 201, "{}", P::NAME);
        }
    }
    for damping in [0.0, 3.0] {
        is_kept(Leapfrog, &free_ring::<F64>(damping));
        is_kept(Leapfrog, &free_ring::<F32>(damping));
        is_kept(Leapfrog, &free_ring::<Fixed>(damping));
        is_kept(JointWise(Leapfrog), &hung_ring::<F64>(damping));
        is_kept(JointWise(Leapfrog), &uneven_ring::<F32>(damping));
        is_kept(JointWise(Leapfrog), &hung_ring::<Fixed>(damping));
    }
}

#[test]
fn setting_a_value_costs_no_evaluation() {
    let mut model = free_ring::<F64>(0.0);
    let kind = InputKind::Actuator { group: GroupIndex(2), element: 0 };
    let pull = model.add_input(kind, 1.0).unwrap();
    let mut plant = Plant::new(&model, Leapfrog, 1e-3).unwrap();
    for _ in 0..10 {
        plant.set_input(pull, 1.0).unwrap();
        plant.step().unwrap();
    }
    assert_eq!(plant.evaluations(), 11);
    plant.set_input(pull, 2.0).unwrap();
    plant.step().unwrap();
    assert_eq!(plant.evaluations(), 12);
}

#[test]
fn tables_that_a_precision_cannot_hold_are_refused_in_it() {
    let kind = InputKind::Anchor { direction: X };
    let single = InputKind::Anchor { direction: Vec3::from_f64([1.0, 0.0, 0.0]) };
    for (table, linear) in [
        // A slope, a value, a rise between values, a time of f64 only.
        (&[[0.0, 0.0], [1e-30, 1e10]], true),
        (&[[0.0, 0.0], [1.0, 1e300]], false),
        (&[[0.0, -3e38], [10.0, 3e38]], true),
        (&[[-1e300, 0.0], [1.0, 1.0]], true),
        (&[[-1e300, 0.0], [1.0, 1.0]], false),
    ] {
        let mut double = Bench::<F64>::new();
        double.add_table(kind, table, linear).unwrap();
        let mut model = Bench::<F32>::new();
        let refused = Err(BuildError::OutOfRange(Quantity::Load));
        assert_eq!(model.add_table(single, table, linear), refused, "{table:?} {linear}");
    }
    let refused = Err(BuildError::OutOfRange(Quantity::Load));
    assert_eq!(Bench::<F32>::new().add_input(single, 1e300), refused);
    // What they hold, they hold: steep, early and held beyond all times.
    let mut model = Bench::<F32>::new();
    model.add_table(single, &[[-1e30, 0.0], [0.0, 1e10], [1e300, 2e10]], false).unwrap();
}

/// A const model whose spring hangs from ground that input `row` moves; its one input is a force.
fn hung_from(row: u16) -> Model<F64, 1, 1, 2, 1, 0, 0, 0, 0, 0, 0, 1> {
    let body = BodyIndex(0);
    let kind = InputKind::Force { body, point: Vec3::ZERO, direction: X, frame: LoadFrame::World };
    Model {
        bodies: [Body::from_f64(1.0, [0.1; 3])],
        initial: [at([1.0, 0.0, 0.0])],
        gravity: [],
        groups: [Group {
            law: Law::Tsda,
            a: BodyIndex::anchor(InputIndex(row)),
            b: body,
            triples: 1,
            arms: 1,
            shared: false,
            point: 0,
            element: 0,
            damper: DamperIndex::NONE,
            clearance: ClearanceIndex::NONE,
        }],
        points: [Vec3::ZERO; 2],
        tsdas: [Tsda { stiffness: 50.0, free_length: 1.0 }],
        bushings: [],
        dampers: [],
        torsions: [],
        loads: [],
        lines: [],
        inputs: [Input {
            kind,
            value: 0.0,
            knot: 0,
            knots: 0,
            range: [-f64::INFINITY, f64::INFINITY],
        }],
        knots: [],
        clearances: [],
        revolutes: [],
        universals: [],
        sources: [],
        laws: (),
    }
}

#[test]
#[should_panic(expected = "the input of an anchor does not exist")]
fn a_const_model_with_an_anchor_of_no_input_is_refused() {
    let _ = hung_from(1).checked();
}

#[test]
#[should_panic(expected = "the input of an anchor does not move the ground")]
fn a_const_model_with_an_anchor_of_another_input_is_refused() {
    let _ = hung_from(0).checked();
}

/// However long after its last knot, and whatever the step: nothing is added to what is held.
#[test]
fn a_table_holds_its_last_value_for_ever() {
    fn held<P: Geometry>(step: f64, linear: bool) {
        let mut model = Bench::<P>::new();
        let body = model.add_body(1.0, [0.1; 3], at([0.0; 3])).unwrap();
        let axis = P::Moment::from_f64([0.0, 0.0, 1.0]);
        let kind = InputKind::Torque { body, axis, frame: LoadFrame::World };
        model.add_table(kind, &[[0.0, 1.0], [1.0, 0.0]], linear).unwrap();
        let mut plant = Plant::new(&model, Leapfrog, step).unwrap();
        let mut state = plant.state().clone();
        // As many steps as take longer than the number can hold seconds.
        state.step = 1_000_000_000_000;
        plant.set_state(state).unwrap();
        assert!(plant.advance(3).is_ok(), "{}", P::NAME);
        assert!(plant.state().signals[0].value.to_f64() == 0.0, "{}", P::NAME);
    }
    for linear in [false, true] {
        held::<F64>(1e300, linear);
        held::<F32>(1e30, linear);
    }
}

#[test]
fn a_direction_that_is_not_finite_is_refused() {
    let mut model = Bench::<F32>::new();
    let body = model.add_body(1.0, [0.1; 3], at([0.0; 3])).unwrap();
    let frame = LoadFrame::World;
    for lost in [f32::NAN, f32::INFINITY] {
        let (good, lost) = (Vec3::new(1.0, 0.0, 0.0), Vec3::new(0.0, lost, 0.0));
        let axis = BuildError::OutOfRange(Quantity::Axis);
        let point = BuildError::OutOfRange(Quantity::Point);
        for (kind, error) in [
            (InputKind::Force { body, point: good, direction: lost, frame }, axis),
            (InputKind::Force { body, point: lost, direction: good, frame }, point),
            (InputKind::Torque { body, axis: lost, frame }, axis),
            (InputKind::JointTorque { a: BodyIndex::WORLD, b: body, axes: [good, lost] }, axis),
            (InputKind::JointForce { a: BodyIndex::WORLD, b: body, point: good, axis: lost }, axis),
            (
                InputKind::JointForce { a: BodyIndex::WORLD, b: body, point: lost, axis: good },
                point,
            ),
            (InputKind::Anchor { direction: lost }, axis),
        ] {
            assert_eq!(model.add_input(kind, 1.0), Err(error));
        }
    }
    assert!(model.view().inputs.is_empty());
}
