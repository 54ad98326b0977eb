//! `[[load]]`: a constant force and torque on a body during a time window.

use dbd_kernel::{Load, LoadFrame, Vec3};

use crate::assembly::Assembly;
use crate::between::BodyName;
use crate::error::SceneError;
use crate::text::{Choice, Number, Numbers, Seconds, Table};

pub(crate) const KEYS: &[&str] = &["body", "force", "torque", "frame", "from", "until"];

/// Reads all loads in scene order.
pub(crate) fn read_all(root: &Table<'_>, assembly: &mut Assembly) -> Result<(), SceneError> {
    for table in root.list("load")? {
        table.only(&[KEYS])?;
        let (_, body) = table.required("body", BodyName { assembly, world: false })?;
        let force = table.optional("force", Numbers(Number::any("N")))?;
        let torque = table.optional("torque", Numbers(Number::any("N·m")))?;
        if force.is_none() && torque.is_none() {
            let help = "give `force` in N, `torque` in N·m, or both, each an array of 3 numbers";
            return Err(table.refuse("has neither `force` nor `torque`", help));
        }
        let frame = match table.optional("frame", Choice(&["world", "body"]))? {
            Some(1) => LoadFrame::Body,
            _ => LoadFrame::World,
        };
        let from = table.optional("from", Seconds::any())?.unwrap_or(0.0);
        let until = table.optional("until", Seconds::any())?.unwrap_or(f64::INFINITY);
        if until <= from {
            let help = "give an `until` after `from`, or omit it for a load that never ends";
            let problem = format!("is {until}, not after `from` = {from}");
            return Err(table.refuse_value("until", &problem, help));
        }
        let vector = |given: Option<[f64; 3]>| {
            let vector = Vec3::from_f64(given.unwrap_or_default());
            if frame == LoadFrame::Body { assembly.of_written(body, vector) } else { vector }
        };
        let (force, torque) = (vector(force), vector(torque));
        assembly.add_load(Load { body, frame, force, torque, from, until });
    }
    Ok(())
}

#[cfg(test)]
mod tests {
    use dbd_kernel::{BodyIndex, LoadFrame, Vec3};

    use crate::example;

    #[test]
    fn a_load_is_in_world_axes_and_lasts_where_nothing_else_is_said() {
        let scene = example::with(
            "[[load]]\nbody = \"hand\"\nforce = [0, 3, 0]\n[[load]]\nbody = \"arm\"\n\
             torque = [0, 0, 0.05]\nframe = \"body\"\nfrom = 0.5\nuntil = 2",
        );
        let [first, second] = &scene.model.loads[..] else { panic!("two loads") };
        assert_eq!((first.body, first.frame), (BodyIndex(1), LoadFrame::World));
        assert_eq!((first.from, first.until), (0.0, f64::INFINITY));
        assert_eq!((first.force, first.torque), (Vec3::new(0.0, 3.0, 0.0), Vec3::ZERO));
        assert_eq!((second.body, second.frame), (BodyIndex(0), LoadFrame::Body));
        assert_eq!((second.from, second.until), (0.5, 2.0));
        let timed = example::with(
            "[[load]]\nbody = \"arm\"\nforce = [0, 3, 0]\nfrom = \"-1ms\"\nuntil = \"20us\"",
        );
        let [load] = &timed.model.loads[..] else { panic!("one load") };
        assert_eq!((load.from, load.until), (-1e-3, 2e-5));
        assert_eq!((second.force, second.torque), (Vec3::ZERO, Vec3::new(0.0, 0.0, 0.05)));
    }
}
