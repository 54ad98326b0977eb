//! `[[input]]` of the type `free_length`: a TSDA whose free length is an input, as the law `distance-winch`.
//!
//! `(tables of inputs and TSDAs) => bodies, points, constants of the law; drive of the input`.

use std::collections::BTreeMap;

use crate::assembly::Assembly;
use crate::between::Between;
use crate::drive::{self, Drive};
use crate::error::SceneError;
use crate::free_length::{is_of_type, winches};
use crate::interaction::common::Constants;
use crate::interaction::field::{Of, TwoPlaces};
use crate::interaction::of_couplings::sides;
use crate::pair::Pair;
use crate::spring;
use crate::target::{ElementName, Elements, Kinds};
use crate::text::{Table, Text};
use crate::tsda::FreeLength;

/// Its law.
pub(super) const LAW: &str = "distance-winch";

/// The keys of its type.
pub(crate) const KEYS: &[&str] = &["target"];

/// Refuses inputs that name no TSDA.
pub(super) fn check_targets(
    root: &Table<'_>,
    winches: &BTreeMap<usize, usize>,
    elements: &Elements,
) -> Result<(), SceneError> {
    for (number, input) in root.list("input")?.iter().enumerate() {
        if is_of_type(input) && !winches.values().any(|known| *known == number) {
            input.only(&[drive::INPUT, &drive::KEYS, KEYS])?;
            input.required("target", ElementName { elements, kinds: Kinds::TSDA })?;
        }
    }
    Ok(())
}

/// The bodies of a TSDA, exchanged if the ground is the second one, and the constants of its law.
pub(super) fn read<'a>(
    tsda: &Table<'_>,
    input: usize,
    assembly: &Assembly,
) -> Result<(Pair, Of<'a>), SceneError> {
    let pair = tsda.required("between", Between(assembly))?;
    let [first, second] = tsda.required("points", TwoPlaces { assembly, pair: &pair })?;
    let spring = spring::read(tsda, spring::AXIAL)?;
    if distance(tsda, assembly)? == 0.0 {
        let help = "give two different points, between which the spring has a direction";
        return Err(tsda.refuse_value("points", "coincide", help));
    }
    let mut constants = Constants::default();
    constants.add("stiffness", spring.stiffness);
    constants.add("damping", spring.damping);
    sides(tsda, &mut constants)?;
    if !pair.b.is_world() {
        return Ok((pair, Of::Winch([first, second], input, constants)));
    }
    Ok((pair.reversed(), Of::Winch([second, first], input, constants)))
}

/// \[m\] the distance of the points of a TSDA at the initial pose.
fn distance(tsda: &Table<'_>, assembly: &Assembly) -> Result<f64, SceneError> {
    let pair = tsda.required("between", Between(assembly))?;
    let [a, b] = tsda.required("points", TwoPlaces { assembly, pair: &pair })?;
    let place = |body, point| assembly.place(body, dbd_kernel::Vec3::from_f64(point));
    let d = place(pair.b, b) - place(pair.a, a);
    Ok(libm::sqrt(d.dot(d)))
}

/// The drive of a free length: without one of its own the caller sets it, from the TSDA's `free_length` on.
pub(crate) fn drive_of(
    root: &Table<'_>,
    (number, table): (usize, &Table<'_>),
    drive: Drive,
    assembly: &Assembly,
) -> Result<Drive, SceneError> {
    let row = winches(root)?.into_iter().find(|(_, input)| *input == number);
    let tsda = row.and_then(|(row, _)| root.list("tsda").ok()?.into_iter().nth(row));
    let Some(tsda) = tsda else { return Err(table.missing("target", "the name of a tsda")) };
    let drives = ["value", "table", "sine"].into_iter().find(|key| table.has(key));
    if let Some(key) = drives {
        if tsda.gives("free_length") {
            let name = table.required("name", Text::Name)?;
            let problem = format!("contradicts the `{key}` of input `{name}`");
            return Err(tsda.refuse_key("free_length", &problem, "remove one of the two"));
        }
        check(table, key, drive.least())?;
        return Ok(drive);
    }
    if !tsda.has("free_length") {
        let help = format!(
            "add a `value`, a `table` or a `sine`, or `free_length` to {}: its value at t = 0",
            tsda.label()
        );
        return Err(table.refuse("has no value", help));
    }
    let distance = distance(&tsda, assembly)?;
    Ok(Drive::Caller(tsda.required("free_length", FreeLength { distance })?))
}

/// Refuses a drive with a negative free length.
pub(crate) fn check(table: &Table<'_>, key: &str, least: f64) -> Result<(), SceneError> {
    if least < 0.0 {
        let problem = format!("has the free length {least:?} m");
        return Err(table.refuse_value(key, &problem, "expected free lengths ≥ 0 in m"));
    }
    Ok(())
}

/// The bounds of a free length, which is never negative.
pub(crate) fn range_of(table: &Table<'_>, range: [f64; 2]) -> Result<[f64; 2], SceneError> {
    let [least, most] = range;
    if table.has("range") && least < 0.0 {
        let help = "expected [lower, upper] in m, with lower ≥ 0";
        return Err(table.refuse_value("range", "has a negative free length", help));
    }
    Ok([least.max(0.0), most])
}
