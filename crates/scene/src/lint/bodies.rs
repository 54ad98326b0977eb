//! Bodies that nothing holds, islands, plausibility of mass and inertia.

use dbd_kernel::Vec3;

use crate::facts::Facts;
use crate::interactions::{InteractionInfo, interactions};
use crate::lint::warning::{Severity, Warning, short};
use crate::scene::Scene;

/// Points may lie this many radii of gyration from the centre of mass. A rod's ends lie 1.7 away;
/// at 30 the body is a grain on a long bar without mass, or its inertia has the wrong unit.
const FAR_POINTS: f64 = 30.0;

/// A radius of gyration of this many times the distance of the farthest point: a joint is near the
/// middle of a large body, or its inertia has the wrong unit.
const NEAR_POINTS: f64 = 100.0;

/// A least principal moment below this share of the greatest: a needle of 1 m and 0.8 mm across.
const NEEDLE: f64 = 1e-6;

/// The heaviest body against the lightest: the step is the light one's, the motion the heavy one's.
const MASS_RATIO: f64 = 1e6;

pub(super) fn judge(scene: &Scene, facts: &Facts, warnings: &mut Vec<Warning>) {
    let farthest = farthest_points(scene);
    let interactions = interactions(scene);
    let acts_on = |info: &&InteractionInfo, row: usize| info.bodies.iter().any(|b| b.row() == row);
    for (row, farthest) in farthest.iter().enumerate() {
        plausibility(scene, row, *farthest, warnings);
    }
    mass_ratio(scene, warnings);
    for island in &facts.islands {
        let first = island.bodies[0];
        if island.elements == 0 {
            let text = if scene.model.gravity.is_empty() {
                "no element holds it: it keeps its velocity"
            } else {
                "no element holds it: it falls"
            };
            warnings.push(of_body(scene, first, Severity::Warning, text));
        } else if !island.grounded {
            let severity =
                if scene.model.gravity.is_empty() { Severity::Note } else { Severity::Warning };
            let with = match island.bodies.len() {
                1 => String::new(),
                2 => " with 1 more body".into(),
                bodies => format!(" with {} more bodies", bodies - 1),
            };
            let falls = if scene.model.gravity.is_empty() { "" } else { " and falls" };
            let text = format!("hangs together{with} but not with the world{falls}");
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
                    true => "only torsion springs hold it, and they hold no place",
                    false => {
                        "only torsion springs or interactions about an axis hold it, and they hold no place"
                    }
                };
                warnings.push(of_body(scene, row, Severity::Warning, text));
            }
        }
    }
}

fn of_body(scene: &Scene, row: usize, severity: Severity, text: &str) -> Warning {
    let name = &scene.body_names[row];
    let line = scene.line_of_body(row);
    Warning { severity, name: format!("body `{name}`"), line, text: text.into() }
}

/// \[m\] per body the farthest of its points from its centre of mass, `None` without points.
fn farthest_points(scene: &Scene) -> Vec<Option<f64>> {
    let mut farthest = vec![None; scene.model.bodies.len()];
    for group in &scene.model.groups {
        let first = usize::from(group.point);
        let centres = first + usize::from(group.stars);
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
        // A plane has no end: its point is anywhere on it.
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
                "its inertia is that of a body of {size} m (radius of gyration), but elements act \
                 {far_text} m from its centre of mass: is the inertia in kg·m², the point in m?"
            ));
        } else if gyration > NEAR_POINTS * far {
            warn(format!(
                "its inertia is that of a body of {size} m (radius of gyration), but all elements \
                 act within {far_text} m of its centre of mass: is the inertia in kg·m²?"
            ));
        }
    }
    if least < NEEDLE * greatest {
        warn(format!(
            "its principal moments differ by a factor of {}: about the smallest it turns so easily \
             that it may decide the step",
            short(greatest / least)
        ));
    }
}

fn mass_ratio(scene: &Scene, warnings: &mut Vec<Warning>) {
    let masses = || scene.model.bodies.iter().map(|body| body.mass).enumerate();
    let least = masses().min_by(|a, b| a.1.total_cmp(&b.1));
    let greatest = masses().max_by(|a, b| a.1.total_cmp(&b.1));
    if let (Some((light, least)), Some((heavy, greatest))) = (least, greatest)
        && greatest > MASS_RATIO * least
    {
        let text = format!(
            "has {} of the mass of `{}`: its vibration decides the step of the whole scene",
            short(least / greatest),
            scene.body_names[heavy]
        );
        warnings.push(of_body(scene, light, Severity::Warning, &text));
    }
}
