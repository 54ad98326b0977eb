//! The columns of a trace: each its own.
//!
//! `(bodies, read-outs) => names in order`: time, the bodies, the energies, the read-outs; and back.

use std::collections::{BTreeMap, BTreeSet};

/// Columns of a body, after its name.
pub const BODY_COLUMNS: [&str; 13] =
    [".x", ".y", ".z", ".qw", ".qx", ".qy", ".qz", ".vx", ".vy", ".vz", ".wx", ".wy", ".wz"];

/// Columns after those of the bodies.
pub const ENERGY_COLUMNS: [&str; 3] = ["energy.kinetic", "energy.potential", "energy.total"];

/// The first column.
pub const TIME_COLUMN: &str = "time";

/// What the columns of a trace are of: [`Scene::columns`](crate::Scene::columns), read back.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct TraceColumns {
    /// Names of the bodies in order.
    pub bodies: Vec<String>,
    /// Names of the read-outs' columns in order.
    pub readouts: Vec<String>,
}

/// A name that stands where a trace has another column.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct UnlikeColumn {
    /// Its place, from 0; that behind the last name where one is missing.
    pub place: usize,
    /// What is wrong.
    pub problem: String,
}

impl TraceColumns {
    /// Reads the names of a trace's columns.
    ///
    /// # Errors
    /// The first name that is not in its place, or is there twice.
    pub fn of(names: &[String]) -> Result<Self, UnlikeColumn> {
        let expect = |place: usize, expected: &str| match names.get(place) {
            Some(name) if name == expected => Ok(()),
            Some(name) => {
                let problem = format!("`{name}` stands where a trace has `{expected}`");
                Err(UnlikeColumn { place, problem })
            }
            None => Err(UnlikeColumn { place, problem: format!("`{expected}` is missing") }),
        };
        expect(0, TIME_COLUMN)?;
        let (mut bodies, mut place) = (Vec::new(), 1);
        while names.get(place).is_some_and(|name| name != ENERGY_COLUMNS[0]) {
            let Some(body) = names[place].strip_suffix(BODY_COLUMNS[0]) else {
                // The error says what would be right.
                expect(place, ENERGY_COLUMNS[0])?;
                break;
            };
            for (column, expected) in of_body(body).enumerate() {
                expect(place + column, &expected)?;
            }
            bodies.push(body.to_owned());
            place += BODY_COLUMNS.len();
        }
        for (column, expected) in ENERGY_COLUMNS.iter().enumerate() {
            expect(place + column, expected)?;
        }
        let mut seen = BTreeSet::new();
        if let Some(place) = names.iter().position(|name| !seen.insert(name)) {
            let problem = format!("`{}` stands there twice", names[place]);
            return Err(UnlikeColumn { place, problem });
        }
        Ok(Self { bodies, readouts: names[place + ENERGY_COLUMNS.len()..].to_vec() })
    }
}

/// The columns of a body.
pub(crate) fn of_body(name: &str) -> impl Iterator<Item = String> + use<'_> {
    BODY_COLUMNS.iter().map(move |end| format!("{name}{end}"))
}

/// The columns that are taken, and by what.
pub(crate) struct Taken(BTreeMap<String, String>);

impl Taken {
    /// The columns of time, bodies and energies.
    pub(crate) fn new(bodies: &[String]) -> Self {
        let mut taken = BTreeMap::from([(TIME_COLUMN.to_owned(), "the time".to_owned())]);
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

#[cfg(test)]
mod tests {
    use super::*;

    fn names(text: &str) -> Vec<String> {
        text.split(' ').map(str::to_owned).collect()
    }

    fn body(name: &str) -> String {
        of_body(name).collect::<Vec<_>>().join(" ")
    }

    #[test]
    fn columns_are_read_back() {
        // A body may be called as an energy is, or as a column of another.
        let of = ["energy.kinetic", "a", "a.x"].map(body).join(" ");
        let energies = ENERGY_COLUMNS.join(" ");
        let columns = TraceColumns::of(&names(&format!("time {of} {energies} angle p.x p.y")));
        let bodies = names("energy.kinetic a a.x");
        assert_eq!(columns, Ok(TraceColumns { bodies, readouts: names("angle p.x p.y") }));
        for (text, place, problem) in [
            ("", 0, "`` stands where a trace has `time`"),
            ("t", 0, "`t` stands where a trace has `time`"),
            ("time", 1, "`energy.kinetic` is missing"),
            ("time b.y", 1, "`b.y` stands where a trace has `energy.kinetic`"),
            ("time b.x b.z", 2, "`b.z` stands where a trace has `b.y`"),
            ("time energy.kinetic energy.total", 2, "`energy.total` stands where"),
            ("time energy.kinetic energy.potential energy.total a a", 5, "`a` stands there twice"),
        ] {
            let wrong = TraceColumns::of(&names(text)).unwrap_err();
            assert_eq!(wrong.place, place, "{text}");
            assert!(wrong.problem.starts_with(problem), "{text}: {}", wrong.problem);
        }
    }
}
