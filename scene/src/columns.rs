//! The columns of a trace: each its own.
//!
//! `(bodies, read-outs) => names in order`: time, the bodies, the energies, the read-outs.

use std::collections::BTreeMap;

use crate::Scene;

/// Columns of a body, after its name.
pub const BODY_COLUMNS: [&str; 13] =
    [".x", ".y", ".z", ".qw", ".qx", ".qy", ".qz", ".vx", ".vy", ".vz", ".wx", ".wy", ".wz"];

/// Columns after those of the bodies.
pub const ENERGY_COLUMNS: [&str; 3] = ["energy.kinetic", "energy.potential", "energy.total"];

const TIME: &str = "time";

impl Scene {
    /// The names of a trace's columns in order.
    #[must_use]
    pub fn columns(&self) -> Vec<String> {
        let mut columns = vec![TIME.to_owned()];
        columns.extend(self.body_names.iter().flat_map(|body| of_body(body)));
        columns.extend(ENERGY_COLUMNS.map(str::to_owned));
        for readout in &self.readouts {
            columns.extend(readout.columns.iter().map(|(end, _)| readout.name.clone() + end));
        }
        columns
    }
}

fn of_body(name: &str) -> impl Iterator<Item = String> + use<'_> {
    BODY_COLUMNS.iter().map(move |end| format!("{name}{end}"))
}

/// The columns that are taken, and by what.
pub(crate) struct Taken(BTreeMap<String, String>);

impl Taken {
    /// The columns of time, bodies and energies.
    pub(crate) fn new(bodies: &[String]) -> Self {
        let mut taken = BTreeMap::from([(TIME.to_owned(), "the time".to_owned())]);
        for body in bodies {
            taken.extend(of_body(body).map(|column| (column, format!("the body `{body}`"))));
        }
        let energies = ENERGY_COLUMNS.map(|column| (column.to_owned(), "the energy".to_owned()));
        taken.extend(energies);
        Self(taken)
    }

    /// Takes a column for `owner`.
    ///
    /// # Errors
    /// Who has it already.
    pub(crate) fn take(&mut self, column: String, owner: &str) -> Result<(), &str> {
        use std::collections::btree_map::Entry;
        match self.0.entry(column) {
            Entry::Vacant(free) => {
                free.insert(owner.to_owned());
                Ok(())
            }
            Entry::Occupied(other) => Err(other.into_mut()),
        }
    }
}
