//! Actuators and sensors.
//!
//! `<motor> at a hinge => torque, at a slide => force along its spring; sensors of joints and points =>
//! read-outs`. Sensors change no motion: what has no counterpart among them is noted and not refused.

use crate::body::Freedom;
use crate::defaults::{Attributes, Defaults, MAIN};
use crate::element::Element;
use crate::error::Fault;
use crate::joints::spring_along;
use crate::mechanism::{Mechanism, Signal, Type};
use crate::notation::{text, vector};
use crate::omission::{Kind, Omissions};
use crate::settings::Settings;
use crate::tree::Tree;

/// Adds inputs and read-outs in the order of the file.
pub(crate) fn add(
    mechanism: &mut Mechanism<'_>,
    root: &Element,
    settings: &Settings,
    defaults: &Defaults,
    omissions: &mut Omissions,
) -> Result<(), Fault> {
    for section in root.sections("actuator").filter(|_| !settings.is_off("actuation")) {
        for element in &section.children {
            let given = defaults.of(element, MAIN)?;
            actuator(mechanism, &given, settings, omissions)?;
        }
    }
    for section in root.sections("tendon") {
        for element in &section.children {
            let part = |name: &str| element.text(name).map(|value| format!("{name} {value}"));
            let names = ["stiffness", "damping", "springlength", "range", "frictionloss"];
            let words: Vec<String> = names.into_iter().filter_map(part).collect();
            let what = format!(
                "{}: {} points or joints {}",
                element.called(),
                element.children.len(),
                words.join(", ")
            );
            omissions.add(Kind::Tendon, element.place, what.trim_end());
        }
    }
    let mut left = 0;
    for section in root.sections("sensor") {
        for element in &section.children {
            left += usize::from(!sensor(mechanism, element)?);
        }
    }
    if left > 0 {
        let s = if left == 1 { "" } else { "s" };
        mechanism
            .notes
            .push(format!("{left} sensor{s} of other kinds left out: they change no motion"));
    }
    Ok(())
}

/// The joint of the mechanism that the joint of a name became, and the body it belongs to.
fn target(mechanism: &Mechanism<'_>, name: &str) -> Option<(usize, String, Freedom)> {
    let lead = mechanism.tree.joint(name)?;
    let joint = mechanism.tree.bodies[lead].joints.first()?;
    let link = mechanism.links.iter().find(|link| link.source.1 == joint.place)?;
    Some((lead, link.name.clone(), joint.freedom))
}

fn actuator(
    mechanism: &mut Mechanism<'_>,
    given: &Attributes<'_>,
    settings: &Settings,
    omissions: &mut Omissions,
) -> Result<(), Fault> {
    let element = given.element;
    let called = element.called();
    let omit = |omissions: &mut Omissions| {
        let part = |name: &str| given.text(name).map(|value| format!(", {name} {value}"));
        let names = ["joint", "tendon", "site", "body", "gear", "kp", "kv", "gainprm", "biasprm"];
        let words: String = names.into_iter().filter_map(part).collect();
        omissions.add(Kind::Actuator, element.place, format!("{called}{words}"));
    };
    let (true, Some(named)) = (element.name == "motor", given.get("joint")) else {
        omit(omissions);
        return Ok(());
    };
    let Some((lead, link, freedom)) = target(mechanism, &named.value) else {
        let names = mechanism.tree.bodies.iter().flat_map(|body| &body.joints);
        let names: Vec<&str> = names.filter_map(|joint| joint.name.as_deref()).collect();
        let listed = omissions.list().iter().any(|(kind, _, what)| {
            *kind == Kind::Joints && what.contains(&format!("`{}`", named.value))
        });
        if listed {
            omit(omissions);
            return Ok(());
        }
        return Err(Tree::unknown("joint", named, names.into_iter()));
    };
    let (kind, target) = match freedom {
        Freedom::Hinge => ("joint_torque", link),
        Freedom::Slide => ("actuator", spring_along(mechanism, lead, &link)),
        Freedom::Ball | Freedom::Free => {
            omit(omissions);
            return Ok(());
        }
    };
    let [_, force, inertia] = freedom.units();
    let limits = [("ctrllimited", "ctrlrange", ""), ("forcelimited", "forcerange", force)];
    for (limited, name, unit) in limits {
        if given.limited(limited, name, settings.automatic_limits)?
            && let Some(range) = given.numbers(name, 2, 2)?
        {
            let what = format!("{called}: {name} {} to {} {unit}", range[0], range[1]);
            omissions.add(Kind::Limit, element.place, what.trim_end());
        }
    }
    let armature = given.magnitude("armature", 0.0)?;
    if armature > 0.0 {
        let what = format!("{called}: armature {armature} {inertia}");
        omissions.add(Kind::Armature, element.place, what);
    }
    for name in ["damping", "delay"] {
        if given.numbers(name, 1, 3)?.unwrap_or_default().iter().any(|number| *number != 0.0) {
            let what = format!("{called}: {name} {}", given.text(name).unwrap_or_default());
            omissions.add(Kind::Actuator, element.place, what);
        }
    }
    let gear = given.numbers("gear", 1, 6)?.map_or(1.0, |gear| gear[0]);
    let wanted = element.text("name").unwrap_or(&named.value);
    let name = mechanism.signal_name(wanted, "motor", &mechanism.inputs);
    let source = (format!("<motor>: {force} = {gear} × its control"), element.place);
    mechanism.inputs.push(Signal {
        name,
        kind,
        keys: vec![format!("target = {}", text(&target))],
        source,
    });
    Ok(())
}

/// Adds a sensor's read-out, if it has one.
fn sensor(mechanism: &mut Mechanism<'_>, element: &Element) -> Result<bool, Fault> {
    let kind = element.name.as_str();
    let wanted = element.text("name").or(element.text("joint")).or(element.text("objname"));
    let name = mechanism.signal_name(wanted.unwrap_or(kind), kind, &mechanism.readouts);
    if let ("jointpos" | "jointvel", Some(joint)) = (kind, element.text("joint")) {
        let Some((lead, link, Freedom::Hinge)) = target(mechanism, joint) else { return Ok(false) };
        let held = mechanism.links.iter().find(|one| one.name == link);
        if !held.is_some_and(|link| matches!(link.kind, Type::Revolute(_))) {
            return Ok(false);
        }
        let start = mechanism.pose.coordinates[lead];
        let mut keys = vec![format!("target = {}", text(&link))];
        let (kind, words) = match kind {
            "jointpos" => ("joint_angle", "<jointpos>".to_owned()),
            _ => ("joint_rate", "<jointvel>".to_owned()),
        };
        if kind == "joint_angle" && start != 0.0 {
            keys.push(format!("offset = {start:?}"));
        }
        mechanism.readouts.push(Signal { name, kind, keys, source: (words, element.place) });
        return Ok(true);
    }
    let (Some(of), Some(named)) = (element.text("objtype"), element.attribute("objname")) else {
        return Ok(false);
    };
    if kind != "framepos" || element.text("reftype").is_some() {
        return Ok(false);
    }
    let (body, point) = match of {
        "site" => {
            let (body, pose) = mechanism.tree.site(named)?;
            (body, pose.translation.vector)
        }
        "body" => {
            let body = mechanism.tree.body(named)?;
            (body, mechanism.tree.bodies[body].mass.centre)
        }
        "xbody" => (mechanism.tree.body(named)?, nalgebra::Vector3::zeros()),
        _ => return Ok(false),
    };
    let Some(part) = mechanism.side(body) else { return Ok(false) };
    let at = mechanism.within(Some(part), mechanism.point(body, point));
    let keys = vec![
        format!("body = {}", text(mechanism.name(Some(part)))),
        format!("point = {}", vector(at, mechanism.size())),
    ];
    let source = (format!("<framepos> of {of} `{}`", named.value), element.place);
    mechanism.readouts.push(Signal { name, kind: "point", keys, source });
    Ok(true)
}
