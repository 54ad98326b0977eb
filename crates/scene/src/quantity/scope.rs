//! What names stand for in a value's text: the `[parameters]` of a scene.
//!
//! `(name, place in the file) => quantity, and whether it was asked for`. What may be a name: letters, digits and `_`,
//! no digit first, and no unit: `m` is a metre wherever it stands. A parameter `A`, `V` or `H` hides the unit.

use std::cell::Cell;
use std::collections::BTreeMap;

use crate::nearest::nearest;
use crate::quantity::Quantity;
use crate::quantity::unit::{HIDDEN, UNITS, find};
use crate::quantity::word::{begins_word, word};
use crate::shortened::shortened;

/// What every text may name.
pub(super) const PI: (&str, f64) = ("pi", core::f64::consts::PI);

/// Why a text cannot be a name.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(crate) enum NameFault {
    /// It is not one word of letters, digits and `_`.
    NoWord,
    /// A unit has it.
    Unit,
    /// Every text has it: π.
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

/// Names with what they stand for, in the order of the file.
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
    /// Names that stand for nothing yet; each once.
    pub(crate) fn of(names: impl Iterator<Item = String>) -> Self {
        let entry = |name| Entry { name, quantity: None, used: Cell::new(false) };
        let entries: Vec<Entry> = names.map(entry).collect();
        let rows = entries.iter().enumerate().map(|(row, entry)| (entry.name.clone(), row));
        Self { rows: rows.collect(), entries }
    }

    /// What a name stands for from now on.
    pub(crate) fn set(&mut self, row: usize, quantity: Quantity) {
        if let Some(entry) = self.entries.get_mut(row) {
            entry.quantity = Some(quantity);
        }
    }

    /// Which of the names it is.
    pub(crate) fn row(&self, name: &str) -> Option<usize> {
        self.rows.get(name).copied()
    }

    /// What a name stands for, without asking for it.
    pub(crate) fn look(&self, name: &str) -> Option<Quantity> {
        self.entries.get(self.row(name)?)?.quantity
    }

    /// What a name stands for.
    pub(crate) fn get(&self, name: &str) -> Option<Quantity> {
        let entry = self.entries.get(self.row(name)?)?;
        entry.used.set(true);
        entry.quantity
    }

    /// All names with what they stand for and whether they were asked for.
    pub(crate) fn iter(&self) -> impl Iterator<Item = (&str, Quantity, bool)> {
        self.entries.iter().filter_map(|entry| {
            entry.quantity.map(|quantity| (entry.name.as_str(), quantity, entry.used.get()))
        })
    }

    /// What would be right instead of an unknown word.
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
            help += &format!("[parameters] has {}{more}; ", some.join(", "));
        }
        help + "units are m, mm, kg, s, ms, deg, N, kN, Hz, …"
    }
}

/// A unit with digits behind it as its power: `m2` is meant as `m^2`.
fn power(word: &str) -> Option<String> {
    let unit = word.trim_end_matches(|c: char| c.is_ascii_digit());
    let power = &word[unit.len()..];
    (find(unit).is_some() && power.len() == 1).then(|| format!("{unit}^{power}"))
}

/// The name nearest to a word: to a single letter only the same one is near.
fn near<'c>(word: &str, names: impl Iterator<Item = &'c str>) -> Option<&'c str> {
    let alone = word.chars().nth(1).is_none();
    nearest(word, names.filter(|name| !alone || name.to_lowercase() == word.to_lowercase()))
}
