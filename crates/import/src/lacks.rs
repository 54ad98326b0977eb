//! Properties of a joint without a counterpart in a scene, with their magnitude.
//!
//! `attributes, joint => omissions`.

use crate::body::{Freedom, Joint};
use crate::defaults::Attributes;
use crate::error::Fault;
use crate::omission::{Kind, Omissions};
use crate::settings::Settings;

/// Lists properties of an imported joint without a counterpart.
pub(crate) fn of_joint(
    given: &Attributes<'_>,
    joint: &Joint,
    name: &str,
    settings: &Settings,
    omissions: &mut Omissions,
) -> Result<(), Fault> {
    let place = given.element.place;
    let word = joint.freedom.word();
    let [_, force, _] = joint.freedom.units();
    if given.limited("actuatorfrclimited", "actuatorfrcrange", settings.automatic_limits)?
        && let Some(range) = given.numbers("actuatorfrcrange", 2, 2)?
    {
        let what = format!("{word} `{name}`: actuators {} to {} {force}", range[0], range[1]);
        omissions.add(Kind::Limit, place, what);
    }
    springs(given, joint, name, omissions)
}

/// Lists limits and friction of a coordinate that no joint of the scene has.
pub(crate) fn of_coordinate(joint: &Joint, name: &str, omissions: &mut Omissions) {
    let word = joint.freedom.word();
    let [coordinate, force, _] = joint.freedom.units();
    if let (true, Some([from, to])) = (joint.limited, joint.range) {
        let degrees = match joint.freedom {
            Freedom::Slide => String::new(),
            _ => format!(", {:.4}° to {:.4}°", from.to_degrees(), to.to_degrees()),
        };
        let what = format!("{word} `{name}`: {from:.6} to {to:.6} {coordinate}{degrees}");
        omissions.add(Kind::Limit, joint.place, what);
    }
    if joint.friction > 0.0 {
        let what = format!("{word} `{name}`: dry friction {} {force}", joint.friction);
        omissions.add(Kind::FrictionLoss, joint.place, what);
    }
}

/// Springs and dampers other than linear ones about or along an axis.
fn springs(
    given: &Attributes<'_>,
    joint: &Joint,
    name: &str,
    omissions: &mut Omissions,
) -> Result<(), Fault> {
    let place = given.element.place;
    let word = joint.freedom.word();
    if let Some(values) = given.numbers("springdamper", 2, 2)?
        && values.iter().all(|value| *value > 0.0)
    {
        let what = format!(
            "{word} `{name}`: spring and damper of time constant {} s, damping ratio {}",
            values[0], values[1]
        );
        omissions.add(Kind::Spring, place, what);
    }
    if joint.freedom == Freedom::Free {
        let both = [("stiffness", joint.stiffness), ("damping", joint.damping)];
        for (what, size) in both.into_iter().filter(|(_, size)| *size > 0.0) {
            let what = format!("{word} `{name}`: {what} {size} in SI units");
            omissions.add(Kind::Spring, place, what);
        }
    }
    for what in ["stiffness", "damping", "springyield"] {
        let least = if what == "springyield" { 0 } else { 1 };
        let numbers = given.numbers(what, 1, 3)?.unwrap_or_default();
        let higher = numbers.get(least..).unwrap_or_default();
        if higher.iter().any(|number| *number != 0.0) {
            let what = format!("{word} `{name}`: {what} {numbers:?}, which is not linear");
            omissions.add(Kind::Spring, place, what);
        }
    }
    Ok(())
}
