//! The names in a value's text: the `[parameters]` of a scene.
//!
//! `(name, position in the file) => quantity, and whether it was used`. A name consists of letters, digits and `_`,
//! does not start with a digit and is not a unit: `m` is always a metre. A parameter `A`, `V` or `H` hides the unit.

use std::cell::Cell;
use std::collections::BTreeMap;

use crate::nearest::nearest;
use crate::quantity::Quantity;
use crate::quantity::unit::{HIDDEN, UNITS, find};
use crate::quantity::word::{begins_word, word};
use crate::shortened::shortened;

/// A constant that every text may use.
pub(super) const PI: (&str, f64) = ("pi", core::f64::consts::PI);

/// Why a text cannot be a name.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(crate) enum NameFault {
    /// It is not one word of letters, digits and `_`.
    NoWord,
    /// It is a unit.
    Unit,
    /// It is the constant π.
    Constant,
}

/// Whether a text can be a name.
pub(crate) fn check_name(name: &str) -> Result<(), NameFault> {
    if find(name).is_some() && !HIDDEN.contains(&name) {
        return Err(NameFault::Unit);
    }
    if name == PI.0 {
        return Err(NameFault::Constant);
    }
    let is_word = name.starts_with(begins_word) && word(name).len() == name.len();
    if !is_word || name.contains('°') || ["inf", "nan"].contains(&name) {
        return Err(NameFault::NoWord);
    }
    Ok(())
}

/// Names with their values, in the order of the file.
#[derive(Debug, Default)]
pub(crate) struct Scope {
    rows: BTreeMap<String, usize>,
    entries: Vec<Entry>,
}

#[derive(Debug)]
struct Entry {
    name: String,
    quantity: Option<Quantity>,
    used: Cell<bool>,
}

impl Scope {
    /// Names without values; each once.
    pub(crate) fn of(names: impl Iterator<Item = String>) -> Self {
        let entry = |name| Entry { name, quantity: None, used: Cell::new(false) };
        let entries: Vec<Entry> = names.map(entry).collect();
        let rows = entries.iter().enumerate().map(|(row, entry)| (entry.name.clone(), row));
        Self { rows: rows.collect(), entries }
    }

    /// Sets the value of a name.
    pub(crate) fn set(&mut self, row: usize, quantity: Quantity) {
        if let Some(entry) = self.entries.get_mut(row) {
            entry.quantity = Some(quantity);
        }
    }

    /// The index of a name.
    pub(crate) fn row(&self, name: &str) -> Option<usize> {
        self.rows.get(name).copied()
    }

    /// The value of a name, without marking it as used.
    pub(crate) fn look(&self, name: &str) -> Option<Quantity> {
        self.entries.get(self.row(name)?)?.quantity
    }

    /// The value of a name; marks it as used.
    pub(crate) fn get(&self, name: &str) -> Option<Quantity> {
        let entry = self.entries.get(self.row(name)?)?;
        entry.used.set(true);
        entry.quantity
    }

    /// All names with their values and whether they were used.
    pub(crate) fn iter(&self) -> impl Iterator<Item = (&str, Quantity, bool)> {
        self.entries.iter().filter_map(|entry| {
            entry.quantity.map(|quantity| (entry.name.as_str(), quantity, entry.used.get()))
        })
    }

    /// The remedy for an unknown word.
    pub(super) fn help(&self, word: &str) -> String {
        let names = || self.entries.iter().map(|entry| entry.name.as_str());
        let units = UNITS.iter().map(|unit| unit.name);
        let meant = match near(word, names()) {
            Some(_) => None,
            None => power(word),
        };
        let meant = meant.or_else(|| near(word, names().chain(units)).map(str::to_owned));
        let mut help = meant.map_or_else(String::new, |meant| format!("did you mean `{meant}`? "));
        let some: Vec<_> = names().take(12).map(shortened).collect();
        if !some.is_empty() {
            let more = if self.entries.len() > some.len() { " …" } else { "" };
            help += &format!("known parameters: {}{more}; ", some.join(", "));
        }
        help + "known units: m, mm, kg, s, ms, deg, N, kN, Hz, …"
    }
}

/// Suggests `m^2` for a unit followed by a digit, `m2`.
fn power(word: &str) -> Option<String> {
    let unit = word.trim_end_matches(|c: char| c.is_ascii_digit());
    let power = &word[unit.len()..];
    (find(unit).is_some() && power.len() == 1).then(|| format!("{unit}^{power}"))
}

/// The name closest to a word; a single letter matches only itself.
fn near<'c>(word: &str, names: impl Iterator<Item = &'c str>) -> Option<&'c str> {
    let alone = word.chars().nth(1).is_none();
    nearest(word, names.filter(|name| !alone || name.to_lowercase() == word.to_lowercase()))
}
