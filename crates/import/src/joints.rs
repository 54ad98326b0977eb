//! The joints of the tree and their springs.
//!
//! `stage => joint between two parts; stiffness => torsion spring, or spring along the axis`. Gravity compensation
//! becomes a load.

use nalgebra::{Isometry3, UnitQuaternion, Vector3};

use crate::body::{Freedom, Joint};
use crate::chain::{Stage, Way, centre};
use crate::coordinate::{Coordinate, Law};
use crate::interaction::{LIMIT_SPEED, RESTITUTION, Sides, bushing};
use crate::lacks;
use crate::mechanism::{Axis, Interaction, Link, Load, Mechanism, Signal, Torsion, Type, rounded};
use crate::notation::{number, text, vector};
use crate::omission::{Kind, Omissions};
use crate::options::Options;
use crate::part::Side;
use crate::settings::Settings;
use crate::tree::Tree;

/// \[rad\] below this angle a ball is considered unrotated at the start.
const UNTURNED: f64 = 1e-9;

/// Adds the joints of all parts in order.
pub(crate) fn add(
    mechanism: &mut Mechanism<'_>,
    stages: &[Stage],
    settings: &Settings,
    omissions: &mut Omissions,
) {
    for part in 0..mechanism.parts.parts.len() {
        let lead = mechanism.parts.parts[part].lead;
        match stages.iter().find(|stage| stage.body == lead) {
            Some(stage) => of_stage(mechanism, stage, omissions),
            None => welded(mechanism, lead, part),
        }
    }
    carriers(mechanism);
    weightless(mechanism, settings, omissions);
}

/// A body without a joint that is a separate part.
fn welded(mechanism: &mut Mechanism<'_>, lead: usize, part: usize) {
    let body = &mechanism.tree.bodies[lead];
    let between = [mechanism.side(body.parent), Some(part)];
    let at = mechanism.pose.start[lead].translation.vector;
    let link = Link {
        name: mechanism.own_name(&body.name),
        kind: Type::Fixed,
        between,
        at: [at; 2],
        span: mechanism.span(between),
        keys: Vec::new(),
        source: (format!("<body name=\"{}\"> without a joint", body.name), body.place),
    };
    mechanism.links.push(link);
}

/// The joint of a stage, its coordinates and their springs.
fn of_stage(mechanism: &mut Mechanism<'_>, stage: &Stage, omissions: &mut Omissions) {
    let tree = mechanism.tree;
    let of = |body: &usize| tree.bodies[*body].joint.as_ref();
    let joints: Vec<&Joint> = stage.joints.iter().filter_map(of).collect();
    let first = joints[0];
    let between = [mechanism.side(stage.base), mechanism.side(stage.body)];
    // An axis rotates with its own joint and the joints before it.
    let axes: Vec<Vector3<f64>> = stage
        .joints
        .iter()
        .zip(&joints)
        .map(|(body, joint)| mechanism.pose.start[*body].rotation * joint.axis.into_inner())
        .collect();
    let kind = match (stage.way, first.freedom) {
        (Way::Free | Way::Plane | Way::Level, _) | (Way::Single, Freedom::Free) => None,
        (Way::Single, Freedom::Hinge) => Some(Type::Revolute(axes[0])),
        (Way::Single, Freedom::Slide) => Some(Type::Translational(axes[0])),
        (Way::Cylindrical, _) => Some(Type::Cylindrical(axes[0])),
        (Way::Universal, _) => Some(Type::Universal([axes[0], axes[1]])),
        (Way::Single, Freedom::Ball) | (Way::Spherical, _) => Some(Type::Spherical),
    };
    // The axis of a cylindrical joint passes through the hinge.
    let hinge = joints.iter().find(|joint| joint.freedom == Freedom::Hinge).copied();
    let anchor = match stage.way {
        Way::Cylindrical | Way::Plane | Way::Level => hinge.unwrap_or(first).anchor,
        _ => centre(&joints),
    };
    let at = mechanism.point(stage.body, anchor);
    let mut name = String::new();
    let mut unknown: Vec<&Joint> = Vec::new();
    if let Some(kind) = kind {
        let body = &tree.bodies[last_of(tree, stage)];
        let names: Vec<&str> = joints.iter().filter_map(|joint| joint.name.as_deref()).collect();
        name = mechanism.own_name(&match names[..] {
            [] => body.name.clone(),
            _ => names.join("-"),
        });
        let sources: Vec<String> = joints.iter().map(|joint| joint.source().0).collect();
        let span = mechanism.span(between);
        let source = (sources.join(", "), first.place);
        // A force far out on a line has a large moment on the body of the line, which should be a whole body rather
        // than a carrier.
        let slides = matches!(kind, Type::Translational(_)) && tree.carries(stage.base);
        let between = if slides { [between[1], between[0]] } else { between };
        let mut link =
            Link { name: name.clone(), kind, between, at: [at; 2], span, keys: Vec::new(), source };
        for (joint, number) in joints.iter().zip(&stage.joints) {
            let q = mechanism.pose.coordinates[*number];
            let masses = between.into_iter().flatten();
            let masses = masses.map(|part| mechanism.parts.parts[part].mass.mass);
            let lightest = masses.fold(f64::INFINITY, f64::min);
            let known = keys(joint, &link, (q, slides), (mechanism.options, lightest));
            let freedom = match (link.kind, joint.freedom) {
                (Type::Revolute(_), Freedom::Hinge) | (Type::Translational(_), Freedom::Slide) => {
                    Some(None)
                }
                (Type::Cylindrical(_), Freedom::Hinge) => Some(Some("turn")),
                (Type::Cylindrical(_), Freedom::Slide) => Some(Some("slide")),
                _ => None,
            };
            if let Some(freedom) = freedom {
                let axis = Axis { joint: name.clone(), freedom, is_reversed: slides, span };
                mechanism.axes.insert(*number, axis);
            }
            match known {
                Some(keys) => {
                    link.keys.extend(keys);
                    mechanism.rotors.insert(*number);
                }
                None => unknown.push(*joint),
            }
        }
        mechanism.links.push(link);
    } else {
        unknown.clone_from(&joints);
    }
    if stage.way == Way::Level {
        name = level(mechanism, stage, &joints, &axes, at);
        unknown.clear();
        for (number, joint) in joints.iter().enumerate() {
            let known = (stage.joints[number], *joint, axes[number]);
            let limited = joint.limited && !ends(mechanism, between, known, at);
            let calm = Joint { limited, ..(*joint).clone() };
            lacks::of_coordinate(&calm, joint.name.as_ref().unwrap_or(&name), omissions);
        }
    }
    for joint in unknown {
        let body = &tree.bodies[last_of(tree, stage)].name;
        lacks::of_coordinate(joint, joint.name.as_ref().unwrap_or(body), omissions);
    }
    for (number, joint) in joints.iter().enumerate() {
        let body = stage.joints[number];
        let q = mechanism.pose.coordinates[body];
        let travel = joint.range.map_or(0.0, |[from, to]| (from - q).abs().max((to - q).abs()));
        let axis = axes[number];
        let coordinate = match (stage.way, joint.freedom) {
            (Way::Spherical | Way::Free, _) | (_, Freedom::Free) => continue,
            (_, Freedom::Ball) => {
                ball(mechanism, stage, joint, &name, omissions);
                continue;
            }
            (Way::Plane | Way::Level, Freedom::Hinge) => {
                Coordinate::Turn { joint: None, between, axis, is_of_second: false }
            }
            (_, Freedom::Hinge) => {
                let about = match stage.way {
                    Way::Universal => Some(["first", "second"][number]),
                    _ => None,
                };
                let is_of_second = about == Some("second");
                let joint = Some((name.clone(), about));
                Coordinate::Turn { joint, between, axis, is_of_second }
            }
            (Way::Plane, Freedom::Slide) => {
                let Some(part) = mechanism.side(stage.body) else { continue };
                let normal = axes.iter().zip(&joints).find(|(_, j)| j.freedom == Freedom::Hinge);
                let across = normal.map_or(axis, |(normal, _)| normal.cross(&axis));
                Coordinate::Shift { part, at, axis, across }
            }
            (Way::Level, Freedom::Slide) => {
                Coordinate::Level { between, at, axis, across: axes[1 - number] }
            }
            (_, Freedom::Slide) => {
                let known = mechanism.axes.get(&body);
                let joint = known.map(|known| (known.joint.clone(), known.is_reversed));
                Coordinate::Slide { joint, between, at, axis, travel }
            }
        };
        let called = joint.name.clone().unwrap_or_else(|| name.clone());
        if joint.stiffness > 0.0 || joint.damping > 0.0 {
            let rest = if joint.stiffness > 0.0 { joint.spring_reference - q } else { 0.0 };
            let (stiffness, damping) = (joint.stiffness, joint.damping);
            let law = Law { stiffness, damping, rest, bias: 0.0 };
            let words = format!("stiffness, damping and springref of {}", joint.source().0);
            let source = (words, joint.place);
            let wanted = format!("{called}-spring");
            let made = coordinate.spring(mechanism, &wanted, law, source);
            mechanism.elements.insert(body, made);
        }
        mechanism.coordinates.insert(body, coordinate);
    }
}

/// The bushing of two slides and, if there is one, a hinge across them; returns its name.
fn level(
    mechanism: &mut Mechanism<'_>,
    stage: &Stage,
    joints: &[&Joint],
    axes: &[Vector3<f64>],
    at: Vector3<f64>,
) -> String {
    let body = &mechanism.tree.bodies[last_of(mechanism.tree, stage)];
    let names: Vec<&str> = joints.iter().filter_map(|joint| joint.name.as_deref()).collect();
    let name =
        mechanism.own_name(&if names.is_empty() { body.name.clone() } else { names.join("-") });
    let between = [mechanism.side(stage.base), mechanism.side(stage.body)];
    let (stiffness, damping) = (mechanism.options.stiffness, mechanism.options.damping);
    let span = mechanism.span(between);
    let about = 0.25 * span * span;
    let third = if joints.len() == 2 { 1.0 } else { 0.0 };
    let turns = [about, about, third * about];
    let sources: Vec<String> = joints.iter().map(|joint| joint.source().0).collect();
    let sides = Sides { between, at: [at; 2] };
    let along = [[0.0, 0.0, stiffness], [0.0, 0.0, damping]];
    let about = [stiffness, damping].map(|size| turns.map(|turn| rounded(size * turn)));
    let keys = bushing(mechanism, &sides, [axes[0], axes[1]], along, about);
    let source = (sources.join(", "), joints[0].place);
    mechanism.interactions.push(Interaction {
        name: name.clone(),
        law: "bushing",
        between,
        keys,
        source,
    });
    name
}

/// The limits of a coordinate that no joint of the scene has, as stops: `known` are its body, its joint and its axis.
/// Returns whether it has them: an empty range would lock it, which stops cannot do.
fn ends(
    mechanism: &mut Mechanism<'_>,
    between: [Side; 2],
    (body, joint, axis): (usize, &Joint, Vector3<f64>),
    at: Vector3<f64>,
) -> bool {
    let range = joint.range.filter(|[from, to]| joint.limited && from < to);
    let Some([from, to]) = range else { return false };
    let q = mechanism.pose.coordinates[body];
    let (words, place) = joint.source();
    let called = joint.name.clone().unwrap_or_else(|| mechanism.name(between[1]).to_owned());
    let add = |mechanism: &mut Mechanism<'_>, end: &str, law, mut keys: Vec<String>, hinge| {
        keys.extend(mechanism.stop(hinge));
        let name = mechanism.own_name(&format!("{called}-{end}"));
        let source = (format!("range of {words}"), place);
        mechanism.interactions.push(Interaction { name, law, between, keys, source });
    };
    if joint.freedom == Freedom::Hinge {
        let span = mechanism.span(between);
        let keys = vec![
            format!("axis = {}", vector(axis, 1.0)),
            format!("from = {}\nto = {}", number(from - q), number(to - q)),
        ];
        add(mechanism, "range", "hinge-stop", keys, Some(span));
        return true;
    }
    for (end, place, normal) in [("from", from - q, axis), ("to", to - q, -axis)] {
        let sides = Sides { between, at: [at + axis * place, at] };
        let keys = vec![sides.points(mechanism), format!("normal = {}", vector(normal, 1.0))];
        add(mechanism, end, "end-stop", keys, None);
    }
    true
}

/// Limits, friction and rotor of a joint as keys of a link; `None` if the link does not have that coordinate. `q` is
/// the initial coordinate of the joint, and whether the link's bodies are swapped; `lightest` \[kg\] the lighter of its
/// bodies.
fn keys(
    joint: &Joint,
    link: &Link,
    (q, reversed): (f64, bool),
    (options, lightest): (&Options, f64),
) -> Option<Vec<String>> {
    let prefix = match (link.kind, joint.freedom) {
        (Type::Revolute(_), Freedom::Hinge) | (Type::Translational(_), Freedom::Slide) => "",
        (Type::Cylindrical(_), Freedom::Hinge) => "turn_",
        (Type::Cylindrical(_), Freedom::Slide) => "slide_",
        _ => {
            let has_none = joint.friction == 0.0 && joint.armature == 0.0 && !joint.limited;
            return has_none.then(Vec::new);
        }
    };
    let stiffness = options.stiffness_of_limits(joint.freedom == Freedom::Hinge, link.span);
    let mut keys = Vec::new();
    let range = joint.range.filter(|_| joint.limited);
    // An empty range would lock the joint, which a stop cannot do.
    if range.is_some_and(|[from, to]| from >= to) {
        return None;
    }
    if let Some([from, to]) = range {
        // A link with swapped bodies has the opposite sign.
        let (from, to, q) = if reversed { (-to, -from, -q) } else { (from, to, q) };
        let offset = if q == 0.0 { String::new() } else { format!("offset = {}, ", number(q)) };
        keys.push(format!(
            "{prefix}limits = {{ from = {}, to = {}, {offset}stiffness = {}, restitution = {}, speed = {} }}",
            number(from),
            number(to),
            number(rounded(stiffness)),
            number(RESTITUTION),
            number(LIMIT_SPEED),
        ));
    }
    if joint.armature > 0.0 {
        // As stiff as the joint, but with no higher frequency.
        let gear = stiffness.min(joint.armature * options.stiffness / lightest);
        keys.push(format!(
            "{prefix}rotor = {{ inertia = {}, stiffness = {} }}",
            number(joint.armature),
            number(rounded(gear)),
        ));
    }
    if joint.friction > 0.0 {
        keys.push(format!("{prefix}friction = {{ coulomb = {} }}", number(joint.friction)));
    }
    Some(keys)
}

/// The body of the file that a stage belongs to.
fn last_of(tree: &Tree, stage: &Stage) -> usize {
    (stage.body..tree.bodies.len()).find(|body| !tree.carries(*body)).unwrap_or(stage.body)
}

/// The springs of a ball: one about each axis of its body.
///
/// MuJoCo's torque is stiffness·φ about the axis of the rotation φ. The three torsion angles are φ, 0 and 0 if that
/// axis is one of theirs; about other axes they agree up to φ³.
fn ball(
    mechanism: &mut Mechanism<'_>,
    stage: &Stage,
    joint: &Joint,
    name: &str,
    omissions: &mut Omissions,
) {
    if joint.stiffness == 0.0 && joint.damping == 0.0 {
        return;
    }
    let (tree, pose) = (mechanism.tree, mechanism.pose);
    let between = [mechanism.side(stage.base), mechanism.side(stage.body)];
    let relative = |poses: &[Isometry3<f64>]| -> UnitQuaternion<f64> {
        poses[tree.bodies[stage.body].parent].rotation.inverse() * poses[stage.body].rotation
    };
    let turned = relative(&pose.start).angle_to(&relative(&pose.first));
    if turned > UNTURNED && joint.stiffness > 0.0 {
        let what = format!(
            "{}: stiffness {} N·m/rad, rotated by {turned} rad at the start; the spring must start at \
             rest: use a keyframe with that joint at 1 0 0 0",
            joint.called(),
            joint.stiffness
        );
        omissions.add(Kind::Spring, joint.place, what);
        return;
    }
    let frame = pose.start[stage.body].rotation;
    let words = format!("stiffness and damping of {}", joint.source().0);
    for (axis, letter) in
        [Vector3::x(), Vector3::y(), Vector3::z()].into_iter().zip(["x", "y", "z"])
    {
        let spring = Torsion {
            name: mechanism.own_name(&format!("{name}-spring-{letter}")),
            between,
            axis: frame * axis,
            stiffness: joint.stiffness,
            damping: joint.damping,
            preload: 0.0,
            source: (words.clone(), joint.place),
        };
        mechanism.torsions.push(spring);
    }
    mechanism.notes.push(format!(
        "{}: its spring and damper become three about the axes of its body: exact for rotations about \
         one of them; for other rotations φ the relative error of the torque is about φ²/9",
        joint.called()
    ));
}

/// Lists the armatures without a rotor, with the inertia driven by their joints to show whether they are negligible.
pub(crate) fn armatures(mechanism: &Mechanism<'_>, omissions: &mut Omissions) {
    for (number, body) in mechanism.tree.bodies.iter().enumerate() {
        let Some(joint) = body.joint.as_ref().filter(|joint| joint.armature > 0.0) else {
            continue;
        };
        if mechanism.rotors.contains(&number) {
            continue;
        }
        let [_, _, unit] = joint.freedom.units();
        let armature = joint.armature;
        let beside = mechanism
            .driven
            .get(&number)
            .map_or(String::new(), |driven| format!(" (it moves {:.3e})", driven - armature));
        let name = joint.name.as_ref().unwrap_or(&body.name);
        let what = format!(
            "{} `{name}`: armature {armature} {unit}{beside}: inertia about one joint, which no body can represent",
            joint.freedom.word()
        );
        omissions.add(Kind::Armature, joint.place, what);
    }
}

/// Notes on carriers, and read-outs of the centres of mass that they have moved.
fn carriers(mechanism: &mut Mechanism<'_>) {
    for shares in &mechanism.parts.shares {
        let body = &mechanism.tree.bodies[shares.body];
        for (carrier, exact) in &shares.carriers {
            let Some(part) = mechanism.side(*carrier) else { continue };
            let name = mechanism.name(Some(part)).to_owned();
            let mass = mechanism.parts.parts[part].mass.mass;
            let what = if *exact {
                "taken from the adjacent bodies without changing the motion".to_owned()
            } else {
                let share = mechanism.options.carriers.unwrap_or(0.0);
                format!(
                    "taken from `{}` as a fraction {share}: its motion is off by about as much",
                    body.name
                )
            };
            mechanism.notes.push(format!(
                "body `{name}` is inserted between joints of `{}`: {mass:.3e} kg, {what}",
                body.name
            ));
        }
    }
    for (number, part) in mechanism.parts.parts.iter().enumerate() {
        let whole = part.whole;
        if mechanism.tree.carries(part.named) || whole == part.mass.centre {
            continue;
        }
        let at = mechanism.point(part.lead, whole);
        let keys = vec![
            format!("body = {}", text(mechanism.name(Some(number)))),
            format!("point = {}", vector(mechanism.within(Some(number), at), mechanism.size())),
        ];
        let body = &mechanism.tree.bodies[part.named];
        let wanted = format!("{}-centre", body.name);
        let name = mechanism.signal_name(&wanted, "point", &mechanism.readouts);
        let words = format!("centre of mass of <body name=\"{}\">, carriers included", body.name);
        mechanism.readouts.push(Signal { name, kind: "point", keys, source: (words, body.place) });
    }
}

/// A force within this many radii of gyration of a part's centre of mass is considered to act at it.
const CENTRED: f64 = 1e-9;

/// Gravity compensation: a constant force where it acts at the centre of mass of a part, which is the case for rigidly
/// connected bodies with the same compensated fraction.
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
                "{words}: it does not act at the common centre of mass of the rigidly connected bodies"
            );
            omissions.add(Kind::GravityCompensation, place, what);
            continue;
        }
        let force = settings.gravity * -lifted;
        mechanism.loads.push(Load { part: number, force, source: (words, place) });
    }
}
