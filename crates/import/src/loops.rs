//! Equalities between bodies, which close loops.
//!
//! `<connect> => spherical joint, <weld> => fixed joint, <joint> => coupling`. Between bodies they are closed at the
//! file's pose, as in MuJoCo: the second endpoint coincides with the first there. Between sites they may be open.

use nalgebra::{Isometry3, Vector3};

use crate::couplings;
use crate::defaults::Attributes;
use crate::element::{Attribute, Element};
use crate::error::Fault;
use crate::mechanism::{Link, Mechanism, Type};
use crate::omission::{Kind, Omissions};
use crate::schema::EQUALITIES;
use crate::settings::{Settings, quaternion};
use crate::tree::{Tree, WORLD, moved};

/// \[rad\] below this angle a weld is considered unrotated at the start.
const TURNED: f64 = 1e-6;

/// Adds the joints of all equalities in order.
pub(crate) fn add(
    mechanism: &mut Mechanism<'_>,
    root: &Element,
    settings: &Settings,
    omissions: &mut Omissions,
) -> Result<(), Fault> {
    if settings.is_off("equality") {
        return Ok(());
    }
    for section in root.sections("equality") {
        for element in &section.children {
            let equality = Attributes::own(element);
            if !equality.flag("active", true)? {
                mechanism.notes.push(format!("{} is inactive and left out", element.called()));
                continue;
            }
            match element.name.as_str() {
                "connect" | "weld" => joint(mechanism, &equality, omissions)?,
                "joint" => {
                    if let Some(why) = couplings::equality(mechanism, &equality)? {
                        omit(element, why, omissions);
                    }
                }
                name if EQUALITIES.contains(&name) => {
                    omit(element, "a scene cannot couple these", omissions);
                }
                _ => {}
            }
        }
    }
    Ok(())
}

fn omit(element: &Element, why: &str, omissions: &mut Omissions) {
    let part = |name: &str| element.text(name).map(|value| format!("{name} {value}"));
    let names = ["joint1", "joint2", "tendon1", "tendon2", "flex", "polycoef"];
    let words: Vec<String> = names.into_iter().filter_map(part).collect();
    omissions.add(
        Kind::Equality,
        element.place,
        format!("{}: {}: {why}", element.called(), words.join(", ")),
    );
}

/// The bodies connected by an equality: two bodies, a point of each, the second's frame in the first's.
struct Held {
    bodies: [usize; 2],
    points: [Vector3<f64>; 2],
    relative: Isometry3<f64>,
}

fn joint(
    mechanism: &mut Mechanism<'_>,
    given: &Attributes<'_>,
    omissions: &mut Omissions,
) -> Result<(), Fault> {
    let element = given.element;
    let held = match (given.get("site1"), given.get("site2")) {
        (Some(first), Some(second)) => of_sites(mechanism.tree, first, second)?,
        (None, None) => of_bodies(mechanism, given)?,
        _ => {
            let message = format!("{} names only one site", element.called());
            return Err(Fault::at(
                element.place,
                message,
                "give site1 and site2, or body1 and body2",
            ));
        }
    };
    let between = held.bodies.map(|body| mechanism.side(body));
    let called = element.called();
    if between[0] == between[1] {
        mechanism.notes.push(format!(
            "{called} connects bodies that are already rigid with each other and is left out"
        ));
        return Ok(());
    }
    let [a, b] = held.bodies;
    let start = &mechanism.pose.start;
    let turned = (start[a].rotation * held.relative.rotation).angle_to(&start[b].rotation);
    let weld = element.name == "weld";
    if weld && turned > TURNED {
        let what = format!(
            "{called}: at the start its bodies are rotated by {turned} rad from the welded pose"
        );
        omissions.add(Kind::Equality, element.place, what);
        return Ok(());
    }
    let names = held.bodies.map(|body| mechanism.tree.bodies[body].name.clone());
    let name = element.text("name").map_or_else(|| names.join("-"), str::to_owned);
    let link = Link {
        name: mechanism.own_name(&name),
        kind: if weld { Type::Fixed } else { Type::Spherical },
        between,
        at: [mechanism.point(a, held.points[0]), mechanism.point(b, held.points[1])],
        span: mechanism.span(between),
        keys: Vec::new(),
        source: (format!("<{}> of `{}` and `{}`", element.name, names[0], names[1]), element.place),
    };
    mechanism.links.push(link);
    Ok(())
}

fn of_sites(tree: &Tree, first: &Attribute, second: &Attribute) -> Result<Held, Fault> {
    let ((a, one), (b, two)) = (tree.site(first)?, tree.site(second)?);
    Ok(Held {
        bodies: [a, b],
        points: [one.translation.vector, two.translation.vector],
        relative: one * two.inverse(),
    })
}

fn of_bodies(mechanism: &Mechanism<'_>, given: &Attributes<'_>) -> Result<Held, Fault> {
    let element = given.element;
    let missing = |name: &str| {
        let message = format!("{} has no `{name}`", element.called());
        Fault::at(element.place, message, "give body1, body2 and anchor, or site1 and site2")
    };
    let tree = mechanism.tree;
    let a = tree.body(given.get("body1").ok_or_else(|| missing("body1"))?)?;
    let b = given.get("body2").map_or(Ok(WORLD), |name| tree.body(name))?;
    let first = &mechanism.pose.first;
    let at_first = first[a].inverse() * first[b];
    let anchor = given.vector("anchor")?;
    if element.name == "connect" {
        let anchor = anchor.ok_or_else(|| missing("anchor"))?;
        let other = moved(&at_first.inverse(), anchor);
        return Ok(Held { bodies: [a, b], points: [anchor, other], relative: at_first });
    }
    let relative = match given.numbers("relpose", 7, 7)?.as_deref() {
        Some(&[x, y, z, w, i, j, k]) => quaternion([w, i, j, k])
            .map_or(at_first, |turn| Isometry3::from_parts(Vector3::new(x, y, z).into(), turn)),
        _ => at_first,
    };
    let anchor = anchor.unwrap_or_default();
    Ok(Held { bodies: [a, b], points: [moved(&relative, anchor), anchor], relative })
}
