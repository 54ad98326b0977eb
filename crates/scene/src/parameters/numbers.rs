//! All numbers of a scene by their paths: the values that a change can replace.
//!
//! `(tables, what was read) => path, value, unit`: the values of `[parameters]`, then in the order of the file within a
//! table. Only written values are listed, no defaults.

use std::ops::Range;

use toml::Spanned;
use toml::de::{DeTable, DeValue};

use super::{Parameter, To, shown};
use crate::written::Log;

/// A number that is written in a scene.
#[derive(Clone, Debug, PartialEq)]
pub struct SceneNumber {
    /// Its path, as used in a change: `body.cart.mass`, `joint.pivot.at[1]`.
    pub path: String,
    /// \[[`unit`](Self::unit)\] its value.
    pub value: f64,
    /// The SI unit, `N/m`; empty for a plain number.
    pub unit: String,
}

impl SceneNumber {
    /// A value of `[parameters]`.
    pub(crate) fn of(parameter: &Parameter) -> Self {
        let way = [To::Key("parameters".into()), To::Key(parameter.name.clone())];
        Self { path: shown(&way), value: parameter.value, unit: parameter.unit.clone() }
    }
}

/// The numbers that were read, with their paths.
pub(crate) fn numbers(read: &Log, document: &DeTable<'_>) -> Vec<SceneNumber> {
    let mut found = Vec::new();
    let add = |way: &[To], span: Range<usize>| {
        if let Some((value, unit)) = read.at(span) {
            found.push(SceneNumber { path: shown(way), value, unit });
        }
    };
    table(document, &mut Vec::new(), &mut { add });
    found
}

fn table(of: &DeTable<'_>, way: &mut Vec<To>, add: &mut impl FnMut(&[To], Range<usize>)) {
    let mut rows: Vec<_> = of.iter().collect();
    rows.sort_by_key(|(key, _)| key.span().start);
    for (key, entry) in rows {
        way.push(To::Key(key.get_ref().to_string()));
        value(entry, way, add);
        way.pop();
    }
}

fn value(of: &Spanned<DeValue<'_>>, way: &mut Vec<To>, add: &mut impl FnMut(&[To], Range<usize>)) {
    match of.get_ref() {
        DeValue::Table(inner) => table(inner, way, add),
        DeValue::Array(array) => {
            for (i, entry) in array.iter().enumerate() {
                way.push(match entry.get_ref() {
                    // An entry of a list of tables, by name or by number from 1.
                    DeValue::Table(one) => {
                        let name = one.get("name").and_then(|name| name.get_ref().as_str());
                        To::Named(name.map_or_else(|| (i + 1).to_string(), str::to_owned), i)
                    }
                    _ => To::Entry(i),
                });
                value(entry, way, add);
                way.pop();
            }
        }
        _ => add(way, of.span()),
    }
}
