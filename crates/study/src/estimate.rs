//! Estimated cost of a step on Cortex-M4F, for scenes whose steps were not counted.
//!
//! `(scene, method, counts) => instructions per step`. A step of leapfrog in f32 has fixed numbers of instructions per
//! body, per rotation axis of a body, and per element; another scheme or precision scales it by the median ratio of
//! counted scenes. Inputs hold their values. A test compares it with every counted row.

use dbd_kernel::model::{Group, Law};
use dbd_plant::plan::step_of;
use dbd_plant::{DampingName, Frequencies, Method, Named as _, PrecisionName, SchemeName, plant};
use dbd_scene::Scene;

use crate::costs::Costs;

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
    /// Of each law, its first body the ground: stops within their range, friction that slides. Counted by `cargo cost`
    /// in projects of `host-sim new firmware` with one joint, less the same without the law.
    laws: [(&'static str, f64); 10],
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
    laws: [
        ("end-stop", 530.0),
        ("hinge-stop", 1108.0),
        ("distance-stop", 470.0),
        ("hinge-friction", 2567.0),
        ("slide-friction", 1472.0),
        ("plane-contact", 3480.0),
        ("distance-spring", 136.0),
        ("distance-damper", 1230.0),
        ("hinge-spring", 261.0),
        ("hinge-damper", 1202.0),
    ],
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
    laws: [
        ("end-stop", 413.0),
        ("hinge-stop", 765.0),
        ("distance-stop", 406.0),
        ("hinge-friction", 1653.0),
        ("slide-friction", 1070.0),
        ("plane-contact", 1920.0),
        ("distance-spring", 110.0),
        ("distance-damper", 937.0),
        ("hinge-spring", 199.0),
        ("hinge-damper", 891.0),
    ],
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
    if !kicks && !model.dampers.is_empty() {
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
    for interaction in dbd_scene::interactions(scene) {
        let law = share.laws.iter().find(|(name, _)| *name == interaction.law)?;
        sum += law.1;
    }
    let ratio = counted.over_leapfrog(
        name,
        method.newton(),
        method.precision_name(),
        method.orientation_name(),
    )?;
    Some(sum * ratio)
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
