//! `[[joint]]`: each expands into the TSDA set of its type.
//!
//! `table => groups in the assembly, what reports say of the joint`. A type is one file with one
//! [`JointType`]; its name, its keys and its expansion stand there and nowhere else.

mod revolute;
mod spherical;

use std::collections::BTreeMap;

use dbd_kernel::Vec3;

use crate::JointInfo;
use crate::assembly::{Assembly, Defect};
use crate::body::refuse_duplicate;
use crate::error::SceneError;
use crate::pair::{Between, Pair};
use crate::spring::{self, Spring};
use crate::text::{Choice, Number, Numbers, Table, Text};

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
const TYPES: [JointType; 2] = [spherical::TYPE, revolute::TYPE];

const KEYS: &[&str] = &["name", "type", "between", "at"];

/// Reads and expands all joints in scene order.
pub(crate) fn read_all(
    root: &Table<'_>,
    assembly: &mut Assembly,
) -> Result<Vec<JointInfo>, SceneError> {
    let mut lines = BTreeMap::new();
    let mut infos = Vec::new();
    for mut table in root.list("joint")? {
        if let Some(name) = table.optional("name", Text::Name)? {
            refuse_duplicate(&table, "joint", &name, &mut lines)?;
            table.rename(format!("joint `{name}`"));
        }
        infos.push(read(&table, assembly)?);
    }
    Ok(infos)
}

fn read(table: &Table<'_>, assembly: &mut Assembly) -> Result<JointInfo, SceneError> {
    let kind = &TYPES[table.required("type", Choice(&TYPES.map(|kind| kind.name)))?];
    table.only(&[KEYS, kind.keys, spring::KEYS])?;
    let name = table.required("name", Text::Name)?;
    let pair = table.required("between", Between(assembly))?;
    let at_w = Vec3::from_f64(table.required("at", Numbers(Number::any("m, world")))?);
    let spring = spring::read(table, spring::AXIAL)?;
    let joint = Joint { pair, at_w, spring };

    let first = assembly.groups().len();
    (kind.expand)(table, &joint, assembly)?;
    let (tsdas, assembly_error) = assembly.extensions(first..assembly.groups().len());
    if !assembly_error.is_finite() {
        return Err(Defect::OutOfRange.refuse(table));
    }
    Ok(JointInfo {
        name,
        kind: kind.name,
        between: joint.pair.names,
        holds: kind.holds,
        tsdas,
        assembly_error,
    })
}
