//! Rows of a model's slices as Rust expressions.
//!
//! `element => source`. Every number is its bit pattern.

use dbd_kernel::elements::input::{Input, InputKind, Knot};
use dbd_kernel::elements::source::{Sensor, Source, SourceLaw};
use dbd_kernel::index::{BodyIndex, DamperIndex};
use dbd_kernel::model::Group;
use dbd_kernel::readouts::{Readout, Slide};
use dbd_kernel::{
    Body, BodyState, Load, LoadFrame, PointBushing, PointOnLine, Revolute, TorsionSpring, Tsda,
    Universal,
};

use super::number::{SourceGeometry, SourceNumber};

pub(super) fn list<T>(items: &[T], item: impl Fn(&T) -> String) -> String {
    if items.is_empty() {
        return "[]".into();
    }
    let items: Vec<_> = items.iter().map(|i| format!("        {},\n", item(i))).collect();
    format!("[\n{}    ]", items.concat())
}

pub(super) fn index(body: BodyIndex) -> String {
    if body == BodyIndex::WORLD {
        "BodyIndex::WORLD".into()
    } else {
        format!("BodyIndex({})", body.0)
    }
}

pub(super) fn damper(damper: DamperIndex) -> String {
    match damper.row() {
        Some(row) => format!("DamperIndex({row})"),
        None => "DamperIndex::NONE".into(),
    }
}

pub(super) fn body<P: SourceGeometry>(body: &Body<P::Space>) -> String {
    format!(
        "Body {{ mass: {}, inertia: {}, inverse_mass: {}, inverse_inertia: {}, ratio: {}, \
         inverse_ratio: {} }}",
        body.mass.number(),
        P::moment(&body.inertia),
        body.inverse_mass.number(),
        P::moment(&body.inverse_inertia),
        P::moment(&body.ratio),
        P::moment(&body.inverse_ratio),
    )
}

pub(super) fn state<P: SourceGeometry>(state: &BodyState<P>) -> String {
    format!(
        "BodyState {{ position: {}, orientation: {}, velocity: {}, angular_velocity: {} }}",
        P::stored_position(&state.position),
        P::orientation(&state.orientation),
        P::stored_velocity(&state.velocity),
        P::stored_spin(&state.angular_velocity),
    )
}

pub(super) fn group(group: &Group) -> String {
    let Group { law, a, b, triples, arms, shared, point, element, damper: coefficients, clearance } =
        group;
    let clearance = match clearance.row() {
        Some(row) => format!("ClearanceIndex({row})"),
        None => "ClearanceIndex::NONE".into(),
    };
    format!(
        "Group {{ law: Law::{law:?}, a: {}, b: {}, triples: {triples}, arms: {arms}, \
         shared: {shared}, point: {point}, element: {element}, damper: {}, clearance: {clearance} }}",
        index(*a),
        index(*b),
        damper(*coefficients),
    )
}

pub(super) fn tsda<R: SourceNumber>(tsda: &Tsda<R>) -> String {
    let (k, l0) = (tsda.stiffness.number(), tsda.free_length.number());
    format!("Tsda {{ stiffness: {k}, free_length: {l0} }}")
}

pub(super) fn bushing<R: SourceNumber>(bushing: &PointBushing<R>) -> String {
    format!("PointBushing {{ stiffness: {} }}", bushing.stiffness.number())
}

pub(super) fn revolute<P: SourceGeometry>(revolute: &Revolute<P::Space>) -> String {
    let (k, along) = (revolute.stiffness.number(), revolute.along.number());
    let [a, b] = revolute.levers.each_ref().map(P::vector);
    format!("Revolute {{ stiffness: {k}, along: {along}, levers: [{a}, {b}] }}")
}

pub(super) fn universal<P: SourceGeometry>(universal: &Universal<P::Space>) -> String {
    let (lever, axis) = (P::vector(&universal.lever), P::vector(&universal.axis));
    format!(
        "Universal {{ stiffness: {}, lever: {lever}, axis: {axis} }}",
        universal.stiffness.number()
    )
}

pub(super) fn point_on_line<P: SourceGeometry>(line: &PointOnLine<P::Space>) -> String {
    let (k, l0) = (line.stiffness.number(), line.free_length.number());
    let direction = P::vector(&line.direction);
    format!("PointOnLine {{ direction: {direction}, stiffness: {k}, free_length: {l0} }}")
}

pub(super) fn input<P: SourceGeometry>(input: &Input<P>) -> String {
    let axes = |frame: LoadFrame| format!("LoadFrame::{frame:?}");
    let kind = match &input.kind {
        InputKind::Force { body, point, direction, frame } => format!(
            "Force {{ body: {}, point: {}, direction: {}, frame: {} }}",
            index(*body),
            P::local(point),
            P::vector(direction),
            axes(*frame),
        ),
        InputKind::Torque { body, axis, frame } => format!(
            "Torque {{ body: {}, axis: {}, frame: {} }}",
            index(*body),
            P::moment(axis),
            axes(*frame),
        ),
        InputKind::JointTorque { a, b, axes: [in_a, in_b] } => format!(
            "JointTorque {{ a: {}, b: {}, axes: [{}, {}] }}",
            index(*a),
            index(*b),
            P::moment(in_a),
            P::moment(in_b),
        ),
        InputKind::JointForce { a, b, point, axis } => format!(
            "JointForce {{ a: {}, b: {}, point: {}, axis: {} }}",
            index(*a),
            index(*b),
            P::local(point),
            P::vector(axis),
        ),
        InputKind::Actuator { group, element } => {
            format!("Actuator {{ group: {group:?}, element: {element} }}")
        }
        InputKind::Gravity { direction } => {
            format!("Gravity {{ direction: {} }}", P::vector(direction))
        }
        InputKind::Velocity { body, direction } => {
            let direction = P::vector(direction);
            format!("Velocity {{ body: {}, direction: {direction} }}", index(*body))
        }
        InputKind::AngularVelocity { body, axis } => {
            let axis = P::moment(axis);
            format!("AngularVelocity {{ body: {}, axis: {axis} }}", index(*body))
        }
        InputKind::Signal => "Signal".into(),
        InputKind::Anchor { direction } => {
            format!("Anchor {{ direction: {} }}", P::vector(direction))
        }
    };
    let (value, knot, knots) = (input.value.number(), input.knot, input.knots);
    let [least, most] = input.range.map(|bound| bound.number());
    format!(
        "Input {{ kind: InputKind::{kind}, value: {value}, knot: {knot}, knots: {knots}, range: [{least}, {most}] }}"
    )
}

pub(super) fn readout<P: SourceGeometry>(readout: &Readout<P>) -> String {
    let at = |kind: &str, body: BodyIndex, point: &P::Local| {
        format!("{kind} {{ body: {}, point: {} }}", index(body), P::local(point))
    };
    let slide = |Slide { bodies: [a, b], points: [at_a, at_b], axis }: &Slide<P>| {
        format!(
            "dbd_kernel::generated::Slide {{ bodies: [{}, {}], points: [{}, {}], axis: {} }}",
            index(*a),
            index(*b),
            P::local(at_a),
            P::local(at_b),
            P::vector(axis),
        )
    };
    let kind = match readout {
        Readout::JointAngle { spring, offset } => {
            format!("JointAngle {{ spring: {spring:?}, offset: {} }}", offset.number())
        }
        Readout::JointRate { spring } => format!("JointRate {{ spring: {spring:?} }}"),
        Readout::JointTravel { slide: of, offset } => {
            format!("JointTravel {{ slide: {}, offset: {} }}", slide(of), offset.number())
        }
        Readout::JointTravelRate { slide: of } => {
            format!("JointTravelRate {{ slide: {} }}", slide(of))
        }
        Readout::Point { body, point } => at("Point", *body, point),
        Readout::PointVelocity { body, point } => at("PointVelocity", *body, point),
        Readout::TsdaForce { group, element } => {
            format!("TsdaForce {{ group: {group:?}, element: {element} }}")
        }
        Readout::JointForce { group } => format!("JointForce {{ group: {group:?} }}"),
        Readout::Imu { body, point } => at("Imu", *body, point),
        Readout::Input { input } => format!("Input {{ input: InputIndex({}) }}", input.0),
        Readout::Law { law, quantity } => {
            format!(
                "Law {{ law: dbd_kernel::generated::LawIndex({}), quantity: {quantity} }}",
                law.0
            )
        }
    };
    format!("Readout::{kind}")
}

pub(super) fn knot<R: SourceNumber>(knot: &Knot<R>) -> String {
    let (time, value, slope) = (knot.time.number(), knot.value.number(), knot.slope.number());
    format!("Knot {{ time: {time}, value: {value}, slope: {slope} }}")
}

fn sensor<P: SourceGeometry>(sensor: &Sensor<P>) -> String {
    let at = |kind: &str, body: BodyIndex, point: &P::Local| {
        format!("{kind} {{ body: {}, point: {} }}", index(body), P::local(point))
    };
    let kind = match sensor {
        Sensor::Angle { spring, offset } => {
            format!("Angle {{ spring: {spring:?}, offset: {} }}", offset.number())
        }
        Sensor::Rate { spring } => format!("Rate {{ spring: {spring:?} }}"),
        Sensor::Point { body, point } => at("Point", *body, point),
        Sensor::Velocity { body, point } => at("Velocity", *body, point),
    };
    format!("Sensor::{kind}")
}

pub(super) fn source<P: SourceGeometry>(source: &Source<P>) -> String {
    let law = match &source.law {
        SourceLaw::Sine { period, phase, amplitude, rate, offset } => format!(
            "Sine {{ period: {}, phase: {}, amplitude: {}, rate: {}, offset: {} }}",
            period.number(),
            phase.number(),
            amplitude.number(),
            rate.number(),
            offset.number(),
        ),
        SourceLaw::Periodic { period } => format!("Periodic {{ period: {} }}", period.number()),
        SourceLaw::Over { sensor, weights: [x, y, z], offset } => format!(
            "Over {{ sensor: {}, weights: [{}, {}, {}], offset: {} }}",
            self::sensor(sensor),
            x.number(),
            y.number(),
            z.number(),
            offset.number(),
        ),
    };
    let Source { input, knot, knots, .. } = source;
    format!(
        "Source {{ input: InputIndex({}), knot: {knot}, knots: {knots}, law: SourceLaw::{law} }}",
        input.0
    )
}

pub(super) fn torsion<P: SourceGeometry>(spring: &TorsionSpring<P::Space>) -> String {
    format!(
        "TorsionSpring {{ a: {}, b: {}, axis: {}, reference: {}, stiffness: {}, preload: {}, \
         damper: {} }}",
        index(spring.a),
        index(spring.b),
        P::moment(&spring.axis),
        P::turn(&spring.reference),
        spring.stiffness.number(),
        spring.preload.number(),
        damper(spring.damper),
    )
}

pub(super) fn load<P: SourceGeometry>(load: &Load<P::Space>) -> String {
    format!(
        "Load {{ body: {}, frame: LoadFrame::{:?}, force: {}, torque: {}, from: {}, until: {} }}",
        index(load.body),
        load.frame,
        P::vector(&load.force),
        P::moment(&load.torque),
        load.from.number(),
        load.until.number(),
    )
}
