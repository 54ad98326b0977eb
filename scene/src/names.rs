//! Names that must differ from each other.

use std::collections::BTreeMap;

use crate::error::SceneError;
use crate::text::{Table, Text};

/// The names of one kind of table and where they are given.
pub(crate) struct Names {
    kind: &'static str,
    starts: BTreeMap<String, usize>,
}

impl Names {
    /// None yet; `kind` is the key of the tables.
    pub(crate) fn new(kind: &'static str) -> Self {
        Self { kind, starts: BTreeMap::new() }
    }

    /// Reads the table's name and refuses one that an earlier table has.
    pub(crate) fn read(&mut self, table: &Table<'_>) -> Result<String, SceneError> {
        let kind = self.kind;
        let name = table.required("name", Text::Name)?;
        if let Some(start) = self.starts.insert(name.clone(), table.start()) {
            let first = table.line_of(start);
            let problem = format!("is \"{name}\", as that of the {kind} on line {first}");
            let help = format!("each {kind} has a name of its own");
            return Err(table.refuse_value("name", &problem, help));
        }
        Ok(name)
    }
}
