//! The target `step`: models of any numbers, built by the kernel's builder and stepped by every
//! scheme.
//!
//! `bytes => model, scheme, step, inputs => steps`. Up to four bodies, every law, torsion springs,
//! lines, loads, inputs, clearances. A plant that runs has a finite state, one that failed stays as
//! it is, and the same steps give the same bits.

use arbitrary::Unstructured;
use dbd_kernel::builder::{LineLaw, ModelBuilder, Triples};
use dbd_kernel::elements::input::InputKind;
use dbd_kernel::energy::energy;
use dbd_kernel::readouts::Readout;
use dbd_kernel::space::Linear as _;
use dbd_kernel::{
    BlanesMoanS6, BodyIndex, BodyState, Dbd, DbdP1, DbdP2, Explicit, F32, F64, Geometry,
    GroupIndex, InputIndex, Leapfrog, Load, LoadFrame, ModelOwner, Pefrl, Plant, Rk4, Scheme,
    SemiImplicitEuler, State, TorsionIndex, frequency,
};
use fastrand::Rng;

use crate::numbers::{Wildness, amount, below, byte, number, one_in, size, triple};
use crate::scene::{RUNNING_IS_FINITE, is_finite};
use crate::target::{Finding, Reach, Target};

/// A model of any parts.
pub type Model<P> = ModelBuilder<P, 4, 6, 40, 36, 4, 40, 3, 3, 6, 4, 12>;

/// Steps of models of any numbers.
pub struct StepTarget;

impl Target for StepTarget {
    fn name(&self) -> &'static str {
        "step"
    }

    fn share(&self) -> f64 {
        0.15
    }

    fn block(&self) -> u64 {
        40_000
    }

    fn input(&self, random: &mut Rng) -> Vec<u8> {
        bytes(random, 400)
    }

    fn execute(&self, input: &[u8]) -> Result<Reach, Finding> {
        let mut bytes = Unstructured::new(input);
        let single = !one_in(&mut bytes, 2);
        if single { any_scheme::<F32>(&mut bytes) } else { any_scheme::<F64>(&mut bytes) }
    }

    fn shown(&self, input: &[u8]) -> String {
        let mut bytes = Unstructured::new(input);
        if !one_in(&mut bytes, 2) {
            shown_model::<F32>(&mut bytes)
        } else {
            shown_model::<F64>(&mut bytes)
        }
    }
}

/// Random bytes, at most so many.
pub fn bytes(random: &mut Rng, most: usize) -> Vec<u8> {
    let mut bytes = vec![0; random.usize(..=most)];
    random.fill(&mut bytes);
    bytes
}

/// What follows the model's bytes.
fn shown_model<P: Geometry>(bytes: &mut Unstructured<'_>) -> String {
    let scheme = byte(bytes) % 10;
    if scheme < 3 {
        // Its Newton iterations.
        byte(bytes);
    }
    let (wildness, model) = model::<P>(bytes);
    format!("{} scheme {scheme}, {wildness:?}, {:#?}", P::NAME, model.view())
}

fn any_scheme<P: Geometry>(bytes: &mut Unstructured<'_>) -> Result<Reach, Finding> {
    let newton = |bytes: &mut Unstructured<'_>| u32::from(byte(bytes) % 9);
    match byte(bytes) % 10 {
        0 => steps::<P, _>(Dbd { newton: newton(bytes) }, bytes),
        1 => steps::<P, _>(DbdP1 { newton: newton(bytes) }, bytes),
        2 => steps::<P, _>(DbdP2 { newton: newton(bytes) }, bytes),
        3 => steps::<P, _>(SemiImplicitEuler, bytes),
        4 => steps::<P, _>(Explicit(SemiImplicitEuler), bytes),
        5 => steps::<P, _>(Leapfrog, bytes),
        6 => steps::<P, _>(Explicit(Leapfrog), bytes),
        7 => steps::<P, _>(Pefrl, bytes),
        8 => steps::<P, _>(BlanesMoanS6, bytes),
        _ => steps::<P, _>(Rk4, bytes),
    }
}

fn steps<P: Geometry, S: Scheme>(
    scheme: S,
    bytes: &mut Unstructured<'_>,
) -> Result<Reach, Finding> {
    let (wildness, model) = model::<P>(bytes);
    // Tame models with a step at which most are stable, too.
    let h = match wildness {
        Wildness::Tame => 1e-3 * amount(bytes, wildness),
        _ => size(bytes, wildness),
    };
    let Ok(mut plant) = Plant::new(&model, scheme, h) else { return Ok(Reach::Refused) };
    let twice = one_in(bytes, 8);
    let rest = bytes.peek_bytes(bytes.len()).unwrap_or_default();
    drive(&mut plant, &mut Unstructured::new(rest), wildness)?;
    if twice {
        let first = plant.hash();
        plant.reset();
        drive(&mut plant, &mut Unstructured::new(rest), wildness)?;
        Finding::unless(plant.hash() == first, "the same steps give the same bits", || {
            format!("{} {}, {:?}", S::NAME, P::NAME, plant.status())
        })?;
    }
    Ok(Reach::Taken)
}

/// Up to eight steps between inputs set, states taken over and sensors read.
fn drive<P: Geometry, S: Scheme>(
    plant: &mut Plant<&Model<P>, S>,
    bytes: &mut Unstructured<'_>,
    wildness: Wildness,
) -> Result<(), Finding> {
    let shown = |plant: &Plant<&Model<P>, S>| {
        let state = plant.state();
        let (step, bodies, signals) = (state.step, &state.bodies, &state.signals);
        format!("{} {}, step {step}, {bodies:?}, {signals:?}", S::NAME, P::NAME)
    };
    for _ in 0..1 + byte(bytes) % 8 {
        match byte(bytes) % 32 {
            0 => {
                let (value, rate) = (number(bytes, wildness), number(bytes, wildness));
                let _ = plant.set_signal(InputIndex(u16::from(byte(bytes) % 5)), value, rate);
            }
            1 => {
                let mut state = plant.state().clone();
                state.step = bytes.arbitrary().unwrap_or(u64::MAX);
                for turns in state.turns.iter_mut() {
                    *turns = bytes.arbitrary().unwrap_or(i32::MAX);
                }
                for body in state.bodies.iter_mut() {
                    body.velocity = P::velocity_from_f64(triple(bytes, wildness));
                }
                let _ = plant.set_state(state);
            }
            2 => readouts(plant, bytes, wildness),
            3 => look::<P>(plant.model(), plant.state()),
            _ => {}
        }
        let status = plant.step();
        let state = plant.state();
        let finite = is_finite(state) && state.signals.iter().all(is_finite);
        Finding::unless(status.is_err() || finite, RUNNING_IS_FINITE, || shown(plant))?;
        if status.is_err() {
            let (hash, again) = (plant.hash(), plant.step());
            let latched = again == status && plant.hash() == hash && plant.status() == status;
            Finding::unless(latched, "a failed plant stays as it is", || shown(plant))?;
            break;
        }
    }
    Ok(())
}

/// Sensors of every kind, on parts that are there or not.
fn readouts<P: Geometry, S: Scheme>(
    plant: &Plant<&Model<P>, S>,
    bytes: &mut Unstructured<'_>,
    wildness: Wildness,
) {
    let body = body(bytes);
    let (row, element) = (u16::from(byte(bytes) % 7), u16::from(byte(bytes) % 10));
    let point = P::local_from_f64(triple(bytes, wildness));
    for readout in [
        Readout::JointAngle { spring: TorsionIndex(row), offset: dbd_kernel::Real::from_f64(0.5) },
        Readout::JointRate { spring: TorsionIndex(row) },
        Readout::Point { body, point },
        Readout::PointVelocity { body, point },
        Readout::TsdaForce { group: GroupIndex(row), element },
        Readout::JointForce { group: GroupIndex(row) },
        Readout::Imu { body, point },
        Readout::Input { input: InputIndex(row) },
    ] {
        let _ = plant.read(&readout);
    }
}

/// What is computed of a state beside its steps.
fn look<P: Geometry>(model: &Model<P>, state: &State<Model<P>>) {
    let _ = energy(model, state, 1e-3);
    let _ = frequency::bound(model, state);
    let _ = frequency::estimate(model, state, 3);
}

/// A body that is there, that is not, the ground or a moved part of it.
fn body(bytes: &mut Unstructured<'_>) -> BodyIndex {
    match byte(bytes) % 16 {
        0..=2 => BodyIndex::WORLD,
        3 => BodyIndex::anchor(InputIndex(u16::from(byte(bytes) % 5))),
        4 => BodyIndex(u16::from(byte(bytes))),
        other => BodyIndex(u16::from(other % 4)),
    }
}

/// A model of any parts; what the builder refuses is left out.
pub fn model<P: Geometry>(bytes: &mut Unstructured<'_>) -> (Wildness, Model<P>) {
    let wild = Wildness::of(bytes);
    let mut model = Model::<P>::new();
    if one_in(bytes, 2) {
        let _ = model.set_gravity(triple(bytes, wild));
    }
    for _ in 0..1 + byte(bytes) % 4 {
        add_body(&mut model, bytes, wild);
    }
    for _ in 0..byte(bytes) % 12 {
        match byte(bytes) % 12 {
            0..=3 => add_triples(&mut model, bytes, wild),
            4 | 5 => add_line(&mut model, bytes, wild),
            6 | 7 => {
                let between = [body(bytes), body(bytes)];
                let axis = triple(bytes, wild);
                let [stiffness, damping] = [size(bytes, wild), size(bytes, wild)];
                let preload = number(bytes, wild);
                let _ = model.add_torsion_spring(between, axis, stiffness, damping, preload);
            }
            8 | 9 => {
                let (from, until) = (number(bytes, wild), number(bytes, wild));
                let _ = model.add_load(Load {
                    body: body(bytes),
                    frame: frame(bytes),
                    force: P::Vector::from_f64(triple(bytes, wild)),
                    torque: P::Moment::from_f64(triple(bytes, wild)),
                    from: 1e-3 * from,
                    until: if one_in(bytes, 2) { f64::INFINITY } else { until },
                });
            }
            _ => add_input(&mut model, bytes, wild),
        }
    }
    (wild, model)
}

fn frame(bytes: &mut Unstructured<'_>) -> LoadFrame {
    if one_in(bytes, 2) { LoadFrame::World } else { LoadFrame::Body }
}

fn add_body<P: Geometry>(model: &mut Model<P>, bytes: &mut Unstructured<'_>, wild: Wildness) {
    let mass = amount(bytes, wild);
    let inertia = if one_in(bytes, 4) {
        std::array::from_fn(|_| amount(bytes, wild))
    } else {
        let [one, factor] = [amount(bytes, wild), f64::from(byte(bytes)) / 255.0];
        [one, one, (0.01 + factor) * one]
    };
    let orientation = if wild == Wildness::Wild && one_in(bytes, 2) {
        std::array::from_fn(|_| number(bytes, wild))
    } else {
        unit(std::array::from_fn(|_| number(bytes, Wildness::Tame)))
    };
    let (position, velocity) = (triple(bytes, wild), triple(bytes, wild));
    let state = BodyState::from_f64(position, orientation, velocity, triple(bytes, wild));
    let _ = model.add_body(mass, inertia, state);
}

fn unit(q: [f64; 4]) -> [f64; 4] {
    let norm = q.iter().map(|c| c * c).sum::<f64>().sqrt();
    if norm > 1e-3 { q.map(|c| c / norm) } else { [1.0, 0.0, 0.0, 0.0] }
}

/// Stiff enough to vibrate within some steps.
fn stiffness(bytes: &mut Unstructured<'_>, wild: Wildness) -> f64 {
    size(bytes, wild) * [1.0, 1e2, 1e4, 1e6][below(bytes, 4)]
}

/// Where there is none, there is none in most models.
fn now_and_then(bytes: &mut Unstructured<'_>, wild: Wildness) -> f64 {
    if one_in(bytes, 4) { size(bytes, wild) } else { 0.0 }
}

fn add_triples<P: Geometry>(model: &mut Model<P>, bytes: &mut Unstructured<'_>, wild: Wildness) {
    let points: [[f64; 3]; 12] = std::array::from_fn(|i| {
        // A joint's points, most of them read from the input.
        if i < 4 || wild == Wildness::Wild {
            triple(bytes, wild)
        } else {
            [0.1 * i as f64, -0.05 * (i % 3) as f64, 0.02]
        }
    });
    let (centres, arms) =
        [(1, 1), (1, 3), (2, 3), (2, 6), (2, 2), (3, 9), (0, 0), (2, 1)][below(bytes, 8)];
    let _ = model.add_triples(Triples {
        between: [body(bytes), body(bytes)],
        centres: &points[..centres],
        arms: &points[centres..centres + arms],
        stiffness: stiffness(bytes, wild),
        damping: size(bytes, wild) * [0.0, 1.0, 1e2, 1e4][below(bytes, 4)],
        free_length: if one_in(bytes, 4) { 0.0 } else { size(bytes, wild) },
        clearance: now_and_then(bytes, wild),
    });
}

fn add_line<P: Geometry>(model: &mut Model<P>, bytes: &mut Unstructured<'_>, wild: Wildness) {
    let between = [body(bytes), body(bytes)];
    let (point, direction) = (triple(bytes, wild), triple(bytes, wild));
    let points = [triple(bytes, wild), triple(bytes, wild)];
    let count = 1 + below(bytes, 2);
    let law = LineLaw {
        stiffness: stiffness(bytes, wild),
        damping: now_and_then(bytes, wild),
        free_length: now_and_then(bytes, wild),
        clearance: now_and_then(bytes, wild),
    };
    let _ = model.add_points_on_line(between, point, direction, &points[..count], law);
}

fn add_input<P: Geometry>(model: &mut Model<P>, bytes: &mut Unstructured<'_>, wild: Wildness) {
    let along = triple(bytes, wild);
    let (direction, axis) = (P::Vector::from_f64(along), P::Moment::from_f64(along));
    let (one, frame) = (body(bytes), frame(bytes));
    let kind = match byte(bytes) % 6 {
        0 => {
            let point = P::local_from_f64(triple(bytes, wild));
            InputKind::Force { body: one, point, direction, frame }
        }
        1 => InputKind::Torque { body: one, axis, frame },
        2 => InputKind::JointTorque { a: one, b: body(bytes), axes: [axis; 2] },
        3 => InputKind::Actuator {
            group: GroupIndex(u16::from(byte(bytes) % 4)),
            element: u16::from(byte(bytes) % 4),
        },
        4 => InputKind::Anchor { direction },
        _ => InputKind::Gravity { direction },
    };
    if one_in(bytes, 2) {
        let _ = model.add_input(kind, number(bytes, wild));
        return;
    }
    let mut time = 1e-3 * number(bytes, wild);
    let mut table = [[0.0; 2]; 3];
    for knot in &mut table {
        *knot = [time, number(bytes, wild)];
        time += 1e-3 * amount(bytes, wild);
    }
    let count = 1 + below(bytes, 3);
    let _ = model.add_table(kind, &table[..count], one_in(bytes, 2));
}
