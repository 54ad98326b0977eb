//! Tendons.
//!
//! `<spatial> of two sites => TSDA, <fixed> => coupling`. Others have no counterpart and are listed.

use crate::coordinate::{Coordinate, Law};
use crate::couplings;
use crate::defaults::{Attributes, Defaults, MAIN};
use crate::element::Element;
use crate::error::Fault;
use crate::interaction::Sides;
use crate::mechanism::{Interaction, Mechanism};
use crate::notation::number;
use crate::omission::{Kind, Omissions};
use crate::pose::Pose;
use crate::settings::Settings;
use crate::tree::moved;

/// Adds the springs of all tendons in order.
pub(crate) fn add(
    mechanism: &mut Mechanism<'_>,
    root: &Element,
    settings: &Settings,
    defaults: &Defaults,
    omissions: &mut Omissions,
) -> Result<(), Fault> {
    for section in root.sections("tendon") {
        for element in &section.children {
            let given = defaults.of_kind(element, "tendon", MAIN)?;
            if let Some(why) = tendon(mechanism, &given, settings, omissions)? {
                let part = |name: &str| given.text(name).map(|value| format!("{name} {value}"));
                let names = ["stiffness", "damping", "springlength", "range", "frictionloss"];
                let words: Vec<String> = names.into_iter().filter_map(part).collect();
                let (called, count) = (element.called(), element.children.len());
                let what = format!("{called}: {count} points or joints {}", words.join(", "));
                omissions.add(Kind::Tendon, element.place, format!("{}: {why}", what.trim_end()));
            }
        }
    }
    Ok(())
}

/// Adds the spring of a tendon, or returns why it has none.
fn tendon(
    mechanism: &mut Mechanism<'_>,
    given: &Attributes<'_>,
    settings: &Settings,
    omissions: &mut Omissions,
) -> Result<Option<&'static str>, Fault> {
    let element = given.element;
    if element.name == "fixed" {
        limits(given, settings, omissions)?;
        return couplings::tendon(mechanism, given, settings);
    }
    let [first, second] = &element.children[..] else {
        return Ok(Some("only springs between two sites are supported"));
    };
    let (Some(one), Some(two)) = (first.attribute("site"), second.attribute("site")) else {
        return Ok(Some("springs around geoms or over pulleys are not supported"));
    };
    let ((a, pose_a), (b, pose_b)) = (mechanism.tree.site(one)?, mechanism.tree.site(two)?);
    let (at_a, at_b) = (pose_a.translation.vector, pose_b.translation.vector);
    let between = [mechanism.side(a), mechanism.side(b)];
    if between[0] == between[1] {
        mechanism.notes.push(format!("{} has constant length and is left out", element.called()));
        return Ok(None);
    }
    let lengths = given.numbers("springlength", 1, 2)?.unwrap_or_else(|| vec![-1.0]);
    if lengths.last().is_some_and(|last| *last != lengths[0]) {
        return Ok(Some("two spring lengths are not supported: give one length"));
    }
    let off = |flag: &str, value: f64| if settings.is_off(flag) { 0.0 } else { value };
    let linear = |name: &str| -> Result<f64, Fault> {
        Ok(given.numbers(name, 1, 3)?.map_or(0.0, |numbers| numbers[0]))
    };
    let stiffness = off("spring", linear("stiffness")?);
    let damping = off("damper", linear("damping")?);
    if stiffness < 0.0 || damping < 0.0 {
        return Ok(Some("its stiffness or damping is negative"));
    }
    let free = if lengths[0] < 0.0 {
        let rest = Pose::at_rest(mechanism.tree);
        (moved(&rest[b], at_b) - moved(&rest[a], at_a)).norm()
    } else {
        lengths[0]
    };
    if free == 0.0 && damping > 0.0 {
        return Ok(Some("a damper of zero length opposes motion in every direction"));
    }
    limits(given, settings, omissions)?;
    let points = [mechanism.point(a, at_a), mechanism.point(b, at_b)];
    let name = element.text("name").unwrap_or("tendon").to_owned();
    let words = format!("<spatial name=\"{name}\"> between `{}` and `{}`", one.value, two.value);
    let limited = given.limited("limited", "range", settings.automatic_limits)?;
    let range = given.numbers("range", 2, 2)?.filter(|_| limited && !settings.is_off("limit"));
    if let Some([from, to]) = range.as_deref().and_then(|range| <[f64; 2]>::try_from(range).ok()) {
        if from >= to || to <= 0.0 {
            return Ok(Some("its range is empty"));
        }
        // The ground comes first.
        let [a, b] = if between[1].is_none() { [1, 0] } else { [0, 1] };
        let sides = Sides { between: [between[a], between[b]], at: [points[a], points[b]] };
        let mut keys = vec![sides.points(mechanism)];
        keys.push(format!("from = {}\nto = {}", number(from.max(0.0)), number(to)));
        keys.extend(mechanism.stop(None));
        let name = mechanism.own_name(&format!("{name}-range"));
        mechanism.interactions.push(Interaction {
            name,
            law: "distance-stop",
            between: sides.between,
            keys,
            source: (words.clone(), element.place),
        });
    }
    let coordinate = Coordinate::Length { between, points };
    let mut made = None;
    if stiffness > 0.0 || damping > 0.0 {
        let rest = free - (points[1] - points[0]).norm();
        let law = Law { stiffness, damping, rest, bias: 0.0 };
        made = Some(coordinate.spring(mechanism, &name, law, (words, element.place)));
        if let Some(line) = mechanism.lines.last_mut() {
            // The value as written, free of rounding errors from a sum and a difference.
            line.free_length = free;
        }
    }
    mechanism.tendons.insert(name, (coordinate, made));
    Ok(None)
}

/// Lists properties of a tendon that a spring does not have.
fn limits(
    given: &Attributes<'_>,
    settings: &Settings,
    omissions: &mut Omissions,
) -> Result<(), Fault> {
    let (element, called) = (given.element, given.element.called());
    let mut add =
        |kind: Kind, what: String| omissions.add(kind, element.place, format!("{called}: {what}"));
    let name = "actuatorfrcrange";
    if given.limited("actuatorfrclimited", name, settings.automatic_limits)?
        && let Some(range) = given.numbers(name, 2, 2)?
    {
        add(Kind::Limit, format!("{name} {} to {} N", range[0], range[1]));
    }
    let armature = given.magnitude("armature", 0.0)?;
    if armature > 0.0 {
        add(Kind::Armature, format!("armature {armature} kg"));
    }
    let friction = given.magnitude("frictionloss", 0.0)?;
    if friction > 0.0 && !settings.is_off("frictionloss") {
        add(Kind::FrictionLoss, format!("dry friction {friction} N"));
    }
    for (name, least) in [("stiffness", 1), ("damping", 1), ("springyield", 0)] {
        let numbers = given.numbers(name, 1, 3)?.unwrap_or_default();
        if numbers.get(least..).unwrap_or_default().iter().any(|number| *number != 0.0) {
            add(Kind::Spring, format!("{name} {numbers:?}, which is not linear"));
        }
    }
    Ok(())
}
