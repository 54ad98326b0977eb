//! Rows of a model's slices as Rust expressions.
//!
//! `element => source`. Every number is its bit pattern.

use dbd_kernel::body::Body;
use dbd_kernel::elements::input::{Input, InputKind, Knot};
use dbd_kernel::geometry::Float;
use dbd_kernel::index::{BodyIndex, DamperIndex};
use dbd_kernel::model::Group;
use dbd_kernel::readouts::Readout;
use dbd_kernel::{
    BodyState, Load, LoadFrame, PointBushing, PointOnLine, Quaternion, Revolute, TorsionSpring,
    Tsda, Universal, Vec3,
};

use super::number::SourceNumber;

pub(super) fn list<T>(items: &[T], item: impl Fn(&T) -> String) -> String {
    if items.is_empty() {
        return "[]".into();
    }
    let items: Vec<_> = items.iter().map(|i| format!("        {},\n", item(i))).collect();
    format!("[\n{}    ]", items.concat())
}

pub(super) fn vector<R: SourceNumber>(v: &Vec3<R>) -> String {
    format!("Vec3::new({}, {}, {})", v.x.number(), v.y.number(), v.z.number())
}

pub(super) fn quaternion<R: SourceNumber>(q: &Quaternion<R>) -> String {
    let [w, x, y, z] = [q.w, q.v.x, q.v.y, q.v.z].map(R::number);
    format!("Quaternion::new({w}, {x}, {y}, {z})")
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

pub(super) fn body<R: SourceNumber>(body: &Body<R>) -> String {
    format!(
        "Body {{ mass: {}, inertia: {}, inverse_mass: {}, inverse_inertia: {}, ratio: {}, \
         inverse_ratio: {} }}",
        body.mass.number(),
        vector::<R>(&body.inertia),
        body.inverse_mass.number(),
        vector::<R>(&body.inverse_inertia),
        vector::<R>(&body.ratio),
        vector::<R>(&body.inverse_ratio),
    )
}

pub(super) fn state<R: SourceNumber>(state: &BodyState<Float<R>>) -> String {
    format!(
        "BodyState {{ position: {}, orientation: {}, velocity: {}, angular_velocity: {} }}",
        vector::<R>(&state.position),
        quaternion::<R>(&state.orientation),
        vector::<R>(&state.velocity),
        vector::<R>(&state.angular_velocity),
    )
}

pub(super) fn group(group: &Group) -> String {
    let Group { law, a, b, stars, arms, shared, point, element, damper: coefficients, clearance } =
        group;
    let clearance = match clearance.row() {
        Some(row) => format!("ClearanceIndex({row})"),
        None => "ClearanceIndex::NONE".into(),
    };
    format!(
        "Group {{ law: Law::{law:?}, a: {}, b: {}, stars: {stars}, arms: {arms}, \
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

pub(super) fn revolute<R: SourceNumber>(revolute: &Revolute<R>) -> String {
    let (k, along) = (revolute.stiffness.number(), revolute.along.number());
    let [a, b] = revolute.levers.each_ref().map(vector);
    format!("Revolute {{ stiffness: {k}, along: {along}, levers: [{a}, {b}] }}")
}

pub(super) fn universal<R: SourceNumber>(universal: &Universal<R>) -> String {
    let (lever, axis) = (vector(&universal.lever), vector(&universal.axis));
    format!(
        "Universal {{ stiffness: {}, lever: {lever}, axis: {axis} }}",
        universal.stiffness.number()
    )
}

pub(super) fn point_on_line<R: SourceNumber>(line: &PointOnLine<R>) -> String {
    let (k, l0) = (line.stiffness.number(), line.free_length.number());
    let direction = vector(&line.direction);
    format!("PointOnLine {{ direction: {direction}, stiffness: {k}, free_length: {l0} }}")
}

pub(super) fn input<R: SourceNumber>(input: &Input<Float<R>>) -> String {
    let axes = |frame: LoadFrame| format!("LoadFrame::{frame:?}");
    let kind = match &input.kind {
        InputKind::Force { body, point, direction, frame } => format!(
            "Force {{ body: {}, point: {}, direction: {}, frame: {} }}",
            index(*body),
            vector(point),
            vector(direction),
            axes(*frame),
        ),
        InputKind::Torque { body, axis, frame } => format!(
            "Torque {{ body: {}, axis: {}, frame: {} }}",
            index(*body),
            vector(axis),
            axes(*frame),
        ),
        InputKind::JointTorque { a, b, axis } => {
            format!("JointTorque {{ a: {}, b: {}, axis: {} }}", index(*a), index(*b), vector(axis),)
        }
        InputKind::Actuator { group, element } => {
            format!("Actuator {{ group: {group}, element: {element} }}")
        }
        InputKind::Anchor { direction } => {
            format!("Anchor {{ direction: {} }}", vector(direction))
        }
    };
    let (value, knot, knots) = (input.value.number(), input.knot, input.knots);
    format!("Input {{ kind: InputKind::{kind}, value: {value}, knot: {knot}, knots: {knots} }}")
}

pub(super) fn readout<R: SourceNumber>(readout: &Readout<Float<R>>) -> String {
    let at = |kind: &str, body: BodyIndex, point: &Vec3<R>| {
        format!("{kind} {{ body: {}, point: {} }}", index(body), vector(point))
    };
    let kind = match readout {
        Readout::JointAngle { spring } => format!("JointAngle {{ spring: {spring} }}"),
        Readout::JointRate { spring } => format!("JointRate {{ spring: {spring} }}"),
        Readout::Point { body, point } => at("Point", *body, point),
        Readout::PointVelocity { body, point } => at("PointVelocity", *body, point),
        Readout::TsdaForce { group, element } => {
            format!("TsdaForce {{ group: {group}, element: {element} }}")
        }
        Readout::JointForce { group } => format!("JointForce {{ group: {group} }}"),
        Readout::Imu { body, point } => at("Imu", *body, point),
        Readout::Input { input } => format!("Input {{ input: InputIndex({}) }}", input.0),
    };
    format!("Readout::{kind}")
}

pub(super) fn knot<R: SourceNumber>(knot: &Knot<R>) -> String {
    let (time, value, slope) = (knot.time.number(), knot.value.number(), knot.slope.number());
    format!("Knot {{ time: {time}, value: {value}, slope: {slope} }}")
}

pub(super) fn torsion<R: SourceNumber>(spring: &TorsionSpring<R>) -> String {
    format!(
        "TorsionSpring {{ a: {}, b: {}, axis: {}, reference: {}, stiffness: {}, preload: {}, \
         damper: {} }}",
        index(spring.a),
        index(spring.b),
        vector::<R>(&spring.axis),
        quaternion::<R>(&spring.reference),
        spring.stiffness.number(),
        spring.preload.number(),
        damper(spring.damper),
    )
}

pub(super) fn load<R: SourceNumber>(load: &Load<R>) -> String {
    format!(
        "Load {{ body: {}, frame: LoadFrame::{:?}, force: {}, torque: {}, from: {}, until: {} }}",
        index(load.body),
        load.frame,
        vector::<R>(&load.force),
        vector::<R>(&load.torque),
        load.from.number(),
        load.until.number(),
    )
}
