//! The tables of a scene file and their keys.
//!
//! `() => tables with their keys`, from the lists by which unknown keys are refused; for editor schemas and similar
//! tools.

use crate::{
    body, defaults, drive, geometry, inertia, input, interaction, joints, links, load, read,
};
use crate::{orientation, point_on_line, points, readout, spring, start, torsion_spring, tsda};

/// A table of scene files and its allowed keys.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct TableKeys {
    /// Its name: `scene`, `body`, `joint`; for nested tables `link`, `shape`, `spider`, `orientation`,
    /// `point` (in `[points]`), `halves` (`{ first, second }`), `rate` (of a joint in `assemble.rates`), `stiffness`,
    /// `sine`, `limits`, `friction` and `rotor` of joints, `gear` and `winding` of drives, `sensor` of
    /// read-outs, `term` of couplings.
    pub table: &'static str,
    /// The type or shape with these keys, if there are several: `revolute`.
    pub kind: Option<&'static str>,
    /// The keys, in the order of messages.
    pub keys: Vec<&'static str>,
}

/// All tables except `[parameters]` and `[points]`, whose keys are names, and `[defaults]`, whose keys are kinds.
#[must_use]
pub fn vocabulary() -> Vec<TableKeys> {
    let one =
        |table, keys: &[&[&'static str]]| TableKeys { table, kind: None, keys: keys.concat() };
    let mut all = vec![
        one("scene", &[read::KEYS]),
        one("point", &[points::KEYS]),
        one("body", &[body::KEYS]),
        one("orientation", &[orientation::KEYS]),
        one("stiffness", &[spring::BY_LOAD]),
        one("tsda", &[tsda::KEYS, spring::KEYS]),
        one("point_on_line", &[point_on_line::KEYS, spring::KEYS]),
        one("torsion_spring", &[torsion_spring::KEYS, spring::KEYS]),
        one("load", &[load::KEYS]),
        one("sine", &[drive::SINE]),
        one("start", &[start::KEYS]),
        one("limits", &[interaction::LIMITS]),
        one("friction", &[interaction::FRICTION]),
        one("friction_load", &[interaction::LOAD]),
        one("rotor", &[interaction::ROTOR]),
        one("gear", &[interaction::GEAR]),
        one("shaft_friction", &[interaction::SHAFT_FRICTION]),
        one("sensor", &[interaction::SENSOR]),
        one("winding", &[interaction::WINDING, interaction::AXES]),
        one("coupling", &[interaction::COUPLING]),
        one("term", &[interaction::TERM]),
    ];
    all.extend(joints::WITHIN.map(|(table, keys)| one(table, &[keys])));
    let mut add = |table, kind, keys| all.push(TableKeys { table, kind: Some(kind), keys });
    for shape in inertia::NAMES {
        let sizes = inertia::sizes(shape);
        add("link", shape, [links::KEYS, &["shape", "mass", "density"], sizes].concat());
        // A sphere has no axis.
        let along = if shape == "sphere" { &body::SHAPE[..1] } else { body::SHAPE };
        add("shape", shape, [along, &["mass", "density"], sizes].concat());
    }
    joints::types().for_each(|(kind, keys)| add("joint", kind, keys));
    input::types().for_each(|(kind, keys)| add("input", kind, keys));
    interaction::types().for_each(|(kind, keys)| add("interaction", kind, keys));
    readout::types().for_each(|(kind, keys)| add("readout", kind, keys));
    geometry::shapes().for_each(|(kind, keys)| add("geometry", kind, keys));
    all
}

/// The tables of `[defaults]` with their allowed keys.
#[must_use]
pub fn defaults() -> Vec<(&'static str, Vec<&'static str>)> {
    let own = |keys: Vec<&'static [&'static str]>| {
        let mut all: Vec<&'static str> = Vec::new();
        for key in keys.concat() {
            if !defaults::OWN.contains(&key) && !all.contains(&key) {
                all.push(key);
            }
        }
        all
    };
    defaults::kinds().into_iter().map(|(kind, keys)| (kind, own(keys))).collect()
}

/// The named colours of geometry.
#[must_use]
pub fn colours() -> Vec<&'static str> {
    geometry::colour_words().into()
}
