//! The joints of the tree and their springs.
//!
//! `joint => revolute, spherical or translational joint; its stiffness => torsion spring, or spring along
//! the axis`. A body's weight that is taken off it becomes a load.

use nalgebra::Vector3;

use crate::body::{Freedom, Joint};
use crate::mechanism::{Line, Link, Load, Mechanism, Torsion, Type, rounded};
use crate::omission::{Kind, Omissions};
use crate::settings::Settings;

/// Adds the joints of all parts in their order.
pub(crate) fn add(mechanism: &mut Mechanism<'_>, settings: &Settings, omissions: &mut Omissions) {
    for part in 0..mechanism.parts.parts.len() {
        let tree = mechanism.tree;
        let lead = mechanism.parts.parts[part].lead;
        let body = &tree.bodies[lead];
        let between = [mechanism.side(body.parent), Some(part)];
        let Some(joint) = body.joints.first() else {
            let at = mechanism.pose.start[lead].translation.vector;
            let link = Link {
                name: mechanism.own_name(&body.name),
                kind: Type::Fixed,
                between,
                at: [at; 2],
                span: mechanism.span(between),
                source: (format!("<body name=\"{}\"> without a joint", body.name), body.place),
            };
            mechanism.links.push(link);
            continue;
        };
        if joint.freedom != Freedom::Free {
            tree_joint(mechanism, lead, joint, part);
        }
    }
    weightless(mechanism, settings, omissions);
}

/// A joint with its spring.
fn tree_joint(mechanism: &mut Mechanism<'_>, lead: usize, joint: &Joint, part: usize) {
    let body = &mechanism.tree.bodies[lead];
    let between = [mechanism.side(body.parent), Some(part)];
    let name = mechanism.own_name(joint.name.as_deref().unwrap_or(&body.name));
    let at = mechanism.point(lead, joint.anchor);
    let axis = mechanism.pose.start[lead].rotation * joint.axis.into_inner();
    let (kind, word) = match joint.freedom {
        Freedom::Hinge => (Type::Revolute(axis), "hinge"),
        Freedom::Slide => (Type::Translational(axis), "slide"),
        Freedom::Ball | Freedom::Free => (Type::Spherical, "ball"),
    };
    let called = joint.name.as_deref().map_or(String::new(), |name| format!(" name=\"{name}\""));
    let source = (format!("<joint{called} type=\"{word}\">"), joint.place);
    let span = mechanism.span(between);
    mechanism.links.push(Link {
        name: name.clone(),
        kind,
        between,
        at: [at; 2],
        span,
        source: source.clone(),
    });
    if joint.stiffness == 0.0 && joint.damping == 0.0 {
        return;
    }
    match joint.freedom {
        Freedom::Hinge => {
            // At the twist θ the coordinate is q + θ, and the torque k·(springref − q − θ).
            let q = mechanism.pose.coordinates[lead];
            let preload = joint.stiffness * (joint.spring_reference - q);
            let name = mechanism.own_name(&format!("{name}-spring"));
            let words = format!("stiffness, damping and springref of {}", source.0);
            let source = (words, joint.place);
            let (stiffness, damping) = (joint.stiffness, joint.damping);
            mechanism.torsions.push(Torsion {
                name,
                between,
                axis,
                stiffness,
                damping,
                preload,
                source,
            });
        }
        Freedom::Slide => {
            spring_along(mechanism, lead, &name);
        }
        Freedom::Ball | Freedom::Free => {}
    }
}

/// The name of the spring along a slide, which is made where there is none yet: a motor acts on it, too.
///
/// Its end on the parent lies ahead on the axis, farther than the slide goes: then its length is a
/// straight function of the coordinate, its pull on the body goes along the axis, and both ends lie on
/// one line, so that it turns nothing.
pub(crate) fn spring_along(mechanism: &mut Mechanism<'_>, lead: usize, slide: &str) -> String {
    let wanted = format!("{slide}-spring");
    if mechanism.lines.iter().any(|line| line.name == wanted) {
        return wanted;
    }
    let joint = &mechanism.tree.bodies[lead].joints[0];
    let between = [mechanism.side(mechanism.tree.bodies[lead].parent), mechanism.side(lead)];
    let at = mechanism.point(lead, joint.anchor);
    let axis = mechanism.pose.start[lead].rotation * joint.axis.into_inner();
    let q = mechanism.pose.coordinates[lead];
    let rest = if joint.stiffness > 0.0 { joint.spring_reference - q } else { 0.0 };
    let travel = joint.range.map_or(0.0, |[from, to]| (from - q).abs().max((to - q).abs()));
    let length = rounded((2.0 * mechanism.size()).max(2.0 * travel).max(4.0 * rest.abs()));
    let source = (format!("stiffness, damping and springref of the slide `{slide}`"), joint.place);
    let (stiffness, damping) = (joint.stiffness, joint.damping);
    let name = mechanism.own_name(&wanted);
    mechanism.lines.push(Line {
        name: name.clone(),
        between,
        points: [at + axis * length, at],
        free_length: length - rest,
        stiffness,
        damping,
        source,
    });
    name
}

/// \[m\] a force that acts this close to a part's centre of mass, in radii of gyration, acts at it.
const CENTRED: f64 = 1e-9;

/// Weight that is taken off bodies: a constant force where it acts at the centre of mass of a part, as it
/// does for bodies that are rigid with each other and have the same fraction taken off.
fn weightless(mechanism: &mut Mechanism<'_>, settings: &Settings, omissions: &mut Omissions) {
    let (tree, parts) = (mechanism.tree, mechanism.parts);
    for (number, part) in parts.parts.iter().enumerate() {
        let of = |body: &usize| &tree.bodies[*body];
        let light: Vec<usize> =
            part.bodies.iter().copied().filter(|body| of(body).weightless != 0.0).collect();
        let Some(first) = light.first() else { continue };
        let [mut lifted, mut moment] = [0.0, 0.0];
        let mut arm = Vector3::zeros();
        for body in &light {
            let mass = of(body).weightless * of(body).mass.mass;
            let centre = mechanism.point(*body, of(body).mass.centre);
            let from = centre - mechanism.placed(number).translation.vector;
            lifted += mass;
            arm += from * mass;
            moment += from.norm() * mass.abs();
        }
        let words: Vec<String> = light
            .iter()
            .map(|body| format!("gravcomp={} of body `{}`", of(body).weightless, of(body).name))
            .collect();
        let (words, place) = (words.join(", "), of(first).place);
        if arm.norm() > CENTRED * (moment + lifted.abs() * part.mass.gyration()) {
            let what = format!(
                "{words}: it does not act at the centre of mass of all that is rigid with it"
            );
            omissions.add(Kind::GravityCompensation, place, what);
            continue;
        }
        let force = settings.gravity * -lifted;
        mechanism.loads.push(Load { part: number, force, source: (words, place) });
    }
}
