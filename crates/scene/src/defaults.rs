//! `[defaults]`: default values of keys for each kind of table.
//!
//! `[defaults.joint], [defaults.revolute] => error for an unknown kind or key`. Tables look up their defaults
//! themselves; those of a type of joint take precedence over those of all joints. Values are read and checked with
//! the tables that use them.

use crate::error::SceneError;
use crate::text::Table;
use crate::{
    body, geometry, inertia, input, interaction, joints, links, load, point_on_line, readout,
    spring,
};
use crate::{torsion_spring, tsda};

/// Keys without a default: they identify a table.
pub(crate) const OWN: &[&str] = &["name"];

/// The kinds that have defaults, each with all keys of its tables.
pub(crate) fn kinds() -> Vec<(&'static str, Vec<&'static [&'static str]>)> {
    let mut kinds = vec![
        ("body", vec![body::KEYS]),
        ("link", vec![links::KEYS, inertia::KEYS]),
        ("shape", vec![body::SHAPE, &inertia::KEYS[1..]]),
        ("tsda", vec![tsda::KEYS, spring::KEYS]),
        ("point_on_line", vec![point_on_line::KEYS, spring::KEYS]),
        ("torsion_spring", vec![torsion_spring::KEYS, spring::KEYS]),
        ("coupling", vec![interaction::COUPLING]),
        ("load", vec![load::KEYS]),
        ("input", input::keys()),
        ("readout", readout::keys()),
        ("geometry", geometry::keys()),
    ];
    kinds.extend(joints::keys());
    kinds
}

/// Rejects defaults that no table has.
pub(crate) fn check(root: &Table<'_>) -> Result<(), SceneError> {
    let Some(value) = root.value("defaults") else { return Ok(()) };
    let defaults =
        value.table("tables of keys by kind, such as [defaults.joint]")?.called("[defaults]");
    let kinds = kinds();
    let names: Vec<&'static str> = kinds.iter().map(|(name, _)| *name).collect();
    defaults.only(&[&names])?;
    for (name, keys) in kinds {
        let Some(value) = defaults.value(name) else { continue };
        let table = value.table("a table of keys")?.called(&format!("[defaults.{name}]"));
        let keys: Vec<&'static str> =
            keys.concat().into_iter().filter(|key| !OWN.contains(key)).collect();
        table.only(&[&keys])?;
    }
    Ok(())
}
