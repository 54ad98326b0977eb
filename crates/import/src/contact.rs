//! Pairs of geoms that can touch; a scene supports spheres, capsules and boxes on planes, and spheres on spheres.
//!
//! `geoms, <contact> => contacts, geoms with unsupported contacts`. Pairs are chosen as in MuJoCo: matching bits,
//! bodies neither rigid with each other nor adjacent in the tree, not excluded; and the pairs of `<contact>`.

use std::collections::BTreeSet;

use nalgebra::Vector3;

use crate::defaults::{Defaults, MAIN};
use crate::element::Element;
use crate::error::Fault;
use crate::geom::{Form, Grip, Surface};
use crate::interaction::Sides;
use crate::mass::Solid;
use crate::mechanism::{Contact, Interaction, Mechanism, rounded};
use crate::notation::number;
use crate::omission::{Kind, Omissions};
use crate::settings::Settings;
use crate::tree::{Tree, WORLD};

/// A solid on a plane, or a sphere on a sphere.
#[derive(Clone, Debug)]
pub(crate) struct Touch {
    /// Index of the plane or the first sphere among the geoms.
    base: usize,
    /// Index of the solid or the second sphere.
    solid: usize,
    grip: Grip,
}

impl Touch {
    /// Orders two geoms; `None` if they are not a supported pair, the second belongs to the world, or both are rigid with
    /// each other.
    fn of(tree: &Tree, [i, j]: [usize; 2], grip: Grip) -> Option<Self> {
        let form = |i: usize| tree.surfaces[i].form;
        let of = |i: usize| lead(tree, tree.surfaces[i].body);
        let is_sphere = |i: usize| matches!(form(i), Form::Solid(Solid::Sphere(_)));
        let spheres = is_sphere(i) && is_sphere(j);
        // The same pair has the same order.
        let (i, j) = if spheres { (i.min(j), i.max(j)) } else { (i, j) };
        let is_first = if spheres { of(j) != WORLD } else { form(i) == Form::Plane };
        let (base, solid) = if is_first { (i, j) } else { (j, i) };
        let meets = spheres || form(base) == Form::Plane && !form(solid).spheres().is_empty();
        (meets && of(solid) != WORLD && of(solid) != of(base)).then_some(Self { base, solid, grip })
    }
}

/// Lists contacts, and geoms with unsupported contacts.
pub(crate) fn find(
    root: &Element,
    tree: &Tree,
    settings: &Settings,
    defaults: &Defaults,
    omissions: &mut Omissions,
) -> Result<Vec<Touch>, Fault> {
    if settings.is_off("contact") {
        return Ok(Vec::new());
    }
    let mut touches = Vec::new();
    let mut excluded = BTreeSet::new();
    for section in root.sections("contact") {
        for child in &section.children {
            match child.name.as_str() {
                "exclude" => {
                    let body = |name: &str| -> Result<usize, Fault> {
                        let named = child.attribute(name).map(|name| tree.body(name));
                        let help = "<exclude body1=\"…\" body2=\"…\"/>";
                        named.unwrap_or_else(|| {
                            Err(Fault::at(child.place, format!("has no `{name}`"), help))
                        })
                    };
                    let (a, b) = (body("body1")?, body("body2")?);
                    excluded.insert((a.min(b), a.max(b)));
                }
                "pair" => {
                    let geom = |name| child.text(name).unwrap_or("?").to_owned();
                    let names = ["geom1", "geom2"].map(geom);
                    let known = |name: &String| {
                        tree.surfaces.iter().position(|one| one.name.as_ref() == Some(name))
                    };
                    let grip = Grip::of(&defaults.of(child, MAIN)?, [0, 3])?;
                    let both = known(&names[0]).zip(known(&names[1]));
                    match both.and_then(|(i, j)| Touch::of(tree, [i, j], grip)) {
                        Some(touch) => touches.push(touch),
                        None => {
                            let what = format!("pair of `{}` and `{}`", names[0], names[1]);
                            omissions.add(Kind::Contact, child.place, what);
                        }
                    }
                }
                other => {
                    let what = format!("<{other}> in <contact>");
                    omissions.add(Kind::Unknown, child.place, what);
                }
            }
        }
    }
    let rigid: Vec<usize> = (0..tree.bodies.len()).map(|body| lead(tree, body)).collect();
    let above: Vec<usize> = rigid.iter().map(|lead| rigid[tree.parent(*lead)]).collect();
    let touch = |i: usize, j: usize| {
        let (a, b) = (&tree.surfaces[i], &tree.surfaces[j]);
        let meet = a.kind & b.affinity != 0 || b.kind & a.affinity != 0;
        let (ra, rb) = (rigid[a.body], rigid[b.body]);
        let next = ra != WORLD && rb != WORLD && (above[a.body] == rb || above[b.body] == ra);
        let pair = (a.body.min(b.body), a.body.max(b.body));
        meet && ra != rb && !next && !excluded.contains(&pair)
    };
    let paired: BTreeSet<[usize; 2]> =
        touches.iter().map(|touch| [touch.base, touch.solid]).collect();
    let between = |i: usize, j: usize| {
        let grip = tree.surfaces[i].grip.and(tree.surfaces[j].grip);
        Touch::of(tree, [i, j], grip)
    };
    for i in 0..tree.surfaces.len() {
        let found = (0..i).filter(|j| touch(i, *j)).filter_map(|j| between(i, j));
        // An explicit pair overrides the bits.
        touches.extend(found.filter(|touch| !paired.contains(&[touch.base, touch.solid])));
    }
    for (i, surface) in tree.surfaces.iter().enumerate() {
        let others = 0..tree.surfaces.len();
        let others = others.filter(|j| touch(i, *j) && between(i, *j).is_none()).count();
        if others > 0 {
            let s = if others == 1 { "" } else { "s" };
            let what = format!("{}: may touch {others} other{s}", surface.words);
            omissions.add(Kind::Contact, surface.place, what);
        }
    }
    Ok(touches)
}

/// Adds the contacts of a mechanism.
pub(crate) fn add(mechanism: &mut Mechanism<'_>, touches: &[Touch]) {
    for Touch { base, solid, grip } in touches {
        let tree = mechanism.tree;
        let (plane, solid) = (&tree.surfaces[*base], &tree.surfaces[*solid]);
        let between = [plane.body, solid.body].map(|body| mechanism.side(body));
        let Some(part) = between[1] else { continue };
        let pose = |surface: &Surface| mechanism.pose.start[surface.body] * surface.pose;
        let (ground, placed) = (pose(plane), pose(solid));
        let normal = ground.rotation * Vector3::z();
        let stiffness = mechanism.options.stiffness;
        // Half of the critical damping for the body alone, as for joint friction.
        let shear = SHEAR * stiffness * mechanism.parts.parts[part].mass.mass;
        let damping = rounded(shear.sqrt());
        let source = (format!("{} on {}", solid.words, plane.words), solid.place);
        let called = solid.name.clone().unwrap_or_else(|| mechanism.name(Some(part)).to_owned());
        if let (Form::Solid(Solid::Sphere(first)), Form::Solid(Solid::Sphere(second))) =
            (plane.form, solid.form)
        {
            let at = [ground.translation.vector, placed.translation.vector];
            let sides = Sides { between, at };
            let mut keys = vec![
                sides.points(mechanism),
                format!("first_radius = {}", number(first + grip.margin())),
                format!("second_radius = {}", number(second)),
            ];
            keys.extend(mechanism.stop(None));
            keys.extend(grip.keys(damping));
            let name = mechanism.own_name(&format!("{called}-contact"));
            let law = "sphere-contact";
            mechanism.interactions.push(Interaction { name, law, between, keys, source });
            continue;
        }
        for (centre, radius) in solid.form.spheres() {
            let contact = Contact {
                name: mechanism.own_name(&format!("{called}-contact")),
                between,
                points: [
                    ground.translation.vector,
                    placed.translation.vector + placed.rotation * centre,
                ],
                normal,
                radius: radius + grip.margin(),
                grip: grip.keys(damping),
                source: source.clone(),
            };
            mechanism.contacts.push(contact);
        }
    }
}

/// Tangential over normal stiffness, as in scenes.
const SHEAR: f64 = 0.8;

/// The first of the bodies that are rigid with a body.
fn lead(tree: &Tree, mut body: usize) -> usize {
    while body != WORLD && tree.bodies[body].joint.is_none() {
        body = tree.bodies[body].parent;
    }
    body
}
