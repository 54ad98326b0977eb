//! Conversion of models and states between single instances and lanes.
//!
//! `models => model of lanes; states => state of lanes; (state of lanes, lane) => state`. All models have the same
//! structure, see [`crate::alike`].

use dbd_kernel::elements::input::{Input, InputKind, Knot};
use dbd_kernel::elements::source::{Sensor, Source, SourceLaw};
use dbd_kernel::geometry::Float;
use dbd_kernel::lanes::{Lanes, Register};
use dbd_kernel::schedule::Signal;
use dbd_kernel::{
    Body, BodyState, Load, PointBushing, PointOnLine, Quaternion, Real as _, Revolute, State,
    TorsionSpring, Tsda, Universal, Vec3,
};
use dbd_scene::SceneModel;

/// The model of one instance.
pub(crate) type ModelOf<R> = SceneModel<Float<R>>;
/// The model of a register's lanes.
pub(crate) type LanesModel<V> = SceneModel<Float<Lanes<V>>>;

/// A number, a vector and a quaternion of each lane, from `of(lane)`.
fn number<V: Register>(of: impl Fn(usize) -> V::Number) -> Lanes<V> {
    Lanes::new(of)
}

fn vector<V: Register>(of: impl Fn(usize) -> Vec3<V::Number>) -> Vec3<Lanes<V>> {
    Vec3::new(number(|i| of(i).x), number(|i| of(i).y), number(|i| of(i).z))
}

fn quaternion<V: Register>(of: impl Fn(usize) -> Quaternion<V::Number>) -> Quaternion<Lanes<V>> {
    Quaternion { w: number(|i| of(i).w), v: vector(|i| of(i).v) }
}

fn body_state<V: Register>(
    of: impl Fn(usize) -> BodyState<Float<V::Number>>,
) -> BodyState<Float<Lanes<V>>> {
    BodyState {
        position: vector(|i| of(i).position),
        orientation: quaternion(|i| of(i).orientation),
        velocity: vector(|i| of(i).velocity),
        angular_velocity: vector(|i| of(i).angular_velocity),
    }
}

/// The model whose lane i is `models[i]`.
pub(crate) fn model<V: Register>(models: &[&ModelOf<V::Number>]) -> LanesModel<V> {
    let first = models[0];
    /// Iterates over a part of all lanes' models together.
    macro_rules! each {
        ($parts:ident, |$row:ident| $new:expr) => {
            (0..first.$parts.len()).map(|$row| $new).collect()
        };
    }
    SceneModel {
        bodies: each!(bodies, |row| {
            let of = |i: usize| models[i].bodies[row];
            Body {
                mass: number(|i| of(i).mass),
                inertia: vector(|i| of(i).inertia),
                inverse_mass: number(|i| of(i).inverse_mass),
                inverse_inertia: vector(|i| of(i).inverse_inertia),
                ratio: vector(|i| of(i).ratio),
                inverse_ratio: vector(|i| of(i).inverse_ratio),
            }
        }),
        initial: each!(initial, |row| body_state(|i| models[i].initial[row])),
        gravity: each!(gravity, |row| vector(|i| models[i].gravity[row])),
        groups: first.groups.clone(),
        plan: first.plan.clone(),
        // Lanes have no laws: such instances are stepped one by one.
        laws: Default::default(),
        points: each!(points, |row| vector(|i| models[i].points[row])),
        tsdas: each!(tsdas, |row| {
            let of = |i: usize| models[i].tsdas[row];
            Tsda {
                stiffness: number(|i| of(i).stiffness),
                free_length: number(|i| of(i).free_length),
            }
        }),
        bushings: each!(bushings, |row| PointBushing {
            stiffness: number(|i| models[i].bushings[row].stiffness)
        }),
        dampers: each!(dampers, |row| number(|i| models[i].dampers[row])),
        torsions: each!(torsions, |row| {
            let of = |i: usize| &models[i].torsions[row];
            TorsionSpring {
                a: of(0).a,
                b: of(0).b,
                axis: vector(|i| of(i).axis),
                reference: quaternion(|i| of(i).reference),
                stiffness: number(|i| of(i).stiffness),
                preload: number(|i| of(i).preload),
                damper: of(0).damper,
            }
        }),
        loads: each!(loads, |row| {
            let of = |i: usize| &models[i].loads[row];
            Load {
                body: of(0).body,
                frame: of(0).frame,
                force: vector(|i| of(i).force),
                torque: vector(|i| of(i).torque),
                from: of(0).from,
                until: of(0).until,
            }
        }),
        lines: each!(lines, |row| {
            let of = |i: usize| models[i].lines[row];
            PointOnLine {
                direction: vector(|i| of(i).direction),
                stiffness: number(|i| of(i).stiffness),
                free_length: number(|i| of(i).free_length),
            }
        }),
        inputs: each!(inputs, |row| input(|i| &models[i].inputs[row])),
        knots: each!(knots, |row| {
            let of = |i: usize| &models[i].knots[row];
            Knot {
                time: of(0).time,
                value: number(|i| of(i).value),
                slope: number(|i| of(i).slope),
            }
        }),
        clearances: each!(clearances, |row| number(|i| models[i].clearances[row])),
        revolutes: each!(revolutes, |row| {
            let of = |i: usize| models[i].revolutes[row];
            Revolute {
                stiffness: number(|i| of(i).stiffness),
                along: number(|i| of(i).along),
                levers: [vector(|i| of(i).levers[0]), vector(|i| of(i).levers[1])],
            }
        }),
        universals: each!(universals, |row| {
            let of = |i: usize| models[i].universals[row];
            Universal {
                stiffness: number(|i| of(i).stiffness),
                lever: vector(|i| of(i).lever),
                axis: vector(|i| of(i).axis),
            }
        }),
        sources: each!(sources, |row| source(|i| &models[i].sources[row])),
    }
}

fn source<'m, V: Register>(
    of: impl Fn(usize) -> &'m Source<Float<V::Number>>,
) -> Source<Float<Lanes<V>>> {
    // Amplitude, its rate and the offset, or weights and offset.
    let numbers = |i: usize| match of(i).law {
        SourceLaw::Sine { amplitude, rate, offset, .. } => [amplitude, rate, offset, offset],
        SourceLaw::Periodic { .. } => [V::Number::ZERO; 4],
        SourceLaw::Over { weights: [x, y, z], offset, .. } => [x, y, z, offset],
    };
    let [x, y, z, last] = core::array::from_fn(|row| number(|i| numbers(i)[row]));
    let read = |i: usize| match of(i).law {
        SourceLaw::Over { sensor: Sensor::Angle { offset, .. }, .. } => (Vec3::default(), offset),
        SourceLaw::Over {
            sensor: Sensor::Point { point, .. } | Sensor::Velocity { point, .. },
            ..
        } => (point, V::Number::ZERO),
        _ => (Vec3::default(), V::Number::ZERO),
    };
    let law = match of(0).law {
        SourceLaw::Sine { period, phase, .. } => {
            SourceLaw::Sine { period, phase, amplitude: x, rate: y, offset: z }
        }
        SourceLaw::Periodic { period } => SourceLaw::Periodic { period },
        SourceLaw::Over { sensor, .. } => {
            let point = vector(|i| read(i).0);
            let sensor = match sensor {
                Sensor::Angle { spring, .. } => {
                    Sensor::Angle { spring, offset: number(|i| read(i).1) }
                }
                Sensor::Rate { spring } => Sensor::Rate { spring },
                Sensor::Point { body, .. } => Sensor::Point { body, point },
                Sensor::Velocity { body, .. } => Sensor::Velocity { body, point },
            };
            SourceLaw::Over { sensor, weights: [x, y, z], offset: last }
        }
    };
    let Source { input, knot, knots, .. } = *of(0);
    Source { input, knot, knots, law }
}

fn input<'m, V: Register>(
    of: impl Fn(usize) -> &'m Input<Float<V::Number>>,
) -> Input<Float<Lanes<V>>> {
    // The vectors of its kind: point and direction, axis, or none.
    let vectors = |i: usize| match of(i).kind {
        InputKind::Force { point, direction, .. } => [point, direction],
        InputKind::Torque { axis, .. } => [axis; 2],
        InputKind::JointTorque { axes, .. } => axes,
        InputKind::JointForce { point, axis, .. } => [point, axis],
        InputKind::Gravity { direction } | InputKind::Anchor { direction } => [direction; 2],
        InputKind::Velocity { direction: axis, .. } | InputKind::AngularVelocity { axis, .. } => {
            [axis; 2]
        }
        InputKind::Actuator { .. } | InputKind::Signal => [Vec3::default(); 2],
    };
    let (point, axis) = (vector(|i| vectors(i)[0]), vector(|i| vectors(i)[1]));
    let kind = match of(0).kind {
        InputKind::Force { body, frame, .. } => {
            InputKind::Force { body, point, direction: axis, frame }
        }
        InputKind::Torque { body, frame, .. } => InputKind::Torque { body, axis, frame },
        InputKind::JointTorque { a, b, .. } => InputKind::JointTorque { a, b, axes: [point, axis] },
        InputKind::JointForce { a, b, .. } => InputKind::JointForce { a, b, point, axis },
        InputKind::Actuator { group, element } => InputKind::Actuator { group, element },
        InputKind::Velocity { body, .. } => InputKind::Velocity { body, direction: axis },
        InputKind::AngularVelocity { body, .. } => InputKind::AngularVelocity { body, axis },
        InputKind::Signal => InputKind::Signal,
        InputKind::Gravity { .. } => InputKind::Gravity { direction: axis },
        InputKind::Anchor { .. } => InputKind::Anchor { direction: axis },
    };
    let Input { knot, knots, .. } = *of(0);
    let range = [0, 1].map(|end| number(|i| of(i).range[end]));
    Input { kind, value: number(|i| of(i).value), knot, knots, range }
}

/// The state whose lane i is `states[i]`; all are at the same step.
pub(crate) fn state<V: Register>(states: &[&State<ModelOf<V::Number>>]) -> State<LanesModel<V>> {
    let first = states[0];
    State {
        bodies: (0..first.bodies.len()).map(|row| body_state(|i| states[i].bodies[row])).collect(),
        turns: (0..first.turns.len())
            .flat_map(|row| states.iter().map(move |state| state.turns[row]))
            .collect(),
        laws: Vec::new(),
        step: first.step,
        signals: (0..first.signals.len())
            .map(|row| Signal {
                value: number(|i| states[i].signals[row].value),
                rate: number(|i| states[i].signals[row].rate),
            })
            .collect(),
    }
}

/// The state in a lane.
pub(crate) fn lane<V: Register>(
    state: &State<LanesModel<V>>,
    lane: usize,
) -> State<ModelOf<V::Number>> {
    let vector = |v: Vec3<Lanes<V>>| Vec3::new(v.x.lane(lane), v.y.lane(lane), v.z.lane(lane));
    State {
        bodies: state
            .bodies
            .iter()
            .map(|body| BodyState {
                position: vector(body.position),
                orientation: Quaternion {
                    w: body.orientation.w.lane(lane),
                    v: vector(body.orientation.v),
                },
                velocity: vector(body.velocity),
                angular_velocity: vector(body.angular_velocity),
            })
            .collect(),
        turns: state.turns.iter().skip(lane).step_by(V::LANES).copied().collect(),
        laws: Vec::new(),
        step: state.step,
        signals: state
            .signals
            .iter()
            .map(|signal| Signal { value: signal.value.lane(lane), rate: signal.rate.lane(lane) })
            .collect(),
    }
}
