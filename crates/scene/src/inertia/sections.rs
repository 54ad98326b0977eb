//! `shape` and its sizes, of a link or of a body: mass and inertia of a uniform body.
//!
//! `table => shape, mass`. A link defines the length; a separate shape has a key for it.

use crate::error::SceneError;
use crate::inertia::shapes::Shape;
use crate::precise::Precise;
use crate::solid::Solid;
use crate::text::{Choice, Kind as _, Number, Numbers, Table};

/// The names of shapes.
pub(crate) const NAMES: [&str; 6] = ["rod", "box", "cylinder", "tube", "plate", "sphere"];

/// Every key of a shape.
pub(crate) const KEYS: &[&str] = &[
    "shape",
    "mass",
    "density",
    "diameter",
    "inner_diameter",
    "wall",
    "section",
    "width",
    "thickness",
];

/// The sizes that a shape has.
pub(crate) fn sizes(shape: &str) -> &'static [&'static str] {
    match shape {
        "rod" | "cylinder" => &["diameter"],
        "box" => &["section"],
        "tube" => &["diameter", "inner_diameter", "wall"],
        "plate" => &["width", "thickness"],
        _ => &["diameter", "inner_diameter"],
    }
}

/// A uniform body along an axis.
#[derive(Clone, Debug, PartialEq)]
pub(crate) struct Section {
    /// Its name in a scene.
    pub(crate) name: &'static str,
    /// \[kg\], where it or its density is given.
    pub(crate) mass: Option<Precise>,
    /// \[m²\] moments over the mass about x, y and z.
    pub(crate) moments: [Precise; 3],
    /// Its solid; `None` without thickness.
    pub(crate) solid: Option<Solid>,
}

/// Reads a shape of a length along a body's axis. `key` names it, `others` are the table's other keys; `is_weighed`:
/// the body has its own mass.
pub(crate) fn section(
    table: &Table<'_>,
    key: &'static str,
    others: &[&'static str],
    (length, along): (Precise, usize),
    is_weighed: bool,
) -> Result<Section, SceneError> {
    let name = NAMES[table.optional(key, Choice(&NAMES))?.unwrap_or(0)];
    table.only(&[others, &[key, "mass", "density"], sizes(name)])?;
    let shape = read(table, name, length)?;
    let mass = table.optional("mass", Number::positive("kg"))?;
    let density = table.optional("density", Number::positive("kg/m³"))?;
    let mass = match (mass, density) {
        (Some(_), Some(_)) => {
            let help = "give either `mass` or `density`";
            return Err(table.refuse_key("density", "contradicts `mass`", help));
        }
        (Some(mass), None) => Some(mass.into()),
        (None, Some(density)) => match shape.volume() {
            Some(volume) => Some(Precise::from(density) * volume),
            None if is_weighed => None,
            None => {
                let size = if name == "plate" { "thickness" } else { "diameter" };
                let help = format!("add `{size}`, or give `mass` instead");
                return Err(table.refuse_key(
                    "density",
                    "is given for a body without volume",
                    help,
                ));
            }
        },
        (None, None) => None,
    };
    let [first, next, last] = shape.moments();
    let mut moments = [Precise::ZERO; 3];
    for (i, moment) in [first, next, last].into_iter().enumerate() {
        moments[(along + i) % 3] = moment;
    }
    Ok(Section { name, mass, moments, solid: shape.solid(along) })
}

fn read(table: &Table<'_>, name: &str, length: Precise) -> Result<Shape, SceneError> {
    let size = |key| table.required(key, Number::positive("m"));
    let precise = |key| size(key).map(Precise::from);
    Ok(match name {
        "rod" => match table.has("diameter") {
            true => Shape::Cylinder { length, outer: precise("diameter")?, inner: Precise::ZERO },
            false => Shape::SlenderRod { length },
        },
        "cylinder" => Shape::Cylinder { length, outer: precise("diameter")?, inner: Precise::ZERO },
        "tube" => {
            let outer = size("diameter")?;
            Shape::Cylinder { length, outer: outer.into(), inner: inner(table, outer)? }
        }
        "box" => {
            let [next, last] = table.required("section", Numbers(Number::positive("m")))?;
            Shape::Block { size: [length, next.into(), last.into()] }
        }
        "plate" => {
            let thickness = table.optional("thickness", Number::positive("m"))?.unwrap_or(0.0);
            Shape::Block { size: [length, precise("width")?, thickness.into()] }
        }
        _ => {
            let outer = size("diameter")?;
            let is_hollow = table.has("inner_diameter");
            let inner = if is_hollow { inner(table, outer)? } else { Precise::ZERO };
            Shape::Sphere { outer: outer.into(), inner }
        }
    })
}

/// \[m\] the inner diameter of a hollow shape.
fn inner(table: &Table<'_>, outer: f64) -> Result<Precise, SceneError> {
    let wall = table.optional("wall", Number::positive("m"))?;
    let inner = table.optional("inner_diameter", Number::positive("m"))?;
    let (key, inner) = match (wall, inner) {
        (Some(wall), None) => ("wall", Precise::from(outer) - Precise::from(2.0 * wall)),
        (None, Some(inner)) => ("inner_diameter", inner.into()),
        (Some(_), Some(_)) => {
            let help = "give either `wall` or `inner_diameter`";
            return Err(table.refuse_key("wall", "contradicts `inner_diameter`", help));
        }
        (None, None) => {
            return Err(table.missing("wall", &Number::positive("m").expected()));
        }
    };
    if !(0.0..outer).contains(&inner.nearest()) {
        let problem = format!("leaves no wall or no bore in a diameter of {outer:?} m");
        let help = "give an inner diameter from 0 to below the outer one, or a wall of at most half the outer one";
        return Err(table.refuse_value(key, &problem, help));
    }
    Ok(inner)
}
