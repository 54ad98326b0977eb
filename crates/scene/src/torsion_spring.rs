//! `[[torsion_spring]]`: a spring about an axis of the first body, with preload and damping.

use crate::assembly::Assembly;
use crate::between::Between;
use crate::error::SceneError;
use crate::points::Heading;
use crate::spring;
use crate::target::{Elements, Target};
use crate::text::{Number, Table};

pub(crate) const KEYS: &[&str] = &["name", "between", "axis", "preload", "limits"];

/// Reads all torsion springs in scene order and names them for messages:
/// `torsion_spring 1 (world–crank)`.
pub(crate) fn read_all(
    root: &Table<'_>,
    assembly: &mut Assembly,
    elements: &mut Elements,
) -> Result<Vec<String>, SceneError> {
    let mut names = Vec::new();
    for table in root.list("torsion_spring")? {
        table.only(&[KEYS, spring::KEYS])?;
        elements.read_optional(&table, "torsion_spring", Target::TorsionSpring(names.len()))?;
        let pair = table.required("between", Between(assembly))?;
        let axis = table.required("axis", Heading(assembly))?;
        let written = axis;
        let axis = assembly.carried_direction(pair.a, axis);
        assembly.resolve_direction(table.value("axis"), written, axis);
        let spring = spring::read(&table, spring::TORSIONAL)?;
        let preload = table.optional("preload", Number::any("N·m"))?.unwrap_or(0.0);
        assembly
            .add_torsion_spring(&pair, axis, spring, preload)
            .map_err(|defect| defect.refuse(&table))?;
        names.push(pair.label(&table));
    }
    Ok(names)
}

#[cfg(test)]
mod tests {
    use dbd_kernel::attitude::Attitude as _;
    use dbd_kernel::{Quaternion, Vec3};

    use crate::example;

    /// The axis is stored in the first body and the torsion angle is 0 at the initial pose.
    #[test]
    fn the_axis_is_the_first_bodys_and_the_twist_starts_at_zero() {
        let scene = example::with(
            "[[torsion_spring]]\nbetween = [\"arm\", \"hand\"]\naxis = [3, 0, 4]\nstiffness = 5\n\
             preload = -2\n[[torsion_spring]]\nbetween = [\"world\", \"hand\"]\naxis = [0, 0, -7]\n\
             stiffness = { load = 3, deflection = 0.5 }",
        );
        assert_eq!(
            scene.torsion_names,
            ["torsion_spring 1 (arm–hand)", "torsion_spring 2 (world–hand)"]
        );
        let [first, second] = &scene.model.torsions[..] else { panic!("two springs") };
        let states = &scene.model.initial;
        let world = states[0].orientation.rotation().to_world(first.axis);
        let gap = world - Vec3::new(0.6, 0.0, 0.8);
        assert!(libm::sqrt(gap.dot(gap)) < 1e-15);
        assert_eq!(second.axis, Vec3::new(0.0, 0.0, -1.0));
        assert_eq!((first.stiffness, first.preload), (5.0, -2.0));
        assert_eq!((second.stiffness, second.preload), (6.0, 0.0));
        let hand = Some(&states[1].orientation);
        for (spring, a) in [(first, Some(&states[0].orientation)), (second, None)] {
            let torsion_angle = spring
                .torsion_angle(&spring.since_start(Quaternion::relative(a, hand)).unwrap(), 0);
            assert!(torsion_angle.angle.abs() < 1e-15, "{:e}", torsion_angle.angle);
            assert_eq!(spring.damper.row(), None);
        }
    }
}
