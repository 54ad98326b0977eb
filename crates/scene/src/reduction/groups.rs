//! Groups in a plane.
//!
//! `scene, bodies in the plane => groups with the same numbers, what leaves the plane`.

use dbd_kernel::index::{ClearanceIndex, DamperIndex};
use dbd_kernel::model::{Group, Law};
use dbd_kernel::{BodyState, F64, PointBushing, PointOnLine, Tsda, Vec3};

use crate::planar::{ALIKE, Plane, short};
use crate::reduction::departure::{Leaves, Part};
use crate::reduction::elements::{Element, Placed, coupling};
use crate::reduction::reduced::{Arm, Reduced, reduced};
use crate::runtime::SceneModel;
use crate::scene::Scene;

/// Largest fraction of a joint's force that may act across the plane.
const ACROSS: f64 = 1e-8;

/// Adds all groups; returns the rows of those that are equally stiff at rest only.
pub(super) fn read(
    scene: &Scene,
    plane: &Plane,
    near: f64,
    model: &mut SceneModel<F64>,
    leaves: &mut Leaves<'_>,
) -> Vec<usize> {
    let states = model.initial.clone();
    let placed = Placed { model: &scene.model, plane, states: &states };
    let raw = scene.joints.last().map_or(0, |joint| joint.groups.end);
    let mut owners = scene
        .joints
        .iter()
        .enumerate()
        .flat_map(|(row, joint)| joint.groups.clone().map(move |_| row));
    let mut at_rest = Vec::new();
    for (row, group) in scene.model.groups.iter().enumerate() {
        let elements = placed.elements(group);
        let clearance = group.clearance.row().and_then(|row| scene.model.clearances.get(row));
        // Raw elements stay what they are, each by itself.
        let (part, at_once) = match owners.next() {
            Some(joint) => {
                let turns = turns(scene, plane, joint);
                stays(Part::Joint(joint), &elements, turns, near, leaves);
                (Part::Joint(joint), elements.len())
            }
            None => {
                lies(Part::Raw(row - raw), &elements, near, leaves);
                (Part::Raw(row - raw), 1)
            }
        };
        let law = match group.law {
            Law::Revolute | Law::Universal => Law::PointBushing,
            law => law,
        };
        let clearance = clearance.copied().unwrap_or(0.0);
        let found = elements.chunks(at_once.max(1)).map(|some| reduced(law, some, clearance, near));
        match found.collect::<Result<Vec<_>, _>>().map(|found| together(found, group)) {
            Ok(Some(found)) => {
                if !found.is_exact {
                    at_rest.push(row);
                }
                add(model, &states, group, &found);
            }
            Ok(None) => {}
            Err(obstacle) => leaves(part, "type", &format!(": it {obstacle}")),
        }
    }
    at_rest
}

/// The elements of a group that were reduced one by one, as its triples; `None` without any.
fn together(each: Vec<Reduced>, group: &Group) -> Option<Reduced> {
    let mut each = each.into_iter();
    let mut all = each.next()?;
    let (one, arms) = (all.triples.len(), usize::from(group.arms));
    for other in each {
        all.is_exact &= other.is_exact;
        all.triples.extend(other.triples);
    }
    if all.triples.len() > one && all.triples.iter().all(|triple| triple.len() == 1) {
        all.triples = all.triples.concat().chunks(arms).map(<[_]>::to_vec).collect();
    }
    Some(all)
}

/// \[degrees\] tilt of the axis of a revolute joint, or the nearer axis of a universal joint, against the normal;
/// `None` without tilt, and for joints that need not rotate to move in the plane.
fn turns(scene: &Scene, plane: &Plane, joint: usize) -> Option<f64> {
    let joint = scene.joints.get(joint)?;
    if !["revolute", "universal"].contains(&joint.kind) {
        return None;
    }
    let axes = joint.hinges.iter().map(|hinge| plane.of_body_inward(hinge.a.row(), hinge.axis));
    let axis_errors = axes.map(|axis| libm::atan2(libm::hypot(axis.x, axis.y), axis.z.abs()));
    let least = axis_errors.fold(f64::INFINITY, f64::min);
    (least > ALIKE).then(|| least.to_degrees())
}

/// Reports a joint that does not stay in the plane.
fn stays(part: Part, elements: &[Element], turns: Option<f64>, near: f64, leaves: &mut Leaves<'_>) {
    let found = coupling(elements, near);
    if let Some(axis_error) = turns {
        leaves(
            part,
            "axis",
            &format!(": its axis is tilted by {} degrees from the normal", short(axis_error)),
        );
    } else if found.height.abs() > near {
        leaves(part, "at", &format!(" by {} m", short(found.height)));
    } else if found.share > ACROSS {
        let by = format!(": a fraction {} of an in-plane force acts across it", short(found.share));
        leaves(part, "axis", &by);
    }
}

/// Reports a raw element that does not lie in the plane.
fn lies(part: Part, elements: &[Element], near: f64, leaves: &mut Leaves<'_>) {
    for element in elements {
        let off = |v: Vec3<f64>| if v.z.abs() > near { Some(v.z) } else { None };
        // For a line normal to the plane any point is valid.
        let from = if element.line.is_some_and(|line| line.z.abs() > 0.5) {
            None
        } else {
            off(element.from)
        };
        let key = if element.line.is_some() { ["line_point", "point"] } else { ["points"; 2] };
        for (z, key) in [from, off(element.to)].into_iter().zip(key) {
            if let Some(z) = z {
                leaves(part, key, &format!(" by {} m", short(z)));
                return;
            }
        }
    }
}

/// Adds a group between the bodies of another.
fn add(model: &mut SceneModel<F64>, states: &[BodyState<F64>], of: &Group, reduced: &Reduced) {
    let Reduced { law, line, triples, clearance, .. } = reduced;
    let alike = triples.iter().all(|triple| triple.len() == triples[0].len());
    let alone: Vec<Vec<Arm>>;
    let triples = if alike && triples[0].len() <= 3 {
        triples
    } else {
        alone = triples.iter().flatten().map(|arm| vec![*arm]).collect();
        &alone
    };
    let arms: Vec<&Arm> = triples.iter().flatten().collect();
    let placed = |body: usize, place: Vec3<f64>| match states.get(body) {
        Some(state) => state.orientation.rotation().to_body(place - state.position),
        None => place,
    };
    let flat = |v: Vec3<f64>| Vec3::new(v.x, v.y, 0.0);
    let centre = |arm: &Arm| match arm.points {
        Some([centre, _]) => centre,
        None => flat(placed(of.a.row(), arm.from)),
    };
    let tip = |arm: &Arm| match arm.points {
        Some([_, tip]) => tip,
        None => flat(placed(of.b.row(), arm.to)),
    };
    let point = model.points.len() as u16;
    model.points.extend(triples.iter().map(|triple| centre(&triple[0])));
    model.points.extend(arms.iter().map(|arm| tip(arm)));
    let damper = match arms.iter().any(|arm| arm.damping > 0.0) {
        true => DamperIndex(model.dampers.len() as u16),
        false => DamperIndex::NONE,
    };
    if damper != DamperIndex::NONE {
        model.dampers.extend(arms.iter().map(|arm| arm.damping));
        model.dampers.resize(usize::from(damper.0) + law.damper_rows(arms.len(), true), 0.0);
    }
    let own = match *clearance > 0.0 {
        true => ClearanceIndex(model.clearances.len() as u16),
        false => ClearanceIndex::NONE,
    };
    if own != ClearanceIndex::NONE {
        model.clearances.push(*clearance);
    }
    let element = match law {
        Law::Tsda => model.tsdas.len(),
        Law::PointBushing | Law::Revolute | Law::Universal => model.bushings.len(),
        Law::PointOnLine => model.lines.len(),
    } as u16;
    for arm in &arms {
        let (stiffness, free_length) = (arm.stiffness, arm.free_length);
        match law {
            Law::Tsda => model.tsdas.push(Tsda::from_f64(stiffness, free_length)),
            Law::PointBushing | Law::Revolute | Law::Universal => {
                model.bushings.push(PointBushing::from_f64(stiffness));
            }
            Law::PointOnLine => {
                let along = line.unwrap_or(Vec3::ZERO);
                let along = match states.get(of.a.row()) {
                    Some(state) => state.orientation.rotation().to_body(along),
                    None => along,
                };
                let along = flat(along).to_f64();
                model.lines.push(PointOnLine::from_f64(along, stiffness, free_length));
            }
        }
    }
    model.groups.push(Group {
        law: *law,
        a: of.a,
        b: of.b,
        triples: triples.len() as u8,
        arms: triples[0].len() as u8,
        shared: false,
        point,
        element,
        damper,
        clearance: own,
    });
}
