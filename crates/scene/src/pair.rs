//! Two bodies that an element connects.

use dbd_kernel::BodyIndex;

use crate::text::Table;

/// Two different bodies, one of which may be the world.
#[derive(Clone, Debug, PartialEq)]
pub(crate) struct Pair {
    /// The first: owner of centre points, axis points and axes.
    pub(crate) a: BodyIndex,
    /// The second: owner of ring and arm points.
    pub(crate) b: BodyIndex,
    /// Their names.
    pub(crate) names: [String; 2],
}

impl Pair {
    /// The second body first.
    pub(crate) fn reversed(&self) -> Self {
        let [first, second] = self.names.clone();
        Self { a: self.b, b: self.a, names: [second, first] }
    }

    /// The name of a table's element in messages: `tsda 1 (world–crank)`.
    pub(crate) fn label(&self, table: &Table<'_>) -> String {
        let [a, b] = &self.names;
        format!("{} ({a}–{b})", table.label())
    }
}
