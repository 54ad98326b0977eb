//! Sums of joint coordinates: equalities between two joints, fixed tendons.
//!
//! `<joint joint1 joint2 polycoef>, <fixed> of joints => [[coupling]]`. A scene measures coordinates from its start;
//! the initial values go into the offset.

use crate::body::{Freedom, Joint};
use crate::defaults::Attributes;
use crate::element::{Attribute, Element};
use crate::error::Fault;
use crate::mechanism::{Axis, Coupling, Mechanism, rounded};
use crate::settings::Settings;

/// \[s\] damping over stiffness of couplings for which a file gives neither: MuJoCo's `solref` has no counterpart.
pub(crate) const SETTLING: f64 = 1e-3;

/// Maximum number of joints of a coupling.
const MAX: usize = 3;

/// A joint's coordinate with its factor in a sum.
struct Term<'m> {
    axis: Axis,
    joint: &'m Joint,
    /// \[rad, m\] initial coordinate.
    start: f64,
    factor: f64,
}

/// Stiffness of a coupling: at each joint no stiffer than the joint's limits.
fn stiffness(mechanism: &Mechanism<'_>, terms: &[Term<'_>]) -> f64 {
    let of = |term: &Term<'_>| {
        let is_hinge = term.joint.freedom == Freedom::Hinge;
        let own = mechanism.options.stiffness_of_limits(is_hinge, term.axis.span);
        own / (term.factor * term.factor)
    };
    rounded(terms.iter().map(of).fold(f64::INFINITY, f64::min))
}

fn term<'m>(
    mechanism: &Mechanism<'m>,
    named: &Attribute,
    factor: f64,
) -> Result<Option<Term<'m>>, Fault> {
    let body = mechanism.tree.joint(named)?;
    let found = mechanism.axes.get(&body).zip(mechanism.tree.bodies[body].joint.as_ref());
    let start = mechanism.pose.coordinates[body];
    Ok(found.map(|(axis, joint)| Term { axis: axis.clone(), joint, start, factor }))
}

fn of(terms: &[Term<'_>]) -> Vec<(Axis, f64)> {
    let signed = |term: &Term<'_>| if term.axis.is_reversed { -term.factor } else { term.factor };
    terms.iter().map(|term| (term.axis.clone(), signed(term))).collect()
}

/// Adds a coupling for an equality of two joints, or returns the reason why it has no counterpart.
pub(crate) fn equality(
    mechanism: &mut Mechanism<'_>,
    given: &Attributes<'_>,
) -> Result<Option<&'static str>, Fault> {
    let element = given.element;
    let Some(first) = given.get("joint1") else {
        let message = format!("{} has no `joint1`", element.called());
        return Err(Fault::at(element.place, message, "give joint1, joint2 and polycoef"));
    };
    let Some(second) = given.get("joint2") else {
        return Ok(Some("a coupling of one joint is not supported"));
    };
    let mut polynomial = given.numbers("polycoef", 1, 5)?.unwrap_or_else(|| vec![0.0, 1.0]);
    polynomial.resize(5, 0.0);
    if polynomial[2..].iter().any(|coefficient| *coefficient != 0.0) {
        return Ok(Some("only linear couplings are supported"));
    }
    let [constant, ratio] = [polynomial[0], polynomial[1]];
    if ratio == 0.0 {
        return Ok(Some("a coupling of one joint is not supported"));
    }
    let (Some(one), Some(two)) = (term(mechanism, first, 1.0)?, term(mechanism, second, -ratio)?)
    else {
        return Ok(Some("its joints are not hinges or slides of the scene"));
    };
    if one.axis == two.axis {
        return Ok(Some("it couples a joint with itself"));
    }
    let offset =
        constant + ratio * (two.start - two.joint.reference) - (one.start - one.joint.reference);
    let terms = [one, two];
    let stiffness = stiffness(mechanism, &terms);
    let name = element
        .text("name")
        .map_or_else(|| format!("{}-{}", first.value, second.value), str::to_owned);
    let words = format!("<joint> of `{}` and `{}`", first.value, second.value);
    let coupling = Coupling {
        name: mechanism.own_name(&name),
        of: of(&terms),
        offset,
        play: 0.0,
        stiffness,
        damping: rounded(SETTLING * stiffness),
        source: (words, element.place),
    };
    mechanism.couplings.push(coupling);
    Ok(None)
}

/// Stores a fixed tendon of one joint, for actuators.
fn single(mechanism: &mut Mechanism<'_>, element: &Element) -> Result<(), Fault> {
    let mut found = Vec::new();
    for child in element.children.iter().filter(|child| child.name == "joint") {
        let own = Attributes::own(child);
        let factor = own.numbers("coef", 1, 1)?.map_or(0.0, |numbers| numbers[0]);
        if let Some(named) = own.get("joint").filter(|_| factor != 0.0) {
            found.push((mechanism.tree.joint(named)?, factor));
        }
    }
    if let ([one], Some(name)) = (&found[..], element.text("name")) {
        mechanism.scaled.insert(name.to_owned(), *one);
    }
    Ok(())
}

/// Adds couplings for the spring and the range of a fixed tendon, or returns the reason why it has no counterpart.
pub(crate) fn tendon(
    mechanism: &mut Mechanism<'_>,
    given: &Attributes<'_>,
    settings: &Settings,
) -> Result<Option<&'static str>, Fault> {
    let element = given.element;
    single(mechanism, element)?;
    let off = |flag: &str, value: f64| if settings.is_off(flag) { 0.0 } else { value };
    let linear = |name: &str| -> Result<f64, Fault> {
        Ok(given.numbers(name, 1, 3)?.map_or(0.0, |numbers| numbers[0]))
    };
    let stiffness_of_spring = off("spring", linear("stiffness")?);
    let damping = off("damper", linear("damping")?);
    let limited = given.limited("limited", "range", settings.automatic_limits)?;
    let range = given.numbers("range", 2, 2)?.filter(|_| limited && !settings.is_off("limit"));
    if stiffness_of_spring == 0.0 && damping == 0.0 && range.is_none() {
        if element.text("name").is_none_or(|name| !mechanism.scaled.contains_key(name)) {
            let called = element.called();
            mechanism.notes.push(format!("{called} exerts no force and is left out"));
        }
        return Ok(None);
    }
    if range.as_ref().is_some_and(|range| range[0] >= range[1]) {
        return Ok(Some("its range is empty"));
    }
    let mut terms = Vec::new();
    for child in element.children.iter().filter(|child| child.name == "joint") {
        let own = Attributes::own(child);
        let Some(named) = own.get("joint") else {
            let message = format!("{} has no `joint`", child.called());
            return Err(Fault::at(child.place, message, "give joint and coef"));
        };
        let factor = own.numbers("coef", 1, 1)?.map_or(0.0, |numbers| numbers[0]);
        let Some(term) = term(mechanism, named, factor)? else {
            return Ok(Some("its joints are not hinges or slides of the scene"));
        };
        if factor != 0.0 {
            terms.push(term);
        }
    }
    if !(1..=MAX).contains(&terms.len()) {
        return Ok(Some("only couplings of one to three joints are supported"));
    }
    if stiffness_of_spring < 0.0 || damping < 0.0 {
        return Ok(Some("its stiffness or damping is negative"));
    }
    if stiffness_of_spring == 0.0 && damping > 0.0 {
        return Ok(Some("a damper across joints requires a spring"));
    }
    let sum = |q: fn(&Term<'_>) -> f64| terms.iter().map(|term| term.factor * q(term)).sum::<f64>();
    let (start, rest) = (sum(|term| term.start), sum(|term| term.joint.spring_reference));
    let name = element.text("name").unwrap_or("tendon").to_owned();
    let joints: Vec<_> = terms.iter().map(|term| format!("`{}`", term.axis.joint)).collect();
    let words = format!("<fixed name=\"{name}\"> of {}", joints.join(", "));
    let of_limits = stiffness(mechanism, &terms);
    let mut add = |name: &str, [from, to]: [f64; 2], stiffness: f64, damping: f64| {
        let coupling = Coupling {
            name: mechanism.own_name(name),
            of: of(&terms),
            offset: 0.5 * (from + to) - start,
            play: to - from,
            stiffness,
            damping,
            source: (words.clone(), element.place),
        };
        mechanism.couplings.push(coupling);
    };
    if stiffness_of_spring > 0.0 {
        let lengths = given.numbers("springlength", 1, 2)?.unwrap_or_else(|| vec![-1.0]);
        // A length of −1 means the length at which the joint springs are at rest; other lengths may be negative.
        let automatic = lengths.iter().all(|length| *length == -1.0);
        let first = if automatic { rest } else { lengths[0] };
        let last = lengths.get(1).copied().filter(|_| !automatic).unwrap_or(first);
        if last > first && damping > 0.0 {
            return Ok(Some("between its two spring lengths only the damper acts"));
        }
        add(&name, [first, last.max(first)], stiffness_of_spring, damping);
    }
    if let Some(range) = range {
        let damping = rounded(SETTLING * of_limits);
        add(&format!("{name}-range"), [range[0], range[1]], of_limits, damping);
    }
    Ok(None)
}
