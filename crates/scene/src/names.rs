//! Unique names and the items that they refer to.

use std::collections::BTreeMap;

use crate::error::SceneError;
use crate::text::{Table, Text};

/// The names of some tables, with their positions and items.
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
    /// Reads the name of a table of `kind`; refuses a name that an earlier table has.
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

    /// Adds a name that a table derives from its owner.
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
            let problem = format!("duplicates \"{name}\" of the {} on line {line}", first.kind);
            let help = if kind == first.kind {
                format!("each {kind} needs a unique name")
            } else {
                "the names of joints and other elements must be unique".into()
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

    /// The item of a name.
    pub(crate) fn get(&self, name: &str) -> Option<&T> {
        self.entries.get(name).map(|entry| &entry.thing)
    }

    /// All names with their items, in alphabetical order.
    pub(crate) fn iter(&self) -> impl Iterator<Item = (&str, &T)> {
        self.entries.iter().map(|(name, entry)| (name.as_str(), &entry.thing))
    }
}
