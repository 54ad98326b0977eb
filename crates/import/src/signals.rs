//! Sensors.
//!
//! `sensors of joints and points => read-outs`. They do not affect the motion: those without a counterpart are noted
//! and not refused.

use crate::coordinate::Coordinate;
use crate::element::Element;
use crate::error::Fault;
use crate::mechanism::{Mechanism, Signal};
use crate::notation::{text, vector};

/// Adds read-outs in the order of the file.
pub(crate) fn add(mechanism: &mut Mechanism<'_>, root: &Element) -> Result<(), Fault> {
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
            .push(format!("{left} sensor{s} of other kinds left out; the motion is unaffected"));
    }
    Ok(())
}

/// Adds the read-out of a sensor, if any.
fn sensor(mechanism: &mut Mechanism<'_>, element: &Element) -> Result<bool, Fault> {
    let kind = element.name.as_str();
    let wanted = element.text("name").or(element.text("joint")).or(element.text("objname"));
    let name = mechanism.signal_name(wanted.unwrap_or(kind), kind, &mechanism.readouts);
    if let ("jointpos" | "jointvel", Some(joint)) = (kind, element.attribute("joint")) {
        let Ok(body) = mechanism.tree.joint(joint) else { return Ok(false) };
        let start = mechanism.pose.coordinates[body];
        let (link, about, kinds) = match mechanism.coordinates.get(&body) {
            Some(Coordinate::Turn { joint: Some((link, about)), .. }) => {
                (link, *about, ["joint_angle", "joint_rate"])
            }
            Some(Coordinate::Slide { joint: Some((link, false)), .. }) => {
                (link, None, ["joint_travel", "joint_travel_rate"])
            }
            _ => return Ok(false),
        };
        let mut keys = vec![format!("target = {}", text(link))];
        keys.extend(about.map(|about| format!("about = \"{about}\"")));
        let is_place = kind == "jointpos";
        if is_place && start != 0.0 {
            keys.push(format!("offset = {start:?}"));
        }
        let [place, rate] = kinds;
        let (kind, words) = (if is_place { place } else { rate }, format!("<{kind}>"));
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
