//! `[[geometry]]`: the appearance of bodies and the ground, for pictures only.
//!
//! `table => solid in its body's axes, colour`. It is not part of the model and affects neither bits nor hashes nor
//! exported source. A shape is one row of [`SHAPES`]: its keys and its reader.

mod colour;

use dbd_kernel::{BodyIndex, Vec3};

use crate::assembly::{Assembly, Resolved};
use crate::between::BodyName;
use crate::error::SceneError;
use crate::orientation::Orientation;
use crate::points::PlaceOf;
use crate::solid::Solid;
use crate::text::{Choice, Direction, Kind as _, Number, Numbers, Table};

use colour::Colour;
pub(crate) use colour::words as colour_words;

/// A solid that pictures show.
#[derive(Clone, Debug, PartialEq)]
pub struct GeometryInfo {
    /// The index of its body in the model; `None` for the ground.
    pub body: Option<usize>,
    /// The solid in the body's principal axes from its centre of mass; world for the ground.
    pub solid: Solid,
    /// `#rrggbb`, if it has its own colour.
    pub colour: Option<String>,
}

type Read = fn(&Table<'_>, &Site<'_>) -> Result<Solid, SceneError>;

struct Shape {
    name: &'static str,
    keys: &'static [&'static str],
    read: Read,
}

static SHAPES: [Shape; 4] = [
    Shape { name: "box", keys: &["at", "size", "orientation"], read: block },
    Shape {
        name: "cylinder",
        keys: &["from", "to", "at", "axis", "length", "radius", "diameter"],
        read: cylinder,
    },
    Shape { name: "link", keys: &["from", "to", "radius", "diameter"], read: link },
    Shape { name: "sphere", keys: &["at", "radius", "diameter"], read: sphere },
];

const KEYS: &[&str] = &["body", "shape", "colour"];

/// \[m\] Greatest coordinate and size, as everywhere in a scene.
const GREATEST: f64 = 1e150;

/// Ends coincide if they are closer than this fraction of their coordinates.
const COINCIDENT: f64 = 1e-12;

/// Every key of all shapes.
pub(crate) fn keys() -> Vec<&'static [&'static str]> {
    std::iter::once(KEYS).chain(SHAPES.iter().map(|shape| shape.keys)).collect()
}

/// The shapes, each with all its keys.
pub(crate) fn shapes() -> impl Iterator<Item = (&'static str, Vec<&'static str>)> {
    SHAPES.iter().map(|shape| (shape.name, [KEYS, shape.keys].concat()))
}

/// The body in whose axes a solid is given.
struct Site<'a> {
    assembly: &'a Assembly,
    body: BodyIndex,
}

/// Reads all geometry in scene order.
pub(crate) fn read_all(
    root: &Table<'_>,
    assembly: &Assembly,
) -> Result<Vec<GeometryInfo>, SceneError> {
    let mut all = Vec::new();
    for table in root.list("geometry")? {
        let shape = shape(&table)?;
        table.only(&[KEYS, shape.keys])?;
        let (_, body) = table.required("body", BodyName { assembly, world: true })?;
        let solid = (shape.read)(&table, &Site { assembly, body })?;
        if !solid.numbers().iter().all(|number| number.abs() <= GREATEST) {
            let help = "use coordinates and sizes of at most 1e150 m";
            return Err(table.refuse("exceeds the range of coordinates", help));
        }
        let colour = table.optional("colour", Colour)?;
        all.push(GeometryInfo { body: (!body.is_world()).then(|| body.row()), solid, colour });
    }
    Ok(all)
}

/// Accepts only the keys of its shape: defaults of other shapes do not apply.
pub(crate) fn allow(table: &Table<'_>) -> Result<(), SceneError> {
    table.only(&[KEYS, shape(table)?.keys])
}

fn shape(table: &Table<'_>) -> Result<&'static Shape, SceneError> {
    if !table.has("shape") {
        table.only(&keys())?;
    }
    let index = table.required("shape", Choice(&SHAPES.each_ref().map(|shape| shape.name)))?;
    Ok(&SHAPES[index])
}

impl Solid {
    /// All coordinates and sizes \[m\].
    fn numbers(&self) -> Vec<f64> {
        match self {
            Self::Box { at, half, .. } => [at, half].into_iter().flatten().copied().collect(),
            Self::Cylinder { ends, radius } | Self::Link { ends, radius } => {
                ends.as_flattened().iter().chain([radius]).copied().collect()
            }
            Self::Sphere { at, radius } => at.iter().chain([radius]).copied().collect(),
        }
    }
}

impl Site<'_> {
    /// A point given by a key; `None` if the key is absent.
    fn place(&self, table: &Table<'_>, key: &str) -> Result<Option<Vec3<f64>>, SceneError> {
        table.optional(key, PlaceOf { assembly: self.assembly, body: self.body })
    }

    /// `from` and `to`.
    fn ends(&self, table: &Table<'_>) -> Result<[[f64; 3]; 2], SceneError> {
        let place = PlaceOf { assembly: self.assembly, body: self.body };
        let ends = [table.required("from", place)?, table.required("to", place)?];
        let apart = ends[1] - ends[0];
        let ends = ends.map(Vec3::to_f64);
        let largest = ends.as_flattened().iter().fold(0.0_f64, |a, b| a.max(b.abs()));
        let longest = apart.to_f64().into_iter().fold(0.0_f64, |a, b| a.max(b.abs()));
        if longest <= COINCIDENT * largest {
            let help = "give two different points, or use `shape = \"sphere\"`";
            return Err(table.refuse_value("to", "coincides with `from`", help));
        }
        Ok(ends)
    }
}

fn block(table: &Table<'_>, site: &Site<'_>) -> Result<Solid, SceneError> {
    let at = site.place(table, "at")?.unwrap_or_default().to_f64();
    let size = table.required("size", Numbers::<3>(Number::positive("m")))?;
    let own = table.optional("orientation", Orientation)?.unwrap_or([1.0, 0.0, 0.0, 0.0]);
    let turn = site.assembly.turn_of_written(site.body, own);
    if let Some(value) = table.value("orientation").filter(|_| turn != own) {
        site.assembly.resolve(&value, Resolved::Turn(turn));
    }
    Ok(Solid::Box { at, turn, half: size.map(|side| 0.5 * side) })
}

fn cylinder(table: &Table<'_>, site: &Site<'_>) -> Result<Solid, SceneError> {
    let has = |key: &&str| table.has(key);
    let by_ends = ["from", "to"].iter().find(|key| has(key));
    let by_middle = ["at", "axis", "length"].iter().find(|key| has(key));
    let help = "give either `from` and `to`, the centres of its end faces, or `axis` and `length`, centred at the \
                centre of mass or at `at`";
    let ends = match (by_ends, by_middle) {
        (Some(_), Some(key)) => {
            return Err(table.refuse_key(key, "contradicts `from` and `to`", help));
        }
        (Some(_), None) => site.ends(table)?,
        (None, Some(_)) => {
            let at = site.place(table, "at")?.unwrap_or_default();
            let own = table.required("axis", Direction)?;
            let axis = site.assembly.of_written(site.body, own);
            site.assembly.resolve_direction(table.value("axis"), own, axis);
            let half = 0.5 * table.required("length", Number::positive("m"))?;
            [-half, half].map(|along| (at + axis * along).to_f64())
        }
        (None, None) => return Err(table.refuse("has no position", help)),
    };
    Ok(Solid::Cylinder { ends, radius: radius(table)? })
}

fn link(table: &Table<'_>, site: &Site<'_>) -> Result<Solid, SceneError> {
    Ok(Solid::Link { ends: site.ends(table)?, radius: radius(table)? })
}

fn sphere(table: &Table<'_>, site: &Site<'_>) -> Result<Solid, SceneError> {
    let at = site.place(table, "at")?.unwrap_or_default().to_f64();
    Ok(Solid::Sphere { at, radius: radius(table)? })
}

/// \[m\] `radius`, or half of `diameter`.
fn radius(table: &Table<'_>) -> Result<f64, SceneError> {
    let number = Number::positive("m");
    let radius = table.optional("radius", number)?;
    match (radius, table.optional("diameter", number)?) {
        (Some(radius), None) => Ok(radius),
        (None, Some(diameter)) => Ok(0.5 * diameter),
        (Some(_), Some(_)) => {
            let help = "give either `radius` or `diameter`";
            Err(table.refuse_key("diameter", "contradicts `radius`", help))
        }
        (None, None) => {
            Err(table.missing("radius", &format!("{}, or `diameter`", number.expected())))
        }
    }
}
