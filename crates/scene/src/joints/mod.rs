//! `[[joint]]`: each expands into the TSDA set of its type.
//!
//! `table => groups in the assembly, what reports say of the joint`. A type is one file with one
//! [`JointType`]; its name, its keys and its expansion stand there and nowhere else.

mod assemble;
mod cylindrical;
mod fixed;
mod info;
mod rates;
mod realisation;
mod revolute;
mod site;
mod spherical;
mod translational;
mod triad;
mod universal;

pub use assemble::{Assembled, Moved, OpenJoint};
pub(crate) use assemble::{ROUNDING, read as assemble};
pub use info::JointInfo;
pub use realisation::Realisation;

use dbd_kernel::Vec3;

use crate::assembly::Assembly;
use crate::closure::{Place, Turn};
use crate::error::SceneError;
use crate::hinge::Hinge;
use crate::joints::site::Site;
use crate::joints::triad::Triad;
use crate::pair::Pair;
use crate::shortened::shortened;
use crate::spring::{self, Spring};
use crate::target::{Elements, Target};
use crate::text::{Choice, Kind as _, Table};

/// A type of joint.
struct JointType {
    /// Its name in a scene.
    name: &'static str,
    /// Degrees of freedom that it holds, see [`JointInfo::holds`].
    holds: u32,
    /// Freedoms among these of a body that it brings as TSDAs alone.
    brings: u32,
    /// The keys it has besides those of every joint.
    keys: &'static [&'static str],
    /// What it asks of its points and triads.
    asks: (Place, Turn),
    /// Adds its elements to the assembly and says about which axes it turns.
    expand: fn(&Table<'_>, &Joint, &mut Assembly) -> Result<Vec<Hinge>, SceneError>,
}

/// What every joint has.
struct Joint {
    name: String,
    pair: Pair,
    /// \[m\] its place, world.
    at_w: Vec3<f64>,
    /// The first body's axis and the second's, world; the same but for a universal joint.
    axes: [Vec3<f64>; 2],
    /// World, where there is one.
    reference: Option<Vec3<f64>>,
    spring: Spring,
    realisation: Realisation,
}

impl Joint {
    /// The triad of its axis and its reference.
    fn triad(&self, table: &Table<'_>) -> Result<Triad, SceneError> {
        triad::about(table, self.axes[0], self.reference)
    }
}

/// Where a joint is, for laws about and along its axis.
pub(crate) struct JointPlace {
    /// Its type.
    pub(crate) kind: &'static str,
    pub(crate) name: String,
    /// Its bodies, exchanged where the ground is the second one: that is a body here.
    pub(crate) pair: Pair,
    /// \[m\] world.
    pub(crate) at_w: Vec3<f64>,
    /// World; a turn or travel of the second body along it counts as that of the joint does.
    pub(crate) axis_w: Vec3<f64>,
}

impl JointPlace {
    fn of(kind: &'static str, joint: &Joint) -> Self {
        let (name, axis, pair) = (joint.name.clone(), joint.axes[0], &joint.pair);
        let (pair, axis_w) =
            if pair.b.is_world() { (pair.reversed(), -axis) } else { (pair.clone(), axis) };
        Self { kind, name, pair, at_w: joint.at_w, axis_w }
    }
}

/// In the order in which messages name them.
static TYPES: [JointType; 6] = [
    spherical::TYPE,
    revolute::TYPE,
    universal::TYPE,
    cylindrical::TYPE,
    translational::TYPE,
    fixed::TYPE,
];

const KEYS: &[&str] = &["name", "type", "between", "at"];

/// Every key of all types together, then those of each type.
pub(crate) fn keys() -> Vec<(&'static str, Vec<&'static [&'static str]>)> {
    let with = |keys: &[&'static [&'static str]]| [&[KEYS, spring::KEYS], keys].concat();
    let all: Vec<_> = TYPES.iter().map(|kind| kind.keys).collect();
    let each = TYPES.iter().map(|kind| (kind.name, with(&[kind.keys])));
    std::iter::once(("joint", with(&all))).chain(each).collect()
}

/// The types, each with all its keys.
pub(crate) fn types() -> impl Iterator<Item = (&'static str, Vec<&'static str>)> {
    TYPES.iter().map(|kind| (kind.name, [KEYS, spring::KEYS, kind.keys].concat()))
}

/// The keys of tables within a joint and within `[assemble]`.
pub(crate) const WITHIN: [(&str, &[&str]); 4] = [
    ("assemble", assemble::KEYS),
    ("spider", universal::SPIDER),
    ("halves", site::HALVES),
    ("rate", rates::RATES),
];

/// What a joint of a type holds of its points and triads.
pub(crate) fn holds(kind: &str) -> (Place, Turn) {
    let of_type = TYPES.iter().find(|of_type| of_type.name == kind);
    of_type.map_or((Place::Point, Turn::All), |of_type| of_type.asks)
}

/// What other programs and people call the types.
const OTHER_NAMES: [(&str, &[&str]); 6] = [
    ("spherical", &["ball", "ball_and_socket", "ball_socket", "socket", "point", "globular"]),
    (
        "revolute",
        &["hinge", "pin", "pivot", "rotary", "rotational", "rotation", "continuous", "bearing"],
    ),
    ("universal", &["cardan", "u", "hooke", "hookes", "hardy_spicer", "gimbal", "cross"]),
    ("cylindrical", &["cylinder", "slide_and_turn"]),
    (
        "translational",
        &["slider", "slide", "prismatic", "sliding", "linear", "translation", "guide"],
    ),
    ("fixed", &["weld", "welded", "rigid", "lock", "locked", "clamp", "clamped", "bolted"]),
];

/// A joint is made at free length. One whose points miss that by more than this share of it lies
/// so far from its bodies, or is so small, that coordinates cannot tell its points apart.
const REACH: f64 = 1e-3;

/// Reads and expands all joints in scene order.
pub(crate) fn read_all(
    root: &Table<'_>,
    assembly: &mut Assembly,
    elements: &mut Elements,
) -> Result<(Vec<JointInfo>, Vec<JointPlace>), SceneError> {
    let (mut infos, mut places) = (Vec::new(), Vec::new());
    let of_all = realisation::of_all(root)?;
    let tables = root.list("joint")?;
    for table in &tables {
        let kind = kind(table)?;
        table.only(&[KEYS, kind.keys, spring::KEYS])?;
        let name = elements.read(table, "joint", Target::Joint(infos.len()))?;
        let (groups, bodies) = (assembly.groups().len(), assembly.body_names().len());
        let (joint, hinges) = read(table, name.clone(), (kind, of_all), assembly)?;
        let spider = assembly.body_names().get(bodies).cloned();
        // Without a body of its own a universal joint holds what its two bodies lose.
        let brought = if spider.is_some() { 0 } else { kind.brings };
        places.push(JointPlace::of(kind.name, &joint));
        infos.push(JointInfo {
            name,
            kind: kind.name,
            between: joint.pair.names,
            realisation: joint.realisation,
            holds: kind.holds - brought,
            spider,
            groups: groups..assembly.groups().len(),
            hinges,
            tsdas: 0,
            size: 0.0,
            mass_left_out: 0.0,
            assembly_error: 0.0,
        });
    }
    // One pass over all elements, for a scene may have thousands of joints.
    let extensions = assembly.largest_extensions();
    for (table, info) in tables.iter().zip(&mut infos) {
        for number in info.groups.clone() {
            let group = &assembly.groups()[number];
            let (extension, reach) = (extensions[number], assembly.size(number));
            // A spherical joint of a bushing has no size where it needs none.
            if reach > 0.0 && extension > REACH * reach {
                return Err(out_of_reach(table, extension, reach));
            }
            info.tsdas += group.elements();
            info.size = info.size.max(reach);
            info.mass_left_out += assembly.mass_left_out(number);
            info.assembly_error = info.assembly_error.max(extension);
        }
    }
    Ok((infos, places))
}

fn out_of_reach(table: &Table<'_>, extension: f64, reach: f64) -> SceneError {
    let problem = format!(
        "does not assemble: its points are {extension:e} m off where its springs are {reach:e} m long"
    );
    let help = "a joint of a larger size, or nearer to the origin and to its bodies: coordinates \
                have 16 digits";
    table.refuse(&problem, help)
}

/// The type, which decides what further keys there may be.
fn kind(table: &Table<'_>) -> Result<&'static JointType, SceneError> {
    if !table.has("type") {
        let mut keys = vec![KEYS, spring::KEYS];
        keys.extend(TYPES.iter().map(|kind| kind.keys));
        table.only(&keys)?;
    }
    let names = TYPES.each_ref().map(|kind| kind.name);
    let value = table.value("type");
    if let Some((value, word)) = value.as_ref().and_then(|v| Some((v, v.get().as_str()?)))
        && let Some(meant) = meant_by(word)
    {
        let expected = format!("{}; did you mean \"{meant}\"?", Choice(&names).expected());
        return Err(value.refuse(&format!("is \"{}\"", shortened(word)), &expected));
    }
    let kind = &TYPES[table.required("type", Choice(&names))?];
    realisation::check(table, kind)?;
    Ok(kind)
}

/// Lets a table have the keys of its type: defaults of other types are not its.
pub(crate) fn allow(table: &Table<'_>) -> Result<(), SceneError> {
    table.only(&[KEYS, kind(table)?.keys, spring::KEYS])
}

/// The type that goes by another name, with or without "joint" behind it.
fn meant_by(word: &str) -> Option<&'static str> {
    let word = word.to_lowercase().replace([' ', '-'], "_").replace('\'', "");
    let word = word.strip_suffix("joint").unwrap_or(&word).trim_end_matches('_');
    let other = OTHER_NAMES.iter().find(|(_, others)| others.contains(&word));
    other.map(|(name, _)| *name)
}

/// Reads a joint of a type and adds its elements.
fn read(
    table: &Table<'_>,
    name: String,
    (kind, of_all): (&JointType, Realisation),
    assembly: &mut Assembly,
) -> Result<(Joint, Vec<Hinge>), SceneError> {
    let site = Site::read(table, kind, assembly)?;
    let spring = spring::read(table, spring::AXIAL)?;
    let realisation = realisation::read(table, kind, spring, of_all)?;
    let joint = Joint { realisation, ..site.joint(table, name, spring, assembly)? };
    let hinges = (kind.expand)(table, &joint, assembly)?;
    Ok((joint, hinges))
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn every_other_name_is_of_a_type_and_of_one() {
        let all =
            || OTHER_NAMES.iter().flat_map(|(name, others)| others.iter().map(move |o| (name, *o)));
        for (name, other) in all() {
            assert!(TYPES.iter().any(|kind| kind.name == *name), "{name}");
            assert!(TYPES.iter().all(|kind| kind.name != other), "{other}");
            assert_eq!(all().filter(|(_, o)| *o == other).count(), 1, "{other}");
        }
        for word in ["U-joint", "u_joint", "Cardan joint", "Hooke's"] {
            assert_eq!(meant_by(word), Some("universal"), "{word}");
        }
        assert_eq!(meant_by("revolut"), None);
    }
}
