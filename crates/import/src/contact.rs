//! Which geoms can touch: a scene has no contact.
//!
//! `geoms, <contact> => each geom that some other could touch`. As MuJoCo chooses pairs: bits that meet, not
//! of bodies rigid with each other or next to each other in the tree, not excluded.

use std::collections::BTreeSet;

use crate::element::Element;
use crate::error::Fault;
use crate::omission::{Kind, Omissions};
use crate::settings::Settings;
use crate::tree::{Tree, WORLD};

/// Lists geoms that can touch another, and pairs.
pub(crate) fn find(
    root: &Element,
    tree: &Tree,
    settings: &Settings,
    omissions: &mut Omissions,
) -> Result<(), Fault> {
    if settings.is_off("contact") {
        return Ok(());
    }
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
                    let what = format!("pair of `{}` and `{}`", geom("geom1"), geom("geom2"));
                    omissions.add(Kind::Contact, child.place, what);
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
    for (i, surface) in tree.surfaces.iter().enumerate() {
        let others = (0..tree.surfaces.len()).filter(|j| touch(i, *j)).count();
        if others > 0 {
            let s = if others == 1 { "" } else { "s" };
            let what = format!("{}: may touch {others} other{s}", surface.words);
            omissions.add(Kind::Contact, surface.place, what);
        }
    }
    Ok(())
}

/// The first of the bodies that are rigid with a body.
fn lead(tree: &Tree, mut body: usize) -> usize {
    while body != WORLD && tree.bodies[body].joint.is_none() {
        body = tree.bodies[body].parent;
    }
    body
}
