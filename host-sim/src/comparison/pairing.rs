//! Pairs of bodies and values of two runs, by name.

use serde::Serialize;

use crate::recorded::{Head, Value};

/// The pairs, as rows of A and of B, and the unpaired rest.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct Pairing {
    /// Bodies that both have.
    pub bodies: Vec<Pair>,
    /// Read-outs and the like that both have.
    pub values: Vec<Pair>,
    /// What only one of them has.
    pub alone: [Alone; 2],
}

/// What both runs have.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct Pair {
    /// Its name.
    pub name: String,
    /// Its unit, if one of them records it.
    pub unit: String,
    /// Its row in A and in B.
    pub rows: [usize; 2],
}

/// What only one of two runs has, by name.
#[derive(Clone, Debug, Default, PartialEq, Eq, Serialize)]
pub struct Alone {
    /// Bodies.
    pub bodies: Vec<String>,
    /// Columns of read-outs; those of another unit in the other run are among them.
    pub readouts: Vec<String>,
}

impl Pairing {
    /// Pairs the contents of two runs.
    #[must_use]
    pub fn of(heads: [&Head; 2]) -> Self {
        let [a, b] = heads;
        let name_of = |name: &String| Value { name: name.clone(), unit: None };
        let as_values = |names: &[String]| names.iter().map(name_of).collect::<Vec<_>>();
        let (bodies, left) = pairs(&as_values(&a.bodies), &as_values(&b.bodies));
        let (values, others) = pairs(&a.values, &b.values);
        let [first, second] =
            left.into_iter().zip(others).collect::<Vec<_>>().try_into().unwrap_or_default();
        let alone = |(bodies, readouts)| Alone { bodies, readouts };
        Self { bodies, values, alone: [alone(first), alone(second)] }
    }

    /// Whether a body is in one run only.
    #[must_use]
    pub fn lacks_bodies(&self) -> bool {
        self.alone.iter().any(|alone| !alone.bodies.is_empty())
    }
}

fn pairs(a: &[Value], b: &[Value]) -> (Vec<Pair>, [Vec<String>; 2]) {
    let places: std::collections::BTreeMap<&str, usize> =
        b.iter().enumerate().map(|(row, value)| (value.name.as_str(), row)).collect();
    let (mut paired, mut left) = (Vec::new(), [Vec::new(), Vec::new()]);
    let mut taken = vec![false; b.len()];
    for (row, value) in a.iter().enumerate() {
        let other = places.get(value.name.as_str()).copied();
        let unit = |other: usize| match (&value.unit, &b[other].unit) {
            (Some(one), Some(two)) if one != two => None,
            (one, two) => Some(one.clone().or(two.clone()).unwrap_or_default()),
        };
        match other.and_then(|other| Some((other, unit(other)?))) {
            Some((other, unit)) => {
                taken[other] = true;
                paired.push(Pair { name: value.name.clone(), unit, rows: [row, other] });
            }
            None => left[0].push(value.name.clone()),
        }
    }
    let alone =
        b.iter().zip(taken).filter(|(_, taken)| !taken).map(|(value, _)| value.name.clone());
    left[1].extend(alone);
    (paired, left)
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn what_has_one_name_and_unit_goes_together() {
        let value = |name: &str, unit: Option<&str>| Value {
            name: name.into(),
            unit: unit.map(str::to_owned),
        };
        let a = [value("x", Some("m")), value("y", None), value("z", Some("m")), value("w", None)];
        let b = [
            value("z", Some("rad")),
            value("y", Some("N")),
            value("v", None),
            value("x", Some("m")),
        ];
        let (paired, left) = pairs(&a, &b);
        let pair =
            |name: &str, unit: &str, rows| Pair { name: name.into(), unit: unit.into(), rows };
        assert_eq!(paired, [pair("x", "m", [0, 3]), pair("y", "N", [1, 1])]);
        assert_eq!(left, [vec!["z".to_owned(), "w".into()], vec!["z".into(), "v".into()]]);
    }
}
