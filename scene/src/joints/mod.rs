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
    for table in root.list("joint")? {
        let kind = kind(&table)?;
        table.only(&[KEYS, kind.keys, spring::KEYS])?;
        let name = names.read(&table)?;
        infos.push(read(&table, kind, name, assembly)?);
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

fn read(
    table: &Table<'_>,
    kind: &JointType,
    name: String,
    assembly: &mut Assembly,
) -> Result<JointInfo, SceneError> {
    let pair = table.required("between", Between(assembly))?;
    let at_w = Vec3::from_f64(table.required("at", Numbers(Number::any("m, world")))?);
    let spring = spring::read(table, spring::AXIAL)?;
    let joint = Joint { pair, at_w, spring };

    let first = assembly.group_count();
    (kind.expand)(table, &joint, assembly)?;
    let (tsdas, assembly_error) =
        assembly.extensions(first).map_err(|defect| defect.refuse(table))?;
    Ok(JointInfo {
        name,
        kind: kind.name,
        between: joint.pair.names,
        holds: kind.holds,
        tsdas,
        assembly_error,
    })
}
