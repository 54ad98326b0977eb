//! Solids that represent bodies, joints and the ground.
//!
//! `(mechanism, size) => solids in the axes of each node`. Widths are fractions of the mechanism's size.

use std::cmp::Ordering;

use crate::picture::Mechanism;
use crate::picture::mechanism::{JointKind, JointMark, Outline, Place, Solid};
use dbd_kernel::{Quaternion, Vec3};
use gltf::json::{Index, Material};

use super::file::File;
use super::solids::Solids;

/// Widths as fractions of the mechanism's size.
const BAR: f64 = 0.012;
const THIN: f64 = 0.006;
const JOINT: f64 = 0.02;

/// Distinct for people who see few colours, too (Okabe & Ito 2008).
const COLOURS: [[u8; 3]; 6] =
    [[86, 180, 233], [230, 159, 0], [0, 158, 115], [204, 121, 167], [0, 114, 178], [213, 94, 0]];

/// Materials and widths \[m\].
pub(super) struct Look {
    bodies: Vec<Index<Material>>,
    pub(super) joint: Index<Material>,
    pub(super) ground: Index<Material>,
    pub(super) spring: Index<Material>,
    pub(super) driven: Index<Material>,
    bar: f64,
    pub(super) thin: f64,
    wide: f64,
}

impl Look {
    /// For a mechanism of a size \[m\].
    pub(super) fn new(file: &mut File, size: f64) -> Self {
        let size = if size > 0.0 && size.is_finite() { size } else { 1.0 };
        let bodies = COLOURS.iter().map(|colour| file.material("body", *colour)).collect();
        Self {
            bodies,
            joint: file.material("joint", [60, 64, 72]),
            ground: file.material("ground", [120, 124, 130]),
            spring: file.material("spring", [150, 160, 60]),
            driven: file.material("driven spring", [200, 60, 50]),
            bar: BAR * size,
            thin: THIN * size,
            wide: JOINT * size,
        }
    }

    /// The material of a body.
    pub(super) fn body(&self, row: usize) -> Index<Material> {
        self.bodies[row % self.bodies.len()]
    }
}

/// The solids of a scene's geometry, each with its material: its own colour's, else `plain`.
pub(super) fn shapes(
    file: &mut File,
    shapes: &[Solid],
    plain: Index<Material>,
) -> Vec<(Solids, Index<Material>)> {
    let solids = |shape: &Solid| {
        let mut solids = Solids::default();
        match shape {
            Solid::Box { at, turn, half, .. } => {
                solids.add_turned_box(Vec3::from_f64(*at), Quaternion::from_f64(*turn), *half);
            }
            Solid::Cylinder { ends, radius, .. } => {
                let [from, to] = ends.map(Vec3::from_f64);
                solids.add_rod(from, to, *radius);
            }
            Solid::Link { ends, radius, .. } => {
                let [from, to] = ends.map(Vec3::from_f64);
                solids.add_rod(from, to, *radius);
                solids.add_ball(from, *radius);
                solids.add_ball(to, *radius);
            }
            Solid::Sphere { at, radius, .. } => solids.add_ball(Vec3::from_f64(*at), *radius),
        }
        solids
    };
    let material = |shape: &Solid| {
        let colour = shape.colour().and_then(bytes);
        colour.map_or(plain, |colour| file.material("geometry", colour))
    };
    let materials: Vec<_> = shapes.iter().map(material).collect();
    shapes.iter().map(solids).zip(materials).collect()
}

/// The bytes of `#rrggbb`.
fn bytes(colour: &str) -> Option<[u8; 3]> {
    let number = u32::from_str_radix(colour.strip_prefix('#')?, 16).ok()?;
    let [_, red, green, blue] = number.to_be_bytes();
    Some([red, green, blue])
}

/// Appearance of a body without geometry.
pub(super) fn outline(outline: &Outline, look: &Look) -> Solids {
    let mut solids = Solids::default();
    match outline {
        Outline::Bar { ends } => {
            let [a, b] = ends.map(Vec3::from_f64);
            solids.add_rod(a, b, look.bar);
            solids.add_ball(a, look.bar);
            solids.add_ball(b, look.bar);
        }
        Outline::Plate { points } => {
            let points: Vec<_> = points.iter().map(|point| Vec3::from_f64(*point)).collect();
            solids.add_plate(&points, look.bar);
        }
        Outline::Block { half } => solids.add_box(Vec3::ZERO, *half),
        Outline::Spider => {}
    }
    solids
}

/// Symbols of joints, on each body.
pub(super) fn joints(mechanism: &Mechanism, look: &Look) -> Vec<Solids> {
    let mut solids = vec![Solids::default(); mechanism.bodies.len()];
    for joint in &mechanism.joints {
        // On the first body; on the second where that is the ground.
        let place = joint.places.iter().find(|place| place.body.is_some());
        let Some((place, own)) = place.and_then(|place| Some((place, place.body?))) else {
            continue;
        };
        if let Some(solids) = solids.get_mut(own) {
            mark(solids, mechanism, joint, place, look);
        }
    }
    solids
}

fn mark(solids: &mut Solids, mechanism: &Mechanism, joint: &JointMark, at: &Place, look: &Look) {
    let point = Vec3::from_f64(at.point);
    // Axes may belong to the other body: they are taken as they lie at t = 0.
    let axes = joint.axes.iter().map(|axis| {
        let tip = mechanism.place(at) + mechanism.along(axis);
        Vec3::from_f64(mechanism.local(at.body, tip).point) - point
    });
    let (reach, radius) = (1.6 * look.wide, 0.7 * look.wide);
    let mut any = false;
    for axis in axes {
        any = true;
        let [from, to] = [point - axis * reach, point + axis * reach];
        match joint.kind {
            JointKind::Translational => solids.add_prism(from, to, look.wide, 4),
            JointKind::Cylindrical => {
                solids.add_rod(point - axis * (1.5 * reach), point + axis * (1.5 * reach), radius);
            }
            JointKind::Universal => solids.add_rod(from, to, 0.4 * look.wide),
            _ => solids.add_rod(from, to, radius),
        }
    }
    match joint.kind {
        JointKind::Fixed => solids.add_box(point, [0.8 * look.wide; 3]),
        _ if !any => solids.add_ball(point, look.wide),
        _ => {}
    }
}

/// Symbols of the ground, at the attachments of joints and elements.
pub(super) fn ground(mechanism: &Mechanism, look: &Look) -> Solids {
    let mut solids = Solids::default();
    let joints = mechanism.joints.iter().flat_map(|joint| &joint.places);
    let springs = mechanism.springs.iter().flat_map(|spring| &spring.ends);
    let held = joints.chain(springs).chain(mechanism.guides.iter().map(|guide| &guide.line));
    let mut points: Vec<[f64; 3]> =
        held.filter(|place| place.body.is_none()).map(|place| place.point).collect();
    let order = |a: &[f64; 3], b: &[f64; 3]| {
        a.iter().zip(b).map(|(a, b)| a.total_cmp(b)).find(|o| o.is_ne()).unwrap_or(Ordering::Equal)
    };
    points.sort_by(order);
    points.dedup();
    for point in points {
        solids.add_box(Vec3::from_f64(point), [1.1 * look.wide; 3]);
    }
    for guide in mechanism.guides.iter().filter(|guide| guide.line.body.is_none()) {
        let (at, along) = (Vec3::from_f64(guide.line.point), mechanism.along(&guide.direction));
        let reach = 10.0 * look.wide;
        solids.add_rod(at - along * reach, at + along * reach, 0.5 * look.thin);
    }
    solids
}
