//! The types of joints, by their names in a scene.
//!
//! `type => constraints, keys`.

use crate::closure::{Place, Turn};
use crate::error::SceneError;
use crate::joints::kind::JointType;
use crate::joints::{
    cylindrical, fixed, realisation, revolute, spherical, translational, universal,
};
use crate::shortened::shortened;
use crate::spring;
use crate::text::{Choice, Kind as _, Table};

/// In the order of messages.
pub(super) static TYPES: [JointType; 6] = [
    spherical::TYPE,
    revolute::TYPE,
    universal::TYPE,
    cylindrical::TYPE,
    translational::TYPE,
    fixed::TYPE,
];

pub(super) const KEYS: &[&str] = &["name", "type", "between", "at"];

/// Every key of all types together, then those of each type.
pub(crate) fn keys() -> Vec<(&'static str, Vec<&'static [&'static str]>)> {
    let with = |keys: &[&'static [&'static str]]| [&[KEYS, spring::KEYS], keys].concat();
    let all: Vec<_> = TYPES.iter().map(|kind| kind.keys).collect();
    let each = TYPES.iter().map(|kind| (kind.name, with(&[kind.keys])));
    std::iter::once(("joint", with(&all))).chain(each).collect()
}

/// The types, each with all its keys.
pub(crate) fn types() -> impl Iterator<Item = (&'static str, Vec<&'static str>)> {
    TYPES.iter().map(|kind| (kind.name, [KEYS, spring::KEYS, kind.keys].concat()))
}

/// Constraints of a joint type on its points and triads.
pub(crate) fn holds(kind: &str) -> (Place, Turn) {
    let of_type = TYPES.iter().find(|of_type| of_type.name == kind);
    of_type.map_or((Place::Point, Turn::All), |of_type| of_type.asks)
}

/// Names of the types in other programs.
const OTHER_NAMES: [(&str, &[&str]); 6] = [
    ("spherical", &["ball", "ball_and_socket", "ball_socket", "socket", "point", "globular"]),
    (
        "revolute",
        &["hinge", "pin", "pivot", "rotary", "rotational", "rotation", "continuous", "bearing"],
    ),
    ("universal", &["cardan", "u", "hooke", "hookes", "hardy_spicer", "gimbal", "cross"]),
    ("cylindrical", &["cylinder", "slide_and_turn"]),
    (
        "translational",
        &["slider", "slide", "prismatic", "sliding", "linear", "translation", "guide"],
    ),
    ("fixed", &["weld", "welded", "rigid", "lock", "locked", "clamp", "clamped", "bolted"]),
];

/// The type, which determines the other keys.
pub(super) fn kind(table: &Table<'_>) -> Result<&'static JointType, SceneError> {
    if !table.has("type") {
        let mut keys = vec![KEYS, spring::KEYS];
        keys.extend(TYPES.iter().map(|kind| kind.keys));
        table.only(&keys)?;
    }
    let names = TYPES.each_ref().map(|kind| kind.name);
    let value = table.value("type");
    if let Some((value, word)) = value.as_ref().and_then(|v| Some((v, v.get().as_str()?)))
        && let Some(meant) = meant_by(word)
    {
        let expected = format!("{}; did you mean \"{meant}\"?", Choice(&names).expected());
        return Err(value.refuse(&format!("is \"{}\"", shortened(word)), &expected));
    }
    let kind = &TYPES[table.required("type", Choice(&names))?];
    realisation::check(table, kind)?;
    Ok(kind)
}

/// Accepts only the keys of its type: defaults of other types do not apply.
pub(crate) fn allow(table: &Table<'_>) -> Result<(), SceneError> {
    table.only(&[KEYS, kind(table)?.keys, spring::KEYS])
}

/// The type for an alternative name, with or without the suffix "joint".
fn meant_by(word: &str) -> Option<&'static str> {
    let word = word.to_lowercase().replace([' ', '-'], "_").replace('\'', "");
    let word = word.strip_suffix("joint").unwrap_or(&word).trim_end_matches('_');
    let other = OTHER_NAMES.iter().find(|(_, others)| others.contains(&word));
    other.map(|(name, _)| *name)
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn every_other_name_is_of_a_type_and_of_one() {
        let all =
            || OTHER_NAMES.iter().flat_map(|(name, others)| others.iter().map(move |o| (name, *o)));
        for (name, other) in all() {
            assert!(TYPES.iter().any(|kind| kind.name == *name), "{name}");
            assert!(TYPES.iter().all(|kind| kind.name != other), "{other}");
            assert_eq!(all().filter(|(_, o)| *o == other).count(), 1, "{other}");
        }
        for word in ["U-joint", "u_joint", "Cardan joint", "Hooke's"] {
            assert_eq!(meant_by(word), Some("universal"), "{word}");
        }
        assert_eq!(meant_by("revolut"), None);
    }
}
