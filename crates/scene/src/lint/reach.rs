//! Joints outside the extent of one of their bodies.
//!
//! `(mass, inertia, points) => joints beyond a body's extent`. The principal second moments of mass bound the extent: a
//! uniform convex body lies within √15 root mean square widths of its centre of mass (Kannan, Lovász & Simonovits 1995,
//! theorem 4.1: √(n(n+2)) in n dimensions; a rod's ends lie at 1.7, an ellipsoid's at 2.2, a box's corners at 3).

use dbd_kernel::Vec3;
use dbd_kernel::model::{Group, Law};

use crate::lint::warning::{Severity, Warning, short};
use crate::scene::Scene;

/// Square of the largest extent of a uniform convex body in root mean square widths.
const CONVEX: f64 = 15.0;

/// An element within this fraction of the extent is treated as central and gives no information on the body's size: a
/// bob may be held at its middle by a massless rod.
const MIDDLE: f64 = 0.1;

/// Distance of an element's nearest point from a body's centre of mass.
#[derive(Clone, Copy)]
struct Place {
    /// The group.
    group: usize,
    /// The body's row.
    body: usize,
    /// \[m\].
    distance: f64,
    /// Relative to the combined extent of body and element in that direction.
    part: f64,
}

pub(super) fn check(scene: &Scene, warnings: &mut Vec<Warning>) {
    let groups = scene.model.groups.iter().enumerate();
    let places: Vec<Place> =
        groups.flat_map(|(number, group)| places(scene, number, group)).collect();
    // Only bodies whose position is constrained are checked.
    let mut placed = vec![0_usize; scene.model.bodies.len()];
    for place in &places {
        placed[place.body] += usize::from((MIDDLE..=1.0).contains(&place.part));
    }
    for (number, joint) in scene.joints.iter().enumerate() {
        // Entries are in the order of their groups.
        let [from, until] = [joint.groups.start, joint.groups.end]
            .map(|group| places.partition_point(|place| place.group < group));
        let own = |place: &&Place| scene.body_names.get(place.body) != joint.spider.as_ref();
        let beyond = places[from..until].iter().filter(own);
        let beyond = beyond.filter(|p| p.part > 1.0 && placed[p.body] > 0);
        // For a joint off both bodies the farther one is reported.
        let Some(worst) = beyond.max_by(|a, b| a.part.total_cmp(&b.part)) else { continue };
        let text = format!(
            "lies {} m from the centre of mass of `{}`, {} times the extent that its mass and \
             inertia imply; check the body and `at`",
            short(worst.distance),
            scene.body_names[worst.body],
            short(worst.part),
        );
        let line = scene.file_lines.joints.get(number).copied();
        let name = format!("joint `{}`", joint.name);
        warnings.push(Warning { severity: Severity::Warning, name, line, text });
    }
}

/// The distances of a group's points from its two bodies.
fn places(scene: &Scene, number: usize, group: &Group) -> Vec<Place> {
    let first = usize::from(group.point);
    let centres = first + usize::from(group.triples);
    let last = first + group.points();
    let size = size(scene, number, group);
    // A line is unbounded: its points may be anywhere on it.
    let ends =
        [(group.a, first..centres, group.law != Law::PointOnLine), (group.b, centres..last, true)];
    let ends = ends.into_iter().filter(|(.., has_place)| *has_place);
    let place = |(index, points, _): (dbd_kernel::BodyIndex, std::ops::Range<usize>, bool)| {
        let body = scene.model.bodies.get(index.row())?;
        let reach = reach(body.mass, body.inertia);
        let measure = |p: &Vec3<f64>| {
            let along = |x: f64, reach: f64| x / (reach + size);
            let part = Vec3::new(along(p.x, reach.x), along(p.y, reach.y), along(p.z, reach.z));
            [part, *p].map(|v| libm::sqrt(v.dot(v)))
        };
        let nearest =
            scene.model.points[points].iter().map(measure).min_by(|a, b| a[0].total_cmp(&b[0]))?;
        Some(Place { group: number, body: index.row(), distance: nearest[1], part: nearest[0] })
    };
    ends.filter_map(place).collect()
}

/// \[m\] extent of a uniform convex body along its axes. A flat body is taken as thick as it is wide, because a rotor's
/// shaft weighs little.
fn reach(mass: f64, inertia: Vec3<f64>) -> Vec3<f64> {
    let Vec3 { x, y, z } = inertia;
    let width = |square: f64| libm::sqrt((CONVEX * square / (2.0 * mass)).max(0.0));
    let mut widths = [width(y + z - x), width(z + x - y), width(x + y - z)];
    let mut sorted = widths;
    sorted.sort_by(f64::total_cmp);
    for width in &mut widths {
        *width = width.max(sorted[1]);
    }
    Vec3::from_f64(widths)
}

/// \[m\] size of a joint: the length of its elements, or of those that its bushings replace.
fn size(scene: &Scene, number: usize, group: &Group) -> f64 {
    let element = usize::from(group.element);
    match group.law {
        Law::Tsda => scene.model.tsdas[element].free_length,
        Law::PointOnLine => scene.model.lines[element].free_length,
        Law::PointBushing | Law::Revolute | Law::Universal => {
            let row = scene.joints.partition_point(|joint| joint.groups.end <= number);
            scene.joints.get(row).map_or(0.0, |joint| joint.size)
        }
    }
}
