//! Written numbers that the model no longer contains.
//!
//! `read values => all numbers by position; large plain angles with their lines`.

use std::cell::RefCell;
use std::collections::BTreeMap;
use std::f64::consts::TAU;
use std::ops::Range;

/// \[rad\] An angle above one revolution is suspect; the margin allows for a revolution written with three digits.
const WHOLE_TURN: f64 = 1.001 * TAU;

/// An angle without a unit that exceeds one revolution.
#[derive(Clone, Debug, PartialEq)]
pub(crate) struct WrittenAngle {
    /// Its owner in messages: ``body `crank` ``.
    pub(crate) owner: String,
    /// Its key, with its table: `` `angle` of its orientation``.
    pub(crate) key: String,
    /// The line, from 1.
    pub(crate) line: usize,
    /// \[rad\].
    pub(crate) angle: f64,
}

/// Large angles by the bytes at which they begin: a value that is read twice counts once.
#[derive(Debug, Default)]
pub(crate) struct Angles(RefCell<BTreeMap<usize, WrittenAngle>>);

impl Angles {
    /// Records an angle if it is large: its key, owner, text and start byte.
    pub(crate) fn note(&self, angle: f64, [key, owner]: [&str; 2], text: &str, start: usize) {
        if angle.abs() <= WHOLE_TURN {
            return;
        }
        let key = key.split('[').next().unwrap_or_default();
        let (owner, key) = match owner.split_once("` of ") {
            Some((point, "[points]")) => (format!("point {point}`"), key.to_owned()),
            Some((table, owner)) if table.starts_with('`') => {
                (owner.to_owned(), format!("{key} of its {}", &table[1..]))
            }
            _ => (owner.to_owned(), key.to_owned()),
        };
        let before = text.as_bytes().iter().take(start);
        let line = 1 + before.filter(|byte| **byte == b'\n').count();
        self.0.borrow_mut().insert(start, WrittenAngle { owner, key, line, angle });
    }

    /// All angles in the order of the file.
    pub(crate) fn all(self) -> Vec<WrittenAngle> {
        self.0.into_inner().into_values().collect()
    }
}

/// The numbers that were read, by position.
#[derive(Debug, Default)]
pub(crate) struct Log(RefCell<BTreeMap<(usize, usize), (f64, String)>>);

impl Log {
    /// Records a number; the first of two readings counts.
    pub(crate) fn note(&self, span: Range<usize>, value: f64, unit: &str) {
        let mut noted = self.0.borrow_mut();
        noted.entry((span.start, span.end)).or_insert_with(|| (value, unit.to_owned()));
    }

    /// The value and the unit of the number that was read at these bytes.
    pub(crate) fn at(&self, span: Range<usize>) -> Option<(f64, String)> {
        self.0.borrow().get(&(span.start, span.end)).cloned()
    }
}
