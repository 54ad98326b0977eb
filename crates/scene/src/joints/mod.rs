//! `[[joint]]`: each expands into the TSDA set of its type.
//!
//! `table => groups in the assembly, description of the joint`. Each type is one file with one [`JointType`], which
//! defines its name, keys and expansion.

mod assemble;
mod cylindrical;
mod fixed;
mod info;
mod kind;
mod rates;
mod realisation;
mod revolute;
mod site;
mod spherical;
mod translational;
mod triad;
mod types;
mod universal;

pub use assemble::{Assembled, Moved, OpenJoint};
pub(crate) use assemble::{ROUNDING, read as assemble};
pub use info::JointInfo;
pub use kind::Realisation;
pub(crate) use types::{allow, holds, keys, types};

use dbd_kernel::Vec3;

use crate::assembly::Assembly;
use crate::error::SceneError;
use crate::hinge::Hinge;
use crate::joints::kind::{Joint, JointType};
use crate::joints::site::Site;
use crate::joints::types::{KEYS, kind};
use crate::pair::Pair;
use crate::spring;
use crate::target::{Elements, Target};
use crate::text::Table;

/// Geometry of a joint, for laws about and along its axis.
pub(crate) struct JointPlace {
    /// Its type.
    pub(crate) kind: &'static str,
    pub(crate) name: String,
    /// Its bodies, exchanged if the ground is the second one: the second is a body here.
    pub(crate) pair: Pair,
    /// \[m\] world.
    pub(crate) at_w: Vec3<f64>,
    /// World; the sign convention is that of the joint coordinate.
    pub(crate) axis_w: Vec3<f64>,
    /// Its last group, which acts on its second body.
    pub(crate) group: usize,
}

impl JointPlace {
    fn of(kind: &'static str, joint: &Joint, group: usize) -> Self {
        let (name, axis, pair) = (joint.name.clone(), joint.axes[0], &joint.pair);
        let (pair, axis_w) =
            if pair.b.is_world() { (pair.reversed(), -axis) } else { (pair.clone(), axis) };
        Self { kind, name, pair, at_w: joint.at_w, axis_w, group }
    }
}

/// The keys of tables within a joint and within `[assemble]`.
pub(crate) const WITHIN: [(&str, &[&str]); 4] = [
    ("assemble", assemble::KEYS),
    ("spider", universal::SPIDER),
    ("halves", site::HALVES),
    ("rate", rates::RATES),
];

/// Axes of a joint without an axis.
const NO_AXES: [Vec3<f64>; 2] = [Vec3::new(0.0, 0.0, 1.0); 2];

/// Joints are created at free length. If the points deviate by more than this fraction of it, the joint is too far
/// from its bodies or too small for the resolution of coordinates.
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
        // Without a spider a universal joint constrains only the freedoms that its two bodies lose.
        let brought = if spider.is_some() { 0 } else { kind.brings };
        places.push(JointPlace::of(kind.name, &joint, assembly.groups().len().saturating_sub(1)));
        infos.push(JointInfo {
            name,
            kind: kind.name,
            between: joint.pair.names,
            at: joint.at_w,
            axes: if kind.keys.iter().any(|key| key.starts_with("ax")) {
                joint.axes
            } else {
                NO_AXES
            },
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
    // One pass over all elements, because a scene may have thousands of joints.
    let extensions = assembly.largest_extensions();
    for (table, info) in tables.iter().zip(&mut infos) {
        for number in info.groups.clone() {
            let group = &assembly.groups()[number];
            let (extension, reach) = (extensions[number], assembly.size(number));
            // A spherical joint of a bushing may have no size.
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
        "cannot be assembled: its points are off by {extension:e} m with springs of {reach:e} m"
    );
    let help = "use a larger joint, or move it nearer to the origin and to its bodies: coordinates have \
                16 digits";
    table.refuse(&problem, help)
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
