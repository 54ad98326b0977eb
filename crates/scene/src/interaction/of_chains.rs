//! `sensor` of read-outs, and `lag`, `delay`, `limits`, `rate_limit` and `period` of inputs: signal chains at joints, as
//! laws about or along their axes.
//!
//! `(table of a read-out or an input, joints) => law, its constants`.

use dbd_kernel::random::Stream;

use crate::error::SceneError;
use crate::interaction::common::Constants;
use crate::joints::JointPlace;
use crate::target::{ElementName, Elements, Kinds, Target};
use crate::text::{Number, Numbers, Table, Text};

/// The keys of a sensor.
pub(crate) const SENSOR: &[&str] =
    &["counts", "resolution", "noise", "bias", "walk", "range", "period", "delay", "seed"];

/// The keys of the signal chain of an input.
const CHAIN: &[&str] = &["lag", "delay", "limits", "rate_limit", "period"];

/// The read-outs of joint coordinates: type, whether it is a rotation, whether it is a rate, unit.
const SENSED: [(&str, bool, bool, &str); 4] = [
    ("joint_angle", true, false, "rad"),
    ("joint_rate", true, true, "rad/s"),
    ("joint_travel", false, false, "m"),
    ("joint_travel_rate", false, true, "m/s"),
];

/// The name of the read-out of a sensor.
pub(crate) fn sensor_name(readout: &str) -> String {
    format!("{readout}.sensor")
}

/// Whether an input has a signal chain.
pub(crate) fn has_chain(table: &Table<'_>) -> bool {
    CHAIN.iter().any(|key| table.has(key))
}

/// The joint of a read-out or an input, which must have one coordinate about or along its axis.
fn joint<'j>(
    table: &Table<'_>,
    turns: bool,
    (places, elements): (&'j [JointPlace], &Elements),
    who: &str,
) -> Result<&'j JointPlace, SceneError> {
    let (name, target) = table.required("target", ElementName { elements, kinds: Kinds::JOINT })?;
    let place = match target {
        Target::Joint(row) => places.get(row),
        _ => None,
    };
    let own = if turns { "revolute" } else { "translational" };
    place.filter(|place| place.kind == own || place.kind == "cylindrical").ok_or_else(|| {
        let kind = place.map_or("unknown", |place| place.kind);
        let problem = format!("names the {kind} joint `{name}`");
        table.refuse_value("target", &problem, format!("{who} needs a {own} or cylindrical joint"))
    })
}

/// A whole number up to `most`, 0 where the key is absent.
fn whole(table: &Table<'_>, key: &str, most: u32) -> Result<f64, SceneError> {
    let given = table.optional(key, Number::not_negative(""))?.unwrap_or(0.0);
    if given.fract() == 0.0 && given <= f64::from(most) {
        return Ok(given);
    }
    let help = format!("give a whole number from 0 to {most}");
    Err(table.refuse_value(key, "is not such a number", help))
}

/// Reads an ascending pair of bounds.
fn bounds(
    table: &Table<'_>,
    key: &str,
    unit: &'static str,
    constants: &mut Constants,
) -> Result<(), SceneError> {
    let Some([least, most]) = table.optional(key, Numbers::<2>(Number::any(unit)))? else {
        return Ok(());
    };
    if least >= most {
        return Err(table.refuse_value(key, "is empty", "give the smaller bound first"));
    }
    constants.add("least", least);
    constants.add("most", most);
    Ok(())
}

/// The largest delay in samples.
const LONGEST: u32 = dbd_kernel::chain::MAX_DELAY as u32;

/// The joint, the law and the constants of the `sensor` of a read-out; `None` without one.
pub(super) fn sensor<'j>(
    table: &Table<'_>,
    joints: (&'j [JointPlace], &Elements),
) -> Result<Option<(&'j JointPlace, &'static str, Constants)>, SceneError> {
    let Some(value) = table.value("sensor") else { return Ok(None) };
    let kind = table.required("type", Text::Any)?;
    let Some((_, turns, is_rate, unit)) = SENSED.iter().find(|(of, ..)| *of == kind) else {
        let help = "use a read-out of a joint coordinate, or an [[interaction]] with the law \
                    \"hinge-sensor\" or \"slide-sensor\"";
        return Err(table.refuse_key("sensor", "is not available for this type", help));
    };
    let place = joint(table, *turns, joints, "a sensor")?;
    let sensor = value.table("{ resolution = …, noise = …, period = … }")?;
    sensor.only(&[SENSOR])?;
    let mut constants = Constants::default();
    if *is_rate {
        constants.add("of_rate", 1.0);
    } else {
        let offset = table.optional("offset", Number::any(unit))?;
        constants.add("offset", offset.unwrap_or(0.0));
    }
    for key in ["noise", "walk"] {
        let number = sensor.optional(key, Number::not_negative(unit))?;
        constants.add(key, number.unwrap_or(0.0));
    }
    constants.add("bias", sensor.optional("bias", Number::any(unit))?.unwrap_or(0.0));
    let mut resolution = sensor.optional("resolution", Number::not_negative(unit))?.unwrap_or(0.0);
    if sensor.has("counts") {
        if kind != "joint_angle" {
            let help = "give the `resolution`; `counts` are those of a revolution";
            return Err(sensor.refuse_key("counts", "is not available for this type", help));
        }
        if sensor.has("resolution") {
            let help = "give only one: a revolution has 2π over the `resolution` counts";
            return Err(sensor.refuse_key("counts", "contradicts `resolution`", help));
        }
        resolution = core::f64::consts::TAU / sensor.required("counts", Number::positive(""))?;
    }
    constants.add("resolution", resolution);
    bounds(&sensor, "range", unit, &mut constants)?;
    let period = sensor.optional("period", Number::not_negative("s"))?;
    constants.add("period", period.unwrap_or(0.0));
    constants.add("delay", whole(&sensor, "delay", LONGEST)?);
    // Sensors of one seed and different names have different random numbers.
    let seed = whole(&sensor, "seed", u32::MAX)? as u64;
    let name = table.required("name", Text::Name)?;
    constants.add("seed", f64::from(Stream::new(seed, &name, 0).bits()));
    Ok(Some((place, if *turns { "hinge-sensor" } else { "slide-sensor" }, constants)))
}

/// The joint, the law and the constants of the signal chain of an input; `None` without one.
pub(super) fn chain<'j>(
    table: &Table<'_>,
    joints: (&'j [JointPlace], &Elements),
) -> Result<Option<(&'j JointPlace, &'static str, Constants)>, SceneError> {
    let kind = table.optional("type", Text::Any)?;
    let (turns, unit, rate) = match kind.as_deref() {
        Some("joint_torque") => (true, "N·m", "N·m/s"),
        Some("joint_force") => (false, "N", "N/s"),
        _ => return Ok(None),
    };
    if !has_chain(table) {
        return Ok(None);
    }
    let place = joint(table, turns, joints, "a signal chain")?;
    let mut constants = Constants::default();
    for key in ["lag", "period"] {
        let time = table.optional(key, Number::not_negative("s"))?;
        constants.add(key, time.unwrap_or(0.0));
    }
    if let Some(limit) = table.optional("rate_limit", Number::positive(rate))? {
        constants.add("rate_limit", limit);
    }
    bounds(table, "limits", unit, &mut constants)?;
    constants.add("delay", whole(table, "delay", LONGEST)?);
    Ok(Some((place, if turns { "hinge-actuator" } else { "slide-actuator" }, constants)))
}
