//! A mechanism: bodies, a field of gravity and a list of boxed elements.
//!
//! `model's data => mechanism; (state, time) => accelerations`. Newton and Euler per body; every element computes its
//! own points.

use dbd_kernel::elements::input::InputKind as KernelInput;
use dbd_kernel::elements::source::SourceLaw;
use dbd_kernel::model::{Group, Law as GroupLaw, ModelRef, Terms};
use dbd_kernel::{BodyIndex, F64, ModelOwner, State as KernelState};
use dbd_scene::Scene;
use nalgebra::Vector3;

use crate::reference::driven::{Input, InputKind, Load, Sensor};
use crate::reference::elements::{
    Element, Law, Pair, PointBushing, PointOnLine, Revolute, TorsionSpring, Tsda, Universal, unit,
};
use crate::reference::instant::{Body, End, Instant, Point, Wrench};
use crate::reference::signals::{Clock, Signal, Table};
use crate::reference::state::State;

/// How a body's velocities change.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub struct Acceleration {
    /// \[m/s²\] world axes.
    pub linear: Vector3<f64>,
    /// \[rad/s²\] body axes.
    pub angular: Vector3<f64>,
}

/// A mechanism.
pub struct Mechanism {
    /// Its bodies.
    pub bodies: Vec<Body>,
    /// \[m/s²\].
    pub gravity: Vector3<f64>,
    /// Elements, loads and inputs.
    pub elements: Vec<Box<dyn Element>>,
    torsions: Vec<TorsionSpring>,
    tables: Vec<Table>,
    sensors: Vec<Sensor>,
    anchors: Vec<Vector3<f64>>,
    jumps: Vec<f64>,
}

impl Mechanism {
    /// The mechanism of a scene and its state at t = 0.
    #[must_use]
    pub fn of(scene: &Scene) -> (Self, State) {
        Self::of_model(&*scene.in_world())
    }

    /// The mechanism of a model and its state at t = 0.
    pub fn of_model<M: ModelOwner<Precision = F64>>(model: &M) -> (Self, State) {
        let state = State::of(&KernelState::initial(model));
        (Self::read(&model.view()), state)
    }

    fn read<T: Terms<F64>>(model: &ModelRef<'_, F64, T>) -> Self {
        let mut elements: Vec<Box<dyn Element>> = Vec::new();
        for load in model.loads {
            elements.push(Box::new(Load {
                end: end(load.body),
                frame: load.frame,
                force: Vector3::from(load.force.to_f64()),
                torque: Vector3::from(load.torque.to_f64()),
                window: [load.from, load.until],
            }));
        }
        let mut anchors = Vec::new();
        for (row, input) in model.inputs.iter().enumerate() {
            let direction = match input.kind {
                KernelInput::Anchor { direction } => Vector3::from(direction.to_f64()),
                _ => Vector3::zeros(),
            };
            anchors.push(direction);
            if let Some(kind) = input_kind(model, &input.kind) {
                elements.push(Box::new(Input { row, kind }));
            }
        }
        for group in model.groups {
            elements.extend((0..group.elements()).map(|i| element(model, group, i)));
        }
        let torsions = (0..model.torsions.len()).map(|row| torsion(model, row)).collect();
        for row in 0..model.torsions.len() {
            elements.push(Box::new(torsion(model, row)));
        }
        let mut tables: Vec<_> = model.inputs.iter().map(|i| Table::of(i, model.knots)).collect();
        let mut sensors = Vec::new();
        for source in model.sources {
            let row = usize::from(source.input.0);
            match source.law {
                SourceLaw::Over { sensor, weights, offset } => {
                    let curve = source.knots_of(model.knots).to_vec();
                    sensors.push(Sensor { row, sensor, weights, offset, curve });
                }
                _ => tables[row] = Table::of_source(source, model.knots),
            }
        }
        let mut jumps: Vec<f64> = model.loads.iter().flat_map(|l| [l.from, l.until]).collect();
        jumps.retain(|time| time.is_finite() && *time > 0.0);
        Self {
            bodies: model
                .bodies
                .iter()
                .map(|b| Body {
                    mass: b.mass,
                    inertia: Vector3::from(b.inertia.to_f64()),
                    driven: b.is_driven(),
                })
                .collect(),
            gravity: model.gravity.iter().map(|g| Vector3::from(g.to_f64())).sum(),
            elements,
            torsions,
            tables,
            sensors,
            anchors,
            jumps,
        }
    }

    /// \[s\] the times after 0, from the first of `window` on and before the second, at which a load or a
    /// table jumps, ascending.
    #[must_use]
    pub fn jumps(&self, window: [f64; 2]) -> Vec<f64> {
        let [from, until] = window;
        let loads = self.jumps.iter().copied().filter(|time| (from..until).contains(time));
        let tables = self.tables.iter().flat_map(|table| table.jumps(window));
        let mut jumps: Vec<f64> = loads.chain(tables).filter(|time| *time > 0.0).collect();
        jumps.sort_by(f64::total_cmp);
        jumps.dedup();
        jumps
    }

    /// Poses and motion at a time.
    #[must_use]
    pub fn at<'s>(&'s self, state: &'s State, clock: Clock) -> Instant<'s> {
        let signals = self.tables.iter().map(|table| table.at(clock)).collect();
        let mut at = Instant::new(state, clock, signals, &self.anchors);
        for sensor in &self.sensors {
            let value = sensor.value(&at, &self.torsions);
            at.signals[sensor.row] = Signal { value, rate: 0.0 };
        }
        at
    }

    /// The accelerations at an instant.
    #[must_use]
    pub fn respond(&self, at: &Instant<'_>) -> Vec<Acceleration> {
        let weight = |body: &Body| Wrench { force: self.gravity * body.mass, ..Wrench::default() };
        let mut wrenches: Vec<Wrench> = self.bodies.iter().map(weight).collect();
        for element in &self.elements {
            element.act(at, &mut wrenches);
        }
        let rows = self.bodies.iter().zip(&wrenches).enumerate();
        rows.map(|(row, (body, wrench))| {
            if body.driven {
                return Acceleration::default();
            }
            let rate = at.rate(row);
            let spin = body.inertia.component_mul(&rate);
            let torque = at.to_body(row, wrench.torque) - rate.cross(&spin);
            Acceleration {
                linear: wrench.force / body.mass,
                angular: torque.component_div(&body.inertia),
            }
        })
        .collect()
    }

    /// The accelerations in a state at a time \[s\].
    #[must_use]
    pub fn accelerations(&self, state: &State, time: f64) -> Vec<Acceleration> {
        self.respond(&self.at(state, Clock::at(time)))
    }

    /// \[rad/s\] the rates of the torsion angles at an instant.
    pub fn torsion_angle_rates(&self, at: &Instant<'_>) -> impl Iterator<Item = f64> {
        self.torsions.iter().map(|spring| spring.torsion_angle(at).rate)
    }

    /// Updates the last known torsion angles to the pose.
    pub fn settle(&self, state: &mut State) {
        if self.torsions.is_empty() {
            return;
        }
        let at = self.at(state, Clock::at(0.0));
        let torsion_angles =
            self.torsions.iter().map(|spring| spring.torsion_angle(&at).angle).collect();
        state.torsion_angles = torsion_angles;
    }
}

fn end(body: BodyIndex) -> End {
    match body.anchor_row() {
        Some(input) => End::Anchor(input),
        None if body.is_world() => End::World,
        None => End::Body(body.row()),
    }
}

/// The points of element `i` of a group: a spring triple has one point on its first body; the second body's points
/// follow all of them, once or once per triple.
fn pair<T: Terms<F64>>(model: &ModelRef<'_, F64, T>, group: &Group, i: usize) -> Pair {
    let (triples, arms) = (usize::from(group.triples), usize::from(group.arms));
    let first = usize::from(group.point);
    let tip = if group.shared { i % arms } else { i };
    let local = |row: usize| Vector3::from(model.points[row].to_f64());
    let line = (group.law == GroupLaw::PointOnLine)
        .then(|| Vector3::from(model.lines[usize::from(group.element) + i].direction.to_f64()));
    Pair {
        a: Point { end: end(group.a), local: local(first + i / arms) },
        b: Point { end: end(group.b), local: local(first + triples + tip) },
        line,
    }
}

fn element<T: Terms<F64>>(
    model: &ModelRef<'_, F64, T>,
    group: &Group,
    i: usize,
) -> Box<dyn Element> {
    let pair = pair(model, group, i);
    let row = usize::from(group.element) + i;
    let damping = group.damper.row().map_or(0.0, |first| model.dampers[first + i]);
    let clearance = group.clearance.row().map(|row| model.clearances[row]);
    let law = |stiffness, free_length| Law { stiffness, damping, free_length, clearance };
    match group.law {
        GroupLaw::Tsda => {
            let tsda = &model.tsdas[row];
            Box::new(Tsda { pair, law: law(tsda.stiffness, tsda.free_length) })
        }
        GroupLaw::PointBushing => {
            let stiffness = model.bushings[row].stiffness;
            Box::new(PointBushing { pair, stiffness, damping })
        }
        GroupLaw::Revolute => {
            let revolute = &model.revolutes[row];
            let levers = revolute.levers.map(|lever| Vector3::from(lever.to_f64()));
            let ratio = 1.0 + revolute.along * levers[0].norm_squared();
            let stiffness = revolute.stiffness;
            Box::new(Revolute { pair, levers, stiffness, damping, ratio })
        }
        GroupLaw::Universal => {
            let universal = &model.universals[row];
            let [lever, axis] =
                [universal.lever, universal.axis].map(|v| Vector3::from(v.to_f64()));
            Box::new(Universal { pair, lever, axis, stiffness: universal.stiffness, damping })
        }
        GroupLaw::PointOnLine => {
            let line = &model.lines[row];
            Box::new(PointOnLine { pair, law: law(line.stiffness, line.free_length) })
        }
    }
}

fn torsion<T: Terms<F64>>(model: &ModelRef<'_, F64, T>, row: usize) -> TorsionSpring {
    let spring = &model.torsions[row];
    TorsionSpring {
        ends: [end(spring.a), end(spring.b)],
        row,
        axis: Vector3::from(spring.axis.to_f64()),
        reference: unit(spring.reference.to_f64()),
        stiffness: spring.stiffness,
        damping: spring.damper.row().map_or(0.0, |damper| model.dampers[damper]),
        preload: spring.preload,
    }
}

/// The action of an input; `None` for a number read by laws and for an anchor, which moves points instead.
fn input_kind<T: Terms<F64>>(
    model: &ModelRef<'_, F64, T>,
    kind: &KernelInput<F64>,
) -> Option<InputKind> {
    Some(match *kind {
        KernelInput::Force { body, point, direction, frame } => {
            let point = Point { end: end(body), local: Vector3::from(point.to_f64()) };
            InputKind::Force(point, Vector3::from(direction.to_f64()), frame)
        }
        KernelInput::Torque { body, axis, frame } => {
            InputKind::Torque(end(body), Vector3::from(axis.to_f64()), frame)
        }
        KernelInput::JointTorque { a, b, axes } => {
            InputKind::JointTorque([end(a), end(b)], axes.map(|axis| Vector3::from(axis.to_f64())))
        }
        KernelInput::JointForce { a, b, point, axis } => {
            let point = Point { end: end(b), local: Vector3::from(point.to_f64()) };
            InputKind::JointForce(end(a), point, Vector3::from(axis.to_f64()))
        }
        KernelInput::Actuator { group, element } => {
            InputKind::Actuator(pair(model, &model.groups[group.row()], element.into()))
        }
        KernelInput::Gravity { direction } => {
            let masses = model.bodies.iter().map(|body| body.mass).collect();
            InputKind::Gravity(masses, Vector3::from(direction.to_f64()))
        }
        KernelInput::Velocity { .. }
        | KernelInput::AngularVelocity { .. }
        | KernelInput::Signal
        | KernelInput::Anchor { .. } => return None,
    })
}
