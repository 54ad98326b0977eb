//! `[[joint]]`: each expands into the TSDA set of its type.
//!
//! `table => groups in the assembly, what reports say of the joint`. A type is one file with one
//! [`JointType`]; its name, its keys and its expansion stand there and nowhere else.

mod revolute;
mod spherical;

use dbd_kernel::Vec3;

use crate::JointInfo;
use crate::assembly::Assembly;
use crate::error::SceneError;
use crate::names::Names;
use crate::pair::{Between, Pair};
use crate::spring::{self, Spring};
use crate::text::{Choice, Number, Numbers, Table};

/// A type of joint.
struct JointType {
    /// Its name in a scene.
    name: &'static str,
    /// Degrees of freedom of the pair that it holds.
    holds: u32,
    /// The keys it has besides those of every joint.
    keys: &'static [&'static str],
    /// Adds its elements to the assembly.
    expand: fn(&Table<'_>, &Joint, &mut Assembly) -> Result<(), SceneError>,
}

/// What every joint has.
struct Joint {
    pair: Pair,
    /// \[m\] its place, world.
    at_w: Vec3<f64>,
    spring: Spring,
}

/// In the order in which messages name them.
static TYPES: [JointType; 2] = [spherical::TYPE, revolute::TYPE];

const KEYS: &[&str] = &["name", "type", "between", "at"];

/// Reads and expands all joints in scene order.
pub(crate) fn read_all(
    root: &Table<'_>,
    assembly: &mut Assembly,
) -> Result<Vec<JointInfo>, SceneError> {
    let mut names = Names::new("joint");
    let mut infos = Vec::new();
    let mut first_groups = Vec::new();
    for table in root.list("joint")? {
        let kind = kind(&table)?;
        table.only(&[KEYS, kind.keys, spring::KEYS])?;
        let name = names.read(&table)?;
        first_groups.push(assembly.groups().len());
        let pair = read(&table, kind, assembly)?;
        infos.push(JointInfo {
            name,
            kind: kind.name,
            between: pair.names,
            holds: kind.holds,
            tsdas: 0,
            assembly_error: 0.0,
        });
    }
    // One pass over all elements, for a scene may have thousands of joints.
    let extensions = assembly.largest_extensions();
    for (number, (group, extension)) in assembly.groups().iter().zip(extensions).enumerate() {
        // Every group here is some joint's: the last one that began at or before it.
        let joint = first_groups.partition_point(|first| *first <= number) - 1;
        let info = &mut infos[joint];
        info.tsdas += group.elements();
        info.assembly_error = info.assembly_error.max(extension);
    }
    Ok(infos)
}

/// The type, which decides what further keys there may be.
fn kind(table: &Table<'_>) -> Result<&'static JointType, SceneError> {
    if !table.has("type") {
        let mut keys = vec![KEYS, spring::KEYS];
        keys.extend(TYPES.iter().map(|kind| kind.keys));
        table.only(&keys)?;
    }
    let index = table.required("type", Choice(&TYPES.each_ref().map(|kind| kind.name)))?;
    Ok(&TYPES[index])
}

/// Reads a joint of a type and adds its elements.
fn read(table: &Table<'_>, kind: &JointType, assembly: &mut Assembly) -> Result<Pair, SceneError> {
    let pair = table.required("between", Between(assembly))?;
    let at_w = Vec3::from_f64(table.required("at", Numbers(Number::any("m, world")))?);
    let spring = spring::read(table, spring::AXIAL)?;
    let joint = Joint { pair, at_w, spring };
    (kind.expand)(table, &joint, assembly)?;
    Ok(joint.pair)
}
