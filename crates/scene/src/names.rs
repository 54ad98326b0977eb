//! Names that must differ from each other, and what they name.

use std::collections::BTreeMap;

use crate::error::SceneError;
use crate::text::{Table, Text};

/// The names of some tables, where they are given and what they name.
pub(crate) struct Names<T> {
    entries: BTreeMap<String, Entry<T>>,
}

struct Entry<T> {
    kind: &'static str,
    start: usize,
    thing: T,
}

impl<T> Default for Names<T> {
    fn default() -> Self {
        Self { entries: BTreeMap::new() }
    }
}

impl<T> Names<T> {
    /// Reads the name of a table of `kind`, its key, and refuses one that an earlier table has.
    pub(crate) fn read(
        &mut self,
        table: &Table<'_>,
        kind: &'static str,
        thing: T,
    ) -> Result<String, SceneError> {
        let name = table.required("name", Text::Name)?;
        self.add(table, name.clone(), kind, thing)?;
        Ok(name)
    }

    /// Adds a name that a table has by what it belongs to.
    pub(crate) fn add(
        &mut self,
        table: &Table<'_>,
        name: String,
        kind: &'static str,
        thing: T,
    ) -> Result<(), SceneError> {
        let entry = Entry { kind, start: table.start(), thing };
        if let Some(first) = self.entries.insert(name.clone(), entry) {
            let line = table.line_of(first.start);
            let problem = format!("is \"{name}\", as that of the {} on line {line}", first.kind);
            let help = if kind == first.kind {
                format!("each {kind} has a name of its own")
            } else {
                "joints and other elements have names that differ from each other".into()
            };
            return Err(match table.has("name") {
                true => table.refuse_value("name", &problem, help),
                false => table.refuse(&format!("has a name that {problem}"), help),
            });
        }
        Ok(())
    }

    /// Reads a name that may be absent.
    pub(crate) fn read_optional(
        &mut self,
        table: &Table<'_>,
        kind: &'static str,
        thing: T,
    ) -> Result<(), SceneError> {
        if table.has("name") { self.read(table, kind, thing).map(drop) } else { Ok(()) }
    }

    /// What a name names.
    pub(crate) fn get(&self, name: &str) -> Option<&T> {
        self.entries.get(name).map(|entry| &entry.thing)
    }

    /// All names with what they name, in alphabetical order.
    pub(crate) fn iter(&self) -> impl Iterator<Item = (&str, &T)> {
        self.entries.iter().map(|(name, entry)| (name.as_str(), &entry.thing))
    }
}
