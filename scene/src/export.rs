//! Rust source of a const model, for a firmware's build script.
//!
//! `scene => source text`. Every number is written as its bit pattern, so the model that the
//! compiler evaluates has the bits of the run-time-sized one; the compiler checks every index
//! ([`dbd_kernel::Model::checked`]). In a build script:
//!
//! ```no_run
//! use dbd_scene::{Scene, export};
//!
//! let scene = Scene::load("scenes/four-bar.toml")?;
//! let source = export::preamble(&scene, 2e-5) + &export::model::<f32>(&scene);
//! let out = std::env::var("OUT_DIR")?;
//! std::fs::write(std::path::Path::new(&out).join("four_bar.rs"), source)?;
//! # Ok::<(), Box<dyn std::error::Error>>(())
//! ```
//!
//! The program includes it into a module of its own: `Plant::new(&FOUR_BAR_F32, …)`.

use std::fmt::{Display, Write};

use dbd_kernel::body::Body;
use dbd_kernel::elements::input::{Input, InputKind, Knot};
use dbd_kernel::geometry::{Float, Named};
use dbd_kernel::index::{BodyIndex, DamperIndex};
use dbd_kernel::model::{Group, ModelOwner};
use dbd_kernel::readouts::Readout;
use dbd_kernel::{
    BodyState, Load, LoadFrame, PointBushing, PointOnLine, Quaternion, Real, TorsionSpring, Tsda,
    Vec3,
};

use crate::{Scene, SceneModel};

/// Stands before what a program need not use.
const UNUSED: &str = "#[allow(dead_code)]\n";

/// A number that can be written as source, and the precision made of it.
pub trait SourceNumber: Real + Named {
    /// The precision's type in the kernel.
    const TYPE: &'static str;
    /// The number's expression.
    fn number(self) -> String;
}

impl SourceNumber for f64 {
    const TYPE: &'static str = "F64";
    fn number(self) -> String {
        format!("f64::from_bits({:#018x})", self.to_bits())
    }
}

impl SourceNumber for f32 {
    const TYPE: &'static str = "F32";
    fn number(self) -> String {
        format!("f32::from_bits({:#010x})", self.to_bits())
    }
}

/// The scene's name as a Rust constant: `four-bar` becomes `FOUR_BAR`; a leading digit gets a `_`.
#[must_use]
pub fn constant_name(scene: &str) -> String {
    let name: String = scene
        .chars()
        .map(|c| if c.is_ascii_alphanumeric() { c.to_ascii_uppercase() } else { '_' })
        .collect();
    if name.starts_with(|c: char| c.is_ascii_digit()) { format!("_{name}") } else { name }
}

/// The scene's name as a Rust type: `four-bar` becomes `FourBar`.
#[must_use]
pub fn type_name(scene: &str) -> String {
    let words = scene.split(|c: char| !c.is_ascii_alphanumeric()).filter(|word| !word.is_empty());
    let name: String = words
        .map(|word| {
            let (first, rest) = word.split_at(1);
            first.to_ascii_uppercase() + rest
        })
        .collect();
    match name.chars().next() {
        None => "Scene".into(),
        Some(first) if first.is_ascii_digit() => format!("_{name}"),
        Some(_) => name,
    }
}

/// A name as code within a documentation comment, whatever quotes it holds: between more backticks
/// than stand together in it.
fn quoted(name: &str) -> String {
    if !name.contains('`') {
        return format!("`{name}`");
    }
    let longest = name.split(|c| c != '`').map(str::len).max().unwrap_or(0);
    let fence = "`".repeat(longest + 1);
    format!("{fence} {name} {fence}")
}

/// Source of what all precisions share: `use` lines, the step \[s\], the bodies' names, and the
/// index of each input: `FOUR_BAR_INPUT_ELBOW`. `step` is the default step where the scene gives
/// none.
#[must_use]
pub fn preamble(scene: &Scene, step: f64) -> String {
    let name = constant_name(&scene.name);
    let step = (scene.step.unwrap_or(step)).number();
    let bodies = list(&scene.body_names, |body| format!("{body:?}"));
    let names = constant_names(scene.inputs.iter().map(|input| input.name.as_str()));
    let inputs: String = scene
        .inputs
        .iter()
        .zip(names)
        .map(|(input, constant)| {
            format!(
                "/// \\[{}\\] the input {}.\n{UNUSED}pub const {name}_INPUT_{constant}: InputIndex = \
             InputIndex({});\n",
                input.unit,
                quoted(&input.name),
                input.index.0
            )
        })
        .collect();
    format!(
        "// Not every scene has every kind of element, and not every program uses all of its constants.\n\
         #[allow(unused_imports)]\n\
         use dbd_kernel::{{\n    \
             Body, BodyIndex, BodyState, F32, F64, Load, LoadFrame, Model, PointBushing, PointOnLine,\n    \
             Quaternion, TorsionSpring, Tsda, Vec3,\n    \
             elements::input::{{Input, InputKind, Knot}},\n    \
             index::{{ClearanceIndex, DamperIndex, InputIndex}},\n    \
             model::{{Group, Law}},\n    \
             readouts::Readout,\n\
         }};\n\n\
         /// \\[s\\] the step of the scene {scene_name}.\n\
         {UNUSED}pub const {name}_STEP: f64 = {step};\n\
         /// The bodies of the scene {scene_name}, in order.\n\
         {UNUSED}pub const {name}_BODIES: [&str; {count}] = {bodies};\n\
         {inputs}",
        scene_name = quoted(&scene.name),
        count = scene.body_names.len(),
    )
}

/// Names of things of a kind as parts of constants, each its own: a second one that would be the
/// same gets its number.
fn constant_names<'n>(names: impl Iterator<Item = &'n str>) -> Vec<String> {
    let mut constants: Vec<String> = Vec::new();
    for name in names {
        let mut constant = constant_name(name);
        while constants.contains(&constant) {
            constant = format!("{constant}_{}", constants.len() + 1);
        }
        constants.push(constant);
    }
    constants
}

/// Source of the scene's model in the precision of `R`: a type alias `FourBarF32` with the counts,
/// a static `FOUR_BAR_F32` and a constant for each read-out, `FOUR_BAR_READOUT_ANGLE_F32`.
#[must_use]
pub fn model<R: SourceNumber>(scene: &Scene) -> String {
    let model: SceneModel<Float<R>> = scene.model.convert();
    let ty = format!("{}{}", type_name(&scene.name), R::TYPE);
    let name = format!("{}_{}", constant_name(&scene.name), R::TYPE);
    let counts = [
        model.bodies.len(),
        model.groups.len(),
        model.points.len(),
        model.tsdas.len(),
        model.bushings.len(),
        model.dampers.len(),
        model.torsions.len(),
        model.gravity.len(),
        model.loads.len(),
        model.lines.len(),
        model.inputs.len(),
        model.knots.len(),
        model.clearances.len(),
    ];
    let counts = counts.map(|n| n.to_string()).join(", ");
    let mut out = String::new();
    let mut line = |text: &dyn Display| {
        // Writing to a string cannot fail.
        let _ = writeln!(out, "{text}");
    };
    line(&format_args!("/// The shape of the scene {}.", quoted(&scene.name)));
    line(&format_args!("{UNUSED}pub type {ty} = Model<{}, {counts}>;", R::TYPE));
    line(&format_args!("/// The scene {}.", quoted(&scene.name)));
    line(&format_args!("{UNUSED}pub static {name}: {ty} = Model {{"));
    line(&format_args!("    bodies: {},", list(&model.bodies, body::<R>)));
    line(&format_args!("    initial: {},", list(model.initial(), state::<R>)));
    line(&format_args!("    gravity: {},", list(&model.gravity, vector::<R>)));
    line(&format_args!("    groups: {},", list(&model.groups, group)));
    line(&format_args!("    points: {},", list(&model.points, vector::<R>)));
    line(&format_args!("    tsdas: {},", list(&model.tsdas, tsda::<R>)));
    line(&format_args!("    bushings: {},", list(&model.bushings, bushing::<R>)));
    line(&format_args!("    dampers: {},", list(&model.dampers, |c| c.number())));
    line(&format_args!("    torsions: {},", list(&model.torsions, torsion::<R>)));
    line(&format_args!("    loads: {},", list(&model.loads, load::<R>)));
    line(&format_args!("    lines: {},", list(&model.lines, point_on_line)));
    line(&format_args!("    inputs: {},", list(&model.inputs, input)));
    line(&format_args!("    knots: {},", list(&model.knots, knot)));
    line(&format_args!("    clearances: {},", list(&model.clearances, |c| c.number())));
    line(&"}");
    line(&".checked();");
    let names = constant_names(scene.readouts.iter().map(|readout| readout.name.as_str()));
    for (info, constant) in scene.readouts.iter().zip(names) {
        let scene = constant_name(&scene.name);
        line(&format_args!("/// The read-out {}.", quoted(&info.name)));
        line(&format_args!(
            "{UNUSED}pub const {scene}_READOUT_{constant}_{}: Readout<{}> = {};",
            R::TYPE,
            R::TYPE,
            readout(&info.readout.convert::<Float<R>>())
        ));
    }
    out
}

fn list<T>(items: &[T], item: impl Fn(&T) -> String) -> String {
    if items.is_empty() {
        return "[]".into();
    }
    let items: Vec<_> = items.iter().map(|i| format!("        {},\n", item(i))).collect();
    format!("[\n{}    ]", items.concat())
}

fn vector<R: SourceNumber>(v: &Vec3<R>) -> String {
    format!("Vec3::new({}, {}, {})", v.x.number(), v.y.number(), v.z.number())
}

fn quaternion<R: SourceNumber>(q: &Quaternion<R>) -> String {
    let [w, x, y, z] = [q.w, q.v.x, q.v.y, q.v.z].map(R::number);
    format!("Quaternion::new({w}, {x}, {y}, {z})")
}

fn index(body: BodyIndex) -> String {
    if body == BodyIndex::WORLD {
        "BodyIndex::WORLD".into()
    } else {
        format!("BodyIndex({})", body.0)
    }
}

fn damper(damper: DamperIndex) -> String {
    match damper.row() {
        Some(row) => format!("DamperIndex({row})"),
        None => "DamperIndex::NONE".into(),
    }
}

fn body<R: SourceNumber>(body: &Body<R>) -> String {
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

fn state<R: SourceNumber>(state: &BodyState<Float<R>>) -> String {
    format!(
        "BodyState {{ position: {}, orientation: {}, velocity: {}, angular_velocity: {} }}",
        vector::<R>(&state.position),
        quaternion::<R>(&state.orientation),
        vector::<R>(&state.velocity),
        vector::<R>(&state.angular_velocity),
    )
}

fn group(group: &Group) -> String {
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

fn tsda<R: SourceNumber>(tsda: &Tsda<R>) -> String {
    let (k, l0) = (tsda.stiffness.number(), tsda.free_length.number());
    format!("Tsda {{ stiffness: {k}, free_length: {l0} }}")
}

fn bushing<R: SourceNumber>(bushing: &PointBushing<R>) -> String {
    format!("PointBushing {{ stiffness: {} }}", bushing.stiffness.number())
}

fn point_on_line<R: SourceNumber>(line: &PointOnLine<R>) -> String {
    let (k, l0) = (line.stiffness.number(), line.free_length.number());
    let direction = vector(&line.direction);
    format!("PointOnLine {{ direction: {direction}, stiffness: {k}, free_length: {l0} }}")
}

fn input<R: SourceNumber>(input: &Input<Float<R>>) -> String {
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

fn readout<R: SourceNumber>(readout: &Readout<Float<R>>) -> String {
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

fn knot<R: SourceNumber>(knot: &Knot<R>) -> String {
    let (time, value, slope) = (knot.time.number(), knot.value.number(), knot.slope.number());
    format!("Knot {{ time: {time}, value: {value}, slope: {slope} }}")
}

fn torsion<R: SourceNumber>(spring: &TorsionSpring<R>) -> String {
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

fn load<R: SourceNumber>(load: &Load<R>) -> String {
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

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn names_become_identifiers() {
        assert_eq!(constant_name("four-bar"), "FOUR_BAR");
        assert_eq!(constant_name("3rrr-1"), "_3RRR_1");
        assert_eq!(type_name("five-bar-a"), "FiveBarA");
        assert_eq!(type_name("3ruu"), "_3ruu");
        assert_eq!(type_name("ü"), "Scene");
        let names = ["a b", "a-b", "c"].into_iter();
        assert_eq!(constant_names(names), ["A_B", "A_B_2", "C"]);
    }

    #[test]
    fn names_with_quotes_stay_within_their_comment() {
        assert_eq!(quoted("four-bar"), "`four-bar`");
        assert_eq!(quoted("a`b``"), "``` a`b`` ```");
        let scene = crate::example::with(
            "[[input]]\nname = \"a`\\\" */ [x]\"\ntype = \"force\"\nbody = \"arm\"\naxis = [1, 0, 0]",
        );
        let source = preamble(&scene, 1e-3);
        let line = "/// \\[N\\] the input `` a`\" */ [x] ``.\n#[allow(dead_code)]\npub const ";
        assert!(source.contains(&format!("{line}TWO_BODIES_INPUT_A_")), "{source}");
    }

    #[test]
    fn numbers_are_written_as_their_bits() {
        assert_eq!(1.0_f32.number(), "f32::from_bits(0x3f800000)");
        assert_eq!((-2.5_f64).number(), "f64::from_bits(0xc004000000000000)");
    }
}
