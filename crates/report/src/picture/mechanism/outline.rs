//! Outlines of bodies: a bar, a plate or a block, by the attachments of joints and elements.
//!
//! `(points of joints and elements, mass, inertia) => outline`. A box of mass m has the sides
//! `a² = 6·(I₂ + I₃ − I₁)/m`.

use std::collections::BTreeSet;

use dbd_kernel::Vec3;
use dbd_scene::Scene;

use super::parts::{Bounds, Mechanism, Outline, Place, length};
use super::solid::Solid;

/// Points closer than this fraction of the mechanism's size are merged.
const SAME: f64 = 1e-6;
/// A body whose points span less than this fraction of its box is drawn as the box, like a wheel on its bearing.
const WITHIN: f64 = 0.25;
/// Tolerance of a body's points outside of its shape, as a fraction of the longest side.
const PIN: f64 = 0.1;
/// Sides of a block: maximum as a fraction of the mechanism's size, minimum as a fraction of its longest side.
const LARGEST: f64 = 0.5;
const THINNEST: f64 = 0.04;

/// The outline of each body.
pub(super) fn outlines(
    scene: &Scene,
    mechanism: &Mechanism,
    spiders: &BTreeSet<usize>,
) -> Vec<Outline> {
    let held = held(mechanism);
    let size = size(mechanism, &held);
    let bodies = held.into_iter().zip(&scene.model.bodies).enumerate();
    bodies
        .map(|(row, (points, body))| {
            if spiders.contains(&row) {
                return Outline::Spider;
            }
            outline(distinct(points, SAME * size), body.mass, body.inertia.to_f64(), size)
        })
        .collect()
}

fn outline(points: Vec<Vec3<f64>>, mass: f64, inertia: [f64; 3], size: f64) -> Outline {
    let half = half_sides(mass, inertia, size);
    let longest = 2.0 * half.into_iter().fold(0.0, f64::max);
    let reach = points.iter().map(|point| length(*point)).fold(0.0, f64::max);
    if reach <= WITHIN * longest {
        return Outline::Block { half };
    }
    match points[..] {
        [] => Outline::Block { half },
        [point] => Outline::Bar { ends: [point.to_f64(), [0.0; 3]] },
        [a, b] => Outline::Bar { ends: [a.to_f64(), b.to_f64()] },
        _ => Outline::Plate { points: points.into_iter().map(Vec3::to_f64).collect() },
    }
}

/// Whether a solid contains all points of an outline, with a tolerance for a pin at its end.
pub(super) fn is_within(outline: &Outline, solid: &Solid) -> bool {
    let points: &[[f64; 3]] = match outline {
        Outline::Bar { ends } => ends,
        Outline::Plate { points } => points,
        Outline::Block { .. } | Outline::Spider => &[],
    };
    let corners = solid.corners();
    let ends = |axis: usize| {
        let along = || corners.iter().map(|corner| corner[axis]);
        [along().fold(f64::INFINITY, f64::min), along().fold(f64::NEG_INFINITY, f64::max)]
    };
    let ends = [0, 1, 2].map(ends);
    let pin = PIN * ends.iter().map(|[low, high]| high - low).fold(0.0, f64::max);
    points.iter().all(|point| {
        let mut axes = point.iter().zip(&ends);
        axes.all(|(at, [low, high])| (low - pin..=high + pin).contains(at))
    })
}

/// Half of each side \[m\] of the box of a mass and inertia.
fn half_sides(mass: f64, inertia: [f64; 3], size: f64) -> [f64; 3] {
    let [x, y, z] = inertia;
    let most = if size > 0.0 { LARGEST * size } else { f64::INFINITY };
    let side = |square: f64| libm::sqrt(6.0 * (square / mass).max(0.0));
    let sides = [y + z - x, z + x - y, x + y - z].map(side).map(|side| {
        // Of numbers that no box has.
        if side.is_finite() { side.min(most) } else { most.min(1.0) }
    });
    let longest = sides.into_iter().fold(0.0, f64::max);
    sides.map(|side| 0.5 * side.max(THINNEST * longest))
}

/// The attachment points of each body.
fn held(mechanism: &Mechanism) -> Vec<Vec<Vec3<f64>>> {
    let mut held = vec![Vec::new(); mechanism.bodies.len()];
    let mut hold = |place: &Place| {
        if let Some(points) = place.body.and_then(|row| held.get_mut(row)) {
            points.push(Vec3::from_f64(place.point));
        }
    };
    mechanism.joints.iter().flat_map(|joint| &joint.places).for_each(&mut hold);
    mechanism.springs.iter().flat_map(|spring| &spring.ends).for_each(&mut hold);
    for guide in &mechanism.guides {
        hold(&guide.line);
        hold(&guide.point);
    }
    for ends in mechanism.interactions.iter().filter_map(|one| one.ends.as_ref()) {
        hold(&ends[1]);
    }
    held
}

/// \[m\] the longest side of the box about all points and centres of mass.
fn size(mechanism: &Mechanism, held: &[Vec<Vec3<f64>>]) -> f64 {
    let mut bounds = Bounds::default();
    for (row, points) in held.iter().enumerate() {
        let centre = Place { body: Some(row), point: [0.0; 3] };
        bounds.add(mechanism.place(&centre));
        for point in points {
            bounds.add(mechanism.place(&Place { point: point.to_f64(), ..centre }));
        }
    }
    bounds.longest()
}

/// Distinct points, each the first of its cluster.
fn distinct(points: Vec<Vec3<f64>>, near: f64) -> Vec<Vec3<f64>> {
    /// Maximum number of attachments that are merged.
    const MAX: usize = 200;
    let mut apart: Vec<Vec3<f64>> = Vec::new();
    for point in points {
        if apart.len() > MAX || apart.iter().all(|other| length(point - *other) > near) {
            apart.push(point);
        }
    }
    apart
}
