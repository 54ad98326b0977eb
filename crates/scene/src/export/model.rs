//! Source of a const model.
//!
//! `(scene, precision) => type alias, static, read-outs`.

use std::fmt::{Display, Write};

use dbd_kernel::geometry::Float;
use dbd_kernel::laws::Laws as _;
use dbd_kernel::model::ModelOwner;
use dbd_kernel::planar::Planar;
use dbd_kernel::readouts::Readout;
use dbd_kernel::{F64, GroupIndex};

use super::laws;
use super::names::{UNUSED, constant_name, constant_names, quoted, type_name};
use super::number::{SourceGeometry, SourceNumber};
use super::rows::{
    body, bushing, group, input, knot, list, load, point_on_line, readout, revolute, source, state,
    torsion, tsda, universal,
};
use crate::elimination::Elimination;
use crate::runtime::SceneModel;
use crate::scene::Scene;

/// Source of the scene's model in the precision of `R`: a type alias `FourBarF32` with the counts,
/// a static `FOUR_BAR_F32` and a constant for each read-out, `FOUR_BAR_READOUT_ANGLE_F32`.
#[must_use]
pub fn model<R: SourceNumber>(scene: &Scene) -> String {
    match &scene.planar {
        Some(planar) => model_in::<Planar<R>>(scene, &planar.model),
        None => model_in::<Float<R>>(scene, &scene.model),
    }
}

/// Source of the stepped model, in a spatial or planar precision.
pub(super) fn model_in<P: SourceGeometry>(scene: &Scene, exact: &SceneModel<F64>) -> String {
    let model: SceneModel<P> = exact.convert();
    let precision = P::name();
    let ty = format!("{}{}", type_name(&scene.name), P::SUFFIX);
    let suffix = P::SUFFIX.to_uppercase();
    let name = format!("{}_{suffix}", constant_name(&scene.name));
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
        model.revolutes.len(),
        model.universals.len(),
        if model.dampers.is_empty() && model.laws.shares().is_empty() {
            0
        } else {
            model.bodies.len()
        },
        model.sources.len(),
    ];
    let counts = counts.map(|n| n.to_string()).join(", ");
    let laws = laws::types::<P>(&model.laws);
    let driven = match model.bodies.iter().filter(|body| body.is_driven()).count() {
        0 => String::new(),
        count => format!(", {count}"),
    };
    let mut out = String::new();
    let mut line = |text: &dyn Display| {
        // Writing to a string cannot fail.
        let _ = writeln!(out, "{text}");
    };
    line(&format_args!("/// The shape of the scene {}.", quoted(&scene.name)));
    line(&format_args!("{UNUSED}pub type {ty} = Model<{precision}, {counts}, {laws}{driven}>;"));
    line(&format_args!("/// The scene {}.", quoted(&scene.name)));
    line(&format_args!("{UNUSED}pub static {name}: {ty} = Model {{"));
    line(&format_args!("    bodies: {},", list(&model.bodies, body::<P>)));
    line(&format_args!("    initial: {},", list(model.initial(), state::<P>)));
    line(&format_args!("    gravity: {},", list(&model.gravity, P::vector)));
    line(&format_args!("    groups: {},", list(&model.groups, group)));
    line(&format_args!("    points: {},", list(&model.points, P::local)));
    line(&format_args!("    tsdas: {},", list(&model.tsdas, tsda)));
    line(&format_args!("    bushings: {},", list(&model.bushings, bushing)));
    line(&format_args!("    dampers: {},", list(&model.dampers, |c| c.number())));
    line(&format_args!("    torsions: {},", list(&model.torsions, torsion::<P>)));
    line(&format_args!("    loads: {},", list(&model.loads, load::<P>)));
    line(&format_args!("    lines: {},", list(&model.lines, point_on_line::<P>)));
    line(&format_args!("    inputs: {},", list(&model.inputs, input::<P>)));
    line(&format_args!("    knots: {},", list(&model.knots, knot)));
    line(&format_args!("    clearances: {},", list(&model.clearances, |c| c.number())));
    line(&format_args!("    revolutes: {},", list(&model.revolutes, revolute::<P>)));
    line(&format_args!("    universals: {},", list(&model.universals, universal::<P>)));
    line(&format_args!("    sources: {},", list(&model.sources, source::<P>)));
    line(&format_args!("    laws: {},", laws::rows::<P>(&model.laws)));
    line(&"}");
    line(&".checked();");
    let names = constant_names(scene.readouts.iter().map(|readout| readout.name.as_str()));
    for (info, constant) in scene.readouts.iter().zip(names) {
        let name = constant_name(&scene.name);
        let read = match &scene.planar {
            Some(planar) => planar.readout(&info.readout),
            None => info.readout,
        };
        line(&format_args!("/// The read-out {}.", quoted(&info.name)));
        line(&format_args!(
            "{UNUSED}pub const {name}_READOUT_{constant}_{suffix}: Readout<{precision}> = {};",
            readout(&read.convert::<P>())
        ));
    }
    out
}

/// Source of the model with the elimination order of a matrix: a type alias `FourBarPlannedF32` and a static
/// `FOUR_BAR_PLANNED_F32`.
pub(super) fn plan<P: SourceGeometry>(scene: &Scene, exact: &SceneModel<F64>) -> String {
    let Elimination { order, pairs, targets, slots, .. } = exact.clone().planned().plan;
    let (ty, name) = (type_name(&scene.name), constant_name(&scene.name));
    let (suffix, capitals) = (P::SUFFIX, P::SUFFIX.to_uppercase());
    let planned = format!("{ty}Planned{suffix}");
    let counts = [order.len(), pairs.len(), targets.len(), slots.len()].map(|n| n.to_string());
    format!(
        "/// The scene {quoted} with the plan of a matrix.\n{UNUSED}\
         pub type {planned} = dbd_kernel::generated::Planned<&'static {ty}{suffix}, {counts}>;\n\
         /// The scene {quoted} with the plan of a matrix.\n{UNUSED}\
         pub static {name}_PLANNED_{capitals}: {planned} = dbd_kernel::generated::Planned {{\n    \
             model: &{name}_{capitals},\n    order: {order:?},\n    pairs: {pairs:?},\n    \
             targets: {targets:?},\n    slots: {slots:?},\n}};\n",
        quoted = quoted(&scene.name),
        counts = counts.join(", "),
    )
}

/// The force of each joint on its second body: of its last group, which acts on it.
pub(super) fn joint_forces<P: SourceGeometry>(scene: &Scene) -> String {
    let names = constant_names(scene.joints.iter().map(|joint| joint.name.as_str()));
    let name = constant_name(&scene.name);
    let joints = scene.joints.iter().zip(names);
    let axes = if scene.planar.is_some() { "the plane's axes" } else { "world" };
    let ty = P::name();
    let line = |(joint, constant): (&crate::JointInfo, String)| {
        let force =
            Readout::<P>::JointForce { group: GroupIndex(joint.groups.end.checked_sub(1)? as u16) };
        Some(format!(
            "/// \\[N\\] the force of the joint {} on its second body, {axes}.\n\
             {UNUSED}pub const {name}_JOINT_{constant}_FORCE_{precision}: Readout<{ty}> = {};\n",
            quoted(&joint.name),
            readout(&force),
            precision = P::SUFFIX.to_uppercase(),
        ))
    };
    joints.filter_map(line).collect()
}
