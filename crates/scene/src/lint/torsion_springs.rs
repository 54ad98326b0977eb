//! Torsion springs without effect, or whose torsion angle is not that of a joint.

use std::collections::HashMap;

use dbd_kernel::{BodyIndex, TorsionSpring, Vec3};

use crate::facts::axis_w;
use crate::lint::warning::{Severity, Warning, short};
use crate::scene::Scene;

/// Sine of the angle between a spring's axis and its joint's: 0.06°.
const ASKEW: f64 = 1e-3;

pub(super) fn check(scene: &Scene, warnings: &mut Vec<Warning>) {
    let springs = scene.model.torsions.iter().take(scene.torsion_springs());
    let revolutes = Revolutes::of(scene);
    for (number, spring) in springs.enumerate() {
        let mut warn = |severity, text: String| {
            let name = scene.torsion_names.get(number).cloned().unwrap_or_default();
            let line = scene.file_lines.torsion_springs.get(number).copied();
            warnings.push(Warning { severity, name, line, text });
        };
        if spring.stiffness == 0.0 && spring.preload == 0.0 && spring.damper.row().is_none() {
            let text = "has neither stiffness nor damping nor preload: it has no effect";
            warn(Severity::Warning, text.into());
        }
        let revolutes = revolutes.between(spring.a, spring.b);
        let axis = axis_of(scene, spring);
        let sine = |joint_axis: Vec3<f64>| {
            let cross = joint_axis.cross(axis);
            libm::sqrt(cross.dot(cross))
        };
        let nearest = revolutes.iter().min_by(|a, b| sine(a.1).total_cmp(&sine(b.1)));
        match nearest {
            Some((name, joint_axis)) if sine(*joint_axis) > ASKEW => {
                let degrees = libm::asin(sine(*joint_axis).min(1.0)).to_degrees();
                warn(
                    Severity::Warning,
                    format!(
                        "its axis is {} degrees off that of the revolute joint `{name}` between \
                         the same bodies",
                        short(degrees)
                    ),
                );
            }
            Some(_) => {}
            None => warn(
                Severity::Note,
                "no revolute joint guides its two bodies: its torsion angle is undefined after \
                 half a revolution about another axis"
                    .into(),
            ),
        }
    }
}

/// The axis at the initial pose, world.
fn axis_of(scene: &Scene, spring: &TorsionSpring<f64>) -> Vec3<f64> {
    match scene.model.initial.get(spring.a.row()) {
        Some(state) => state.orientation.rotation().to_world(spring.axis),
        None => spring.axis,
    }
}

/// Names and axes of the revolute joints, universal joints included, by their pair of bodies.
struct Revolutes<'s>(HashMap<[u16; 2], Vec<(&'s str, Vec3<f64>)>>);

impl<'s> Revolutes<'s> {
    fn of(scene: &'s Scene) -> Self {
        let mut found: HashMap<_, Vec<_>> = HashMap::new();
        for joint in scene.joints.iter().filter(|j| matches!(j.kind, "revolute" | "universal")) {
            for number in joint.groups.clone() {
                let group = &scene.model.groups[number];
                if let Some(axis) = axis_w(scene, number) {
                    let between = pair(group.a, group.b);
                    found.entry(between).or_default().push((joint.name.as_str(), axis));
                }
            }
        }
        Self(found)
    }

    /// The ones between two bodies, in scene order.
    fn between(&self, a: BodyIndex, b: BodyIndex) -> &[(&'s str, Vec3<f64>)] {
        self.0.get(&pair(a, b)).map_or(&[], Vec::as_slice)
    }
}

/// Two bodies in canonical order.
fn pair(a: BodyIndex, b: BodyIndex) -> [u16; 2] {
    [a.0.min(b.0), a.0.max(b.0)]
}
