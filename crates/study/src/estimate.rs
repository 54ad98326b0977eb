//! Estimated cost of a step on Cortex-M4F, for scenes whose steps were not counted.
//!
//! `(scene, method, counts) => instructions per step`. A step of leapfrog in f32 has fixed numbers of instructions per
//! body, per rotation axis of a body, and per element; those of laws are counted by `cargo xtask cost --elements`.
//! Another scheme or precision scales it by the median ratio of counted scenes. Inputs hold their values, those of laws
//! excepted; what setting them costs is the difference of two columns of docs/costs.csv. A test compares it with every
//! counted row.

use dbd_kernel::model::{Group, Law};
use dbd_plant::plan::step_of;
use dbd_plant::{DampingName, Frequencies, Method, Named as _, PrecisionName, SchemeName, plant};
use dbd_scene::Scene;
use dbd_scene::laws::known_law;
use serde::Deserialize;

use crate::costs::Costs;

/// Instructions of a step more with each element, as counted.
const ELEMENTS: &str = include_str!("../elements.csv");

/// Instructions of both damper passes per body without a damper, from a trace of a limit within its range.
const PASSES: f64 = 140.0;

/// The columns that are read.
#[derive(Deserialize)]
struct Element {
    element: String,
    instructions_mean: f64,
    planar_instructions_mean: Option<f64>,
}

/// The package of the laws that are counted.
const KERNEL: &str = "dbd-kernel";

/// Steps after which the rotation axes are determined: as many as are counted.
const STEPS: u64 = 68;

/// Instructions per body, per rotation axis, per element and per damped element: in space and in a plane.
/// Fitted to the rows of leapfrog in f32 in docs/costs.csv by least squares of the relative errors. Dampers of torsion
/// springs and of bushings, dampers in a plane and damping modes: gripper, cart-pendulum and a gate of five revolute
/// joints, counted by `cargo cost`. Not counted, and taken from the most similar element: spatial point bushings; in a
/// plane torsion springs, points on lines, revolute and universal bushings.
struct Share {
    body: f64,
    axis: f64,
    tsda: f64,
    line: f64,
    point_bushing: f64,
    revolute: f64,
    universal: f64,
    torsion: f64,
    /// Sweeps: of a TSDA, of a direction of a bushing, of a point on a line.
    dampers: [f64; 3],
    /// By sweeps, then joint-wise: of a torsion spring's damper.
    torsion_damper: [f64; 2],
    /// Joint-wise: of a damping mode of a joint to the ground, of one between two bodies.
    levers: [f64; 2],
    /// Joint-wise, of a group that still uses sweeps, in addition to its dampers.
    swept: f64,
}

const IN_SPACE: Share = Share {
    body: 322.0,
    axis: 109.0,
    tsda: 45.0,
    line: 102.0,
    point_bushing: 60.0,
    revolute: 10.0,
    universal: 81.0,
    torsion: 169.0,
    dampers: [639.0, 665.0, 1239.0],
    torsion_damper: [920.0, 885.0],
    levers: [196.0, 305.0],
    swept: 0.0,
};

/// From the planar scenes that were counted.
const IN_PLANE: Share = Share {
    body: 140.0,
    axis: 0.0,
    tsda: 32.0,
    line: 45.0,
    point_bushing: 29.0,
    revolute: 29.0,
    universal: 29.0,
    torsion: 80.0,
    dampers: [620.0, 500.0, 670.0],
    torsion_damper: [450.0, 345.0],
    levers: [130.0, 260.0],
    swept: 1100.0,
};

/// Instructions of a step of a scene by a method; `None` for a damping mode, scheme or precision without counts, for
/// scenes with dampers and other schemes than leapfrog and semi-implicit Euler, and with custom laws.
#[must_use]
pub fn instructions(scene: &Scene, method: &Method, counted: &Costs) -> Option<f64> {
    let model = scene.stepped();
    let share = if scene.planar.is_some() { &IN_PLANE } else { &IN_SPACE };
    let joint_wise = match method.foreign_damping().map(|damping| damping.name()) {
        None => false,
        Some(name) if name == DampingName::JointWise.name() => true,
        Some(_) => return None,
    };
    let name = method.scheme_name();
    let kicks = name == SchemeName::Leapfrog.name() || name == SchemeName::SemiImplicitEuler.name();
    let interactions = dbd_scene::interactions(scene);
    let damped = interactions.iter().filter(|interaction| interaction.dampers > 0).count();
    if !kicks && (!model.dampers.is_empty() || damped > 0) {
        return None;
    }
    let mut sum = share.body * model.bodies.len() as f64;
    sum += share.axis * turning(scene) as f64 + share.torsion * model.torsions.len() as f64;
    for group in &model.groups {
        let each = match group.law {
            Law::Tsda => share.tsda,
            Law::PointOnLine => share.line,
            Law::PointBushing => share.point_bushing,
            Law::Revolute => share.revolute,
            Law::Universal => share.universal,
        };
        sum += group.elements() as f64 * each;
        if group.damper.row().is_some() {
            sum += share.damped(group, joint_wise, scene.planar.is_some());
        }
    }
    let turned = model.torsions.iter().filter(|spring| spring.damper.row().is_some()).count();
    sum += share.torsion_damper[usize::from(joint_wise)] * turned as f64;
    for interaction in interactions {
        sum += of_law(interaction.law, interaction.dampers > 0, scene.planar.is_some())?;
    }
    // The passes over all bodies are part of each damped element as it was counted, and made once.
    sum -= PASSES * model.bodies.len() as f64 * damped.saturating_sub(1) as f64;
    let ratio = counted.over_leapfrog(
        name,
        method.newton(),
        method.precision_name(),
        method.orientation_name(),
    )?;
    Some(sum * ratio)
}

/// The counted element of a law, of the same name unless it shares one: limits within their range, contacts in contact,
/// friction that slides.
fn element(law: &str, damped: bool) -> &str {
    match law {
        "end-stop" | "hinge-stop" | "distance-stop" => "limits-free",
        "soft-end-stop" | "soft-hinge-stop" | "soft-distance-stop" => "limits-soft",
        "plane-contact" => "contact-pressed",
        "sphere-contact" => "balls",
        "wheel-contact" => "wheel",
        "bushing" if !damped => "bushing-undamped",
        "distance-spring" => "spring-table",
        "distance-damper" => "damper-table",
        "distance-winch" => "winch",
        "hinge-friction" | "slide-friction" => "friction",
        "hinge-friction-load" | "slide-friction-load" => "friction-load",
        "hinge-servo" | "slide-servo" => "servo",
        "hinge-drive" | "slide-drive" => "drive",
        "hinge-drive-friction" | "slide-drive-friction" => "drive",
        "hinge-drive-dq" => "drive-dq",
        "hinge-sensor" | "slide-sensor" => "sensor",
        "hinge-actuator" | "slide-actuator" => "actuator",
        _ => law,
    }
}

/// Instructions of a law in a step of leapfrog in f32; `None` for a custom law.
///
/// # Panics
/// Never: a test reads the table.
fn of_law(law: &str, damped: bool, planar: bool) -> Option<f64> {
    // A custom law may have the name of an element, or replace a law of the kernel.
    known_law(law).filter(|known| known.package[0] == KERNEL)?;
    let name = element(law, damped);
    let mut reader = csv::ReaderBuilder::new().comment(Some(b'#')).from_reader(ELEMENTS.as_bytes());
    let rows = reader.deserialize().map(|row| row.expect("a test reads the table"));
    let row: Element = rows.into_iter().find(|row: &Element| row.element == name)?;
    if planar { row.planar_instructions_mean } else { Some(row.instructions_mean) }
}

impl Share {
    /// Of a group's dampers.
    fn damped(&self, group: &Group, joint_wise: bool, planar: bool) -> f64 {
        let elements = group.elements();
        // Joint-wise damping modes, and directions in which its elements damp.
        let of_bushings = group.law.damper_rows(elements, planar);
        let (levers, directions) = match (group.law, planar) {
            (Law::Tsda, false) => ([0, 1, 0, 3, 0, 0, 5].get(elements).copied().unwrap_or(6), 1),
            (Law::Tsda, true) => ([0, 1, 2].get(elements).copied().unwrap_or(3), 1),
            (Law::PointOnLine, false) => (if elements < 6 { 0 } else { 5 }, 1),
            (Law::PointOnLine, true) => (if elements < 3 { 0 } else { 2 }, 1),
            (Law::PointBushing, false) => (of_bushings, 3),
            (Law::Revolute, false) => (of_bushings, 5),
            (Law::Universal, false) => (0, 4),
            (Law::PointBushing | Law::Revolute | Law::Universal, true) => (of_bushings, 2),
        };
        if joint_wise && levers > 0 && group.clearance.row().is_none() {
            let grounded = [group.a, group.b].iter().any(|body| body.is_world());
            let [ground, between] = self.levers;
            return levers as f64 * if grounded { ground } else { between };
        }
        let [tsda, bushing, line] = self.dampers;
        let each = match group.law {
            Law::Tsda => tsda,
            Law::PointOnLine => line,
            _ => f64::from(directions) * bushing,
        };
        elements as f64 * each + if joint_wise { self.swept } else { 0.0 }
    }
}

/// Number of rotation axes of all bodies together.
fn turning(scene: &Scene) -> usize {
    let all = 3 * scene.model.bodies.len();
    let method = Method::default().with_precision(PrecisionName::F32);
    let longest = || Frequencies::of(scene).default_limit(&method, scene.duration);
    let stepped = step_of(scene, None, longest).ok().and_then(|step| {
        let mut plant = plant(scene, &method, step).ok()?;
        plant.advance(STEPS).is_ok().then(|| plant.state())
    });
    let Some(state) = stepped else { return all };
    let rates = state.bodies.iter().flat_map(|body| body.angular_velocity.to_f64());
    rates.filter(|rate| *rate != 0.0).count()
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn every_law_of_the_kernel_has_been_counted() {
        for law in dbd_scene::laws::known_laws() {
            for damped in [false, true] {
                let count = of_law(law.name, damped, false);
                assert!(count.is_some_and(|count| count > 0.0), "{} {count:?}", law.name);
            }
        }
        for custom in ["my-law", "winch", "plain"] {
            assert_eq!(of_law(custom, false, false), None);
        }
    }
}
