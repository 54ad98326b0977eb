//! Raw elements: springs between points, points on lines, torsion springs, interactions.

use dbd_kernel::elements::input::InputKind;
use dbd_kernel::model::{Group, Law};
use dbd_scene::{InteractionInfo, Scene};

use super::attached::{Pivots, centres, row, tips};
use super::parts::{Along, GuideMark, InteractionMark, Mechanism, Place, SpringMark, TorsionMark};

/// Springs and guides of a scene, in the order of their groups.
pub(super) fn raw(scene: &Scene, mechanism: &Mechanism) -> (Vec<SpringMark>, Vec<GuideMark>) {
    let model = &scene.model;
    let driven: Vec<usize> = model
        .inputs
        .iter()
        .filter_map(|input| match input.kind {
            InputKind::Actuator { group, .. } => Some(group.row()),
            _ => None,
        })
        .collect();
    let (mut springs, mut guides) = (Vec::new(), Vec::new());
    let first = scene.joints.iter().map(|joint| joint.groups.end).max().unwrap_or(0);
    let raw = model.groups.iter().enumerate().skip(first);
    for ((number, group), label) in raw.zip(scene.raw_names()) {
        let name = named(label);
        let (centres, tips) = (centres(scene, group), tips(scene, group));
        let ends = |element: usize| {
            let (triple, leg) = (element / usize::from(group.arms), element % tips.len().max(1));
            let (centre, tip) = (centres.get(triple)?, tips.get(leg)?);
            Some([
                Place { body: row(group.a), point: centre.to_f64() },
                Place { body: row(group.b), point: tip.to_f64() },
            ])
        };
        match group.law {
            Law::PointOnLine => {
                let line = model.lines.get(usize::from(group.element));
                let (Some(line), Some(ends)) = (line, ends(0)) else { continue };
                let direction = Along { body: row(group.a), vector: line.direction.to_f64() };
                let [from, point] = [ends[0], ends[1]].map(|end| mechanism.place(&end));
                let n = mechanism.along(&direction);
                let foot = mechanism.local(ends[0].body, from + n * (point - from).dot(n));
                guides.push(GuideMark { name, line: foot, direction, point: ends[1] });
            }
            Law::Tsda | Law::PointBushing | Law::Revolute | Law::Universal => {
                let (free_length, driven) = (free_length(scene, group), driven.contains(&number));
                let marks = (0..group.elements()).filter_map(ends);
                let mark = |ends| SpringMark { name: name.clone(), ends, free_length, driven };
                springs.extend(marks.map(mark));
            }
        }
    }
    (springs, guides)
}

fn free_length(scene: &Scene, group: &Group) -> f64 {
    match group.law {
        Law::Tsda => {
            let tsda = scene.model.tsdas.get(usize::from(group.element));
            tsda.map_or(0.0, |tsda| tsda.free_length)
        }
        Law::PointBushing | Law::PointOnLine | Law::Revolute | Law::Universal => 0.0,
    }
}

/// The name within an element's name in messages: "tsda `strut` (shell–knuckle)".
fn named(label: &str) -> Option<String> {
    let (_, rest) = label.split_once(" `")?;
    rest.rsplit_once("` (").map(|(name, _)| name.to_owned())
}

/// Torsion springs, without those that only count revolutions.
pub(super) fn torsions(scene: &Scene, mechanism: &Mechanism, pivots: &Pivots) -> Vec<TorsionMark> {
    let springs = scene.model.torsions.iter().take(scene.torsion_springs());
    springs
        .zip(&scene.torsion_names)
        .map(|(spring, label)| {
            let (a, b) = (row(spring.a), row(spring.b));
            let centre = |body| Place { body, point: [0.0; 3] };
            let at = pivots.between(a, b).unwrap_or_else(|| match (a, b) {
                (Some(_), Some(_)) => {
                    let [from, to] = [a, b].map(|body| mechanism.place(&centre(body)));
                    mechanism.local(a, from + (to - from) * 0.5)
                }
                _ => centre(b.or(a)),
            });
            let axis = Along { body: a, vector: spring.axis.to_f64() };
            TorsionMark { name: named(label), at, axis }
        })
        .collect()
}

/// The interactions whose law has points or an axis; sensors exert no force.
pub(super) fn interactions(scene: &Scene, pivots: &Pivots) -> Vec<InteractionMark> {
    let infos = dbd_scene::interactions(scene).into_iter();
    let has_place = |info: &InteractionInfo| {
        (info.points.is_some() || info.axis.is_some()) && !info.law.ends_with("-sensor")
    };
    let mark = |info: InteractionInfo| {
        let [a, b] = info.bodies.map(row);
        let along = |vector| Along { body: a, vector };
        let centre = Place { body: b, point: [0.0; 3] };
        let ends = |[first, second]: [[f64; 3]; 2]| {
            [Place { body: a, point: first }, Place { body: b, point: second }]
        };
        InteractionMark {
            name: info.name().map(str::to_owned),
            law: info.law,
            ends: info.points.map(ends),
            normal: info.normal.map(along),
            axis: info.axis.map(along),
            at: pivots.between(a, b).unwrap_or(centre),
        }
    };
    infos.filter(has_place).map(mark).collect()
}

#[cfg(test)]
mod tests {
    use super::named;

    #[test]
    fn only_what_has_a_name_is_named() {
        assert_eq!(named("tsda `a `b` (x)` (world–c)").as_deref(), Some("a `b` (x)"));
        assert_eq!(named("tsda 3 (world–c)"), None);
    }
}
