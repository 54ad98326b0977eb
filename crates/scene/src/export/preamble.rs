//! Source of the items that all precisions share.
//!
//! `scene => use lines, step, names, indices`.

use super::names::{UNUSED, constant_name, constant_names, quoted};
use super::number::SourceNumber;
use super::rows::{index, list};
use crate::assembly::WORLD;
use crate::scene::Scene;
use dbd_kernel::BodyIndex;

/// Source of the items that all precisions share: `use` lines, the step \[s\], the bodies' names, and the index of
/// each input: `FOUR_BAR_INPUT_ELBOW`. `step` is the default step for a scene without one.
#[must_use]
pub fn preamble(scene: &Scene, step: f64) -> String {
    shared(scene, scene.step.unwrap_or(step))
}

/// The same with this step \[s\].
pub(super) fn shared(scene: &Scene, step: f64) -> String {
    let name = constant_name(&scene.name);
    let step = step.number();
    let bodies = names_list(scene, "BODIES", "bodies", scene.body_names.iter());
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
         use dbd_kernel::generated::*;\n\n\
         /// \\[s\\] the step of the scene {scene_name}.\n\
         {UNUSED}pub const {name}_STEP: f64 = {step};\n\
         {bodies}{inputs}",
        scene_name = quoted(&scene.name),
    )
}

/// Names of joints, inputs and torsion springs by index, and the indices of each body and joint in the model.
pub(super) fn names(scene: &Scene) -> String {
    let name = constant_name(&scene.name);
    let mut text = names_list(scene, "JOINTS", "joints", scene.joints.iter().map(|one| &one.name));
    text += &names_list(scene, "INPUTS", "inputs", scene.inputs.iter().map(|one| &one.name));
    text += &names_list(scene, "TORSION_SPRINGS", "torsion springs", scene.torsion_names.iter());
    let bodies = constant_names(scene.body_names.iter().map(String::as_str));
    for ((row, body), constant) in scene.body_names.iter().enumerate().zip(bodies) {
        text += &format!(
            "/// The body {}.\n{UNUSED}pub const {name}_BODY_{constant}: BodyIndex = BodyIndex({row});\n",
            quoted(body),
        );
    }
    let joints = constant_names(scene.joints.iter().map(|joint| joint.name.as_str()));
    for (joint, constant) in scene.joints.iter().zip(joints) {
        let [a, b] = joint.between.each_ref().map(|body| index(body_of(scene, body)));
        let (kind, joint_name) = (joint.kind, quoted(&joint.name));
        let (from, until) = (joint.groups.start, joint.groups.end);
        text += &format!(
            "/// The bodies of the joint {joint_name}, {kind}.\n\
             {UNUSED}pub const {name}_JOINT_{constant}_BODIES: [BodyIndex; 2] = [{a}, {b}];\n\
             /// The groups of the elements of the joint {joint_name} in the model.\n\
             {UNUSED}pub const {name}_JOINT_{constant}_GROUPS: core::ops::Range<u16> = {from}..{until};\n",
        );
    }
    text
}

/// The index of a body that a joint names.
fn body_of(scene: &Scene, name: &str) -> BodyIndex {
    let row = scene.body_names.iter().position(|body| body == name);
    match row {
        Some(row) if name != WORLD => BodyIndex(row as u16),
        _ => BodyIndex::WORLD,
    }
}

fn names_list<'n>(
    scene: &Scene,
    constant: &str,
    what: &str,
    names: impl Iterator<Item = &'n String>,
) -> String {
    let names: Vec<&String> = names.collect();
    format!(
        "/// The {what} of the scene {}, in order.\n\
         {UNUSED}pub const {}_{constant}: [&str; {}] = {};\n",
        quoted(&scene.name),
        constant_name(&scene.name),
        names.len(),
        list(&names, |name| format!("{name:?}")),
    )
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn names_with_quotes_stay_within_their_comment() {
        let scene = crate::example::with(
            "[[input]]\nname = \"a`\\\" */ [x]\"\ntype = \"force\"\nbody = \"arm\"\naxis = [1, 0, 0]",
        );
        let source = preamble(&scene, 1e-3);
        let line = "/// \\[N\\] the input `` a`\" */ [x] ``.\n#[allow(dead_code)]\npub const ";
        assert!(source.contains(&format!("{line}TWO_BODIES_INPUT_A_")), "{source}");
    }
}
