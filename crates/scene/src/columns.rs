//! The columns of a trace, each with a unique name.
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

/// Contents of the columns of a trace, read back from [`Scene::columns`](crate::Scene::columns).
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct TraceColumns {
    /// Names of the bodies in order.
    pub bodies: Vec<String>,
    /// Names of the read-outs' columns in order.
    pub readouts: Vec<String>,
}

/// An unexpected name of a column.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct UnlikeColumn {
    /// Its index, from 0; the number of names if one is missing.
    pub place: usize,
    /// The problem.
    pub problem: String,
}

impl TraceColumns {
    /// Reads the names of a trace's columns.
    ///
    /// # Errors The first unexpected or duplicate name.
    pub fn of(names: &[String]) -> Result<Self, UnlikeColumn> {
        let expect = |place: usize, expected: &str| match names.get(place) {
            Some(name) if name == expected => Ok(()),
            Some(name) => {
                let problem = format!("found `{name}`, expected `{expected}`");
                Err(UnlikeColumn { place, problem })
            }
            None => Err(UnlikeColumn { place, problem: format!("`{expected}` is missing") }),
        };
        expect(0, TIME_COLUMN)?;
        let (mut bodies, mut place) = (Vec::new(), 1);
        while names.get(place).is_some_and(|name| name != ENERGY_COLUMNS[0]) {
            let Some(body) = names[place].strip_suffix(BODY_COLUMNS[0]) else {
                // The error states the expected name.
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
            let problem = format!("duplicate column `{}`", names[place]);
            return Err(UnlikeColumn { place, problem });
        }
        Ok(Self { bodies, readouts: names[place + ENERGY_COLUMNS.len()..].to_vec() })
    }
}

/// The columns of a body.
pub(crate) fn of_body(name: &str) -> impl Iterator<Item = String> + use<'_> {
    BODY_COLUMNS.iter().map(move |end| format!("{name}{end}"))
}

/// Used columns and their owners.
pub(crate) struct Taken {
    bodies: BTreeSet<String>,
    readouts: BTreeMap<String, String>,
}

impl Taken {
    /// The columns of time, bodies and energies.
    pub(crate) fn new(bodies: &[String]) -> Self {
        Self { bodies: bodies.iter().cloned().collect(), readouts: BTreeMap::new() }
    }

    /// Reserves a column for `owner`.
    ///
    /// # Errors The present owner, if it is used.
    pub(crate) fn take(&mut self, column: String, owner: &str) -> Result<(), String> {
        if column == TIME_COLUMN {
            return Err("the time".into());
        }
        if ENERGY_COLUMNS.contains(&column.as_str()) {
            return Err("the energy".into());
        }
        let body = BODY_COLUMNS.iter().find_map(|end| self.bodies.get(column.strip_suffix(end)?));
        if let Some(body) = body {
            return Err(format!("the body `{body}`"));
        }
        if let Some(other) = self.readouts.get(&column) {
            return Err(other.clone());
        }
        self.readouts.insert(column, owner.to_owned());
        Ok(())
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
        // A body may have the name of an energy or of a column of another body.
        let of = ["energy.kinetic", "a", "a.x"].map(body).join(" ");
        let energies = ENERGY_COLUMNS.join(" ");
        let columns = TraceColumns::of(&names(&format!("time {of} {energies} angle p.x p.y")));
        let bodies = names("energy.kinetic a a.x");
        assert_eq!(columns, Ok(TraceColumns { bodies, readouts: names("angle p.x p.y") }));
        for (text, place, problem) in [
            ("", 0, "found ``, expected `time`"),
            ("t", 0, "found `t`, expected `time`"),
            ("time", 1, "`energy.kinetic` is missing"),
            ("time b.y", 1, "found `b.y`, expected `energy.kinetic`"),
            ("time b.x b.z", 2, "found `b.z`, expected `b.y`"),
            ("time energy.kinetic energy.total", 2, "found `energy.total`, expected"),
            ("time energy.kinetic energy.potential energy.total a a", 5, "duplicate column `a`"),
        ] {
            let wrong = TraceColumns::of(&names(text)).unwrap_err();
            assert_eq!(wrong.place, place, "{text}");
            assert!(wrong.problem.starts_with(problem), "{text}: {}", wrong.problem);
        }
    }
}
