//! Actuators.
//!
//! `<motor>, <position>, <velocity>, affine <general> at a hinge, a slide, a tendon => an element for the terms in
//! coordinate and rate, an input for the term in the control`.

use crate::coordinate::{Coordinate, Law};
use crate::defaults::{Attributes, Defaults, MAIN};
use crate::element::Element;
use crate::error::Fault;
use crate::mechanism::{Mechanism, Signal};
use crate::omission::{Kind, Omissions};
use crate::pose::key;
use crate::servo::{Servo, has_one_control};
use crate::settings::Settings;

/// The target of an actuator.
struct Target {
    coordinate: Coordinate,
    /// Its name.
    name: String,
    /// \[rad, m\] initial value.
    start: f64,
    /// \[1, m\] the factor of a fixed tendon: force on the coordinate over force of the actuator.
    factor: f64,
    /// \[kg·m², kg\] the driven inertia.
    inertia: Option<f64>,
    /// The TSDA of its own spring.
    element: Option<String>,
}

/// Adds the inputs and elements of all actuators in order.
pub(crate) fn add(
    mechanism: &mut Mechanism<'_>,
    root: &Element,
    settings: &Settings,
    defaults: &Defaults,
    omissions: &mut Omissions,
) -> Result<(), Fault> {
    if settings.is_off("actuation") {
        return Ok(());
    }
    let all: Vec<&Element> =
        root.sections("actuator").flat_map(|section| &section.children).collect();
    let controls = controls(mechanism, root, &all, omissions)?;
    for (element, control) in all.into_iter().zip(controls) {
        let given = defaults.of_kind(element, "actuator", MAIN)?;
        let target = match target(mechanism, &given)? {
            Ok(target) => target,
            Err(why) => {
                omit(&given, &why, omissions);
                continue;
            }
        };
        match Servo::read(&given, defaults)? {
            Ok(servo) => actuator(mechanism, &given, target, &servo, control, settings, omissions)?,
            Err(why) => omit(&given, &why, omissions),
        }
    }
    Ok(())
}

/// Names of joints on which actuators act.
pub(crate) fn driven(root: &Element, settings: &Settings) -> impl Iterator<Item = String> {
    let acts = !settings.is_off("actuation");
    let sections = root.sections("actuator").filter(move |_| acts);
    let all = sections.flat_map(|section| &section.children);
    all.filter_map(|one| one.text("joint").or(one.text("jointinparent"))).map(str::to_owned)
}

fn omit(given: &Attributes<'_>, why: &str, omissions: &mut Omissions) {
    let element = given.element;
    let part = |name: &str| given.text(name).map(|value| format!(", {name} {value}"));
    let names = [
        "joint",
        "jointinparent",
        "tendon",
        "site",
        "body",
        "gear",
        "kp",
        "kv",
        "gainprm",
        "biasprm",
    ];
    let words: String = names.into_iter().filter_map(part).collect();
    omissions.add(Kind::Actuator, element.place, format!("{}{words}: {why}", element.called()));
}

/// The initial controls: those of the keyframe, else 0.
fn controls(
    mechanism: &Mechanism<'_>,
    root: &Element,
    all: &[&Element],
    omissions: &mut Omissions,
) -> Result<Vec<f64>, Fault> {
    let none = vec![0.0; all.len()];
    let Some(name) = &mechanism.options.keyframe else { return Ok(none) };
    let given = Attributes::own(key(root, name)?);
    if given.numbers("ctrl", 0, usize::MAX)?.is_none() {
        return Ok(none);
    }
    if let Some(other) = all.iter().find(|element| !has_one_control(&element.name)) {
        let what =
            format!("`ctrl` of keyframe `{name}`: {} may have several controls", other.called());
        omissions.add(Kind::Actuator, given.place("ctrl"), what);
        return Ok(none);
    }
    Ok(given.numbers("ctrl", all.len(), all.len())?.unwrap_or(none))
}

/// The target of an actuator, or the reason why it has no counterpart.
fn target(
    mechanism: &Mechanism<'_>,
    given: &Attributes<'_>,
) -> Result<Result<Target, String>, Fault> {
    let of_joint = given.get("joint").or(given.get("jointinparent"));
    let of_tendon = given.get("tendon").filter(|_| of_joint.is_none());
    let scaled = of_tendon.and_then(|named| mechanism.scaled.get(&named.value));
    let of_joint = match of_joint {
        Some(named) => Some((named, mechanism.tree.joint(named)?, 1.0)),
        None => of_tendon.zip(scaled).map(|(named, (body, factor))| (named, *body, *factor)),
    };
    if let Some((named, body, factor)) = of_joint {
        let Some(coordinate) = mechanism.coordinates.get(&body).cloned() else {
            let why = "its joint is not a hinge or slide of the scene".to_owned();
            return Ok(Err(why));
        };
        return Ok(Ok(Target {
            coordinate,
            name: named.value.clone(),
            start: mechanism.pose.coordinates[body],
            factor,
            inertia: mechanism.driven.get(&body).copied(),
            element: mechanism.elements.get(&body).cloned(),
        }));
    }
    let Some(named) = given.get("tendon") else {
        return Ok(Err("acts on neither a joint nor a tendon".into()));
    };
    let Some((coordinate, element)) = mechanism.tendons.get(&named.value).cloned() else {
        return Ok(Err("its tendon is not in the scene".into()));
    };
    let start = match coordinate {
        Coordinate::Length { points: [a, b], .. } => (b - a).norm(),
        _ => 0.0,
    };
    let name = named.value.clone();
    Ok(Ok(Target { coordinate, name, start, factor: 1.0, inertia: None, element }))
}

/// Adds the element and the input of an actuator.
fn actuator(
    mechanism: &mut Mechanism<'_>,
    given: &Attributes<'_>,
    target: Target,
    servo: &Servo,
    control: f64,
    settings: &Settings,
    omissions: &mut Omissions,
) -> Result<(), Fault> {
    let element = given.element;
    let [force, _] = target.coordinate.units();
    let Some(mut law) = servo.law(target.start, target.inertia) else {
        omit(given, "`dampratio` is not supported for a tendon: give `kv`", omissions);
        return Ok(());
    };
    let is_motor = law.is_none();
    if !is_motor && target.factor != 1.0 {
        omit(given, "a servo of a fixed tendon requires the coefficient 1", omissions);
        return Ok(());
    }
    let (control, bounds) =
        limits(given, &target.coordinate, (control, is_motor), settings, omissions)?;
    // A constant force belongs to the input where no spring can represent it: without stiffness, and for a tendon,
    // whose force is relative to its initial length.
    let constant = match target.coordinate {
        Coordinate::Length { .. } => {
            let force = law.stiffness * law.rest + law.bias;
            (law.rest, law.bias) = (0.0, 0.0);
            force
        }
        _ if law.stiffness == 0.0 => std::mem::take(&mut law.bias),
        _ => 0.0,
    };
    let called = element.text("name").unwrap_or(&target.name).to_owned();
    let mut line = target.element;
    if !law.is_none() {
        let words = format!("stiffness and damping of <{}> at `{}`", element.name, target.name);
        let source = (words, element.place);
        line = Some(target.coordinate.spring(mechanism, &format!("{called}-servo"), law, source));
    } else if target.coordinate.needs_line() && line.is_none() {
        let source =
            (format!("line of action of <{}>: `{}`", element.name, target.name), element.place);
        let wanted = format!("{}-spring", target.name);
        let made = target.coordinate.spring(mechanism, &wanted, Law::default(), source);
        remember(mechanism, given, &made)?;
        line = Some(made);
    }
    let (kind, mut keys, sign) = target.coordinate.drive(mechanism, &line.unwrap_or_default());
    let sign = sign * target.factor;
    let per_control = sign * servo.per_control();
    let of_control = bounds.control.map(|bound| per_control * bound + sign * constant);
    let of_force = bounds.force.map(|bound| sign * servo.gear() * bound);
    let [of_control, [least, most]] = [of_control, of_force].map(|[a, b]| [a.min(b), a.max(b)]);
    // The motor's force range limits the control: a control range beyond it shrinks to a single value.
    let range = of_control.map(|bound| bound.clamp(least, most));
    let value = (per_control * control + sign * constant).clamp(least, most);
    if value != 0.0 {
        keys.push(format!("value = {value:?}"));
    }
    if range.iter().all(|bound| bound.is_finite()) {
        keys.push(format!("range = [{:?}, {:?}]", range[0] + 0.0, range[1] + 0.0));
    }
    let plus = if constant == 0.0 { String::new() } else { format!(" + {:?}", sign * constant) };
    let name = mechanism.signal_name(&called, &element.name, &mechanism.inputs);
    let words = format!("<{}>: {force} = {per_control:?} × its control{plus}", element.name);
    mechanism.inputs.push(Signal { name, kind, keys, source: (words, element.place) });
    Ok(())
}

/// Stores the TSDA made for an input, so that further inputs reuse it.
fn remember(
    mechanism: &mut Mechanism<'_>,
    given: &Attributes<'_>,
    line: &str,
) -> Result<(), Fault> {
    if let Some(named) = given.get("joint").or(given.get("jointinparent")) {
        let body = mechanism.tree.joint(named)?;
        mechanism.elements.insert(body, line.to_owned());
    } else if let Some(named) = given.get("tendon")
        && let Some((_, kept)) = mechanism.tendons.get_mut(&named.value)
    {
        *kept = Some(line.to_owned());
    }
    Ok(())
}

/// Bounds of an actuator's control and, for a motor, of its force.
struct Bounds {
    control: [f64; 2],
    force: [f64; 2],
}

/// Lists limits, armatures and the like without a counterpart; returns the clamped control and the bounds of the input.
fn limits(
    given: &Attributes<'_>,
    coordinate: &Coordinate,
    (mut control, is_motor): (f64, bool),
    settings: &Settings,
    omissions: &mut Omissions,
) -> Result<(f64, Bounds), Fault> {
    let element = given.element;
    let called = element.called();
    let [force, inertia] = coordinate.units();
    let none = [-f64::INFINITY, f64::INFINITY];
    let mut bounds = Bounds { control: none, force: none };
    for (limited, name, unit) in
        [("ctrllimited", "ctrlrange", ""), ("forcelimited", "forcerange", force)]
    {
        if given.limited(limited, name, settings.automatic_limits)?
            && let Some(range) = given.numbers(name, 2, 2)?
        {
            let [from, to] = [range[0], range[1]];
            if from <= to && (name == "ctrlrange" || is_motor) {
                if name == "ctrlrange" {
                    control = control.clamp(from, to);
                    bounds.control = [from, to];
                } else {
                    bounds.force = [from, to];
                }
                continue;
            }
            let what = format!("{called}: {name} {from} to {to} {unit}");
            omissions.add(Kind::Limit, element.place, what.trim_end());
        }
    }
    if given.number("inheritrange")?.is_some_and(|factor| factor > 0.0) {
        let what = format!("{called}: ctrlrange inherited from its joint");
        omissions.add(Kind::Limit, element.place, what);
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
    Ok((control, bounds))
}
