//! Looks up the joints and hinge axes that inputs, read-outs, drives and couplings refer to by name.
//!
//! `keys => joint or hinge`.

use dbd_kernel::BodyIndex;
use dbd_kernel::laws::Quantity;

use crate::assembly::Assembly;
use crate::error::SceneError;
use crate::hinge::Hinge;
use crate::joints::{JointInfo, JointPlace};
use crate::pair::Pair;
use crate::target::{ElementName, Elements, Kinds, Target};
use crate::text::{Choice, Direction, Table};

/// What inputs and read-outs can refer to.
pub(crate) struct Known<'k> {
    /// The model so far.
    pub(crate) assembly: &'k mut Assembly,
    /// Names of joints and other elements.
    pub(crate) elements: &'k Elements,
    /// The joints.
    pub(crate) joints: &'k [JointInfo],
    /// Their positions.
    pub(crate) places: &'k [JointPlace],
    /// The quantities that each interaction reports.
    pub(crate) quantities: &'k [&'static [Quantity]],
}

/// The joint named by a key, which must move about or along one axis, and whether it rotates; a cylindrical joint needs
/// `freedom`. `who` is the subject of the message: `a drive`.
pub(crate) fn freedom<'p>(
    table: &Table<'_>,
    key: &str,
    (places, elements): (&'p [JointPlace], &Elements),
    who: &str,
) -> Result<(&'p JointPlace, bool), SceneError> {
    let (name, target) = table.required(key, ElementName { elements, kinds: Kinds::JOINT })?;
    let place = match target {
        Target::Joint(row) => places.get(row),
        _ => None,
    };
    let turns = match place.map(|place| place.kind) {
        Some("revolute") => true,
        Some("translational") => false,
        Some("cylindrical") => table.required("freedom", Choice(&["turn", "slide"]))? == 0,
        kind => {
            let problem = format!("names the {} joint `{name}`", kind.unwrap_or("unknown"));
            let help = format!("{who} needs a revolute, translational or cylindrical joint");
            return Err(table.refuse_value(key, &problem, help));
        }
    };
    let Some(place) = place else { return Err(table.missing(key, "the name of a joint")) };
    if table.has("freedom") && place.kind != "cylindrical" {
        let help = "only a cylindrical joint needs `freedom`";
        return Err(table.refuse_key("freedom", "is not allowed here", help));
    }
    Ok((place, turns))
}

/// The joint named by `target`, which must slide along an axis. `who` is the subject of the message: `a drive`.
pub(crate) fn slide<'k>(
    table: &Table<'_>,
    known: &Known<'k>,
    who: &str,
) -> Result<&'k JointPlace, SceneError> {
    let kinds = Kinds::JOINT;
    let (name, target) =
        table.required("target", ElementName { elements: known.elements, kinds })?;
    let place = match target {
        Target::Joint(row) => known.places.get(row),
        _ => None,
    };
    place.filter(|place| matches!(place.kind, "translational" | "cylindrical")).ok_or_else(|| {
        let kind = place.map_or("unknown", |place| place.kind);
        let problem = format!("names the {kind} joint `{name}`, which does not slide");
        let help = format!("{who} needs a translational or cylindrical joint");
        table.refuse_value("target", &problem, help)
    })
}

/// Reads `target`, a joint or a torsion spring, with the keys it requires: `axis` for a spherical joint, `about` for a
/// universal one.
pub(crate) fn hinge(table: &Table<'_>, known: &Known<'_>) -> Result<Hinge, SceneError> {
    let name = ElementName { elements: known.elements, kinds: Kinds::TURNING };
    let (name, target) = table.required("target", name)?;
    let info = match target {
        Target::Joint(joint) => known.joints.get(joint),
        _ => None,
    };
    let Some(info) = info else {
        let Target::TorsionSpring(spring) = target else {
            return Err(rigid(table, &name, "element"));
        };
        refuse_keys(table, &["axis", "about"], "a torsion spring defines its own axis")?;
        return known.assembly.torsion_hinge(spring).ok_or_else(|| rigid(table, &name, "spring"));
    };
    match (info.kind, &info.hinges[..]) {
        (_, [hinge]) => {
            refuse_keys(
                table,
                &["axis", "about"],
                &format!("a {} joint defines its own axis", info.kind),
            )?;
            Ok(*hinge)
        }
        (_, [first, second]) => {
            refuse_keys(
                table,
                &["axis"],
                "a universal joint defines its own axes; set `about` to \"first\" or \"second\"",
            )?;
            let which = table.required("about", Choice(&["first", "second"]))?;
            Ok(if which == 0 { *first } else { *second })
        }
        ("spherical", _) => {
            refuse_keys(
                table,
                &["about"],
                "a spherical joint has no axis of its own; give `axis`",
            )?;
            let axis = table.required("axis", Direction)?;
            let group = known.assembly.groups().get(info.groups.start).copied();
            let (a, b) = group.map_or((BodyIndex::WORLD, BodyIndex::WORLD), |g| (g.a, g.b));
            let pair = Pair { a, b, names: info.between.clone() };
            let written = axis;
            let axis = known.assembly.carried_direction(a, axis);
            known.assembly.resolve_direction(table.value("axis"), written, axis);
            Ok(known.assembly.hinge(&pair, axis))
        }
        (kind, _) => Err(rigid(table, &name, &format!("{kind} joint"))),
    }
}

fn rigid(table: &Table<'_>, name: &str, kind: &str) -> SceneError {
    let problem = format!("names the {kind} `{name}`, which has no rotation axis");
    let help = "expected a revolute, cylindrical, universal or spherical joint, or a torsion \
        spring";
    table.refuse_value("target", &problem, help)
}

/// Refuses keys that this target does not use.
fn refuse_keys(table: &Table<'_>, keys: &[&str], help: &str) -> Result<(), SceneError> {
    match keys.iter().find(|key| table.has(key)) {
        Some(key) => Err(table.refuse_key(key, "is not allowed here", help)),
        None => Ok(()),
    }
}
