//! Unconnected bodies, islands, plausibility of mass and inertia.

use dbd_kernel::elements::input::InputKind;
use dbd_kernel::{F64, Vec3};

use crate::facts::Facts;
use crate::interactions::{InteractionInfo, interactions};
use crate::lint::warning::{Severity, Warning, short};
use crate::scene::Scene;

/// Largest distance of a point from the centre of mass in radii of gyration. A rod's ends are at 1.7; beyond 30 the
/// body is a grain on a long massless bar, or its inertia has the wrong unit.
const FAR_POINTS: f64 = 30.0;

/// Largest radius of gyration in distances of the farthest point: beyond it the joints are near the middle of a large
/// body, or its inertia has the wrong unit.
const NEAR_POINTS: f64 = 100.0;

/// Smallest ratio of principal moments: that of a needle 1 m long and 0.8 mm across.
const NEEDLE: f64 = 1e-6;

/// Largest ratio of masses: the lightest body limits the step, the heaviest determines the motion.
const MASS_RATIO: f64 = 1e6;

pub(super) fn check(scene: &Scene, facts: &Facts, warnings: &mut Vec<Warning>) {
    let farthest = farthest_points(scene);
    let interactions = interactions(scene);
    let acts_on = |info: &&InteractionInfo, row: usize| info.bodies.iter().any(|b| b.row() == row);
    for (row, farthest) in farthest.iter().enumerate() {
        plausibility(scene, row, *farthest, warnings);
    }
    mass_ratio(scene, warnings);
    for island in &facts.islands {
        let first = island.bodies[0];
        let is_driven = |row: &usize| scene.model.bodies[*row].is_driven();
        if island.bodies.iter().any(is_driven) {
            continue;
        }
        let is_flown = island.bodies.iter().any(|row| is_flown(scene, *row));
        let falls = has_gravity(scene) && !is_flown;
        if island.elements == 0 {
            let (severity, text) = match is_flown {
                true => (Severity::Note, "only forces of inputs act on it"),
                false if falls => (Severity::Warning, "no element acts on it: it falls freely"),
                false => (Severity::Warning, "no element acts on it: it keeps its velocity"),
            };
            warnings.push(of_body(scene, first, severity, text));
        } else if !island.grounded {
            let severity = if falls { Severity::Warning } else { Severity::Note };
            let with = match island.bodies.len() {
                1 => String::new(),
                2 => " to 1 more body".into(),
                bodies => format!(" to {} more bodies", bodies - 1),
            };
            let falls = if falls { " and falls" } else { "" };
            let text = format!("is connected{with} but not to the world{falls}");
            warnings.push(of_body(scene, first, severity, &text));
        }
        if island.elements > 0 {
            for &row in island.bodies.iter().filter(|row| farthest[**row].is_none()) {
                let own: Vec<_> = interactions.iter().filter(|info| acts_on(info, row)).collect();
                let turns = |info: &&InteractionInfo| info.points.is_none() && info.axis.is_some();
                if !own.iter().all(turns) {
                    continue;
                }
                let text = match own.is_empty() {
                    true => "only torsion springs act on it: nothing constrains its position",
                    false => {
                        "only torsion springs or interactions about an axis act on it: nothing \
                         constrains its position"
                    }
                };
                warnings.push(of_body(scene, row, Severity::Warning, text));
            }
        }
    }
}

/// Whether the scene or an input of it has gravity.
fn has_gravity(scene: &Scene) -> bool {
    let is_gravity = |kind: &InputKind<F64>| matches!(kind, InputKind::Gravity { .. });
    !scene.model.gravity.is_empty()
        || scene.model.inputs.iter().any(|input| is_gravity(&input.kind))
}

/// Whether a caller's force may carry a body, as a rotor's thrust does.
fn is_flown(scene: &Scene, row: usize) -> bool {
    let carries =
        |kind: &InputKind<F64>| matches!(kind, InputKind::Force { body, .. } if body.row() == row);
    let inputs = scene.model.inputs.iter().zip(&scene.inputs);
    inputs.into_iter().any(|(input, info)| !info.table && carries(&input.kind))
}

fn of_body(scene: &Scene, row: usize, severity: Severity, text: &str) -> Warning {
    let name = &scene.body_names[row];
    let line = scene.line_of_body(row);
    Warning { severity, name: format!("body `{name}`"), line, text: text.into() }
}

/// \[m\] distance of each body's farthest point from its centre of mass; `None` without points.
fn farthest_points(scene: &Scene) -> Vec<Option<f64>> {
    let mut farthest = vec![None; scene.model.bodies.len()];
    for group in &scene.model.groups {
        let first = usize::from(group.point);
        let centres = first + usize::from(group.triples);
        for (body, points) in
            [(group.a, first..centres), (group.b, centres..first + group.points())]
        {
            let Some(farthest) = farthest.get_mut(body.row()) else { continue };
            for point in &scene.model.points[points] {
                let distance = libm::sqrt(point.dot(*point));
                *farthest = Some(farthest.unwrap_or(0.0_f64).max(distance));
            }
        }
    }
    for info in interactions(scene) {
        // A plane is unbounded: its point may be anywhere on it.
        let first = usize::from(info.normal.is_some());
        for (body, [x, y, z]) in
            info.bodies.iter().zip(info.points.into_iter().flatten()).skip(first)
        {
            let Some(farthest) = farthest.get_mut(body.row()) else { continue };
            let distance = libm::sqrt(x * x + y * y + z * z);
            *farthest = Some(farthest.unwrap_or(0.0_f64).max(distance));
        }
    }
    farthest
}

fn plausibility(scene: &Scene, row: usize, farthest: Option<f64>, warnings: &mut Vec<Warning>) {
    let body = &scene.model.bodies[row];
    let Vec3 { x, y, z } = body.inertia;
    let (least, greatest) = (x.min(y).min(z), x.max(y).max(z));
    let gyration = libm::sqrt(greatest / body.mass);
    let mut warn = |text: String| {
        warnings.push(of_body(scene, row, Severity::Warning, &text));
    };
    if let Some(far) = farthest.filter(|far| *far > 0.0) {
        let (size, far_text) = (short(gyration), short(far));
        if far > FAR_POINTS * gyration {
            warn(format!(
                "its inertia gives a radius of gyration of {size} m, but elements act {far_text} m \
                 from its centre of mass; check that the inertia is in kg·m² and the point in m"
            ));
        } else if gyration > NEAR_POINTS * far {
            warn(format!(
                "its inertia gives a radius of gyration of {size} m, but all elements act within \
                 {far_text} m of its centre of mass; check that the inertia is in kg·m²"
            ));
        }
    }
    if least < NEEDLE * greatest {
        warn(format!(
            "its principal moments differ by a factor of {}: the smallest may limit the step size",
            short(greatest / least)
        ));
    }
}

fn mass_ratio(scene: &Scene, warnings: &mut Vec<Warning>) {
    let bodies = || scene.model.bodies.iter().enumerate();
    let masses =
        || bodies().filter(|(_, body)| !body.is_driven()).map(|(row, body)| (row, body.mass));
    let least = masses().min_by(|a, b| a.1.total_cmp(&b.1));
    let greatest = masses().max_by(|a, b| a.1.total_cmp(&b.1));
    if let (Some((light, least)), Some((heavy, greatest))) = (least, greatest)
        && greatest > MASS_RATIO * least
    {
        let text = format!(
            "has {} of the mass of `{}`: its vibration limits the step size of the whole scene",
            short(least / greatest),
            scene.body_names[heavy]
        );
        warnings.push(of_body(scene, light, Severity::Warning, &text));
    }
}
