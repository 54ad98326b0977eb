//! `[[tsda]]`: one raw TSDA between two points; a point bushing if the free length is 0.

use dbd_kernel::Vec3;

use crate::assembly::{Assembly, Points};
use crate::between::Between;
use crate::error::SceneError;
use crate::free_length::winches;
use crate::pair::Pair;
use crate::points::PlaceOf;
use crate::raw_groups::{Leg, raw_groups};
use crate::spring;
use crate::target::{Elements, Target};
use crate::text::{Kind, Number, Table, Value};

pub(crate) const KEYS: &[&str] = &["name", "between", "points", "free_length", "acts", "limits"];

/// Points closer than this fraction of the free length define no direction.
const COINCIDENT: f64 = 1e-9;

/// The raw TSDAs of a scene as groups of the model.
#[derive(Clone, Debug, Default)]
pub(crate) struct Raw {
    /// The name of each in messages.
    pub(crate) names: Vec<String>,
    /// The row of the first table of each.
    pub(crate) rows: Vec<usize>,
}

/// A raw TSDA as it was read.
struct Read<'t> {
    row: usize,
    table: Table<'t>,
    leg: Leg,
    names: [String; 2],
}

/// Reads all raw TSDAs in scene order; those with a free length that an input sets are laws. TSDAs that write a joint
/// out become one group, see [`raw_groups`].
pub(crate) fn read_all(
    root: &Table<'_>,
    planar: bool,
    assembly: &mut Assembly,
    elements: &mut Elements,
) -> Result<Raw, SceneError> {
    let winches = winches(root)?;
    let mut all = Vec::new();
    for (row, table) in root.list("tsda")?.into_iter().enumerate() {
        table.only(&[KEYS, spring::KEYS])?;
        if winches.contains_key(&row) {
            continue;
        }
        all.push(read(row, table, assembly)?);
    }
    let mut raw = Raw::default();
    let legs: Vec<_> = all.iter().map(|one| one.leg).collect();
    for group in raw_groups(&legs, planar) {
        let (Some(first), Some(last)) = (group.rows().next(), group.rows().next_back()) else {
            continue;
        };
        let Read { row, table, leg, names } = &all[first];
        elements.read_optional(table, "tsda", Target::Tsda(assembly.groups().len()))?;
        let ([a, b], [from, to]) = (leg.bodies, leg.points);
        let pair = Pair { a, b, names: names.clone() };
        let mut label = pair.label(table);
        if last > first {
            label =
                format!("tsda {} to {} ({}–{})", row + 1, all[last].row + 1, names[0], names[1]);
        }
        if leg.free_length == 0.0 {
            let points = Points { centres: &[from], tips: &[to], shared: false };
            assembly.add_bushings(&pair, points, 0.0, leg.spring)
        } else {
            let pair = if group.is_reversed { pair.reversed() } else { pair };
            let [centres, tips] = [group.centres(&legs), group.tips(&legs)];
            let points = Points { centres: &centres, tips: &tips, shared: centres.len() > 1 };
            assembly.add_tsdas(&pair, points, leg.free_length, leg.spring)
        }
        .map_err(|defect| defect.refuse(table))?;
        raw.names.push(label);
        raw.rows.push(*row);
    }
    Ok(raw)
}

fn read<'t>(row: usize, table: Table<'t>, assembly: &Assembly) -> Result<Read<'t>, SceneError> {
    if table.has("acts") {
        let help = "drive the free length by an input of the type \"free_length\", or use the law \
            `distance-spring` of an interaction with a `force` on one side only";
        return Err(table.refuse_key("acts", "needs an input of the free length", help));
    }
    let pair = table.required("between", Between(assembly))?;
    let points = table.required("points", TwoPoints { assembly, pair: &pair })?;
    let spring = spring::read(&table, spring::AXIAL)?;
    let d = assembly.place(pair.b, points[1]) - assembly.place(pair.a, points[0]);
    let distance = libm::sqrt(d.dot(d));
    let Some(free_length) = table.optional("free_length", FreeLength { distance })? else {
        let help = format!("add `free_length`: {}", FreeLength { distance }.expected());
        return Err(table.refuse("has no `free_length`, and no input sets it", help));
    };
    if free_length > 0.0 && distance <= COINCIDENT * free_length {
        let help = "give two different points, or use `free_length = 0` for a spring that is \
            isotropic";
        let problem = "coincide, but `free_length` is not 0";
        return Err(table.refuse_value("points", problem, help));
    }
    let bodies = [pair.a, pair.b];
    let is_alone = table.has("name") || table.has("limits") || free_length == 0.0;
    let leg = Leg { bodies, points, free_length, spring, is_alone };
    Ok(Read { row, table, leg, names: pair.names })
}

/// A length, or `"initial"` for the length at the initial pose.
pub(crate) struct FreeLength {
    /// \[m\] length at the initial pose.
    pub(crate) distance: f64,
}

const INITIAL: &str = "initial";

impl Kind for FreeLength {
    type Output = f64;

    fn expected(&self) -> String {
        format!(
            "{}, or \"{INITIAL}\" for the length at t = 0",
            Number::not_negative("m").expected()
        )
    }

    fn read(&self, value: &Value<'_>) -> Result<f64, SceneError> {
        match value.get().as_str() {
            Some(INITIAL) => Ok(self.distance),
            _ => Number::not_negative("m").read(value),
        }
    }
}

/// A point of the first body and one of the second.
struct TwoPoints<'a> {
    assembly: &'a Assembly,
    pair: &'a Pair,
}

impl Kind for TwoPoints<'_> {
    type Output = [Vec3<f64>; 2];

    fn expected(&self) -> String {
        "two points in m, [[x, y, z], [x, y, z]], each in the axes of its body, or names of points"
            .into()
    }

    fn read(&self, value: &Value<'_>) -> Result<[Vec3<f64>; 2], SceneError> {
        let Self { assembly, pair } = *self;
        let mut points = [Vec3::ZERO; 2];
        let entries = value.entries(2, || self.expected())?;
        for ((point, entry), body) in points.iter_mut().zip(entries).zip([pair.a, pair.b]) {
            *point = PlaceOf { assembly, body }.read(&entry)?;
        }
        Ok(points)
    }
}

#[cfg(test)]
mod tests {
    use dbd_kernel::Vec3;
    use dbd_kernel::model::Law;

    use crate::example;

    #[test]
    fn points_are_taken_as_given_and_no_free_length_makes_a_bushing() {
        let scene = example::with(
            "[[tsda]]\nbetween = [\"arm\", \"hand\"]\npoints = [[0, 0.5, 0], [0, -2, 0]]\n\
             stiffness = 4e6\nfree_length = 0.03\n[[tsda]]\nbetween = [\"world\", \"hand\"]\n\
             points = [[1, 2, 3], [0, 0, 0]]\nstiffness = 8\ndamping = 0.5\nfree_length = 0",
        );
        let model = &scene.model;
        assert_eq!((model.groups[0].law, model.groups[1].law), (Law::Tsda, Law::PointBushing));
        assert_eq!(model.points[..2], [Vec3::new(0.0, 0.5, 0.0), Vec3::new(0.0, -2.0, 0.0)]);
        assert_eq!(model.points[2..], [Vec3::new(1.0, 2.0, 3.0), Vec3::ZERO]);
        assert_eq!((model.tsdas[0].stiffness, model.tsdas[0].free_length), (4e6, 0.03));
        assert_eq!((model.bushings[0].stiffness, model.dampers[0]), (8.0, 0.5));
        assert!(scene.joints.is_empty());
    }
}
